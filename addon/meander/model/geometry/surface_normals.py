# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals of a surface at the scale of a curve's spacing, at points in its triangles; no bpy.

As the library has them for the points of a flow (mesh/normal_field): blended over smooth meshes,
while a face beside a crease is flat, and its normals turn near its edges and corners only.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .unit_vectors import unit

# In r: a crease turns the normals of its faces up to so far from it.
_REACH = 0.5
# Cosines of how far the normal of a corner may lean on its face, where a mesh is smooth, and where
# it is creased: 10 and 20 degrees.
_SMOOTH, _CREASED = 0.985, 0.940


def normals_at(
    vertices: NDArray[np.float64],
    faces: NDArray[np.integer],
    index: NDArray[np.integer],
    weights: NDArray[np.float64],
    radius: float,
) -> NDArray[np.float64]:
    """Unit normals (n, 3).

    index, weights   (n,) and (n, 3), the triangle of each point and where in it that is
    radius           r, half the spacing, in the units of the vertices
    """
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    weighted = np.cross(b - a, c - a)
    of_vertices = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(of_vertices, faces[:, corner], weighted)
    corners = unit(of_vertices)[faces[index]]
    flat = unit(weighted)
    beside = _beside(faces)[index]
    there = np.where((beside < 0)[:, :, None], flat[index][:, None], flat[beside])
    folded = unit(flat[index][:, None] + there)

    # Of the edge opposite to each corner: how far it is, as a share of the reach.
    points = vertices[faces[index]]
    edges = np.linalg.norm(np.roll(points, -2, axis=1) - np.roll(points, -1, axis=1), axis=2)
    twice = np.linalg.norm(weighted[index], axis=1)[:, None]
    heights = np.divide(twice, edges, out=np.zeros_like(edges), where=edges > 0.0)
    away = np.clip(weights * heights / max(_REACH * radius, 1e-300), 0.0, 1.0)
    near = 1.0 - away
    total = away.prod(axis=1)[:, None] * flat[index]
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        total += (near[:, k] * away[:, i] * away[:, j])[:, None] * folded[:, k]
        total += (away[:, k] * near[:, i] * near[:, j])[:, None] * corners[:, k]
    smooth = unit(np.einsum("nk,nkx->nx", weights, corners))
    total += near.prod(axis=1)[:, None] * smooth
    upright = np.einsum("nkx,nx->nk", corners, flat[index]).min(axis=1)
    creased = np.clip((_SMOOTH - upright) / (_SMOOTH - _CREASED), 0.0, 1.0)[:, None]
    total = creased * unit(total) + (1.0 - creased) * smooth
    return unit(total, flat[index])


def _beside(faces: NDArray[np.integer]) -> NDArray[np.int64]:
    """The face beyond the edge opposite to each corner, (m, 3); -1: there is none, or several."""
    count = len(faces)
    ends = np.stack([np.roll(faces, -1, axis=1), np.roll(faces, -2, axis=1)], axis=2)
    pairs = np.sort(ends.reshape(-1, 2).astype(np.int64), axis=1)
    keys = pairs[:, 0] * (int(faces.max()) + 1) + pairs[:, 1]
    order = np.argsort(keys, kind="stable")
    _, first, times = np.unique(keys[order], return_index=True, return_counts=True)
    two = first[times == 2]
    one, other = order[two], order[two + 1]
    found = np.full(3 * count, -1, dtype=np.int64)
    found[one], found[other] = other // 3, one // 3
    return found.reshape(-1, 3)
