# SPDX-License-Identifier: GPL-3.0-or-later
"""A radius of bending that is asked for: it holds as others measure it, or is refused."""

from __future__ import annotations

import json
import re
import tracemalloc
from pathlib import Path
from types import SimpleNamespace

import geometry
import numpy as np
import pytest
from meander import batch
from meander.model.least_bend import LOOSER_WHERE_STIFF, sharpest_bend

SPACING = 0.08


@pytest.fixture
def sheet(tmp_path: Path) -> Path:
    return geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(20))


def run(mesh: Path, *extra: str, spacing: float = SPACING) -> int:
    given = ["--input", mesh, "--output", mesh.with_name("a.obj"), "--spacing", spacing]
    given += ["--report", mesh.with_name("r.json")]
    return batch.main([str(a) for a in (*given, *extra)])


def least_radius(curve: Path) -> float:
    """Of the circles through three points of a file's lines, an eighth of the spacing apart by
    their chords: found by walking, without any of the product's code."""
    points = [line.split()[1:] for line in curve.read_text().splitlines() if line[:2] == "v "]
    places = np.array(points, dtype=float)
    least = np.inf
    for line in (text for text in curve.read_text().splitlines() if text[:2] == "l "):
        numbers = [int(word) - 1 for word in line.split()[1:]]
        if numbers[0] == numbers[-1]:
            numbers += numbers[1:40]
        way = places[numbers]
        fine = np.concatenate([
            np.linspace(a, b, 20, endpoint=False) for a, b in zip(way[:-1], way[1:], strict=True)
        ])  # fmt: skip
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(fine, axis=0), axis=1))])
        for middle in range(0, len(fine), 5):
            before = np.searchsorted(along, along[middle] - SPACING / 8)
            after = np.searchsorted(along, along[middle] + SPACING / 8)
            if before == 0 or after >= len(fine):
                continue
            a, b, c = fine[before], fine[middle], fine[after]
            turn = np.arccos(np.clip(np.dot(b - a, c - b)
                / np.linalg.norm(b - a) / np.linalg.norm(c - b), -1.0, 1.0))  # fmt: skip
            if turn > 0.0:
                # The circle's angle at the middle point: the chord from first to last is
                # 2 R sin(turn).
                least = min(least, float(np.linalg.norm(c - a) / (2.0 * np.sin(turn))))
    return least


def test_the_radius_holds(tmp_path: Path, capsys) -> None:
    sheet = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(16))
    assert run(sheet, "--quiet") == 0
    before = least_radius(sheet.with_name("a.obj"))
    asked = 0.43 * SPACING / 2
    assert before < 0.8 * asked
    capsys.readouterr()
    assert run(sheet, "--least-bend-radius", repr(asked)) == 0
    tries = re.findall(r"at a stiffness of (\S+) the least bend radius is", capsys.readouterr().out)
    assert 1 <= len(tries) <= 7
    report = json.loads(sheet.with_name("r.json").read_text())
    assert report["bend"]["least_radius"] >= asked
    assert least_radius(sheet.with_name("a.obj")) > 0.95 * asked
    assert report["options"]["bending"] > float(tries[-1])
    assert report["options"]["least_bend_radius"] == asked
    assert report["crossings"] == 0


def test_stiffness_widens_by_the_power_that_the_library_makes_up_for() -> None:
    constants = Path(__file__).parents[2] / "native/src/flow/constants.h"
    (power,) = re.findall(r"kLooserWhereStiff = 1\.0 / (\d+)", constants.read_text())
    assert pytest.approx(1.0 / int(power)) == LOOSER_WHERE_STIFF


def test_what_holds_anyway_stays_as_it_is(sheet: Path) -> None:
    assert run(sheet, "--quiet") == 0
    before = sheet.with_name("a.obj").read_bytes()
    assert run(sheet, "--quiet", "--least-bend-radius", "0.001") == 0
    assert sheet.with_name("a.obj").read_bytes() == before
    assert json.loads(sheet.with_name("r.json").read_text())["options"]["bending"] == 1.0


def test_the_published_weights_have_no_stiffness_and_get_one(sheet: Path) -> None:
    assert run(sheet, "--quiet", "--preset", "paper") == 0
    before = json.loads(sheet.with_name("r.json").read_text())
    assert before["options"]["bending"] == 0.0
    asked = 1.2 * before["bend"]["least_radius"]
    assert run(sheet, "--quiet", "--preset", "paper", "--least-bend-radius", repr(asked)) == 0
    after = json.loads(sheet.with_name("r.json").read_text())
    assert after["options"]["bending"] >= 1.0 and after["bend"]["least_radius"] >= asked


def test_what_no_stiffness_holds_is_refused_with_the_place(tmp_path: Path, capsys) -> None:
    """Over the edges of a cube every curve bends sharply."""
    cube = geometry.write_obj(tmp_path / "cube.obj", geometry.cube())
    spacing = 0.25
    assert run(cube, "--quiet", "--least-bend-radius", "0.125", spacing=spacing) == 2
    said = capsys.readouterr().err
    assert "a bend radius of 0.125" in said and "larger spacing" in said
    place = np.array([float(word) for word in re.search(r"\((.*?)\)", said)[1].split(",")])
    vertices = np.asarray(geometry.cube().vertices)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    off = np.minimum(np.abs(place - low), np.abs(place - high))
    assert np.sort(off)[1] < spacing / 4  # near two sides of the box, so beside one of its edges
    assert not cube.with_name("a.obj").exists() and not cube.with_name("r.json").exists()


@pytest.mark.parametrize(
    ("extra", "words"),
    [
        (("0.1", "--bridge"), "--bridge makes corners"),
        (("0",), "not greater than 0"),
        (("nan",), "not a finite number"),
    ],
)
def test_what_cannot_be_is_refused(sheet: Path, extra, words, capsys) -> None:
    assert run(sheet, "--least-bend-radius", *extra) == 2
    assert words in capsys.readouterr().err
    assert not sheet.with_name("a.obj").exists()


def test_one_sharp_turn_is_found_in_a_long_curve_and_little_memory() -> None:
    """Of half a radian, in a line that is all but straight."""
    count, kink = 200_000, 23_457
    way = np.full(count, 2.0 * np.pi / count)
    way[kink] += 0.5
    way[kink + count // 2] -= 0.5
    heading = np.cumsum(way)
    points = np.cumsum(np.stack([np.cos(heading), np.sin(heading), 0 * heading], axis=1), axis=0)
    curve = SimpleNamespace(offsets=np.array([0, count]), positions=points, closed=np.array([0]))
    tracemalloc.start()
    bend = sharpest_bend(curve, 4.0)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    corners = points[[kink - 1, kink - 1 + count // 2]]
    assert np.linalg.norm(corners - bend.place, axis=1).min() < 0.2
    # From a unit before the corner to a unit after it the line turns by half a radian.
    assert bend.radius == pytest.approx(1.0 / (2.0 * np.sin(0.25)), rel=0.03)
    assert peak < 300 * count
