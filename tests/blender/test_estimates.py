# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panel says before a run, when it is measured, and from which size on a run asks."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import pytest
from meander.model.estimate import Estimate
from meander.run import estimate as estimates
from meander.run.plan import plan_run
from meander.run.queue import Queue, objects_of
from meander.scene.look import Look
from meander.ui import fill as run_operators
from meander.ui import preferences
from scenes import activate, cube, fill, grid, point_count, sphere


@pytest.fixture(autouse=True)
def nothing_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(estimates, "_measured", {})
    monkeypatch.setattr(estimates, "speeds", estimates.Speeds())


def measured(thing: bpy.types.Object) -> Estimate:
    estimates.measure(thing)
    estimate = estimates.shown([thing])
    assert estimate is not None
    return estimate


def up_to_date(thing: bpy.types.Object) -> bool:
    """Whether a redraw of the panel orders no measuring."""
    estimates._ordered.clear()
    estimates.shown([thing])
    return not estimates._ordered


@pytest.mark.parametrize("build", [sphere, grid, cube])
def test_the_panel_says_what_the_run_comes_to(build):
    surface = build()
    surface.scale = (1.0, 1.5, 0.8)
    bpy.context.view_layer.update()
    surface.meander.spacing = 0.2
    estimate = measured(surface)
    assert estimate == estimates.of_plan(plan_run(bpy.context))
    # The boundary of a grid leaves a little less.
    assert estimate.points == pytest.approx(point_count(fill(surface, 0.2)), rel=0.2)


def test_symmetry_takes_the_time_of_one_half():
    surface = sphere()
    surface.meander.spacing = 0.02
    whole = measured(surface)
    surface.meander.mirror = "X"
    symmetric = measured(surface)
    assert symmetric == estimates.of_plan(plan_run(bpy.context))
    assert symmetric.points == whole.points
    assert 0.4 < symmetric.seconds / whole.seconds < 0.75


def test_density_and_region_count():
    surface = grid(cells=40)
    surface.meander.spacing = 0.1
    whole = measured(surface).points
    left = [vertex.index for vertex in surface.data.vertices if vertex.co.x < 0.0]
    surface.vertex_groups.new(name="Left").add(left, 1.0, "REPLACE")
    surface.meander.density_group = "Left"
    dense = measured(surface).points
    assert 2.0 < dense / whole < 3.0, "half of it has four times the nodes"
    surface.meander.density_group = ""
    surface.meander.mask_source, surface.meander.mask_group = "GROUP", "Left"
    assert measured(surface).points == pytest.approx(whole / 2.0, rel=0.1)
    assert measured(surface) == estimates.of_plan(plan_run(bpy.context))


def test_curvature_counts():
    surface = sphere()
    surface.scale = (1.0, 1.0, 4.0)
    bpy.context.view_layer.update()
    surface.meander.spacing = 0.1
    even = measured(surface).points
    surface.meander.density_source = "CURVATURE"
    assert measured(surface).points > 1.2 * even
    assert measured(surface) == estimates.of_plan(plan_run(bpy.context))


def test_nothing_is_measured_while_a_panel_is_drawn(monkeypatch):
    surface = sphere()
    monkeypatch.setattr(estimates, "triangles_of", lambda *_: pytest.fail("a panel measures"))
    assert estimates.shown([surface]) is None
    assert estimates._ordered


def test_measured_once_until_the_shape_changes():
    surface = sphere()
    surface.meander.spacing = 0.1
    coarse = measured(surface)
    assert up_to_date(surface)
    surface.meander.spacing = 0.05
    assert up_to_date(surface), "another spacing is arithmetic"
    assert estimates.shown([surface]).points == pytest.approx(4 * coarse.points, rel=0.2)
    surface.select_set(False)
    surface.location.x += 1.0
    bpy.context.view_layer.update()
    assert up_to_date(surface)
    for change in (
        lambda: setattr(surface, "scale", (2.0, 1.0, 1.0)),
        lambda: surface.modifiers.new("Subdivision", "SUBSURF"),
        lambda: surface.data.vertices[0].co.__setitem__(0, 3.0),
    ):
        change()
        surface.data.update()
        bpy.context.view_layer.update()
        assert not up_to_date(surface)
        measured(surface)
        assert up_to_date(surface)


@pytest.mark.parametrize("hide", ["hide_viewport", "hide_set"])
def test_measuring_a_hidden_surface_does_not_ask_for_more(hide):
    result = fill(sphere(), 0.3)
    surface = result.meander.surface
    if hide == "hide_set":
        surface.hide_set(True)
    else:
        surface.hide_viewport = True
    bpy.context.view_layer.update()
    activate(result)
    measured(result)
    bpy.context.view_layer.update()
    assert up_to_date(result)


