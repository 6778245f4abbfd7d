# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drawing takes from the scene: the UV map that lays it flat, the view, the unit."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np
from mathutils import Vector

from ..model.toolpaths import toolpath
from ..model.toolpaths.unrolling import unrolled
from .attributes import uv_of
from .errors import DataError
from .evaluated import surface_mesh
from .meshes import triangles_of
from .points import bind
from .triangulation import loops_of


def metres_of(scene: bpy.types.Scene) -> float:
    """The length of a scene unit."""
    units = scene.unit_settings
    return float(units.scale_length) if units.system != "NONE" else 1.0


def unrolled_strands(
    strands: Sequence[toolpath.Strand],
    surface: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
    uv_map: str,
) -> list[toolpath.Strand]:
    """Strands laid flat by a UV map of their surface, in the scene's units.

    strands   with faces, as triangles_of() numbers them
    uv_map    its name; empty: the active one

    Raises DataError where there is no such map, or nothing in it.
    """
    vertices, faces = triangles_of(surface, depsgraph)
    mesh = toolpath.Mesh(vertices, faces)
    uv = map_of(surface, depsgraph, uv_map)
    flat = unrolled(strands, mesh, uv, lambda points: bind(points, vertices, faces))
    if not flat:
        raise DataError(f"The UV map of '{surface.name}' has no area; unwrap the mesh again")
    return flat


def has_map(surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bool:
    """Whether a surface has a UV map to be laid flat by."""
    with surface_mesh(surface, depsgraph) as (mesh, _matrix):
        return len(mesh.uv_layers) > 0


def map_of(
    surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph, uv_map: str
) -> np.ndarray:
    """The map at the corners of the triangles of triangles_of(), (n, 3, 2)."""
    with surface_mesh(surface, depsgraph) as (mesh, matrix):
        places = uv_of(mesh, uv_map, surface)
        corners = loops_of(mesh)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        corners = corners[:, ::-1]
    return places.astype(np.float64)[corners]


def axes_of_view(view: bpy.types.RegionView3D | None) -> tuple[Vector, Vector]:
    """To the right and up in a 3D view. Raises DataError without a view."""
    if view is None:
        raise DataError("There is no 3D view to see the curve in; choose another layout")
    rotation = view.view_rotation
    return rotation @ Vector((1, 0, 0)), rotation @ Vector((0, 1, 0))
