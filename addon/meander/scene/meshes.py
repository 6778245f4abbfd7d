# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces: the triangles of mesh objects, and the values that their vertices have."""

from __future__ import annotations

import re

import bpy
import numpy as np

from .. import core
from .columns import column
from .errors import DataError
from .evaluated import instances_of, is_evaluated, surface_mesh
from .fillable import kinds_shown
from .rendered import rendering_of
from .transforms import check_invertible, to_world, world_matrix
from .triangulation import vertices_of


def triangles_of(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> tuple[np.ndarray, np.ndarray]:
    """The triangles of a mesh object with its modifiers applied, in world units; as a render shows
    it where evaluated.surface_mesh() does.

    Works in Edit Mode and for hidden objects. Where the transform mirrors, faces are flipped, so
    that they face outward as Blender shows them.

    Returns vertices float64 (n, 3) and faces uint32 (m, 3). Raises DataError (a ValueError) with
    one sentence for what is not a mesh, has no faces, or is scaled to nothing.
    """
    with surface_mesh(object, depsgraph) as (mesh, matrix):
        check_invertible(object, matrix)
        coordinates = column(mesh.vertices, "co", 3)
        indices = vertices_of(mesh)
    if not len(indices):
        shown = kinds_shown(object, depsgraph)
        if shown and shown <= {"CURVE", "CURVES"}:
            raise DataError(
                f"'{object.name}' shows curves only, which have no faces; add a Curve to Mesh node "
                "with a profile at the end of its Geometry Nodes, or choose a mesh with faces"
            )
        if shown and shown <= {"POINTCLOUD"}:
            raise DataError(
                f"'{object.name}' shows points only, which have no faces; add an Instance on "
                "Points node with a mesh at the end of its Geometry Nodes, to fill a copy at each"
            )
        if shown:
            raise DataError(
                f"'{object.name}' shows instances, none of them of a mesh with faces; instance "
                "meshes instead, or use Object > Apply > Make Instances Real"
            )
        raise DataError(f"'{object.name}' has no faces; choose a mesh with faces as the surface")
    faces = indices.astype(np.uint32)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        faces = np.ascontiguousarray(faces[:, ::-1])
    return to_world(coordinates, matrix), faces


def polygons_of(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> np.ndarray | None:
    """Per triangle of triangles_of() its polygon, uint32; None: each is one."""
    with surface_mesh(object, depsgraph) as (mesh, _matrix):
        mesh.calc_loop_triangles()
        count = len(mesh.loop_triangles)
        if len(mesh.polygons) == count:
            return None
        polygons = column(mesh.loop_triangles, "polygon_index", kind=np.int32)
    return polygons.astype(np.uint32)


def surface_now(
    surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """World vertices, triangles and world matrix of a surface as `depsgraph` has evaluated it.

    Unlike triangles_of it updates nothing, so that a frame handler may call it. Raises DataError
    for a surface that is hidden, and so not evaluated, and for one that renders otherwise.
    """
    if not is_evaluated(surface, depsgraph):
        raise DataError(
            f"'{surface.name}' is hidden, so that Blender does not evaluate it; show it, display "
            "it as Bounds instead, or bake the frames"
        )
    if len(instances_of(surface, depsgraph).sizes):
        raise DataError(
            f"'{surface.name}' shows instances, which a curve does not follow in the view; bake "
            "the frames, or add a Realize Instances node at the end of its Geometry Nodes"
        )
    rendering = rendering_of(surface, depsgraph.scene) if depsgraph.mode == "VIEWPORT" else None
    if rendering is not None and rendering.may_be_filled:
        raise DataError(
            f"'{surface.name}' renders otherwise than the view shows; press Show as Rendered or "
            "Render as Shown, or bake the frames"
        )
    evaluated_surface = surface.evaluated_get(depsgraph)
    mesh = evaluated_surface.to_mesh()
    try:
        matrix = world_matrix(evaluated_surface)
        coordinates = column(mesh.vertices, "co", 3)
        indices = vertices_of(mesh)
    finally:
        evaluated_surface.to_mesh_clear()
    faces = indices.astype(np.uint32)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        faces = np.ascontiguousarray(faces[:, ::-1])
    return to_world(coordinates, matrix), faces, matrix


def in_polygons(
    error: core.MeanderError, object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> core.MeanderError:
    """An error about a mesh with its faces named as Blender counts them; others as they are.

    The library knows triangles only; a user sees polygons, of the mesh with its modifiers.
    """
    if error.status != core.Status.INVALID_MESH:
        return error
    with surface_mesh(object, depsgraph) as (mesh, _matrix):
        mesh.calc_loop_triangles()
        polygons = column(mesh.loop_triangles, "polygon_index", kind=np.int32)

    def named(match: re.Match[str]) -> str:
        return re.sub(r"\d+", lambda number: str(polygons[int(number[0])]), match[0])

    # "face 3", and "3 faces (0, 1, 2)": numbers of faces, not of vertices, and not how many.
    text = re.sub(r"(?<=[Ff]ace )\d+|(?<=faces \()[\d, ]+", named, str(error))
    return core.MeanderError(text, error.status, error.element_kind, error.elements)


def vertex_group_weights(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph, name: str
) -> np.ndarray:
    """The weights of a vertex group on the evaluated mesh, float64, 0 where a vertex is not in it.

    The order is that of the vertices of triangles_of(). A group that a Geometry Nodes modifier has
    turned into a named float attribute is found as well. Raises DataError for an unknown name.
    """
    with surface_mesh(object, depsgraph) as (mesh, _matrix):
        count = len(mesh.vertices)
        attribute = mesh.attributes.get(name)
        if attribute is not None and (attribute.domain, attribute.data_type) == ("POINT", "FLOAT"):
            return column(attribute.data, "value").astype(np.float64)
        group = object.vertex_groups.get(name)
        if group is None:
            known = ", ".join(f"'{other.name}'" for other in object.vertex_groups)
            raise DataError(
                f"'{object.name}' has no vertex group '{name}'; "
                + (f"it has {known}" if known else "paint one, or leave the field empty")
            )
        index = group.index
        weights = np.zeros(count, dtype=np.float64)
        for position, vertex in enumerate(mesh.vertices):
            for element in vertex.groups:
                if element.group == index:
                    weights[position] = element.weight
        return weights


def loose_edge_count(surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> int:
    """Edges of the evaluated mesh that no face has."""
    with surface_mesh(surface, depsgraph) as (mesh, _matrix):
        loose = np.ones(len(mesh.edges), dtype=bool)
        loose[column(mesh.loops, "edge_index", kind=np.int32)] = False
        return int(np.count_nonzero(loose))
