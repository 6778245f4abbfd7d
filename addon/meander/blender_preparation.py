# SPDX-License-Identifier: GPL-3.0-or-later
"""How a mesh is made ready: the settings, the mask that they name, and where a mesh was refused."""

from __future__ import annotations

from collections.abc import Iterable

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntVectorProperty, StringProperty

from . import blender_data, core
from .blender_data import DataError
from .preparation import Mask, Repair

_FACE_TYPES = ("BOOLEAN", "INT", "INT8")


# ------------------------------------------------------------------------------------------------
# Settings


def _is_face_mask(attribute: bpy.types.Attribute) -> bool:
    return attribute.domain == "FACE" and attribute.data_type in _FACE_TYPES


def _mask_names(
    settings: bpy.types.PropertyGroup, context: bpy.types.Context, _text: str
) -> Iterable[str]:
    owner = settings.id_data
    surface = owner if owner.type == "MESH" else settings.surface
    if surface is None:
        return []
    mesh = surface.evaluated_get(context.evaluated_depsgraph_get()).data
    names = [item.name for item in mesh.attributes if _is_face_mask(item)]
    return [face_map.name for face_map in getattr(surface, "face_maps", ())] + [
        name for name in names if not name.startswith(".")
    ]


class PreparationSettings:
    """The part of MeanderSettings that says what is done to the mesh, and which part is filled."""

    mask_source: EnumProperty(
        name="Fill",
        description="Which part of the mesh the curve fills; its edge acts as a border",
        items=(
            ("NONE", "Whole Mesh", "All faces"),
            ("MATERIAL", "Material", "The faces that have a material"),
            ("ATTRIBUTE", "Face Attribute", "The faces for which an attribute is true or not 0"),
            ("GROUP", "Vertex Group", "Where the weight is high enough, also across faces"),
        ),
        default="NONE",
        options=set(),
    )
    mask_material: StringProperty(
        name="Material", description="Only faces with this material are filled", options=set()
    )
    mask_attribute: StringProperty(
        name="Attribute",
        description=(
            "Boolean or integer attribute of faces, or a face map in Blender before 4.0; faces "
            "where it is false or 0 are left out"
        ),
        search=_mask_names,
        search_options={"SUGGESTION"},
        options=set(),
    )
    mask_group: StringProperty(
        name="Group",
        description="Vertex group; what has less than the threshold is left out",
        options=set(),
    )
    mask_threshold: FloatProperty(
        name="Threshold",
        description="The border runs where the weight is this, straight through faces",
        default=0.5,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
        options=set(),
    )
    mask_inverted: BoolProperty(
        name="Invert",
        description="Fill what would be left out, and leave out what would be filled",
        default=False,
        options=set(),
    )
    border_distance: FloatProperty(
        name="Distance",
        description=(
            "Distance of the last strand from borders and holes, in spacings. "
            "At 0 strands run along the border"
        ),
        default=0.5,
        min=0.0,
        max=2.0,
        precision=2,
        step=5,
        options=set(),
    )
    use_outline: BoolProperty(
        name="Outline First",
        description=(
            "Lay a fixed strand along every border at the border distance, and fill what is "
            "left inside"
        ),
        default=False,
        options=set(),
    )
    use_merge: BoolProperty(
        name="Merge Close Vertices",
        description="Take vertices that are very near each other as one; the mesh stays as it is",
        default=False,
        options=set(),
    )
    merge_distance: FloatProperty(
        name="Distance",
        description="Vertices this near to each other are one, in world units",
        default=0.0001,
        min=0.0,
        soft_max=0.1,
        precision=5,
        step=1,
        unit="LENGTH",
        options=set(),
    )
    drop_degenerate: BoolProperty(
        name="Dissolve Degenerate",
        description="Do without faces that have no area or are there twice, instead of refusing",
        default=False,
        options=set(),
    )
    split_bow_ties: BoolProperty(
        name="Split Bow-Ties",
        description="Part faces that meet in one vertex only, instead of refusing the mesh",
        default=False,
        options=set(),
    )
    cut_non_manifold: BoolProperty(
        name="Cut Non-Manifold Edges",
        description=(
            "Take edges with more than two faces as borders, where every sheet ends, instead of "
            "refusing the mesh"
        ),
        default=False,
        options=set(),
    )


class MeanderProblem(bpy.types.PropertyGroup):
    """The element of the mesh because of which the last run did not begin."""

    kind: StringProperty(name="Kind", options=set())  # "vertex", "edge", "face"; empty: none
    elements: IntVectorProperty(name="Elements", size=2, options=set())
    sentence: StringProperty(name="Sentence", options=set())


def repair_of(settings: PreparationSettings) -> Repair:
    return Repair(
        settings.merge_distance if settings.use_merge else 0.0,
        settings.drop_degenerate,
        settings.split_bow_ties,
        settings.cut_non_manifold,
    )


def store_repair(repair: Repair, settings: PreparationSettings) -> None:
    settings.use_merge = repair.merge_distance > 0.0
    if settings.use_merge:
        settings.merge_distance = repair.merge_distance
    settings.drop_degenerate = repair.drop_degenerate
    settings.split_bow_ties = repair.split_bow_ties
    settings.cut_non_manifold = repair.cut_non_manifold


def mask_of(settings: PreparationSettings) -> Mask:
    source = settings.mask_source
    name = "" if source == "NONE" else getattr(settings, f"mask_{source.lower()}")
    return Mask(source, name, settings.mask_threshold, settings.mask_inverted)


