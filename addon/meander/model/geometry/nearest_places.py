# SPDX-License-Identifier: GPL-3.0-or-later
"""Where sets of points come nearest to each other, and the tree that joins them all. No bpy.

Points are taken in blocks, of which most are too far away to be looked at: points that follow each
other on a curve are near to each other.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

_BLOCK = 64


class Tree:
    """Which of `count` things are joined already."""

    def __init__(self, count: int) -> None:
        self._above = list(range(count))

    def root(self, thing: int) -> int:
        while self._above[thing] != thing:
            self._above[thing] = self._above[self._above[thing]]
            thing = self._above[thing]
        return thing

    def join(self, one: int, other: int) -> bool:
        """Joins two things; False where they were joined already."""
        one, other = self.root(one), self.root(other)
        self._above[max(one, other)] = min(one, other)
        return one != other


def closest_pair(one: NDArray[np.float64], other: NDArray[np.float64]) -> tuple[int, int, float]:
    """The nearest two of points (n, 3) and (m, 3), and their distance; of several such pairs the
    first."""
    mine, theirs = _boxes(one), _boxes(other)
    bounds = _apart(*mine, *theirs)
    best, found = np.inf, (0, 0)
    width = bounds.shape[1]
    for pair in np.argsort(bounds, axis=None, kind="stable").tolist():
        i, j = divmod(pair, width)
        if bounds[i, j] > best:
            break
        here = one[i * _BLOCK : (i + 1) * _BLOCK]
        there = other[j * _BLOCK : (j + 1) * _BLOCK]
        distances = np.linalg.norm(here[:, None] - there[None], axis=2)
        least = int(np.argmin(distances))
        a, b = divmod(least, len(there))
        place = (i * _BLOCK + a, j * _BLOCK + b)
        if (distances[a, b], place) < (best, found) or best == np.inf:
            best, found = float(distances[a, b]), place
    return found[0], found[1], best


def spanning_tree(
    sets: Sequence[NDArray[np.float64]], together: Sequence[tuple[int, int]] = ()
) -> list[tuple[int, int]]:
    """The pairs of sets that join all of them with the least distance in all, the nearest first;
    the distance of two sets is that of their nearest points.

    sets       points (n, 3) each, at least one
    together   pairs that are joined already
    """
    tree = Tree(len(sets))
    for one, other in together:
        tree.join(one, other)
    low = np.array([points.min(axis=0) for points in sets])
    high = np.array([points.max(axis=0) for points in sets])
    first, second = np.triu_indices(len(sets), 1)
    gaps = np.maximum(0.0, np.maximum(low[first] - high[second], low[second] - high[first]))
    bounds = np.linalg.norm(gaps, axis=1)
    # What is known of a pair's distance, least first: a bound until the pair is looked at.
    waiting = [
        (bound, False, a, b)
        for bound, a, b in zip(bounds.tolist(), first.tolist(), second.tolist(), strict=True)
    ]
    heapq.heapify(waiting)
    pairs = []
    while waiting:
        distance, exact, one, other = heapq.heappop(waiting)
        if tree.root(one) == tree.root(other):
            continue
        if exact:
            tree.join(one, other)
            pairs.append((one, other))
        else:
            distance = closest_pair(sets[one], sets[other])[2]
            heapq.heappush(waiting, (distance, True, one, other))
    return pairs


def _boxes(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    begins = np.arange(0, len(points), _BLOCK)
    low = np.minimum.reduceat(points, begins, axis=0)
    high = np.maximum.reduceat(points, begins, axis=0)
    return low, high


def _apart(
    low: NDArray[np.float64],
    high: NDArray[np.float64],
    other_low: NDArray[np.float64],
    other_high: NDArray[np.float64],
) -> NDArray[np.float64]:
    """How far each box is from each other one, (n, m)."""
    square = np.zeros((len(low), len(other_low)))
    for axis in range(3):
        gap = np.maximum(
            low[:, None, axis] - other_high[None, :, axis],
            other_low[None, :, axis] - high[:, None, axis],
        )
        square += np.maximum(gap, 0.0) ** 2
    return np.sqrt(square)
