# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces that are selected in Edit Mode, as the part of a mesh to fill.

A result keeps its part as an attribute of the mesh's faces, so that it can go on there later, also
after other faces have been selected.
"""

from __future__ import annotations

import bpy
import numpy as np

from ..model.preparation import Mask
from .evaluated import evaluated_copy
from .preparation import face_mask

# What the attributes are called; the first free name is taken.
NAME = "Meander Region"


def selected_faces(surface: bpy.types.Object) -> np.ndarray | None:
    """Per polygon of the mesh itself: is it selected? None out of Edit Mode, and if none is."""
    if surface.type != "MESH" or surface.mode != "EDIT":
        return None
    surface.update_from_editmode()
    selected = np.empty(len(surface.data.polygons), dtype=bool)
    surface.data.polygons.foreach_get("select", selected)
    return selected if selected.any() else None


def is_region(settings: bpy.types.PropertyGroup) -> bool:
    """Whether settings name a region that was selected in Edit Mode."""
    return settings.mask_attribute.startswith(NAME)


def triangles_of_region(
    region: np.ndarray, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> np.ndarray:
    """Per triangle of meshes.triangles_of(): is it in the region, or made of what is?

    region   per polygon of the mesh without modifiers. What these make is told by a copy, so that
             nothing is written to the mesh
    """
    with evaluated_copy(surface, depsgraph, with_data=True) as (copy, own):
        attribute = copy.data.attributes.new(NAME, "BOOLEAN", "FACE")
        attribute.data.foreach_set("value", region)
        copy.data.update_tag()
        return face_mask(Mask("ATTRIBUTE", attribute.name), copy, own)


def store_region(
    region: np.ndarray, surface: bpy.types.Object, settings: bpy.types.PropertyGroup
) -> None:
    """Keeps the region with the mesh, and has the settings of a result name it.

    The mesh must not be in Edit Mode. Where its faces have changed since, the name stays without an
    attribute, so that going on is refused with a sentence and does not flood the rest.
    """
    mesh: bpy.types.Mesh = surface.data
    attribute = mesh.attributes.get(settings.mask_attribute) if is_region(settings) else None
    if len(mesh.polygons) == len(region):
        if attribute is None or (attribute.domain, attribute.data_type) != ("FACE", "BOOLEAN"):
            attribute = mesh.attributes.new(NAME, "BOOLEAN", "FACE")
        attribute.data.foreach_set("value", region)
        name = attribute.name
    else:
        name = f"{NAME} of other faces"
    settings.mask_attribute = name  # first: what names a region is not shared with the surface
    settings.mask_source = "ATTRIBUTE"
    settings.mask_inverted = False
