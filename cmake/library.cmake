# SPDX-License-Identifier: GPL-3.0-or-later
#
# The native library: meander_core, a static one for the tests, and meander, the one that programs load.

set(generated_dir "${PROJECT_BINARY_DIR}/generated")
configure_file(cmake/version.h.in "${generated_dir}/version.h" @ONLY)

# The header includes one for each object.
file(GLOB headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/native/include/meander/*.h")

# What of the library only repeats them.
add_custom_command(
  OUTPUT "${generated_dir}/structs.inc"
  COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/scripts/generate_abi.py"
          --header "${PROJECT_SOURCE_DIR}/native/include/meander/meander.h"
          --structs "${generated_dir}/structs.inc"
  DEPENDS ${headers} scripts/generate_abi.py scripts/c_header.py
  COMMENT "Making structs.inc from meander.h" VERBATIM)

file(GLOB_RECURSE sources CONFIGURE_DEPENDS
  "${PROJECT_SOURCE_DIR}/native/src/*.cpp" "${PROJECT_SOURCE_DIR}/native/src/*.h")

# The same classes with threads and without.
set(threaded base/thread_pool.cpp outputs/job.cpp)
set(serial base/serial_pool.cpp outputs/serial_job.cpp)
if(MEANDER_THREADS)
  set(left_out ${serial})
else()
  set(left_out ${threaded})
endif()
list(TRANSFORM left_out PREPEND "${PROJECT_SOURCE_DIR}/native/src/")
list(REMOVE_ITEM sources ${left_out})

# OpenMesh's connectivity, whose warnings and assertions are not ours (native/third_party/openmesh). A section for
# each function lets the linker leave out what nobody calls.
set(openmesh_dir "${PROJECT_SOURCE_DIR}/native/third_party/openmesh")
file(GLOB_RECURSE openmesh_sources CONFIGURE_DEPENDS "${openmesh_dir}/*.cc")
if(NOT MEANDER_THREADS)
  list(FILTER openmesh_sources EXCLUDE REGEX "/omstream\\.cc$") # native/web/openmesh has another
endif()
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
if(NOT MEANDER_THREADS)
  target_include_directories(meander_core SYSTEM BEFORE PUBLIC "${PROJECT_SOURCE_DIR}/native/web/openmesh")
endif()
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
  PUBLIC Eigen3::Eigen nanoflann::nanoflann $<TARGET_NAME_IF_EXISTS:Threads::Threads> meander_compile_options)
if(NOT MEANDER_THREADS)
  target_compile_definitions(meander_core PUBLIC MEANDER_WITHOUT_THREADS)
endif()

# What libFuzzer is led by (tests/fuzz). The tests' own code is not counted, and those that do not fuzz are
# hardly slower: the sanitizer's run-time library ignores the counters.
if(MEANDER_SANITIZE MATCHES "address" AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  target_compile_options(meander_core PRIVATE -fsanitize-coverage=inline-8bit-counters,pc-table)
endif()

if(CMAKE_SYSTEM_PROCESSOR STREQUAL "wasm32")
  include(cmake/web.cmake)
else()
  include(cmake/shared_library.cmake)
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
