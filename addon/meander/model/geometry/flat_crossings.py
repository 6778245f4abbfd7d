# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a flat drawing crosses itself; numpy only, no bpy."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .near_chords import pairs_within

# Segments this near to each other, as a share of the drawing's size, are looked at: rounding of the
# search is far below it.
_NEAR = 1e-9


def segments_of(
    ways: Sequence[NDArray[np.float64]], closed: Sequence[bool]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Begins and ends (n, 2) of the segments of polylines, and the polyline of each."""
    begins, ends, owners = [], [], []
    for number, (way, is_closed) in enumerate(zip(ways, closed, strict=True)):
        flat = np.asarray(way, dtype=np.float64)[:, :2]
        after = np.roll(flat, -1, axis=0) if is_closed else flat[1:]
        begins.append(flat[: len(after)])
        ends.append(after)
        owners.append(np.full(len(after), number))
    if not begins:
        return np.empty((0, 2)), np.empty((0, 2)), np.empty(0, np.int64)
    return np.concatenate(begins), np.concatenate(ends), np.concatenate(owners)


def crossings(
    begin: NDArray[np.float64], end: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """The pairs of segments (n, 2) that cross within both, and the places where they do, (k, 2).

    Segments that only touch, such as neighbours on one line, do not cross.
    """
    nothing = np.empty(0, np.int64)
    if len(begin) < 2:
        return nothing, nothing, np.empty((0, 2))
    low = np.minimum(begin.min(axis=0), end.min(axis=0))
    size = float((np.maximum(begin.max(axis=0), end.max(axis=0)) - low).max())
    if not size > 0.0:
        return nothing, nothing, np.empty((0, 2))
    flat = [np.column_stack([points - low, np.zeros(len(points))]) for points in (begin, end)]
    reach = np.full(len(begin), _NEAR * size)
    first, second = pairs_within(*flat, reach, np.ones(len(begin), dtype=bool))
    pairs = np.unique(np.column_stack([first, second]), axis=0)
    first, second = pairs[:, 0], pairs[:, 1]
    a, b, c, d = begin[first] - low, end[first] - low, begin[second] - low, end[second] - low
    cross, share = crossing_shares(a, b, c, d)
    places = a + share[:, None] * (b - a) + low
    return first[cross], second[cross], places[cross]


def crossing_shares(
    a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64], d: NDArray[np.float64]
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Whether the segments a b and c d, (n, 2) each, cross within both, and where on a b."""
    one, other = _side(a, b, c), _side(a, b, d)
    three, four = _side(c, d, a), _side(c, d, b)
    cross = (one * other < 0) & (three * four < 0)
    return cross, np.divide(three, three - four, out=np.zeros(len(three)), where=cross)


def _side(a: np.ndarray, b: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Twice the area of a b p; 0 where it is no more than its rounding."""
    u, v = b - a, p - a
    one, other = u[:, 0] * v[:, 1], u[:, 1] * v[:, 0]
    area = one - other
    return np.where(np.abs(area) > 1e-12 * (np.abs(one) + np.abs(other)), area, 0.0)
