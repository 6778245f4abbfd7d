# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever a user does while a curve grows."""

from __future__ import annotations

import tempfile
from collections.abc import Generator, Iterator

import bpy
from meander.run import estimate, plan, session, suspended
from meander.ui import fill
from stage import (
    COARSE,
    FINE,
    RESULT,
    SURFACE,
    activate,
    assert_nothing_left_over,
    changed_share,
    choose_spacing,
    click,
    ended,
    key,
    middle_of,
    options_of_settings,
    press_run,
    redrawn,
    seen,
    shown_points,
    splines_of,
    state,
    status_texts,
    step,
    suzanne_in_view,
    undo,
    until,
    window_override,
)

# Of a run that the user is asked about: what comes to more points at a fine spacing.
LARGE = 20_000


def grows() -> Iterator[float]:
    """Until the run has made another iteration."""
    assert not ended(), "the run has ended"
    latest = session.current().latest
    begun = latest.iterations if latest else -1
    yield from until(
        lambda: ended() or (session.current().latest or latest).iterations > begun,
        "another iteration",
    )
    assert not ended(), "the run has ended"


def all_selected() -> bool:
    return len(bpy.context.selected_objects) > 1


def press_resume() -> None:
    with bpy.context.temp_override(**window_override()):
        assert bpy.ops.meander.resume("INVOKE_DEFAULT") == {"RUNNING_MODAL"}


def splines_in_file(path: str) -> list[bytes]:
    with bpy.data.libraries.load(path) as (_there, here):
        here.objects = [RESULT]
    splines = splines_of(here.objects[0].name)
    bpy.data.objects.remove(here.objects[0])
    return splines


def window_opens() -> Iterator[float]:
    yield from suzanne_in_view(COARSE)
    surfaces = [bpy.context.active_object]
    yield from until(lambda: estimate.shown(surfaces) is not None, "an estimate")
    measured = estimate.shown(surfaces)
    yield from seen("5_estimate")
    press_run()
    yield from until(ended, "the end of the run")
    points = sum(len(spline.points) for spline in bpy.data.objects[RESULT].data.splines)
    assert 0.8 < measured.points / points < 1.25, (measured, points)
    yield from seen("5_result")


def undo_during_a_run() -> Iterator[float]:
    step("what happens during a run has its undo steps, which hold the whole result")
    former = splines_of(RESULT)
    choose_spacing(FINE)
    press_run()
    yield from until(lambda: shown_points() > 0, "a first curve")
    yield from grows()
    yield from seen("5_continued")
    assert changed_share("5_result", "5_continued") > 0.02
    key("A")  # selects everything
    yield from until(all_selected, "everything selected")
    yield from grows()
    assert splines_of(RESULT) == former
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/during.blend"
        bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
        assert splines_in_file(path) == former
    for shift in (False, True):
        key("Z", ctrl=True, shift=shift)
        yield from until(lambda wanted=shift: all_selected() == wanted, "undo is for the scene")
        yield from grows()
        assert splines_of(RESULT) == former
    key("RET")
    yield from until(ended, "the end after Enter")
    assert_nothing_left_over()
    step("one undo takes the new curve back, and one redo brings it again")
    latter = splines_of(RESULT)
    assert latter != former
    for shift, expected in ((False, former), (True, latter), (False, former), (False, former)):
        yield from undo(redo=shift)
        yield from until(lambda wanted=expected: splines_of(RESULT) == wanted, f"redo {shift}")
    for _ in range(2):
        yield from undo(redo=True)
    yield from until(lambda: splines_of(RESULT) == latter, "the new splines")


def clicks_during_a_run() -> Generator[float, None, dict]:
    step("a right-click does what it always does, and Esc belongs to who is under the mouse")
    activate(SURFACE)
    choose_spacing(FINE)
    before = state()
    press_run()
    yield from until(lambda: shown_points() > 0, "a first curve")
    assert "Right" not in status_texts[-1], status_texts[-1]
    for place in (middle_of("OUTLINER"), middle_of("PROPERTIES"), middle_of("VIEW_3D")):
        click(*place, button="RIGHTMOUSE")
        yield 0.3
        assert not ended(), "a right-click has ended the run"
        key("ESC", at=place)  # closes the menu
        yield 0.3
        assert not ended(), "Esc has ended the run instead of closing a menu"
    for area in ("OUTLINER", "PROPERTIES", "DOPESHEET_EDITOR"):
        place = middle_of(area)
        click(*place, button="MIDDLEMOUSE")
        key("ESC", at=place)
        yield 0.3
        assert not ended(), f"Esc over {area} has ended the run"
    yield from grows()
    return before


