# SPDX-License-Identifier: GPL-3.0-or-later
"""The faults of a mesh: remembered in words, and selected in the mesh itself."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from .. import core
from ..model.preparation import seam_width
from .errors import DataError
from .linked_settings import settings_of, settings_to_change
from .transforms import to_world, world_matrix

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
    mesh.calc_loop_triangles()
    triangles = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    coordinates = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", coordinates)
    vertices = to_world(coordinates.reshape(-1, 3), world_matrix(surface))
    if not len(triangles):
        raise DataError(f"'{surface.name}' has no faces; add some, or choose another mesh")
    faults = core.find_faults(
        vertices, triangles.reshape(-1, 3).astype(np.uint32), seam_width(vertices, radius)
    )
    if not len(faults.kinds):
        by = "its modifiers make them" if len(surface.modifiers) else "it has been corrected"
        raise DataError(f"The mesh of '{surface.name}' has no faults; {by}")
    return _located(mesh, faults)


def _located(mesh: bpy.types.Mesh, faults: core.Faults) -> Located:
    polygons = np.empty(len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("polygon_index", polygons)
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
    own = np.empty(2 * len(mesh.edges), dtype=np.int32)
    mesh.edges.foreach_get("vertices", own)
    own = np.sort(own.reshape(-1, 2), axis=1).astype(np.int64)
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
    edge_of_loop = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("edge_index", edge_of_loop)
    for face in faces.tolist():
        for loop in mesh.polygons[face].loop_indices:
            mesh.edges[int(edge_of_loop[loop])].select = True
