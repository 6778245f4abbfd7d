# SPDX-License-Identifier: GPL-3.0-or-later
"""A page of line art to draw, black on white: strokes of several widths, hatching, a solid shape
and curves, as in a pen drawing of a face, a leaf and a jar. Needs Pillow."""

from __future__ import annotations

import math
from collections.abc import Callable

from PIL import Image, ImageDraw

SIZE = 1600
# Drawn so many times larger, and made smaller, for smooth edges.
FINER = 2

Place = tuple[float, float]
Stroke = Callable[[list[Place], float], None]


def page() -> Image.Image:
    """The page, SIZE x SIZE, of 8 bits."""
    made = Image.new("L", (SIZE * FINER, SIZE * FINER), 255)
    draw = ImageDraw.Draw(made)

    def stroke(places: list[Place], width: float) -> None:
        """Places from 0 to 1 from the upper left corner, and so the width."""
        scale = SIZE * FINER
        points = [(x * scale, y * scale) for x, y in places]
        draw.line(points, fill=0, width=max(1, round(width * scale)), joint="curve")
        half = width * scale / 2.0
        for x, y in (points[0], points[-1]):
            draw.ellipse((x - half, y - half, x + half, y + half), fill=0)

    def solid(places: list[Place]) -> None:
        draw.polygon([(x * SIZE * FINER, y * SIZE * FINER) for x, y in places], fill=0)

    stroke([(0.04, 0.04), (0.96, 0.04), (0.96, 0.96), (0.04, 0.96), (0.04, 0.04)], 0.012)
    _face(stroke, solid)
    _leaf(stroke)
    _jar(stroke)
    return made.resize((SIZE, SIZE), Image.Resampling.BOX)


def _arc(middle: Place, radii: Place, begin: float, end: float, steps: int = 60) -> list[Place]:
    """Of an ellipse; angles in degrees from the right, downwards."""
    turns = [math.radians(begin + (end - begin) * k / steps) for k in range(steps + 1)]
    return [
        (middle[0] + radii[0] * math.cos(turn), middle[1] + radii[1] * math.sin(turn))
        for turn in turns
    ]


def _face(stroke: Stroke, solid: Callable[[list[Place]], None]) -> None:
    stroke(_arc((0.36, 0.38), (0.22, 0.28), 0, 360), 0.014)
    solid(_arc((0.36, 0.30), (0.23, 0.24), 190, 350) + _arc((0.36, 0.30), (0.20, 0.13), 350, 190))
    for x in (0.28, 0.44):
        stroke(_arc((x, 0.37), (0.05, 0.025), 180, 360), 0.008)
        stroke(_arc((x, 0.36), (0.05, 0.02), 20, 160), 0.004)
        solid(_arc((x, 0.365), (0.014, 0.018), 0, 360))
        stroke(_arc((x, 0.33), (0.06, 0.03), 200, 340), 0.010)
    stroke([(0.36, 0.36), (0.335, 0.46), (0.375, 0.465)], 0.005)
    stroke(_arc((0.36, 0.51), (0.08, 0.035), 15, 165), 0.010)
    for k in range(9):
        stroke([(0.50 + 0.008 * k, 0.40 + 0.02 * k), (0.53 + 0.004 * k, 0.42 + 0.02 * k)], 0.003)


def _leaf(stroke: Stroke) -> None:
    stroke([(0.62, 0.44), (0.90, 0.12)], 0.007)
    for side in (1.0, -1.0):
        rim = []
        for k in range(41):
            along, out = k / 40, side * 0.09 * math.sin(math.pi * k / 40)
            rim.append((0.62 + 0.28 * along + 0.75 * out, 0.44 - 0.32 * along + 0.66 * out))
        stroke(rim, 0.009)
        for k in range(6, 36, 5):
            x, y = 0.62 + 0.28 * k / 40, 0.44 - 0.32 * k / 40
            stroke([(x, y), rim[min(k + 4, 40)]], 0.0035)


def _jar(stroke: Stroke) -> None:
    stroke(_arc((0.68, 0.58), (0.16, 0.03), 0, 360), 0.008)
    stroke([(0.52, 0.58), (0.50, 0.70), (0.56, 0.86)], 0.010)
    stroke([(0.84, 0.58), (0.86, 0.70), (0.80, 0.86)], 0.010)
    stroke(_arc((0.68, 0.86), (0.12, 0.025), 0, 180), 0.010)
    for k in range(14):
        x = 0.70 + 0.01 * k
        stroke([(x, 0.63 + 0.001 * k), (x + 0.005, 0.84 - 0.002 * k)], 0.003)
    for k in range(12):
        stroke([(0.08 + 0.03 * k, 0.90), (0.12 + 0.03 * k, 0.74)], 0.002 + 0.0006 * k)
