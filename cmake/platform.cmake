# SPDX-License-Identifier: GPL-3.0-or-later
#
# meander_platform: what the built library is for, as the manifest of a Blender extension calls it.
# addon/meander/binding/library_file.py looks for the library in a folder of this name.

if(WIN32)
  set(meander_system windows)
elseif(APPLE)
  set(meander_system macos)
else()
  string(TOLOWER "${CMAKE_SYSTEM_NAME}" meander_system)
endif()

set(meander_machine "${CMAKE_SYSTEM_PROCESSOR}")
if(APPLE AND CMAKE_OSX_ARCHITECTURES)
  list(LENGTH CMAKE_OSX_ARCHITECTURES count)
  if(NOT count EQUAL 1)
    message(FATAL_ERROR "the library is built for one processor at a time: "
      "set CMAKE_OSX_ARCHITECTURES to arm64 or x86_64, not ${CMAKE_OSX_ARCHITECTURES}")
  endif()
  set(meander_machine "${CMAKE_OSX_ARCHITECTURES}")
endif()
string(TOLOWER "${meander_machine}" meander_machine)
if(meander_machine MATCHES "^(x86_64|amd64)$")
  set(meander_machine x64)
elseif(meander_machine MATCHES "^(aarch64|arm64)$")
  set(meander_machine arm64)
endif()

set(meander_platform "${meander_system}-${meander_machine}")

# Microsoft's compiler has no vector types like GCC's, which the medial axis is written with; clang-cl
# takes its options.
if(MSVC)
  message(FATAL_ERROR "On Windows this library is compiled with clang: "
    "cmake --preset windows, or -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++")
endif()
