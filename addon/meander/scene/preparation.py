# SPDX-License-Identifier: GPL-3.0-or-later
"""How a mesh is prepared: what the settings say, the part to fill, and the faults of the mesh.

Faults are remembered in words, and selected in the mesh itself. The part may be the faces that are
selected in Edit Mode; a result keeps it as an attribute of the mesh's faces, so that it can go on
there later, also after other faces have been selected.
"""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from .. import core
from ..model.preparation import Mask, Repair, Share, seam_width
from .attributes import is_face_mask
from .columns import column
from .errors import DataError
from .evaluated import evaluated_copy, surface_mesh
from .linked_settings import settings_of, settings_to_change
from .meshes import polygons_of, vertex_group_weights
from .transforms import to_world, world_matrix
from .triangulation import vertices_of


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
    """The options for the triangles of meshes.triangles_of(), with their polygons and the mask put
    into `options`.

    Raises DataError for a mask that does not exist or has no faces.
    """
    options.polygons = polygons_of(surface, depsgraph)
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
        polygon = column(mesh.loop_triangles, "polygon_index", kind=np.int32)
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
    index = column(mesh.polygons, "material_index", kind=np.int32)
    index = np.minimum(index, len(names) - 1)  # as Blender draws an index beyond the slots
    return np.array([other == name for other in names], dtype=bool)[index]


def _polygons_of_attribute(
    name: str, surface: bpy.types.Object, mesh: bpy.types.Mesh
) -> np.ndarray:
    face_map = getattr(surface, "face_maps", {}).get(name)
    if face_map is not None:
        layer = mesh.face_maps.active
        if layer is None:
            return np.zeros(len(mesh.polygons), dtype=bool)
        return column(layer.data, "value", kind=np.int32) == face_map.index
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
    kind = bool if attribute.data_type == "BOOLEAN" else np.int32
    return column(attribute.data, "value", kind=kind) != 0


# What the attributes are called; the first free name is taken.
NAME = "Meander Region"


def selected_faces(surface: bpy.types.Object) -> np.ndarray | None:
    """Per polygon of the mesh itself: is it selected? None out of Edit Mode, and if none is."""
    if surface.type != "MESH" or surface.mode != "EDIT":
        return None
    surface.update_from_editmode()
    selected = column(surface.data.polygons, "select", kind=bool)
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


# What the numbers of a fault count.
_VERTICES = frozenset({"not_finite", "bow_tie"})
_FACES = frozenset({"no_area", "doubled_face"})


def remember_problem(surface: bpy.types.Object, sentence: str) -> None:
    """Keeps with a surface why it was refused; an empty sentence says that it was not."""
    if settings_of(surface).problem.sentence != sentence:
        settings_to_change(surface).problem.sentence = sentence


@dataclass(frozen=True)
class Located:
    """Faults in the mesh of an object, not of its modifiers.

    mode       the selection mode that shows them: "VERT", "EDGE" or "FACE"
    vertices   of all of them; `edges` and `faces` only where the mode is theirs
    """

    faults: core.Faults
    mode: str
    vertices: np.ndarray
    edges: np.ndarray
    faces: np.ndarray


def locate_faults(surface: bpy.types.Object, radius: float) -> Located:
    """All faults of a mesh object that is not in Edit Mode.

    radius   half the spacing; it decides what is a seam

    Raises DataError where the mesh itself has none.
    """
    mesh: bpy.types.Mesh = surface.data
    triangles = vertices_of(mesh)
    coordinates = column(mesh.vertices, "co", 3)
    vertices = to_world(coordinates, world_matrix(surface))
    if not len(triangles):
        raise DataError(f"'{surface.name}' has no faces; add some, or choose another mesh")
    faults = core.find_faults(
        vertices, triangles.astype(np.uint32), seam_width(vertices, radius)
    )
    if not len(faults.kinds):
        by = "its modifiers make them" if len(surface.modifiers) else "it has been corrected"
        raise DataError(f"The mesh of '{surface.name}' has no faults; {by}")
    return _located(mesh, faults)


def _located(mesh: bpy.types.Mesh, faults: core.Faults) -> Located:
    polygons = column(mesh.loop_triangles, "polygon_index", kind=np.int32)
    names = np.array(core.FAULTS)[faults.kinds]
    of_face = np.isin(names, list(_FACES))
    of_edge = ~(of_face | np.isin(names, list(_VERTICES)))
    faces = np.unique(polygons[faults.elements[of_face, 0]])
    ends = np.sort(faults.elements[of_edge], axis=1).astype(np.int64)
    edges = _edges_between(mesh, ends)
    corners = [mesh.polygons[int(face)].vertices[:] for face in faces]
    of_faces = np.concatenate(corners) if corners else []
    others = faults.elements[~of_face].ravel()
    vertices = np.unique(np.concatenate([others, of_faces]).astype(np.int64))
    mode = "VERT"
    if of_face.all():
        mode = "FACE"
    elif of_edge.all() and len(edges) == len(np.unique(ends, axis=0)):
        mode = "EDGE"  # else some are diagonals of polygons, which are no edges of the mesh
    return Located(faults, mode, vertices, edges, faces)


def _edges_between(mesh: bpy.types.Mesh, ends: np.ndarray) -> np.ndarray:
    """The edges of the mesh with these ends (n, 2), each rising; those that it has."""
    own = column(mesh.edges, "vertices", 2, np.int32)
    own = np.sort(own, axis=1).astype(np.int64)
    count = len(mesh.vertices)
    return np.flatnonzero(np.isin(own @ [count, 1], ends @ [count, 1]))


def select_located(mesh: bpy.types.Mesh, located: Located) -> None:
    """Selects faults, in a mesh that is not in Edit Mode and in which nothing is selected."""
    for elements, chosen in (
        (mesh.vertices, located.vertices),
        (mesh.edges, located.edges if located.mode == "EDGE" else ()),
        (mesh.polygons, located.faces if located.mode == "FACE" else ()),
    ):
        flags = np.zeros(len(elements), dtype=bool)
        flags[np.asarray(chosen, dtype=np.int64)] = True
        elements.foreach_set("select", flags)
    if located.mode == "FACE":
        _select_edges_of(mesh, located.faces)


def _select_edges_of(mesh: bpy.types.Mesh, faces: np.ndarray) -> None:
    edge_of_loop = column(mesh.loops, "edge_index", kind=np.int32)
    for face in faces.tolist():
        for loop in mesh.polygons[face].loop_indices:
            mesh.edges[int(edge_of_loop[loop])].select = True
