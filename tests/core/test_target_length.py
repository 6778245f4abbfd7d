# SPDX-License-Identifier: GPL-3.0-or-later
"""A length that is asked for: the spacing is found at which the curve has it."""

from __future__ import annotations

import json
import re
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import fill
from meander import batch
from meander.cli import target_length
from meander.cli.target_length import CLOSE, Search, tried
from meander.cli.values import BadInput


@pytest.fixture
def ball(tmp_path: Path) -> Path:
    return geometry.write_obj(tmp_path / "ball.obj", geometry.icosphere(3))


def run(mesh: Path, *extra: str) -> int:
    report = mesh.with_name("r.json")
    return fill(mesh, mesh.with_name("a.obj"), "--quiet", "--report", report, *extra)


@pytest.mark.parametrize("length", ["30", "57.5"])
def test_the_curve_is_as_long_as_asked_for(ball: Path, length: str) -> None:
    assert run(ball, "--target-length", length) == 0
    report = json.loads(ball.with_name("r.json").read_text())
    assert report["length"] == pytest.approx(float(length), rel=2 * CLOSE)
    assert report["options"]["target_length"] == float(length)
    # What was found is the spacing of a run without it, to the last bit.
    spacing = report["options"]["spacing"]
    assert run(ball, "--spacing", repr(spacing)) == 0
    assert json.loads(ball.with_name("r.json").read_text())["length"] == report["length"]


def test_coarse_runs_come_first_and_mostly_one_whole_run(ball: Path, capsys) -> None:
    """Counted by the lines that say what each run came to."""
    whole = 0
    for length in ("20", "35", "60"):
        report = ball.with_name("r.json")
        given = ["--input", ball, "--output", ball.with_name("a.obj"), "--report", report]
        assert batch.main([str(a) for a in (*given, "--target-length", length)]) == 0
        said = capsys.readouterr().out
        assert 1 <= len(re.findall("the curve is about", said)) <= 3
        runs = re.findall(r"at a spacing of (\S+) the curve is (\S+) long", said)
        assert 1 <= len(runs) <= 4
        whole += len(runs)
        # One of them is the one that is written: it is not made again.
        written = json.loads(report.read_text())["length"]
        assert any(float(length) == pytest.approx(written, 1e-5) for _spacing, length in runs)
        assert said.count(" iterations and ") == 1
    assert whole <= 6


# Lines that differ from what has grown: options, and a mesh.
WRITTEN = {
    "bridges": ("two_spheres", ("--bridge",)),
    "bridges between many": ("five", ("--bridge",)),
    "light": ("two_spheres", ("--light", "0.25")),
    "light, with bridges": ("two_spheres", ("--light", "0.1", "--bridge")),
    "few points": ("two_spheres", ("--point-limit", "200", "--bridge")),
    "a guide that is left out": ("sheet", ("--guides", "guide.obj", "--leave-out-guides")),
    "an outline, with a bridge": ("sheet", ("--outline", "--bridge")),
}
LENGTHS = {"two_spheres": "40", "five": "200", "sheet": "12"}


def five() -> geometry.Mesh:
    ball = geometry.icosphere(2)
    faces = [ball.faces + k * len(ball.vertices) for k in range(5)]
    return geometry.Mesh(
        np.concatenate([ball.vertices + [2.5 * k, 0.0, 0.0] for k in range(5)]),
        np.concatenate(faces),
    )


