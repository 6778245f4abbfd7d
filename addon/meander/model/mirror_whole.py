# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry: what has grown on one half, and its mirror image, on the whole surface; no bpy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import core
from .geometry.bridge_places import Strand
from .geometry.half_mesh import section
from .geometry.thinning import kept_points, with_points
from .mirror import Half, at_rest
from .mirror_crossings import Crossings, Side
from .mirror_plane import Mirror

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
        of_run = {
            key: value
            for key, value in grown.statistics().items()
            if key in ("iterations", "stop_reason", "polishing") or key.startswith("seconds_")
        }
        return self.flow.statistics() | of_run | half.fit

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
