#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_debian11.sh
#
# Makes a Debian 11 in build/debian-11 (by debootstrap, from Debian's packages), the oldest that
# mirrors have, and runs the library of a release for Linux there: the curves have to have the same
# bytes as from the library that this system's compiler has built. Needs root, as debootstrap and
# chroot do. scripts/test.sh does not run it: it takes some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[ "$(id -u)" -eq 0 ] || { echo "Run this script as root: it makes a system of its own" >&2; exit 1; }

bash scripts/package.sh linux-x64
command -v debootstrap >/dev/null || apt-get install -y -qq --no-install-recommends debootstrap
bash scripts/build.sh stage

system=$PWD/build/debian-11
if [ ! -e "$system/.complete" ]; then
  rm -rf --one-file-system "$system"
  debootstrap --variant=minbase bullseye "$system"
  touch "$system/.complete"
fi
rm -rf "$system/meander"
mkdir "$system/meander"
cp build/package/linux-x64/lib/libmeander-*.so "$system/meander"

export ZIG_GLOBAL_CACHE_DIR=$PWD/build/package-tools/cache ZIG_LOCAL_CACHE_DIR=$PWD/build/package-tools/cache
build/package-tools/zig cc -target x86_64-linux-gnu.2.28 -std=c99 -O2 -ffp-contract=off \
  -Inative/include tests/platforms/curve_bytes.c "$system"/meander/libmeander-*.so \
  -Wl,-rpath,/meander -o "$system/meander/curve_bytes"
here=$(ls -t build/lib/libmeander-*.so | head -n 1)
cc -std=c99 -O1 -Inative/include tests/platforms/curve_bytes.c "$here" \
  -Wl,-rpath,"$PWD/build/lib" -o build/curve_bytes

chroot "$system" /usr/bin/ldd --version | head -n 1
chroot "$system" env -i /meander/curve_bytes >build/curves-debian-11.txt
build/curve_bytes >build/curves-here.txt
diff build/curves-here.txt build/curves-debian-11.txt
echo "$(wc -l <build/curves-here.txt) curves with the same bytes"