def test_what_cannot_be_filled_has_no_estimate():
    surface = sphere()
    surface.meander.density_source = "ATTRIBUTE"
    estimates.measure(surface)
    assert estimates.shown([surface]) is None and up_to_date(surface)
    flat = sphere()
    flat.scale.x = 0.0
    bpy.context.view_layer.update()
    estimates.measure(flat)
    assert estimates.shown([flat]) is None


def test_another_object_does_not_show_the_figures_of_the_last():
    measured(sphere())
    assert estimates.shown([grid()]) is None


def test_a_result_is_estimated_as_its_surface():
    surface = sphere()
    surface.meander.spacing = 0.2
    estimate = measured(surface)
    result = fill(surface, 0.2)
    assert measured(result).points == estimate.points


def test_automatic_spacing_is_what_the_run_takes():
    surface = sphere()
    assert surface.meander.spacing == 0.0
    assert measured(surface).points == pytest.approx(
        estimates.of_plan(plan_run(bpy.context)).points, rel=1e-6
    )


def test_several_objects_are_estimated_together():
    first, second, third = sphere(), cube(), grid()
    for thing in (second, third):
        thing.location.x = 3.0
    first.meander.spacing = 0.2
    third.meander.spacing = 0.3
    activate(first)
    for thing in (second, third):
        thing.select_set(True)
    bpy.context.view_layer.update()
    objects = objects_of(bpy.context)
    assert set(objects) == {first, second, third} and objects[0] == first
    assert estimates.shown(objects) is None
    for thing in objects:
        estimates.measure(thing)
    queue = Queue(bpy.context, restart=False, beside=False)
    expected = queue.estimate_of_rest(bpy.context, queue.next_plan(bpy.context))
    assert estimates.shown(objects).points == pytest.approx(expected.points, rel=1e-3)


def test_what_cannot_be_filled_counts_for_nothing_among_others():
    good, bad = sphere(), sphere()
    good.meander.spacing = bad.meander.spacing = 0.2
    bad.meander.density_source = "ATTRIBUTE"
    for thing in (good, bad):
        estimates.measure(thing)
    assert estimates.shown([good, bad]) == estimates.shown([good])


def test_the_panel_says_what_automatic_comes_to():
    surface = sphere()
    assert estimates.automatic(surface) == 0.0
    estimates.measure(surface)
    assert estimates.automatic(surface) == pytest.approx(plan_run(bpy.context).spacing)


# -- the question ----------------------------------------------------------------------------------


def test_the_preferences_say_what_is_large(monkeypatch):
    small, long, heavy = (
        Estimate(10_000, 1.0, 10**7),
        Estimate(600_000, 1.0, 10**7),
        Estimate(10_000, 1.0, 3 * 10**9),
    )
    assert [preferences.is_large(size) for size in (small, long, heavy)] == [False, True, True]
    chosen = SimpleNamespace(most_points=0, most_memory=5)
    monkeypatch.setattr(
        preferences,
        "_limit",
        lambda name: getattr(chosen, name),
    )
    assert [preferences.is_large(size) for size in (small, long, heavy)] == [True, True, True]
    chosen.most_memory = 0
    assert not preferences.is_large(heavy), "0 never asks"


def test_the_preferences_belong_to_the_package():
    assert preferences.MeanderPreferences.bl_idname == preferences.PACKAGE == "meander"


class Rows:
    """A layout that keeps its labels."""

    def __init__(self) -> None:
        self.texts: list[str] = []

    def column(self) -> Rows:
        return self

    def label(self, text: str, icon: str) -> None:
        del icon
        self.texts.append(text)


def test_a_question_names_the_export_where_blender_would_hang(monkeypatch):
    asked: list[dict] = []
    monkeypatch.setattr(
        run_operators, "bpy", SimpleNamespace(ops=SimpleNamespace(meander=SimpleNamespace(
            ask_run=lambda _mode, **given: asked.append(given)
        )))
    )
    for points, radius in ((600_000, 0.2), (3_000_000, 0.2), (2_000_000, 0.0)):
        operator = SimpleNamespace(
            _queue=SimpleNamespace(estimate_of_rest=lambda *_, n=points: Estimate(n, 1.0, 10**7)),
            _what=dict,
        )
        plan = SimpleNamespace(look=Look(radius))
        assert run_operators.MEANDER_OT_run._asks(operator, None, plan)
    rows = Rows()
    run_operators.draw_question(rows, asked[1]["figures"], asked[1]["notice"])
    assert any("batch command" in text for text in rows.texts)
    assert asked[0]["notice"] == ""
    assert asked[2]["notice"] == "", "a bare curve"


def test_scripts_are_not_asked(monkeypatch):
    surface = sphere()
    monkeypatch.setattr(run_operators, "is_large", lambda _estimate: True)
    assert point_count(fill(surface, 0.3)) > 0
