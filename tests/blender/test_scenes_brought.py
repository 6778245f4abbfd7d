# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects as scenes have them: what is filled is what Blender shows, with its size in the world.

The yardstick is the mesh that Blender evaluates, with the object's matrix applied vertex by vertex.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from mathutils.bvhtree import BVHTree
from scenes import activate, cube, fill, grid, poly_curve, sphere, world_splines

SPACING = 0.25


def scaled_unevenly() -> bpy.types.Object:
    thing = sphere()
    thing.scale = (1.0, 2.0, 0.7)
    return thing


def mirrored_and_turned() -> bpy.types.Object:
    thing = sphere()
    thing.scale, thing.rotation_euler = (-1.0, 1.0, 1.0), (0.3, 0.5, 0.1)
    return thing


def sheared_by_its_parent() -> bpy.types.Object:
    thing = cube()
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(parent)
    parent.scale = (2.0, 1.0, 1.0)
    thing.parent = parent
    thing.rotation_euler.z = 0.6
    return activate(thing)


def moved_off_by_its_parent() -> bpy.types.Object:
    thing = grid()
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(parent)
    thing.parent = parent
    thing.matrix_parent_inverse = Matrix.Translation((40.0, -3.0, 2.0))
    return activate(thing)


def subdivided() -> bpy.types.Object:
    thing = cube()
    modifier = thing.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = 3
    return thing


def thickened() -> bpy.types.Object:
    thing = grid(cells=10)
    thing.modifiers.new("Solidify", "SOLIDIFY").thickness = 0.3
    return thing


def arrayed() -> bpy.types.Object:
    thing = sphere(0.6)
    array = thing.modifiers.new("Array", "ARRAY")
    array.count, array.relative_offset_displace = 2, (1.5, 0.0, 0.0)
    return thing


def cut_by_another() -> bpy.types.Object:
    other = cube()
    other.location, other.hide_render = (1.0, 1.0, 1.0), True
    thing = cube()
    cut = thing.modifiers.new("Boolean", "BOOLEAN")
    cut.operation, cut.object, cut.solver = "DIFFERENCE", other, "EXACT"
    return activate(thing)


def of_a_shape_key() -> bpy.types.Object:
    thing = grid(cells=20)
    thing.shape_key_add(name="Basis")
    hill = thing.shape_key_add(name="Hill")
    for point in hill.data:
        point.co.z = 0.6 * math.exp(-3.0 * (point.co.x**2 + point.co.y**2))
    hill.value = 1.0
    return thing


def a_bevelled_curve() -> bpy.types.Object:
    ring = [(math.cos(t), math.sin(t), 0.0) for t in np.linspace(0, 2 * math.pi, 32, False)]
    thing = poly_curve("Tube", [ring], cyclic=True)
    thing.data.bevel_depth, thing.data.bevel_resolution = 0.3, 4
    return activate(thing)


def a_metaball() -> bpy.types.Object:
    bpy.ops.object.metaball_add(radius=1.5)
    data = bpy.context.object.data
    data.resolution = data.render_resolution = 0.2
    return activate(bpy.context.object)


def a_nurbs_surface() -> bpy.types.Object:
    bpy.ops.surface.primitive_nurbs_surface_sphere_add()
    return activate(bpy.context.object)


def in_scene_units_of_centimetres() -> bpy.types.Object:
    bpy.context.scene.unit_settings.scale_length = 0.01
    return sphere()


SCENES = (
    scaled_unevenly, mirrored_and_turned, sheared_by_its_parent, moved_off_by_its_parent,
    subdivided, thickened, arrayed, cut_by_another, of_a_shape_key, a_bevelled_curve, a_metaball,
    a_nurbs_surface, in_scene_units_of_centimetres,
)  # fmt: skip


def shown(thing: bpy.types.Object) -> tuple[BVHTree, float, np.ndarray]:
    """What Blender shows of an object: a tree of its faces, its area, and its bounds."""
    bpy.context.view_layer.update()
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    vertices = [evaluated.matrix_world @ vertex.co for vertex in mesh.vertices]
    mesh.calc_loop_triangles()  # polygons that are not flat have the corners that Blender draws
    triangles = [tuple(triangle.vertices) for triangle in mesh.loop_triangles]
    area = sum(
        (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]).length / 2.0
        for a, b, c in triangles
    )
    points = np.array([vertex[:] for vertex in vertices])
    evaluated.to_mesh_clear()
    return BVHTree.FromPolygons(vertices, triangles), area, points


@pytest.mark.parametrize("build", SCENES, ids=lambda build: build.__name__)
def test_what_is_shown_is_filled(build: Callable[[], bpy.types.Object]) -> None:
    thing = build()
    tree, area, points = shown(thing)
    splines = world_splines(fill(thing, SPACING))
    size = float(np.ptp(points, axis=0).max())
    length = 0.0
    for way, cyclic in splines:
        away = [tree.find_nearest(place)[3] for place in way[:: max(1, len(way) // 500)]]
        # Single precision, of places that may be far from the origin.
        assert max(away) < 1e-4 * max(size, float(np.abs(points).max()))
        around = np.vstack([way, way[:1]]) if cyclic else way
        length += float(np.linalg.norm(np.diff(around, axis=0), axis=1).sum())
    assert SPACING * length / area == pytest.approx(1.0, abs=0.15)
    # It reaches everywhere: the bounds are those of what is shown, up to a spacing.
    every = np.vstack([way for way, _cyclic in splines])
    assert every.min(axis=0) == pytest.approx(points.min(axis=0), abs=1.1 * SPACING)
    assert every.max(axis=0) == pytest.approx(points.max(axis=0), abs=1.1 * SPACING)
