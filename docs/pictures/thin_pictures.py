# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: makes the pictures of thin shapes in docs/quality.md.

    bash docs/pictures/make.sh thin

Each has four fills: by distances through space from above and from below, then by distances along
the surface. FOLDER is docs/images by default; see strands_pictures.py.
"""

import math
import sys
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs" / "pictures"))

import strands_pictures  # noqa: E402  (the path comes first)
from meander import core  # noqa: E402
from strands_pictures import INK, SURFACE, begin, curve, fill, link, material, meander  # noqa: E402
from strands_pictures import render as render_to  # noqa: E402

SPACING = 0.1
GAP_OF_FOLDS = 0.05 * SPACING  # .1 r


def solid(
    x: np.ndarray, y: np.ndarray, height: np.ndarray, thickness: np.ndarray
) -> bpy.types.Mesh:
    """A sheet over a grid, as thick as it says, closed along its rim."""
    columns, rows = x.shape
    half = 0.5 * thickness
    vertices = [
        np.stack([x, y, height + side * half], axis=-1).reshape(-1, 3) for side in (1.0, -1.0)
    ]
    count = columns * rows
    corner = np.arange(count).reshape(columns, rows)
    quads = np.stack([corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]], axis=-1)
    quads = quads.reshape(-1, 4)
    rim = np.concatenate([corner[:-1, 0], corner[-1, :-1], corner[:0:-1, -1], corner[0, :0:-1]])
    after = np.roll(rim, -1)
    wall = np.stack([after, rim, rim + count, after + count], axis=-1)
    mesh = bpy.data.meshes.new("Thin")
    faces = [*quads.tolist(), *(quads[:, ::-1] + count).tolist(), *wall.tolist()]
    mesh.from_pydata(np.concatenate(vertices).tolist(), [], faces)
    return mesh


def leaf() -> bpy.types.Mesh:
    """Wavy, pointed, .3 r thick."""
    u, v = np.meshgrid(np.linspace(-1, 1, 61), np.linspace(-1, 1, 31), indexing="ij")
    wide = 0.42 * np.cos(0.5 * np.pi * u) ** 0.8 + 0.03
    x, y = u, v * wide
    height = 0.1 * np.sin(4 * x) - 0.25 * y**2
    return solid(x, y, height, np.full_like(x, 0.15 * SPACING))


def blade() -> bpy.types.Mesh:
    """From 1.5 r down to nothing."""
    x, y = np.meshgrid(np.linspace(-1, 1, 41), np.linspace(-0.4, 0.4, 17), indexing="ij")
    return solid(x, y, 0.15 * x**2, np.maximum(0.75 * SPACING * (0.5 + y / 0.8), 0.0005))


def four_fills(make, path: Path) -> None:
    begin()
    for column, axis in enumerate(("EUCLIDEAN", "GEODESIC")):
        for row, turned in enumerate((0.0, math.pi)):
            surface = link("Thin", make())
            surface.data.materials.append(material("Surface", SURFACE))
            surface.rotation_euler = (turned, 0.0, 0.0)
            surface.location = (1.15 * (2 * column - 1), -0.5 * (2 * row - 1), 0.0)
            bpy.context.view_layer.update()
            # Thinner than the sheet, so that the other side's line does not show through.
            fill(surface, SPACING, medial_axis=axis, bevel_share=0.06)
    render(path)


def folded(points: np.ndarray, width: float) -> np.ndarray:
    """A strip of cloth that is three times as long as `width`, folded twice along x."""
    bend = 0.5 * GAP_OF_FOLDS
    around = math.pi * bend
    s = points[:, 0]
    out = points.copy()
    first, second = s - width, s - 2 * width - around
    turn = np.clip(first, 0, around) / bend
    back = np.clip(first - around, 0, width)
    again = np.clip(second, 0, around) / bend
    third = np.clip(second - around, 0, None)
    out[:, 0] = np.minimum(s, width) + bend * np.sin(turn) - back - bend * np.sin(again) + third
    out[:, 2] = bend * (1 - np.cos(turn)) + bend * (1 - np.cos(again))
    return out


def cloth(path: Path) -> None:
    """Filled as it is folded, and shown unfolded."""
    begin()
    width = 1.0
    around = math.pi * 0.5 * GAP_OF_FOLDS
    parts = [width, around, width, around, width]
    cuts, at = [0.0], 0.0
    for part in parts:
        count = 12 if part == width else 8
        cuts += [at + part * (k + 1) / count for k in range(count)]
        at += part
    x, y = np.meshgrid(cuts, np.linspace(0, 0.8, 11), indexing="ij")
    flat = np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3)
    corner = np.arange(x.size).reshape(x.shape)
    quads = np.stack([corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]], axis=-1)
    quads = quads.reshape(-1, 4)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.uint32)
    ink = material("Ink", INK)
    for row, axis in enumerate((core.MedialAxis.EUCLIDEAN, core.MedialAxis.GEODESIC)):
        options = core.default_options("even")
        options.radius, options.medial_axis = 0.5 * SPACING, axis
        flow = core.Flow(core.Surface(folded(flat, width), triangles), options)
        flow.run()
        flow.set_vertices(flat)
        lines = flow.polylines()
        away = np.array([-0.5 * at, 0.12 - 1.05 * row, 0.0])
        mesh = bpy.data.meshes.new("Cloth")
        mesh.from_pydata((flat + away).tolist(), [], quads.tolist())
        mesh.materials.append(material("Surface", SURFACE))
        link("Cloth", mesh)
        strands = np.split(lines.positions + away, lines.offsets[1:-1])
        drawn = curve("Line", strands, list(lines.closed), [ink] * len(strands))
        drawn.data.bevel_depth = 0.17 * SPACING
        drawn.meander.surface = bpy.data.objects["Cloth"]  # so that it is not taken for a seed
    render(path)


def render(path: Path) -> None:
    strands_pictures.SIZE = (620, 280)
    render_to(path, (0.0, -1.6, 10.5), lens=72.0)


if __name__ == "__main__":
    names = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    target = Path(names[0]) if names else ROOT / "docs/images"
    meander.register()
    four_fills(leaf, target / "thin_leaf.png")
    four_fills(blade, target / "thin_blade.png")
    cloth(target / "thin_cloth.png")
    meander.unregister()
