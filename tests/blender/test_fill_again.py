# SPDX-License-Identifier: GPL-3.0-or-later
"""Filling a mesh again: its last result is updated, or another one made beside it."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from meander.scene.results import last_result
from meander.ui import variations
from meander.ui.look import MEANDER_PT_look
from meander.ui.panels import MEANDER_PT_figures, MEANDER_PT_main
from panel_layout import texts_of
from scenes import (
    activate,
    circle_points,
    counts,
    fill,
    length_of,
    points_of,
    poly_curve,
    reopened,
    sphere,
    world_splines,
)
from watched_runs import begin, tick_until

QUICK = {"spacing": 0.5, "iteration_limit": 20, "use_bevel": True}


def run_again(surface: bpy.types.Object, spacing: float, **options) -> bpy.types.Object | None:
    """Fills a mesh again with another spacing; the curve that the next run would update."""
    activate(surface)
    surface.meander.spacing = spacing
    assert bpy.ops.meander.run(**options) == {"FINISHED"}
    return last_result(surface, bpy.context.scene)


def test_filling_again_updates_the_last_result_and_nothing_but_its_curve():
    surface = sphere()
    result = fill(surface, **QUICK)
    result.name, result.data.name = "My Line", "My Data"
    data, material = result.data, bpy.data.materials.new("Mine")
    data.materials.clear()
    data.materials.append(material)
    other = bpy.data.collections.new("Elsewhere")
    bpy.context.scene.collection.children.link(other)
    other.objects.link(result)
    result.modifiers.new("Mine", "SMOOTH")
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(parent)
    result.parent = parent
    data.bevel_depth, data.bevel_resolution = 0.123, 7
    data.keyframe_insert("bevel_depth", frame=1)
    before, short = counts(), length_of(result)
    surface.meander.iteration_limit = 40  # a closer curve takes longer to grow
    assert run_again(surface, 0.25) == result
    assert counts() == before
    assert bpy.context.view_layer.objects.active == surface and surface.select_get()
    assert length_of(result) > 1.5 * short
    assert (result.name, result.data, data.name) == ("My Line", data, "My Data")
    assert result.meander.spacing == pytest.approx(0.25)
    assert data.materials[:] == [material] and other in result.users_collection
    assert "Mine" in result.modifiers and result.parent == parent
    assert data.animation_data.action is not None
    assert (data.bevel_depth, data.bevel_resolution) == (pytest.approx(0.123), 7)


def test_a_new_curve_leaves_the_one_before_it():
    surface = sphere()
    first = fill(surface, **QUICK)
    former = world_splines(first)[0][0]
    second = run_again(surface, 0.4, beside=True)
    assert second not in (None, first) and bpy.context.active_object == second
    assert np.array_equal(world_splines(first)[0][0], former)
    assert run_again(surface, 0.3) == second
    assert np.array_equal(world_splines(first)[0][0], former)


def test_a_new_curve_can_be_made_with_a_curve_active():
    surface = sphere()
    first = fill(surface, **QUICK)
    assert bpy.context.active_object == first and "New Curve" in texts_of(MEANDER_PT_main)
    former = world_splines(first)[0][0]
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    second = bpy.context.active_object
    assert second != first and second.meander.surface == surface
    assert last_result(surface, bpy.context.scene) == second
    assert np.array_equal(world_splines(first)[0][0], former)
    # An earlier curve gives its own settings, which its panel shows, and keeps them and its line.
    second.meander.spacing, second.meander.density_source = 0.3, "CURVATURE"
    activate(first)
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    third = bpy.context.active_object
    assert third not in (first, second)
    assert third.meander.spacing == pytest.approx(QUICK["spacing"])
    assert third.meander.density_source == "GROUP" == surface.meander.density_source
    assert surface.meander.spacing == third.meander.spacing
    assert length_of(third) == pytest.approx(length_of(first), rel=0.1), "it begins from its seed"
    assert second.meander.spacing == pytest.approx(0.3)
    assert np.array_equal(world_splines(first)[0][0], former)


def test_a_new_curve_begins_from_the_seed_that_the_active_curve_began_from():
    surface = sphere()
    surface.meander.seed = poly_curve("Ring", [circle_points(0.8, 0.6)], True)
    first = fill(surface, **QUICK)
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    second = bpy.context.active_object
    assert second != first and second.name.startswith("Ring Meander")
    assert second.meander.seed == first.meander.seed
    assert not np.array_equal(world_splines(second)[0][0], world_splines(first)[0][0])
    second.meander.variation = 0
    activate(second)
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
    assert np.array_equal(world_splines(second)[0][0], world_splines(first)[0][0])


def delete(thing: bpy.types.Object) -> None:
    activate(thing)
    bpy.ops.object.delete()


def test_where_the_newest_curve_is_deleted_the_one_before_it_is_updated():
    surface = sphere()
    surface.name = "Ball"
    curves = [fill(surface, **QUICK)]
    for spacing in (0.4, 0.3):
        curves.append(run_again(surface, spacing, beside=True))
    # The last that was run counts, whatever its name.
    activate(curves[0])
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
    curves = [curves[1], curves[2], curves[0]]
    curves[0].name, curves[1].name = "Z", "A"
    for left in (2, 1):
        delete(curves[left])
        activate(surface)
        before = curves[left - 1]
        assert last_result(surface, bpy.context.scene) == before
        assert texts_of(MEANDER_PT_figures) and "New Curve" in texts_of(MEANDER_PT_main)
        # Either's settings are the other's, from the next choice on.
        surface.meander.spacing = 0.35
        assert before.meander.spacing == pytest.approx(0.35)
        before.meander.spacing = 0.45
        assert surface.meander.spacing == pytest.approx(0.45)
    assert run_again(surface, 0.5) == curves[0] and surface.meander.last_result == curves[0]
    delete(curves[0])
    activate(surface)
    assert last_result(surface, bpy.context.scene) is None and not texts_of(MEANDER_PT_figures)


def test_the_look_names_the_curve_that_is_left():
    surface = sphere()
    first = fill(surface, **QUICK)
    second = run_again(surface, 0.4, beside=True)
    first.name, second.name = "First", "Second"
    activate(surface)
    assert "First" not in texts_of(MEANDER_PT_look)
    delete(second)
    activate(surface)
    assert "First" in texts_of(MEANDER_PT_look)


def test_the_last_result_is_found_after_undo_and_in_a_file(tmp_path):
    surface = sphere()
    result = fill(surface, **QUICK)
    surface.name, result.name = "Surface", "Line"
    former = length_of(result)
    bpy.ops.ed.undo_push(message="Filled")
    run_again(surface, 0.25)
    bpy.ops.ed.undo_push(message="Filled Again")
    bpy.ops.ed.undo()
    surface, result = bpy.data.objects["Surface"], bpy.data.objects["Line"]
    assert length_of(result) == pytest.approx(former, rel=1e-6)
    assert run_again(surface, 0.3) == result
    reopened(tmp_path / "saved.blend")
    surface = bpy.data.objects["Surface"]
    before = counts()
    assert run_again(surface, 0.25) == bpy.data.objects["Line"]
    assert counts() == before


def test_a_deleted_result_is_not_updated():
    surface = sphere()
    result = fill(surface, **QUICK)
    name, before = result.name, counts()
    activate(result)
    bpy.ops.object.delete()
    again = run_again(surface, 0.5)
    assert again is not None and again.users_scene
    assert again.name == name and counts() == before, "the deleted one is not in its way"


def test_a_duplicated_mesh_gets_a_result_of_its_own():
    surface = sphere()
    result = fill(surface, **QUICK)
    former = world_splines(result)[0][0]
    activate(surface)
    bpy.ops.object.duplicate()
    copy = bpy.context.active_object
    assert last_result(copy, bpy.context.scene) is None
    own = run_again(copy, 0.4)
    assert own != result and own.meander.surface == copy
    assert last_result(surface, bpy.context.scene) == result
    assert np.array_equal(world_splines(result)[0][0], former)


def test_a_mesh_that_is_duplicated_with_its_result_updates_the_copy():
    surface = sphere()
    result = fill(surface, **QUICK)
    former = world_splines(result)[0][0]
    surface.select_set(True)
    result.select_set(True)
    bpy.context.view_layer.objects.active = surface
    bpy.ops.object.duplicate()
    copy = bpy.context.active_object
    copied = last_result(copy, bpy.context.scene)
    assert copied not in (None, result) and copied.meander.surface == copy
    assert run_again(copy, 0.3) == copied
    assert np.array_equal(world_splines(result)[0][0], former)


def test_a_result_that_goes_away_during_the_run_is_made_anew(windowed):
    surface = sphere()
    result = fill(surface, **QUICK)
    running = begin(surface, 0.1)
    tick_until(running, lambda: running.shown_points > 0)
    activate(result)
    bpy.ops.object.delete()
    running.stop_wanted = True
    tick_until(running, lambda: False)
    made, _figures = running.keep(bpy.context)
    running.end()
    assert made.users_scene and last_result(surface, bpy.context.scene) == made


def test_a_linked_surface_is_filled_again_into_its_curve(tmp_path):
    """It cannot note its result, so the scene is looked through; New Curve makes another one."""
    surface = sphere()
    surface.name = "Lib"
    surface.meander.spacing, surface.meander.iteration_limit = 0.5, 20
    path = tmp_path / "library.blend"
    bpy.data.libraries.write(str(path), {surface})
    bpy.data.objects.remove(surface)
    with bpy.data.libraries.load(str(path), link=True) as (_there, here):
        here.objects = ["Lib"]
    linked = bpy.data.objects["Lib"]
    bpy.context.scene.collection.objects.link(linked)

    def curves() -> list[str]:
        return [thing.name for thing in bpy.context.scene.objects if thing.type == "CURVE"]

    for _ in range(2):
        bpy.context.view_layer.objects.active = linked
        assert bpy.ops.meander.run() == {"FINISHED"}
        assert curves() == ["Lib Meander"]
    bpy.context.view_layer.objects.active = linked
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    assert len(curves()) == 2
    bpy.context.view_layer.objects.active = linked
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert len(curves()) == 2


@pytest.mark.parametrize("restart", [True, False])
def test_a_curve_that_is_changed_by_itself_changes_what_its_mesh_says(restart):
    surface = sphere()
    result = fill(surface, **QUICK)
    activate(result)
    result.meander.spacing, result.meander.iteration_limit = 0.4, 30
    result.meander.density_source = "CURVATURE"
    assert bpy.ops.meander.run(restart=restart) == {"FINISHED"}
    assert texts_of(MEANDER_PT_figures)
    shown = texts_of(MEANDER_PT_figures)
    activate(surface)
    assert surface.meander.spacing == pytest.approx(0.4)
    assert surface.meander.density_source == "CURVATURE"
    assert texts_of(MEANDER_PT_figures) == shown
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert result.meander.spacing == pytest.approx(0.4), "filling again does not go back"


def test_what_is_chosen_on_a_curve_or_its_mesh_is_chosen_on_both():
    surface = sphere()
    first = fill(surface, **QUICK)
    activate(surface)
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    second = last_result(surface, bpy.context.scene)
    assert second != first
    spacing = first.meander.spacing
    second.meander.spacing, second.meander.preset = 0.4, "FINEST"
    assert surface.meander.spacing == pytest.approx(0.4) and surface.meander.preset == "FINEST"
    surface.meander.density_source, surface.meander.border_distance = "CURVATURE", 1.5
    assert second.meander.density_source == "CURVATURE"
    assert second.meander.border_distance == pytest.approx(1.5)
    assert first.meander.spacing == spacing, "an earlier curve keeps its own"
    assert first.meander.density_source == "GROUP"
    first.meander.spacing = 0.5
    assert surface.meander.spacing == pytest.approx(0.4)
    surface.meander.last_result = first  # is updated next
    surface.meander.spacing = 0.3
    assert first.meander.spacing == pytest.approx(0.3)
    assert second.meander.spacing == pytest.approx(0.4)


def test_a_drawn_ramp_is_one_of_a_curve_and_its_mesh():
    surface = sphere()
    result = fill(surface, **QUICK)
    result.meander.density_source, result.meander.density_interpolation = "CURVATURE", "FREE"
    assert surface.meander.density_ramp == result.meander.density_ramp is not None
    activate(surface)
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    other = last_result(surface, bpy.context.scene)
    assert other.meander.density_ramp not in (None, result.meander.density_ramp)
    assert surface.meander.density_ramp == other.meander.density_ramp
    activate(surface)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert surface.meander.density_ramp == other.meander.density_ramp


def test_a_curve_that_is_deleted_takes_its_figures_with_it():
    surface = sphere()
    result = fill(surface, **QUICK)
    activate(surface)
    assert texts_of(MEANDER_PT_figures)
    bpy.data.objects.remove(result)
    assert not texts_of(MEANDER_PT_figures)


# -- another curve ---------------------------------------------------------------------------------


def between(one: bpy.types.Object, other: bpy.types.Object) -> float:
    """The mean distance of the points of a curve from those of another."""
    mine, its = points_of(one), points_of(other)
    return float(np.mean([np.linalg.norm(its - point, axis=1).min() for point in mine[::4]]))


@pytest.mark.parametrize("start", ["PRESET", "FULL"])
def test_a_new_curve_is_another_one(start):
    surface = sphere(subdivisions=4)
    first = fill(surface, 0.2, start=start)
    activate(surface)
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    second = surface.meander.last_result
    activate(surface)
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    third = surface.meander.last_result
    for one, other in ((first, second), (second, third), (first, third)):
        assert between(one, other) > 0.1 * 0.2
    # Fill Again keeps it, and the same settings make the same curve.
    for result in (second, third):
        activate(result)
        before = points_of(result)
        assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
        assert np.array_equal(points_of(result), before)
    for number, each in enumerate((first, second, third)):
        assert each.meander.figures.variation == each.meander.variation == number
    assert surface.meander.variation == 2


def test_fill_again_makes_the_variation_that_is_chosen():
    surface = sphere()
    first = fill(surface, 0.3)
    before = points_of(first)
    activate(surface)
    surface.meander.variation = 5
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert surface.meander.last_result == first and first.meander.figures.variation == 5
    assert not np.array_equal(points_of(first), before)
    activate(first)
    surface.meander.variation = 0
    assert bpy.ops.meander.run() == {"FINISHED"}, "it goes on"
    assert first.meander.figures.variation == 5, "with the line of that variation"
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
    assert np.array_equal(points_of(first), before)


@pytest.mark.parametrize("start", ["PRESET", "FULL"])
@pytest.mark.parametrize("mirror", ["NONE", "X"])
def test_six_variations_are_shown_to_choose_from(start, mirror):
    surface = sphere()
    surface.meander.spacing, surface.meander.start, surface.meander.mirror = 0.3, start, mirror
    activate(surface)
    assert bpy.ops.meander.show_variations() == {"FINISHED"}
    assert surface.meander.last_result is None and surface.meander.variation == 0
    shown = variations.shown
    first_six = [picture_of(str(number)) for number in range(6)]
    line, ground = (0.96, 0.60, 0.22), first_six[0][0, 0]
    assert ground[3] == 0.0, "the corner of a ball's picture is empty"
    for number, picture in enumerate(first_six):
        seen = picture[picture[:, :, 3] == 1.0]
        drawn = np.abs(seen[:, :3] - line).max(axis=1) < 0.02
        assert 0.02 < drawn.mean() < 0.6
        for other in first_six[:number]:
            assert np.abs(picture - other).max() > 0.3
    assert bpy.ops.meander.show_variations(following=True) == {"FINISHED"}
    assert shown.first == 6 and set(shown.pictures) == {str(number) for number in range(6, 12)}
    assert bpy.ops.meander.use_variation(number=7) == {"FINISHED"}
    result = surface.meander.last_result
    assert result.meander.figures.variation == 7 == surface.meander.variation
    assert bpy.ops.meander.show_variations() == {"FINISHED"}
    assert shown.first == 6, "those among which the chosen one is"


def picture_of(name: str) -> np.ndarray:
    picture = variations.shown.pictures[name]
    found = np.empty(len(picture.image_pixels_float), dtype=np.float32)
    picture.image_pixels_float.foreach_get(found)
    return found.reshape(*picture.image_size, 4)


def test_a_new_curve_has_its_points_on_the_faces_that_the_mesh_numbers():
    surface = sphere()
    fill(surface, 0.3)
    activate(surface)
    surface.meander.points_as = "MESH"
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    points = surface.meander.last_result.meander.figures.points.data
    count = len(points.vertices)
    triangles, weights = np.empty(count, dtype=np.int32), np.empty(3 * count, dtype=np.float32)
    places = np.empty(3 * count, dtype=np.float32)
    points.attributes["triangle"].data.foreach_get("value", triangles)
    points.attributes["weights"].data.foreach_get("vector", weights)
    points.vertices.foreach_get("co", places)
    surface.data.calc_loop_triangles()
    corners = np.array([each.vertices[:] for each in surface.data.loop_triangles])[triangles]
    vertices = np.array([vertex.co[:] for vertex in surface.data.vertices])
    there = np.einsum("nk,nkj->nj", weights.reshape(-1, 3), vertices[corners])
    assert np.abs(there - places.reshape(-1, 3)).max() < 1e-5
