# SPDX-License-Identifier: GPL-3.0-or-later
#
# The native library: meander_core, a static one for the tests, and meander, the shared one.

set(generated_dir "${PROJECT_BINARY_DIR}/generated")
configure_file(cmake/version.h.in "${generated_dir}/version.h" @ONLY)

# What of the library only repeats the header.
add_custom_command(
  OUTPUT "${generated_dir}/structs.inc"
  COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/scripts/generate_abi.py"
          --header "${PROJECT_SOURCE_DIR}/native/include/meander/meander.h"
          --structs "${generated_dir}/structs.inc"
  DEPENDS native/include/meander/meander.h scripts/generate_abi.py
  COMMENT "Making structs.inc from meander.h" VERBATIM)

file(GLOB_RECURSE sources CONFIGURE_DEPENDS
  "${PROJECT_SOURCE_DIR}/native/src/*.cpp" "${PROJECT_SOURCE_DIR}/native/src/*.h")

# OpenMesh's connectivity, whose warnings and assertions are not ours (native/third_party/openmesh). A section for
# each function lets the linker leave out what nobody calls.
set(openmesh_dir "${PROJECT_SOURCE_DIR}/native/third_party/openmesh")
file(GLOB_RECURSE openmesh_sources CONFIGURE_DEPENDS "${openmesh_dir}/*.cc")
set_source_files_properties(${openmesh_sources} PROPERTIES
  COMPILE_OPTIONS "-w;-DNDEBUG;-ffunction-sections;-fdata-sections"
  SKIP_UNITY_BUILD_INCLUSION ON
  SKIP_PRECOMPILE_HEADERS ON)

add_library(meander_core STATIC ${sources} ${openmesh_sources} "${generated_dir}/structs.inc")
set_target_properties(meander_core PROPERTIES
  POSITION_INDEPENDENT_CODE ON
  CXX_VISIBILITY_PRESET hidden
  VISIBILITY_INLINES_HIDDEN ON)
target_include_directories(meander_core
  PUBLIC "${PROJECT_SOURCE_DIR}/native/include"
         "${PROJECT_SOURCE_DIR}/native/src"
         "${generated_dir}")
target_include_directories(meander_core SYSTEM PUBLIC "${openmesh_dir}")
# EIGEN_MPL2_ONLY makes it an error to use one of the few LGPL parts of Eigen. EIGEN_DONT_VECTORIZE leaves out its
# vectors for this processor, and EIGEN_VECTORIZE has it use those of base/eigen.h, the same on every platform.
# The objects go into the shared library, which exports the C API; programs linked with the static
# library do not import it.
target_compile_definitions(meander_core
  PUBLIC EIGEN_MPL2_ONLY EIGEN_DONT_VECTORIZE EIGEN_VECTORIZE
  PRIVATE MEANDER_BUILDING
  INTERFACE MEANDER_STATIC)
target_link_libraries(meander_core
  PUBLIC Eigen3::Eigen nanoflann::nanoflann Threads::Threads meander_compile_options)

# What libFuzzer is led by (tests/fuzz). The tests' own code is not counted, and those that do not fuzz are
# hardly slower: the sanitizer's run-time library ignores the counters.
if(MEANDER_SANITIZE MATCHES "address" AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  target_compile_options(meander_core PRIVATE -fsanitize-coverage=inline-8bit-counters,pc-table)
endif()

# The version is part of the file name: a process that has loaded a library keeps it when another
# takes its path, so the library of an add-on updated in a running Blender needs a name of its own.
add_library(meander SHARED $<TARGET_OBJECTS:meander_core>)
set_target_properties(meander PROPERTIES
  OUTPUT_NAME "meander-${PROJECT_VERSION}"
  LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib"
  RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib" # a DLL is one for CMake
  ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib"
  LINKER_LANGUAGE CXX
  LINK_DEPENDS "${PROJECT_SOURCE_DIR}/cmake/exports.map")
if(WIN32)
  set_target_properties(meander PROPERTIES PREFIX "")
endif()
target_include_directories(meander INTERFACE "${PROJECT_SOURCE_DIR}/native/include")
target_link_libraries(meander PRIVATE Threads::Threads meander_compile_options)
if(APPLE)
  # Hidden visibility and this leave the C API, and the runtime's operators new and delete, which the system
  # joins with its own.
  target_link_options(meander PRIVATE -Wl,-dead_strip)
  # A name without the folder in which it was built.
  set_target_properties(meander PROPERTIES BUILD_WITH_INSTALL_NAME_DIR ON INSTALL_NAME_DIR "@rpath")
elseif(MINGW)
  # What is marked for export is all that is exported; the C++ runtime comes along.
  target_link_options(meander PRIVATE -static)
elseif(NOT WIN32)
  target_link_options(meander PRIVATE
    "LINKER:--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map"
    "LINKER:--as-needed"
    "LINKER:--gc-sections")
  # A sanitized library finds its run-time symbols only in the program that loads it.
  if(NOT MEANDER_SANITIZE)
    target_link_options(meander PRIVATE "LINKER:--no-undefined")
  endif()
endif()

# Reports of sanitizers name lines of the library. In the tests, whose functions they name, lines would take a sixth of
# the compiler's time.
if(MEANDER_SANITIZE)
  target_compile_options(meander_core PRIVATE -g1)
endif()

# Reading Eigen and the large headers of the standard library takes nearly half of the time.
if(MEANDER_UNITY)
  include(cmake/unity.cmake)
elseif(NOT CMAKE_CROSSCOMPILING) # Zig takes no precompiled header in the form of CMake
  target_precompile_headers(meander_core PRIVATE
    "${PROJECT_SOURCE_DIR}/native/src/base/eigen.h" <algorithm> <functional> <memory> <ranges> <string> <vector>)
endif()

# The Python module that declares the C API is generated from the header in every build, so it
# always fits the library of the same build. It is placed among the add-on's sources, which cannot
# run without the library either, and git ignores it as it does the library.
add_custom_target(abi ALL
  COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/scripts/generate_abi.py"
          --header "${PROJECT_SOURCE_DIR}/native/include/meander/meander.h"
          --output "${PROJECT_SOURCE_DIR}/addon/meander/binding/abi.py"
  COMMENT "Making addon/meander/binding/abi.py from meander.h" VERBATIM)

# A source checkout works as an add-on once it has been built. Checked in every build, so that a
# deleted copy comes back.
if(MEANDER_STAGE)
  add_custom_target(stage ALL
    COMMAND ${CMAKE_COMMAND}
            "-DFILES=$<TARGET_FILE:meander>"
            "-DFOLDER=${PROJECT_SOURCE_DIR}/addon/meander/native/${meander_platform}"
            -P "${PROJECT_SOURCE_DIR}/cmake/stage.cmake"
    DEPENDS meander abi
    COMMENT "Copying the library into addon/meander/native" VERBATIM)
endif()
