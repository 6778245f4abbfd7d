# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables say what the rows say."""

from __future__ import annotations

import json
import sys
from typing import Any

import pytest
import summary


def row(**changes: Any) -> dict[str, Any]:
    whole = dict(model="cube", factor=1.0, preset="even", measure="geodesic", seed=1, threads=1)
    whole |= dict(most_iterations=0, outcome="converged", reason="", iterations=100, checked=101)
    whole |= dict(nodes=500, node_iterations=40_000.0, crossings=0, faults=0, creating=0.1)
    whole |= dict(flowing=0.4, radius=0.05, length=10.0)  # on an area of 1, which that fills
    return whole | changes


def test_outcomes_are_counted() -> None:
    rows = [row(), row(seed=2), row(factor=3.0, outcome="crash", reason="SIGSEGV")]
    lines = summary.by(rows, "radius", lambda row: row["factor"]).splitlines()
    assert lines[2] == "| 1.0 | 2 | 2 | 0 | 0 | 0 | 0 | 0 | 202 | 0 | 0 |"
    assert lines[3] == "| 3.0 | 1 | 0 | 0 | 0 | 0 | 0 | 1 | 101 | 0 | 0 |"


def test_what_fails_is_said() -> None:
    assert summary.failures([row()]) == "No run failed."
    said = summary.failures([row(), row(faults=2, first_fault="iteration 3: crossing: here")])
    assert said == "* cube, 1 r, even, geodesic, seed 1: converged  iteration 3: crossing: here"


def test_refusals_are_put_together() -> None:
    refused = [row(outcome="refused", reason=f"Face {k} has no area.") for k in (3, 17)]
    assert summary.refusals(refused).endswith("| 2 | Face … has no area. |")


def test_slow_runs_are_measured_against_their_like() -> None:
    rows = [row(seed=k) for k in range(9)] + [row(flowing=4.0), row(preset="finest", flowing=40.0)]
    relative = summary.relative_costs(rows)
    assert relative[9] == pytest.approx(10) and relative[10] == 1
    assert summary.cost(row(node_iterations=1000.0)) is None, "too few nodes to tell"
    assert "1 of 11 runs take more than 4 times" in summary.tables(rows)


def test_runs_that_leave_half_of_the_surface_empty_are_said() -> None:
    assert summary.filled(row()) == pytest.approx(1)
    assert summary.filled(row(factor=0.5, radius=0.025)) == pytest.approx(0.5)
    empty = row(model="a_cube", length=4.0, outcome="stalled")
    excused = [dict(preset="paper"), dict(measure="euclidean"), dict(factor=3.0, radius=0.15)]
    sparse, ought = summary.half_empty([row(), empty, *(empty | other for other in excused)])
    assert sparse == [empty] and ought == 2
    assert "1 leave more than half of it empty (on a cube)." in summary.tables([row(), empty])


def test_rows_are_printed_by_radius(tmp_path, monkeypatch, capsys) -> None:
    rows = tmp_path / "rows.jsonl"
    rows.write_text("".join(json.dumps(one) + "\n" for one in (row(), row(factor=3.0), row())))
    monkeypatch.setattr(sys, "argv", ["summary.py", str(rows), "--rows"])
    assert summary.main() == 0
    printed = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [(one["radius"], one["runs"], one["checked"]) for one in printed] == [
        (1.0, 2, 202), (3.0, 1, 101),
    ]
