# SPDX-License-Identifier: GPL-3.0-or-later
"""A defect of the library leaves a bundle, from which the same run begins again.

That the library finds a defect, and what it then leaves, is in tests/native/test_invariant.cpp;
here a run is said to have ended so.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import geometry
import numpy as np
import pytest
from conftest import REPOSITORY
from flows import options_of
from meander import batch, core
from meander.model import bundle
from meander.model.files import obj
from meander.model.files.whole import FileError
from meander.model.opening import open_flow
from meander.model.problem import Problem

SENTENCE = "In iteration 8 a point would have left its face; please report this."
BROKEN = core.MeanderError(SENTENCE, core.Status.INTERNAL)


def whole_problem() -> Problem:
    """One with everything that a problem can have."""
    vertices, faces = geometry.grid(12)
    options = options_of("finest", radius=0.04, alignment_weight=0.5, threads=1)
    points = np.array([[0.2, 0.2, 0.0], [0.8, 0.3, 0.0], [0.3, 0.8, 0.0], [0.2, 0.5, 0.0]])
    fixed = np.array([1, 0, 1, 0], dtype=np.uint8)
    seed = core.Seed(
        points, np.array([0, 4], np.uint32), np.array([0], np.uint8), fixed,
        loops=True, max_distance=0.1,
    )  # fmt: skip
    prepared = core.SurfaceOptions(merge_distance=1e-9)
    prepared.face_mask = np.arange(len(faces)) > 3
    return Problem(
        vertices, faces, options, seed,
        density=lambda surface, _context: (
            1.0 + np.abs(surface.curvature("mean")) + vertices[:, 0]
        ),
        surface_options=prepared,
        directions=np.tile([1.0, 0.3, 0.0], (len(vertices), 1)),
        alignment="across",
        outline=0.06,
    )  # fmt: skip


def after(problem: Problem, iterations: int) -> core.Polylines:
    with open_flow(problem).flow as flow:
        for _iteration in range(iterations):
            flow.step()
        return flow.polylines()


def same(one: core.Polylines, other: core.Polylines) -> bool:
    return all(a.tobytes() == b.tobytes() for a, b in zip(one, other, strict=True))


def test_a_run_begins_again_from_its_bundle(tmp_path: Path) -> None:
    path, opened = tmp_path / "a.npz", open_flow(whole_problem())
    with opened.flow as flow:
        for _iteration in range(7):
            flow.step()
        made = bundle.bundle_of(flow, opened.problem, BROKEN)
    bundle.write_bundle(path, made)
    read = bundle.read_bundle(path)
    assert (read.version, read.iteration, read.sentence) == (core.VERSION, 7, SENTENCE)
    assert read.problem.options == opened.problem.options
    assert same(read.curve, after(read.problem, 7))


def test_old_names_of_options_are_read(tmp_path: Path) -> None:
    path, opened = tmp_path / "a.npz", open_flow(whole_problem())
    opened.problem.options.boundary_distance = 0.75
    opened.problem.options.hairpin_removal_iterations = 33
    opened.problem.options.tunings["polish_length_gain"] = 2.5
    with opened.flow as flow:
        bundle.write_bundle(path, bundle.bundle_of(flow, opened.problem, BROKEN))
    with np.load(path) as file:
        arrays = dict(file)
    record = json.loads(str(arrays["record"]))
    options = record["options"]
    options["border_distance"] = options.pop("boundary_distance")
    options["ripening_iterations"] = options.pop("hairpin_removal_iterations")
    options |= options.pop("tunings")
    record["seed"]["reach"] = record["seed"].pop("max_distance")
    np.savez_compressed(path, **(arrays | {"record": np.array(json.dumps(record))}))
    read = bundle.read_bundle(path).problem
    assert read.options == opened.problem.options
    assert read.seed.max_distance == opened.problem.seed.max_distance > 0.0


def test_reading_executes_nothing_and_refuses_other_files(tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    np.savez(path, record=np.array([print], dtype=object))
    with pytest.raises(FileError):
        bundle.read_bundle(path)
    path.write_text("something else")
    with pytest.raises(FileError):
        bundle.read_bundle(path)
    np.savez(path, vertices=np.zeros(3))
    with pytest.raises(FileError):
        bundle.read_bundle(path)


def test_the_batch_command_leaves_one_beside_the_output(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    mesh, output = tmp_path / "square.obj", tmp_path / "curve.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
    output.write_text("earlier")
    wait = core.Flow.wait

    def wait_and_fail(flow: core.Flow) -> str:
        wait(flow)
        raise BROKEN

    monkeypatch.setattr(core.Flow, "wait", wait_and_fail)
    given = ["--input", mesh, "--output", output, "--spacing", 0.2, "--iterations", 7, "--quiet"]
    assert batch.main([str(item) for item in given]) == 1
    error = capsys.readouterr().err
    path = tmp_path / "curve.defect.npz"
    assert str(path) in error and SENTENCE in error and "Traceback" in error
    assert output.read_text() == "earlier"
    read = bundle.read_bundle(path)
    assert read.iteration == 7 and same(read.curve, after(read.problem, 7))
    # The library has no such defect, and so nothing fails again.
    good = tmp_path / "good.obj"
    done = subprocess.run(
        [sys.executable, str(REPOSITORY / "scripts" / "replay_bundle.py"), path, "--curve", good],
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert SENTENCE in done.stdout and "8 iterations, and nothing fails" in done.stdout
    assert len(obj.read_obj_curve(good).points) == len(read.curve.positions)
