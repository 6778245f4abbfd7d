# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry: what has grown on one half, and its mirror image, on the whole surface; no bpy.

A closed strand and its image become one line by two crossings of the plane. Where the strand runs
along the plane as its neighbour, a piece is taken out of it and out of its image, and either end
turns to the plane: two hairpins back to back, each of a radius of half the spacing, as all others.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import core
from .geometry.bridge_places import Strand
from .geometry.half_mesh import section
from .geometry.reflection import Mirror
from .geometry.thinning import kept_points, with_points
from .mirror import Half, at_rest

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

    def places(
        self, strand: Strand, spacings: NDArray[np.float64]
    ) -> Iterator[Crossings]:
        """Where a closed strand may be opened, the straightest piece beside the plane first.

        spacings   (n,) at the points of the strand
        """
        if not len(self._section):
            return
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
        feet = np.array([self._foot(corner) for corner in corners])
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
        knots = strand.knots[: len(strand.points)]
        knots = np.concatenate([knots, knots + strand.length])
        least = 1e-3 * spacing  # a point that all but coincides with an end would be there twice
        begin, end = begin % strand.length, begin % strand.length + strand.length - (begin - end)
        inside = knots[(knots > begin + least) & (knots < end - least)]
        arcs = np.concatenate([[begin], inside, [end]])
        return Crossings(arcs, turns[1][::-1], turns[0])

    def _foot(self, point: NDArray[np.float64]) -> NDArray[np.float64]:
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


# Points nearer to the last one than this, in spacings, are left out. A strand through a vertex has
# several in all but one place there, whose images may lie in another order.
_APART = 0.01
# How often another place for the crossings is looked for where the library refuses one.
_TRIES = 12


@dataclass(frozen=True)
class Whole:
    """A curve and its mirror image on the whole surface.

    flow      makes no step; the caller closes it
    sources   (s,) int64, the strand of the given seed that each strand came from; a large number
              where it had none
    joined    how many strands are one closed line with their image
    why       why there are more lines than parts of the surface, without a full stop; empty: there
              are not
    """

    flow: core.Flow
    sources: NDArray[np.int64]
    joined: int
    why: str

    def statistics(self, half: Half, grown: core.Flow) -> dict[str, Any]:
        """Of the whole curve; how long it took is that of the half's flow."""
        return with_run(self.flow.statistics(), grown) | half.fit

    def figures(self, half: Half) -> dict[str, Any]:
        """The report's "mirror"."""
        crossings = self.plane_crossings(half.mirror)
        return {"axis": half.mirror.axis, "joined": self.joined, "crossings": crossings,
                "why": self.why or None}  # fmt: skip

    def plane_crossings(self, mirror: Mirror) -> int:
        """How often strands that are no guides go through the plane."""
        curve, guides = self.flow.polylines(), self.flow.guides()
        count = 0
        for k in np.flatnonzero(~guides):
            heights = mirror.heights(curve.positions[curve.offsets[k] : curve.offsets[k + 1]])
            sides = np.sign(heights[heights != 0.0])
            after = np.roll(sides, -1) if curve.closed[k] else sides[1:]
            count += int(np.count_nonzero(sides[: len(after)] != after))
        return count


def with_run(figures: dict[str, Any], grown: core.Flow) -> dict[str, Any]:
    """Figures of a curve that was laid, with those of the run that it has grown in."""
    return figures | {
        key: value
        for key, value in grown.statistics().items()
        if key in ("iterations", "stop_reason", "polishing") or key.startswith("seconds_")
    }


_NO_SOURCE = 1 << 31


def whole_of(half: Half, grown: core.Flow, options: core.FlowOptions) -> Whole:
    """The curve that has grown on a half, and its mirror image, as one closed line where there is
    a place for that. Raises core.MeanderError.

    options   those that the half's flow has by now
    """
    curve, guides = grown.polylines(), grown.guides()
    spacings = _spacings(half, grown, options)
    kept = kept_points(curve, _APART * float(spacings.min()))
    curve, spacings = with_points(curve, kept), spacings[kept]
    strands = [_Mirrored(half, curve, k, bool(guides[k])) for k in range(len(guides))]
    lines = section(half.given.vertices, half.given.faces, half.mirror.heights(half.given.vertices))
    side = Side(half.mirror.origin, half.mirror.normal, lines, curve.positions)
    for strand in strands:
        strand.look_for_places(side, spacings)
    given = half.given
    with core.Surface(
        given.vertices, given.faces, given.surface_options, options.threads
    ) as surface:
        flow = _laid(strands, surface, options, half.density)
    sources = [
        int(half.sources[k]) if k < len(half.sources) else _NO_SOURCE
        for k, strand in enumerate(strands)
        for _line in strand.lines()
    ]
    joined = sum(strand.crossings is not None for strand in strands)
    count = sum(len(strand.lines()) for strand in strands if not strand.guide)
    why = "" if count == half.figures["components"] else _why(strands, lines)
    return Whole(flow, np.array(sources, dtype=np.int64), joined, why)


