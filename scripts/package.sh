#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# package.sh [--test | --test-all] [PLATFORM]...
#
# From a bare Debian 12: builds the library for the given platforms, or for all six, and makes the
# zips of a release in build/release: one for each platform, as extension repositories ask, one with
# all that were built, and the wheels of the Python package. The same sources give the same bytes, in
# whatever folder they lie.
#
#   linux-x64 linux-arm64 windows-x64 windows-arm64 macos-x64 macos-arm64
#
# --test also runs tests/platforms: what is inside of every library, and by Wine and qemu, where the
# platforms are among the given ones, a few native tests and whether curves have the same bytes.
# --test-all builds and runs all native tests for them, more curves, and builds libraries once more in
# another folder, to compare their bytes: an hour or so.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

platforms=() test=""
for argument in "$@"; do
  case "$argument" in
    --test) test=short ;;
    --test-all) test=all ;;
    linux-x64 | linux-arm64 | windows-x64 | windows-arm64 | macos-x64 | macos-arm64)
      platforms+=("$argument") ;;
    *) echo "usage: $0 [--test | --test-all] [PLATFORM]...; a platform is the name of a file in cmake/toolchains" >&2
       exit 2 ;;
  esac
done
if [ ${#platforms[@]} -eq 0 ]; then
  platforms=(linux-x64 linux-arm64 windows-x64 windows-arm64 macos-x64 macos-arm64)
fi

bash scripts/install_dependencies.sh --package ${test:+--emulators}

# The compiler of releases writes no times into files, but a zip must not either.
export SOURCE_DATE_EPOCH=315532800 # 1980, the earliest that a zip can hold
mkdir -p build/package build/release

library_of() { # PLATFORM: the file
  find build/package/"$1"/lib -maxdepth 1 -name '*meander-*' \
    \( -name '*.so' -o -name '*.dylib' -o -name '*.dll' \)
}

# library PLATFORM - builds it, and prints a line about it
library() {
  local begin=$SECONDS log=build/package/$1.log file
  if ! { cmake --preset "$1" && cmake --build --preset "$1"; } >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "$0: the library for $1 was not built; the whole log is $log" >&2
    return 1
  fi
  file=$(library_of "$1")
  printf '%-14s %6d KiB  %4d s  %s\n' \
    "$1" $(($(stat -c %s "$file") / 1024)) $((SECONDS - begin)) "$file"
}
# Two at a time: when it first links for a system, Zig builds the runtime, on one core.
running=0
for platform in "${platforms[@]}"; do
  if [ $running -eq 2 ]; then wait -n; else running=$((running + 1)); fi
  library "$platform" &
done
for ((; running > 0; running--)); do wait -n; done
native=()
for platform in "${platforms[@]}"; do native+=("$platform=$(library_of "$platform")"); done

version=$(sed -n 's/^project(Meander VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
/usr/bin/python3 scripts/generate_abi.py --header native/include/meander/meander.h \
  --output addon/meander/binding/abi.py

# pack NAME PLATFORM=LIBRARY... - a zip of the add-on with these libraries
pack() {
  local name=$1 flags=() library
  shift
  for library in "$@"; do flags+=(--native "$library"); done
  /usr/bin/python3 scripts/make_addon_zip.py --addon addon/meander --version "$version" \
    "${flags[@]}" --licence LICENSE --licence THIRD_PARTY_NOTICES.md --pages docs \
    --wheels build/wheels \
    --output "build/release/$name.zip"
}
for library in "${native[@]}"; do
  platform=${library%%=*}
  pack "meander-$version-${platform//-/_}" "$library"
done
pack "meander-$version" "${native[@]}"

# wheel PLATFORM=LIBRARY - the Python package for it; the tag says what the library needs
wheel() {
  local tag
  case "${1%%=*}" in
    linux-x64) tag=manylinux_2_28_x86_64 ;;
    linux-arm64) tag=manylinux_2_28_aarch64 ;;
    windows-x64) tag=win_amd64 ;;
    windows-arm64) tag=win_arm64 ;;
    macos-x64) tag=macosx_11_0_x86_64 ;;
    macos-arm64) tag=macosx_11_0_arm64 ;;
  esac
  /usr/bin/python3 scripts/build_wheel.py --library "${1#*=}" --platform "$tag" --folder build/release
}
for library in "${native[@]}"; do wheel "$library"; done

[ -n "$test" ] || exit 0

# native_tests PLATFORM - builds the native tests for another system than this one
native_tests() {
  local targets=(test_elementary test_thread_pool test_crossings test_job) source
  if [ "$test" = all ]; then
    targets=()
    for source in tests/native/test_*.cpp; do targets+=("$(basename "$source" .cpp)"); done
  fi
  cmake --preset "$1" -DMEANDER_BUILD_TESTS=ON && cmake --build --preset "$1" --target "${targets[@]}"
}
for platform in "${platforms[@]}"; do
  case "$platform" in windows-x64 | linux-arm64) ;; *) continue ;; esac
  log=build/package/$platform-tests.log
  if ! native_tests "$platform" >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "$0: the native tests for $platform were not built; the whole log is $log" >&2
    exit 1
  fi
done
if [ "$test" = all ]; then export MEANDER_LONG=1; fi
MEANDER_PLATFORMS="${platforms[*]}" /usr/bin/python3 -m pytest -q -p no:cacheprovider tests/platforms
