# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes and UV maps of a mesh: which there are, and the one that a setting names."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import bpy
import numpy as np
from numpy.typing import NDArray

from .columns import column, vertices_of_corners
from .errors import DataError
from .settings import surface_of

_COLOR_TYPES = ("FLOAT_COLOR", "BYTE_COLOR")
_FACE_TYPES = ("BOOLEAN", "INT", "INT8")
_DOMAINS = ("POINT", "FACE", "CORNER")
# Of numbers, and how numpy holds them.
_NUMBERS = {"FLOAT": np.float32, "INT": np.int32, "INT8": np.int8, "BOOLEAN": bool}


def attributes_seen(
    settings: bpy.types.PropertyGroup, context: bpy.types.Context
) -> Iterable[bpy.types.Attribute]:
    """Those of the evaluated surface, so that what Geometry Nodes make is among them."""
    owner = settings.id_data
    surface = surface_of(owner)
    if surface is None:
        return ()
    evaluated = surface.evaluated_get(context.evaluated_depsgraph_get())
    return getattr(evaluated.data, "attributes", ())  # a text has none


def attribute_names(
    settings: bpy.types.PropertyGroup, context: bpy.types.Context, _text: str
) -> list[str]:
    return [item.name for item in attributes_seen(settings, context) if is_number(item)]


def color_names(
    settings: bpy.types.PropertyGroup, context: bpy.types.Context, _text: str
) -> list[str]:
    return [item.name for item in attributes_seen(settings, context) if is_color(item)]


def vector_names(
    settings: bpy.types.PropertyGroup, context: bpy.types.Context, _text: str
) -> Iterable[str]:
    return [item.name for item in attributes_seen(settings, context) if is_point_vector(item)]


def mask_names(
    settings: bpy.types.PropertyGroup, context: bpy.types.Context, _text: str
) -> Iterable[str]:
    owner = settings.id_data
    surface = surface_of(owner)
    if surface is None:
        return []
    names = [item.name for item in attributes_seen(settings, context) if is_face_mask(item)]
    return [face_map.name for face_map in getattr(surface, "face_maps", ())] + [
        name for name in names if not name.startswith(".")
    ]


def is_number(attribute: bpy.types.Attribute) -> bool:
    """Whether it has a number, or yes and no, at every point, face or corner; Blender's own, which
    are there unasked, are none."""
    own = attribute.name.startswith(".") or attribute.name == "sharp_face"
    return not own and attribute.data_type in _NUMBERS and attribute.domain in _DOMAINS


def is_point_vector(attribute: bpy.types.Attribute) -> bool:
    return (attribute.domain, attribute.data_type) == ("POINT", "FLOAT_VECTOR")


def is_color(attribute: bpy.types.Attribute) -> bool:
    return attribute.data_type in _COLOR_TYPES and attribute.domain in {"POINT", "CORNER"}


def is_face_mask(attribute: bpy.types.Attribute) -> bool:
    return attribute.domain == "FACE" and attribute.data_type in _FACE_TYPES


def named_attribute(
    mesh: bpy.types.Mesh,
    name: str,
    surface: bpy.types.Object,
    fits: Callable[[bpy.types.Attribute], bool],
    kind: str,
) -> bpy.types.Attribute:
    """The attribute of that name, if it is of the kind that is wanted."""
    attribute = mesh.attributes.get(name)
    if attribute is not None and fits(attribute):
        return attribute
    if attribute is not None:
        type_name = attribute.data_type.lower().replace("_", " ")
        raise DataError(
            f"'{name}' of '{surface.name}' is a {type_name} per {attribute.domain.lower()}; "
            f"choose a {kind}"
        )
    known = ", ".join(f"'{other.name}'" for other in mesh.attributes if fits(other))
    raise DataError(
        f"'{surface.name}' has no {kind} '{name}'; "
        + (f"it has {known}" if known else "add one, or choose another source")
    )


def uv_layer_of(
    mesh: bpy.types.Mesh, name: str, surface: bpy.types.Object
) -> bpy.types.MeshUVLoopLayer:
    """The UV map of that name; the active one for an empty name."""
    layer = mesh.uv_layers.get(name) if name else mesh.uv_layers.active
    if layer is None:
        raise DataError(
            f"'{surface.name}' has no UV map '{name}'; choose one that it has"
            if name
            else f"'{surface.name}' has no UV map; unwrap it first"
        )
    return layer


def uv_of(mesh: bpy.types.Mesh, name: str, surface: bpy.types.Object) -> NDArray[np.float32]:
    """A UV map at the corners of the faces, (n, 2), of uv_layer_of(). Raises DataError also where a
    place in it is not a number."""
    layer = uv_layer_of(mesh, name, surface)
    uv = column(layer.data, "uv", 2)
    bad = np.flatnonzero(~np.isfinite(uv))
    if len(bad):
        vertex = int(vertices_of_corners(mesh)[bad[0] // 2])
        raise DataError(
            f"The UV map '{layer.name}' is not a finite number at vertex {vertex} of "
            f"'{surface.name}'; unwrap the mesh again, or choose another map"
        )
    return uv


def numbers_of(attribute: bpy.types.Attribute) -> NDArray[np.float64]:
    """The values of an attribute of which is_number() is true."""
    kind = _NUMBERS[attribute.data_type]
    values = column(attribute.data, "value", kind=np.int32 if kind is np.int8 else kind)
    return values.astype(np.float64)
