# SPDX-License-Identifier: GPL-3.0-or-later
"""A length that is asked for: the spacing is found at which the curve has it."""

from __future__ import annotations

import json
from pathlib import Path

import geometry
import pytest
from meander import batch
from meander.cli.target_length import CLOSE, nearest


@pytest.fixture
def ball(tmp_path: Path) -> Path:
    vertices, faces = geometry.icosphere(3)
    lines = ["v {!r} {!r} {!r}".format(*place) for place in vertices.tolist()]
    lines += ["f {} {} {}".format(*(face + 1)) for face in faces]
    path = tmp_path / "ball.obj"
    path.write_text("\n".join(lines))
    return path


def run(mesh: Path, *extra: str) -> int:
    report = mesh.with_name("r.json")
    given = ["--input", mesh, "--output", mesh.with_name("a.obj"), "--quiet", "--report", report]
    return batch.main([str(a) for a in (*given, *extra)])


@pytest.mark.parametrize("length", ["40", "97.5"])
def test_the_curve_is_as_long_as_asked_for(ball: Path, length: str) -> None:
    assert run(ball, "--target-length", length) == 0
    report = json.loads(ball.with_name("r.json").read_text())
    assert report["length"] == pytest.approx(float(length), rel=4 * CLOSE)
    assert report["options"]["target_length"] == float(length)
    # What was found is the spacing of a run without it, to the last bit.
    spacing = report["options"]["spacing"]
    assert run(ball, "--spacing", repr(spacing)) == 0
    assert json.loads(ball.with_name("r.json").read_text())["length"] == report["length"]


@pytest.mark.parametrize("power", [-0.8, -1.0, -1.3])
def test_the_search_needs_few_trials(power: float) -> None:
    asked = []

    def length_at(spacing: float) -> float:
        asked.append(spacing)
        return 12.0 * spacing**power

    spacing, length = nearest(length_at, 3.0, 100.0)
    assert length == pytest.approx(100.0, rel=CLOSE) and length == 12.0 * spacing**power
    assert len(asked) <= 4


@pytest.mark.parametrize(
    ("extra", "words"),
    [
        ((), "--spacing"),
        (("--spacing", "1", "--target-length", "5"), "both given"),
        (("--target-length", "0"), "not greater than 0"),
        (("--target-length", "1e12"), "larger spacing"),
        (("--target-length", "1e-3"), ""),
    ],
)
def test_what_cannot_be_is_refused(ball: Path, extra, words, capsys) -> None:
    assert run(ball, *extra) == 2
    assert words in capsys.readouterr().err
    assert not ball.with_name("a.obj").exists()
