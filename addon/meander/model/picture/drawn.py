# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drawing has become: how well it has the tone, and how it looks; no bpy."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..files.whole import FileError
from ..toolpaths.drawing import ring
from ..toolpaths.toolpath import Strand
from .image import blurred, is_there, missing_text
from .sheet import Grid

# This share of the sides is not looked at along the rim: no ink lies beyond it.
_RIM = 0.05
# Longer pieces of a line are divided before their ink is given to cells, in cells.
_LONGEST = 0.5
# How much larger a preview is drawn before it is made smaller.
_FINER = 3


@dataclass(frozen=True)
class ToneError:
    """The difference of a drawing from what it was to be, both blurred, as shares of the range from
    white to black.

    one, two   mean of its size, blurred by one and by two mean spacings
    bias       mean of it, blurred by two: positive is too dark
    """

    one: float
    two: float
    bias: float

    def entry(self) -> dict[str, float]:
        """Of a report."""
        return {"error_1": self.one, "error_2": self.two, "bias": self.bias}


def ink_of(strands: Sequence[Strand], pen: float, grid: Grid) -> NDArray[np.float64]:
    """The share of ink around each place of a grid, (down + 1, across + 1): length times width,
    over the area that the place stands for. Strands that overlap count twice."""
    across, down = grid.cells
    steps = np.array([grid.sides[0] / across, grid.sides[1] / down])
    total = np.zeros((down + 1) * (across + 1))
    for strand in strands:
        points = ring(strand)[:, :2] / steps
        ways = np.diff(points, axis=0)
        pieces = np.ceil(np.linalg.norm(ways, axis=1) / _LONGEST).astype(np.int64)
        pieces = np.maximum(pieces, 1)
        owner = np.repeat(np.arange(len(pieces)), pieces)
        first = np.repeat(np.cumsum(pieces) - pieces, pieces)
        share = (np.arange(len(owner)) - first + 0.5) / pieces[owner]
        places = points[owner] + share[:, None] * ways[owner]
        weights = (np.linalg.norm(ways * steps, axis=1) / pieces)[owner]
        # To the four places around, each the more the nearer it is.
        whole = np.floor(places).astype(np.int64).clip(0, [across - 1, down - 1])
        x, y = (places - whole).clip(0.0, 1.0).T
        at = (down - whole[:, 1]) * (across + 1) + whole[:, 0]
        for shift, part in (
            (0, (1 - x) * (1 - y)),
            (1, x * (1 - y)),
            (-(across + 1), (1 - x) * y),
            (-across, x * y),
        ):
            total += np.bincount(at + shift, weights * part, len(total))
    area = np.full((down + 1, across + 1), float(np.prod(steps)))
    area[[0, -1]] /= 2.0
    area[:, [0, -1]] /= 2.0
    return total.reshape(area.shape) * pen / area


def tone_error(
    ink: NDArray[np.float64], share: NDArray[np.float64], spacing: float, grid: Grid
) -> ToneError:
    """How far the ink of a drawing is from the share that was wanted, away from the rim.

    share     at the places of the grid; 0 where there is to be no line
    spacing   the mean one, in millimetres
    """
    rim = tuple(slice(math.ceil(_RIM * n), n - math.ceil(_RIM * n)) for n in ink.shape)
    sizes, bias = [], 0.0
    for times in (1.0, 2.0):
        difference = blurred(ink - share, times * spacing / grid.cell)[rim]
        sizes.append(float(np.abs(difference).mean()))
        bias = float(difference.mean())
    return ToneError(*sizes, bias)


def preview(
    layers: Sequence[tuple[str, Sequence[Strand]]],
    sides: tuple[float, float],
    pen: float,
    size: int,
) -> Any:
    """The drawing as an image of Pillow's, on white, as paper would show it.

    layers   colours as #rrggbb, and strands in millimetres from the lower left corner
    sides    width and height of the page, in millimetres
    size     of the longer side, in pixels

    Inks lie over each other as glass does. Raises FileError where Pillow is not installed.
    """
    if not is_there():
        raise FileError(missing_text("a preview"))
    from PIL import Image, ImageChops, ImageDraw

    scale = size / max(sides)
    pixels = tuple(max(1, round(side * scale)) for side in sides)
    fine = tuple(_FINER * count for count in pixels)
    page = Image.new("RGB", pixels, "white")
    for colour, strands in layers:
        ink = Image.new("L", fine, 255)
        draw = ImageDraw.Draw(ink)
        for strand in strands:
            points = ring(strand)[:, :2] * scale * _FINER
            points[:, 1] = fine[1] - points[:, 1]
            width = max(1, round(pen * scale * _FINER))
            draw.line(points.ravel().tolist(), fill=0, width=width, joint="curve")
        ink = ink.resize(pixels, Image.Resampling.BOX)
        tinted = Image.composite(
            Image.new("RGB", pixels, "white"), Image.new("RGB", pixels, colour), ink
        )
        page = ImageChops.multiply(page, tinted)
    return page
