# SPDX-License-Identifier: GPL-3.0-or-later
"""Strands as a drawing for a machine: laid into a plane or not, in a unit of length; no bpy."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..files.whole import FileError
from ..geometry.arcs import Moves, fitted
from ..geometry.flat_crossings import crossings, segments_of
from .toolpath import Strand, strand_of

# Metres, and the name that files use.
UNITS = {"mm": 0.001, "cm": 0.01, "in": 0.0254, "m": 1.0}

# To the right and up on paper: what one sees from above, from the front and from the right.
VIEWS = {
    "top": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    "front": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "side": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
}

# How finely arcs are looked at for crossings, in spacings.
_FLAT = 1e-3

# From the origin, in sizes, beyond which single precision would be seen in a file that has it.
_FAR = 100.0


class Page(NamedTuple):
    """A sheet of paper with its lower left corner at the origin, in the unit of what is on it.

    sides   width and height
    marks   strands that show where it meets other sheets
    """

    sides: tuple[float, float]
    marks: Sequence[Strand]


@dataclass(frozen=True)
class Drawing:
    """Strands in the unit of a file.

    flat   they lie in the plane z = 0, with their lower left corner at the origin
    spacing   the least spacing of neighbouring strands, in the unit; 0: it is not known
    moves   of a flat drawing: lines and arcs in place of the points of each strand; None: none
    lights  its points are lights, and nothing is drawn between them
    frames  of a curve that moves: times and strands, in the order of time; empty: it does not
    rate    how many times are a second
    of_scene_unit   how long a scene unit is, in the unit
    page    the sheet of paper that a flat one lies on; None: one that is as large as it is
    """

    strands: Sequence[Strand]
    unit: str
    flat: bool
    spacing: float = 0.0
    moves: Sequence[Moves] | None = None
    lights: bool = False
    frames: Sequence[tuple[float, Sequence[Strand]]] = ()
    rate: float = 24.0
    of_scene_unit: float = 1.0
    page: Page | None = None

    @property
    def millimetres(self) -> float:
        """How many millimetres the unit is."""
        return UNITS[self.unit] * 1000.0

    @property
    def point_count(self) -> int:
        return sum(len(strand.points) for strand in self.strands)

    @property
    def length(self) -> float:
        """Of all strands, as they are drawn."""
        return sum(_length(strand) for strand in self.strands)

    def box(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The least and the greatest coordinates, (3,) each."""
        return _box(self.strands)

    def crossings(self) -> NDArray[np.float64]:
        """The places (k, 2) where a flat drawing crosses itself."""
        if not self.flat or self.lights:
            return np.empty((0, 2))
        ways = [strand.points for strand in self.strands]
        closed = [strand.closed for strand in self.strands]
        if self.moves is not None:
            ways = [moves.flattened(_FLAT * self.spacing or 1e-3) for moves in self.moves]
            closed = [False] * len(ways)
        begin, end, _owner = segments_of(ways, closed)
        return crossings(begin, end)[2]

    def size_text(self) -> str:
        """Such as "100 x 45.07 mm"."""
        low, high = self.box()
        sides = (high - low)[:2] if self.flat else high - low
        return f"{' x '.join(f'{side:.4g}' for side in sides)} {self.unit}"

    def described(self) -> str:
        """Its size, strands and points, in words."""
        size = self.size_text()
        paths = f"{len(self.strands):,} path{'s' * (len(self.strands) != 1)}"
        if self.moves is not None:
            turns = np.concatenate([moves.turns for moves in self.moves])
            arcs = int(np.count_nonzero(turns))
            return f"{size}, {paths}, {arcs:,} arcs and {len(turns) - arcs:,} lines"
        points = f"{self.point_count:,} {'lights' if self.lights else 'points'}"
        if self.frames:
            return f"{size}, {len(self.frames):,} frames, {paths} and {points} in the present one"
        return f"{size}, {paths}, {points}"

    def with_arcs(self, tolerance: float) -> Drawing:
        """The same with lines and arcs within a tolerance in millimetres; it has to be flat."""
        allowed = tolerance / self.millimetres
        return replace(
            self, moves=[fitted(ring(strand)[:, :2], allowed) for strand in self.strands]
        )


