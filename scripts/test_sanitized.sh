#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_sanitized.sh [--all | --fuzz]
#
# Builds the library and the native tests with AddressSanitizer and UndefinedBehaviorSanitizer in a
# folder of their own, build/sanitized, and runs the tests there, among them a minute of fuzzing the C API
# (tests/fuzz), which takes one of two processors. Without NDEBUG: the assertions of
# Eigen are on, which no other build has. By Clang, which takes half of the time and warns of other things
# than GCC, with which everything else is built.
#
# Some checks of undefined behaviour take half of the compiler's time: those of null pointers, object sizes and pointers
# that overflow, whose use AddressSanitizer mostly finds as well, and of missing returns, which compilers warn of,
# virtual tables and function types, which are hardly there. They are made with --all, by hand.
#
# With --fuzz only what the fuzzer needs is built and run: a sixth of it, and what finds most.
set -euo pipefail
except=null,object-size,pointer-overflow,return,vptr,function
targets=(all) tests=.
case "${1:-}" in
  "") ;;
  --all) except="" ;;
  --fuzz) targets=(meander abi fuzz_api) tests=^fuzz_ ;;
  *) echo "usage: $0 [--all | --fuzz]" >&2
     exit 2 ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash scripts/install_dependencies.sh --sanitizers
cmake -S . -B build/sanitized -G Ninja -DPython3_EXECUTABLE=/usr/bin/python3 \
  -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
  -DMEANDER_BUILD_BENCH=OFF -DMEANDER_SANITIZE=address,undefined -DMEANDER_UNITY=ON \
  -DMEANDER_SANITIZE_EXCEPT="$except" \
  -DCMAKE_CXX_FLAGS_RELEASE=-O1
cmake --build build/sanitized --target "${targets[@]}"
ctest --test-dir build/sanitized --output-on-failure --no-tests=error -j 2 -R "$tests"
bash scripts/test_sanitized_python.sh --short
