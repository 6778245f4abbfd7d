# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a strand beside a plane of symmetry is opened, so that it and its image become one line by
two crossings of the plane. No bpy."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .bridge_places import Strand
from .facing_tips import Tip, arcs_between

# A strand runs beside the plane where it is at most so many spacings from it; it is half of one
# away where the surface is filled well.
_BESIDE = 0.8
# Whatever else is nearer to a crossing than this, in spacings, is in its way.
_CLEAR = 0.4
# Control points of a quarter of a circle: Goldapp 1991, Approximation of circular arcs by cubic
# polynomials.
_QUARTER = 0.5523
# Points of one of the four turns, its end at the plane included.
_POINTS = 8
# So many places are measured at most: of those that were tried, every strand that has room had a
# place among the first few.
_MOST_PLACES = 400


@dataclass(frozen=True)
class Crossings:
    """A strand opened at a place, and how it goes on to the plane from both ends.

    arcs     (k,) float64: what is left of the strand, by the arc lengths of its points, rising
    before   (n, 3): from the plane to the first of them; the first of these lies in the plane
    after    (n, 3): from the last of them to the plane; the last of these lies in the plane
    """

    arcs: NDArray[np.float64]
    before: NDArray[np.float64]
    after: NDArray[np.float64]


class Side:
    """All strands on one side of the plane, and where that meets the surface.

    normal, origin   of the plane; strands lie where it points to
    section          (k, 2, 3), of the surface by the plane
    points           (n, 3), of all strands, guides too
    """

    def __init__(
        self,
        origin: NDArray[np.float64],
        normal: NDArray[np.float64],
        section: NDArray[np.float64],
        points: NDArray[np.float64],
    ) -> None:
        self._origin, self._normal, self._section = origin, normal, section
        self._points = points

    @property
    def meets(self) -> bool:
        """Whether the plane meets the surface."""
        return len(self._section) > 0

    def places(
        self, strand: Strand, spacings: NDArray[np.float64]
    ) -> Iterator[Crossings]:
        """Where a closed strand may be opened, the straightest piece beside the plane first.

        spacings   (n,) at the points of the strand
        """
        heights = (strand.points - self._origin) @ self._normal
        along = np.roll(strand.points, -1, axis=0) - np.roll(strand.points, 1, axis=0)
        lengths = np.linalg.norm(along, axis=1)
        rise = np.abs(along @ self._normal) / np.where(lengths > 0.0, lengths, 1.0)
        worth = np.abs(heights / spacings - 0.5) + rise
        near = np.flatnonzero((heights < _BESIDE * spacings) & (strand.length > 6.0 * spacings))
        tried: list[float] = []
        for point in near[np.argsort(worth[near], kind="stable")].tolist():
            arc, spacing = float(strand.knots[point]), float(spacings[point])
            if len(tried) == _MOST_PLACES:
                return
            if np.any(strand.distances(np.array(tried), arc) < 0.5 * spacing):
                continue
            tried.append(arc)
            found = self._crossings(strand, arc, spacing)
            if found is not None:
                yield found

    def _crossings(self, strand: Strand, arc: float, spacing: float) -> Crossings | None:
        """The two crossings at a place; None where the strand does not run beside the plane for so
        long, or something else is in the way."""
        corners = strand.positions([arc - spacing / 2.0, arc + spacing / 2.0])
        feet = np.array([self.foot(corner) for corner in corners])
        reaches = np.linalg.norm(feet - corners, axis=1)
        if reaches.max() > _BESIDE * spacing or reaches.min() < 0.1 * spacing:
            return None
        begin, end = arc + spacing / 2.0 + reaches[1], arc - spacing / 2.0 - reaches[0]
        piece = strand.positions(np.linspace(end, begin, 17))
        heights = (piece - self._origin) @ self._normal
        if heights.max() > _BESIDE * spacing or heights.min() <= 0.0:
            return None
        turns = [
            _turn(piece[0], corners[0], feet[0]),
            _turn(piece[-1], corners[1], feet[1]),
        ]
        if not self._clear(strand, (end, begin), np.vstack(turns), _CLEAR * spacing):
            return None
        least = 1e-3 * spacing  # a point that all but coincides with an end would be there twice
        begin, end = begin % strand.length, begin % strand.length + strand.length - (begin - end)
        arcs = arcs_between(strand, begin, end, least)
        return Crossings(arcs, turns[1][::-1], turns[0])

    def foot(self, point: NDArray[np.float64]) -> NDArray[np.float64]:
        """The nearest place where the plane meets the surface."""
        begins, sides = self._section[:, 0], self._section[:, 1] - self._section[:, 0]
        lengths = (sides * sides).sum(axis=1)
        along = ((point - begins) * sides).sum(axis=1)
        shares = np.clip(along / np.where(lengths > 0.0, lengths, 1.0), 0.0, 1.0)
        places = begins + shares[:, None] * sides
        return places[np.argmin(((places - point) ** 2).sum(axis=1))]

    def _clear(
        self,
        strand: Strand,
        taken: tuple[float, float],
        turns: NDArray[np.float64],
        least: float,
    ) -> bool:
        """Whether nothing but the strand beside the piece that is `taken` out comes near."""
        low, high = turns.min(axis=0) - least, turns.max(axis=0) + least
        first = strand.first
        near = np.flatnonzero(np.all((self._points >= low) & (self._points <= high), axis=1))
        own = near[(near >= first) & (near < first + len(strand.points))] - first
        others = near[(near < first) | (near >= first + len(strand.points))]
        middle, reach = sum(taken) / 2.0, (taken[1] - taken[0]) / 2.0 + 2.0 * least
        beyond = strand.distances(strand.knots[own], middle % strand.length) > reach
        points = self._points[np.concatenate([others, own[beyond] + first])]
        return not any((np.linalg.norm(turns - point, axis=1) < least).any() for point in points)


def _turn(
    begin: NDArray[np.float64], corner: NDArray[np.float64], end: NDArray[np.float64]
) -> NDArray[np.float64]:
    """A quarter of a circle from one place towards a corner and on to another, without the first:
    a cubic of Bezier's."""
    t = np.linspace(0.0, 1.0, _POINTS + 1)[1:, None]
    one, other = begin + _QUARTER * (corner - begin), end + _QUARTER * (corner - end)
    s = 1.0 - t
    return s**3 * begin + 3.0 * s * s * t * one + 3.0 * s * t * t * other + t**3 * end


def opened(tip: Tip) -> Crossings:
    """The crossings of a hairpin that faces the plane, without its turn."""
    begin, end = tip.ends[1], tip.ends[0] + tip.strand.length
    arcs = arcs_between(tip.strand, begin, end, 1e-3 * tip.spacing)
    return Crossings(arcs, tip.to_plane(1), tip.to_plane(0)[::-1])
