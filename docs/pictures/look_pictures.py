# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: makes the picture of docs/look.md, one ball with four looks.

    bash docs/pictures/make.sh look

FOLDER is docs/images by default. The picture there has since been reduced to 40 colours.
"""

from __future__ import annotations

import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "docs" / "pictures")]

import meander  # noqa: E402  (the path comes first)
import studio  # noqa: E402
from meander.scene import look  # noqa: E402

SPACING = 0.17
SIZE = (840, 240)
# Of every ball: profile, radius, lift.
LOOKS = (("ROUND", 0.24, 0.0), ("RIBBON", 0.34, 0.6), ("WALL", 0.22, 1.0), ("ROUND", 0.12, 5.0))


def ball(place: float, profile: str, radius: float, lift: float) -> None:
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5, location=(place, 0.0, 0.0))
    surface = bpy.context.active_object
    bpy.ops.object.shade_smooth()
    surface.data.materials.append(studio.material("Ball", (0.62, 0.60, 0.56), 0.7))
    surface.meander.spacing = SPACING
    assert bpy.ops.meander.run() == {"FINISHED"}
    result = bpy.context.active_object
    result.meander.shown_profile = profile
    modifier = look.modifier_of(result)
    look.set_value(modifier, "Radius", radius)
    look.set_value(modifier, "Lift", lift)


def main() -> None:
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    folder = Path(arguments[0]) if arguments else ROOT / "docs" / "images"
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    for number, given in enumerate(LOOKS):
        ball(2.6 * (number - 1.5), *given)
    studio.add_lights(1.6)
    studio.add_floor(-1.1, (0.5, 0.52, 0.55))
    studio.add_camera((0.0, -19.0, 6.0), (0.0, 0.0, -0.1), 65.0)
    studio.take_picture(str((folder / "look.png").resolve()), SIZE, 160)


meander.register()
try:
    main()
finally:
    meander.unregister()
