# SPDX-License-Identifier: GPL-3.0-or-later
"""Poses of a tool along the curve: right-handed frames, a standoff, ways there and back."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch
from meander.model.toolpaths import poses, toolpath


def matrices(quaternions: np.ndarray) -> np.ndarray:
    """Rotations by q v q*, of x, y, z, w."""
    x, y, z, w = quaternions.T
    return np.stack(
        [
            np.column_stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)]),
            np.column_stack([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)]),
            np.column_stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]),
        ],
        axis=2,
    )


@pytest.fixture
def ball(tmp_path: Path) -> Path:
    return geometry.write_obj(tmp_path / "ball.obj", geometry.icosphere(3))


def run(mesh: Path, name: str, *extra: str) -> int:
    given = ["--input", mesh, "--output", mesh.with_name(name), "--spacing", "0.3", "--quiet"]
    return batch.main([str(a) for a in (*given, "--resample-step", "0.05", *extra)])


def test_every_pose_stands_on_the_surface_and_looks_into_it(ball: Path) -> None:
    given = ("--poses", "--standoff", "0.1", "--approach", "0.5")
    assert run(ball, "a.csv", *given) == 0
    with (ball.with_name("a.csv")).open() as file:
        rows = list(csv.DictReader(file))
    table = {key: np.array([float(row[key]) for row in rows]) for key in rows[0] if key != "kind"}
    places = np.column_stack([table[axis] for axis in "xyz"])
    quaternions = np.column_stack([table[f"q{axis}"] for axis in "xyzw"])
    normals = np.column_stack([table[f"n{axis}"] for axis in "xyz"])
    tangents = np.column_stack([table[f"t{axis}"] for axis in "xyz"])
    kinds = np.array([row["kind"] for row in rows])
    strands = int(table["strand"].max()) + 1
    assert (kinds == "approach").sum() == (kinds == "retreat").sum() == strands
    heights = np.linalg.norm(places, axis=1)
    assert np.allclose(heights[kinds == "curve"], 1.1, atol=0.02)
    assert np.allclose(heights[kinds != "curve"], 1.6, atol=0.02)
    assert np.allclose(np.linalg.norm(quaternions, axis=1), 1.0)
    frames = matrices(quaternions)
    assert np.allclose(np.linalg.det(frames), 1.0)
    assert np.allclose(frames[:, :, 2], -normals, atol=1e-9)
    assert np.allclose(frames[:, :, 0], tangents, atol=1e-9)
    outward = places / heights[:, None]
    assert (np.abs((frames[:, :, 2] * outward).sum(axis=1) + 1.0) < 0.02).all()
    on = kinds == "curve"
    ahead = np.diff(places[on], axis=0)
    step = np.linalg.norm(ahead, axis=1)
    close = step < 0.08
    assert ((frames[on][:-1, :, 0][close] * ahead[close]).sum(axis=1) > 0.5 * step[close]).all()
    # Neighbours are in the same half, so that a robot turns the short way.
    same = table["strand"][1:] == table["strand"][:-1]
    assert ((quaternions[1:] * quaternions[:-1]).sum(axis=1)[same] > 0.0).all()
    assert run(ball, "a.npz", *given) == 0
    with np.load(ball.with_name("a.npz")) as arrays:
        assert np.allclose(arrays["places"], places) and np.allclose(arrays["normals"], normals)
        assert arrays["kinds"].tolist() == kinds.tolist()
        assert arrays["offsets"][-1] == len(places) and len(arrays["offsets"]) == strands + 1
    assert run(ball, "a.json", *given) == 0
    record = json.loads(ball.with_name("a.json").read_text())
    assert "z into the surface" in record["frame"]
    assert np.allclose(np.concatenate([s["places"] for s in record["strands"]]), places)
    assert np.allclose(
        np.concatenate([s["quaternions"] for s in record["strands"]]), quaternions, atol=1e-9
    )


def test_frames_where_a_tangent_is_none() -> None:
    """A way that turns back, and one along its normal: still a right-handed frame."""
    points = np.array([(0, 0, 0), (1, 0, 0), (0, 0, 0), (0, 0, 1)], dtype=float)
    normals = np.array([(0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 0, 1)], dtype=float)
    found = poses.poses_of(toolpath.strand_of(points, normals, False))
    frames = matrices(found.quaternions)
    assert np.allclose(np.linalg.det(frames), 1.0) and np.isfinite(frames).all()
    assert np.allclose(frames[:, :, 2], -normals)


def test_every_direction_has_its_quaternion() -> None:
    rng = np.random.default_rng(2)
    frames = np.stack([np.linalg.qr(rng.normal(size=(3, 3)))[0] for _ in range(300)])
    frames[np.linalg.det(frames) < 0] *= -1.0
    half = [np.diag(d) for d in ((1.0, -1, -1), (-1.0, 1, -1), (-1.0, -1, 1), (1.0, 1, 1))]
    frames = np.concatenate([frames, half])
    assert np.allclose(matrices(poses._quaternions(frames)), frames, atol=1e-12)


@pytest.mark.parametrize(
    ("extra", "name"),
    [(("--poses",), "a.svg"), (("--standoff", "1"), "a.csv"), (("--approach", "1"), "a.json")],
)
def test_what_means_nothing_is_refused(ball: Path, extra, name, capsys) -> None:
    assert run(ball, name, *extra) == 2
    assert "--poses" in capsys.readouterr().err