@pytest.mark.parametrize("title", WRITTEN)
def test_the_length_is_that_of_the_written_line(title: str, tmp_path: Path, capsys) -> None:
    name, words = WRITTEN[title]
    mesh = {"five": five, "sheet": lambda: geometry.grid(8)}.get(name, geometry.two_spheres)()
    path = geometry.write_obj(tmp_path / "mesh.obj", mesh)
    (tmp_path / "guide.obj").write_text("v 0.2 0.3 0\nv 0.8 0.4 0\nl 1 2\n")
    report = tmp_path / "r.json"
    given = ["--input", path, "--output", tmp_path / "a.obj", "--report", report]
    words = [str(tmp_path / word) if word == "guide.obj" else word for word in words]
    given += ["--target-length", LENGTHS[name], *words]
    assert batch.main([str(a) for a in given]) == 0
    points, length = [], 0.0
    for line in (tmp_path / "a.obj").read_text().splitlines():
        kind, *numbers = line.split()
        if kind == "v":
            points.append([float(number) for number in numbers])
        elif kind == "l":
            way = np.array(points)[[int(number) - 1 for number in numbers]]
            length += float(np.linalg.norm(np.diff(way, axis=0), axis=1).sum())
    assert json.loads(report.read_text())["length"] == pytest.approx(length, rel=1e-9)
    assert length == pytest.approx(float(LENGTHS[name]), rel=0.05)
    said = capsys.readouterr().out
    assert f"length {length:.6g}," in said


@pytest.mark.parametrize("power", [-0.8, -1.0, -1.3])
def test_the_search_needs_few_trials(power: float) -> None:
    trials = tried(lambda spacing: 12.0 * spacing**power, 3.0, 100.0, 0.005, 6)
    spacing, length = trials[-1]
    assert length == pytest.approx(100.0, rel=0.005) and length == 12.0 * spacing**power
    assert len(trials) <= 4


def test_of_whole_runs_the_nearest_stays() -> None:
    """Lengths that jump: the third run is the last, and no run is made again."""
    search = Search(100.0)
    spacing, nearest = 1.0, []
    for length in (97.0, 102.0, 96.0):
        nearest.append(search.is_nearest(spacing, length))
        spacing = search.following
    assert spacing is None and nearest == [True, True, False]
    search = Search(100.0)
    for length in (50.0, 200.0):
        search.is_nearest(1.0, length)
    with pytest.raises(BadInput, match="no spacing gives a length of 100"):
        search.is_nearest(1.0, 60.0)


def test_the_nearest_of_the_whole_runs_is_written(ball: Path, monkeypatch, capsys) -> None:
    """One that is not the last, with its own spacing."""
    monkeypatch.setattr(target_length, "CLOSE", 0.0)
    given = ["--input", ball, "--output", ball.with_name("a.obj"), "--target-length", "20"]
    places = []
    for unreachable in ("20", "25", "30"):
        given[-1] = unreachable
        report = ball.with_name("r.json")
        assert batch.main([str(a) for a in (*given, "--report", report)]) == 0
        said = capsys.readouterr().out
        found = re.findall(r"at a spacing of (\S+) the curve is (\S+) long", said)
        runs = [(float(spacing), float(length)) for spacing, length in found]
        assert len(runs) == 3
        nearest = min(runs, key=lambda run: abs(np.log(run[1] / float(unreachable))))
        record = json.loads(report.read_text())
        assert record["options"]["spacing"] == pytest.approx(nearest[0], rel=1e-5)
        assert record["length"] == pytest.approx(nearest[1], rel=1e-5)
        places.append(runs.index(nearest))
    assert min(places) < 2  # else it would be the last by chance


@pytest.mark.parametrize(
    ("extra", "words"),
    [
        (("--spacing", "1", "--target-length", "5"), "both given"),
        (("--target-length", "0"), "not greater than 0"),
        (("--target-length", "1e12"), "smaller length"),
        (("--target-length", "1e-3"), ""),
    ],
)
def test_what_cannot_be_is_refused(ball: Path, extra, words, capsys) -> None:
    assert run(ball, *extra) == 2
    assert words in capsys.readouterr().err
    assert not ball.with_name("a.obj").exists()


@pytest.mark.parametrize(("length", "way"), [("0.5", "greater"), ("1e9", "smaller")])
def test_what_no_spacing_can_give_is_said_of_the_length(ball: Path, length, way, capsys) -> None:
    """Nobody gave a spacing, so none is to be chosen."""
    assert run(ball, "--target-length", length) == 2
    said = capsys.readouterr().err.strip()
    assert f"a length of {float(length):g} needs a spacing of about" in said
    assert said.endswith(f"choose a {way} length")
    assert "choose a smaller spacing" not in said and "choose a larger spacing" not in said
