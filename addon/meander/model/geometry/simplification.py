# SPDX-License-Identifier: GPL-3.0-or-later
"""Polylines with fewer points, which stay within a tolerance and still cross nothing; no bpy.

The points that stay are points of the curve, so they are as much on the surface as they were. Every
chord between two of them keeps within the tolerance of the pieces that it replaces, and they of it
(Ramer 1972; Douglas and Peucker 1973).

Nothing crosses. All that a chord replaces lies in the tube around it whose radius is its deviation,
and pulling it straight does not leave that tube. So where the tubes of two chords are apart,
neither has passed through the other; where they are not, both chords are split, down to the pieces
of the curve, which deviate by nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ... import core
from . import thinning
from .near_chords import pairs_within

# A strand is first divided into parts of this many points. That bounds the time of what could take
# out one row of a zigzag after another, and leaves one point in a thousand too many.
_PART = 1024

# A tolerance in spacings, by default and at most: neighbouring strands are one spacing apart.
DEFAULT_SHARE = 0.01
GREATEST_SHARE = 0.25


@dataclass(frozen=True)
class Light:
    """How many points a light curve has.

    share   how far it may be from the whole one, in spacings, 0 or more
    limit   the largest number of points, for which up to GREATEST_SHARE is taken; 0: none
    """

    share: float = DEFAULT_SHARE
    limit: int = 0


def result_points(
    polylines: core.Polylines, spacing: float, light: Light | None
) -> NDArray[np.int64]:
    """The indices of the points that a result has of a curve.

    spacing   the least one on the surface

    Points that nearly coincide are merged. What is light is so by its distance from that.
    """
    kept = thinning.kept_points(polylines, spacing * thinning.MERGED_SHARE)
    if light is None:
        return kept
    return kept[light_points(thinning.with_points(polylines, kept), light, spacing)]


def light_points(
    polylines: core.Polylines, light: Light, spacing: float
) -> NDArray[np.int64]:
    """The indices of the points of a light curve, in order.

    spacing   the least one on the surface

    The first point of every strand stays, the last one of an open strand, and three points of a
    closed one. More points than the limit stay where even the greatest tolerance leaves more.
    """
    chain = _Chain(
        np.asarray(polylines.positions, dtype=np.float64),
        np.asarray(polylines.offsets, dtype=np.int64),
        np.asarray(polylines.closed, dtype=bool),
    )
    tolerance, greatest = light.share * spacing, max(light.share, GREATEST_SHARE) * spacing
    weights = chain.significances(tolerance)
    kept = chain.uncrossed(weights > tolerance)
    excess, wanted = np.count_nonzero(kept) - light.limit, light.limit
    # What has to be added so that nothing crosses is only known afterwards.
    for _ in range(6):
        if light.limit == 0 or excess <= 0 or wanted <= 0:
            break
        order = np.sort(weights)[::-1]
        tolerance = min(float(order[min(wanted, len(order) - 1)]), greatest)
        kept = chain.uncrossed(weights > tolerance)
        if tolerance == greatest:
            break
        excess = np.count_nonzero(kept) - light.limit
        wanted -= excess
    return np.flatnonzero(kept)


def kept_within(
    points: NDArray[np.float64], closed: bool, tolerance: float
) -> NDArray[np.int64]:
    """The indices of the points of one strand that keep it within a tolerance.

    points   (n, 3)

    Crossings are not looked for. At least 3 points of a closed strand, and both ends of an open
    one.
    """
    chain = _Chain(
        np.asarray(points, dtype=np.float64), np.array([0, len(points)]), np.array([closed])
    )
    return np.flatnonzero(chain.significances(tolerance) > tolerance)


class _Chain:
    """All strands behind one another, the closed ones with their first point again at the end."""

    def __init__(self, points: np.ndarray, offsets: np.ndarray, closed: np.ndarray) -> None:
        self._count = len(points)
        own = []
        for begin, end, is_closed in zip(offsets[:-1], offsets[1:], closed):
            own.append(np.arange(begin, end))
            if is_closed and end > begin:
                own.append([begin])
        self._own = np.concatenate(own).astype(np.int64) if own else np.empty(0, np.int64)
        self._points = points[self._own]
        sizes = np.diff(offsets) + (closed & (np.diff(offsets) > 0))
        self._strand = np.repeat(np.arange(len(closed)), sizes)
        self._closed = closed
        self._first = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)

    def significances(self, floor: float) -> NDArray[np.float64]:
        """For every point the tolerance up to which it stays; those that always do have infinity.

        floor   tolerances below are of no interest: points that would go at them have 0
        """
        found = np.zeros(len(self._own))
        begins, ends = [], []
        for strand, (begin, end) in enumerate(zip(self._first[:-1], self._first[1:] - 1)):
            if end < begin:
                continue
            least = 3 if self._closed[strand] else 1
            parts = max(least, -(-(end - begin) // _PART))
            cuts = np.unique(begin + (end - begin) * np.arange(parts + 1) // parts)
            found[cuts] = np.inf
            begins.append(cuts[:-1])
            ends.append(cuts[1:])
        if not begins:
            return np.zeros(self._count)
        begin, end = np.concatenate(begins), np.concatenate(ends)
        above = np.full(len(begin), np.inf)
        while len(begin):
            begin, end, above = _longer_than_one(begin, end, above)
            if not len(begin):
                break
            worst, distance = _farthest(self._points, begin, end)
            split = distance > floor
            begin, end, worst = begin[split], end[split], worst[split]
            above = np.minimum(above[split], distance[split])
            found[worst] = above
            begin, end = np.concatenate([begin, worst]), np.concatenate([worst, end])
            order = np.argsort(begin, kind="stable")
            begin, end, above = begin[order], end[order], np.concatenate([above, above])[order]
        own = np.zeros(self._count)
        np.maximum.at(own, self._own, found)
        return own

    def uncrossed(self, kept: np.ndarray) -> NDArray[np.bool_]:
        """What is kept, and the points that have to be added so that nothing crosses."""
        here = kept[self._own]
        changed = None
        while True:
            at = np.flatnonzero(here)
            same = self._strand[at[1:]] == self._strand[at[:-1]]
            begin, end = at[:-1][same], at[1:][same]
            worst, deviation = np.zeros(len(begin), np.int64), np.zeros(len(begin))
            long = end - begin > 1
            if long.any():
                worst[long], deviation[long] = _farthest(self._points, begin[long], end[long])
            new = np.ones(len(begin), bool) if changed is None else changed[begin] | changed[end]
            near = self._too_near(begin, end, deviation, new)
            near = near[deviation[near] > 0.0]
            if not len(near):
                break
            here[worst[near]] = True
            changed = np.zeros(len(here), dtype=bool)
            changed[worst[near]] = True
        result = np.zeros(self._count, dtype=bool)
        result[self._own[here]] = True
        return result

    def _too_near(
        self, begin: np.ndarray, end: np.ndarray, deviation: np.ndarray, new: np.ndarray
    ) -> NDArray[np.int64]:
        """Chords whose tube touches that of another which does not follow or precede it.

        new   the chords that were not asked about before
        """
        first, second = pairs_within(self._points[begin], self._points[end], deviation, new)
        own = self._own
        joined = (own[begin[first]] == own[end[second]]) | (own[begin[second]] == own[end[first]])
        return np.unique(np.concatenate([first[~joined], second[~joined]]))


def _longer_than_one(begin: np.ndarray, end: np.ndarray, above: np.ndarray) -> tuple:
    long = end - begin > 1
    return begin[long], end[long], above[long]


def _farthest(
    points: np.ndarray, begin: np.ndarray, end: np.ndarray
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """For each span the point between its ends that is farthest from their chord, and how far.

    begin, end   the spans, at least two apart
    """
    counts = end - begin - 1
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
    span = np.repeat(np.arange(len(begin)), counts)
    inner = np.arange(len(span)) - starts[span] + begin[span] + 1
    chord = points[end] - points[begin]
    square = np.einsum("nk,nk->n", chord, chord)
    inverse = np.divide(1.0, square, out=np.zeros_like(square), where=square > 0.0)
    away = points[inner] - points[begin][span]
    along = chord[span]
    share = np.clip(np.einsum("nk,nk->n", away, along) * inverse[span], 0.0, 1.0)
    away -= share[:, None] * along
    squares = np.einsum("nk,nk->n", away, away)
    greatest = np.maximum.reduceat(squares, starts)
    at = np.flatnonzero(squares == greatest[span])
    first = np.concatenate([[True], np.diff(span[at]) > 0])
    return inner[at[first]], np.sqrt(greatest)
