# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry in Blender: one press, watched runs, Live, going on, what is kept, what is refused."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from meander import batch, core
from meander.run import cut as cutting
from meander.run import seeds, session
from scenes import (
    activate,
    circle_points,
    fill,
    grid,
    length_of,
    poly_curve,
    refused,
    sphere,
    world_splines,
)
from sentences import assert_sentence
from watched_runs import FakeWindow, begin, tick_until

pytestmark = pytest.mark.usefixtures("nothing_kept")


def ball() -> bpy.types.Object:
    """Fine enough to be its own mirror image, to a tenth of a small spacing."""
    return sphere(subdivisions=4)


def suzanne() -> bpy.types.Object:
    bpy.ops.mesh.primitive_monkey_add()
    thing = activate(bpy.context.active_object)
    thing.modifiers.new("Round", "SUBSURF").levels = 1
    return thing


def own_points(result: bpy.types.Object) -> list[np.ndarray]:
    """The points of every spline in the space of the surface, which is the result's own."""
    return [
        np.array([point.co[:3] for point in spline.points]) for spline in result.data.splines
    ]


def through_plane(points: np.ndarray, axis: int, closed: bool = True) -> int:
    sides = np.sign(points[np.abs(points[:, axis]) > 1e-5, axis])
    after = np.roll(sides, -1) if closed else sides[1:]
    return int(np.count_nonzero(sides[: len(after)] != after))


def assert_mirrored(points: np.ndarray, axis: int, within: float) -> None:
    """Every point of one side has one of the other near its image."""
    images = points.copy()
    images[:, axis] *= -1.0
    # The line, not its points: what lies between two of them counts as well.
    line = np.vstack([points, 0.5 * (points[:-1] + points[1:])])
    for begin_at in range(0, len(images), 500):
        part = images[begin_at : begin_at + 500]
        apart = np.linalg.norm(part[:, None] - line[None], axis=2).min(axis=1)
        assert apart.max() < within


def test_hide_seam_has_strands_cross_the_plane_and_the_curve_goes_on():
    result = fill(ball(), 0.2, mirror="X", hide_seam=True)
    (points,) = own_points(result)
    crossings = through_plane(points, 0)
    assert crossings > 12 and result.data.splines[0].use_cyclic_u
    assert result.meander.hide_seam  # kept with the result
    activate(result)
    result.meander.spacing = 0.22
    assert bpy.ops.meander.run() == {"FINISHED"}
    (spline,) = result.data.splines
    assert spline.use_cyclic_u


@pytest.mark.parametrize("axis", ["X", "Y", "Z"])
def test_a_ball_is_one_closed_line_through_the_plane_twice(axis):
    result = fill(ball(), 0.3, mirror=axis)
    (spline,) = result.data.splines
    assert spline.use_cyclic_u
    (points,) = own_points(result)
    assert through_plane(points, "XYZ".index(axis)) == 2
    assert_mirrored(points, "XYZ".index(axis), 0.05)
    assert result.meander.mirror == axis  # kept with the result
    assert result.meander.figures.lines == 1 and result.meander.figures.evenness > 0.7


def test_suzanne_is_three_lines_because_she_has_three_parts():
    """Head and eyes; her head is one line, mirrored, wherever she stands and however she turns."""
    thing = suzanne()
    thing.location, thing.rotation_euler, thing.scale = (3, 1, -2), (0.4, 1.1, 0.3), (1, 2, 1)
    bpy.context.view_layer.update()
    result = fill(thing, 0.2, mirror="X")
    lines = own_points(result)
    assert sorted(through_plane(points, 0) for points in lines) == [0, 0, 2]
    assert all(spline.use_cyclic_u for spline in result.data.splines)
    assert "3 parts" in result.meander.figures.lines_why
    assert_mirrored(np.vstack(lines), 0, 0.04)


def test_a_watched_run_shows_both_halves_and_ends_in_the_same_curve(monkeypatch):
    monkeypatch.setattr(session, "Window", FakeWindow)
    surface = ball()
    surface.meander.mirror = "X"
    running = begin(surface, 0.25)
    seen = []

    def note() -> bool:
        if running.latest is not None:
            seen.append(running.latest.polylines)
        return False

    tick_until(running, note)
    result, _figures = running.keep(bpy.context)
    running.end()
    assert seen
    for curve in seen:
        x = curve.positions[:, 0]
        assert np.sort(x) == pytest.approx(np.sort(-x), abs=1e-9)
    watched = np.vstack(own_points(result))
    at_once = np.vstack(own_points(fill(ball(), 0.25, mirror="X")))
    assert np.array_equal(watched, at_once)


def test_one_that_was_stopped_is_mirrored_too(monkeypatch):
    monkeypatch.setattr(session, "Window", FakeWindow)
    surface = ball()
    surface.meander.mirror = "X"
    running = begin(surface, 0.1)
    tick_until(running, lambda: running.latest is not None and running.latest.iterations > 3)
    running.stop_wanted = True
    tick_until(running, lambda: False)
    result, _figures = running.keep(bpy.context)
    running.end()
    assert_mirrored(np.vstack(own_points(result)), 0, 0.04)


