# SPDX-License-Identifier: GPL-3.0-or-later
"""Live: a curve follows its settings and its paint, while it grows and after."""

from __future__ import annotations

import time

import bpy
import numpy as np
import pytest
from meander.model.estimate import in_words
from meander.run import estimate, live, session, suspended
from meander.run.plan import Plan
from scenes import activate, counts, fill, grid, length_of, sphere, world_splines
from watched_runs import begin, tick_until

pytestmark = pytest.mark.usefixtures("nothing_kept")

SPACING = 0.25


def length_above(result: bpy.types.Object, share: float = 1.0) -> float:
    """The length of a curve above z = 0; times share, the rest."""
    total = 0.0
    for points, cyclic in world_splines(result):
        points = np.vstack([points, points[:1]]) if cyclic else points
        above = (points[1:, 2] + points[:-1, 2]) * share > 0.0
        total += float(np.linalg.norm(np.diff(points, axis=0), axis=1)[above].sum())
    return total


def paint_above(surface: bpy.types.Object, weight: float) -> None:
    """As a brush does: weights of the vertices above the middle, and an update."""
    group = surface.vertex_groups.get("Dense") or surface.vertex_groups.new(name="Dense")
    upper = [vertex.index for vertex in surface.data.vertices if vertex.co.z > 0.0]
    group.add(upper, weight, "REPLACE")
    surface.data.update_tag()
    bpy.context.view_layer.update()


def test_a_finished_curve_takes_another_spacing_from_its_mesh_or_itself():
    surface = sphere()
    result = fill(surface, spacing=SPACING, live=True)
    name, first = result.name, length_of(result)
    iterations = result.meander.figures.iterations
    activate(surface)
    surface.meander.spacing = 0.9 * SPACING
    assert bpy.ops.meander.live() == {"FINISHED"}
    assert length_of(result) == pytest.approx(first / 0.9, rel=0.08)
    assert result.meander.spacing == pytest.approx(0.9 * SPACING)
    # It was fitted, and has not grown once more.
    assert result.meander.figures.iterations < 1.3 * iterations
    # The result's own settings count as much, and the mesh takes them over.
    activate(result)
    result.meander.spacing = SPACING
    assert bpy.ops.meander.live() == {"FINISHED"}
    assert length_of(result) == pytest.approx(first, rel=0.08)
    assert surface.meander.spacing == pytest.approx(SPACING)
    assert [thing.name for thing in bpy.data.objects if thing.type == "CURVE"] == [name]
    assert bpy.context.view_layer.objects.active == result


def test_what_a_flow_does_not_take_leaves_the_curve_as_it_is():
    surface = sphere()
    result = fill(surface, spacing=SPACING, live=True)
    before = length_of(result)
    activate(surface)
    surface.meander.motion_steps += 1
    assert bpy.ops.meander.live() == {"CANCELLED"}
    assert length_of(result) == before
    surface.meander.spacing = 0.9 * SPACING  # and it still goes on
    assert bpy.ops.meander.live() == {"FINISHED"}
    assert length_of(result) > before


def test_paint_makes_strands_denser_where_it_is():
    surface = sphere()
    paint_above(surface, 0.0)
    result = fill(
        surface,
        spacing=0.35,
        live=True,
        density_source="GROUP",
        density_group="Dense",
        factor_1=0.5,
    )
    assert length_above(result) == pytest.approx(length_above(result, -1.0), rel=0.15)
    activate(surface)
    paint_above(surface, 1.0)
    assert bpy.ops.meander.live() == {"FINISHED"}
    assert length_above(result) > 1.7 * length_above(result, -1.0)


def test_points_edited_by_hand_and_other_shapes_are_gone_on_from_as_they_are():
    surface = grid()
    result = fill(surface, spacing=SPACING, live=True)
    activate(result)
    kept = live.finished.current.run.stepper
    result.data.splines[0].points[0].co.x += 0.01
    depsgraph = bpy.context.evaluated_depsgraph_get()
    assert live.taken(result, depsgraph) is None
    # Where there is no flow any more, the curve goes on from its points, also from the mesh.
    for active, spacing in ((surface, 0.9 * SPACING), (result, SPACING)):
        live.finished.end()
        activate(active)
        active.meander.spacing = spacing
        before = counts()
        assert bpy.ops.meander.live() == {"FINISHED"}
        assert counts() == before
        assert bpy.context.view_layer.objects.active == active
        assert result.meander.figures.spacing_median == pytest.approx(spacing, rel=0.1)
    result = fill(surface, spacing=SPACING, live=True)
    assert live.finished.current.run.stepper is not kept
    surface.data.vertices[0].co.x += 0.01
    surface.data.update_tag()
    assert live.taken(surface, bpy.context.evaluated_depsgraph_get()) is None


