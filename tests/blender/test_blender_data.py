# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes, weights and curves in; curves out."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from meander import core
from meander.scene import curve_reader, curve_writer, meshes
from scenes import (
    activate,
    circle_points,
    counts,
    cube,
    grid,
    matrix_of,
    mesh_object,
    points_of,
    poly_curve,
    sphere,
    world_splines,
)

# Blender stores coordinates as float32: half a unit in the last place, and a few operations.
FLOAT32 = 4e-7


def depsgraph() -> bpy.types.Depsgraph:
    return bpy.context.evaluated_depsgraph_get()


def volume(vertices: np.ndarray, faces: np.ndarray) -> float:
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)


# -- meshes in -------------------------------------------------------------------------------------


def test_triangles_are_in_world_units():
    thing = cube()
    thing.scale = (2.0, 3.0, 0.5)
    thing.location = (1.0, 2.0, 3.0)
    thing.rotation_euler = (0.3, 0.2, 0.1)
    vertices, faces = meshes.triangles_of(thing, depsgraph())
    assert (vertices.dtype, faces.dtype) == (np.float64, np.uint32)
    assert faces.shape == (12, 3)
    assert core.area_of(vertices, faces) == pytest.approx(2 * (24 + 4 + 6), rel=1e-6)
    assert volume(vertices, faces) == pytest.approx(24.0, rel=1e-6)


def test_modifiers_are_applied():
    thing = cube()
    thing.modifiers.new("Subdivision", "SUBSURF").levels = 2
    assert len(meshes.triangles_of(thing, depsgraph())[0]) == 98


def test_edit_mode_is_read_as_it_is_on_screen():
    import bmesh

    thing = cube()
    bpy.ops.object.mode_set(mode="EDIT")
    edited = bmesh.from_edit_mesh(thing.data)
    edited.verts.ensure_lookup_table()
    edited.verts[0].co.x = -7.0
    vertices, _faces = meshes.triangles_of(thing, depsgraph())
    assert vertices[:, 0].min() == pytest.approx(-7.0)
    bpy.ops.object.mode_set(mode="OBJECT")


def test_a_mirrored_surface_still_looks_outward():
    thing = cube()
    thing.scale = (-1.0, 1.0, 1.0)
    assert volume(*meshes.triangles_of(thing, depsgraph())) == pytest.approx(8.0)


def test_what_is_no_surface_is_refused():
    curve = poly_curve("Curve", [[(0, 0, 0), (1, 0, 0)]], False)
    with pytest.raises(ValueError, match="has no faces"):
        meshes.triangles_of(curve, depsgraph())
    with pytest.raises(ValueError, match="no faces"):
        meshes.triangles_of(mesh_object("Points", [(0, 0, 0)], []), depsgraph())
    flat = cube()
    flat.scale.z = 0.0
    with pytest.raises(ValueError, match="scale"):
        meshes.triangles_of(flat, depsgraph())


def test_weights_of_the_evaluated_mesh():
    thing = grid(cells=2)
    group = thing.vertex_groups.new(name="Other")
    group = thing.vertex_groups.new(name="Fine")
    group.add([0, 1, 2], 0.25, "REPLACE")
    weights = meshes.vertex_group_weights(thing, depsgraph(), "Fine")
    assert weights.tolist() == [0.25] * 3 + [0.0] * 6
    modifier = thing.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = 1
    weights = meshes.vertex_group_weights(thing, depsgraph(), "Fine")
    assert len(weights) == len(meshes.triangles_of(thing, depsgraph())[0]) == 25
    with pytest.raises(ValueError, match=r"no vertex group 'Coarse'; it has 'Other', 'Fine'"):
        meshes.vertex_group_weights(thing, depsgraph(), "Coarse")


# -- curves in -------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["POLY", "BEZIER", "NURBS"])
@pytest.mark.parametrize("cyclic", [False, True])
def test_strands_of_all_kinds_of_spline(kind, cyclic):
    strands = [circle_points(1.0, 0.0, 8), circle_points(2.0, 5.0, 8), circle_points(1.5, -5.0, 8)]
    thing = poly_curve("Seed", strands, cyclic, kind)
    thing.data.bevel_depth = 0.1
    thing.data.extrude = 0.2
    thing.location.x = 10.0
    before = counts()
    seed = curve_reader.strands_of_curve(thing, depsgraph())
    assert counts() == before
    assert thing.data.bevel_depth == pytest.approx(0.1)
    assert (seed.points.dtype, seed.offsets.dtype) == (np.float64, np.uint32)
    assert seed.closed.tolist() == [int(cyclic)] * 3
    assert seed.offsets[0] == 0 and seed.offsets[-1] == len(seed.points)
    for strand, (radius, height) in enumerate([(1.0, 0.0), (2.0, 5.0), (1.5, -5.0)]):
        points = seed.points[seed.offsets[strand] : seed.offsets[strand + 1]]
        assert points[:, 2] == pytest.approx(height)
        # In order along the circle: no step longer than between two of the eight points.
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        assert steps.max() < 0.8 * radius
        assert len({tuple(point) for point in points}) == len(points)
        assert points[:, 0].mean() == pytest.approx(10.0, abs=0.5 * radius)


