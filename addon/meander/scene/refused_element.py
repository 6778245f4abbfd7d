# SPDX-License-Identifier: GPL-3.0-or-later
"""The element of a mesh because of which it was refused: remembered, and found again."""

from __future__ import annotations

import bpy
import numpy as np

from .. import core
from .errors import DataError
from .evaluated import surface_mesh


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
        with surface_mesh(surface, depsgraph) as (mesh, _matrix):
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
    with surface_mesh(surface, depsgraph) as (evaluated, _matrix):
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
