# SPDX-License-Identifier: GPL-3.0-or-later
#
# The sweep (tests/sweep): a program that runs a flow through the C API and checks every curve, and the
# tests of its checks. Nothing of native/src is linked, so that the checks share nothing with the flow.

add_library(curve_checks OBJECT
  "${PROJECT_SOURCE_DIR}/tests/sweep/curve_checker.cpp"
  "${PROJECT_SOURCE_DIR}/tests/sweep/watched_run.cpp")
target_include_directories(curve_checks PUBLIC "${PROJECT_SOURCE_DIR}/tests/sweep")
target_link_libraries(curve_checks PUBLIC meander PRIVATE meander_compile_options)

add_executable(sweep_run "${PROJECT_SOURCE_DIR}/tests/sweep/sweep_run.cpp")
target_link_libraries(sweep_run PRIVATE curve_checks meander_compile_options)
add_executable(sweep_check "${PROJECT_SOURCE_DIR}/tests/sweep/sweep_check.cpp")
target_link_libraries(sweep_check PRIVATE curve_checks meander_compile_options)

add_executable(test_curve_checker
  "${PROJECT_SOURCE_DIR}/tests/sweep/test_curve_checker.cpp"
  "${PROJECT_SOURCE_DIR}/tests/native/processor_time.cpp")
target_link_libraries(test_curve_checker PRIVATE curve_checks meander_compile_options GTest::gtest GTest::gtest_main)
gtest_discover_tests(test_curve_checker
  TEST_PREFIX "test_curve_checker."
  DISCOVERY_TIMEOUT 60
  PROPERTIES TIMEOUT 300)