def seen_along(strands: Sequence[Strand], right: ArrayLike, up: ArrayLike) -> list[Strand]:
    """Strands projected into a plane, at z = 0, their normals towards the eye.

    right, up   (3,) each, unit and at right angles: the axes of the plane in space
    """
    axes = np.column_stack([np.asarray(right, float), np.asarray(up, float)])
    flat = []
    for strand in strands:
        points = np.column_stack([strand.points @ axes, np.zeros(len(strand.points))])
        flat.append(strand_of(points, np.tile([0.0, 0.0, 1.0], (len(points), 1)), strand.closed))
    return flat


def axes_of(layout: str) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """To the right and up in a layout that is one of VIEWS; "space" is seen from the top."""
    return VIEWS["top" if layout == "space" else layout]


def frame_of(
    strands: Sequence[Strand],
    unit: str,
    metres: float,
    scale: float,
    size: float,
    flat: bool,
) -> tuple[NDArray[np.float64], float]:
    """What is the origin of a drawing, in scene units, and by what lengths are multiplied; see
    drawing_of, which raises the same."""
    if not strands:
        raise FileError("The curve has no strands; fill the surface first")
    if not all(np.isfinite(strand.points).all() for strand in strands):
        raise FileError("The curve has points that are not numbers; fill the surface again")
    low, high = _box(strands)
    extent = float((high - low).max())
    factor = scale * metres / UNITS[unit] if size <= 0.0 else size / extent if extent > 0.0 else 0.0
    if not 0.0 < factor * extent < math.inf:
        raise FileError("All points of the curve are in one place; fill the surface again")
    return low if flat else np.zeros(3), factor


def drawing_of(
    strands: Sequence[Strand],
    unit: str,
    metres: float,
    scale: float,
    size: float,
    flat: bool,
    spacing: float = 0.0,
) -> Drawing:
    """Strands in a unit of length.

    unit     one of UNITS
    metres   the length of a scene unit
    scale    by which the true size is multiplied
    size     the longest side of the drawing in the unit, instead of the true size; 0: true size
    flat     the strands lie at z = 0 already, and may be moved to the origin
    spacing  the least spacing, in scene units; 0: it is not known

    Raises FileError with one sentence for what is no drawing: no points, points that are not
    numbers, or all of them in one place.
    """
    origin, factor = frame_of(strands, unit, metres, scale, size, flat)
    laid = [moved(strand, origin, factor) for strand in strands]
    return Drawing(laid, unit, flat, spacing * factor, of_scene_unit=factor)


def moved(strand: Strand, origin: NDArray[np.float64], factor: float) -> Strand:
    """A strand with another origin, (3,), and its lengths multiplied."""
    return replace(
        strand,
        length=strand.length * factor,
        points=(strand.points - origin) * factor,
        arc_lengths=strand.arc_lengths * factor,
        radii=None if strand.radii is None else strand.radii * factor,
    )


def far_away(strands: Sequence[Strand]) -> NDArray[np.float64]:
    """What to subtract from the points, (3,), before they are rounded to single precision: the
    middle of their box if that is far from the origin, else 0."""
    low, high = _box(strands)
    middle = (low + high) / 2.0
    return middle if np.abs(middle).max() > _FAR * float((high - low).max()) else np.zeros(3)


def ring(strand: Strand) -> NDArray[np.float64]:
    """The points in order, (n, 3), of a closed strand with the first one again at the end."""
    return np.vstack([strand.points, strand.points[:1]]) if strand.closed else strand.points


def number(value: float, decimals: int) -> str:
    """A number as every program reads it: a point, no exponent, no zeros at the end, no -0."""
    text = f"{value:.{decimals}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _length(strand: Strand) -> float:
    return float(np.linalg.norm(np.diff(ring(strand), axis=0), axis=1).sum())


def _box(strands: Sequence[Strand]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    return (
        np.min([strand.points.min(axis=0) for strand in strands], axis=0),
        np.max([strand.points.max(axis=0) for strand in strands], axis=0),
    )
