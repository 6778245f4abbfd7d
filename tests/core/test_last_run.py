# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user reads while a run goes on, and of what came of it."""

from __future__ import annotations

import time

import numpy as np
import pytest
from flows import flow_on
from geometry import icosphere
from meander import core
from meander.model import last_run
from meander.model.estimate import Remaining, in_words, told


def test_a_roughness_that_changes_nothing_is_not_told():
    """Suzanne's, at an automatic spacing."""
    assert last_run.roughness(0.0008, 1.000035) == ""
    assert "shortens lengths by 5 %" in last_run.roughness(0.4, 1.0526)
    assert last_run.roughness(0.0, 1.0) == ""


def test_one_line_is_called_so():
    assert last_run.lines(1, 1) == "One closed line"
    assert last_run.lines(1, 0) == "One open line"
    assert last_run.lines(3, 2) == "3 lines"
    assert last_run.lines(1, 1, 1) == "One closed line, 1 guide"
    assert last_run.lines(1, 0, 2) == "One open line, 2 guides"


def test_only_what_is_wholly_even_is_100_per_cent():
    assert last_run.evenness(0.9996) == "99 %"
    assert last_run.evenness(1.0) == "100 %"
    assert last_run.evenness(0.947) == "95 %"


def test_gaps_are_said_where_there_are_any():
    assert last_run.gaps(0, 0.0) == last_run.gaps(-1, 0.0) == ""
    assert last_run.gaps(1, 1.62) == "1 gap 1.6 spacings wide"
    assert last_run.gaps(63, 14.93) == "63 gaps up to 14.9 spacings wide"


def test_what_is_left_of_a_steady_run():
    remaining = Remaining()
    assert remaining.seconds() is None
    for k in range(41):
        remaining.note(100.0 + k, k / 50)
    assert remaining.seconds() == pytest.approx(10.0)
    # It goes on after a pause; the pause counts nothing.
    remaining = Remaining()
    remaining.note(1000.0, 0.8)
    assert remaining.seconds() is None
    remaining.note(1002.0, 0.9)
    assert remaining.seconds() == pytest.approx(2.0)
    # There is more to do than before: what went before counts no more.
    remaining.note(1003.0, 0.2)
    assert remaining.seconds() is None
    remaining.note(1007.0, 0.6)
    assert remaining.seconds() == pytest.approx(4.0)


def test_the_words_of_what_is_left():
    assert told("growth", 12.3) == "Growing, 12 s left"
    assert told("polish", 0.01) == "Evening out, 1 s left"
    assert told("none", None) == "Preparing"
    assert (in_words(200.0), in_words(7200.0)) == ("3 min", "2 h")


def test_evenness_is_counted_over_nodes_and_phases_come_in_order():
    vertices, faces = icosphere(3)
    context, phases = core.Context(), []
    assert context.phase == "none"
    flow = flow_on((vertices, faces), radius=0.1)
    flow.start(context)
    while flow.running:
        phases.append(context.phase)
        time.sleep(0.001)
    flow.wait()
    order = [phase for k, phase in enumerate(phases) if k == 0 or phase != phases[k - 1]]
    assert order == [phase for phase in core.PHASES if phase in order]
    assert "hairpin_removal" in order
    figures = flow.statistics()
    spacing = 2.0 * flow.nodes().radii
    even = np.abs(spacing / figures["spacing_target"] - 1.0) <= 0.2
    assert figures["evenness"] == pytest.approx(even.mean())
    assert 0.85 < figures["evenness"] <= 1.0
    context.reset()
    assert context.phase == "none"
