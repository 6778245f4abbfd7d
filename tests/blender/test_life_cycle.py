# SPDX-License-Identifier: GPL-3.0-or-later
"""What lives between events ends with the file and with the add-on, in whatever state they are."""

from __future__ import annotations

from collections.abc import Callable

import bpy
import meander
import pytest
from meander.run import estimate, gaps, lasting, live, motion, notes, seeds, session, suspended
from meander.ui import drawing, events
from scenes import activate, circle_points, fill, grid, poly_curve, sphere
from watched_runs import begin, tick_until


def handlers() -> dict[str, int]:
    """How many handlers each event of Blender's has."""
    lists = {name: getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)}
    return {name: len(value) for name, value in lists.items() if isinstance(value, list)}


def test_many_times_registered_leaves_no_handler_behind():
    registered = handlers()
    meander.unregister()
    try:
        assert not hasattr(bpy.types.Object, "meander")
        bare = handlers()
        ours = {name: registered[name] - bare[name] for name in bare}
        assert {name: count for name, count in ours.items() if count} == {
            event: len(functions) for event, functions in events._CALLED.items()
        }
        for _ in range(10):
            meander.register()
            meander.unregister()
        assert handlers() == bare
    finally:
        meander.register()
    assert handlers() == registered


def growing() -> None:
    running = begin(sphere(), 0.05)
    tick_until(running, lambda: running.shown_points > 0)
    assert session.current() is running


def ended() -> None:
    growing()
    session.current().suspend()
    assert suspended.kept.current is not None


def finished() -> None:
    fill(sphere(), 0.5, iteration_limit=20, live=True)
    assert live.finished.current is not None


def previewed() -> None:
    surface = grid(8)
    surface.meander.seed = poly_curve("Seed", [circle_points(0.4, 0.0)], True)
    activate(surface)
    assert bpy.ops.meander.preview_seed() == {"FINISHED"}
    assert seeds.preview.current is not None


def marked() -> None:
    gaps.show(fill(sphere(), 0.3, iteration_limit=3))
    assert gaps.marks.current is not None


def drawn() -> None:
    activate(grid(8))
    assert bpy.ops.meander.draw_seed() == {"FINISHED"}
    assert drawing.drawn.current is not None


def following() -> None:
    result = fill(sphere(), 0.5, iteration_limit=20)
    result.meander.follow = True
    bpy.context.scene.frame_set(2)
    assert [name for _, name in motion._followers] == [result.name_full]


def noted() -> None:
    surface = grid(8)
    notes.keep(surface, "No")
    estimate.measure(surface)
    assert notes.of(surface) and estimate._measured


STATES = (growing, ended, finished, previewed, marked, drawn, following, noted)


def nothing_lasts() -> None:
    assert [one for one in lasting._all if one.lasts] == []


@pytest.mark.parametrize("state", STATES)
def test_a_file_can_be_opened_in_every_state(state: Callable[[], None], windowed, tmp_path):
    path = str(tmp_path / "kept.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    before = handlers()
    state()
    bpy.ops.wm.open_mainfile(filepath=path)
    nothing_lasts()
    assert handlers() == before
    fill(sphere(), 0.5, iteration_limit=5)


@pytest.mark.parametrize("state", STATES)
def test_the_add_on_can_go_in_every_state(state: Callable[[], None], windowed):
    state()
    meander.unregister()
    try:
        nothing_lasts()
        assert not any(map(bpy.app.timers.is_registered, events._TIMERS))
    finally:
        meander.register()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    fill(sphere(), 0.5, iteration_limit=5)
