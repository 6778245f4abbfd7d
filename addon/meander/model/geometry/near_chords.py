# SPDX-License-Identifier: GPL-3.0-or-later
"""Straight segments that come near one another, found by a grid of cells; numpy only, no bpy."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

# Half of the cells around a cell, and itself: each pair of cells is met once.
_STEPS = [step for step in itertools.product((-1, 0, 1), repeat=3) if step >= (0, 0, 0)]

# Pairs that are measured at a time, which bounds the memory.
_AT_ONCE = 1_000_000

# Cells are numbered by 20 bits for each axis.
_MOST_CELLS = 1 << 20


def pairs_within(
    begin: NDArray[np.float64],
    end: NDArray[np.float64],
    reach: NDArray[np.float64],
    wanted: NDArray[np.bool_],
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The pairs of segments that are no farther apart than both of their reaches together.

    begin, end   (n, 3) each
    reach        (n,), 0 or more; two segments that reach nowhere are no pair
    wanted       (n,), pairs without any of these are left out
    """
    if len(begin) < 2 or not reach.any():
        return np.empty(0, np.int64), np.empty(0, np.int64)
    segment, low, high = _pieces(begin, end, reach)
    middle, half = (low + high) / 2.0, np.linalg.norm(high - low, axis=1) / 2.0 + reach[segment]
    order, keys, steps = _cells(middle, 2.0 * float(half.max()))
    firsts, seconds = [], []
    for step in steps:
        for i, j in _neighbours(keys, step):
            i, j = order[i], order[j]
            a, b = segment[i], segment[j]
            reaches = reach[a] + reach[b]
            near = (a != b) & (wanted[a] | wanted[b]) & (reaches > 0.0)
            i, j, a, b, reaches = i[near], j[near], a[near], b[near], reaches[near]
            apart = middle[i] - middle[j]
            near = np.einsum("nk,nk->n", apart, apart) <= (half[i] + half[j]) ** 2
            i, j, a, b, reaches = i[near], j[near], a[near], b[near], reaches[near]
            near = distances(low[i], high[i], low[j], high[j]) <= reaches
            firsts.append(a[near])
            seconds.append(b[near])
    first, second = np.concatenate(firsts), np.concatenate(seconds)
    return np.minimum(first, second), np.maximum(first, second)


def distances(
    a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64], d: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The distances of the segments from a to b and from c to d, (n, 3) each, pair by pair."""
    u, v, w = b - a, d - c, a - c
    uu, uv, vv = _dot(u, u), _dot(u, v), _dot(v, v)
    uw, vw = _dot(u, w), _dot(v, w)
    determinant = uu * vv - uv * uv
    crooked = determinant > 1e-12 * uu * vv
    inverse = np.divide(1.0, determinant, out=np.zeros_like(uu), where=crooked)
    s, t = (uv * vw - vv * uw) * inverse, (uu * vw - uv * uw) * inverse
    inside = crooked & (s >= 0.0) & (s <= 1.0) & (t >= 0.0) & (t <= 1.0)
    between = w + s[:, None] * u - t[:, None] * v
    squares = np.where(inside, _dot(between, between), np.inf)
    for point, low, along, square in (
        (a, c, v, vv),
        (b, c, v, vv),
        (c, a, u, uu),
        (d, a, u, uu),
    ):
        away = point - low
        share = np.divide(_dot(away, along), square, out=np.zeros_like(square), where=square > 0.0)
        away = away - np.clip(share, 0.0, 1.0)[:, None] * along
        squares = np.minimum(squares, _dot(away, away))
    return np.sqrt(squares)


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.einsum("nk,nk->n", a, b)


def _pieces(begin: np.ndarray, end: np.ndarray, reach: np.ndarray) -> tuple:
    """The segments in pieces of about their mean length, so that cells need not be large."""
    lengths = np.linalg.norm(end - begin, axis=1)
    longest = max(float(lengths.mean()), 2.0 * float(reach.max()))
    counts = np.maximum(np.ceil(lengths / longest).astype(np.int64), 1)
    segment = np.repeat(np.arange(len(begin)), counts)
    number = np.arange(len(segment)) - np.repeat(np.cumsum(counts) - counts, counts)
    along = (end - begin)[segment]
    low = begin[segment] + (number / counts[segment])[:, None] * along
    high = begin[segment] + ((number + 1) / counts[segment])[:, None] * along
    return segment, low, high


def _cells(points: np.ndarray, size: float) -> tuple[np.ndarray, np.ndarray, list[int]]:
    """The order of points by cell, the cell numbers in that order, and the steps to neighbours."""
    low = points.min(axis=0)
    size = max(size, float((points.max(axis=0) - low).max()) / (_MOST_CELLS - 4))
    cell = np.floor((points - low) / size).astype(np.int64) + 1
    number = (cell[:, 0] * _MOST_CELLS + cell[:, 1]) * _MOST_CELLS + cell[:, 2]
    order = np.argsort(number, kind="stable")
    steps = [(x * _MOST_CELLS + y) * _MOST_CELLS + z for x, y, z in _STEPS]
    return order, number[order], steps


def _neighbours(keys: np.ndarray, step: int):
    """Pairs of places in sorted cell numbers that are a step apart; of one cell, each pair once."""
    here = np.arange(len(keys))
    first = here + 1 if step == 0 else np.searchsorted(keys, keys + step, side="left")
    counts = np.searchsorted(keys, keys + step, side="right") - first
    sums = np.cumsum(counts)
    begin = 0
    while begin < len(keys):
        before = sums[begin - 1] if begin else 0
        end = max(int(np.searchsorted(sums, before + _AT_ONCE, side="right")), begin + 1)
        many = counts[begin:end]
        left = np.repeat(here[begin:end], many)
        number = np.arange(len(left)) - np.repeat(np.cumsum(many) - many, many)
        yield left, first[left] + number
        begin = end
