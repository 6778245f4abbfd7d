# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever happens during a run, a result keeps its splines until it has new ones."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Callable
from pathlib import Path

import bpy
import meander
import numpy as np
import pytest
from meander import core
from meander.run import session, suspended
from meander.run.plan import plan_run
from scenes import activate, counts, fill, grid, sphere, world_splines
from watched_runs import begin, tick_until

pytestmark = pytest.mark.usefixtures("windowed", "nothing_kept")

# The two runs of a test: one that leaves a result, one that is still going when it is looked at.
QUICK, LONG = {"spacing": 0.2, "iteration_limit": 10, "use_bevel": True}, 0.05


def shape_of(name: str) -> list[tuple[bytes, bool]]:
    """All splines of a curve object, to be compared."""
    return [
        (np.array([point.co[:] for point in spline.points]).tobytes(), spline.use_cyclic_u)
        for spline in bpy.data.objects[name].data.splines
    ]


def shape_in_file(path: Path, name: str) -> list[tuple[bytes, bool]]:
    with bpy.data.libraries.load(str(path)) as (_there, here):
        here.objects = [name]
    shape = shape_of(here.objects[0].name)
    bpy.data.objects.remove(here.objects[0])
    return shape


def continued() -> tuple[str, list[tuple[bytes, bool]], session.Session]:
    """A result that is being continued, and is out of sight: its name, its splines, the run."""
    result = fill(sphere(), **QUICK)
    bpy.ops.object.empty_add()  # something else to select
    result.meander.iteration_limit = 0
    name, shape = result.name, shape_of(result.name)
    running = begin(result, LONG)
    bpy.ops.ed.undo_push(message="Before the run")
    tick_until(running, lambda: running.shown_points > 0)
    return name, shape, running


def finish(running: session.Session) -> str:
    """Ends a run as Enter does, and gives it the undo step that the operator would."""
    running.stop_wanted = True
    tick_until(running, lambda: False)
    result, _figures = running.keep(bpy.context)
    running.end()
    bpy.ops.ed.undo_push(message="Fill with Curve")
    return result.name


# -- a result that is continued --------------------------------------------------------------------


def select_another() -> None:
    activate(bpy.data.objects["Empty"])


def move_another() -> None:
    bpy.data.objects["Empty"].location.x += 1.0


def change_a_property() -> None:
    bpy.data.objects["Icosphere"].meander.bevel_share = 0.3


def rename_everything() -> None:
    for thing in bpy.data.objects:
        thing.name = f"Other {thing.name}"


DEEDS = (select_another, move_another, change_a_property)


@pytest.mark.parametrize("deed", DEEDS)
def test_undo_after_a_run_gives_the_former_curve_back(deed):
    name, former, running = continued()
    deed()
    bpy.ops.ed.undo_push(message=deed.__name__)
    assert shape_of(name) == former
    finish(running)
    latter = shape_of(name)
    assert latter != former
    bpy.ops.ed.undo()
    assert shape_of(name) == former
    bpy.ops.ed.undo()
    assert shape_of(name) == former
    bpy.ops.ed.redo()
    assert shape_of(name) == former
    bpy.ops.ed.redo()
    assert shape_of(name) == latter


@pytest.mark.parametrize("deed", DEEDS)
def test_undo_and_redo_during_a_run(deed):
    name, former, running = continued()
    ticks = running.latest.iterations
    deed()
    bpy.ops.ed.undo_push(message=deed.__name__)
    for step in (bpy.ops.ed.undo, bpy.ops.ed.redo, bpy.ops.ed.undo, bpy.ops.ed.redo):
        step()
        assert shape_of(name) == former
        assert running.tick(bpy.context), "the run goes on"
    tick_until(running, lambda: running.latest.iterations > ticks)
    finish(running)
    assert shape_of(name) != former
    bpy.ops.ed.undo()
    assert shape_of(name) == former


def test_a_file_saved_during_a_run_has_the_curve(tmp_path):
    name, former, running = continued()
    paths = [tmp_path / f"{number}.blend" for number in range(3)]
    bpy.ops.wm.save_as_mainfile(filepath=str(paths[0]), copy=True)
    assert shape_in_file(paths[0], name) == former
    tick_until(running, lambda: True)
    # An autosave, and what a crash leaves, ask nobody before they write.
    bpy.data.libraries.write(str(paths[1]), {bpy.data.objects[name]})
    assert shape_in_file(paths[1], name) == former
    running.end()
    bpy.ops.wm.save_as_mainfile(filepath=str(paths[2]), copy=True)
    assert shape_in_file(paths[2], name) == former


