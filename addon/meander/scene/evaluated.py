# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects with their modifiers applied, hidden or not, in any mode: as the dependency graph shows
them, and surfaces as a render does where that differs."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import NamedTuple

import bpy
import numpy as np

from . import instances
from .changes import shape_count
from .errors import DataError
from .fillable import has_faces, shows_collection, shows_instances, why_not_this
from .identity import number_of
from .rendered import RenderedCopies, Rendering, rendering_of
from .transforms import world_matrix


class Evaluation(NamedTuple):
    """A copy of an object, and the dependency graph that evaluates it."""

    copy: bpy.types.Object
    depsgraph: bpy.types.Depsgraph


@contextmanager
def evaluated_copy(
    object: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
    with_data: bool,
    as_rendered: bool = False,
    nodes: bpy.types.NodeTree | None = None,
) -> Iterator[Evaluation]:
    """A visible copy of the object in a scene of its own, for as long as the block lasts.

    Only objects that a dependency graph shows are evaluated, and an evaluated curve can only be
    changed through a copy. What was hidden while the frame changed, parents and what modifiers
    point at included, is still where it was: a graph of its own evaluates all of it at the frame,
    and leaves the animated properties of the scene that is shown as the user has them.

    with_data    the data is copied too; update `depsgraph` of the result after changing it
    as_rendered  it has what a render shows instead of what the views show
    nodes        Geometry Nodes that it has after all its modifiers; None: it has none besides

    Raises DataError where the frame hides the object.
    """
    shown = depsgraph.scene
    scene = bpy.data.scenes.new("Meander Evaluation")
    copy = object.copy()
    data, rendered = None, RenderedCopies()
    try:
        scene.render.use_simplify = shown.render.use_simplify
        scene.render.simplify_subdivision = shown.render.simplify_subdivision
        # Before the graph is made, which then begins at this frame.
        scene.frame_float = shown.frame_float
        if with_data:
            data = object.data.copy()
            copy.data = data
        if nodes is not None:
            copy.modifiers.new("Nodes", "NODES").node_group = nodes
        members = [copy]
        if as_rendered:
            scene.render.simplify_subdivision = shown.render.simplify_subdivision_render
            rendered.prepare(copy, object, shown)
            members = rendered.family(copy, object, shown) or members
        for member in members:
            member.hide_viewport = False
            scene.collection.objects.link(member)
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
        rendered.remove()
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
        if shows_collection(object):
            raise DataError(
                f"'{object.name}' shows a collection without meshes; link some to it, or choose "
                "another object"
            ) from error
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

    As a render shows it where that differs from what the views show, and costs at most
    rendered.MOST_FACES times the faces: what lies on it is then seen where it is looked at in the
    end. Works in Edit Mode and for hidden objects. Raises DataError for what has no faces.
    """
    if not has_faces(object):
        raise DataError(
            why_not_this(object)
            or f"'{object.name}' is not a mesh; choose a mesh object as the surface"
        )
    if object.mode == "EDIT":
        object.update_from_editmode()
    with ExitStack() as stack:
        found = stack.enter_context(_rendered_mesh(object, depsgraph))
        if found is None:
            found = stack.enter_context(_realized_mesh(object, depsgraph))
        yield found if found is not None else stack.enter_context(_shown_mesh(object, depsgraph))


@contextmanager
def _shown_mesh(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Iterator[tuple[bpy.types.Mesh, np.ndarray]]:
    """surface_mesh() of what the views show."""
    if is_evaluated(object, depsgraph):
        depsgraph.update()
        with mesh_of(object, depsgraph) as result:
            yield result
    else:
        with evaluated_copy(object, depsgraph, with_data=False) as (copy, own):
            with mesh_of(copy, own) as result:
                yield result


@contextmanager
def _realized_mesh(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Iterator[tuple[bpy.types.Mesh, np.ndarray] | None]:
    """surface_mesh() of an object of which all that is shown are instances of meshes: these as one
    mesh; None: it is no such object."""
    if not instances.may_show(object):
        yield None
        return
    kept, number = _kept_of(depsgraph), number_of(object)
    if kept is not None and number in kept.found:
        yield kept.found[number]
        return
    with ExitStack() as stack:
        shown, graph = object, depsgraph
        if is_evaluated(object, depsgraph):
            depsgraph.update()
        else:
            shown, graph = stack.enter_context(evaluated_copy(object, depsgraph, with_data=False))
        has_own = not shows_collection(shown) and _has_faces_of_its_own(shown, graph)
        if has_own or not len(instances.sizes_of(object, shown, graph)):
            yield None
            return
        found = stack.enter_context(_realized(shown, graph))
        if kept is not None:
            kept.found[number] = found
            kept.stack.push(stack.pop_all())
        yield found


class Instances(NamedTuple):
    """Instances that an object shows.

    sizes      (n,) int64, the number of vertices of each that the surface consists of
    left_out   whether it shows some that are no part of it, as it has faces of its own
    """

    sizes: np.ndarray
    left_out: bool

    @property
    def in_words(self) -> tuple[int, bool]:
        """For model.preparation.described()."""
        return len(self.sizes), self.left_out


def instances_of(object: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Instances:
    """What a surface consists of and shows besides; of one that the views hide nothing is known."""
    none = np.zeros(0, dtype=np.int64)
    if not instances.may_show(object) or not is_evaluated(object, depsgraph):
        return Instances(none, False)
    if not shows_collection(object) and _has_faces_of_its_own(object, depsgraph):
        return Instances(none, shows_instances(object, depsgraph))
    return Instances(instances.sizes_of(object, object, depsgraph), False)


def _has_faces_of_its_own(thing: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bool:
    with mesh_of(thing, depsgraph) as (mesh, _matrix):
        return len(mesh.polygons) > 0


@contextmanager
def _realized(
    thing: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Iterator[tuple[bpy.types.Mesh, np.ndarray]]:
    """The instances that an object shows as one mesh, and its world matrix."""
    with instances.stand_in(thing) as whole, instances.realizing(thing) as nodes:
        with evaluated_copy(whole, depsgraph, with_data=False, nodes=nodes) as (copy, own):
            with mesh_of(copy, own) as result:
                yield result


# Surfaces whose render was found to have too many faces, by their numbers, and the count of their
# shape then: what is heavy is not evaluated again and again.
_too_costly: dict[int, int] = {}


class _Once:
    """What is kept of the surfaces of a dependency graph while evaluated_once() lasts."""

    def __init__(self, depsgraph: bpy.types.Depsgraph) -> None:
        self.depsgraph, self.stack = depsgraph, ExitStack()
        self.found: dict[int, tuple[bpy.types.Mesh, np.ndarray]] = {}


_once: _Once | None = None


def _kept_of(depsgraph: bpy.types.Depsgraph) -> _Once | None:
    return _once if _once is not None and _once.depsgraph == depsgraph else None


@contextmanager
def evaluated_once(depsgraph: bpy.types.Depsgraph) -> Iterator[None]:
    """Has surfaces evaluated as rendered, and instances realized, once, however often they are
    asked for in the block, which changes nothing of them."""
    global _once
    if _once is not None:
        yield
        return
    _once = _Once(depsgraph)
    try:
        with _once.stack:
            yield
    finally:
        _once = None


@contextmanager
def _rendered_mesh(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Iterator[tuple[bpy.types.Mesh, np.ndarray] | None]:
    """surface_mesh() of what a render shows; None where the views' is to be taken."""
    rendering = rendering_of(object, depsgraph.scene) if depsgraph.mode == "VIEWPORT" else None
    number = number_of(object)
    costly = _too_costly.get(number) == shape_count(object)
    if rendering is None or not rendering.may_be_filled or costly and rendering.counted:
        yield None
        return
    kept = _kept_of(depsgraph)
    if kept is not None and number in kept.found:
        yield kept.found[number]
        return
    with ExitStack() as stack:
        enter = stack.enter_context
        found = enter(mesh_of(*enter(evaluated_copy(object, depsgraph, False, as_rendered=True))))
        if _is_worth(len(found[0].loops), rendering, object, depsgraph):
            if kept is not None:
                kept.found[number] = found
                kept.stack.push(stack.pop_all())
            yield found
            return
    _too_costly.clear()
    _too_costly[number] = shape_count(object)
    yield None


def _is_worth(
    corners: int,
    rendering: Rendering,
    object: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
) -> bool:
    """Whether a render's faces, which have so many corners, are to be filled."""
    if not corners or not rendering.counted or not is_evaluated(object, depsgraph):
        return corners > 0
    with mesh_of(object, depsgraph) as (shown, _matrix):
        return rendering.is_worth(corners, len(shown.loops))


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
