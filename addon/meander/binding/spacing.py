# SPDX-License-Identifier: GPL-3.0-or-later
"""The spacing where nobody chose one."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .elsewhere import mesh_arrays

# Smaller areas have lost digits.
_LEAST_AREA = 1e-290
# A sheet whose parts are narrower than this in the mean, in spacings, is one of stems, as a text.
_OF_STEMS = 6.0
# Two strands leave the fewest gaps in a stem of so many spacings, where stems meet and end too.
_STEM = 1.6
# Vertices that are this near, as a share of the size of all, are in the same place.
_SAME_PLACE = 1e-6
# So many faces are measured at a time: what numpy makes of them stays in the processor's cache.
_BLOCK = 1 << 13


def spacing_for(area: float) -> float:
    """1/30 of the side of a square of this area, rounded to two digits: it shows the shape, and is
    filled in seconds. 1 where the area is none."""
    if not (math.isfinite(area) and area > 0.0):
        return 1.0
    return float(f"{math.sqrt(area) / 30.0:.1e}")


def area_of(vertices: NDArray[np.float64], faces: NDArray[np.integer]) -> float:
    """The area of triangles (m, 3), in square units of the vertices (n, 3)."""
    doubled = np.empty(len(faces))
    with np.errstate(all="ignore"):  # of coordinates that are not finite, or whose products are not
        for begin in range(0, len(faces), _BLOCK):
            some = slice(begin, begin + _BLOCK)
            a, b, c = vertices[faces[some].T]
            doubled[some] = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        return float(doubled.sum() / 2.0)


def boundary_of(vertices: NDArray[np.float64], faces: NDArray[np.integer]) -> float:
    """How long the edges are together that only one of the triangles (m, 3) has."""
    ends = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64), axis=1)
    keys, count = np.unique(ends[:, 0] * len(vertices) + ends[:, 1], return_counts=True)
    first, second = np.divmod(keys[count == 1], len(vertices))
    return float(np.linalg.norm(vertices[first] - vertices[second], axis=1).sum())


def _joined(vertices: NDArray[np.float64], faces: NDArray[np.integer]) -> NDArray[np.int64]:
    """The faces by one vertex for all that are in the same place: what is extruded has seams."""
    grain = max(_SAME_PLACE * float(np.ptp(vertices, axis=0).max()), np.finfo(float).tiny)
    steps = np.rint((vertices - vertices.min(axis=0)) / grain)
    _, first, place = np.unique(steps, axis=0, return_index=True, return_inverse=True)
    return first[place.ravel()][faces]


def _for_stems(
    spacing: float, area: float, vertices: NDArray[np.float64], faces: NDArray[np.integer]
) -> float:
    """This spacing, or that which stems have room for: their mean width is twice the area over the
    length of the boundary."""
    boundary = 0.0
    for find in (lambda: faces, lambda: _joined(vertices, faces)):  # which takes longer
        boundary = boundary_of(vertices, find())
        if not _STEM * spacing * boundary < 2.0 * area < _OF_STEMS * spacing * boundary:
            return spacing
    return float(f"{2.0 * area / (_STEM * boundary):.1e}")


def automatic_spacing(vertices: ArrayLike | Any, faces: ArrayLike | None = None) -> float:
    """The spacing of triangles where nobody chose one: see spacing_for; on a sheet of stems, as the
    letters of a text are, that of two strands in each.

    vertices, faces   as for Surface

    Faces that name vertices which are not there are for the library to refuse: 1 then.
    """
    vertices, faces = mesh_arrays(vertices, faces)
    if len(faces) == 0 or faces.max() >= len(vertices):
        return 1.0
    area = area_of(vertices, faces)
    if math.isfinite(area) and area > _LEAST_AREA:
        return _for_stems(spacing_for(area), area, vertices, faces)
    # Squares of very large and very small coordinates are no doubles; their ratios are.
    with np.errstate(all="ignore"):
        corners = vertices[faces]
        size = float(np.abs(corners - corners[0, 0]).max())
    if not (math.isfinite(size) and size > 0.0):
        return 1.0
    area = area_of(vertices / size, faces)
    return float(f"{size * math.sqrt(area) / 30.0:.1e}") if area > 0.0 else 1.0
