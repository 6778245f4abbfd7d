# SPDX-License-Identifier: GPL-3.0-or-later
"""Which way the strands run: the settings, and the directions that they name, in world space.

Directions are lines: their signs and lengths do not matter. What can be read is an array per vertex
of the evaluated mesh; what has to be computed on the surface is a function of it.
"""

from collections.abc import Iterable

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, PointerProperty, StringProperty
from numpy.typing import NDArray

from . import blender_data
from .alignment import Alignment, Directions, axis_directions, computed, mean_lines, uv_lines
from .blender_data import DataError
from .blender_density import attributes_seen, named_attribute, uv_layer_of


def _is_point_vector(attribute: bpy.types.Attribute) -> bool:
    return (attribute.domain, attribute.data_type) == ("POINT", "FLOAT_VECTOR")


def vector_names(
    settings: bpy.types.PropertyGroup, context: bpy.types.Context, _text: str
) -> Iterable[str]:
    return [item.name for item in attributes_seen(settings, context) if _is_point_vector(item)]


def _is_curve(_settings: bpy.types.PropertyGroup, object: bpy.types.Object) -> bool:
    return object.type == "CURVE"


# ------------------------------------------------------------------------------------------------
# Settings


class AlignmentSettings:
    """The part of MeanderSettings that says which way the strands run."""

    alignment_source: EnumProperty(
        name="Follow",
        description="The directions that strands run along; their spacing stays the same",
        items=(
            ("NONE", "None", "No direction is preferred"),
            ("AXIS", "Axis", "An axis of the world or the object, as it lies in the surface"),
            ("CURVATURE", "Curvature", "Along what bends least, or most"),
            ("SMOOTH", "Smooth Field", "The smoothest field of directions on the surface"),
            ("STROKES", "Curves", "Curves drawn on the surface, continued smoothly between them"),
            ("UV", "UV Map", "The U or V lines of a UV map"),
            ("ATTRIBUTE", "Attribute", "A vector attribute of points, as Geometry Nodes make"),
        ),
        default="NONE",
        options=set(),
    )
    alignment_weight: FloatProperty(
        name="Weight",
        description=(
            "How strongly strands turn into the directions; 1 is clear to see, far more makes "
            "the spacing less even"
        ),
        default=1.0,
        min=0.0,
        max=1e6,
        soft_max=5.0,
        precision=2,
        step=10,
        options=set(),
    )
    align_across: BoolProperty(
        name="Across",
        description="Run at right angles to the directions instead of along them",
        default=False,
        options=set(),
    )
    alignment_axis: EnumProperty(
        name="Axis",
        description="The axis that strands run along, as it lies in the surface",
        items=(("X", "X", "The X axis"), ("Y", "Y", "The Y axis"), ("Z", "Z", "The Z axis")),
        default="Z",
        options=set(),
    )
    alignment_space: EnumProperty(
        name="Space",
        description="Whose axis it is",
        items=(
            ("WORLD", "World", "It stays when the object is turned"),
            ("LOCAL", "Object", "It turns with the object"),
        ),
        default="WORLD",
        options=set(),
    )
    alignment_curvature: EnumProperty(
        name="Bending",
        description="Which of the two principal directions strands run along",
        items=(
            ("MIN", "Least", "Along a limb: strands bend as little as possible"),
            ("MAX", "Most", "Round a limb: strands show its shape"),
        ),
        default="MIN",
        options=set(),
    )
    alignment_smoothing: FloatProperty(
        name="Smoothing",
        description=(
            "Average the curvature over this many halves of the spacing; more leaves out small "
            "features, 0 takes every dent"
        ),
        default=2.0,
        min=0.0,
        soft_max=10.0,
        precision=1,
        step=50,
        options=set(),
    )
    alignment_strokes: PointerProperty(
        type=bpy.types.Object,
        name="Curves",
        description=(
            "Curve object whose splines show the way on or near the surface; parts of the mesh "
            "without a spline are left free"
        ),
        poll=_is_curve,
        options=set(),
    )
    alignment_uv: EnumProperty(
        name="Lines",
        description="Which lines of the UV map strands run along",
        items=(
            ("U", "U", "Where V stays the same"),
            ("V", "V", "Where U stays the same"),
        ),
        default="U",
        options=set(),
    )
    alignment_uv_map: StringProperty(
        name="UV Map",
        description="UV map whose lines strands follow. Empty: the active one",
        options=set(),
    )
    alignment_attribute: StringProperty(
        name="Attribute",
        description=(
            "Vector attribute of points, in the object's space; where it is zero no direction is "
            "preferred"
        ),
        search=vector_names,
        search_options={"SUGGESTION"},
        options=set(),
    )


