#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# demo.sh
#
# Installs what is missing, builds, installs the add-on into a throw-away profile of Blender, and
# fills Suzanne from a seed curve with a painted vertex group. Leaves in build/demo:
#
#     suzanne.blend   the scene with the curve in it
#     suzanne.png     a picture of it
#     suzanne.json    the report of the run
#
# MEANDER_DEMO_SAMPLES: how often each pixel is sampled at most, instead of what the published picture has. Rendering is
# nearly all that the demo takes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
demo=$PWD/build/demo

bash scripts/install_dependencies.sh
bash scripts/build.sh stage addon

rm -rf "$demo"
mkdir -p "$demo/profile/config" "$demo/profile/scripts" "$demo/profile/datafiles"
export BLENDER_USER_CONFIG=$demo/profile/config
export BLENDER_USER_SCRIPTS=$demo/profile/scripts
export BLENDER_USER_DATAFILES=$demo/profile/datafiles

# blender_script NAME SCRIPT ARGUMENT... - quiet, unless it fails
blender_script() {
  local name=$1 script=$2 log=$demo/$1.log
  shift 2
  echo "$name ..."
  if ! blender --background --python-exit-code 1 --python "$script" -- "$@" >"$log" 2>&1; then
    cat "$log" >&2
    exit 1
  fi
}

zip=$(ls -t build/meander-*.zip | head -n 1)
blender_script "Installing the add-on" scripts/install_addon.py "$zip"
blender_script "Setting the scene" docs/pictures/demo_scene.py "$demo/scene.blend"
# From the profile, as a user runs it: nothing of the checkout's add-on is used.
blender_script "Filling Suzanne" "$BLENDER_USER_SCRIPTS/addons/meander/batch.py" \
  --input "$demo/scene.blend" --object Suzanne --seed-object Seed --density-group Fine \
  --spacing 0.055 --output "$demo/suzanne.blend" --report "$demo/suzanne.json"
grep '^meander:' "$demo/Filling Suzanne.log" | tail -n 2
blender_script "Rendering" docs/pictures/demo_render.py "$demo/suzanne.blend" "$demo/suzanne.png" \
  ${MEANDER_DEMO_SAMPLES:+"$MEANDER_DEMO_SAMPLES"}

rm -f "$demo/scene.blend" "$demo"/*.blend1
printf '\n'
ls -1 "$demo/suzanne.blend" "$demo/suzanne.png" "$demo/suzanne.json"
