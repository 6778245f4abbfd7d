# SPDX-License-Identifier: GPL-3.0-or-later
"""What is told of a curve of many nodes is found on a thread of the library's: no window hangs."""

from __future__ import annotations

import time

import bpy
import pytest
from meander import core
from meander.run import search
from scenes import sphere
from watched_runs import begin

# What a flow finds while its caller waits.
WAITED_FOR = ("statistics", "gaps", "point_data", "rounded", "polylines", "guides", "found")


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, bool]]:
    """What a flow has been asked for, and whether its thread was going then."""
    calls: list[tuple[str, bool]] = []

    def noting(name: str):
        whole = getattr(core.Flow, name)
        return lambda flow, *given: (calls.append((name, flow.running)), whole(flow, *given))[1]

    for name in (*WAITED_FOR, "start_finding"):
        monkeypatch.setattr(core.Flow, name, noting(name))
    return calls


def tick_to_the_end(running) -> None:
    end = time.monotonic() + 60.0
    while running.tick(bpy.context):
        assert time.monotonic() < end
        time.sleep(0.01)


@pytest.mark.parametrize("many", ["MANY_NODES", "MANY_FACES", ""])
def test_nobody_waits_for_what_is_told_of_many(windowed, asked, monkeypatch, many):
    for name in ("MANY_NODES", "MANY_FACES"):
        monkeypatch.setattr(search, name, 1 if name == many else 10**9)
    running = begin(sphere(), 0.3)
    running.stepper._nodes = 100  # as a copy says, which a short run may not have made
    tick_to_the_end(running)
    assert asked == ([("start_finding", False)] if many else [])
    assert running.stepper.search.begun == bool(many)
    result, figures = running.keep(bpy.context)
    running.end()
    assert [name for name, _going in asked] == ["start_finding", "found"], "all at once, and once"
    if many:
        assert asked[1] == ("found", False), "it had ended before it was waited for"
    assert figures["nodes"] > 100 and len(result.data.splines[0].points) > 100
    assert result.meander.figures.gap_count >= 0


def test_it_says_how_far_it_is(windowed, monkeypatch):
    monkeypatch.setattr(search, "MANY_NODES", 1)
    running = begin(sphere(), 0.3)
    running.stepper._nodes = 100
    tick_to_the_end(running)
    assert running.progress_text() == "Measuring the curve, 100%"
    assert running.phase_text() == "Measuring the curve" and running.left_text() == ""
    running.end()
    assert not running.stepper.search.begun, "taken back"


def test_a_run_that_goes_on_is_told_of_anew(windowed, asked, monkeypatch):
    monkeypatch.setattr(search, "MANY_NODES", 1)
    running = begin(sphere(), 0.3)
    running.stepper._nodes = 100
    tick_to_the_end(running)
    running.stepper.start()
    assert not running.stepper.search.begun
    asked.clear()
    running._is_over = False
    tick_to_the_end(running)
    running.keep(bpy.context)
    running.end()
    assert [name for name, _going in asked] == ["start_finding", "found"]


def test_one_that_is_stopped_by_hand_has_no_gaps(windowed, asked, monkeypatch):
    monkeypatch.setattr(search, "MANY_NODES", 1)
    running = begin(sphere(), 0.1)
    running.stepper._nodes = 100
    running.stop_wanted = True
    tick_to_the_end(running)
    result, _figures = running.keep(bpy.context)
    running.end()
    assert result.meander.figures.gap_count == -1
    assert result.meander.figures.nodes > 0
