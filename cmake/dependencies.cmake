# SPDX-License-Identifier: GPL-3.0-or-later
#
# The headers of others: Eigen, nanoflann and OpenMesh, from packages of the system, or else from one
# folder, MEANDER_HEADERS, which has Eigen/, nanoflann.hpp and OpenMesh/ in it. A build for another
# system needs that folder: among /usr/include they lie beside headers of the wrong system.

set(MEANDER_HEADERS "" CACHE PATH "A folder with Eigen/, nanoflann.hpp and OpenMesh/; empty: the system's")

find_package(Threads REQUIRED)
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)

if(MEANDER_HEADERS)
  foreach(header Eigen/Core nanoflann.hpp OpenMesh/Core/Mesh/TriConnectivity.hh)
    if(NOT EXISTS "${MEANDER_HEADERS}/${header}")
      message(FATAL_ERROR "MEANDER_HEADERS is ${MEANDER_HEADERS}, where ${header} is missing: docs/building.md")
    endif()
  endforeach()
  foreach(target Eigen3::Eigen nanoflann::nanoflann)
    add_library(${target} INTERFACE IMPORTED)
    target_include_directories(${target} SYSTEM INTERFACE "${MEANDER_HEADERS}")
  endforeach()
  set(OPENMESH_INCLUDE_DIR "${MEANDER_HEADERS}")
else()
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  find_package(nanoflann REQUIRED)
endif()
