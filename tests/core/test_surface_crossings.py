# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves of few points that cross themselves are counted, as a search of every pair finds them."""

from __future__ import annotations

import csv
import itertools
import json
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import fill
from meander.model.geometry import surface_crossings
from meander.model.geometry.surface_crossings import crossings


def run(mesh: Path, kind: str, *extra: str, spacing: str = "0.15") -> tuple[dict, Path]:
    output, report = mesh.with_name(f"a{kind}"), mesh.with_name("r.json")
    assert fill(mesh, output, "--report", report, "--spacing", spacing, "--quiet", *extra) == 0
    return json.loads(report.read_text())["points"], output


def ways_of(path: Path) -> list[np.ndarray]:
    """The polylines of a table or an OBJ, closed ones with their first point again."""
    if path.suffix == ".obj":
        lines = [line.split() for line in path.read_text().splitlines()]
        places = np.array([line[1:] for line in lines if line[:1] == ["v"]], dtype=float)
        return [places[np.array(line[1:], dtype=int) - 1] for line in lines if line[:1] == ["l"]]
    if path.suffix == ".json":
        strands = json.loads(path.read_text())["strands"]
        return [np.array(strand["places"]) for strand in strands]
    rows = list(csv.DictReader(line for line in path.read_text().splitlines() if line[0] != "#"))
    ways = []
    for _strand, group in itertools.groupby(rows, key=lambda row: row["strand"]):
        points = [[float(row[axis]) for axis in "xyz"] for row in group]
        ways.append(np.array([*points, points[0]]))
    return ways


def crossing_pairs(ways: list[np.ndarray]) -> int:
    """In the plane, every pair of segments, by the intersection of their lines."""
    begin = np.concatenate([way[:-1, :2] for way in ways])
    step = np.concatenate([np.diff(way[:, :2], axis=0) for way in ways])
    count = 0
    for k in range(len(begin)):
        apart = begin[k + 1 :] - begin[k]
        other = step[k + 1 :]
        cross = step[k, 0] * other[:, 1] - step[k, 1] * other[:, 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            s = (apart[:, 0] * other[:, 1] - apart[:, 1] * other[:, 0]) / cross
            t = (apart[:, 0] * step[k, 1] - apart[:, 1] * step[k, 0]) / cross
            inside = (s > 1e-9) & (s < 1 - 1e-9) & (t > 1e-9) & (t < 1 - 1e-9)
        count += int(inside.sum())
    return count


@pytest.mark.parametrize(
    ("kind", "extra"),
    [
        (".csv", ("--chord-tolerance", "0.2")),
        (".csv", ("--chord-tolerance", "0.3")),
        (".json", ("--poses", "--resample-step", "1.2")),
    ],
)
def test_on_a_sheet_as_a_search_of_every_pair_finds_them(tmp_path, capsys, kind, extra) -> None:
    sheet = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(20, 2.0))
    points, path = run(sheet, kind, *extra)
    assert points["crossings"] == crossing_pairs(ways_of(path)) > 0
    said = capsys.readouterr().err
    assert "the curve crosses itself" in said and "smaller tolerance or step" in said
    assert len(points["crossing_places"]) == min(points["crossings"], 20)


@pytest.mark.parametrize("mesh", [geometry.grid(20, 2.0), geometry.icosphere(3), geometry.cube()])
@pytest.mark.parametrize(
    ("kind", "extra"), [(".csv", ()), (".json", ("--poses",)), (".obj", ("--light", "0.01"))]
)
def test_what_is_near_the_curve_does_not_cross(tmp_path, capsys, mesh, kind, extra) -> None:
    path = geometry.write_obj(tmp_path / "mesh.obj", mesh)
    points, path = run(path, kind, *extra, spacing="0.25")
    assert points["crossings"] == 0 and "crosses" not in capsys.readouterr().err
    if np.ptp(mesh.vertices[:, 2]) == 0.0:
        assert crossing_pairs(ways_of(path)) == 0


def test_all_points_of_an_obj_are_not_looked_at(tmp_path) -> None:
    points, _path = run(geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(20, 2.0)), ".obj")
    assert points["crossings"] is None


def test_all_points_of_a_table_are_not_searched(tmp_path, monkeypatch) -> None:
    # A million take half a minute and a gigabyte.
    searched = []
    monkeypatch.setattr(
        surface_crossings, "crossings", lambda *_given: (searched.append(1), np.empty((0, 3)))[1]
    )
    sheet = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(20, 2.0))
    for extra in ((), ("--poses",)):
        points, _path = run(sheet, ".npz", *extra)
        assert points["crossings"] == 0 and not searched
    for extra in (("--chord-tolerance", "0.2"), ("--poses", "--standoff", "0.1")):
        run(sheet, ".npz", *extra)
        assert searched.pop()


def test_on_a_ball(tmp_path) -> None:
    ball = geometry.write_obj(tmp_path / "ball.obj", geometry.icosphere(3))
    points, _path = run(ball, ".csv", "--resample-step", "0.8")
    assert points["crossings"] > 0
    for place in points["crossing_places"]:
        assert 0.85 < np.linalg.norm(place) <= 1.0001  # on chords, below the ball
    points, _path = run(ball, ".csv", "--poses")
    assert points["crossings"] == 0


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_by_hand(scale: float) -> None:
    up, ways = np.tile([0.0, 0.0, 1.0], (2, 1)), scale * np.array(
        [[(-1, 0, 0), (1, 0, 0)], [(0, -1, 0.01), (0, 1, 0.01)]]
    )  # fmt: skip
    found = crossings(ways, [up, up], [False, False], scale)
    assert found == pytest.approx(scale * np.zeros((1, 3)), abs=1e-9 * scale)
    # On the other side of a thin sheet, on another sheet, and end to side there is none.
    assert not len(crossings(ways, [up, -up], [False, False], scale))
    far = ways + scale * np.array([0, 0, 0.7]) * np.array([[[0]], [[1]]])
    assert not len(crossings(far, [up, up], [False, False], scale))
    touching = ways.copy()
    touching[1, 0] = 0.0
    assert not len(crossings(touching, [up, up], [False, False], scale))
    assert not len(crossings([], [], [], scale))
