# SPDX-License-Identifier: GPL-3.0-or-later
"""What lasts before a run on a large mesh: done on a thread of the library's, a window living."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator

import bpy
import numpy as np
import pytest
from meander import core
from meander.run import estimate, lasting, session, stepper, suspended
from meander.run.plan import plan_run
from meander.scene.errors import DataError
from scenes import activate
from watched_runs import FakeWindow, begin, tick_until

SPACING = 0.3


def sphere(name: str = "Scan", turns: int = 40) -> bpy.types.Object:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=2 * turns, ring_count=turns)
    thing = bpy.context.active_object
    thing.name = name
    return thing


class Held:
    """Calls that are begun on a thread of the library's: counted, and at an end when let go.

    free   how many of them may end
    """

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.begun: list[core.Begun] = []
        self.free = 0.0
        running, begin_of = core.Begun.running.fget, core.Work.begin
        self.works = lambda: any(one._pointer is not None and running(one) for one in self.begun)

        def begin(work: core.Work, context: core.Context) -> core.Begun:
            self.begun.append(begin_of(work, context))
            return self.begun[-1]

        monkeypatch.setattr(core.Work, "begin", begin)
        monkeypatch.setattr(core.Begun, "running", property(lambda one: held(one) or running(one)))

        def held(one: core.Begun) -> bool:
            return not any(one is each for each in self.begun[: int(min(self.free, 99))])

    def let_one(self, running: session.Session) -> None:
        """Lets one more end, and the run take note of it."""
        self.free += 1.0
        tick_until(running, lambda: len(self.begun) > self.free or prepared(running))


@pytest.fixture
def held(monkeypatch: pytest.MonkeyPatch) -> Iterator[Held]:
    monkeypatch.setattr(session, "Window", FakeWindow)
    monkeypatch.setattr(stepper, "MANY_FACES", 100)
    yield Held(monkeypatch)
    lasting.end_all()


def at_once(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The calls that last and are made while the caller waits, from here on."""
    made: list[str] = []
    now = core.Work.now

    def noted(work: core.Work, context: core.Context | None = None) -> object:
        made.append(work._name)
        return now(work, context)

    monkeypatch.setattr(core.Work, "now", noted)
    return made


def scene_as_it_is() -> tuple[object, ...]:
    """All that a run could leave behind."""
    return (
        sorted(bpy.data.objects.keys()),
        sorted(bpy.data.curves.keys()),
        sorted(bpy.data.meshes.keys()),
        bpy.context.view_layer.objects.active,
        session.current(),
    )


def prepared(running: session.Session) -> bool:
    return not running.stepper.preparing


def result_points(running: session.Session) -> np.ndarray:
    result, _figures = running.keep(bpy.context)
    points = np.empty(4 * len(result.data.splines[0].points), np.float32)
    result.data.splines[0].points.foreach_get("co", points)
    return points


