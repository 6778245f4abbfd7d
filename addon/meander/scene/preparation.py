# SPDX-License-Identifier: GPL-3.0-or-later
"""How a mesh is prepared: what the settings say, and the mask that they name."""

from __future__ import annotations

import bpy
import numpy as np

from .. import core
from ..model.preparation import Mask, Repair, Share
from .attributes import is_face_mask
from .errors import DataError
from .evaluated import surface_mesh
from .meshes import vertex_group_weights


def repair_of(settings: bpy.types.PropertyGroup) -> Repair:
    return Repair(
        settings.merge_distance if settings.use_merge else 0.0,
        settings.drop_degenerate,
        settings.split_bow_ties,
        settings.cut_non_manifold,
        settings.strict,
        settings.smallest_part,
    )


def store_repair(repair: Repair, settings: bpy.types.PropertyGroup) -> None:
    settings.use_merge = repair.merge_distance > 0.0
    if settings.use_merge:
        settings.merge_distance = repair.merge_distance
    settings.drop_degenerate = repair.drop_degenerate
    settings.split_bow_ties = repair.split_bow_ties
    settings.cut_non_manifold = repair.cut_non_manifold
    settings.strict = repair.strict
    if not isinstance(repair.smallest_part, Share):
        settings.smallest_part = repair.smallest_part


def mask_of(settings: bpy.types.PropertyGroup) -> Mask:
    source = settings.mask_source
    name = "" if source == "NONE" else getattr(settings, f"mask_{source.lower()}")
    return Mask(source, name, settings.mask_threshold, settings.mask_inverted)


def store_mask(mask: Mask, settings: bpy.types.PropertyGroup) -> None:
    settings.mask_source = mask.source
    if mask.source != "NONE":
        setattr(settings, f"mask_{mask.source.lower()}", mask.name)
    settings.mask_threshold = mask.threshold
    settings.mask_inverted = mask.inverted


# ------------------------------------------------------------------------------------------------
# Masks


def surface_options(
    options: core.SurfaceOptions,
    mask: Mask,
    surface: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
) -> core.SurfaceOptions:
    """The options for the triangles of meshes.triangles_of(), with the mask put into `options`.

    Raises DataError for a mask that does not exist or has no faces.
    """
    if mask.source == "NONE":
        return options
    if not mask.name:
        what = {"MATERIAL": "material", "ATTRIBUTE": "face attribute", "GROUP": "vertex group"}
        raise DataError(f"Choose the {what[mask.source]} of the part to fill, or fill it all")
    if mask.source == "GROUP":
        weights = vertex_group_weights(surface, depsgraph, mask.name)
        # Weights are stored in single precision, and so is what a user types.
        options.vertex_mask = -weights if mask.inverted else weights
        threshold = float(np.float32(mask.threshold))
        options.mask_threshold = -threshold if mask.inverted else threshold
        empty = not (options.vertex_mask >= options.mask_threshold).any()
    else:
        options.face_mask = face_mask(mask, surface, depsgraph)
        empty = not options.face_mask.any()
    if empty:
        raise DataError(
            f"'{mask.name}' leaves no faces of '{surface.name}' to fill; choose another part"
        )
    return options


def face_mask(mask: Mask, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> np.ndarray:
    """Per triangle of triangles_of(): is it to be filled?"""
    with surface_mesh(surface, depsgraph) as (mesh, _matrix):
        mesh.calc_loop_triangles()
        polygon = np.empty(len(mesh.loop_triangles), dtype=np.int32)
        mesh.loop_triangles.foreach_get("polygon_index", polygon)
        if mask.source == "MATERIAL":
            chosen = _polygons_of_material(mask.name, surface, mesh)
        else:
            chosen = _polygons_of_attribute(mask.name, surface, mesh)
        return (~chosen if mask.inverted else chosen)[polygon]


def _polygons_of_material(name: str, surface: bpy.types.Object, mesh: bpy.types.Mesh) -> np.ndarray:
    names = [material.name if material else "" for material in mesh.materials]
    for index, slot in enumerate(surface.material_slots):  # a slot may have one of the object's own
        if index < len(names) and slot.material is not None:
            names[index] = slot.material.name
    if name not in names:
        known = ", ".join(f"'{other}'" for other in names if other)
        raise DataError(
            f"'{surface.name}' has no material '{name}'; "
            + (f"it has {known}" if known else "assign one to the faces to fill")
        )
    index = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("material_index", index)
    index = np.minimum(index, len(names) - 1)  # as Blender draws an index beyond the slots
    return np.array([other == name for other in names], dtype=bool)[index]


def _polygons_of_attribute(
    name: str, surface: bpy.types.Object, mesh: bpy.types.Mesh
) -> np.ndarray:
    count = len(mesh.polygons)
    face_map = getattr(surface, "face_maps", {}).get(name)
    if face_map is not None:
        layer = mesh.face_maps.active
        if layer is None:
            return np.zeros(count, dtype=bool)
        index = np.empty(count, dtype=np.int32)
        layer.data.foreach_get("value", index)
        return index == face_map.index
    attribute = mesh.attributes.get(name)
    if attribute is None or not is_face_mask(attribute):
        known = ", ".join(
            f"'{other.name}'"
            for other in mesh.attributes
            if is_face_mask(other) and not other.name.startswith(".")
        )
        if attribute is not None:
            kind = attribute.data_type.lower().replace("_", " ")
            raise DataError(
                f"'{name}' of '{surface.name}' is a {kind} per {attribute.domain.lower()}; the "
                "mask needs a boolean or integer attribute of faces"
            )
        raise DataError(
            f"'{surface.name}' has no boolean or integer attribute of faces '{name}'; "
            + (f"it has {known}" if known else "add one, or choose another mask")
        )
    values = np.empty(count, dtype=bool if attribute.data_type == "BOOLEAN" else np.int32)
    attribute.data.foreach_get("value", values)
    return values != 0
