# SPDX-License-Identifier: GPL-3.0-or-later
"""What artists try first: texts and curves, several meshes, Edit Mode, paint that nobody named."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from meander.run import estimate, live
from meander.run.plan import plan_of
from scenes import (
    activate,
    circle_points,
    cube,
    farthest_from,
    fill,
    grid,
    in_edit_mode,
    mesh_object,
    packing,
    points_of,
    poly_curve,
    sphere,
)

# ------------------------------------------------------------------------------------------------
# What is not a mesh


def text() -> bpy.types.Object:
    data = bpy.data.curves.new("Words", "FONT")
    data.body = "OK"
    data.extrude = 0.2
    thing = bpy.data.objects.new("Words", data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def pipe() -> bpy.types.Object:
    thing = poly_curve("Pipe", [circle_points(1.0, 0.0, 12)], True)
    thing.data.bevel_depth = 0.3
    thing.data.use_path = True  # which would carry children along
    return thing


def ball() -> bpy.types.Object:
    bpy.ops.object.metaball_add(type="BALL")
    data = bpy.context.active_object.data
    data.render_resolution = data.resolution
    return bpy.context.active_object


def patch() -> bpy.types.Object:
    bpy.ops.surface.primitive_nurbs_surface_torus_add()
    return bpy.context.active_object


@pytest.mark.parametrize(
    ("build", "spacing"), [(text, 0.12), (pipe, 0.2), (ball, 0.3), (patch, 0.25)]
)
def test_what_blender_makes_a_mesh_of_is_filled(build, spacing):
    thing = build()
    thing.location = (3.0, 1.0, 0.5)
    curve = fill(thing, spacing, iteration_limit=80)
    assert curve.meander.surface == thing
    assert farthest_from(thing, curve) < 1e-3
    assert 0.7 < packing(thing, curve) < 1.2
    estimate.measure(thing)
    assert estimate.shown([thing]) is not None
    # Filled again it is updated, and from the curve it goes on.
    assert fill(activate(thing), spacing, iteration_limit=80) in (thing, curve)
    activate(curve)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert farthest_from(thing, curve) < 1e-3
    assert not bpy.ops.meander.select_problem.poll()


def test_a_bare_curve_is_no_surface():
    activate(poly_curve("Bare", [circle_points(1.0, 0.0)], True))
    assert not bpy.ops.meander.run.poll()
    with pytest.raises(RuntimeError, match="give it a bevel"):
        bpy.ops.meander.run()


def test_geometry_nodes_that_make_curves_only_say_what_to_do():
    thing = cube()
    modifier = thing.modifiers.new("Nodes", "NODES")
    tree = bpy.data.node_groups.new("Nodes", "GeometryNodeTree")
    if bpy.app.version < (4, 0, 0):
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    else:
        tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    made = tree.nodes.new("GeometryNodeCurvePrimitiveCircle")
    end = tree.nodes.new("NodeGroupOutput")
    tree.links.new(made.outputs[0], end.inputs[0])
    modifier.node_group = tree
    activate(thing)
    with pytest.raises(RuntimeError, match="shows curves only.*Curve to Mesh"):
        bpy.ops.meander.run()


# ------------------------------------------------------------------------------------------------
# Several at once


def test_all_selected_meshes_are_filled_one_after_another():
    first, second, third = cube(), grid(8), grid(4)
    third.location.x, second.location.x = 5.0, 10.0
    third.meander.spacing = 0.5
    broken = mesh_object("Nothing", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [])
    lamp = bpy.data.objects.new("Empty", None)
    bpy.context.scene.collection.objects.link(lamp)
    activate(first)
    first.meander.spacing, first.meander.bevel_share = 0.3, 0.35
    for thing in (second, third, broken, lamp):
        thing.select_set(True)
    with pytest.raises(RuntimeError, match="'Nothing' has no faces"):
        bpy.ops.meander.run()  # what cannot be filled is reported, and the others are filled
    shown = bpy.context.scene.objects
    results = {thing.meander.surface: thing for thing in shown if thing.type == "CURVE"}
    assert set(results) == {first, second, third}
    # Who has been set up keeps it; who has not takes what the active one has.
    assert [results[thing].meander.spacing for thing in (first, second, third)] == pytest.approx(
        [0.3, 0.3, 0.5]
    )
    assert results[second].meander.bevel_share == pytest.approx(0.35)
    assert results[third].meander.bevel_share == pytest.approx(0.2)
    for surface, curve in results.items():
        assert farthest_from(surface, curve) < 1e-3


def test_an_automatic_spacing_is_each_ones_own():
    large, words = sphere(2.0), text()
    activate(large)
    words.select_set(True)
    large.meander.bevel_share, large.meander.iteration_limit = 0.35, 100
    assert bpy.ops.meander.run() == {"FINISHED"}
    of_ball, of_words = large.meander.last_result, words.meander.last_result
    assert of_words.meander.bevel_share == pytest.approx(0.35)
    # As if it had been filled alone, and not with a spacing that its letters have no room for.
    alone = text()
    activate(alone)
    alone.meander.iteration_limit = 1
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert of_words.meander.spacing == alone.meander.last_result.meander.spacing
    assert of_words.meander.spacing < 0.5 * of_ball.meander.spacing
    assert of_words.meander.figures.evenness > 0.7


# ------------------------------------------------------------------------------------------------
# Edit Mode


@pytest.mark.parametrize("levels", [0, 1])
def test_the_selected_faces_are_filled_in_edit_mode(levels):
    surface = grid(10)
    if levels:
        surface.modifiers.new("Subdivision", "SUBSURF").levels = levels
    in_edit_mode(surface, lambda centre: centre.x > 0.0)
    surface.meander.spacing = 0.2
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert bpy.context.mode == "EDIT_MESH" and bpy.context.active_object == surface
    curve = surface.meander.last_result
    x = points_of(curve)[:, 0]
    assert 0.0 < x.min() < 0.15 and x.max() > 0.8
    # It goes on there, whatever is selected now.
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    activate(curve)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert points_of(curve)[:, 0].min() > 0.0
    # Another part for the same curve takes no second attribute; no part is the whole.
    in_edit_mode(surface, lambda centre: centre.x < 0.0)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert points_of(curve)[:, 0].max() < 0.0
    bpy.ops.mesh.select_all(action="DESELECT")
    assert bpy.ops.meander.run() == {"FINISHED"}
    x = points_of(curve)[:, 0]
    assert x.min() < -0.8 and x.max() > 0.8
    bpy.ops.object.mode_set(mode="OBJECT")
    names = [item.name for item in surface.data.attributes if item.name.startswith("Meander")]
    assert names == ["Meander Region"]


# ------------------------------------------------------------------------------------------------
# Paint


def painted(name: str) -> bpy.types.Object:
    surface = grid(10)
    group = surface.vertex_groups.new(name=name)
    for vertex in surface.data.vertices:
        group.add([vertex.index], float(vertex.co.x > 0.0), "REPLACE")
    return surface


def test_the_active_vertex_group_is_taken_and_kept():
    surface = painted("Dense")
    curve = fill(surface, 0.2)
    assert curve.meander.density_group == surface.meander.density_group == "Dense"
    x = points_of(curve)[:, 0]
    assert (x > 0.0).mean() > 0.6


def test_another_spacing_for_a_curve_that_grows_keeps_the_paint():
    surface = painted("Dense")
    surface.meander.spacing = 0.2
    depsgraph = bpy.context.evaluated_depsgraph_get()
    plan = plan_of(surface, bpy.context.scene, depsgraph)
    assert live.wish_of(surface, plan, plan.problem.density, depsgraph) is None
    surface.meander.spacing = 0.25
    wish = live.wish_of(surface, plan, plan.problem.density, depsgraph)
    assert np.array_equal(wish.density, plan.problem.density)
    assert wish.applied(plan).density_group == "Dense"


def test_groups_of_bones_are_left_out_and_said_to_be():
    surface = painted("Bone")
    bones = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(bones)
    activate(bones)
    bpy.ops.object.mode_set(mode="EDIT")
    bones.data.edit_bones.new("Bone").tail = (0, 0, 1)
    bpy.ops.object.mode_set(mode="OBJECT")
    surface.modifiers.new("Armature", "ARMATURE").object = bones
    curve = fill(surface, 0.2)
    assert curve.meander.density_group == ""
    assert "no vertex group is chosen" in surface.meander.last_result.meander.figures.preparation
    assert 0.4 < (points_of(curve)[:, 0] > 0.0).mean() < 0.6
