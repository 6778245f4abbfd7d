# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed bodies whose faces show inwards; numpy only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def inside_out(vertices: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Which triangles belong to closed bodies with a negative volume, (m,).

    A body is what hangs together by its corners; one that is open, or whose faces do not all show
    to the same side, has no volume and is none of these.
    """
    if not len(faces) or faces.max() >= len(vertices) or not np.isfinite(vertices).all():
        return np.zeros(len(faces), dtype=bool)  # for the library to refuse
    body = bodies(faces, len(vertices))[faces[:, 0]]
    ways = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    there = ways[:, 0] * len(vertices) + ways[:, 1]
    back = ways[:, 1] * len(vertices) + ways[:, 0]
    _values, place, counts = np.unique(there, return_inverse=True, return_counts=True)
    # Every edge is gone along once in either direction.
    whole = (counts[place] == 1) & np.isin(back, there)
    is_open = np.bincount(np.tile(body, 3), weights=~whole, minlength=len(vertices)) > 0.0
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    # From a corner of the body, so that a place far away costs no digits.
    here = vertices[body]
    volumes = np.einsum("ij,ij->i", a - here, np.cross(b - here, c - here))
    inward = np.bincount(body, weights=volumes, minlength=len(vertices)) < 0.0
    return (inward & ~is_open)[body]


def bodies(faces: NDArray[np.integer], count: int) -> NDArray[np.int64]:
    """For every vertex the least one that it hangs together with."""
    labels = np.arange(count)
    while True:
        found = labels.copy()
        np.minimum.at(found, faces, labels[faces].min(axis=1, keepdims=True))
        found = found[found]
        if (found == labels).all():
            return labels
        labels = found
