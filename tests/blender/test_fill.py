# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator, as scripts and background Blender run it: execute(), from settings to the curve."""

from __future__ import annotations

import os
import threading
import time

import bpy
import numpy as np
import pytest
from meander import core
from meander.run import session, stepper
from meander.run.preview import Preview
from meander.scene import errors, look
from meander.scene.options import options_of
from scenes import (
    activate,
    circle_points,
    counts,
    cube,
    farthest_from,
    fill,
    grid,
    length_of,
    matrix_of,
    packing,
    poly_curve,
    reopened,
    sphere,
    world_splines,
)
from watched_runs import FakeWindow, begin, tick_until

# Small surfaces have few strands; 1 is parallel strands at the spacing.
PACKING = pytest.approx(1.0, abs=0.15)


def near(thing: bpy.types.Object) -> float:
    """How far float32 coordinates may lie from a surface."""
    return 1e-6 * max(1.0, float(np.abs(matrix_of(thing)).max()) * 2.0)


# -- surfaces and seeds ----------------------------------------------------------------------------


@pytest.mark.parametrize("build", [sphere, cube, grid])
def test_a_surface_is_filled_without_a_seed(build):
    surface = build()
    before = counts()
    result = fill(surface, 0.3, use_bevel=True)
    assert result.type == "CURVE"
    assert result.parent == surface
    assert surface.users_collection == result.users_collection
    assert counts() == before | {
        "objects": before["objects"] + 2,  # it, and the line that its look draws
        "curves": before["curves"] + 2,
        "node_groups": before["node_groups"] + 1,  # of its look
    }
    assert [cyclic for _points, cyclic in world_splines(result)] == [True]
    assert farthest_from(surface, result) < near(surface)
    assert packing(surface, result) == PACKING


def test_both_sides_of_a_thin_plate_are_filled_along_the_surface():
    surface = cube()
    surface.scale = (1.0, 1.0, 0.01)
    bpy.context.view_layer.update()
    result = fill(surface, 0.2)
    assert result.meander.medial_axis == "PRESET"
    assert packing(surface, result) == PACKING
    result = fill(surface, 0.2, medial_axis="EUCLIDEAN")
    assert result.meander.medial_axis == "EUCLIDEAN"
    assert packing(surface, result) < 0.8


def test_files_from_before_the_preset_chose_distances_keep_theirs():
    """Blender keeps the number of a choice, not its name."""
    settings = sphere().meander
    for number, name in enumerate(("EUCLIDEAN", "GEODESIC")):
        settings["medial_axis"] = number
        assert settings.medial_axis == name
    assert options_of(settings, 0.2).medial_axis == core.MedialAxis.GEODESIC
    settings["medial_axis"] = 0
    assert options_of(settings, 0.2).medial_axis == core.MedialAxis.EUCLIDEAN


def test_seed_strands_keep_their_number_order_and_kind():
    surface = sphere()
    seed = poly_curve("Seed", [circle_points(0.45, 0.89), circle_points(0.45, -0.89)], True)
    arc = seed.data.splines.new("POLY")
    arc.points.add(8)
    for i, point in enumerate(arc.points):
        angle = 0.15 * i
        point.co = (np.cos(angle), np.sin(angle), 0.0, 1.0)
    result = fill(surface, 0.25, seed=seed)
    splines = world_splines(result)
    assert [cyclic for _points, cyclic in splines] == [True, True, False]
    assert splines[0][0][:, 2].mean() > 0.2 and splines[1][0][:, 2].mean() < -0.2
    assert farthest_from(surface, result) < near(surface)
    assert packing(surface, result) == PACKING


