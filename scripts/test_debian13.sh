#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_debian13.sh [command|add-on|window]...
#
# Makes a Debian 13 in build/debian-13 (2 GB, by debootstrap, from Debian's packages), and runs in
# its Blender 4.3.2 what bpy modules cannot: "blender --command meander", a job in Blender's own
# Python, and the stories in a window; and the tests of the add-on. Needs root, as debootstrap and
# chroot do. scripts/test.sh does not run it: it takes a quarter of an hour. The pictures of the
# window are left in build/debian-13/home/pictures.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[ "$(id -u)" -eq 0 ] || { echo "Run this script as root: it makes a system of its own" >&2; exit 1; }
suites=("$@")
[ ${#suites[@]} -gt 0 ] || suites=(command add-on window)
for suite in "${suites[@]}"; do
  case "$suite" in
    command | add-on | window) ;;
    *) echo "usage: $0 [command|add-on|window]..." >&2; exit 2 ;;
  esac
done

bash scripts/install_dependencies.sh
if ! command -v debootstrap >/dev/null; then
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends debootstrap
fi
bash scripts/build.sh stage addon
zip=$(ls -t build/meander-*.zip | head -n 1)
system=$PWD/build/debian-13
packages=(blender python3-numpy python3-pytest libegl1 libgl1 libgl1-mesa-dri xvfb xauth imagemagick)

in_system() { chroot "$system" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 "$@"; }

# Neither the sources nor /proc may still be there when the folder is deleted.
leave() {
  for place in checkout/build/ui checkout proc; do
    if mountpoint -q "$system/$place"; then umount "$system/$place"; fi
  done
}
trap leave EXIT
leave # what was killed has left

# The mark is made last, so that an interrupted installation starts again.
if [ ! -e "$system/.complete" ]; then
  rm -rf --one-file-system "$system"
  debootstrap --variant=minbase trixie "$system"
  # Blender asks what is mounted.
  ln -sf /proc/mounts "$system/etc/mtab"
fi
if [ "$(cat "$system/.complete" 2>/dev/null)" != "${packages[*]}" ]; then
  in_system apt-get update -qq
  in_system DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    "${packages[@]}"
  echo "${packages[*]}" >"$system/.complete"
fi

mkdir -p build/ui "$system/checkout" "$system/home/pictures"
mount -t proc proc "$system/proc"
mount --bind -o ro "$PWD" "$system/checkout"
mount --bind "$system/home/pictures" "$system/checkout/build/ui"

# run COMMAND... - in the system, with an empty home and an empty profile
run() {
  rm -rf "$system/home/tester"
  mkdir -p "$system/home/tester/profile"
  in_system env HOME=/home/tester BLENDER_USER_RESOURCES=/home/tester/profile \
    PYTHONDONTWRITEBYTECODE=1 LIBGL_ALWAYS_SOFTWARE=1 MEANDER_ZIP="/checkout/$zip" \
    MEANDER_CAMERA="import -window root" timeout --kill-after=10 1200 "$@" </dev/null
}

in_window() { # STORY: in a window of Blender
  run xvfb-run -a -n 300 -s "-screen 0 960x600x24 -nolisten tcp" blender --factory-startup \
    --enable-event-simulate --window-geometry 0 0 960 600 --python-exit-code 1 \
    --python /checkout/tests/ui/tell.py -- "$1"
}

failures=0
for suite in "${suites[@]}"; do
  echo "== $suite"
  case "$suite" in
    command) run python3 -m pytest -q -p no:cacheprovider /checkout/tests/command ;;
    add-on) run blender -b --factory-startup --python-exit-code 1 \
      --python /checkout/tests/blender/run.py ;;
    window)
      for story in run undo live follow look make variations nothing_lost calm_panel seeds first_try export; do
        echo "-- $story"
        in_window "$story" || failures=$((failures + 1))
      done
      ;;
  esac || failures=$((failures + 1))
done
echo "$failures failed"
exit $((failures > 0))
