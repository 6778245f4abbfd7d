# SPDX-License-Identifier: GPL-3.0-or-later
#
# meander, the library as a shared one, with the C API as its only symbols.

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
  # joins with its own. -x: no names of what is hidden, which are a quarter of the file.
  target_link_options(meander PRIVATE -Wl,-dead_strip -Wl,-x)
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
