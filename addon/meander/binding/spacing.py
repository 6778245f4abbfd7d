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


def spacing_for(area: float) -> float:
    """1/30 of the side of a square of this area, rounded to two digits: it shows the shape, and is
    filled in seconds. 1 where the area is none."""
    if not (math.isfinite(area) and area > 0.0):
        return 1.0
    return float(f"{math.sqrt(area) / 30.0:.1e}")


def area_of(vertices: NDArray[np.float64], faces: NDArray[np.integer]) -> float:
    """The area of triangles (m, 3), in square units of the vertices (n, 3)."""
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    with np.errstate(all="ignore"):  # of coordinates that are not finite, or whose products are not
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0)


def automatic_spacing(vertices: ArrayLike | Any, faces: ArrayLike | None = None) -> float:
    """The spacing of triangles where nobody chose one; see spacing_for.

    vertices, faces   as for Surface

    Faces that name vertices which are not there are for the library to refuse: 1 then.
    """
    vertices, faces = mesh_arrays(vertices, faces)
    if len(faces) == 0 or faces.max() >= len(vertices):
        return 1.0
    area = area_of(vertices, faces)
    if math.isfinite(area) and area > _LEAST_AREA:
        return spacing_for(area)
    # Squares of very large and very small coordinates are no doubles; their ratios are.
    with np.errstate(all="ignore"):
        corners = vertices[faces]
        size = float(np.abs(corners - corners[0, 0]).max())
    if not (math.isfinite(size) and size > 0.0):
        return 1.0
    area = area_of(vertices / size, faces)
    return float(f"{size * math.sqrt(area) / 30.0:.1e}") if area > 0.0 else 1.0