def _spacings(
    half: Half, grown: core.Flow, options: core.FlowOptions
) -> NDArray[np.float64]:
    """At every point of the curve that has grown."""
    spacing = 2.0 * options.radius
    if half.density is None:
        return np.full(len(grown.polylines().positions), spacing)
    data = grown.point_data()
    corners = half.mesh.carried(half.density)[half.mesh.faces[data.faces]]
    return spacing / np.sqrt((corners * data.barycentrics).sum(axis=1))


class _Mirrored:
    """A strand that has grown, and what becomes of it and its image."""

    def __init__(self, half: Half, curve: core.Polylines, number: int, guide: bool) -> None:
        begin, end = int(curve.offsets[number]), int(curve.offsets[number + 1])
        self.closed, self.guide = bool(curve.closed[number]), guide
        self.crossings: Crossings | None = None
        self._mirror = half.mirror
        self._strand = Strand(curve.positions[begin:end], self.closed, begin)
        self._places = iter(())

    def look_for_places(self, side: Side, spacings: NDArray[np.float64]) -> None:
        if self.guide or not self.closed:
            return
        first = self._strand.first
        own = spacings[first : first + len(self._strand.points)]
        self._places = side.places(self._strand, own)
        self.next_place()

    def next_place(self, wanted: bool = True) -> None:
        """Takes another place for the crossings; not `wanted`: none any more."""
        self.crossings = next(self._places, None) if wanted else None

    def lines(self) -> list[NDArray[np.float64]]:
        """One closed line, or the strand and its image."""
        if self.crossings is None:
            points = self._strand.points
            return [points, self._mirror.images(points)]
        found = self.crossings
        line = np.vstack([found.before, self._strand.positions(found.arcs), found.after])
        # Both ends lie in the plane, and are their own images.
        return [np.vstack([line, self._mirror.images(line[1:-1])[::-1]])]


def _laid(
    strands: list[_Mirrored],
    surface: core.Surface,
    options: core.FlowOptions,
    density: NDArray[np.float64] | None,
) -> core.Flow:
    """The flow of all lines. Where the library refuses crossings of the plane the next place is
    taken."""
    refusals = 0
    while True:
        lines = [(strand, line) for strand in strands for line in strand.lines()]
        offsets = np.cumsum([0] + [len(line) for _strand, line in lines])
        seed = core.Seed(
            np.vstack([line for _strand, line in lines]),
            offsets.astype(np.uint32),
            np.array([strand.closed for strand, _line in lines], dtype=np.uint8),
            guides=np.array([strand.guide for strand, _line in lines], dtype=np.uint8),
            max_distance=options.radius,
        )
        try:
            return core.Flow(surface, at_rest(options), seed, density)
        except core.MeanderError as error:
            refused = [
                lines[int(np.searchsorted(offsets, point, side="right")) - 1][0]
                for point in (error.elements if error.element_kind == "seed_point" else ())
            ]
            joined = [strand for strand in refused if strand.crossings is not None]
            if not joined:
                raise core.MeanderError(
                    "The curve and its mirror image meet on the other half of the surface, which "
                    "is not quite alike; make the two halves more alike, or choose a larger "
                    "spacing",
                    error.status,
                ) from error
            refusals += 1
            joined[0].next_place(refusals < _TRIES)


def _why(strands: list[_Mirrored], lines: NDArray[np.float64]) -> str:
    apart = [strand for strand in strands if not strand.guide and strand.crossings is None]
    if not apart:
        return ""
    if not len(lines):
        return "the two halves do not meet"
    if any(not strand.closed for strand in apart):
        return "open strands stay one a side"
    return "no place at the plane has room to cross it"
