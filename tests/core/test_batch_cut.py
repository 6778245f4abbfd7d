# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command's --cut: files of the surface with the curve among its edges."""

from __future__ import annotations

import json
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import fill
from meander.model.files import obj
from sentences import assert_sentence

SPACING = 0.5


@pytest.fixture
def ball(tmp_path: Path) -> Path:
    return geometry.write_obj(tmp_path / "ball.obj", geometry.icosphere(2))


def run(ball: Path, folder: Path, *extra: object) -> int:
    return fill(ball, folder / "curve.obj", "--spacing", SPACING, "--quiet", *extra)


def read_ply(path: Path) -> dict[str, list[dict[str, object]]]:
    """Every element of a binary PLY file, as slowly and plainly as its header says."""
    sizes = {"uchar": "u1", "int": "<i4", "float": "<f4", "double": "<f8"}
    head, data = path.read_bytes().split(b"end_header\n", 1)
    elements: list[tuple[str, int, list[list[str]]]] = []
    for line in head.decode("ascii").splitlines():
        words = line.split()
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    at = 0

    def take(kind: str, count: int) -> list[float]:
        nonlocal at
        values = np.frombuffer(data, sizes[kind], count, at)
        at += values.nbytes
        return values.tolist()

    found: dict[str, list[dict[str, object]]] = {}
    for name, count, properties in elements:
        rows = found[name] = []
        for _ in range(count):
            row: dict[str, object] = {}
            for words in properties:
                if words[0] == "list":
                    row[words[3]] = take(words[2], int(take(words[1], 1)[0]))
                else:
                    row[words[1]] = take(words[0], 1)[0]
            rows.append(row)
    assert at == len(data)
    return found


def test_ply_has_the_fields(ball: Path, tmp_path: Path) -> None:
    cut, report = tmp_path / "cut.ply", tmp_path / "report.json"
    extra = ("--cut", cut, "--cut-detail", 0.1, "--cut-middle-lines", "--report", report)
    assert run(ball, tmp_path, *extra) == 0
    found = read_ply(cut)
    vertices, faces, edges = found["vertex"], found["face"], found["edge"]
    record = json.loads(report.read_text())
    assert record["cut"] == {"vertices": len(vertices), "faces": len(faces), "regions": 2}
    assert record["options"]["cut_detail"] == 0.1
    # The curve is among the edges, and the distance is 0 there and about r between.
    curve = obj.read_obj_curve(tmp_path / "curve.obj")
    points = np.array([[row["x"], row["y"], row["z"]] for row in vertices])
    distance = np.array([row["distance"] for row in vertices])
    on_line = sorted({row["vertex1"] for row in edges})
    assert len(on_line) == len(edges) >= len(curve.points)
    nearest = np.linalg.norm(points[on_line][None] - curve.points[:, None], axis=2).min(axis=1)
    assert nearest.max() < 0.02 * SPACING
    assert (distance[on_line] == 0.0).all() and (np.delete(distance, on_line) > 0.0).all()
    assert 0.4 * SPACING < distance.max() < 0.8 * SPACING
    # Each edge of the curve has a face of either side.
    sides: dict[frozenset, set] = {}
    for row in faces:
        a, b, c = row["vertex_indices"]
        for pair in ((a, b), (b, c), (c, a)):
            sides.setdefault(frozenset(pair), set()).add(row["side"])
        assert len(row["texcoord"]) == 6
    assert all(sides[frozenset((row["vertex1"], row["vertex2"]))] == {-1, 1} for row in edges)
    assert {row["strand"] for row in faces} == {0} and {row["region"] for row in faces} == {0, 1}


def test_obj_has_the_sides_as_materials(ball: Path, tmp_path: Path) -> None:
    cut = tmp_path / "cut.obj"
    assert run(ball, tmp_path, "--cut", cut) == 0
    lines = [line.split() for line in cut.read_text().splitlines()]
    points = np.array([list(map(float, words[1:])) for words in lines if words[0] == "v"])
    assert sum(words[0] == "vt" for words in lines) == 3 * sum(w[0] == "f" for w in lines)
    areas, name = {}, ""
    for words in lines:
        if words[0] == "usemtl":
            name = words[1]
        elif words[0] == "f":
            a, b, c = (points[int(word.split("/")[0]) - 1] for word in words[1:])
            areas[name] = areas.get(name, 0.0) + np.linalg.norm(np.cross(b - a, c - a)) / 2
    whole = geometry.triangle_areas(*geometry.icosphere(2)).sum()
    assert set(areas) == {"side_1", "side_2"}
    assert sum(areas.values()) == pytest.approx(whole, rel=1e-9)
    assert areas["side_1"] == pytest.approx(areas["side_2"], rel=0.2)
    line = next(words[1:] for words in lines if words[0] == "l")
    assert line[0] == line[-1] and len(set(line)) == len(line) - 1


@pytest.mark.parametrize(
    "extra",
    [
        ("--cut", "cut.stl"),
        ("--cut-detail", "0.1"),
        ("--cut-middle-lines",),
        ("--cut", "cut.ply", "--cut-detail", "0"),
        ("--cut", "curve.obj"),
        ("--cut", "missing/cut.ply"),
    ],
)
def test_what_cannot_be_is_refused(
    ball: Path, tmp_path: Path, capsys: pytest.CaptureFixture, extra: tuple[str, ...]
) -> None:
    extra = tuple(
        str(tmp_path / word) if "." in word and word[0] == "c" else word for word in extra
    )
    assert run(ball, tmp_path, *extra) == 2
    error = capsys.readouterr().err.rstrip("\n")
    assert_sentence(error)
    assert "--cut" in error
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ball.obj"]
