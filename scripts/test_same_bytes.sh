#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_same_bytes.sh
#
# Builds the library twice more, in build/bytes, with another idea of what the processor has: `wide`, vectors of four
# doubles and all that the optimizer does, and `plain`, no vectors of the compiler's choice and little optimized. Fails
# where a fingerprint (scripts/fingerprints.py) is not that of the library in addon/meander, and names it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

declare -A flags=([plain]="-O1 -fno-tree-vectorize -fno-tree-slp-vectorize")
# Nothing may be fused: docs/platforms.md.
if grep -qw avx2 /proc/cpuinfo; then flags[wide]="-O3 -mavx2 -mno-fma"; fi

mkdir -p build/bytes
/usr/bin/python3 scripts/fingerprints.py >build/bytes/expected.txt
passed=0 failed=0
for name in "${!flags[@]}"; do
  folder=build/bytes/$name
  cmake -S . -B "$folder" -G Ninja -DPython3_EXECUTABLE=/usr/bin/python3 -DMEANDER_UNITY=ON -DMEANDER_STAGE=OFF \
    -DMEANDER_BUILD_TESTS=OFF -DMEANDER_BUILD_BENCH=OFF -DCMAKE_CXX_FLAGS_RELEASE="-DNDEBUG ${flags[$name]}"
  cmake --build "$folder" --target meander
  rm -rf "$folder/package"
  cp -r addon/meander "$folder/package"
  for library in "$folder"/package/native/linux-*/; do cp "$folder"/lib/libmeander-*.so "$library"; done
  echo "$name: ${flags[$name]}"
  if /usr/bin/python3 scripts/fingerprints.py --package "$folder/package" --compare build/bytes/expected.txt; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
  fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
