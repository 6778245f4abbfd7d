# SPDX-License-Identifier: GPL-3.0-or-later
"""Points from an object's own space to the world and back.

Everything leaves Blender in world units, because the spacing that users choose is the one that they
see. Arrays are computed in float64; only what is stored in Blender is rounded to float32.
"""

from __future__ import annotations

import bpy
import numpy as np

from ..model.geometry.blocks import blocks
from .errors import DataError


def world_matrix(object: bpy.types.Object) -> np.ndarray:
    """The object's matrix_world as float64 (4, 4).

    Row by row, since np.array(matrix) is float32 in Blender 5.0 and later.
    """
    return np.array([row[:] for row in object.matrix_world], dtype=np.float64)


def to_world(points: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Local points (n, 3) to world, in float64."""
    return np.asarray(points, dtype=np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def to_local(points: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """World points (n, 3) to the space of `matrix`, in float64."""
    points = np.asarray(points)
    local = np.empty(points.shape)
    for begin, end in blocks(len(points)):
        away = points[begin:end] - matrix[:3, 3]
        local[begin:end] = np.linalg.solve(matrix[:3, :3], away.T).T
    return local


def mean_scale(matrix: np.ndarray) -> float:
    """By how much the matrix enlarges lengths, averaged over the three axes."""
    return float(abs(np.linalg.det(matrix[:3, :3])) ** (1.0 / 3.0))


def check_invertible(object: bpy.types.Object, matrix: np.ndarray) -> None:
    if not np.isfinite(matrix).all():  # as a driver or a constraint leaves it
        raise DataError(
            f"'{object.name}' has a location, rotation or scale that is not a finite number; "
            "correct it in the Item tab, or the driver that sets it"
        )
    # Condition number, not determinant: a mesh in micrometres is fine, a flattened one is not.
    if np.linalg.cond(matrix[:3, :3]) > 1e6:
        raise DataError(
            f"'{object.name}' is scaled to nothing along an axis; give it a scale other than 0"
        )
