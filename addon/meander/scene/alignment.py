# SPDX-License-Identifier: GPL-3.0-or-later
"""Which direction the strands follow: what the settings say, and the directions that they name.

Directions are lines: their signs and lengths do not matter. What can be read is an array per vertex
of the evaluated mesh, in world space; what has to be computed on the surface is a function of it.
"""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

from ..model.alignment import (
    Alignment,
    Directions,
    axis_on,
    computed,
    mean_lines,
    turned,
    uv_lines,
)
from ..model.density import Choice
from .attributes import is_color, is_number, is_point_vector, named_attribute, uv_of
from .columns import column
from .curve_reader import strands_of_curve
from .density import painted_values
from .errors import DataError
from .evaluated import matrix_of, surface_mesh
from .meshes import triangles_of
from .transforms import to_world


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
        angle_source=settings.alignment_angle,
        angle_name=_angle_name(settings),
        angle_uv_map=settings.alignment_angle_uv_map,
    )


def _angle_name(settings: bpy.types.PropertyGroup) -> str:
    source = settings.alignment_angle
    if source == "IMAGE":
        return settings.alignment_angle_image.name if settings.alignment_angle_image else ""
    return "" if source == "NONE" else getattr(settings, f"alignment_angle_{source.lower()}")


def store_alignment(alignment: Alignment, settings: bpy.types.PropertyGroup) -> None:
    """Writes an alignment into the settings of an object; alignment_of() then gives it back."""
    settings.alignment_source = alignment.source
    settings.alignment_weight = alignment.weight
    settings.align_across = alignment.across
    settings.alignment_space = "LOCAL" if alignment.local else "WORLD"
    settings.alignment_smoothing = alignment.smoothing
    settings.alignment_angle = alignment.angle_source
    settings.alignment_angle_uv_map = alignment.angle_uv_map
    if alignment.angle_source == "IMAGE":
        settings.alignment_angle_image = bpy.data.images.get(alignment.angle_name)
    elif alignment.angle_source != "NONE":
        name = f"alignment_angle_{alignment.angle_source.lower()}"
        setattr(settings, name, alignment.angle_name)
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
    """The directions (n, 3) at the vertices of meshes.triangles_of(), in world space, or what
    computes them; None where none are followed.

    radius   r, half the spacing

    Raises DataError with one sentence for what is missing or of another kind.
    """
    if alignment.source == "NONE" or alignment.weight == 0.0:
        return None
    named = _named_directions(alignment, surface, depsgraph, radius)
    if alignment.angle_source == "NONE":
        return named
    return turned(named, _angles_of(alignment, surface, depsgraph))


def angle_source_of(
    name: str, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> str:
    """What of a surface or of the file has this name, and can be an angle: a vertex group before a
    attribute of numbers, a color attribute and an image. Raises DataError where nothing has."""
    if surface.type == "MESH" and name in surface.vertex_groups:
        return "GROUP"
    with surface_mesh(surface, depsgraph) as (mesh, _matrix):
        attribute = mesh.attributes.get(name)
        if attribute is not None and is_number(attribute):
            return "ATTRIBUTE"
        if attribute is not None and is_color(attribute):
            return "COLOR"
    if name in bpy.data.images:
        return "IMAGE"
    raise DataError(
        f"'{surface.name}' has no vertex group, attribute of numbers or color attribute "
        f"'{name}', and the file has no such image; name one of these for the angle"
    )


# Of full weight or white; an attribute is in degrees by itself.
_DEGREES = 180.0


def _angles_of(
    alignment: Alignment, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> NDArray[np.float64]:
    """In degrees, per vertex."""
    source, name = alignment.angle_source, alignment.angle_name
    if source == "GROUP" and not name:
        raise DataError("The angle has no vertex group; choose one, or paint one")
    choice = Choice(source, name, uv_map=alignment.angle_uv_map)
    values = painted_values(choice, surface, depsgraph, "angle")
    return values if source == "ATTRIBUTE" else _DEGREES * values


def _named_directions(
    alignment: Alignment,
    surface: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
    radius: float,
) -> Directions:
    if alignment.source == "CURVATURE":
        kind = f"curvature_{alignment.choice.lower()}"
        return computed(kind, alignment.smoothing * radius)
    if alignment.source in ("SMOOTH", "BOUNDARY"):
        return computed(alignment.source.lower())
    if alignment.source == "STROKES":
        return _continued_strokes(alignment, depsgraph)
    if alignment.source == "AXIS":
        vertices, faces = triangles_of(surface, depsgraph)
        frame = matrix_of(surface, depsgraph)[:3, :3] if alignment.local else np.eye(3)
        axis = axis_on(alignment.choice, frame, vertices, faces)
        if axis.problem:
            raise DataError(axis.problem)
        return axis.directions(len(vertices))
    with surface_mesh(surface, depsgraph) as (mesh, matrix):
        if alignment.source == "UV":
            return _lines_of_uv_map(alignment, surface, mesh, matrix)
        return _vectors(alignment, surface, mesh, matrix)


def _continued_strokes(alignment: Alignment, depsgraph: bpy.types.Depsgraph) -> Directions:
    strokes = bpy.data.objects.get(alignment.name) if alignment.name else None
    if strokes is None:
        raise DataError("The alignment has no curves to follow; choose a curve object")
    seed = strands_of_curve(strokes, depsgraph)
    pieces = []
    for begin, end, closed in zip(seed.offsets[:-1], seed.offsets[1:], seed.closed):
        points = seed.points[begin:end]
        pieces.append(np.vstack([points, points[:1]]) if closed else points)
    offsets = np.cumsum([0] + [len(piece) for piece in pieces]).astype(np.uint32)
    points = np.vstack(pieces)
    return lambda surface, context=None: surface.extended_directions(points, offsets, context)


def _vectors(
    alignment: Alignment, surface: bpy.types.Object, mesh: bpy.types.Mesh, matrix: np.ndarray
) -> NDArray[np.float64]:
    if not alignment.name:
        raise DataError("The alignment has no attribute; choose a vector attribute of points")
    attribute = named_attribute(
        mesh, alignment.name, surface, is_point_vector, "vector attribute of points"
    )
    vectors = column(attribute.data, "vector", 3)
    return vectors.astype(np.float64) @ matrix[:3, :3].T


def _lines_of_uv_map(
    alignment: Alignment, surface: bpy.types.Object, mesh: bpy.types.Mesh, matrix: np.ndarray
) -> NDArray[np.float64]:
    """At every vertex the mean line of its triangles along which the other coordinate stays."""
    mesh.calc_loop_triangles()
    corners = column(mesh.loop_triangles, "loops", 3, np.int32)
    faces = column(mesh.loop_triangles, "vertices", 3, np.int32)
    uv = uv_of(mesh, alignment.name, surface).astype(np.float64)[corners]
    places = to_world(column(mesh.vertices, "co", 3), matrix)[faces]
    lines = uv_lines(places, uv, "UV".index(alignment.choice))
    return mean_lines(lines, faces, len(mesh.vertices))
