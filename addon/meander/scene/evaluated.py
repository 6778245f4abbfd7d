# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects as the dependency graph shows them: modifiers applied, hidden or not, in any mode."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

import bpy
import numpy as np

from .errors import DataError
from .fillable import has_faces, why_not_this
from .transforms import world_matrix


class Evaluation(NamedTuple):
    """A copy of an object, and the dependency graph that evaluates it."""

    copy: bpy.types.Object
    depsgraph: bpy.types.Depsgraph


@contextmanager
def evaluated_copy(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph, with_data: bool
) -> Iterator[Evaluation]:
    """A visible copy of the object in a scene of its own, for as long as the block lasts.

    Only objects that a dependency graph shows are evaluated, and an evaluated curve can only be
    changed through a copy. What was hidden while the frame changed, parents and what modifiers
    point at included, is still where it was: a graph of its own evaluates all of it at the frame,
    and leaves the animated properties of the scene that is shown as the user has them.

    with_data   the data is copied too; update `depsgraph` of the result after changing it

    Raises DataError where the frame hides the object.
    """
    shown = depsgraph.scene
    scene = bpy.data.scenes.new("Meander Evaluation")
    copy = object.copy()
    data = None
    try:
        scene.render.use_simplify = shown.render.use_simplify
        scene.render.simplify_subdivision = shown.render.simplify_subdivision
        # Before the graph is made, which then begins at this frame.
        scene.frame_float = shown.frame_float
        if with_data:
            data = object.data.copy()
            copy.data = data
        copy.hide_viewport = False
        scene.collection.objects.link(copy)
        layer = scene.view_layers[0]
        layer.update()
        if copy.evaluated_get(layer.depsgraph).hide_viewport:
            raise DataError(
                f"'{object.name}' is hidden by its animation at frame {shown.frame_current}, where "
                "Blender does not evaluate it; choose a frame that shows it"
            )
        yield Evaluation(copy, layer.depsgraph)
    finally:
        bpy.data.objects.remove(copy)
        if data is not None:
            bpy.data.batch_remove([data])
        bpy.data.scenes.remove(scene)
        depsgraph.update()  # what this has stirred is no change of anything


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
        raise DataError(
            why_not_this(object)
            or f"'{object.name}' is not a mesh; choose a mesh object as the surface"
        )
    if object.mode == "EDIT":
        object.update_from_editmode()
    if is_evaluated(object, depsgraph):
        depsgraph.update()
        with mesh_of(object, depsgraph) as result:
            yield result
    else:
        with evaluated_copy(object, depsgraph, with_data=False) as (copy, own):
            with mesh_of(copy, own) as result:
                yield result


def is_evaluated(object: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bool:
    """Whether a dependency graph keeps the object as it is at the frame: not what is hidden, by
    itself or a collection, or is in no collection of the view layer."""
    if depsgraph.mode == "RENDER":
        return not object.hide_render
    return object.visible_get(view_layer=depsgraph.view_layer)


def matrix_of(object: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> np.ndarray:
    """The world matrix of an object at the frame, hidden or not."""
    if is_evaluated(object, depsgraph):
        return world_matrix(object.evaluated_get(depsgraph))
    with evaluated_copy(object, depsgraph, with_data=False) as (copy, own):
        return world_matrix(copy.evaluated_get(own))
