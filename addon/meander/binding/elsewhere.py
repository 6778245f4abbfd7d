# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of other libraries of Python, trimesh and PyVista, known by what they have, so that
neither is imported for it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import MeanderError
from .files import triangulated
from .handle import checked_array


def mesh_arrays(
    vertices: Any, faces: ArrayLike | None
) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Vertices (n, 3) and faces (m, 3) of arrays, or of a mesh that is given as the vertices.

    A mesh has `vertices` and `faces`, as trimesh's, or `points` and a list of `faces` with the
    number of corners before each, as PyVista's PolyData; polygons become triangles. Raises
    MeanderError for what is neither.
    """
    if faces is None:
        mesh = vertices
        if hasattr(mesh, "points") and hasattr(mesh, "faces"):
            vertices, faces = mesh.points, _triangles_of(mesh)
        elif hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
            vertices, faces = mesh.vertices, mesh.faces
        else:
            raise MeanderError(
                "a surface is made of vertices and faces, or of a mesh of trimesh or PyVista "
                f"(PolyData); this is one {type(mesh).__name__}"
            )
    vertex_array = checked_array("vertices", vertices, np.float64, 3)
    return vertex_array, checked_array("faces", faces, np.uint32, 3)


def _triangles_of(mesh: Any) -> NDArray[np.uint32]:
    """The triangles of a mesh of PyVista."""
    listed = np.asarray(mesh.faces, dtype=np.int64)
    if len(listed) % 4 == 0 and (listed[::4] == 3).all():
        return listed.reshape(-1, 4)[:, 1:].astype(np.uint32)
    starts, at = [], 0
    while at < len(listed):
        starts.append(at)
        at += int(listed[at]) + 1
    corners = np.delete(listed, starts).astype(np.uint32)
    points = np.asarray(mesh.points, dtype=np.float64)
    return triangulated(points, corners, np.cumsum(listed[starts]).astype(np.uint64))[0]