def esc_and_resume(before: dict) -> Iterator[float]:
    step("Esc in the view ends a run, and Continue goes on with it")
    key("ESC", at=middle_of("VIEW_3D"))
    yield from until(ended, "the end after Esc")
    assert_nothing_left_over()
    assert state() == before
    kept = suspended.run_of(bpy.data.objects[SURFACE])
    assert kept is not None and kept.latest.iterations > 0
    yield from seen("5_resume")
    begun = kept.latest.iterations
    press_resume()
    yield from until(lambda: shown_points() > 0, "the curve again")
    assert session.current().latest.iterations >= begun
    yield from grows()
    key("Z", ctrl=True)
    yield from grows()
    key("ESC", at=middle_of("VIEW_3D"))
    yield from until(ended, "the end after Esc")
    activate(SURFACE)
    bpy.data.objects[SURFACE].meander.spacing = COARSE
    yield from seen("5_changed")
    assert suspended.run_of(bpy.data.objects[SURFACE]) is None


def renamed_during_a_run() -> Iterator[float]:
    step("a run follows its objects when they are renamed")
    choose_spacing(FINE)
    press_run()
    yield from until(lambda: shown_points() > 0, "a first curve")
    bpy.data.objects[SURFACE].name = "Monkey"
    bpy.ops.ed.undo_push(message="Rename")
    yield from grows()
    key("Z", ctrl=True)
    yield from until(lambda: SURFACE in bpy.data.objects, "the former name")
    yield from grows()
    key("Z", ctrl=True, shift=True)
    yield from until(lambda: "Monkey" in bpy.data.objects, "the new name again")
    yield from grows()
    key("RET")
    yield from until(ended, "the end after Enter")
    result = bpy.data.objects["Monkey"].meander.last_result
    assert result.type == "CURVE" and result.meander.surface.name == "Monkey"
    assert result.meander.figures.stop_reason == "cancelled"


def repeat_last() -> Iterator[float]:
    step("Repeat Last is a modal run")
    activate("Monkey")
    choose_spacing(FINE)
    key("R", shift=True)
    yield from until(lambda: session.current() is not None, "a run after Shift+R")
    yield from until(lambda: shown_points() > 0, "a first curve")
    yield from grows()
    key("ESC")
    yield from until(ended, "the end after Esc")


def another_scene_meanwhile() -> Iterator[float]:
    step("a result goes to the scene of its surface, though the window shows another by then")
    surface = activate_surface()
    former = splines_of(surface.meander.last_result.name)
    choose_spacing(FINE)
    press_run()
    yield from until(lambda: shown_points() > 0, "a first curve")
    window = bpy.context.window_manager.windows[0]
    home = window.scene
    with bpy.context.temp_override(**window_override()):
        bpy.ops.scene.new(type="NEW")
    other = window.scene
    assert other != home
    yield from seen("5_other_scene")
    yield from grows()
    key("RET")
    yield from until(ended, "the end after Enter")
    assert window.scene == other, "what the window shows is the user's"
    assert not other.objects, list(other.objects)
    window.scene = home
    yield from redrawn()
    result = bpy.data.objects["Monkey"].meander.last_result
    assert result.users_scene[:] == (home,)
    assert splines_of(result.name) != former
    bpy.data.scenes.remove(other)
    yield from seen("5_home_again")


def activate_surface() -> bpy.types.Object:
    activate("Monkey")
    return bpy.data.objects["Monkey"]


def large_run() -> Iterator[float]:
    step("a large run asks first")
    plan.options_of = options_of_settings  # as everywhere but here: the question says how long
    is_large = fill.is_large
    fill.is_large = lambda estimate: estimate.points > LARGE
    choose_spacing(0.6 * FINE)
    with bpy.context.temp_override(**window_override()):
        assert bpy.ops.meander.run("INVOKE_DEFAULT") == {"CANCELLED"}
    assert session.current() is None
    yield from seen("5_question")
    place = middle_of("VIEW_3D")
    key("ESC", at=place)
    yield from redrawn()
    assert session.current() is None
    with bpy.context.temp_override(**window_override()):
        assert bpy.ops.meander.run("INVOKE_DEFAULT") == {"CANCELLED"}
    yield from redrawn()
    key("RET", at=place)
    yield from until(lambda: session.current() is not None, "a run after OK")
    yield from until(lambda: shown_points() > 0, "a first curve")
    key("ESC", at=place)
    yield from until(ended, "the end after Esc")
    fill.is_large = is_large


def story() -> Iterator[float]:
    yield from window_opens()
    yield from undo_during_a_run()
    before = yield from clicks_during_a_run()
    yield from esc_and_resume(before)
    yield from renamed_during_a_run()
    yield from repeat_last()
    yield from another_scene_meanwhile()
    yield from large_run()
