# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat strands as few straight lines and arcs of circles within a tolerance; numpy only, no bpy."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

# No arc turns by more than this: controllers and readers take half circles in different ways.
_MOST_TURN = 0.9 * np.pi

# How near to an arc its chords have to be at most, of its radius.
_LEAST_SAG = 1e-6


class Moves(NamedTuple):
    """A way of lines and arcs from a start; of a closed strand the last one ends at the start.

    start    (2,)
    ends     (k, 2)
    centres  (k, 2) of arcs; NaN of lines
    turns    (k,) angles of arcs, counter-clockwise positive; 0 of lines
    """

    start: NDArray[np.float64]
    ends: NDArray[np.float64]
    centres: NDArray[np.float64]
    turns: NDArray[np.float64]

    @property
    def bulges(self) -> NDArray[np.float64]:
        """Tangents of a quarter of the angles, as DXF has them."""
        return np.tan(self.turns / 4.0)

    @property
    def radii(self) -> NDArray[np.float64]:
        return np.linalg.norm(self.ends - self.centres, axis=1)

    def flattened(self, tolerance: float) -> NDArray[np.float64]:
        """Points on the way, (n, 2), whose chords are within a tolerance of its arcs, or within a
        millionth of their radius."""
        places = [self.start[None]]
        at = self.start
        for end, centre, turn in zip(self.ends, self.centres, self.turns):
            if turn != 0.0:
                radius = float(np.linalg.norm(end - centre))
                beside = min(1.0, max(tolerance / radius, _LEAST_SAG))
                step = 2.0 * np.arccos(1.0 - beside)
                count = max(2, int(np.ceil(abs(turn) / step)))
                first = np.arctan2(*(at - centre)[::-1])
                angles = first + turn * np.arange(1, count) / count
                places.append(centre + radius * np.column_stack([np.cos(angles), np.sin(angles)]))
            places.append(end[None])
            at = end
        return np.concatenate(places)


def fitted(way: NDArray[np.float64], tolerance: float) -> Moves:
    """Lines and arcs through some points of a polyline (n, 2), at least 2, each as long as keeps
    it and the points that it replaces within `tolerance` of each other.

    Of a closed strand the first point stands at the end again.
    """
    ends, centres, turns = [], [], []
    at, last = 0, len(way) - 1
    while at < last:
        line = _farthest(way, at, lambda end, at=at: _line_fits(way[at : end + 1], tolerance))
        arc = _farthest(way, at, lambda end, at=at: _arc(way[at : end + 1], tolerance) is not None)
        if arc > line:
            centre, turn = _arc(way[at : arc + 1], tolerance)
        else:
            centre, turn = np.full(2, np.nan), 0.0
        at = max(arc, line)
        ends.append(way[at])
        centres.append(centre)
        turns.append(turn)
    return Moves(way[0], np.array(ends), np.array(centres), np.array(turns))


def _farthest(way: np.ndarray, at: int, fits) -> int:
    """The last point that a move from `at` reaches: doubled, then halved into place."""
    last = len(way) - 1
    good, step = at + 1, 2
    while at + step <= last and fits(at + step):
        good, step = at + step, 2 * step
    bad = min(at + step, last + 1)
    while bad - good > 1:
        middle = (good + bad) // 2
        good, bad = (middle, bad) if fits(middle) else (good, middle)
    return good


def _line_fits(points: np.ndarray, tolerance: float) -> bool:
    along = points[-1] - points[0]
    length = float(np.hypot(*along))
    if not length > 0.0:
        return False
    along = along / length
    away = points - points[0]
    share = away @ along
    off = np.abs(away[:, 0] * along[1] - away[:, 1] * along[0])
    return bool(off.max() <= tolerance and (np.diff(share) >= 0.0).all())


def _arc(points: np.ndarray, tolerance: float) -> tuple[np.ndarray, float] | None:
    """Centre and angle of the arc from the first point to the last that is near the others."""
    if len(points) < 3:
        return None
    a, b = points[0], points[-1]
    chord = b - a
    length = float(np.hypot(*chord))
    if not length > 0.0:
        return None
    across = np.array([-chord[1], chord[0]]) / length
    half, middle = length / 2.0, (a + b) / 2.0
    away = points[1:-1] - middle
    # The circle through both ends and q has its centre at h across the chord, where
    # |q|^2 - half^2 = 2 h (q . across); one circle for all in the sense of least squares.
    height = away @ across
    square = float(height @ height)
    if not square > 0.0:
        return None
    h = float(height @ ((away * away).sum(axis=1) - half * half)) / (2.0 * square)
    radius = float(np.hypot(h, half))
    centre = middle + h * across
    seen = points - centre
    angles = np.unwrap(np.arctan2(seen[:, 1], seen[:, 0]))
    turn = float(angles[-1] - angles[0])
    steps = np.diff(angles) * np.sign(turn)
    if not 0.0 < abs(turn) <= _MOST_TURN or (steps <= 0.0).any():
        return None
    off = np.abs(np.hypot(seen[:, 0], seen[:, 1]) - radius)
    # Between two points the arc is off its chord by this.
    sag = radius * (1.0 - np.cos(steps.max() / 2.0))
    return (centre, turn) if off.max() + sag <= tolerance else None
