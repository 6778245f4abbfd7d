# SPDX-License-Identifier: GPL-3.0-or-later
"""The walls of a maze: what doors leave of a line, and prisms along that. Numpy only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def wall_pieces(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    gaps: list[tuple[float, float]],
) -> list[tuple[NDArray[np.float64], NDArray[np.float64], bool]]:
    """What is left of a closed line without gaps: points, normals, and whether it is closed.

    points, normals   (n, 3), the first point not repeated at the end
    gaps              the middle of each, as an arc length, and its width
    """
    ring, across = np.vstack([points, points[:1]]), np.vstack([normals, normals[:1]])
    steps = np.linalg.norm(np.diff(ring, axis=0), axis=1)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    whole = at[-1]
    if not gaps:
        return [(points, normals, True)]
    bounds = sorted(((middle - width / 2) % whole, width) for middle, width in gaps)
    pieces = []
    for (begin, width), (following, _) in zip(bounds, bounds[1:] + bounds[:1], strict=True):
        start = begin + width
        length = (following - start) % whole
        if length <= 0.0 or length > whole - width / 2.0:  # gaps that meet leave nothing between
            continue
        inner = (at[:-1] - start) % whole
        kept = np.flatnonzero((inner > 0.0) & (inner < length))
        kept = kept[np.argsort(inner[kept])]
        ends = [(start % whole), ((start + length) % whole)]
        piece = [
            np.vstack([_at(values, at, ends[0]), values[kept], _at(values, at, ends[1])])
            for values in (ring, across)
        ]
        pieces.append((piece[0], piece[1], False))
    return pieces


def bar_pieces(
    ends: NDArray[np.float64], normals: NDArray[np.float64], gap: float
) -> list[tuple[NDArray[np.float64], NDArray[np.float64], bool]]:
    """A straight wall between two points, as wall_pieces() has it, with a gap in its middle.

    ends, normals   (2, 3)
    gap             how wide; 0: none
    """
    share = (1.0 - gap / max(float(np.linalg.norm(ends[1] - ends[0])), 1e-300)) / 2.0
    if share <= 0.0:
        return []
    places = [(0.0, share), (1.0 - share, 1.0)] if gap > 0.0 else [(0.0, 1.0)]
    return [
        tuple(np.array([(1.0 - t) * both[0] + t * both[1] for t in place])
              for both in (ends, normals)) + (False,)
        for place in places
    ]  # fmt: skip


def _at(values: NDArray[np.float64], at: NDArray[np.float64], place: float) -> NDArray[np.float64]:
    """Values between those of points, at an arc length."""
    return np.array([np.interp(place, at, values[:, axis]) for axis in range(3)])


def wall(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    closed: bool,
    width: float,
    height: float,
    depth: float,
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """A wall along a line: vertices (4 n, 3) and faces (f, 4), watertight, facing outward.

    points, normals   (n, 3), of the line and of the surface below it
    depth             how far the wall goes on below the surface
    """
    count = len(points)
    if closed:
        tangents = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    else:
        tangents = np.gradient(points, axis=0)
    up = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    left = np.cross(up, tangents)
    left /= np.linalg.norm(left, axis=1, keepdims=True)
    half, low, high = width / 2.0 * left, -depth * up, height * up
    rows = [points + half + low, points + half + high, points - half + high, points - half + low]
    vertices = np.stack(rows, axis=1).reshape(-1, 3)
    here = 4 * np.arange(count if closed else count - 1)
    there = (here + 4) % (4 * count)
    sides = [
        np.column_stack([here + a, here + b, there + b, there + a])
        for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))
    ]
    if not closed:
        last = 4 * (count - 1)
        sides += [np.array([[3, 2, 1, 0]]), np.array([[last, last + 1, last + 2, last + 3]])]
    return vertices, np.vstack(sides)
