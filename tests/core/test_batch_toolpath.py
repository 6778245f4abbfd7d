# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command's tool paths: CSV and JSON instead of OBJ."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import fill
from meander.model.files import meshes
from sentences import assert_sentence


@pytest.fixture
def square(tmp_path: Path) -> Path:
    return geometry.write_obj(tmp_path / "square.obj", geometry.grid(6))


def _run(square: Path, name: str, *extra: str) -> int:
    return fill(square, square.parent / name, "--spacing", "0.25", "--quiet", *extra)


def test_step_and_tolerance_give_the_same_curve(square: Path) -> None:
    report = square.parent / "report.json"
    assert _run(square, "all.json", "--report", str(report)) == 0
    assert _run(square, "step.json", "--resample-step", "0.05") == 0
    assert _run(square, "chord.csv", "--chord-tolerance", "0.002") == 0
    whole = json.loads((square.parent / "all.json").read_text())["strands"]
    stepped = json.loads((square.parent / "step.json").read_text())["strands"]
    with (square.parent / "chord.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert json.loads(report.read_text())["length"] == pytest.approx(
        sum(strand["length"] for strand in whole)
    )
    assert [strand["closed"] for strand in stepped] == [strand["closed"] for strand in whole]
    steps = np.diff(stepped[0]["arc_lengths"])
    assert np.allclose(steps, steps[0])
    assert steps[0] <= 0.05
    assert 3 <= len(rows) < sum(len(strand["points"]) for strand in whole)
    assert np.allclose(np.abs([float(row["nz"]) for row in rows]), 1.0)
    assert all(0.01 < float(row["r_plus"]) < 0.5 for row in rows)
    vertices, faces = meshes.read_mesh(square)
    for row in rows:
        corners = vertices[faces[int(row["face"])]]
        rebuilt = np.array([float(row[f"w{corner}"]) for corner in range(3)]) @ corners
        assert np.allclose(rebuilt, [float(row[axis]) for axis in "xyz"], atol=1e-9)
    assert {row["strand"] for row in rows} == {str(at) for at in range(len(whole))}


def test_a_round_line_is_written_in_place_of_the_curve(square: Path) -> None:
    report = square.parent / "report.json"
    assert _run(square, "all.json") == 0
    assert _run(square, "round.json", "--round", "0.12", "--report", str(report)) == 0
    (curve,) = json.loads((square.parent / "all.json").read_text())["strands"]
    (line,) = json.loads((square.parent / "round.json").read_text())["strands"]
    assert line["closed"] == curve["closed"]
    begin = np.array(curve["points"])
    away = geometry.distance_to_pieces(np.array(line["points"]), begin, np.roll(begin, -1, axis=0))
    assert 0.01 * 0.25 < away.max() < 0.13 * 0.25
    figures = json.loads(report.read_text())
    assert figures["length"] == pytest.approx(line["length"])
    assert figures["options"]["round"] == 0.12
    assert line["length"] < curve["length"]


def test_bad_combinations_are_refused(square: Path, capsys: pytest.CaptureFixture) -> None:
    for name, extra, words in (
        ("out.obj", ("--resample-step", "0.1"), ".csv, .json or .svg"),
        ("out.csv", ("--resample-step", "0.1", "--chord-tolerance", "1"), "choose one"),
        ("out.csv", ("--resample-step", "0"), "greater than 0"),
        ("out.csv", ("--resample-step", "1e-12"), "longer one"),
        ("out.csv", ("--round", "0.6"), "choose from 0 to 0.5"),
        ("out.csv", ("--points", "mesh"), ".csv, .json and .npz have the same"),
        ("out.txt", (), ".pixelblaze.json or .yaml"),
    ):
        (square.parent / name).write_text("earlier")
        assert _run(square, name, *extra) == 2
        sentence = capsys.readouterr().err.rstrip("\n")
        assert_sentence(sentence)
        assert words in sentence
        assert (square.parent / name).read_text() == "earlier"
