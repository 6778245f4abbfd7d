# SPDX-License-Identifier: GPL-3.0-or-later
#
# Native tests: every tests/native/test_*.cpp is a GoogleTest program of its own, linked with
# meander_core, so that it may test the inside as well as the C API.
#
# With MEANDER_JOINED_TESTS most of them are one program, native_tests, and 24 files at a time are compiled as one: most
# of the time goes to templates of the headers, which all of them use. A file's own program is then built when asked for.
# The namespace of a test has the name of its file, so files share no names.
#
# For another system GoogleTest is built from its sources, and the tests are only built: tests/platforms
# runs them by Wine and qemu.

if(CMAKE_CROSSCOMPILING)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON) # Zig takes no precompiled header in the form of CMake
  set(BUILD_GMOCK OFF)
  set(INSTALL_GTEST OFF)
  add_subdirectory(/usr/src/googletest "${PROJECT_BINARY_DIR}/googletest" EXCLUDE_FROM_ALL)
else()
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()

file(GLOB test_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/native/test_*.cpp")
# What the tests share (meshes, brute-force checks) is in headers beside them; what every test program
# is linked with is compiled once.
file(GLOB test_support CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/native/*.cpp")
list(REMOVE_ITEM test_support ${test_sources})
add_library(meander_test_support OBJECT ${test_support})
target_include_directories(meander_test_support PUBLIC "${PROJECT_SOURCE_DIR}/tests/native")
target_link_libraries(meander_test_support PUBLIC meander_core GTest::gtest GTest::gtest_main)
# Tests spend their time in the library, and at -O2 they themselves take 1.4 times as long to compile.
target_compile_options(meander_test_support PUBLIC $<$<CONFIG:Release>:-O1>)
# Reading these takes longer than compiling many a test.
target_precompile_headers(meander_test_support PRIVATE
  <gtest/gtest.h> <Eigen/Core> "${PROJECT_SOURCE_DIR}/tests/native/curves.h")

# These put others in the place of operator new and malloc.
set(failing_tests test_out_of_memory test_failing_calls)

function(add_native_tests name)
  add_executable(${name} ${ARGN} $<TARGET_OBJECTS:meander_test_support>)
  target_link_libraries(${name} PRIVATE meander_test_support)
  target_precompile_headers(${name} REUSE_FROM meander_test_support)
endfunction()

set(test_programs "")
set(joined_sources "")
foreach(test_source IN LISTS test_sources)
  get_filename_component(test_name "${test_source}" NAME_WE)
  add_native_tests(${test_name} "${test_source}")
  if(MEANDER_JOINED_TESTS AND NOT test_name IN_LIST failing_tests)
    set_target_properties(${test_name} PROPERTIES EXCLUDE_FROM_ALL ON)
    list(APPEND joined_sources "${test_source}")
  else()
    list(APPEND test_programs ${test_name})
  endif()
endforeach()
if(joined_sources)
  add_native_tests(native_tests ${joined_sources})
  set_target_properties(native_tests PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 24)
  list(APPEND test_programs native_tests)
endif()
if(NOT CMAKE_CROSSCOMPILING)
  foreach(test_program IN LISTS test_programs)
    gtest_discover_tests(${test_program}
      TEST_PREFIX "${test_program}."
      DISCOVERY_TIMEOUT 60
      PROPERTIES TIMEOUT 300)
  endforeach()
endif()
# Eigen and nanoflann allocate by malloc: where the linker can put another one in its place, that fails as well.
if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND NOT CMAKE_CROSSCOMPILING)
  foreach(test_name IN LISTS failing_tests)
    target_compile_definitions(${test_name} PRIVATE MEANDER_WRAPPED_MALLOC)
    target_link_options(${test_name} PRIVATE LINKER:--wrap=malloc,--wrap=calloc,--wrap=realloc)
  endforeach()
  # It looks whether there is a function that it does not try.
  target_compile_definitions(test_failing_calls PRIVATE
    "MEANDER_HEADERS=\"${PROJECT_SOURCE_DIR}/native/include/meander\"")
endif()
if(CMAKE_CROSSCOMPILING)
  return()
endif()

include(cmake/sweep.cmake)
if(MEANDER_SANITIZE MATCHES "address" AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  include(cmake/fuzz.cmake)
endif()

# The header is C99, and a program compiled against the first declarations of this ABI runs with the present library.
set(abi3_header "${generated_dir}/abi3/meander.h")
add_custom_command(
  OUTPUT "${abi3_header}"
  COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/scripts/dump_abi.py"
          --dump "${PROJECT_SOURCE_DIR}/tests/native/abi3.txt" --c "${abi3_header}"
  DEPENDS tests/native/abi3.txt scripts/dump_abi.py scripts/c_header.py
  COMMENT "Making the header of ABI 3 as it began" VERBATIM)
foreach(client c99_client abi3_client)
  add_executable(${client} tests/native/client.c)
  target_compile_options(${client} PRIVATE -pedantic -Wall -Wextra -Werror)
  target_link_libraries(${client} PRIVATE meander m)
endforeach()
target_include_directories(c99_client PRIVATE native/include/meander)
target_sources(abi3_client PRIVATE "${abi3_header}")
target_include_directories(abi3_client BEFORE PRIVATE "${generated_dir}/abi3")
add_test(NAME c99_client COMMAND c99_client "${PROJECT_VERSION}")
add_test(NAME abi3_client COMMAND abi3_client)
# What sanitizers check of C++ is in a run-time library that only C++ programs are linked with.
if(MEANDER_SANITIZE)
  foreach(client c99_client abi3_client)
    target_link_libraries(${client} PRIVATE meander_compile_options)
    set_target_properties(${client} PROPERTIES LINKER_LANGUAGE CXX)
  endforeach()
endif()

# Shared libraries export exactly what the header declares, and need only what every system has.
set(shared_libraries meander)
if(TARGET meander_installed)
  list(APPEND shared_libraries meander_installed)
endif()
foreach(library IN LISTS shared_libraries)
  add_test(NAME exported_symbols_${library}
    COMMAND ${CMAKE_COMMAND}
            "-DLIBRARY=$<TARGET_FILE:${library}>"
            "-DHEADERS=${PROJECT_SOURCE_DIR}/native/include/meander"
            "-DNM=${CMAKE_NM}" "-DREADELF=${CMAKE_READELF}" "-DSANITIZED=${MEANDER_SANITIZE}"
            -P "${PROJECT_SOURCE_DIR}/cmake/check_library.cmake")
  set_tests_properties(exported_symbols_${library} PROPERTIES TIMEOUT 60)
endforeach()

add_test(NAME addon_versions
  COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/scripts/make_addon_zip.py"
          --addon "${PROJECT_SOURCE_DIR}/addon/meander" --version "${PROJECT_VERSION}" --check-only)

set_tests_properties(c99_client abi3_client addon_versions PROPERTIES TIMEOUT 60)
