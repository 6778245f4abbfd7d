# SPDX-License-Identifier: GPL-3.0-or-later
#
# meander_openmesh: OpenMesh's headers, and the few of its sources that they need. Debian has the rest of
# OpenMesh only as a shared library, which no system has by itself (docs/building.md).

if(NOT OPENMESH_INCLUDE_DIR)
  find_path(OPENMESH_INCLUDE_DIR OpenMesh/Core/Mesh/TriConnectivity.hh REQUIRED)
endif()
# The sources are those of 9.0, and read members that its headers declare.
file(STRINGS "${OPENMESH_INCLUDE_DIR}/OpenMesh/Core/System/config.h" openmesh_version
  REGEX "^#define OM_VERSION 0x90000")
if(NOT openmesh_version)
  message(FATAL_ERROR "native/third_party/openmesh needs the headers of OpenMesh 9.0; "
    "those in ${OPENMESH_INCLUDE_DIR} are of another version")
endif()

file(GLOB openmesh_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/native/third_party/openmesh/*.cc")
add_library(meander_openmesh OBJECT ${openmesh_sources})
set_target_properties(meander_openmesh PROPERTIES
  POSITION_INDEPENDENT_CODE ON
  CXX_VISIBILITY_PRESET hidden
  VISIBILITY_INLINES_HIDDEN ON)
target_include_directories(meander_openmesh SYSTEM PUBLIC "${OPENMESH_INCLUDE_DIR}")
# Its warnings are not ours. One section a function lets the linker leave out what nobody calls.
target_compile_options(meander_openmesh PRIVATE -w -ffunction-sections -fdata-sections)
if(MEANDER_SANITIZE)
  target_compile_options(meander_openmesh PRIVATE -fsanitize=${MEANDER_SANITIZE} -fno-omit-frame-pointer -g)
endif()
