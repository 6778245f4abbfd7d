#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_threads.sh
#
# Builds the library with ThreadSanitizer in a folder of its own, build/threads, and with it the tests of
# everything that runs in several threads: the pool, runs in the background, and the C API from many
# threads. By Clang, as scripts/test_sanitized.sh.
#
# What is compiled takes most of the time, so no other test is built.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tests=(test_thread_pool test_job test_threads)
bash scripts/install_dependencies.sh --sanitizers
cmake -S . -B build/threads -G Ninja -DPython3_EXECUTABLE=/usr/bin/python3 \
  -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
  -DMEANDER_BUILD_BENCH=OFF -DMEANDER_SANITIZE=thread -DMEANDER_UNITY=ON \
  -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG"
cmake --build build/threads --target "${tests[@]}"
export TSAN_OPTIONS=halt_on_error=1
ctest --test-dir build/threads --output-on-failure --no-tests=error -R "^($(IFS='|'; echo "${tests[*]}"))\."
