# SPDX-License-Identifier: GPL-3.0-or-later
"""Hairpins that face their images across a plane of symmetry, and strands that cross it there.

A closed line that is its own mirror image meets the plane in two points. But where a hairpin and
its image face each other, the gap between them can be moved along both their strands into one half:
the one reaches through the plane, the other draws back. The line stays one, crosses itself nowhere,
and has no turns beside the plane. numpy only, no bpy.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .bridge_places import Strand
from .reflection import Mirror

# Lengths are in spacings. Nearer to the plane than this a strand is part of a turn.
_TURN = 1.0
# How far apart the strands of a hairpin are, and how long its turn is at most.
_LEAST_APART, _MOST_APART = 0.6, 1.5
_LONGEST_TURN = 3.5
# How far along its strands a hairpin is looked at, and at which steps.
_FARTHEST, _STEP = 6.0, 0.25
# Points of a turn, and of a strand from its turn to the plane.
_POINTS = 8
# Gaps side by side are moved by different lengths: those of the golden ratio repeat last.
_GOLDEN = 0.618034

_Points = NDArray[np.float64]


@dataclass(frozen=True)
class Piece:
    """What is on a strand between two arc lengths, in place of what was there."""

    begin: float
    end: float
    points: _Points


@dataclass(frozen=True)
class Tip:
    """A hairpin that faces its image across the plane.

    A level on one of its sides, 0 or 1, is how far that is from the plane along the strand, in
    spacings; below its turn a side goes on straight to the plane.

    ends   arc lengths at which its turn begins, on side 0, and ends, on side 1
    feet   (2, 3) where its sides meet the plane
    top    the highest level that both sides have
    """

    strand: Strand
    mirror: Mirror
    spacing: float
    ends: tuple[float, float]
    feet: _Points
    top: float

    @property
    def middle(self) -> _Points:
        return self.feet.mean(axis=0)

    def lies_between(self, begin: float, end: float) -> bool:
        """Whether all of it lies on a stretch of its strand between two arc lengths."""
        one, other = self.arc(0, self.top), self.arc(1, self.top)
        return (one - begin) % self.strand.length + other - one <= end - begin

    def arc(self, side: int, level: float) -> float:
        way = self.spacing * (level - _TURN)
        return self.ends[side] + (way if side else -way)

    def at(self, side: int, levels: NDArray[np.float64]) -> _Points:
        """Places on a side."""
        places = self.strand.positions([self.arc(side, level) for level in levels])
        first = self.strand.positions([self.ends[side]])[0]
        foot = self.feet[side]
        straight = foot + levels[:, None] / _TURN * (first - foot)
        return np.where(levels[:, None] < _TURN, straight, places)

    def to_plane(self, side: int) -> _Points:
        """From where a side meets the plane up to the turn, without its last place."""
        return self.at(side, np.linspace(0.0, _TURN, _POINTS, endpoint=False))

    def drawn_back(self, by: float) -> Piece:
        """The turn farther from the plane, by so many spacings."""
        top = _TURN + by
        return Piece(self.arc(0, top), self.arc(1, top), self._turn(top, -1.0))

    def reaching(self, by: float) -> Piece:
        """The turn on the other side of the plane, one spacing from the image that has drawn back
        by so many spacings."""
        top = by - _TURN
        levels = np.linspace(0.0, top, max(2, int(np.ceil(_POINTS * top)) + 1))[1:]
        beyond = [
            self.mirror.images(self.at(side, levels[levels > 0.0])) for side in (0, 1)
        ]
        here = [self.to_plane(side) for side in (0, 1)]
        turn = self.mirror.images(self._turn(top, 1.0))
        way = [here[0][::-1], beyond[0], turn, beyond[1][::-1], here[1]]
        return Piece(*self.ends, np.vstack(way))

    def _turn(self, level: float, way: float) -> _Points:
        """Half an ellipse from side 0 to side 1, without its ends: down (-1) or up (1)."""
        one, other = (self.at(side, np.array([level]))[0] for side in (0, 1))
        middle = (one + other) / 2.0
        before = np.array([level - way * _STEP])
        ahead = middle - np.vstack([self.at(side, before) for side in (0, 1)]).mean(axis=0)
        ahead *= 0.5 * self.spacing / np.linalg.norm(ahead)
        angles = np.linspace(0.0, np.pi, _POINTS + 2)[1:-1, None]
        return middle + np.cos(angles) * (one - middle) + np.sin(angles) * ahead


def tips_of(
    strand: Strand,
    mirror: Mirror,
    spacings: NDArray[np.float64],
    foot_of: Callable[[_Points], _Points],
) -> Iterator[Tip]:
    """The hairpins of a closed strand that face the plane, as they come along it.

    spacings   (n,) at its points
    foot_of    the nearest place where the plane meets the surface
    """
    levels = mirror.heights(strand.points) / spacings
    below = levels < _TURN
    count = len(below)
    if below.all() or not below.any():
        return
    for begin in np.flatnonzero(below & ~np.roll(below, 1)).tolist():
        last = begin
        while below[(last + 1) % count]:
            last += 1
        ends = (
            _crossing(strand, levels, begin - 1),
            _crossing(strand, levels, last),
        )
        spacing = float(spacings[begin])
        length = (ends[1] - ends[0]) % strand.length
        if length > _LONGEST_TURN * spacing:
            continue
        ends = (ends[1] - length, ends[1])
        feet = np.array([foot_of(place) for place in strand.positions(ends)])
        tip = Tip(strand, mirror, spacing, ends, feet, _TURN)
        top = _top(tip)
        if top >= 2.0 * _TURN:
            yield Tip(strand, mirror, spacing, ends, feet, top)


def _crossing(strand: Strand, levels: NDArray[np.float64], point: int) -> float:
    """Where a strand goes through the level of the turns, after a point of it."""
    count = len(levels)
    before, after = levels[point % count], levels[(point + 1) % count]
    share = (_TURN - before) / (after - before)
    knots, point = strand.knots, point % count
    return float(knots[point] + share * (knots[point + 1] - knots[point]))


def _top(tip: Tip) -> float:
    """Up to which level both sides leave the plane side by side; 0 for no hairpin."""
    longest = (tip.strand.length - (tip.ends[1] - tip.ends[0])) / (4.0 * tip.spacing)
    levels = np.arange(_TURN, _TURN + min(_FARTHEST, longest), _STEP)
    one, other = (tip.at(side, levels) for side in (0, 1))
    apart = np.linalg.norm(one - other, axis=1) / tip.spacing
    fits = (apart > _LEAST_APART) & (apart < _MOST_APART)
    fits &= np.linalg.norm(tip.feet[0] - tip.feet[1]) > _LEAST_APART * tip.spacing
    for side in (one, other):
        fits[1:] &= np.diff(tip.mirror.heights(side)) > 0.5 * _STEP * tip.spacing
    wrong = np.flatnonzero(~fits)
    count = int(wrong[0]) if len(wrong) else len(levels)
    return float(levels[count - 1]) if count else 0.0


@dataclass(frozen=True)
class Moved:
    """A tip, and what takes the place of its turn and of its image's where their gap is moved.

    pieces   of the strand, and of the one whose mirror image is the other half's
    """

    tip: Tip
    pieces: tuple[Piece, Piece]


def moved(tips: list[Tip]) -> list[Moved]:
    """Every tip's gap moved, to either side in turn, by lengths that differ."""
    if not tips:
        return []
    middles = np.array([tip.middle for tip in tips])
    around = middles - middles.mean(axis=0)
    along = np.roll(np.eye(3), 1, axis=0)[int(np.argmax(np.abs(tips[0].mirror.normal)))]
    first = np.cross(tips[0].mirror.normal, along)
    second = np.cross(tips[0].mirror.normal, first)
    order = np.argsort(np.arctan2(around @ second, around @ first), kind="stable")
    found = []
    for place, k in enumerate(order.tolist()):
        tip = tips[k]
        by = _TURN + (tip.top - 2.0 * _TURN) * (_GOLDEN * place % 1.0)
        back, reaching = tip.drawn_back(by), tip.reaching(by)
        found.append(Moved(tip, (reaching, back) if place % 2 else (back, reaching)))
    return found


