# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender keeps of each element of a collection, read as one array."""

from __future__ import annotations

import bpy
import numpy as np


def column(
    rows: bpy.types.bpy_prop_collection, name: str, width: int = 1, kind: type = np.float32
) -> np.ndarray:
    """One property of every element: (n,), or (n, width) of vectors.

    kind   as Blender stores it: values of another one are converted one at a time
    """
    values = np.empty(width * len(rows), dtype=kind)
    rows.foreach_get(name, values)
    return values if width == 1 else values.reshape(-1, width)


def vertices_of_corners(mesh: bpy.types.Mesh) -> np.ndarray:
    return column(mesh.loops, "vertex_index", kind=np.int32)


def corner_counts(mesh: bpy.types.Mesh) -> np.ndarray:
    """How many corners each polygon has."""
    return column(mesh.polygons, "loop_total", kind=np.int32)
