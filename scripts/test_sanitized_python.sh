#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_sanitized_python.sh [--short]
#
# Runs the tests that call the library by ctypes with a library that has AddressSanitizer and
# UndefinedBehaviorSanitizer, in Python and in Debian's Blender: what they see here is an array of numpy's or
# ctypes' that is too short for what the library writes, which no native test has. Leaks are not looked for, since
# Python and Blender leave much of their memory to the system. The library is that of scripts/test_sanitized.sh.
# By hand, in eight minutes of a processor; with --short, which scripts/test_sanitized.sh runs, in some seconds.
#
# Left out: what runs under a limit of memory, for sanitizers reserve terabytes of addresses; what measures memory;
# and what compares messages to the last word, among which one says that MEANDER_LIBRARY names the library.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/sanitized
if [ "${1:-}" != --short ]; then
  bash scripts/install_dependencies.sh --sanitizers
  cmake -S . -B "$build" -G Ninja -DPython3_EXECUTABLE=/usr/bin/python3 \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DMEANDER_BUILD_BENCH=OFF -DMEANDER_SANITIZE=address,undefined -DMEANDER_UNITY=ON \
    -DCMAKE_CXX_FLAGS_RELEASE=-O1
  cmake --build "$build" --target meander abi
fi
library=$(ls "$PWD/$build"/lib/libmeander-*.so)

# The sanitizer has to be there before anything else, and the C++ runtime before exceptions are looked for.
# PYTHONMALLOC: small objects of Python's, such as arrays of ctypes', as blocks of memory with guards as well.
sanitized=(env LD_PRELOAD="$(clang -print-file-name=libclang_rt.asan-x86_64.so) $(clang++ -print-file-name=libstdc++.so.6)"
  ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 PYTHONMALLOC=malloc PYTHONDONTWRITEBYTECODE=1
  MEANDER_LIBRARY="$library")

# That all of this sees anything: an array that is 8 bytes too short has to end the program. Much more might lie beyond
# all memory of the heap, where the program ends without that being said.
report=$("${sanitized[@]}" /usr/bin/python3 - "$library" 2>&1 <<'PYTHON' || true
import ctypes
import sys

sys.path.insert(0, "addon")
from meander.binding.abi import FlowOptionsRecord

size = ctypes.sizeof(FlowOptionsRecord)
ctypes.CDLL(sys.argv[1]).meander_flow_options_init(ctypes.create_string_buffer(size - 8), size, 0)
PYTHON
)
if ! grep -q 'ERROR: AddressSanitizer: heap-buffer-overflow' <<<"$report"; then
  printf 'an array that is too short was not noticed\n%s\n' "$report"
  exit 1
fi
echo "an array that is too short was noticed, as planned"

in_python() { "${sanitized[@]}" /usr/bin/python3 -m pytest -q -p no:cacheprovider "$@"; }
if [ "${1:-}" = --short ]; then
  in_python tests/core/test_lifetime.py
  exit
fi
in_python tests/core \
  --ignore tests/core/test_memory_limit.py --ignore tests/core/test_whole_files.py \
  --ignore tests/core/test_batch.py --ignore tests/core/test_batch_limits.py \
  --ignore tests/core/test_batch_outputs.py --ignore tests/core/test_batch_toolpath.py \
  -k 'not (test_strands and batch) and not test_the_memory_that_a_run_takes'

profile=$PWD/$build/profile
mkdir -p "$profile/home" "$profile/config" "$profile/scripts" "$profile/datafiles"
PATH=/usr/bin:/bin HOME=$profile/home BLENDER_USER_CONFIG=$profile/config BLENDER_USER_SCRIPTS=$profile/scripts \
  BLENDER_USER_DATAFILES=$profile/datafiles \
  "${sanitized[@]}" blender -b --factory-startup --python-exit-code 1 --python tests/blender/run.py -- \
  tests/blender/test_fill.py tests/blender/test_gaps.py tests/blender/test_cut.py tests/blender/test_motion.py \
  tests/blender/test_batch_scene.py
