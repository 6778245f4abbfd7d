# SPDX-License-Identifier: GPL-3.0-or-later
"""What is told of a curve of many nodes is found at several events, so that no window hangs."""

from __future__ import annotations

import time

import bpy
import pytest
from meander import core
from meander.run import stepper
from scenes import sphere
from watched_runs import begin

COSTLY = ("statistics", "gaps", "point_data")


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What a flow has been asked for that costs about an iteration."""
    names: list[str] = []

    def noting(name: str):
        whole = getattr(core.Flow, name)
        return lambda flow, *given: (names.append(name), whole(flow, *given))[1]

    for name in COSTLY:
        monkeypatch.setattr(core.Flow, name, noting(name))
    return names


def ticks_to_the_end(running, asked: list[str]) -> list[int]:
    """How much was asked for at each event."""
    counts, end = [], time.monotonic() + 60.0
    more = True
    while more:
        assert time.monotonic() < end
        before = len(asked)
        more = running.tick(bpy.context)
        counts.append(len(asked) - before)
        time.sleep(0.01)
    return counts


@pytest.mark.parametrize("many", [True, False])
def test_what_is_told_comes_in_pieces(windowed, asked, monkeypatch, many):
    monkeypatch.setattr(stepper, "MANY_NODES", 1 if many else 10**9)
    running = begin(sphere(), 0.3)
    running.stepper._nodes = 100  # as a copy says, which a short run may not have made
    counts = ticks_to_the_end(running, asked)
    assert max(counts) == (1 if many else 0)
    before = len(asked)
    result, figures = running.keep(bpy.context)
    running.end()
    assert sorted(asked) == sorted(COSTLY), "each once"
    assert len(asked) - before == (0 if many else 3)
    assert figures["nodes"] > 100 and len(result.data.splines[0].points) > 100


def test_a_run_that_goes_on_is_told_of_anew(windowed, asked, monkeypatch):
    monkeypatch.setattr(stepper, "MANY_NODES", 1)
    running = begin(sphere(), 0.3)
    running.stepper._nodes = 100
    ticks_to_the_end(running, asked)
    running.stepper.start()
    asked.clear()
    running._is_over = False
    ticks_to_the_end(running, asked)
    running.keep(bpy.context)
    running.end()
    assert sorted(asked) == sorted(COSTLY)
