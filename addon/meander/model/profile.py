# SPDX-License-Identifier: GPL-3.0-or-later
"""Tilt and radius of a curve's points: a profile that lies on the surface, and its size; no bpy."""

from __future__ import annotations

import numpy as np

from .geometry.blocks import blocks

# Blender's own limit in its Z-Up frames: a direction this near to the axis has no up.
_VERTICAL = 1e-4
# The radius is clamped to these, however wide the gaps beside the curve are.
_LEAST, _MOST = 0.25, 2.0


def radius_factors(radii: np.ndarray, radius: float) -> np.ndarray:
    """Radius of every point: the mean of r+ and r- (n, 2), in units of half the nominal spacing."""
    return np.clip(np.asarray(radii).mean(axis=1) / radius, _LEAST, _MOST)


def tilts(points: np.ndarray, normals: np.ndarray, cyclic: bool) -> np.ndarray:
    """The tilt of every point that turns Blender's Z-Up frame so that X is the surface normal.

    points, normals  (n, 3), in the curve's own space, of any kind; normals need no unit length
    """
    angles = np.empty(len(points))
    for begin, end in blocks(len(points)):
        # Millions of points: a row for each axis is three times as fast as one for each point.
        tangents = _directions(points, begin, end, cyclic)
        up = _up(tangents)
        # Blender's frame has Z against the tangent, so X is the normal where Y is this.
        across = _cross(_rows(normals[begin:end]), tangents)
        across = _unit(across, out=up.copy())
        sine = _dot(_cross(up, across), tangents)
        np.arctan2(sine, _dot(up, across), out=angles[begin:end])
    # No turns of more than half a circle between neighbours: what blends them is short.
    return np.unwrap(angles)


def directions(points: np.ndarray, cyclic: bool) -> np.ndarray:
    """Unit directions at the points, as Blender has them: halving the angle of both pieces."""
    return _directions(points, 0, len(points), cyclic).T


# Below, vectors are columns (3, n).


def _directions(points: np.ndarray, begin: int, end: int, cyclic: bool) -> np.ndarray:
    """Those at the points from `begin` to `end`."""
    count = len(points)
    places = np.arange(begin - 1, end + 1)
    places = places % count if cyclic and count else np.clip(places, 0, max(0, count - 1))
    around = _rows(points[places])
    pieces = _unit(around[:, 1:] - around[:, :-1])
    if not cyclic:
        if begin == 0:
            pieces[:, 0] = pieces[:, min(1, end)]
        if end == count:
            pieces[:, -1] = pieces[:, max(-2, -end - 1)]
    return _unit(pieces[:, 1:] + pieces[:, :-1])


def _rows(vectors: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(np.asarray(vectors, dtype=np.float64).T)


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.stack(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )


def _unit(vectors: np.ndarray, out: np.ndarray | None = None) -> np.ndarray:
    """out   what stays where there is no direction; None: zeros"""
    lengths = np.sqrt(_dot(vectors, vectors))
    out = np.zeros_like(vectors) if out is None else out
    return np.divide(vectors, lengths, out=out, where=lengths > 0.0)


def _up(tangents: np.ndarray) -> np.ndarray:
    """The Y axis of the Z-Up frame: as near to the Z axis as it can be."""
    x, y, z = tangents
    up = _unit(np.stack([-x * z, -y * z, 1.0 - z * z]))
    vertical = np.abs(x) + np.abs(y) < _VERTICAL
    up[:, vertical] = [[0.0], [1.0], [0.0]]
    up[:, vertical & (z > 0.0)] = [[0.0], [-1.0], [0.0]]
    return up
