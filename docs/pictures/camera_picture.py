# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: draws docs/images/gallery/scene_drawing.svg, a still life from a camera, and
scene_tone.svg, the same as dark as a sun makes it.

    bash docs/pictures/make.sh camera

The drawing is as the add-on writes it, on white paper.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "docs" / "pictures")]

import gallery_scenes  # noqa: E402
import meander  # noqa: E402
import studio  # noqa: E402

FOLDER = ROOT / "docs" / "images" / "gallery"
PAGE = {"paper": "CUSTOM", "width": 150.0, "height": 120.0, "margin": 2.0}


def directed(source: str, **settings: str) -> None:
    """Lays the strands of what has just been added in rows."""
    chosen = gallery_scenes.active().meander
    chosen.alignment_source, chosen.alignment_weight = source, 3.0
    for name, value in settings.items():
        setattr(chosen, name, value)


def still_life() -> None:
    add = bpy.ops.mesh
    head = gallery_scenes.suzanne()
    head.location = (0.0, 0.1, 1.53)
    head.rotation_euler.z = 0.35
    add.primitive_cylinder_add(vertices=64, radius=0.95, depth=0.8, location=(0.0, 0.1, 0.4))
    directed("CURVATURE", alignment_curvature="MAX")
    add.primitive_torus_add(
        major_segments=72, minor_segments=24, major_radius=0.62, minor_radius=0.24,
        location=(-1.75, -0.35, 0.66), rotation=(math.radians(62.0), 0.0, math.radians(-24.0)),
    )
    directed("CURVATURE")
    add.primitive_uv_sphere_add(
        segments=48, ring_count=24, radius=0.62, location=(1.5, -0.75, 0.62)
    )
    gallery_scenes.active()
    add.primitive_cube_add(size=1.3, location=(1.85, 1.3, 0.65), rotation=(0.0, 0.0, 0.5))
    add.primitive_circle_add(vertices=96, radius=3.1, fill_type="NGON")
    directed("AXIS", alignment_axis="X")
    studio.add_camera((1.1, -9.5, 4.2), (0.0, 0.0, 0.72), 56.0)
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y = 560, 448


def sunlight() -> None:
    """From the upper left, with some light from everywhere."""
    sun = bpy.data.lights.new("Sun", "SUN")
    sun.energy = 3.0
    thing = bpy.data.objects.new("Sun", sun)
    thing.rotation_euler = (math.radians(48.0), 0.0, math.radians(-42.0))
    bpy.context.scene.collection.objects.link(thing)
    world = bpy.data.worlds.new("World")
    world.color = (0.12, 0.12, 0.12)
    bpy.context.scene.world = world
    bpy.context.view_layer.update()


def draw(name: str, **how: object) -> None:
    """The drawing on white paper."""
    path = FOLDER / name
    bpy.ops.meander.draw_camera(filepath=str(path), **PAGE, **how)
    text = path.read_text(encoding="utf-8")
    paper = '<rect width="100%" height="100%" fill="#ffffff"/>\n<g fill="none"'
    path.write_text(text.replace('<g fill="none"', paper, 1), encoding="utf-8")
    print(f"{path.name}: {path.stat().st_size} bytes", flush=True)


meander.register()
try:
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    still_life()
    if "tone" not in sys.argv:
        draw("scene_drawing.svg", spacing=1.3, line_width=0.25)
    sunlight()
    draw("scene_tone.svg", use_tone=True, line_width=0.5)
finally:
    meander.unregister()