def test_live_takes_another_spacing_and_keeps_the_symmetry():
    surface = ball()
    result = fill(surface, 0.25, live=True, mirror="X")
    before = length_of(result)
    activate(surface)
    surface.meander.spacing = 0.22
    assert bpy.ops.meander.live() == {"FINISHED"}
    assert length_of(result) == pytest.approx(before * 0.25 / 0.22, rel=0.08)
    (points,) = own_points(result)
    assert through_plane(points, 0) == 2
    assert_mirrored(points, 0, 0.04)


def test_live_takes_paint_of_the_half_that_counts():
    surface = ball()
    group = surface.vertex_groups.new(name="Dense")
    every = [vertex.index for vertex in surface.data.vertices]
    group.add(every, 0.0, "REPLACE")
    result = fill(
        surface, 0.3, live=True, mirror="X", density_source="GROUP", density_group="Dense"
    )
    before = length_of(result)
    activate(surface)
    group.add([i for i in every if surface.data.vertices[i].co.x > 0.0], 1.0, "REPLACE")
    surface.data.update_tag()
    bpy.context.view_layer.update()
    assert bpy.ops.meander.live() == {"FINISHED"}
    assert length_of(result) > 1.2 * before
    points = np.vstack(own_points(result))
    assert_mirrored(points, 0, 0.05)


def test_a_result_goes_on_as_one_line():
    surface = ball()
    result = fill(surface, 0.35, mirror="X")
    activate(result)
    result.meander.spacing = 0.25
    assert bpy.ops.meander.run() == {"FINISHED"}
    (points,) = own_points(result)
    assert through_plane(points, 0) == 2


def test_open_strands_and_materials_go_to_both_sides():
    surface = grid()
    seed = poly_curve("Trail", [[(0.2, 0.1, 0.0), (0.6, 0.3, 0.0)]], cyclic=False)
    seed.data.materials.append(bpy.data.materials.new("Red"))
    result = fill(surface, 0.2, mirror="X", seed=seed)
    assert [spline.use_cyclic_u for spline in result.data.splines] == [False, False]
    assert [spline.material_index for spline in result.data.splines] == [0, 0]
    assert result.data.materials[0].name == "Red"
    assert result.meander.figures.lines_why == "open strands stay one a side"
    left, right = (points[:, 0] for points, _cyclic in world_splines(result))
    assert (left < 0.0).all() != (right < 0.0).all()


def test_guides_of_one_side_are_known_on_both():
    surface = grid()
    guides = poly_curve("Guides", [circle_points(0.2, 0.0)], cyclic=True)
    guides.location.x = 0.5
    result = fill(surface, 0.15, mirror="X", guides=guides)
    figures = result.meander.figures
    assert figures.guides == 2
    first = figures.first_guide
    x = [points[:, 0].mean() for points in own_points(result)[first : first + 2]]
    assert sorted(x) == pytest.approx([-0.5, 0.5], abs=0.01)
    activate(result)
    result.meander.spacing = 0.12
    assert bpy.ops.meander.run() == {"FINISHED"}  # the guides are told from the rest
    assert result.meander.figures.guides == 2


def test_the_seed_is_shown_on_both_sides():
    surface = ball()
    surface.meander.spacing, surface.meander.mirror = 0.3, "X"
    found = seeds.show(activate(surface), bpy.context)
    assert found.strands == 2


def test_a_mirrored_curve_cuts_its_surface():
    result = fill(ball(), 0.3, mirror="X")
    cut = cutting.cut_result(result, bpy.context.scene, bpy.context.evaluated_depsgraph_get())
    assert cut.parted


def test_what_is_not_alike_is_refused_with_the_place():
    surface = ball()
    surface.location = (5.0, 0.0, 0.0)
    top = max(surface.data.vertices, key=lambda vertex: vertex.co.x + 0.3 * vertex.co.y)
    top.co *= 1.4
    place = ", ".join(f"{value:.4g}" for value in top.co)
    bpy.context.view_layer.update()
    sentence = refused(surface, 0.3, mirror="X")
    assert f"({place})" in sentence and "mirror image in X" in sentence
    assert_sentence(sentence)


def test_live_refuses_another_border_in_one_sentence():
    surface = grid()
    surface.meander.mirror = "X"
    result = fill(surface, 0.3, live=True, border_distance=0.4)
    before = length_of(result)
    activate(surface)
    surface.meander.border_distance = 0.2
    try:
        bpy.ops.meander.live()
    except RuntimeError as error:
        assert "With Symmetry" in str(error)
    assert length_of(result) == before


def test_the_batch_command_mirrors_about_an_object(tmp_path):
    thing = suzanne()
    thing.rotation_euler, thing.location = (0.3, 0.2, 1.0), (1.0, 2.0, 3.0)
    scene = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(scene), check_existing=False, copy=True)
    output = tmp_path / "out.blend"
    given = ("--input", scene, "--output", output, "--spacing", 0.2, "--mirror", "x", "--quiet")
    assert batch.main([str(each) for each in given]) == 0
    bpy.ops.wm.open_mainfile(filepath=str(output))
    (result,) = (each for each in bpy.data.objects if each.type == "CURVE")
    assert result.meander.mirror == "X"
    assert sorted(through_plane(points, 0) for points in own_points(result)) == [0, 0, 2]
    assert core.library_version()