def test_begins_without_waiting_for_anything(
    held: Held, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = at_once(monkeypatch)
    running = begin(sphere(), SPACING)
    for _ in range(5):
        assert running.tick(bpy.context) and running.stepper.preparing
    assert len(held.begun) == 1 and not made, "the first call goes on, and no other is made"
    while held.works():
        time.sleep(0.01)
    running.tick(bpy.context)
    assert running.progress_text() == f"Preparing the mesh, {running.bar():.0%}"
    assert running._window.texts[-1] == running.progress_text()
    assert 0.5 < running.bar() <= 1.0, "the share is that of the call"
    assert running.left_text() == "" and running.progress() == 0.0
    held.free = math.inf
    tick_until(running, lambda: prepared(running))
    assert not made, "all of it on the library's threads"
    running.end()


def test_says_first_mesh_then_surface(held: Held) -> None:
    running = begin(sphere(), SPACING)
    said = []
    while running.stepper.preparing:
        said.append(running.phase_text())
        held.let_one(running)
    assert said == ["Preparing the mesh", "Preparing the mesh", "Looking at the surface"]
    assert running.left_text(), "what the run itself takes is known from its cost"
    held.free = math.inf
    running.end()


def test_the_curve_is_that_of_a_run_that_waits(held: Held) -> None:
    held.free = math.inf
    running = begin(sphere(), SPACING)
    tick_until(running, lambda: False)
    watched = result_points(running)
    running.end()
    activate(bpy.data.objects["Scan"])
    alone = session.Session(plan_run(bpy.context))
    alone.run()
    assert np.array_equal(watched, result_points(alone))
    alone.end()


@pytest.mark.parametrize("calls", [1, 2, 3])
def test_esc_gives_the_scene_back_as_it_was(held: Held, calls: int) -> None:
    thing = sphere()
    before = scene_as_it_is()
    running = begin(thing, SPACING)
    for _ in range(calls - 1):
        held.let_one(running)
    assert len(held.begun) == calls and running.stepper.preparing
    running.suspend()  # what Esc does
    assert scene_as_it_is() == before
    # Where the last call had ended already there is a flow, which can go on later.
    assert suspended.kept.current is None or calls == 3
    assert running.ended and not running.stepper.preparing
    assert all(one._pointer is None for one in held.begun), "no thread is left"
    assert lasting.why_busy() is None


def test_stop_and_keep_has_nothing_to_keep(held: Held) -> None:
    running = begin(sphere(), SPACING)
    before = len(bpy.data.objects)
    running.stop_wanted = True
    with pytest.raises(DataError, match="Nothing has grown yet"):
        running.tick(bpy.context)
    running.suspend()
    assert len(bpy.data.objects) == before and suspended.kept.current is None


def test_the_mesh_may_be_deleted(held: Held) -> None:
    thing = sphere()
    running = begin(thing, SPACING)
    bpy.data.objects.remove(thing)
    with pytest.raises(DataError, match="deleted"):
        running.tick(bpy.context)
    running.suspend()
    assert all(one._pointer is None for one in held.begun)


def test_another_file_ends_it(held: Held) -> None:
    running = begin(sphere(), SPACING)
    lasting.leave_file()
    assert running.ended and session.current() is None
    assert all(one._pointer is None for one in held.begun)


def test_undo_leaves_it_alone(held: Held) -> None:
    running = begin(sphere(), SPACING)
    lasting.end_undone()
    lasting.end_gone()
    assert running.tick(bpy.context) and session.current() is running
    held.free = math.inf
    tick_until(running, lambda: prepared(running))
    running.end()


def test_nothing_else_may_begin_meanwhile(held: Held) -> None:
    running = begin(sphere(), SPACING)
    assert lasting.why_busy() == "A curve is growing already"
    assert not bpy.ops.meander.run.poll() and not bpy.ops.meander.live.poll()
    assert not bpy.ops.meander.resume.poll()
    running.end()
    assert bpy.ops.meander.run.poll()


def test_nothing_is_measured_meanwhile(held: Held, monkeypatch: pytest.MonkeyPatch) -> None:
    running = begin(sphere(), SPACING)
    thing = running.plan.surface.find()
    monkeypatch.setattr(estimate, "_measured", {})
    assert estimate.shown([thing]) is None and estimate._ordered
    assert estimate.measure_ordered() > 0.0 and not estimate._going.lasts, "later"
    running.end()
    held.free = math.inf
    measure_all()
    assert estimate.shown([thing]) is not None


def measure_all() -> int:
    """Lets the timer of the panel's estimate do all that is ordered; the number of its events."""
    events = 1
    while estimate.measure_ordered() is not None:
        events += 1
        time.sleep(0.01)
    return events


def ordered(monkeypatch: pytest.MonkeyPatch) -> bpy.types.Object:
    """An object of many faces, which a panel shows that has not been measured yet."""
    thing = sphere()
    thing.meander.spacing = SPACING
    monkeypatch.setattr(estimate, "_measured", {})
    estimate._ordered.clear()
    assert estimate.shown([thing]) is None
    return thing


def test_no_window_waits_while_many_faces_are_measured(
    held: Held, monkeypatch: pytest.MonkeyPatch
) -> None:
    thing = ordered(monkeypatch)
    made = at_once(monkeypatch)
    with monkeypatch.context() as at_once_only:
        at_once_only.setattr(estimate, "extent_of", lambda *_: pytest.fail("measured in one go"))
        for _ in range(5):
            assert estimate.measure_ordered() > 0.0 and estimate.shown([thing]) is None
        assert len(held.begun) == 1 and lasting.why_busy() is None
        held.free = math.inf
        assert measure_all() > 1 and len(held.begun) == 2 and not made
    expected = estimate.of_plan(plan_run(bpy.context))
    assert estimate.shown([thing]).points == pytest.approx(expected.points, rel=1e-6)


@pytest.mark.parametrize("end", [lasting.leave_file, lasting.end_all])
def test_what_is_measured_ends_with_the_file(
    held: Held, monkeypatch: pytest.MonkeyPatch, end: Callable[[], None]
) -> None:
    ordered(monkeypatch)
    for _ in range(5):
        estimate.measure_ordered()
    end()
    assert not estimate._going.lasts and all(one._pointer is None for one in held.begun)
    assert estimate.measure_ordered() is None


def test_a_run_ends_what_is_measured_and_it_is_measured_later(
    held: Held, monkeypatch: pytest.MonkeyPatch
) -> None:
    thing = ordered(monkeypatch)
    for _ in range(5):
        estimate.measure_ordered()
    running = begin(thing, SPACING)
    assert estimate.measure_ordered() > 0.0 and not estimate._going.lasts
    running.end()
    held.free = math.inf
    measure_all()
    assert estimate.shown([thing]) is not None


def test_what_changes_while_it_is_measured_is_measured_again(
    held: Held, monkeypatch: pytest.MonkeyPatch
) -> None:
    thing = ordered(monkeypatch)
    estimate.measure_ordered()
    thing.scale = (2.0, 1.0, 1.0)
    bpy.context.view_layer.update()
    held.free = math.inf
    measure_all()
    assert estimate.shown([thing]) is None and estimate._ordered
    bpy.data.objects.remove(thing)
    assert measure_all() == 1


def test_a_wish_is_taken_when_the_run_has_begun(held: Held) -> None:
    thing = sphere()
    thing.meander.live = True
    running = begin(thing, SPACING)
    thing.meander.spacing = 0.4
    for _ in range(3):
        assert running.tick(bpy.context)
    assert running.plan.spacing == pytest.approx(SPACING) and len(held.begun) == 1
    held.free = math.inf
    tick_until(running, lambda: running.plan.spacing > 0.39)
    assert running.stepper.problem.options.radius == pytest.approx(0.2)
    running.end()


def test_a_fault_is_told_at_the_end(held: Held, monkeypatch: pytest.MonkeyPatch) -> None:
    thing = sphere()
    thing.meander.strict = True
    thing.data.vertices[100].co = (np.nan, 0.0, 0.0)
    running = begin(thing, SPACING)
    held.free = math.inf
    tick_until(running, lambda: False)
    with pytest.raises((DataError, core.MeanderError), match="finite|position"):
        running.keep(bpy.context)
    running.end()


def test_what_was_ended_goes_on_without_preparing(held: Held) -> None:
    held.free = math.inf
    running = begin(sphere(), 0.15)
    tick_until(running, lambda: running.latest is not None and running.latest.iterations > 2)
    running.suspend()
    kept = suspended.kept.current
    assert kept is not None
    begun = len(held.begun)
    resumed = session.Session(kept.plan, suspended.taken(plan_run(bpy.context)))
    resumed.start(bpy.context)
    assert not resumed.stepper.preparing and len(held.begun) == begun
    resumed.end()


def test_small_meshes_are_prepared_at_once(
    held: Held, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stepper, "MANY_FACES", 20_000)
    running = begin(sphere(), SPACING)
    assert not running.stepper.preparing and not held.begun
    running.end()


def test_symmetry_and_curvature_are_prepared_in_the_background(
    held: Held, monkeypatch: pytest.MonkeyPatch
) -> None:
    thing = sphere()
    thing.meander.mirror = "X"
    thing.meander.use_density = True
    thing.meander.density_source = "CURVATURE"
    made = at_once(monkeypatch)
    held.free = math.inf
    running = begin(thing, SPACING)
    tick_until(running, lambda: prepared(running))
    assert not made and not running.stepper.failed
    assert len(held.begun) > 4
    running.end()