def alignment_of(settings: bpy.types.PropertyGroup) -> Alignment:
    """What the settings of an object say."""
    source = settings.alignment_source
    names = {
        "ATTRIBUTE": settings.alignment_attribute,
        "UV": settings.alignment_uv_map,
        "STROKES": settings.alignment_strokes.name if settings.alignment_strokes else "",
    }
    choices = {
        "AXIS": settings.alignment_axis,
        "CURVATURE": settings.alignment_curvature,
        "UV": settings.alignment_uv,
    }
    return Alignment(
        source=source,
        weight=float(f"{settings.alignment_weight:.6g}"),
        across=settings.align_across,
        name=names.get(source, ""),
        choice=choices.get(source, ""),
        local=settings.alignment_space == "LOCAL",
        smoothing=float(f"{settings.alignment_smoothing:.6g}"),
    )


def store_alignment(alignment: Alignment, settings: bpy.types.PropertyGroup) -> None:
    """Writes an alignment into the settings of an object; alignment_of() then gives it back."""
    settings.alignment_source = alignment.source
    settings.alignment_weight = alignment.weight
    settings.align_across = alignment.across
    settings.alignment_space = "LOCAL" if alignment.local else "WORLD"
    settings.alignment_smoothing = alignment.smoothing
    if alignment.source == "STROKES":
        settings.alignment_strokes = bpy.data.objects.get(alignment.name)
    elif alignment.source == "ATTRIBUTE":
        settings.alignment_attribute = alignment.name
    elif alignment.source == "UV":
        settings.alignment_uv_map, settings.alignment_uv = alignment.name, alignment.choice
    elif alignment.source == "AXIS":
        settings.alignment_axis = alignment.choice
    elif alignment.source == "CURVATURE":
        settings.alignment_curvature = alignment.choice


# ------------------------------------------------------------------------------------------------
# Directions


def directions_of(
    alignment: Alignment,
    surface: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
    radius: float,
) -> Directions | None:
    """The directions (n, 3) at the vertices of blender_data.triangles_of(), in world space, or what
    computes them; None where none are followed.

    radius   r, half the spacing

    Raises DataError with one sentence for what is missing or of another kind.
    """
    if alignment.source == "NONE" or alignment.weight == 0.0:
        return None
    if alignment.source == "CURVATURE":
        kind = f"curvature_{alignment.choice.lower()}"
        return computed(kind, alignment.smoothing * radius)
    if alignment.source == "SMOOTH":
        return computed("smooth")
    if alignment.source == "STROKES":
        return _continued_strokes(alignment, depsgraph)
    with blender_data.surface_mesh(surface, depsgraph) as (mesh, matrix):
        if alignment.source == "AXIS":
            frame = matrix[:3, :3] if alignment.local else np.eye(3)
            return axis_directions(frame, alignment.choice, len(mesh.vertices))
        if alignment.source == "UV":
            return _lines_of_uv_map(alignment, surface, mesh, matrix)
        return _vectors(alignment, surface, mesh, matrix)


def _continued_strokes(alignment: Alignment, depsgraph: bpy.types.Depsgraph) -> Directions:
    strokes = bpy.data.objects.get(alignment.name) if alignment.name else None
    if strokes is None:
        raise DataError("The alignment has no curves to follow; choose a curve object")
    seed = blender_data.strands_of_curve(strokes, depsgraph)
    pieces = []
    for begin, end, closed in zip(seed.offsets[:-1], seed.offsets[1:], seed.closed):
        points = seed.points[begin:end]
        pieces.append(np.vstack([points, points[:1]]) if closed else points)
    offsets = np.cumsum([0] + [len(piece) for piece in pieces]).astype(np.uint32)
    points = np.vstack(pieces)
    return lambda surface: surface.extended_directions(points, offsets)


def _vectors(
    alignment: Alignment, surface: bpy.types.Object, mesh: bpy.types.Mesh, matrix: np.ndarray
) -> NDArray[np.float64]:
    if not alignment.name:
        raise DataError("The alignment has no attribute; choose a vector attribute of points")
    attribute = named_attribute(
        mesh, alignment.name, surface, _is_point_vector, "vector attribute of points"
    )
    vectors = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    attribute.data.foreach_get("vector", vectors)
    return vectors.reshape(-1, 3).astype(np.float64) @ matrix[:3, :3].T


def _lines_of_uv_map(
    alignment: Alignment, surface: bpy.types.Object, mesh: bpy.types.Mesh, matrix: np.ndarray
) -> NDArray[np.float64]:
    """At every vertex the mean line of its triangles along which the other coordinate stays."""
    layer = uv_layer_of(mesh, alignment.name, surface)
    mesh.calc_loop_triangles()
    corners = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("loops", corners)
    faces = np.empty_like(corners)
    mesh.loop_triangles.foreach_get("vertices", faces)
    faces = faces.reshape(-1, 3)
    uv = np.empty(2 * len(layer.data), dtype=np.float32)
    layer.data.foreach_get("uv", uv)
    uv = uv.reshape(-1, 2).astype(np.float64)[corners.reshape(-1, 3)]
    positions = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", positions)
    places = blender_data.to_world(positions.reshape(-1, 3), matrix)[faces]
    lines = uv_lines(places, uv, "UV".index(alignment.choice))
    return mean_lines(lines, faces, len(mesh.vertices))
