# SPDX-License-Identifier: GPL-3.0-or-later
"""The spacing where nobody chose one."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray


def spacing_for(area: float) -> float:
    """1/30 of the side of a square of this area, rounded to two digits: it shows the shape, and is
    filled in seconds. 1 where the area is none."""
    if not (math.isfinite(area) and area > 0.0):
        return 1.0
    return float(f"{math.sqrt(area) / 30.0:.1e}")


def area_of(vertices: NDArray[np.float64], faces: NDArray[np.integer]) -> float:
    """The area of triangles (m, 3), in square units of the vertices (n, 3)."""
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0)


def automatic_spacing(vertices: NDArray[np.float64], faces: NDArray[np.integer]) -> float:
    """The spacing of triangles where nobody chose one; see spacing_for.

    Faces that name vertices which are not there are for the library to refuse: 1 then.
    """
    if len(faces) == 0 or faces.max() >= len(vertices):
        return 1.0
    return spacing_for(area_of(vertices, faces))
