# SPDX-License-Identifier: GPL-3.0-or-later
"""Results that are light, bridged, cut, duplicated and live, and where their objects are put."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from meander.run import estimate, live, suspended
from meander.run.queue import Queue
from meander.scene.points import bind
from meander.ui import live as live_operator
from scenes import activate, counts, fill, grid, in_edit_mode, point_count, sphere
from watched_runs import begin, tick_until

pytestmark = pytest.mark.usefixtures("nothing_kept")

SPACING = 0.5


def two_balls() -> bpy.types.Object:
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, location=(2.5, 0.0, 0.0))
    other = bpy.context.active_object
    ball = sphere()
    other.select_set(True)
    bpy.ops.object.join()
    return activate(ball)


def test_a_duplicate_that_goes_on_leaves_the_points_of_the_original():
    result = fill(sphere(), SPACING, points_as="MESH")
    points = result.meander.figures.points
    name, before = points.name, len(points.data.vertices)
    activate(result)
    bpy.ops.object.duplicate()
    duplicate = bpy.context.active_object
    assert bpy.ops.meander.run() == {"FINISHED"}
    kept = result.meander.figures.points
    assert kept is not None and kept.name == name and len(kept.data.vertices) == before
    assert duplicate.meander.figures.points not in (None, kept)
    # Points that are one's own are replaced, as ever.
    objects = counts()["objects"]
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert counts()["objects"] == objects


def test_a_run_can_be_resumed_with_fewer_points():
    surface = sphere()
    many = point_count(fill(surface, 0.1))
    activate(surface)
    running = begin(surface, 0.1)
    tick_until(running, lambda: running.latest and running.latest.iterations > 0)
    running.suspend()
    surface.meander.use_light = True
    assert suspended.run_of(surface) is not None, "which points are kept is no other curve"
    assert bpy.ops.meander.resume() == {"FINISHED"}
    assert point_count(surface.meander.last_result) < 0.6 * many


def test_what_live_cannot_take_leaves_its_timer_alive():
    surface = sphere()
    result = fill(surface, SPACING, live=True)
    before = point_count(result)
    activate(surface)
    live.finished.end()  # as after a file has been opened: the curve goes on from its points
    windows = bpy.context.window_manager.windows
    live_operator._look_at(windows)
    surface.meander.density_source = "ATTRIBUTE"
    surface.meander.density_attribute = "Nothing"
    live_operator._look_at(windows)  # Blender drops a timer that raises
    assert point_count(result) == before
    surface.meander.density_source = "NONE"
    surface.meander.spacing = 0.9 * SPACING
    live_operator._look_at(windows)
    assert result.meander.spacing == pytest.approx(0.9 * SPACING)


def test_a_cut_stands_where_it_is_seen_though_the_surface_is_in_no_view_layer():
    surface = sphere()
    result = fill(surface, SPACING)
    away = bpy.data.collections.new("Away")
    bpy.context.scene.collection.children.link(away)
    away.objects.link(surface)
    for collection in surface.users_collection:
        if collection != away:
            collection.objects.unlink(surface)
    bpy.context.view_layer.layer_collection.children["Away"].exclude = True
    activate_alone(result)
    assert bpy.ops.meander.two_tone() == {"FINISHED"}
    made = bpy.context.view_layer.objects.active
    assert made.type == "MESH" and made.visible_get()


def activate_alone(thing: bpy.types.Object) -> None:
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)


def test_what_is_made_in_local_view_is_seen_there():
    surface = sphere()
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        assert bpy.ops.view3d.localview() == {"FINISHED"}
        space = area.spaces.active
        try:
            result = fill(surface, SPACING)
            assert result.visible_get(viewport=space)
            activate(result)
            assert bpy.ops.meander.two_tone() == {"FINISHED"}
            made = bpy.context.view_layer.objects.active
            assert made != result and made.visible_get(viewport=space)
        finally:
            bpy.ops.view3d.localview()


def test_a_bridged_live_light_result_stays_one_line_and_can_be_cut():
    surface = two_balls()
    result = fill(surface, SPACING, bridge_parts=True, live=True)
    assert len(result.data.splines) == 1 and result.meander.figures.bridge_count == 2
    activate(result)
    assert bpy.ops.meander.make_light() == {"FINISHED"}
    assert bpy.ops.meander.two_tone(hide=False) == {"FINISHED"}
    sides = bpy.context.view_layer.objects.active
    indices = {polygon.material_index for polygon in sides.data.polygons}
    assert indices == {0, 1}
    for active, spacing in ((surface, 0.9 * SPACING), (result, SPACING)):
        activate(active)
        active.meander.spacing = spacing
        assert bpy.ops.meander.live() == {"FINISHED"}
        assert len(result.data.splines) == 1 and result.meander.figures.bridge_count == 2
        assert result.meander.spacing == pytest.approx(spacing)


def test_live_stays_on_the_faces_that_were_filled_in_edit_mode():
    surface = grid(cells=12)
    surface.meander.spacing, surface.meander.live = 0.3, True
    in_edit_mode(surface, lambda middle: middle.x > 0.0)
    assert bpy.ops.meander.run() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    result = surface.meander.last_result
    for spacing, kept in ((0.25, True), (0.3, False)):
        if not kept:
            live.finished.end()
        activate(surface)
        surface.meander.spacing = spacing
        assert bpy.ops.meander.live() == {"FINISHED"}
        points = [point.co.x for spline in result.data.splines for point in spline.points]
        assert np.min(points) > -1e-3 * 0.3
        assert result.meander.spacing == pytest.approx(spacing)


def test_others_take_the_choices_of_the_active_one_also_after_the_question():
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, radius=10.0)
    large = bpy.context.active_object
    ball = sphere()
    ball.meander.spacing = 0.1
    large.select_set(True)
    queue = Queue(bpy.context, restart=False, beside=False)
    first = queue.next_plan(bpy.context)
    asked = queue.estimate_of_rest(bpy.context, first)
    second = queue.next_plan(bpy.context)
    assert second.surface.find() == large and second.spacing == pytest.approx(0.1)
    both = estimate.of_plan(first).points + estimate.of_plan(second).points
    assert asked.points == pytest.approx(both, rel=0.05)


def test_points_beside_faces_without_area_are_held_by_others():
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.0, 0.0]])
    faces = np.array([[0, 3, 1], [0, 1, 2], [3, 3, 0]])  # a line, a triangle, and a line
    points = np.array([[0.3, 0.0, 0.0], [0.5, 0.0, 0.0], [0.9, 0.0, 0.0]])
    index, weights = bind(points, corners, faces)
    assert index.tolist() == [1, 1, 1]
    found = np.einsum("nk,nkj->nj", weights, corners[faces[index]])
    assert np.abs(found - points).max() < 1e-6
