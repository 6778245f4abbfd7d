#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# export_pictures.sh
#
# Makes the pictures of docs/export.md, which are what the batch command writes, on white paper:
# export_unrolled.svg, a torus laid flat by its UV map, and export_visible.svg, Suzanne from the
# front. Needs the library, which scripts/build.sh makes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
in_blender=(blender --background --factory-startup --python-exit-code 1)

# draw NAME PYTHON FLAG... - a drawing of what Python adds to a scene
draw() {
  local name=$1 scene=$2
  shift 2
  "${in_blender[@]}" --python-expr \
    "import bpy; $scene; bpy.ops.wm.save_as_mainfile(filepath='$folder/$name.blend')" >/dev/null
  "${in_blender[@]}" --python addon/meander/batch.py -- --input "$folder/$name.blend" --quiet \
    --output "$folder/$name.svg" "$@" >/dev/null
  sed 's#<g fill="none"#<rect width="100%" height="100%" fill="\#ffffff"/>\n&#' \
    "$folder/$name.svg" >"docs/images/$name.svg"
  wc -c "docs/images/$name.svg"
}

draw export_unrolled "bpy.ops.mesh.primitive_torus_add()" \
  --object Torus --spacing 0.15 --light 0.01 --layout uv --size 120 --chord-tolerance 0.003
draw export_visible "bpy.ops.mesh.primitive_monkey_add(); \
  bpy.context.active_object.modifiers.new('Subdivision', 'SUBSURF').levels = 3" \
  --object Suzanne --spacing 0.06 --layout front --visible-only --size 120 --chord-tolerance 0.002
