# SPDX-License-Identifier: GPL-3.0-or-later
#
# fuzz_api (tests/fuzz): the C API under libFuzzer, in builds with the sanitizers of Clang. It is linked with the same
# objects as the sanitized tests, so the library is compiled once for both.

file(GLOB fuzz_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/fuzz/*.cpp")
add_executable(fuzz_api ${fuzz_sources}
  "${PROJECT_SOURCE_DIR}/tests/sweep/curve_checker.cpp"
  "${PROJECT_SOURCE_DIR}/tests/sweep/watched_run.cpp")
target_include_directories(fuzz_api PRIVATE "${PROJECT_SOURCE_DIR}/tests/fuzz" "${PROJECT_SOURCE_DIR}/tests/sweep")
target_link_libraries(fuzz_api PRIVATE meander_core)
target_link_options(fuzz_api PRIVATE -fsanitize=fuzzer)
set_target_properties(fuzz_api PROPERTIES UNITY_BUILD ${MEANDER_UNITY} UNITY_BUILD_BATCH_SIZE 0)

# The corpus once, with its leaks; a minute of new inputs, which are kept in the build folder; and the test of
# tests/fuzz/shrink.py. The minute begins first, since it is longer than any other test.
set(fuzz_corpus "${PROJECT_SOURCE_DIR}/tests/fuzz/corpus")
set(fuzz_new "${PROJECT_BINARY_DIR}/fuzz_new")
file(MAKE_DIRECTORY "${fuzz_new}")
add_test(NAME fuzz_corpus COMMAND fuzz_api -runs=0 -timeout=60 "-artifact_prefix=${fuzz_new}/" "${fuzz_corpus}")
add_test(NAME fuzz_a_minute
  COMMAND fuzz_api -max_len=256 -entropic=0 -use_counters=0 -timeout=60 -max_total_time=60 -print_final_stats=1
          "-artifact_prefix=${fuzz_new}/" "${fuzz_new}" "${fuzz_corpus}")
add_test(NAME fuzz_shrink
  COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/tests/fuzz/test_shrink.py" $<TARGET_FILE:fuzz_api>
          "${CMAKE_CXX_COMPILER}")
set_tests_properties(fuzz_corpus fuzz_a_minute fuzz_shrink PROPERTIES TIMEOUT 300)
set_tests_properties(fuzz_a_minute PROPERTIES COST 1000)
