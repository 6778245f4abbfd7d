# SPDX-License-Identifier: GPL-3.0-or-later
"""Variations: other curves of the same settings, by the command and in Python."""

from __future__ import annotations

import json
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import fill, options_of
from meander import batch, core
from meander.model import variations
from meander.model.problem import Problem
from meander.model.thumbnail import Thumbnails

SPACING = 0.3


@pytest.fixture(scope="module")
def ball(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("variation") / "ball.obj"
    return geometry.write_obj(path, geometry.icosphere(3))


def written(ball: Path, tmp_path: Path, *flags: object) -> tuple[bytes, dict]:
    output, report = tmp_path / "curve.obj", tmp_path / "report.json"
    assert fill(ball, output, "--report", report, "--spacing", SPACING, "--quiet", *flags) == 0
    lines = output.read_bytes().splitlines()
    return b"\n".join(each for each in lines if each[:1] != b"#"), json.loads(report.read_text())


@pytest.mark.parametrize("flags", [(), ("--start", "full"), ("--mirror", "x")])
def test_the_command_makes_the_variation_that_is_asked_for(
    ball: Path, tmp_path: Path, flags: tuple
) -> None:
    plain, report = written(ball, tmp_path, *flags)
    assert report["options"]["variation"] == 0
    assert written(ball, tmp_path, *flags, "--variation", 0)[0] == plain
    second, report = written(ball, tmp_path, *flags, "--variation", 2, "--threads", 1)
    assert report["options"]["variation"] == 2 and report["converged"]
    assert report["crossings"] == 0
    assert second != plain
    assert written(ball, tmp_path, *flags, "--variation", 2, "--threads", 3)[0] == second


def test_what_is_drawn_grows_otherwise(ball: Path, tmp_path: Path) -> None:
    seed = tmp_path / "seed.obj"
    angles = np.linspace(0.0, 2.0, 20)
    points = [f"v {np.cos(a):.9f} {np.sin(a):.9f} 0" for a in angles]
    seed.write_text("\n".join([*points, "l " + " ".join(str(k + 1) for k in range(20))]))
    found = {written(ball, tmp_path, "--seed", seed, "--variation", k)[0] for k in range(3)}
    assert len(found) == 3


@pytest.mark.parametrize("number", ["-1", "1.5", "x", "4294967296"])
def test_what_is_no_variation_is_refused(
    ball: Path, tmp_path: Path, number: str, capsys: pytest.CaptureFixture
) -> None:
    output = tmp_path / "curve.obj"
    code = batch.main(
        ["--input", str(ball), "--output", str(output), f"--variation={number}", "--quiet"]
    )
    assert code == 2 and "--variation" in capsys.readouterr().err
    assert not output.exists()


def problem(spacing: float) -> Problem:
    options = options_of(radius=spacing / 2.0)
    return Problem(*geometry.icosphere(3), options)


def test_coarse_runs_are_the_run_itself_before_it_is_made_even() -> None:
    whole = problem(SPACING)
    nodes = core.estimate_cost(
        core.Surface(whole.vertices, whole.faces).extent(None), whole.options
    ).nodes
    assert not variations.is_coarser(whole, nodes)
    for number, curve in zip((0, 3), variations.lines(whole, (0, 3), nodes), strict=True):
        with core.Surface(whole.vertices, whole.faces) as surface:
            options = options_of(radius=SPACING / 2.0, variation=number, iteration_limit=80)
            with core.Flow(surface, options) as flow:
                flow.run()
                assert np.array_equal(flow.polylines().positions, curve.positions)


def test_coarse_runs_of_a_fine_curve_are_wider() -> None:
    fine = problem(0.01)
    assert variations.is_coarser(fine, 1e6)
    taken = variations.coarse(fine, 1, 1e6).options
    assert taken.radius == pytest.approx(0.005 * np.sqrt(1e6 / 7000.0))
    assert fine.options.variation == 0 and fine.options.radius == 0.005


def test_thumbnails_show_what_is_in_front() -> None:
    vertices, faces = geometry.icosphere(3)
    angles = np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False)
    pictures = Thumbnails(vertices, faces, np.eye(3), 64)

    def ring(z: float) -> core.Polylines:
        wide = np.sqrt(1.0 - z * z)
        points = np.column_stack([wide * np.cos(angles), wide * np.sin(angles), 0.0 * angles + z])
        return core.Polylines(points, points, np.array([0, 200]), np.array([1]))

    empty = core.Polylines(
        np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(1, dtype=int), np.zeros(0, dtype=bool)
    )
    plain, front, back = pictures.of(empty), pictures.of(ring(0.8)), pictures.of(ring(-0.8))
    assert np.array_equal(plain, back), "a ring behind the ball"
    rows, columns = np.nonzero(np.abs(front - plain).max(axis=2) > 0.3)
    away = np.hypot(columns - 31.5, rows - 31.5) / (0.46 * 64)
    assert len(rows) > 100 and np.abs(away - 0.6).max() < 0.08
    middle = plain[32, 32]
    assert middle[3] == 1.0 and plain[0, 0, 3] == 0.0
    assert middle[0] > plain[32, 5, 0] > 0.0, "darker where it turns away"
