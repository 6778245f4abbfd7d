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
    tangents = directions(points, cyclic)
    up = _up(tangents)
    # Blender's frame has Z against the tangent, so X is the normal where Y is this.
    across = np.cross(normals, tangents)
    lengths = np.linalg.norm(across, axis=1, keepdims=True)
    across = np.divide(across, lengths, out=up.copy(), where=lengths > 0.0)
    sine = (np.cross(up, across) * tangents).sum(axis=1)
    cosine = (up * across).sum(axis=1)
    # No turns of more than half a circle between neighbours: what blends them is short.
    return np.unwrap(np.arctan2(sine, cosine))


def directions(points: np.ndarray, cyclic: bool) -> np.ndarray:
    """Unit directions at the points, as Blender has them: halving the angle of both pieces."""
    pieces = _unit(np.roll(points, -1, axis=0) - points)
    before = np.roll(pieces, 1, axis=0)
    if not cyclic:
        pieces[-1] = before[-1]
        before[0] = pieces[0]
    return _unit(pieces + before)


def _unit(vectors: np.ndarray) -> np.ndarray:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, lengths, out=np.zeros_like(vectors), where=lengths > 0.0)


def _up(tangents: np.ndarray) -> np.ndarray:
    """The Y axis of the Z-Up frame: as near to the Z axis as it can be."""
    z = tangents[:, 2]
    up = np.column_stack([-tangents[:, 0] * z, -tangents[:, 1] * z, 1.0 - z * z])
    vertical = np.abs(tangents[:, 0]) + np.abs(tangents[:, 1]) < _VERTICAL
    up = _unit(up)
    up[vertical] = [0.0, 1.0, 0.0]
    up[vertical & (z > 0.0)] = [0.0, -1.0, 0.0]
    return up
