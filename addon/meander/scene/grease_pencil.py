# SPDX-License-Identifier: GPL-3.0-or-later
"""Strokes of Grease Pencil, as they are seen at a frame."""

from __future__ import annotations

import bpy
import numpy as np

from .blender_versions import GREASE_PENCIL, layer_matrices, strokes_of_layer
from .errors import DataError
from .evaluated import evaluated_copy, is_evaluated
from .transforms import to_world, world_matrix

Stroke = tuple[np.ndarray, bool]  # points in world units (n, 3), and whether it is cyclic


def is_grease_pencil(object: bpy.types.Object) -> bool:
    return object.type == GREASE_PENCIL


def strokes_of(object: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> list[Stroke]:
    """The strokes that a Grease Pencil object shows, in the order of its layers, lowest first.

    With modifiers, layers' own transforms and parents; what hidden layers have is left out, and so
    are strokes of one point. Works in every mode and for hidden objects.

    Raises DataError with one sentence for strokes that are Bezier or NURBS curves.
    """
    if is_evaluated(object, depsgraph):
        depsgraph.update()
        return _shown(object.evaluated_get(depsgraph), object.name)
    with evaluated_copy(object, depsgraph, with_data=False) as (copy, own):
        return _shown(copy.evaluated_get(own), object.name)


def _shown(evaluated: bpy.types.Object, name: str) -> list[Stroke]:
    found = []
    for layer in evaluated.data.layers:
        if _is_hidden(layer):
            continue
        strokes = strokes_of_layer(layer)
        if strokes is None:
            raise DataError(
                f"'{name}' has strokes that are Bezier or NURBS curves; make them Poly with Stroke "
                "> Set Curve Type in Edit Mode"
            )
        matrix = _matrix_of(layer, evaluated)
        found += [
            (to_world(points, matrix), cyclic) for points, cyclic in strokes if len(points) > 1
        ]
    return found


def _is_hidden(layer: bpy.types.bpy_struct) -> bool:
    while layer is not None:
        if layer.hide:
            return True
        layer = getattr(layer, "parent_group", None)  # layers are in groups from 4.3 on
    return False


def _matrix_of(layer: bpy.types.bpy_struct, owner: bpy.types.Object) -> np.ndarray:
    """From the space of a layer to the world."""
    matrices = layer_matrices(layer)
    if matrices is None:
        return world_matrix(owner)
    (inverse, own), parent = matrices, layer.parent
    if parent is None:
        return world_matrix(owner) @ own
    matrix = world_matrix(parent)
    bone = parent.pose.bones.get(layer.parent_bone) if parent.pose is not None else None
    if bone is not None:
        matrix = matrix @ np.array([row[:] for row in bone.matrix], dtype=np.float64)
    return matrix @ inverse @ own