@pytest.mark.usefixtures("windowed")
def test_a_run_takes_spacing_and_paint_while_it_goes():
    surface = sphere()
    paint_above(surface, 0.0)
    settings = surface.meander
    settings.live, settings.density_source, settings.density_group = True, "GROUP", "Dense"
    running = begin(surface, 0.12)
    tick_until(running, lambda: running.latest and running.latest.iterations > 3)
    settings.spacing = 0.2
    tick_until(running, lambda: running.plan.spacing == pytest.approx(0.2))
    assert not running.stepper.finished
    paint_above(surface, 1.0)
    tick_until(running, lambda: running.stepper.density.max() > 1.0)
    settings.density_source = "NONE"
    tick_until(running, lambda: running.stepper.density is None)
    settings.spacing = 1e6
    tick_until(running, lambda: running.refusal)
    assert "larger than the surface" in running.refusal
    settings.spacing = 0.4
    tick_until(running, lambda: False)
    result, figures = running.keep(bpy.context)
    running.end()
    assert figures["spacing_target"] == pytest.approx(0.4)
    assert result.meander.spacing == pytest.approx(0.4)
    assert figures["stop_reason"] == "converged"


@pytest.mark.usefixtures("windowed")
def test_what_is_asked_while_a_run_ends_is_done():
    surface = sphere()
    surface.meander.live = True
    running = begin(surface, 0.4)
    tick_until(running, lambda: running.latest)
    keep_out = running._preview.keep_result_out

    def asked_as_it_ends() -> None:
        # Wishes have been looked for in this tick.
        surface.meander.spacing = 0.5
        while not running.stepper.finished:
            time.sleep(0.01)
        keep_out()

    running._preview.keep_result_out = asked_as_it_ends
    assert running.tick(bpy.context)
    running._preview.keep_result_out = keep_out
    tick_until(running, lambda: False)
    _result, figures = running.keep(bpy.context)
    running.end()
    assert figures["spacing_target"] == pytest.approx(0.5)


def seconds_of(plan: Plan) -> float:
    return estimate.of_plan(plan).seconds


@pytest.mark.usefixtures("windowed")
def test_the_time_left_is_there_at_once_for_what_live_asks():
    surface = sphere()
    surface.meander.live = True
    running = begin(surface, 0.05)
    assert running.left_text() == in_words(seconds_of(running.plan)), "nobody has measured it yet"
    tick_until(running, lambda: running.latest and running.latest.iterations > 3)
    surface.meander.spacing = 0.02
    tick_until(running, lambda: running.plan.spacing == pytest.approx(0.02))
    assert running.left_text() == in_words(seconds_of(running.plan))
    assert running.left_text() != in_words(0.0)
    # A run that goes on has the rest of it before it.
    while running.progress() < 0.02:
        assert running.tick(bpy.context)
    running.suspend()
    kept = suspended.run_of(surface)
    assert kept is not None and kept.latest.progress >= 0.02
    resumed = session.Session(kept.plan, kept)
    resumed.start(bpy.context)
    left = seconds_of(kept.plan) * (1.0 - kept.latest.progress)
    assert resumed.left_text() == in_words(left)
    resumed.end()


@pytest.mark.usefixtures("windowed")
def test_the_time_left_is_there_at_once_where_a_finished_curve_goes_on():
    surface = sphere()
    fill(surface, spacing=SPACING, live=True)
    activate(surface)
    surface.meander.spacing = 0.02
    kept = live.taken(surface, bpy.context.evaluated_depsgraph_get())
    running = session.Session(kept.plan, kept)
    assert running.find_wish(bpy.context, surface)
    running.start(bpy.context)
    tick_until(running, lambda: running.plan.spacing == pytest.approx(0.02))
    assert running.left_text() == in_words(seconds_of(running.plan)) != in_words(0.0)
    running.end()


@pytest.mark.usefixtures("windowed")
def test_without_live_a_run_is_what_it_was_planned_as():
    surface = sphere()
    running = begin(surface, 0.3)
    surface.meander.spacing = 0.5
    tick_until(running, lambda: False)
    _result, figures = running.keep(bpy.context)
    running.end()
    assert figures["spacing_target"] == pytest.approx(0.3)
    assert surface.meander.spacing == pytest.approx(0.5)
