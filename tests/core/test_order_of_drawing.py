# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a tool begins, from where it goes on, and which way it follows the line."""

from __future__ import annotations

import json
import re
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import fill
from meander.model.toolpaths import order
from meander.model.toolpaths.toolpath import Strand, strand_of
from sentences import assert_sentence


def _strand(points: list, closed: bool = False) -> Strand:
    places = np.column_stack([np.array(points, dtype=float), np.zeros(len(points))])
    return strand_of(places, np.tile([0.0, 0.0, 1.0], (len(points), 1)), closed)


SQUARE = _strand([(0, 0), (4, 0), (4, 4), (0, 4)], closed=True)
LINE = _strand([(10, 0), (10, 2), (10, 8)])


def _consistent(strand: Strand) -> None:
    again = strand_of(strand.points, strand.normals, strand.closed)
    assert strand.length == pytest.approx(again.length)
    assert strand.arc_lengths == pytest.approx(again.arc_lengths)


def test_a_closed_strand_begins_anywhere():
    first, second = order.begun_at([LINE, SQUARE], (5.0, 1.0))
    assert second is LINE
    assert first.points[0].tolist() == [4, 1, 0] and first.closed
    assert first.length == SQUARE.length
    assert {tuple(p) for p in SQUARE.points} == {tuple(p) for p in first.points[1:]}
    _consistent(first)


def test_an_open_strand_begins_at_its_nearer_end():
    first, _second = order.begun_at([SQUARE, LINE], (10.0, 9.0))
    assert first.points[:, 1].tolist() == [8, 2, 0]
    _consistent(first)
    # The middle of an open strand is no place to begin.
    assert order.begun_at([SQUARE, LINE], (12.0, 5.0))[0].points[0].tolist() == [10, 8, 0]


def test_going_on_leaves_out_what_is_drawn():
    rest = order.gone_on([SQUARE, LINE], (4.2, 3.0))
    assert rest[0].points.tolist() == [[4, 3, 0], [4, 4, 0], [0, 4, 0], [0, 0, 0]]
    assert not rest[0].closed and rest[1] is LINE
    _consistent(rest[0])
    assert order.gone_on([SQUARE, LINE], (10.0, 9.0)) == []
    assert order.gone_on([SQUARE, LINE], (0.0, -1.0)) == [SQUARE, LINE]


def test_backwards_is_the_same_way():
    back = order.backwards([SQUARE, LINE])
    assert back[0].points[:, 1].tolist() == [8, 2, 0]
    assert back[1].points.tolist() == [[0, 0, 0], [0, 4, 0], [4, 4, 0], [4, 0, 0]]
    for strand in back:
        _consistent(strand)
    again = order.backwards(back)
    for strand, other in zip(again, [SQUARE, LINE], strict=True):
        assert np.array_equal(strand.points, other.points)
        assert np.allclose(strand.tangents, other.tangents)


@pytest.fixture(scope="module")
def mesh(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return geometry.write_obj(tmp_path_factory.mktemp("mesh") / "mesh.obj", geometry.grid(6))


def _run(mesh: Path, output: Path, *extra: object) -> int:
    return fill(mesh, output, "--spacing", "0.2", "--iterations", "5", "--quiet", *extra)


def _moves(path: Path) -> np.ndarray:
    found = re.findall(r"^G[01] X(\S+) Y(\S+)", path.read_text(), re.MULTILINE)
    return np.array(found, dtype=float)


def _points(path: Path) -> np.ndarray:
    return np.array(json.loads(path.read_text())["strands"][0]["points"])


def test_what_is_left_of_a_drawing_lies_where_it_lay(mesh: Path, tmp_path: Path):
    drawn = ("--layout", "top", "--tool", "laser")
    assert _run(mesh, tmp_path / "all.nc", *drawn) == 0
    whole = _moves(tmp_path / "all.nc")
    x, y = whole[len(whole) // 2]
    at = ("--go-on-from", x, y)
    assert _run(mesh, tmp_path / "rest.nc", *drawn, *at) == 0
    rest = _moves(tmp_path / "rest.nc")
    assert np.abs(rest[0] - (x, y)).max() < 1e-3
    assert np.abs(rest[1:] - whole[-len(rest) + 1 :]).max() < 1e-3
    assert _run(mesh, tmp_path / "back.nc", *drawn, *at, "--backwards") == 0
    assert np.abs(_moves(tmp_path / "back.nc") - rest[::-1]).max() < 1e-3
    assert _run(mesh, tmp_path / "begun.nc", *drawn, "--begin-at", x, y) == 0
    begun = _moves(tmp_path / "begun.nc")
    assert np.abs(begun[0] - (x, y)).max() < 1e-3
    assert np.abs(begun[-1] - (x, y)).max() < 1e-3  # the line is closed


def test_tables_of_points_have_an_order_too(mesh: Path, tmp_path: Path):
    assert _run(mesh, tmp_path / "all.json") == 0
    whole = _points(tmp_path / "all.json")
    place = whole[len(whole) // 3].tolist()
    assert _run(mesh, tmp_path / "rest.json", "--go-on-from", *place) == 0
    rest = _points(tmp_path / "rest.json")
    assert np.allclose(rest[:-1], whole[len(whole) // 3 :])  # and back to where it began
    assert np.allclose(rest[-1], whole[0])
    assert _run(mesh, tmp_path / "begun.json", "--begin-at", *place, "--part-length", 0.5) == 0
    assert np.allclose(_points(tmp_path / "begun.json")[0], place)
    assert _run(mesh, tmp_path / "back.json", "--backwards") == 0
    assert np.allclose(_points(tmp_path / "back.json"), np.roll(whole[::-1], 1, axis=0))


STROKE = ("--from", 0.1, 0.5, 0, "--to", 0.9, 0.5, 0)


@pytest.mark.parametrize(
    ("name", "extra", "words"),
    [
        ("a.csv", (*STROKE, "--go-on-from", 0.9, 0.5, 0), "nothing is left"),
        ("a.obj", ("--backwards",), "does nothing"),
        ("a.obj", ("--begin-at", 0, 0, 0), "does nothing"),
        ("a.svg", ("--begin-at", 0, 0, 0), "two numbers"),
        ("a.csv", ("--go-on-from", 0, 0), "three numbers"),
        ("a.nc", ("--go-on-from", 0, 0), "three numbers"),
    ],
)
def test_what_has_no_order_is_said(
    mesh: Path, tmp_path: Path, capsys: pytest.CaptureFixture, name: str, extra: tuple, words: str
):
    assert _run(mesh, tmp_path / name, *extra) == 2
    said = capsys.readouterr().err
    assert words in said
    assert_sentence(said.removeprefix("meander: ").strip())
