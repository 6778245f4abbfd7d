# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry: what has grown on one half, and its mirror image, on the whole surface; no bpy.

A closed strand and its image become one line by two crossings of the plane. Where the strand runs
along the plane as its neighbour, a piece is taken out of it and out of its image, and either end
turns to the plane: two hairpins back to back, each of a radius of half the spacing, as all others.
Where strands are to cross the plane, hairpins that face it are opened or moved (facing_tips).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import core
from .geometry.bridge_places import Strand
from .geometry.facing_tips import Moved, Piece, moved, spliced, tips_of
from .geometry.half_mesh import section
from .geometry.plane_crossings import Crossings, Side, opened
from .geometry.reflection import Mirror
from .geometry.thinning import kept_points, with_points
from .mirror import Half, at_rest

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
        self._places: Iterator[Crossings] = iter(())
        self._moved: list[Moved] = []
        self._least = 0.0

    def look_for_places(self, side: Side, spacings: NDArray[np.float64]) -> None:
        if self.guide or not self.closed or not side.meets:
            return
        strand = self._strand
        own = spacings[strand.first : strand.first + len(strand.points)]
        self._places = side.places(strand, own)
        if self._mirror.across:
            tips = list(tips_of(strand, self._mirror, own, side.foot))
            longest = sorted(tips, key=lambda tip: -tip.top)
            self._places = chain((opened(tip) for tip in longest), self._places)
            self._moved = moved(tips)
            self._least = 1e-3 * float(own.min())
        self.next_place()

    def next_place(self, wanted: bool = True) -> None:
        """Takes another place for the crossings; not `wanted`: none any more."""
        self.crossings = next(self._places, None) if wanted else None

    def leave_tip(self, place: NDArray[np.float64], every: bool) -> bool:
        """Leaves the tip that is nearest to a place as it is, or `every` one. Whether there was
        any that is moved."""
        if not self._moved:
            return False
        distances = [float(np.linalg.norm(each.tip.middle - place)) for each in self._moved]
        nearest = int(np.argmin(distances))
        self._moved = [] if every else self._moved[:nearest] + self._moved[nearest + 1 :]
        return True

    def lines(self) -> list[NDArray[np.float64]]:
        """One closed line, or the strand and its image."""
        both = [self._line([each.pieces[half] for each in self._free()]) for half in (0, 1)]
        if self.crossings is None:
            return [both[0], self._mirror.images(both[1])]
        # Both ends lie in the plane, and are their own images.
        return [np.vstack([both[0], self._mirror.images(both[1][1:-1])[::-1]])]

    def _free(self) -> list[Moved]:
        """The moved tips that the crossings leave room for."""
        if self.crossings is None:
            return self._moved
        begin, end = self.crossings.arcs[[0, -1]]
        return [each for each in self._moved if each.tip.lies_between(float(begin), float(end))]

    def _line(self, pieces: list[Piece]) -> NDArray[np.float64]:
        found, strand = self.crossings, self._strand
        if found is not None:
            arcs = found.arcs
            if not pieces:
                way = strand.positions(arcs)
            else:
                way = spliced(strand, float(arcs[0]), float(arcs[-1]), pieces, self._least)
            return np.vstack([found.before, way, found.after])
        if not pieces:
            return strand.points
        begin = pieces[0].begin
        return spliced(strand, begin, begin + strand.length, pieces, self._least)[:-1]


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
            refusals += 1
            left = [
                strand.leave_tip(seed.points[point], refusals >= _TRIES)
                for strand, point in zip(refused, error.elements, strict=False)
            ]
            if any(left):
                continue
            joined = [strand for strand in refused if strand.crossings is not None]
            if not joined:
                raise core.MeanderError(
                    "The curve and its mirror image meet on the other half of the surface, which "
                    "is not quite alike; make the two halves more alike, or choose a larger "
                    "spacing",
                    error.status,
                ) from error
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
