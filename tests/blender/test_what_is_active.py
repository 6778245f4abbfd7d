# SPDX-License-Identifier: GPL-3.0-or-later
"""Who owns what is active: seeds that are drawn, what is clicked meanwhile, what a fill leaves."""

from __future__ import annotations

import bpy
import pytest
from meander.run import session
from meander.scene import look
from meander.scene.bake import looks_differ
from meander.ui import drawing
from meander.ui import look as look_panel
from meander.ui.panels import MEANDER_PT_main
from panel_layout import texts_of
from scenes import activate, circle_points, cube, fill, points_of, poly_curve, sphere
from watched_runs import begin, tick_until


def active() -> bpy.types.Object:
    return bpy.context.view_layer.objects.active


# -- a seed that is drawn --------------------------------------------------------------------------


def stroke(curve: bpy.types.Object) -> None:
    bpy.ops.object.mode_set(mode="OBJECT")
    spline = curve.data.splines.new("POLY")
    spline.points.add(23)
    for point, place in zip(spline.points, circle_points(1.0, 0.0)):
        point.co = (*place, 1.0)
    spline.use_cyclic_u = True
    bpy.ops.object.mode_set(mode="EDIT")


def test_tab_is_end_drawing():
    surface = sphere()
    bpy.ops.meander.draw_seed()
    curve = active()
    stroke(curve)
    bpy.ops.object.mode_set(mode="OBJECT")  # as Tab does
    drawing.watch()
    assert active() == surface and surface.select_get() and not curve.select_get()
    assert surface.meander.seed == curve
    assert drawing.surface_drawn_on(curve) is None


def test_tab_without_a_stroke_gives_the_seed_back_that_there_was():
    surface, before = sphere(), poly_curve("Before", [circle_points(1.0, 0.0)], True)
    surface.meander.seed = before
    activate(surface)
    bpy.ops.meander.draw_seed()
    name = active().name
    bpy.ops.object.mode_set(mode="OBJECT")
    drawing.watch()
    assert surface.meander.seed == before
    assert active() == surface
    assert name not in bpy.data.objects


def test_what_was_clicked_after_drawing_stays_active():
    surface = sphere()
    other = cube()
    activate(surface)
    bpy.ops.meander.draw_seed()
    stroke(active())
    bpy.ops.object.mode_set(mode="OBJECT")
    activate(other)
    drawing.watch()
    assert active() == other
    assert surface.meander.seed is not None


@pytest.mark.parametrize("field", ["seed", "guides"])
def test_a_selected_seed_offers_the_fill_of_its_mesh(field):
    surface = sphere()
    curve = poly_curve("Ring", [circle_points(1.0, 0.0)], True)
    setattr(surface.meander, field, curve)
    surface.meander.spacing, surface.meander.use_bevel = 0.3, False
    activate(curve)
    texts = texts_of(MEANDER_PT_main)
    assert surface.name in texts and "Fill with Curve" in texts
    assert not any("no faces" in text for text in texts)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert surface.meander.last_result is not None
    activate(curve)
    assert "Fill Again" in texts_of(MEANDER_PT_main)


def test_a_curve_that_is_no_seed_says_what_it_lacks():
    sphere()
    activate(poly_curve("Ring", [circle_points(1.0, 0.0)], True))
    assert "no faces" in " ".join(texts_of(MEANDER_PT_main))
    assert not bpy.ops.meander.run.poll()


# -- what is clicked while a curve grows -----------------------------------------------------------


@pytest.mark.parametrize("click", ["another", "nothing"])
def test_a_run_that_ends_leaves_what_was_clicked_meanwhile(windowed, nothing_kept, click):
    other = cube()
    surface = sphere()
    surface.meander.spacing = 0.3
    running = begin(surface, 0.3)
    tick_until(running, lambda: running.stepper.finished)
    if click == "another":
        activate(other)
    else:
        activate(surface).select_set(False)
    running.keep(bpy.context)
    running.end()
    assert active() == (other if click == "another" else surface)
    assert other.select_get() == (click == "another")


def test_a_run_that_ends_shows_its_curve_where_nobody_clicked(windowed, nothing_kept):
    surface = sphere()
    surface.meander.spacing = 0.3
    running = begin(surface, 0.3)
    tick_until(running, lambda: running.stepper.finished)
    result, _figures = running.keep(bpy.context)
    running.end()
    assert active() == result


