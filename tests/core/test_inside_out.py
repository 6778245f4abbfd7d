# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed bodies whose faces show inwards are said and turned, so that a tool stays off them."""

from __future__ import annotations

import csv
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch
from meander.model.geometry.inside_out import inside_out
from sentences import assert_sentence


def turned(mesh: geometry.Mesh) -> geometry.Mesh:
    return geometry.Mesh(mesh.vertices, mesh.faces[:, ::-1])


@pytest.mark.parametrize(
    ("name", "more", "code"),
    [("a.obj", [], 2), ("a.svg", [], 2), ("a.dxf", ["--layout", "top"], 2), ("a.gcode", [], 2)]
    + [("a.xmodel", [], 2), ("a.usda", [], 0), ("a.json", [], 0), ("a.yaml", [], 0)]
    + [("a.gcode", ["--layer-offset", "1"], 0), ("a.obj", ["--cut", "c.obj"], 0)],
)
def test_what_has_no_normals_is_not_turned(
    name: str, more: list, code: int, tmp_path: Path, monkeypatch, capsys
) -> None:
    monkeypatch.chdir(tmp_path)
    mesh = geometry.write_obj(tmp_path / "mesh.obj", geometry.icosphere(1))
    given = ["--input", mesh.name, "--output", name, "--spacing", "0.6", "--iterations", "1"]
    assert batch.main([*given, "--outward", "--quiet", *more]) == code
    if code:
        said = capsys.readouterr().err.strip()
        assert_sentence(said)
        assert "--outward turns normals" in said


def beside(one: geometry.Mesh, other: geometry.Mesh, far: float = 5.0) -> geometry.Mesh:
    return geometry.Mesh(
        np.concatenate([one.vertices, other.vertices + [far, 0.0, 0.0]]),
        np.concatenate([one.faces, other.faces + len(one.vertices)]),
    )


BALL, CUBE, TORUS = geometry.icosphere(2), geometry.cube(), geometry.torus(24, 12)


@pytest.mark.parametrize("far", [0.0, 1e7])
@pytest.mark.parametrize("mesh", [BALL, CUBE, TORUS])
def test_a_body_is_known_wherever_it_is(mesh: geometry.Mesh, far: float) -> None:
    moved = geometry.Mesh(mesh.vertices + far, mesh.faces)
    assert not inside_out(*moved).any()
    assert inside_out(*turned(moved)).all()


def test_each_body_counts_by_itself() -> None:
    both = beside(BALL, turned(CUBE))
    found = inside_out(*both)
    assert not found[: len(BALL.faces)].any() and found[len(BALL.faces) :].all()


def test_what_is_open_or_at_odds_with_itself_has_no_inside() -> None:
    assert not inside_out(*turned(geometry.grid(4))).any()
    assert not inside_out(BALL.vertices, BALL.faces[:, ::-1][1:]).any()
    odd = BALL.faces[:, ::-1].copy()
    odd[3] = odd[3, ::-1]
    assert not inside_out(BALL.vertices, odd).any()


@pytest.mark.parametrize("name", ["ball", "two"])
def test_a_tool_stays_off_a_body_that_is_turned(name: str, tmp_path: Path, capsys) -> None:
    mesh = BALL if name == "ball" else beside(BALL, BALL)
    path = geometry.write_obj(tmp_path / "mesh.obj", turned(mesh))
    given = ["--input", path, "--output", tmp_path / "a.csv", "--spacing", "0.4", "--quiet"]
    given += ["--poses", "--standoff", "0.1"]

    def outside() -> bool:
        with (tmp_path / "a.csv").open() as file:
            rows = [row for row in csv.DictReader(line for line in file if line[0] != "#")]
        places = np.array([[float(row[axis]) for axis in "xyz"] for row in rows])
        middles = [(0.0, 0.0, 0.0), (5.0, 0.0, 0.0)][: 1 + (name == "two")]
        far = np.min([np.linalg.norm(places - middle, axis=1) for middle in middles], axis=0)
        return bool(np.median(far) > np.linalg.norm(BALL.vertices[0]))

    assert batch.main([str(a) for a in given]) == 0
    said = capsys.readouterr().err.strip()
    assert_sentence(said.removeprefix("meander: warning: "))
    assert "inside out" in said and "--outward" in said and not outside()
    assert batch.main([str(a) for a in (*given, "--outward")]) == 0
    assert capsys.readouterr().err == "" and outside()
