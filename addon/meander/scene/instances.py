# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects of which all that is shown are instances of meshes, and the nodes that make these one
mesh, as a Realize Instances node at the end of their Geometry Nodes would."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import numpy as np

from .blender_versions import add_geometry_socket
from .errors import DataError
from .fillable import is_result, shown_by, shows_collection

# More faces do not fit into the memory of most machines, and as many copies are a mistake.
MOST_FACES = 20_000_000
MOST_COPIES = 100_000


def may_show(thing: bpy.types.Object) -> bool:
    """Whether an object could be one of these, by what it has; cheap."""
    return shows_collection(thing) or any(m.type == "NODES" for m in thing.modifiers)


def sizes_of(
    named: bpy.types.Object, shown: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> np.ndarray:
    """The number of vertices of each instance of a mesh that an object shows, (n,). Raises
    DataError for more than could be filled.

    named   for the error; `shown` may be a copy of it
    """
    sizes, faces = [], 0
    for instance in shown_by(shown, depsgraph):
        if instance.object.type == "MESH" and not is_result(instance.object.original):
            sizes.append(len(instance.object.data.vertices))
            faces += len(instance.object.data.polygons)
    if faces > MOST_FACES or len(sizes) > MOST_COPIES:
        raise DataError(
            f"'{named.name}' shows {len(sizes):,} instances with {faces:,} faces, and at most "
            f"{MOST_COPIES:,} with {MOST_FACES:,} are filled; show fewer of them"
        )
    return np.array(sizes, dtype=np.int64)


@contextmanager
def stand_in(thing: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """An object with modifiers in the place of one that shows a collection; else that itself."""
    if not shows_collection(thing):
        yield thing
        return
    mesh = bpy.data.meshes.new(thing.name)
    made = bpy.data.objects.new(thing.name, mesh)
    made.matrix_world = thing.matrix_world
    try:
        yield made
    finally:
        bpy.data.objects.remove(made)
        bpy.data.meshes.remove(mesh)


@contextmanager
def realizing(thing: bpy.types.Object) -> Iterator[bpy.types.GeometryNodeTree]:
    """Nodes for a modifier of a copy of an object, after all others, while the block lasts."""
    tree = bpy.data.node_groups.new("Meander Realized", "GeometryNodeTree")
    collection = bpy.data.collections.new("Meander Realized")
    try:
        for way in ("INPUT", "OUTPUT"):
            add_geometry_socket(tree, way)
        source = tree.nodes.new("NodeGroupInput")
        if shows_collection(thing):
            source = tree.nodes.new("GeometryNodeCollectionInfo")
            source.inputs["Collection"].default_value = collection
            collection.instance_offset = thing.instance_collection.instance_offset
            for shown in thing.instance_collection.all_objects:
                if not is_result(shown):  # a line that lies on what is filled
                    collection.objects.link(shown)
        realize = tree.nodes.new("GeometryNodeRealizeInstances")
        end = tree.nodes.new("NodeGroupOutput")
        tree.links.new(source.outputs[0], realize.inputs[0])
        tree.links.new(realize.outputs[0], end.inputs[0])
        yield tree
    finally:
        bpy.data.node_groups.remove(tree)
        bpy.data.collections.remove(collection)
