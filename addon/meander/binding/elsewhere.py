# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and curves of other libraries of Python: trimesh and PyVista, which are not needed for
anything else. A mesh is known by what it has, so that neither is imported for it."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .files import triangulated
from .native_library import MeanderError, checked_array

if TYPE_CHECKING:
    from .flow import PointData, Polylines


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


def _imported(name: str, package: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as missing:
        raise MeanderError(
            f"this needs the Python package {package}, which is not there ({missing}); install it "
            f"with python3 -m pip install {package}"
        ) from missing


def _values(curve: Polylines, data: PointData | None) -> dict[str, NDArray]:
    """What is known of the points, by name."""
    if data is None:
        return {}
    if len(data.arc_lengths) != len(curve.positions):
        raise MeanderError(
            f"the data are of {len(data.arc_lengths)} points and the curve has "
            f"{len(curve.positions)}; take both from the flow at the same time"
        )
    return {
        "arc_length": data.arc_lengths,
        "tangent": data.tangents,
        "r_plus": data.radii[:, 0],
        "r_minus": data.radii[:, 1],
        "face": data.faces,
        "weights": data.barycentrics,
    }


def _orders(curve: Polylines) -> list[NDArray[np.int64]]:
    """The points of each strand in order, of a closed one with the first again at the end."""
    offsets = np.asarray(curve.offsets, dtype=np.int64)
    return [
        np.append(np.arange(begin, end), [begin] if closed else []).astype(np.int64)
        for begin, end, closed in zip(offsets[:-1], offsets[1:], curve.closed, strict=True)
    ]


def path_of(curve: Polylines, data: PointData | None) -> Any:
    """A curve as a trimesh.path.Path3D; see Polylines.to_trimesh."""
    entities = _imported("trimesh.path.entities", "trimesh")
    return _imported("trimesh.path", "trimesh").Path3D(
        entities=[entities.Line(order) for order in _orders(curve)],
        vertices=np.array(curve.positions),
        vertex_attributes={"normal": np.array(curve.normals), **_values(curve, data)},
        process=False,
    )


def poly_data_of(curve: Polylines, data: PointData | None) -> Any:
    """A curve as a pyvista.PolyData; see Polylines.to_pyvista."""
    pyvista = _imported("pyvista", "pyvista")
    orders = _orders(curve)
    lines = np.concatenate([np.append(len(order), order) for order in orders] or [[]])
    made = pyvista.PolyData(np.array(curve.positions), lines=lines.astype(np.int64))
    made.point_data["Normals"] = np.array(curve.normals)
    for name, values in _values(curve, data).items():
        made.point_data[name] = values
    made.cell_data["strand"] = np.arange(len(orders))
    return made
