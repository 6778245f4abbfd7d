#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# make.sh [NAME...]
#
# Makes the pictures of the pages in docs/images anew: of each name below, or all of them. Needs the
# library, which scripts/build.sh makes, and Debian's Blender; "quality" needs python3-matplotlib, and
# "panel" xvfb, in whose window stories of tests/ui are told. "gallery" takes an hour.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
names=(terms quality export density look strands surface start rough thin motion bake camera panel gallery)

in_blender() {
  blender --background --factory-startup --python-exit-code 1 --python "docs/pictures/$1.py" -- "${@:2}"
}

[ $# -gt 0 ] || set -- "${names[@]}"
for name; do
  case "$name" in
    terms) /usr/bin/python3 docs/pictures/draw_terms.py docs/images ;;
    quality) /usr/bin/python3 docs/pictures/quality_plots.py docs/images ;;
    export) bash docs/pictures/export_pictures.sh ;;
    density | look | strands | surface | start | rough | thin) in_blender "${name}_pictures" docs/images ;;
    motion) in_blender motion_picture docs/images/motion.png ;;
    bake) in_blender bake_picture docs/images/motion_bake.png ;;
    panel)
      LIBGL_ALWAYS_SOFTWARE=1 MEANDER_UI_SCALE=1 xvfb-run -a -s "-screen 0 1280x800x24 -nolisten tcp" \
        blender --factory-startup --enable-event-simulate --window-geometry 0 0 1280 800 \
        --python-exit-code 1 --python tests/ui/tell.py -- calm_panel nothing_lost look
      in_blender panel_picture ;;
    camera) in_blender camera_picture ;;
    gallery) in_blender gallery docs/images/gallery ;;
    *) echo "there are no pictures '$name'; choose from: ${names[*]}" >&2
       exit 2 ;;
  esac
done