@pytest.mark.parametrize("fixed", [True, False])
def test_fixed_ends_stay_where_they_are(fixed):
    surface = grid()
    ends = np.array([(-0.5, 0.0, 0.0), (0.5, 0.0, 0.0)])
    seed = poly_curve("Seed", [[(-0.5 + 0.1 * i, 0.0, 0.0) for i in range(11)]], False)
    result = fill(surface, 0.2, seed=seed, fixed_ends=fixed)
    ((points, cyclic),) = world_splines(result)
    assert not cyclic
    moved = np.abs(points[[0, -1]] - ends).max()
    assert moved < near(surface) if fixed else moved > 0.01


# -- settings --------------------------------------------------------------------------------------


def test_spacing_is_proposed_the_first_time():
    surface = sphere()
    result = fill(surface, 0.0, iteration_limit=3)
    assert surface.meander.spacing == result.meander.spacing > 0.0
    surface.meander.spacing = 0.0
    activate(surface)
    assert bpy.ops.meander.propose_spacing() == {"FINISHED"}
    assert surface.meander.spacing == result.meander.spacing


def test_the_result_knows_its_surface_settings_and_figures():
    surface = sphere()
    seed = poly_curve("Seed", [circle_points(0.45, 0.89)], True)
    chosen = {"preset": "PAPER", "threads": 1, "use_bevel": True, "bevel_share": 0.1}
    result = fill(surface, 0.3, seed=seed, **chosen)
    settings = result.meander
    assert (settings.surface, settings.seed) == (surface, seed)
    assert (settings.preset, settings.threads) == ("PAPER", 1)
    assert look.radius_of(result) == pytest.approx(0.03)
    figures = settings.figures
    assert figures.stop_reason == "converged"
    assert figures.nodes > 100 and figures.iterations > 5 and figures.seconds > 0.0
    assert figures.length == pytest.approx(length_of(result), rel=1e-4)
    assert figures.spacing_median == pytest.approx(0.3, rel=0.2)
    assert not surface.meander.figures.stop_reason, "figures are those of a curve"


def test_the_thickness_can_be_left_out():
    result = fill(cube(), 0.5, use_bevel=False)
    assert result.data.bevel_depth == 0.0 and not result.modifiers


def test_the_iteration_limit_holds():
    result = fill(sphere(), 0.1, iteration_limit=5)
    assert result.meander.figures.iterations == 5
    assert result.meander.figures.stop_reason == "iteration_limit"


def test_a_result_goes_on_from_itself():
    surface = sphere()
    result = fill(surface, 0.2, iteration_limit=15)
    short = length_of(result)
    result.meander.iteration_limit = 15
    before = counts()
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert counts() == before
    assert bpy.context.view_layer.objects.active == result
    assert result.meander.surface == surface
    assert length_of(result) > 1.2 * short
    assert farthest_from(surface, result) < near(surface)


def test_a_result_can_start_over():
    surface = sphere()
    result = fill(surface, 0.2, iteration_limit=15)
    short = length_of(result)
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
    assert length_of(result) == pytest.approx(short, rel=1e-6)


def test_settings_and_results_survive_the_file(tmp_path):
    surface = sphere()
    seed = poly_curve("Seed", [circle_points(0.45, 0.89)], True)
    result = fill(surface, 0.4, seed=seed, factor_1=0.25)
    name, points = result.name, world_splines(result)[0][0]
    reopened(tmp_path / "saved.blend")
    result = bpy.data.objects[name]
    assert result.meander.surface.name == "Icosphere"
    assert result.meander.seed.name == "Seed"
    assert result.meander.spacing == pytest.approx(0.4)
    assert result.meander.factor_1 == pytest.approx(0.25)
    assert result.meander.figures.nodes > 0
    assert np.array_equal(world_splines(result)[0][0], points)
    activate(result)
    assert bpy.ops.meander.run() == {"FINISHED"}


def test_weight_paint_stays_where_it_is():
    surface = sphere()
    bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
    surface.meander.spacing = 0.5
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert bpy.context.view_layer.objects.active == surface
    assert surface.mode == "WEIGHT_PAINT"
    bpy.ops.object.mode_set(mode="SCULPT")
    assert not bpy.ops.meander.run.poll()
    bpy.ops.object.mode_set(mode="OBJECT")


