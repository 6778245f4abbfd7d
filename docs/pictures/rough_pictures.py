# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: makes the pictures of rough surfaces in docs/rough_surfaces.md.

    bash docs/pictures/make.sh rough

Each shows the same surface twice: with a spacing that follows every bump (roughness 1), and with
one that is measured on the surface as it is at the scale of the spacing. FOLDER is docs/images by
default; see strands_pictures.py.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs" / "pictures"))

import strands_pictures  # noqa: E402  (the path comes first)
from strands_pictures import begin, fill, link, meander, surface_of  # noqa: E402
from strands_pictures import render as render_to  # noqa: E402
from thin_pictures import solid  # noqa: E402

FOLLOWED = (1.0, 0.0)


def displaced_grid() -> bpy.types.Object:
    """Blender's own: a grid, and a displacement by its noise."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=60, y_subdivisions=60, size=2)
    grid = surface_of(bpy.context.object)
    displace = grid.modifiers.new("Displace", "DISPLACE")
    displace.texture = bpy.data.textures.new("Clouds", "CLOUDS")
    displace.strength = 1
    return grid


def waves(x: np.ndarray, y: np.ndarray, length: float, seed: int) -> np.ndarray:
    """Noise with hills about as wide as `length`, and half, and a quarter as wide ones on them."""
    numbers = np.random.default_rng(seed)
    height = np.zeros_like(x)
    for octave in range(3):
        for _ in range(24):
            u, v = numbers.normal(size=2) * 2.0 * 2**octave / length
            height += np.cos(u * x + v * y + numbers.uniform(0.0, 7.0)) / 2**octave
    return height / np.sqrt(12.0)


def relief() -> bpy.types.Object:
    """A thin closed sheet with relief on both sides, as of a scan of something flat."""
    x, y = np.meshgrid(np.linspace(-1, 1, 141), np.linspace(-1, 1, 141), indexing="ij")
    thickness = 0.03 * (1.3 + np.tanh(waves(x, y, 0.3, 3)))
    return surface_of(link("Relief", solid(x, y, 0.025 * waves(x, y, 0.12, 1), thickness)))


def two_fills(make, spacing: float, path: Path) -> None:
    begin()
    for column, roughness in enumerate(FOLLOWED):
        surface = make()
        surface.location = (1.08 * (2 * column - 1), 0.0, 0.0)
        bpy.context.view_layer.update()
        result = fill(surface, spacing, roughness=roughness, bevel_share=0.1)
        figures = result.meander.figures
        print(
            f"{path.stem}, roughness {roughness:g}: {figures.iterations} iterations, "
            f"{figures.seconds:.1f} s, {figures.evenness:.3f} even"
        )
    strands_pictures.SIZE = (1240, 640)
    render_to(path, (0.0, -1.2, 10.0), lens=78.0)


if __name__ == "__main__":
    names = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    target = Path(names[0]) if names else ROOT / "docs/images"
    meander.register()
    two_fills(displaced_grid, 0.12, target / "rough_grid.png")
    two_fills(relief, 0.07, target / "rough_relief.png")
    meander.unregister()