@pytest.mark.parametrize("end", ["suspend", "end"])
def test_a_continued_result_is_whole_after_a_cancelled_run(end):
    name, former, running = continued()
    before, data = counts(), bpy.data.objects[name].data
    getattr(running, end)()
    assert shape_of(name) == former and bpy.data.objects[name].data == data
    assert counts() == before


def test_a_continued_result_is_whole_after_the_add_on_has_gone():
    name, former, running = continued()
    meander.unregister()
    try:
        assert running.ended
        assert shape_of(name) == former
        assert bpy.data.objects[name].visible_get()
    finally:
        meander.register()


def test_a_continued_result_that_is_edited_meanwhile_gets_its_new_curve():
    name, former, running = continued()
    activate(bpy.data.objects[name])
    bpy.ops.object.mode_set(mode="EDIT")
    finish(running)
    latter = shape_of(name)
    assert latter != former
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    assert shape_of(name) == latter


def test_a_write_that_fails_leaves_the_splines(monkeypatch):
    from meander.scene import curve_writer

    name, former, running = continued()

    def fails(*_arguments) -> None:
        raise np.linalg.LinAlgError("singular")

    running.stop_wanted = True
    tick_until(running, lambda: False)
    monkeypatch.setattr(curve_writer, "to_local", fails)
    with pytest.raises(np.linalg.LinAlgError):
        running.keep(bpy.context)
    running.end()
    assert shape_of(name) == former


# -- as a box --------------------------------------------------------------------------------------


def drawn_as_box(name: str) -> bool:
    graph = bpy.context.view_layer.depsgraph
    return bpy.data.objects[name].evaluated_get(graph).display_type == "BOUNDS"


def test_a_continued_result_is_drawn_as_a_box_without_a_trace():
    name, _former, running = continued()
    assert drawn_as_box(name)
    result = bpy.data.objects[name]
    result.parent.location.x += 1.0
    bpy.context.view_layer.update()
    assert drawn_as_box(name)
    result.location.y += 0.5
    bpy.context.view_layer.update()
    running.tick(bpy.context)
    bpy.context.view_layer.update()
    assert drawn_as_box(name)
    assert result.display_type == "TEXTURED" and result.visible_get() and result.select_get()
    bpy.ops.ed.undo_push(message="Moved")
    bpy.ops.ed.undo()
    running.tick(bpy.context)
    assert drawn_as_box(name)
    running.end()
    assert not drawn_as_box(name)


def test_a_result_that_is_edited_is_drawn_in_full():
    name, _former, running = continued()
    activate(bpy.data.objects[name])
    bpy.ops.object.mode_set(mode="EDIT")
    running.tick(bpy.context)
    assert not drawn_as_box(name)
    bpy.ops.object.mode_set(mode="OBJECT")
    running.tick(bpy.context)
    assert drawn_as_box(name)
    bpy.data.objects[name].display_type = "WIRE"
    bpy.context.view_layer.update()
    running.end()
    bpy.context.view_layer.update()
    assert bpy.data.objects[name].display_type == "WIRE" and not drawn_as_box(name)


# -- identity --------------------------------------------------------------------------------------


def rename_and_undo() -> None:
    rename_everything()
    bpy.ops.ed.undo_push(message="Rename")
    bpy.ops.ed.undo()


def rename_undo_and_redo() -> None:
    rename_and_undo()
    bpy.ops.ed.redo()


def rename_after_undo() -> None:
    select_another()
    bpy.ops.ed.undo_push(message="Select")
    bpy.ops.ed.undo()
    rename_everything()


def swap_names() -> None:
    surface, another = bpy.data.objects["Icosphere"], bpy.data.objects["Empty"]
    surface.name, another.name = "Aside", "Icosphere"
    surface.name = "Empty"


