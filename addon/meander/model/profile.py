# SPDX-License-Identifier: GPL-3.0-or-later
"""Tilt and radius of a curve's points: a profile that lies on the surface, and its size; no bpy."""

from __future__ import annotations

import numpy as np

# Blender's own limit in its Z-Up frames: a direction this near to the axis has no up.
_VERTICAL = 1e-4
# The radius is clamped to these, however wide the gaps beside the curve are.
_LEAST, _MOST = 0.25, 2.0


def radius_factors(radii: np.ndarray, radius: float) -> np.ndarray:
    """Radius of every point: the mean of r+ and r- (n, 2), in units of half the nominal spacing."""
    return np.clip(np.asarray(radii).mean(axis=1) / radius, _LEAST, _MOST)


def tilts(points: np.ndarray, normals: np.ndarray, cyclic: bool) -> np.ndarray:
    """The tilt of every point that turns Blender's Z-Up frame so that X is the surface normal.

    points, normals  (n, 3), in the curve's own space; normals need no unit length
    """
    # Millions of points: a row for each axis is three times as fast as one for each point.
    tangents = _directions(_rows(points), cyclic)
    up = _up(tangents)
    # Blender's frame has Z against the tangent, so X is the normal where Y is this.
    across = _cross(_rows(normals), tangents)
    across = _unit(across, out=up.copy())
    sine = _dot(_cross(up, across), tangents)
    # No turns of more than half a circle between neighbours: what blends them is short.
    return np.unwrap(np.arctan2(sine, _dot(up, across)))


def directions(points: np.ndarray, cyclic: bool) -> np.ndarray:
    """Unit directions at the points, as Blender has them: halving the angle of both pieces."""
    return _directions(_rows(points), cyclic).T


# Below, vectors are columns (3, n).


def _directions(points: np.ndarray, cyclic: bool) -> np.ndarray:
    pieces = _unit(np.roll(points, -1, axis=1) - points)
    before = np.roll(pieces, 1, axis=1)
    if not cyclic:
        pieces[:, -1] = before[:, -1]
        before[:, 0] = pieces[:, 0]
    return _unit(pieces + before)


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