def test_ends_of_open_strands_can_be_fixed():
    thing = poly_curve("Seed", [[(0, 0, 0), (1, 0, 0), (2, 0, 0)]], False)
    ring = thing.data.splines.new("POLY")
    ring.points.add(2)
    ring.use_cyclic_u = True
    seed = curve_reader.strands_of_curve(thing, depsgraph(), fixed_ends=True)
    assert seed.fixed.tolist() == [1, 0, 1, 0, 0, 0]
    assert curve_reader.strands_of_curve(thing, depsgraph()).fixed is None


def test_hidden_seeds_modifiers_and_edit_mode():
    thing = poly_curve("Seed", [circle_points(1.0, 0.0)], True)
    thing.modifiers.new("Array", "ARRAY").count = 2
    thing.hide_viewport = True
    seed = curve_reader.strands_of_curve(thing, depsgraph())
    assert seed.closed.tolist() == [1, 1]
    thing.hide_viewport = False
    thing.modifiers.clear()
    activate(thing)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.curve.select_all(action="SELECT")
    bpy.ops.transform.translate(value=(0.0, 0.0, 4.0))
    assert curve_reader.strands_of_curve(thing, depsgraph()).points[:, 2] == pytest.approx(4.0)
    bpy.ops.object.mode_set(mode="OBJECT")


def test_what_is_no_seed_is_refused():
    with pytest.raises(ValueError, match="has faces; choose a curve"):
        curve_reader.strands_of_curve(cube(), depsgraph())
    with pytest.raises(ValueError, match="two or more points"):
        curve_reader.strands_of_curve(poly_curve("Seed", [[(0, 0, 0)]], False), depsgraph())
    solid = poly_curve("Solid", [circle_points(1.0, 0.0)], True)
    solid.modifiers.new("Skin", "SOLIDIFY")
    solid.data.dimensions = "2D"
    solid.data.fill_mode = "BOTH"
    curve_reader.strands_of_curve(solid, depsgraph())  # the fill is left out


# -- curves out ------------------------------------------------------------------------------------


def polylines(strands: list[np.ndarray], closed: list[int]) -> core.Polylines:
    points = np.vstack(strands)
    offsets = np.cumsum([0] + [len(strand) for strand in strands]).astype(np.uint32)
    return core.Polylines(points, np.ones_like(points), offsets, np.array(closed, np.uint8))


def test_world_positions_are_exact_under_a_sheared_parent():
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(parent)
    parent.scale = (1.0, 4.0, 0.25)
    thing = sphere()
    thing.parent = parent
    thing.rotation_euler = (0.5, 0.6, 0.7)
    thing.matrix_parent_inverse = Matrix.Translation((1.0, 2.0, 3.0))
    thing.scale = (-1.0, 2.0, 0.5)
    vertices, faces = meshes.triangles_of(thing, depsgraph())
    centres = vertices[faces].mean(axis=1)
    curve = curve_writer.write_curve(
        polylines([centres[:50], centres[50:]], [1, 0]), thing, "Result"
    )
    assert curve.parent == thing
    (first, first_cyclic), (second, second_cyclic) = world_splines(curve)
    assert (first_cyclic, second_cyclic) == (True, False)
    scale = np.abs(centres).max()
    assert np.abs(np.vstack([first, second]) - centres).max() < 4 * FLOAT32 * scale
    # And it follows: after any change of the parent it still lies on the surface.
    parent.scale = (3.0, 1.0, 1.0)
    parent.rotation_euler.x = 1.0
    bpy.context.view_layer.update()
    vertices, faces = meshes.triangles_of(thing, depsgraph())
    moved = points_of(curve)
    assert np.abs(moved - vertices[faces].mean(axis=1)).max() < 8 * FLOAT32 * scale
    assert np.array_equal(matrix_of(curve), matrix_of(thing))


def test_a_curve_that_was_written_reads_back():
    thing = cube()
    thing.scale = (1.0, 2.0, 3.0)
    bpy.context.view_layer.update()
    points = np.array(circle_points(1.0, 3.0))
    curve = curve_writer.write_curve(polylines([points], [1]), thing, "Result", bevel_depth=0.1)
    bpy.context.view_layer.update()
    seed = curve_reader.strands_of_curve(curve, depsgraph())
    assert np.abs(seed.points - points).max() < 4 * FLOAT32 * 3.0
    assert seed.closed.tolist() == [1]
    # Rewriting leaves one object and one spline, and its looks as they were.
    again = curve_writer.write_curve(
        polylines([points[:5]], [0]), thing, "Other", curve_object=curve, bevel_depth=0.3
    )
    assert again == curve and len(curve.data.splines) == 1
    assert curve.data.bevel_depth == pytest.approx(0.1 / 6.0 ** (1.0 / 3.0))


def test_the_bevel_is_as_thick_as_asked_in_world_units():
    thing = cube()
    thing.scale = (2.0, 2.0, 2.0)
    bpy.context.view_layer.update()
    points = np.array(circle_points(3.0, 2.0))
    curve = curve_writer.write_curve(polylines([points], [1]), thing, "Result", bevel_depth=0.25)
    assert curve.data.bevel_depth == pytest.approx(0.125)


def test_the_proposed_spacing_follows_the_size():
    small = core.automatic_spacing(*meshes.triangles_of(sphere(0.01), depsgraph()))
    large = core.automatic_spacing(*meshes.triangles_of(sphere(10.0), depsgraph()))
    assert large == pytest.approx(1000.0 * small, rel=0.1)
