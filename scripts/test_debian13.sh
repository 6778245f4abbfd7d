#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_debian13.sh [command|add-on]...
#
# Makes a Debian 13 in build/debian-13 (3 GB, by debootstrap, from Debian's packages), and runs in
# its Blender 4.3.2 what bpy modules cannot: "blender --command meander" and a job in Blender's own
# Python; and the tests of the add-on. Needs root, as debootstrap and chroot do. scripts/test.sh does
# not run it: it takes some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[ "$(id -u)" -eq 0 ] || { echo "Run this script as root: it makes a system of its own" >&2; exit 1; }
suites=("$@")
[ ${#suites[@]} -gt 0 ] || suites=(command add-on)
for suite in "${suites[@]}"; do
  case "$suite" in
    command | add-on) ;;
    *) echo "usage: $0 [command|add-on]..." >&2; exit 2 ;;
  esac
done

bash scripts/install_dependencies.sh
command -v debootstrap >/dev/null || apt-get install -y -qq --no-install-recommends debootstrap
bash scripts/build.sh stage addon
zip=$(ls -t build/meander-*.zip | head -n 1)
system=$PWD/build/debian-13
packages=(blender python3-numpy python3-pytest libegl1 libgl1 libgl1-mesa-dri)

in_system() { chroot "$system" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 "$@"; }

# Neither the sources nor /proc may still be there when the folder is deleted.
leave() {
  for place in checkout proc; do
    if mountpoint -q "$system/$place"; then umount "$system/$place"; fi
  done
}
trap leave EXIT
leave # what was killed has left

if [ ! -e "$system/.complete" ]; then
  rm -rf --one-file-system "$system"
  debootstrap --variant=minbase trixie "$system"
  in_system apt-get update -qq
  in_system DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    "${packages[@]}"
  # Blender asks what is mounted.
  ln -sf /proc/mounts "$system/etc/mtab"
  touch "$system/.complete"
fi

mkdir -p "$system/checkout"
mount -t proc proc "$system/proc"
mount --bind -o ro "$PWD" "$system/checkout"

failures=0
for suite in "${suites[@]}"; do
  echo "== $suite"
  rm -rf "$system/home/tester"
  mkdir -p "$system/home/tester/profile"
  run=(env HOME=/home/tester BLENDER_USER_RESOURCES=/home/tester/profile PYTHONDONTWRITEBYTECODE=1
    LIBGL_ALWAYS_SOFTWARE=1 MEANDER_ZIP="/checkout/$zip")
  case "$suite" in
    command) run+=(python3 -m pytest -q -p no:cacheprovider /checkout/tests/command) ;;
    add-on) run+=(blender -b --factory-startup --python-exit-code 1
      --python /checkout/tests/blender/run.py) ;;
  esac
  in_system "${run[@]}" || failures=$((failures + 1))
done
exit $((failures > 0))
