# SPDX-License-Identifier: GPL-3.0-or-later
"""Which objects can be filled, and why the others cannot."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import bpy

from .made import made_from

# Types of which Blender always makes a mesh.
_OF_FACES = frozenset({"MESH", "FONT", "SURFACE", "META"})


def is_result(thing: bpy.types.Object | None) -> bool:
    """Whether an object is a curve that Meander has made, also one whose surface is gone."""
    settings = getattr(thing, "meander", None)  # which the batch command may do without
    if settings is None or thing.type != "CURVE":
        return False
    return settings.surface is not None or settings.figures.strands > 0


def has_faces(thing: bpy.types.Object | None) -> bool:
    """Whether an object is one to fill: a mesh, or what Blender makes a mesh with faces of.

    Cheap, for panels; what modifiers make is not looked at.
    """
    if thing is None or is_result(thing):
        return False
    if shows_collection(thing):
        return True
    if thing.type == "MESH":
        # Edges alone are strands, but modifiers may make faces of them; in Edit Mode the data is
        # what it was before. A mesh with neither is one to fill, which will say what it lacks.
        mesh = thing.data
        no_strands = bool(mesh.polygons) or not mesh.edges
        return no_strands or bool(thing.modifiers) or thing.mode == "EDIT"
    if thing.type != "CURVE":
        return thing.type in _OF_FACES
    curve = thing.data
    thick = curve.bevel_depth > 0.0 or curve.extrude > 0.0 or curve.bevel_object is not None
    filled = curve.dimensions == "2D" and curve.fill_mode != "NONE"
    return thick or filled or any(modifier.type == "NODES" for modifier in thing.modifiers)


def why_not(thing: bpy.types.Object | None) -> str:
    """What to do where an object cannot be filled, as a sentence without its full stop."""
    return why_not_this(thing) or "Choose a mesh to fill, or a curve that Meander has made"


def why_not_this(thing: bpy.types.Object | None) -> str:
    """why_not() where it is about the object itself; else empty."""
    if is_missing(thing):
        return (
            f"'{thing.name}' is linked from {thing.library.filepath}, which is not there; give "
            "that file back its place, or choose another with File > External Data > Find Missing "
            "Files"
        )
    curve = made_from(thing)
    if curve is not None:
        return (
            f"'{thing.name}' was made from '{curve.name}'; press Select Curve, or Use as Surface "
            "to fill it"
        )
    if is_result(thing):
        return f"The surface of '{thing.name}' is gone; choose a mesh to fill"
    if thing is not None and thing.type == "MESH" and not has_faces(thing):
        return f"'{thing.name}' has no faces; choose a mesh with faces as the surface"
    if thing is not None and thing.type == "POINTCLOUD":
        return (
            f"'{thing.name}' has points only; give a mesh the Geometry Nodes Object Info and "
            "Instance on Points with a mesh, to fill a copy at each"
        )
    if thing is not None and thing.type == "CURVE":
        return f"'{thing.name}' has no faces; give it a bevel or an extrusion, or choose a mesh"
    return ""


def is_missing(thing: bpy.types.Object | None) -> bool:
    """Whether an object only stands for one of a library that is not there."""
    if thing is None or thing.library is None or thing.type != "EMPTY" or thing.data is not None:
        return False
    return not Path(bpy.path.abspath(thing.library.filepath)).is_file()


def shows_collection(thing: bpy.types.Object | None) -> bool:
    """Whether an object stands for a collection, whose objects it shows."""
    is_empty = thing is not None and thing.type == "EMPTY" and thing.instance_type == "COLLECTION"
    return is_empty and thing.instance_collection is not None


def shows_instances(thing: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bool:
    """Whether an object shows copies of others, as Geometry Nodes make them."""
    return any(True for _instance in shown_by(thing, depsgraph))


def kinds_shown(thing: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> set[str]:
    """The types of what an object shows beside its own mesh; curves of its own Geometry Nodes, and
    points, are of the types CURVE, CURVES and POINTCLOUD."""
    return {instance.object.type for instance in shown_by(thing, depsgraph)}


def shown_by(
    thing: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Iterator[bpy.types.DepsgraphObjectInstance]:
    """What an object shows beside its own mesh; each only until the next one is asked for."""
    if thing.instance_type == "NONE" and all(m.type != "NODES" for m in thing.modifiers):
        return  # a scene may show millions of others
    for instance in depsgraph.object_instances:
        if instance.is_instance and instance.parent is not None and (
            instance.parent.original == thing
        ):
            yield instance