@pytest.mark.parametrize(
    "deed",
    [rename_everything, rename_and_undo, rename_undo_and_redo, rename_after_undo, swap_names],
)
def test_a_run_follows_its_objects(deed: Callable[[], None]):
    name, former, running = continued()
    result, surface = bpy.data.objects[name], bpy.data.objects["Icosphere"]
    result["mark"], surface["mark"] = "result", "surface"
    bpy.ops.ed.undo_push(message="Marks")
    deed()
    assert running.plan.surface.find()["mark"] == "surface"
    written = finish(running)
    assert bpy.data.objects[written]["mark"] == "result"
    assert bpy.data.objects[written].meander.surface["mark"] == "surface"
    assert shape_of(written) != former
    assert [thing.name for thing in bpy.context.scene.objects if thing.type == "CURVE"] == [written]


def test_a_deleted_surface_is_found_again_after_undo():
    result = fill(sphere(), **QUICK)
    key = plan_run(bpy.context).surface
    bpy.ops.ed.undo_push(message="Before")
    bpy.data.objects.remove(result.meander.surface)
    assert key.find() is None
    bpy.ops.ed.undo_push(message="Deleted")
    bpy.ops.ed.undo()
    assert key.find() == bpy.data.objects["Icosphere"]
    bpy.ops.ed.redo()
    assert key.find() is None


def test_another_object_of_the_name_is_not_taken_for_a_deleted_one():
    surface = sphere()
    other = grid()
    activate(surface)
    surface.meander.spacing = 0.2
    key = plan_run(bpy.context).surface
    name = surface.name
    bpy.data.objects.remove(surface)
    other.name = name
    assert key.find() is None


def test_a_spacing_chosen_during_a_run_is_for_the_next_one():
    surface = sphere()
    running = begin(surface, LONG)
    tick_until(running, lambda: running.shown_points > 0)
    surface.meander.spacing = 0.3
    result = bpy.data.objects[finish(running)]
    assert surface.meander.spacing == result.meander.spacing == pytest.approx(0.3)
    assert result.meander.figures.spacing == pytest.approx(LONG), "what it was made with"


# -- to resume -------------------------------------------------------------------------------------


def suspend_early(thing: bpy.types.Object, spacing: float) -> session.Session:
    running = begin(thing, spacing)
    tick_until(running, lambda: running.latest and running.latest.iterations > 0)
    running.suspend()
    assert running.ended and session.current() is None
    return running


def test_a_resumed_run_gives_the_curve_of_one_that_was_never_ended():
    surface = sphere()
    expected = world_splines(fill(surface, 0.15, iteration_limit=0))
    activate(surface)
    suspend_early(surface, 0.15)
    before = counts()
    assert suspended.run_of(surface) is not None
    assert bpy.ops.meander.resume() == {"FINISHED"}
    result = surface.meander.last_result
    assert counts() == before, "the run updates the curve that it was begun with"
    assert result.meander.figures.stop_reason == "converged"
    found = world_splines(result)
    assert len(found) == len(expected)
    for (points, cyclic), (expected_points, expected_cyclic) in zip(found, expected, strict=True):
        assert cyclic == expected_cyclic
        assert np.array_equal(points, expected_points)
    assert not bpy.ops.meander.resume.poll()


def test_a_run_can_be_resumed_more_than_once():
    surface = sphere()
    surface.meander.iteration_limit = 0
    suspend_early(surface, LONG)
    first = suspended.run_of(surface)
    running = session.Session(first.plan, suspended.taken(plan_run(bpy.context)))
    running.start(bpy.context)
    begun = first.latest.iterations
    tick_until(running, lambda: running.latest.iterations > begun)
    running.suspend()
    assert suspended.run_of(surface).latest.iterations > begun
    finish_it = suspended.taken(plan_run(bpy.context))
    assert finish_it is not None and suspended.run_of(surface) is None


def select_and_deselect(surface: bpy.types.Object) -> None:
    select_something = surface.select_get()
    surface.select_set(not select_something)
    surface.select_set(select_something)


def move(surface: bpy.types.Object) -> None:
    surface.location = (1.0, 2.0, 3.0)
    surface.rotation_euler = (0.1, 0.2, 0.3)


def rename(surface: bpy.types.Object) -> None:
    surface.name = "Renamed"


def choose_bevel(surface: bpy.types.Object) -> None:
    surface.meander.bevel_share = 0.4


