# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions on a surface, read from Blender data: one vector in world space per vertex."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

from . import blender_data
from .blender_data import DataError

AXES = ("x", "y", "z")


def attribute_directions(
    surface_object: bpy.types.Object, depsgraph: bpy.types.Depsgraph, name: str
) -> NDArray[np.float64]:
    """A vector attribute of the points of the evaluated mesh, (n, 3), turned into world space.

    Raises DataError for an attribute that is not there, or is not a vector per point.
    """
    with blender_data.surface_mesh(surface_object, depsgraph) as (mesh, matrix):
        attribute = mesh.attributes.get(name)
        if attribute is None:
            raise DataError(
                f"'{surface_object.name}' has no attribute '{name}'; choose a vector attribute of "
                "its points"
            )
        if attribute.domain != "POINT" or attribute.data_type != "FLOAT_VECTOR":
            raise DataError(
                f"the attribute '{name}' of '{surface_object.name}' is {attribute.data_type} per "
                f"{attribute.domain}; directions need FLOAT_VECTOR per POINT"
            )
        values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
        attribute.data.foreach_get("vector", values)
    return values.reshape(-1, 3).astype(np.float64) @ matrix[:3, :3].T


def axis_direction(
    surface_object: bpy.types.Object, depsgraph: bpy.types.Depsgraph, axis: str
) -> NDArray[np.float64]:
    """One of the object's own AXES in world space, (3,)."""
    with blender_data.surface_mesh(surface_object, depsgraph) as (_mesh, matrix):
        return np.array(matrix[:3, AXES.index(axis)], dtype=np.float64)
