#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# build.sh [TARGET]...
#
# Builds into build/ the given targets, or else everything: the library, the native tests, the
# benchmark, and the add-on's zip build/meander-VERSION.zip. The packages of install_dependencies.sh
# must be installed. Options of the build are remembered in build/: docs/building.md. Where nothing is built yet, each
# folder of the sources is compiled as one file, and native tests several at a time: the same bytes, sooner. Where
# MEANDER_UNITY or MEANDER_JOINED_TESTS is set to ON or OFF, it is that option.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(all addon)

mkdir -p build
[ -f build/CMakeCache.txt ] || : "${MEANDER_UNITY:=ON}" "${MEANDER_JOINED_TESTS:=ON}"
# Debian's Python by its full path: another Python may come first on the PATH.
if ! cmake -S . -B build -G Ninja -DPython3_EXECUTABLE=/usr/bin/python3 \
  ${MEANDER_UNITY:+"-DMEANDER_UNITY=$MEANDER_UNITY"} \
  ${MEANDER_JOINED_TESTS:+"-DMEANDER_JOINED_TESTS=$MEANDER_JOINED_TESTS"} >build/configure.log 2>&1
then
  cat build/configure.log >&2
  exit 1
fi
cmake --build build --target "${targets[@]}"
