# SPDX-License-Identifier: GPL-3.0-or-later
"""A defect of the library in the midst of a run leaves what has grown, and a file to report."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest
from meander import core
from meander.model.bundle import read_bundle
from scenes import fill, refused, sphere

SENTENCE = "In iteration 6 a point would have left its face; please report this."


def failing_after(iterations: int):
    def run(flow: core.Flow, context: core.Context) -> str:
        for _iteration in range(iterations):
            flow.step(context)
        raise core.MeanderError(SENTENCE, core.Status.INTERNAL)

    return run


def test_the_last_good_curve_is_the_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(core.Flow, "run", failing_after(5))
    result = fill(sphere(), 0.3)
    assert sum(len(spline.points) for spline in result.data.splines) > 10
    (path,) = tmp_path.glob("meander-*/defect.npz")
    said = capfd.readouterr().out
    assert "In iteration 6" in said and str(path) in said
    bundle = read_bundle(path)
    assert (bundle.iteration, bundle.sentence) == (5, SENTENCE)
    with core.Surface(
        bundle.problem.vertices, bundle.problem.faces, bundle.problem.surface_options
    ) as surface, core.Flow(surface, bundle.problem.options) as flow:
        for _iteration in range(5):
            flow.step()
        assert flow.polylines().positions.tobytes() == bundle.curve.positions.tobytes()


def test_without_a_curve_it_is_an_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(core.Flow, "run", failing_after(0))
    assert "In iteration 6" in refused(sphere())