def spliced(strand: Strand, begin: float, end: float, pieces: list[Piece], least: float) -> _Points:
    """A closed strand from one arc length to another with pieces in place, which lie between.

    least   see arcs_between()
    """
    ways, here = [], begin
    for piece in sorted(pieces, key=lambda piece: (piece.begin - begin) % strand.length):
        first = begin + (piece.begin - begin) % strand.length
        ways += [strand.positions(arcs_between(strand, here, first, least)), piece.points]
        here = first + piece.end - piece.begin
    ways.append(strand.positions(arcs_between(strand, here, end, least)))
    return np.vstack(ways)


def arcs_between(strand: Strand, begin: float, end: float, least: float) -> NDArray[np.float64]:
    """Two arc lengths on a closed strand, and between them those of its points; those that are not
    nearer than `least` to either."""
    knots = strand.knots[: len(strand.points)]
    begin_turn, end_turn = (int(np.floor(arc / strand.length)) for arc in (begin, end))
    inside = []
    for turn in range(begin_turn, end_turn + 1):
        shift = strand.length * turn
        first, last = np.searchsorted(knots, [begin - shift, end - shift])
        near = knots[max(first - 1, 0) : last + 1] + shift
        inside.append(near[(near > begin + least) & (near < end - least)])
    return np.concatenate([[begin], *inside, [end]])


def kept_of(points: _Points, above: NDArray[np.bool_], spacing: float) -> NDArray[np.bool_]:
    """Which points of a closed strand are left, (n,), once hairpins that reach through the plane
    are taken back, so that it goes through it twice.

    above   on which side each lies
    """
    kept = np.ones(len(points), dtype=bool)
    for side in (True, False):  # what reaches to one side, and what is a part of the other then
        left = np.flatnonzero(kept)
        runs = _runs(above[left])
        lengths = [
            np.linalg.norm(np.diff(points[left[run]], axis=0), axis=1).sum() for run in runs
        ]
        mine = [k for k, run in enumerate(runs) if above[left[run[0]]] == side]
        for k in sorted(mine, key=lambda k: lengths[k])[:-1]:
            ends = points[left[runs[k]]][[0, -1]]
            apart = float(np.linalg.norm(ends[0] - ends[1]))
            if lengths[k] < 2.0 * (_FARTHEST + _TURN) * spacing and apart < 2.0 * spacing:
                kept[left[runs[k]]] = False
    return kept


def _runs(flags: NDArray[np.bool_]) -> list[NDArray[np.int64]]:
    """Places round a ring in runs of the same flag."""
    starts = np.flatnonzero(flags != np.roll(flags, 1))
    if len(starts) < 2:
        return [np.arange(len(flags))]
    count = len(flags)
    ends = np.append(starts[1:], starts[0] + count)
    return [np.arange(a, b) % count for a, b in zip(starts, ends, strict=True)]
