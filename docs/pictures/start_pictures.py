# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: makes the pictures of full starts in docs/terms.md.

    bash docs/pictures/make.sh start

FOLDER is docs/images by default; see strands_pictures.py.
"""

import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs" / "pictures"))

import strands_pictures  # noqa: E402  (the path comes first)
import studio  # noqa: E402
from strands_pictures import begin, fill, link, meander, surface_of  # noqa: E402
from strands_pictures import render as render_to  # noqa: E402

APART = 1.35


def head(place: float) -> bpy.types.Object:
    bpy.ops.mesh.primitive_monkey_add(location=(place, 0.0, 0.0))
    modifier = bpy.context.active_object.modifiers.new("Smooth", "SUBSURF")
    modifier.levels = modifier.render_levels = 2
    return bpy.context.active_object


def torus(place: float) -> bpy.types.Object:
    bpy.ops.mesh.primitive_torus_add(
        major_radius=0.9, minor_radius=0.38, major_segments=64, minor_segments=28
    )
    bpy.context.active_object.location = (place, 0.0, 0.0)
    return bpy.context.active_object


def pair(make, spacing: float, path: Path, eye: tuple, **settings) -> None:
    """The same surface grown, on the left, and with a full start."""
    begin()
    for place, start in ((-APART, "GROW"), (APART, "FULL")):
        surface = surface_of(make(place))
        bpy.context.view_layer.update()
        fill(surface, spacing, start=start, **settings)
    strands_pictures.SIZE = (720, 360)
    render_to(path, eye, lens=72.0)


def word(text: str, height: float, edge: float) -> bpy.types.Object:
    """A word as a mesh with edges no longer than this: directions have a value at each vertex."""
    data = bpy.data.curves.new("Word", "FONT")
    data.body, data.align_x, data.resolution_u = text, "CENTER", 8
    text_object = link("Text", data)
    mesh = bpy.data.meshes.new_from_object(text_object)
    bpy.data.objects.remove(text_object)
    studio.divide(mesh, edge)
    thing = link("Word", mesh)
    thing.location.y = height
    return thing


def words(path: Path) -> None:
    """A word grown, and below it along its outline from a full start."""
    begin()
    for height, settings in (
        (0.15, {"start": "GROW"}),
        (-0.75, {"alignment_source": "BOUNDARY", "alignment_weight": 2.0}),
    ):
        surface = surface_of(word("Meander", height, 0.03))
        bpy.context.view_layer.update()
        fill(surface, 0.033, **settings)
    strands_pictures.SIZE = (720, 360)
    render_to(path, (0.0, -0.9, 8.0), lens=78.0)


if __name__ == "__main__":
    names = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    target = Path(names[0]) if names else ROOT / "docs/images"
    meander.register()
    pair(head, 0.07, target / "start_flowing.png", (0.0, -10.5, 1.4))
    pair(
        torus, 0.09, target / "start_rows.png", (0.0, -7.2, 8.9),
        alignment_source="CURVATURE", alignment_weight=2.0,
    )
    words(target / "start_word.png")
    meander.unregister()