# -- after a fill ----------------------------------------------------------------------------------


def test_one_click_selects_the_curve():
    surface = sphere()
    result = fill(surface, 0.3)
    for thing in (result, surface):
        activate(thing)
        if thing is result:
            thing.select_set(False)
        assert "meander.select_curve" in operators()
        assert bpy.ops.meander.select_curve() == {"FINISHED"}
        assert active() == result and bpy.context.selected_objects == [result]
    assert "meander.select_curve" not in operators()


def operators() -> list[str]:
    """The operators of the panel's buttons, with text or without."""
    found = []

    class Buttons:
        def __getattr__(self, _name):
            return lambda *given, **_options: Buttons()

        def __setattr__(self, _name, _value) -> None:
            pass

        def operator(self, name, **_options):
            found.append(name)
            return Buttons()

    panel = type("Panel", (), {"layout": Buttons()})()
    for name in ("_draw_settings", "_draw_buttons", "_draw_seed", "_draw_progress"):
        setattr(type(panel), name, getattr(MEANDER_PT_main, name))
    MEANDER_PT_main.draw(panel, bpy.context)
    return found


def test_with_the_mesh_active_all_goes_on_with_its_curve(tmp_path):
    surface = sphere()
    result = fill(surface, 0.3)
    before = points_of(result)
    activate(surface)
    texts = texts_of(MEANDER_PT_main)
    assert {"Continue", "Fill Again", "New Curve"} <= set(texts)
    assert bpy.ops.meander.run(go_on=True) == {"FINISHED"}
    assert active() == result and surface.meander.last_result == result
    assert len(points_of(result)) != 0 and len(before) != 0
    activate(surface)
    path = tmp_path / "curve.csv"
    assert bpy.ops.meander.export_toolpath(filepath=str(path)) == {"FINISHED"}
    assert path.stat().st_size > 0
    for maker in ("two_tone", "relief", "points_to_mesh"):
        activate(surface)
        assert getattr(bpy.ops.meander, maker)() == {"FINISHED"}
        assert active().meander.made_from == result or maker == "points_to_mesh"
        for thing in (surface, result):
            thing.hide_set(False)


def test_the_buttons_of_a_mesh_with_a_curve_take_no_more_rows():
    surface = sphere()
    fill(surface, 0.3)
    rows = []
    for thing in (surface, surface.meander.last_result):
        activate(thing)
        rows.append(len([text for text in texts_of(MEANDER_PT_main)]))
    assert rows[0] == rows[1]


# -- a look after a bake ---------------------------------------------------------------------------


@pytest.mark.parametrize("bake", ["bake_growth", "animate_growth"])
def test_baked_frames_follow_the_look(bake):
    surface = sphere()
    result = fill(surface, 0.4, use_bevel=True)
    activate(result)
    arguments = {"every": 8} if bake == "bake_growth" else {"frames": 4}
    assert getattr(bpy.ops.meander, bake)(**arguments) == {"FINISHED"}
    frames = list(result.meander.bake.objects)
    assert frames
    modifier = look.modifier_of(result)
    look.set_value(modifier, "Radius", 0.123)
    look.set_value(modifier, "Lift", 0.2)
    result.data.materials[0] = bpy.data.materials.new("Other")
    look.write(result, modifier)
    assert looks_differ(result)
    activate(surface)
    texts_of(look_panel.MEANDER_PT_look)  # which orders it
    look_panel.pass_on()
    assert not looks_differ(result)
    for frame in frames:
        its = look.modifier_of(frame)
        assert look.value_of(its, "Radius") == pytest.approx(0.123)
        assert look.value_of(its, "Material").name == "Other"
        assert frame.data.materials[0].name == "Other"


def test_a_script_s_look_is_on_the_frames_of_the_saved_file(tmp_path):
    surface = sphere()
    result = fill(surface, 0.4, use_bevel=True)
    activate(result)
    bpy.ops.meander.animate_growth(frames=4)
    look.set_value(look.modifier_of(result), "Radius", 0.123)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    for frame in result.meander.bake.objects:
        assert look.value_of(look.modifier_of(frame), "Radius") == pytest.approx(0.123)
    assert session.current() is None
