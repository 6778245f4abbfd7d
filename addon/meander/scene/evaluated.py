# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects as the dependency graph shows them: modifiers applied, hidden or not, in any mode."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import numpy as np

from .errors import DataError
from .fillable import has_faces
from .transforms import world_matrix


@contextmanager
def linked_copy(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph, with_data: bool
) -> Iterator[bpy.types.Object]:
    """A visible copy of the object in the scene for as long as the block lasts.

    Only objects that the dependency graph shows are evaluated, and an evaluated curve can only be
    changed through a copy.
    """
    copy = object.copy()
    data = None
    try:
        if with_data:
            data = object.data.copy()
            copy.data = data
        copy.hide_viewport = False
        depsgraph.scene.collection.objects.link(copy)
        yield copy
    finally:
        bpy.data.objects.remove(copy)
        if data is not None:
            bpy.data.batch_remove([data])
        depsgraph.update()


@contextmanager
def mesh_of(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Iterator[tuple[bpy.types.Mesh, np.ndarray]]:
    """The evaluated object's mesh and its world matrix; the mesh is freed after the block."""
    evaluated = object.evaluated_get(depsgraph)
    try:
        mesh = evaluated.to_mesh()
    except RuntimeError as error:
        raise DataError(f"'{object.name}' cannot be turned into a mesh: {error}") from error
    try:
        yield mesh, world_matrix(evaluated)
    finally:
        evaluated.to_mesh_clear()


@contextmanager
def surface_mesh(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Iterator[tuple[bpy.types.Mesh, np.ndarray]]:
    """The evaluated mesh of a surface and its world matrix, freed after the block.

    Works in Edit Mode and for hidden objects. Raises DataError for what has no faces.
    """
    if not has_faces(object):
        raise DataError(f"'{object.name}' is not a mesh; choose a mesh object as the surface")
    if object.mode == "EDIT":
        object.update_from_editmode()
    if object.visible_get(view_layer=depsgraph.view_layer):
        depsgraph.update()
        with mesh_of(object, depsgraph) as result:
            yield result
    else:
        with linked_copy(object, depsgraph, with_data=False) as copy:
            depsgraph.update()
            with mesh_of(copy, depsgraph) as result:
                yield result
