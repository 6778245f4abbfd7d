# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: makes the pictures of docs/surfaces.md.

    bash docs/pictures/make.sh surface

FOLDER is docs/images by default; see strands_pictures.py.
"""

import math
import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs" / "pictures"))

import strands_pictures  # noqa: E402  (the path comes first)
from strands_pictures import begin, fill, meander, render, surface_of  # noqa: E402


def region(folder: Path) -> None:
    """A band of a sphere, between two wavy lines that are not edges of the mesh."""
    begin()
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24)
    surface = surface_of(bpy.context.active_object)
    group = surface.vertex_groups.new(name="Band")
    for vertex in surface.data.vertices:
        x, y, z = vertex.co
        wave = 0.16 * math.sin(4.0 * math.atan2(y, x))
        group.add([vertex.index], min(1.0, max(0.0, 1.0 - abs(z - wave))), "REPLACE")
    fill(surface, 0.07, mask_source="GROUP", mask_group="Band", mask_threshold=0.55)
    render(folder / "surface_region.png", (0.0, -5.8, 3.2))


def borders(folder: Path) -> None:
    """Three plates with a round hole: a quarter of a spacing, a whole one, and an outline."""
    begin()
    choices = (
        {"border_distance": 0.25},
        {"border_distance": 1.0},
        {"border_distance": 0.5, "use_outline": True},
    )
    for index, settings in enumerate(choices):
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=120, y_subdivisions=120, size=2.0)
        surface = surface_of(bpy.context.active_object)
        group = surface.vertex_groups.new(name="Plate")
        for vertex in surface.data.vertices:
            away = math.hypot(vertex.co.x - 0.2, vertex.co.y - 0.1)
            group.add([vertex.index], min(1.0, away), "REPLACE")
        surface.location.x = 2.3 * (index - 1)
        mask = {"mask_source": "GROUP", "mask_group": "Plate", "mask_threshold": 0.4}
        fill(surface, 0.13, **mask, **settings)
        cut = surface.modifiers.new("Hole", "MASK")  # the surface is shown without the hole
        cut.vertex_group, cut.threshold = "Plate", 0.4
    strands_pictures.SIZE = (600, 200)
    render(folder / "surface_borders.png", (0.0, -0.01, 17.0))


if __name__ == "__main__":
    names = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    target = Path(names[0]) if names else ROOT / "docs/images"
    meander.register()
    region(target)
    borders(target)
    meander.unregister()