def test_undo_takes_the_curve_away():
    fill(cube(), 0.5)  # so that there is something to go back to
    bpy.ops.ed.undo_push(message="Before")
    before = counts()
    activate(bpy.data.objects["Cube"])
    assert bpy.ops.meander.run(beside=True) == {"FINISHED"}
    bpy.ops.ed.undo_push(message="Fill with Curve")  # in background nobody else does
    assert counts() != before
    bpy.ops.ed.undo()
    assert counts() == before


# -- a run in pieces, as a window makes it ---------------------------------------------------------


def test_watching_changes_nothing(windowed):
    surface = sphere()
    alone = fill(surface, 0.15, iteration_limit=0)
    expected = world_splines(alone)
    running = begin(surface, 0.15)
    sizes = set()
    tick_until(running, lambda: running.latest and sizes.add(running.latest.nodes))
    result, figures = running.keep(bpy.context)
    running.end()
    assert len(sizes) > 1, "the run was over before it could be watched"
    assert figures["stop_reason"] == result.meander.figures.stop_reason == "converged"
    found = world_splines(result)
    assert len(found) == len(expected)
    for (points, cyclic), (expected_points, expected_cyclic) in zip(found, expected, strict=True):
        assert cyclic == expected_cyclic
        assert np.array_equal(points, expected_points)


def test_a_run_has_no_thread_of_pythons(windowed):
    # Blender 3.4 crashes now and then when operators run beside a Python thread that computes.
    before = threading.enumerate()
    running = begin(sphere(), 0.05)
    tick_until(running, lambda: running.latest and running.latest.iterations > 0)
    assert not running.stepper.finished
    assert threading.enumerate() == before
    running.end()


def test_the_first_preview_is_there_at_once(windowed):
    running = begin(sphere(), 0.05)
    assert running.tick(bpy.context)
    assert running.latest.iterations == 0 and running.latest.nodes >= 3
    running.end()


def test_a_picture_shows_the_curve_as_it_is_now(windowed, monkeypatch):
    """Copies are made when the last one has been taken, so one that has waited is an old one."""
    due, shown = [True], []
    monkeypatch.setattr(FakeWindow, "picture_due", lambda _self, _growth: due[0])
    monkeypatch.setattr(Preview, "show", lambda *_: shown.append(running.latest))
    monkeypatch.setattr(session, "STALE", 0.3)
    monkeypatch.setattr(stepper, "GROWTH_STEP", 0.0)  # how it grew is shown however old it is
    running = begin(sphere(), 0.03)
    tick_until(running, lambda: len(shown) == 2)
    due[0] = False
    looked_away = time.monotonic()
    tick_until(running, lambda: time.monotonic() > looked_away + 0.6)
    assert len(shown) == 2, "nobody asked for a picture"
    due[0] = True
    assert running.tick(bpy.context) and len(shown) == 2
    old = running.latest.iterations  # made when the picture before it had been taken
    tick_until(running, lambda: len(shown) == 3)
    assert shown[2].iterations > old
    running.end()


def test_growth_is_shown_step_by_step_by_a_window_that_comes_late(windowed):
    """Growth takes a small part of a run, and is over before a large mesh has been drawn once."""
    running = begin(sphere(), 0.08)
    while not running.stepper._context.phase == "polish":
        time.sleep(0.01)
    lengths: list[float] = []

    def seen() -> bool:
        if running.latest is not None and running.latest.length not in lengths[-1:]:
            lengths.append(running.latest.length)
        return len(lengths) > 1 and running.latest.kept == 0

    tick_until(running, seen)
    running.end()
    whole = lengths[-1]
    assert lengths[0] < 0.1 * whole and sorted(lengths[:-1]) == lengths[:-1]
    assert np.diff(lengths).max() < 0.2 * whole and len(lengths) > 8


