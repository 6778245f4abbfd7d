# SPDX-License-Identifier: GPL-3.0-or-later
"""Full starts are counted as they are: what began full, what grows and why."""

from __future__ import annotations

from pathlib import Path

from full_starts import (
    grown_as_a_whole,
    grown_parts,
    is_wrong,
    key_of,
    said,
    starts_of,
    summary,
)
from shapes import SHAPES


def test_a_start_says_what_began_full_and_is_made_once(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr("full_starts.SPACINGS", 2)
    monkeypatch.setattr("full_starts.FIRST_FACES", 1)
    mesh = SHAPES["knot"]()
    rows = list(starts_of("knot", mesh, tmp_path, 1, set()))
    assert [row["side"] for row in rows] == [20, 200]
    for row in rows:
        assert row["full_parts"] == 1 and not grown_parts(row) and not is_wrong(row)
        assert 0.8 < row["filled"] < 1.4 and row["empty"] < 0.01
    known = {key_of(row) for row in rows[:1]}
    assert [row["side"] for row in starts_of("knot", mesh, tmp_path, 1, known)] == [200]


def test_rows_are_counted_by_radius() -> None:
    whole = dict(outcome="limit", full_parts=3, no_room_parts=0, crossing_parts=0, crossings=0)
    rows = [
        whole | {"side": 20.0},
        whole | {"side": 20.0, "full_parts": 0, "no_room_parts": 2, "crossing_parts": 1},
        {"side": 200.0, "outcome": "hang", "model": "saw", "first_face": 0, "filled": 0.0},
    ]
    first, second = summary(rows)
    counts = ("starts", "full_parts", "no_room", "not_laid", "whole", "wrong")
    assert [first[name] for name in counts] == [2, 3, 2, 1, 1, 0]
    assert [second[name] for name in counts] == [1, 0, 0, 0, 0, 1]
    assert grown_parts(rows[1]) == 3 and grown_as_a_whole(rows[1]) and not grown_as_a_whole(rows[0])
    assert said(rows[2]).startswith("saw, root of the area 200 r, first face 0: hang")
