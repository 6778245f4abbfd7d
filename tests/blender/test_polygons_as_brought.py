# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons that are there twice, and polygons of very many corners, in Blender."""

from __future__ import annotations

import bpy
import numpy as np
from meander import core
from meander.model.preparation import Repair
from meander.scene.layouts import map_of
from meander.scene.meshes import polygons_of, triangles_of
from scenes import activate, column, fill, grid, mesh_object

CORNERS = 40_000


def told(surface: bpy.types.Object) -> str:
    return surface.meander.last_result.meander.figures.preparation


def test_a_solidify_without_thickness_is_filled_once():
    surface = grid(8)
    for vertex in surface.data.vertices:
        vertex.co.z = 0.2 * np.sin(3 * vertex.co.x) * np.cos(2 * vertex.co.y)
    surface.modifiers.new("Solidify", "SOLIDIFY").thickness = 0.0
    result = fill(surface, 0.3)
    assert result.meander.figures.lines == 1
    assert "doubled faces" in told(surface)


def traced() -> bpy.types.Object:
    """A polygon of 40,000 corners, with a UV map that repeats its places."""
    turn = np.arange(CORNERS) * 2 * np.pi / CORNERS
    radius = 1 + 0.2 * np.sin(37 * turn)
    places = np.stack([radius * np.cos(turn), radius * np.sin(turn), 0 * turn], axis=1)
    surface = mesh_object("Traced", places, [tuple(range(CORNERS))])
    layer = surface.data.uv_layers.new(name="Map")
    corners = column(surface.data.loops, "vertex_index", kind=np.int32)
    layer.data.foreach_set("uv", places[corners, :2].astype(np.float32).ravel())
    return surface


def test_a_traced_outline_stays_in_one_piece():
    surface = traced()
    activate(surface)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    vertices, faces = triangles_of(surface, depsgraph)
    prepared = Repair().options(vertices, 0.05, polygons_of(surface, depsgraph))
    with core.Surface(vertices, faces, prepared) as found:
        figures = found.statistics()
    assert (figures["components"], figures["boundary_loops"]) == (1, 1)
    # What else is asked by triangle has the same triangles.
    uv = map_of(surface, depsgraph, "Map")
    assert np.abs(uv - vertices[faces][:, :, :2]).max() < 1e-6