def test_a_run_in_a_window_leaves_a_processor_to_it(windowed, monkeypatch):
    for processors, threads in ((2, 0), (8, 7)):
        monkeypatch.setattr(os, "cpu_count", lambda many=processors: many)
        surface = sphere()
        running = begin(surface, 0.2)
        assert running.stepper.problem.options.threads == threads
        running.end()
        surface.meander.threads = 3
        running = begin(surface, 0.2)
        assert running.stepper.problem.options.threads == 3
        running.end()


def test_a_cancelled_run_leaves_no_trace(windowed):
    surface = sphere()
    before = counts()
    running = begin(surface, 0.1)
    tick_until(running, lambda: running.shown_points > 0)
    assert counts() == before  # drawn, but no object
    running.end()
    assert counts() == before and not running.shown_points
    assert session.current() is None
    assert running._window.texts[-1] is None
    running.end()  # harmless


def test_stop_keeps_what_has_grown(windowed):
    running = begin(sphere(), 0.05)
    tick_until(running, lambda: running.latest and running.latest.iterations > 0)
    running.stop_wanted = True
    tick_until(running, lambda: False)
    result, figures = running.keep(bpy.context)
    running.end()
    assert result.meander.figures.stop_reason == "cancelled"
    assert figures["nodes"] > 0 and len(result.data.splines) == 1
    # It has gaps everywhere: nobody looked for them, and the panel says so.
    assert result.meander.figures.gap_count == -1 and not result.meander.figures.gaps


def test_stopping_at_once_keeps_the_seed(windowed):
    running = begin(sphere(), 0.05)
    running.stepper.cancel()
    tick_until(running, lambda: False)
    result, figures = running.keep(bpy.context)
    running.end()
    assert len(result.data.splines) == 1 and len(result.data.splines[0].points) >= 3
    assert figures["crossings"] == 0


@pytest.mark.parametrize("victim", ["surface", "result"])
def test_deleting_an_object_under_the_run_ends_it(windowed, victim):
    surface = sphere()
    result = fill(surface, 0.2, iteration_limit=10)
    before = counts()
    running = begin(result, 0.05)
    tick_until(running, lambda: running.shown_points > 0)
    bpy.data.objects.remove(surface if victim == "surface" else result)
    with pytest.raises(errors.DataError, match="deleted"):
        running.tick(bpy.context)
    running.end()
    after = counts()
    assert after["curves"] == before["curves"]
    assert after["objects"] == before["objects"] - 1


def test_an_error_of_the_run_reaches_the_host(windowed):
    surface = sphere()
    surface.meander.seed = poly_curve("Far", [circle_points(1.0, 9.0)], True)
    running = begin(surface, 0.2)
    tick_until(running, lambda: False)
    with pytest.raises(core.MeanderError):
        running.keep(bpy.context)
    running.end()
    assert [thing.name for thing in bpy.data.objects if thing.type == "CURVE"] == ["Far"]


def test_a_new_file_ends_the_run(windowed):
    running = begin(sphere(), 0.05)
    assert session.current() is running
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert running.ended and session.current() is None


@pytest.mark.parametrize(("start", "drawn"), [("FULL", True), ("GROW", False)])
def test_a_full_start_is_drawn_from_its_beginning(windowed, monkeypatch, start, drawn):
    """Little by little, and in the end all of it; what grows is shown as it is."""
    shares = []
    show = Preview.show

    def note(self, polylines, share=1.0):
        shares.append(share)
        show(self, polylines, share)

    monkeypatch.setattr(Preview, "show", note)
    monkeypatch.setattr(session, "DRAWN_IN", 0.2)
    thing = sphere()
    thing.meander.start = start
    running = begin(thing, 0.03)
    tick_until(running, lambda: len(shares) > 2 and shares[-1] == 1.0)
    running.stop_wanted = True
    tick_until(running, lambda: False)
    running.end()
    assert shares == sorted(shares) and shares[-1] == 1.0
    assert (shares[0] < 0.5) == drawn
