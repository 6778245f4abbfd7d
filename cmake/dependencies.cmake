# SPDX-License-Identifier: GPL-3.0-or-later
#
# The headers of others: Eigen and nanoflann, from packages of the system, or else from one folder,
# MEANDER_HEADERS, which has Eigen/ and nanoflann.hpp in it. A build for another system needs that folder: among /usr/include they lie beside headers of the wrong system.

set(MEANDER_HEADERS "" CACHE PATH "A folder with Eigen/ and nanoflann.hpp; empty: the system's")

if(MEANDER_THREADS)
  find_package(Threads REQUIRED)
endif()
find_package(Python3 3.10 REQUIRED COMPONENTS Interpreter)

if(MEANDER_HEADERS)
  foreach(header Eigen/Core nanoflann.hpp)
    if(NOT EXISTS "${MEANDER_HEADERS}/${header}")
      message(FATAL_ERROR "MEANDER_HEADERS is ${MEANDER_HEADERS}, where ${header} is missing: docs/building.md")
    endif()
  endforeach()
  foreach(target Eigen3::Eigen nanoflann::nanoflann)
    add_library(${target} INTERFACE IMPORTED)
    target_include_directories(${target} SYSTEM INTERFACE "${MEANDER_HEADERS}")
  endforeach()
else()
  find_package(Eigen3 3.4 QUIET NO_MODULE)
  find_package(nanoflann QUIET)
  foreach(package Eigen3 nanoflann)
    if(NOT ${package}_FOUND)
      message(FATAL_ERROR "The headers of ${package} are missing: install both of Eigen 3.4 and nanoflann (on Debian apt install libeigen3-dev libnanoflann-dev), or name a folder that has Eigen/ and nanoflann.hpp by MEANDER_HEADERS=FOLDER, after -D of cmake or after -C cmake.define. of pip")
    endif()
  endforeach()
endif()
