# SPDX-License-Identifier: GPL-3.0-or-later
"""The triangles of a Blender mesh: Blender's own, but for polygons of very many corners."""

from __future__ import annotations

import bpy
import numpy as np

from .. import core
from .columns import column, corner_counts, vertices_of_corners

# Triangles this flat count as faces without area (kFlatForRepair of the library), as a share of the
# size of the mesh.
_FLAT = 4e-8


def loops_of(mesh: bpy.types.Mesh) -> np.ndarray:
    """The three loops of each triangle, int32 (m, 3), in the order of mesh.loop_triangles.

    A polygon of which Blender makes slivers, such as a traced logo of 40,000 corners, is divided by
    the library instead, into as many triangles.
    """
    if _is_of_triangles(mesh):
        return np.arange(len(mesh.loops), dtype=np.int32).reshape(-1, 3)
    mesh.calc_loop_triangles()
    loops = column(mesh.loop_triangles, "loops", 3, np.int32)
    if _has_ngons(mesh):
        _divide_slivers(mesh, loops)
    return loops


def _is_of_triangles(mesh: bpy.types.Mesh) -> bool:
    """Whether the polygons are triangles, one after another: Blender's are the same then, and take
    longer to be read than all the rest."""
    count = len(mesh.polygons)
    if len(mesh.loops) != 3 * count:
        return False
    begins = column(mesh.polygons, "loop_start", kind=np.int32)
    return bool((begins == np.arange(0, 3 * count, 3, dtype=np.int32)).all())


def vertices_of(mesh: bpy.types.Mesh) -> np.ndarray:
    """The same with the three vertices of each triangle."""
    corners = vertices_of_corners(mesh)
    return corners.reshape(-1, 3) if _is_of_triangles(mesh) else corners[loops_of(mesh)]


def _has_ngons(mesh: bpy.types.Mesh) -> bool:
    return bool((corner_counts(mesh) > 4).any())


def _divide_slivers(mesh: bpy.types.Mesh, loops: np.ndarray) -> None:
    """Puts the library's triangles into the places of those of polygons that have slivers."""
    places = column(mesh.vertices, "co", 3).astype(np.float64)
    polygons = column(mesh.loop_triangles, "polygon_index", kind=np.int32)
    begins = column(mesh.polygons, "loop_start", kind=np.int32)
    totals = corner_counts(mesh)
    of_ngons = np.flatnonzero(totals[polygons] > 4)
    corners = vertices_of_corners(mesh)
    a, b, c = places[corners[loops[of_ngons]]].transpose(1, 0, 2)
    sides = np.stack([b - a, c - b, a - c])
    longest = np.linalg.norm(sides, axis=2).max(axis=0)
    heights = np.linalg.norm(np.cross(sides[0], sides[1]), axis=1)
    flat = heights <= _FLAT * np.linalg.norm(np.ptp(places, axis=0)) * longest
    wanted = np.unique(polygons[of_ngons[flat]])
    if not len(wanted):
        return
    # Loops for vertices, so that the triangles say which; all places, since the size of the mesh
    # decides what is flat.
    everywhere = np.concatenate([places[corners], places])
    given = [np.arange(begins[k], begins[k] + totals[k]) for k in wanted]
    ends = np.cumsum([len(one) for one in given])
    found, sources = core.triangulated(everywhere, np.concatenate(given), ends)
    for place, polygon in enumerate(wanted):
        own, slots = found[sources == place], np.flatnonzero(polygons == polygon)
        if len(own) == len(slots):
            loops[slots] = own
