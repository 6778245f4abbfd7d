#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_memcheck.sh
#
# Runs a client of the C API and a flow of many strands under valgrind, which sees memory that was never
# written and is read, as no sanitizer here does; and leaks. By hand. apt-get install valgrind comes first.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash scripts/build.sh c99_client test_threads
memcheck() {
  valgrind --quiet --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite "$@"
}
memcheck build/c99_client "$(sed -n 's/^project(Meander VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)"
memcheck build/test_threads --gtest_filter='Threads.ShareAFlowOfManyStrands'
echo "no error was reported"