def store_mask(mask: Mask, settings: PreparationSettings) -> None:
    settings.mask_source = mask.source
    if mask.source != "NONE":
        setattr(settings, f"mask_{mask.source.lower()}", mask.name)
    settings.mask_threshold = mask.threshold
    settings.mask_inverted = mask.inverted


# ------------------------------------------------------------------------------------------------
# Masks


def surface_options(
    repair: Repair, mask: Mask, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> core.SurfaceOptions:
    """The options for the triangles of blender_data.triangles_of().

    Raises DataError for a mask that does not exist or has no faces.
    """
    options = core.SurfaceOptions(
        repair.merge_distance,
        repair.drop_degenerate,
        repair.split_bow_ties,
        repair.cut_non_manifold,
    )
    if mask.source == "NONE":
        return options
    if not mask.name:
        what = {"MATERIAL": "material", "ATTRIBUTE": "face attribute", "GROUP": "vertex group"}
        raise DataError(f"Choose the {what[mask.source]} of the part to fill, or fill it all")
    if mask.source == "GROUP":
        weights = blender_data.vertex_group_weights(surface, depsgraph, mask.name)
        # Weights are stored in single precision, and so is what a user types.
        options.vertex_mask = -weights if mask.inverted else weights
        threshold = float(np.float32(mask.threshold))
        options.mask_threshold = -threshold if mask.inverted else threshold
        empty = not (options.vertex_mask >= options.mask_threshold).any()
    else:
        options.face_mask = _face_mask(mask, surface, depsgraph)
        empty = not options.face_mask.any()
    if empty:
        raise DataError(
            f"'{mask.name}' leaves no faces of '{surface.name}' to fill; choose another part"
        )
    return options


def _face_mask(
    mask: Mask, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> np.ndarray:
    """Per triangle of triangles_of(): is it to be filled?"""
    with blender_data.surface_mesh(surface, depsgraph) as (mesh, _matrix):
        mesh.calc_loop_triangles()
        polygon = np.empty(len(mesh.loop_triangles), dtype=np.int32)
        mesh.loop_triangles.foreach_get("polygon_index", polygon)
        if mask.source == "MATERIAL":
            chosen = _polygons_of_material(mask.name, surface, mesh)
        else:
            chosen = _polygons_of_attribute(mask.name, surface, mesh)
        return (~chosen if mask.inverted else chosen)[polygon]


def _polygons_of_material(
    name: str, surface: bpy.types.Object, mesh: bpy.types.Mesh
) -> np.ndarray:
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
    if attribute is None or not _is_face_mask(attribute):
        known = ", ".join(
            f"'{other.name}'"
            for other in mesh.attributes
            if _is_face_mask(other) and not other.name.startswith(".")
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


def loose_edge_count(surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> int:
    """Edges of the evaluated mesh that no face has."""
    with blender_data.surface_mesh(surface, depsgraph) as (mesh, _matrix):
        edges = np.empty(len(mesh.loops), dtype=np.int32)
        mesh.loops.foreach_get("edge_index", edges)
        return len(mesh.edges) - len(np.unique(edges))


# ------------------------------------------------------------------------------------------------
# Problems


def forget_problem(surface: bpy.types.Object) -> None:
    if surface.library is None:
        surface.meander.problem.kind = ""


def remember_problem(
    error: core.MeanderError, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> None:
    """Keeps the element that an error names, so that it can be selected."""
    if surface.library is not None or error.element_kind not in {"vertex", "edge", "face"}:
        return
    elements = list(error.elements)
    if error.element_kind == "face":  # a triangle of the evaluated mesh; the user knows its polygon
        with blender_data.surface_mesh(surface, depsgraph) as (mesh, _matrix):
            mesh.calc_loop_triangles()
            elements = [mesh.loop_triangles[elements[0]].polygon_index]
    problem = surface.meander.problem
    problem.kind = error.element_kind
    problem.elements = (elements + elements)[:2]
    problem.sentence = str(error)


def locate_problem(
    surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> tuple[str, list[bpy.types.ID]]:
    """The remembered element in the mesh, which must not be in Edit Mode.

    Returns the selection mode that shows it, "VERT", "EDGE" or "FACE", and the elements to select.
    Raises DataError where it is not in the mesh itself.
    """
    problem = surface.meander.problem
    mesh = surface.data
    with blender_data.surface_mesh(surface, depsgraph) as (evaluated, _matrix):
        same = (len(evaluated.vertices), len(evaluated.polygons)) == (
            len(mesh.vertices),
            len(mesh.polygons),
        )
    first, second = problem.elements
    count = len(mesh.polygons) if problem.kind == "face" else len(mesh.vertices)
    if not same or max(first, second) >= count:
        raise DataError(
            f"The {problem.kind} at fault is made by the modifiers of '{surface.name}', or the "
            "mesh has changed since; apply them, or fill it again"
        )
    if problem.kind == "face":
        polygon = mesh.polygons[first]
        ends = set(polygon.vertices)
        return "FACE", [
            polygon,
            *(mesh.vertices[v] for v in ends),
            *(edge for edge in mesh.edges if ends.issuperset(edge.vertices)),
        ]
    vertices = [mesh.vertices[v] for v in {first, second}]
    if problem.kind == "edge":
        ends = np.empty(2 * len(mesh.edges), dtype=np.int32)
        mesh.edges.foreach_get("vertices", ends)
        same_ends = (np.sort(ends.reshape(-1, 2), axis=1) == sorted((first, second))).all(axis=1)
        if same_ends.any():  # a diagonal of a polygon is no edge of the mesh
            return "EDGE", [*vertices, mesh.edges[int(np.flatnonzero(same_ends)[0])]]
    return "VERT", vertices