def choose_spacing(surface: bpy.types.Object) -> None:
    surface.meander.spacing *= 1.1


def choose_preset(surface: bpy.types.Object) -> None:
    surface.meander.preset = "PAPER"


def scale(surface: bpy.types.Object) -> None:
    surface.scale.x = 2.0


def sculpt(surface: bpy.types.Object) -> None:
    surface.data.vertices[0].co.x += 0.1
    surface.data.update()


def add_modifier(surface: bpy.types.Object) -> None:
    surface.modifiers.new("Subdivision", "SUBSURF")


@pytest.mark.parametrize("deed", [select_and_deselect, move, rename, choose_bevel])
def test_what_means_the_same_run_leaves_resume(deed):
    surface = sphere()
    suspend_early(surface, LONG)
    deed(surface)
    bpy.context.view_layer.update()
    assert suspended.run_of(surface) is not None
    assert bpy.ops.meander.resume.poll()
    assert suspended.taken(plan_run(bpy.context)) is not None


@pytest.mark.parametrize("deed", [choose_spacing, choose_preset, scale, sculpt, add_modifier])
def test_what_means_another_run_takes_resume_away(deed):
    surface = sphere()
    suspend_early(surface, LONG)
    deed(surface)
    bpy.context.view_layer.update()
    assert suspended.run_of(surface) is None
    assert not bpy.ops.meander.resume.poll()


def test_undo_of_a_change_to_the_surface_takes_resume_away():
    surface = sphere()
    bpy.ops.ed.undo_push(message="Sphere")
    sculpt(surface)
    bpy.ops.ed.undo_push(message="Sculpt")
    suspend_early(surface, LONG)
    bpy.ops.ed.undo()
    bpy.context.view_layer.update()
    surface = bpy.data.objects["Icosphere"]
    assert suspended.run_of(surface) is None


def test_another_run_and_another_file_take_resume_away():
    surface = sphere()
    suspend_early(surface, LONG)
    fill(surface, **QUICK)
    assert suspended.run_of(surface) is None
    activate(surface)
    suspend_early(surface, LONG)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert suspended.kept.current is None


def test_resume_is_for_its_own_object():
    surface = sphere()
    suspend_early(surface, LONG)
    assert suspended.run_of(grid()) is None
    assert not bpy.ops.meander.resume.poll()
    activate(surface)
    assert bpy.ops.meander.resume.poll()


def test_a_run_whose_surface_was_deleted_can_be_resumed_after_undo():
    surface = sphere()
    bpy.ops.ed.undo_push(message="Sphere")
    running = begin(surface, LONG)
    tick_until(running, lambda: running.latest and running.latest.iterations > 0)
    bpy.ops.ed.undo_push(message="Spacing")
    bpy.data.objects.remove(surface)
    bpy.ops.ed.undo_push(message="Delete")
    with pytest.raises(ValueError, match="deleted"):
        running.tick(bpy.context)
    running.suspend()
    bpy.ops.ed.undo()
    surface = activate(bpy.data.objects["Icosphere"])
    bpy.context.view_layer.update()
    assert running.plan.surface.find() == surface


@pytest.fixture
def flows(monkeypatch: pytest.MonkeyPatch) -> Callable[[], int]:
    """How many of the flows that a test makes are alive."""
    made, begun = weakref.WeakSet(), core.Flow._begin_life

    def noted(flow: core.Flow) -> None:
        begun(flow)
        made.add(flow)

    monkeypatch.setattr(core.Flow, "_begin_life", noted)

    def alive() -> int:
        gc.collect()
        return len(made)

    return alive


def test_blender_keeps_operators_that_have_run_but_not_their_flows(flows):
    things = [sphere(), sphere()]
    activate(things[0])
    for thing in things:
        thing.meander.spacing = 0.4
        thing.select_set(True)
    # With an undo step, as from a window, Blender keeps it for Adjust Last Operation.
    assert bpy.ops.meander.run("EXEC_DEFAULT", True) == {"FINISHED"}
    assert flows() == 0
    activate(things[0])
    suspend_early(things[0], 0.15)
    assert flows() == 1, "what was ended can be resumed"
    assert bpy.ops.meander.resume("EXEC_DEFAULT", True) == {"FINISHED"}
    assert flows() == 0
