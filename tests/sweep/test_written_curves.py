# SPDX-License-Identifier: GPL-3.0-or-later
"""The checker looks at curves in files: it finds nothing in what the batch command writes, and what
was put there by hand."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from geometry import obj_text, torus
from written_curves import ROOT, found_in

MESH = torus(24, 12)


@pytest.fixture(scope="module")
def arrays(tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    folder = tmp_path_factory.mktemp("curve")
    mesh, curve = folder / "torus.obj", folder / "curve.npz"
    mesh.write_text(obj_text(MESH))
    options = ["--input", mesh, "--output", curve, "--start", "full", "--spacing", 0.1, "--quiet"]
    command = ROOT / "addon" / "meander" / "batch.py"
    subprocess.run([sys.executable, command, *map(str, options)], check=True)
    with np.load(curve) as read:
        return {name: read[name] for name in ("points", "faces", "weights", "offsets", "closed")}


def found(arrays: dict[str, np.ndarray], folder: Path) -> dict[str, int | str]:
    np.savez(folder / "curve.npz", **arrays)
    return found_in(MESH.vertices, MESH.faces, folder / "curve.npz")


def test_nothing_is_wrong_with_what_is_written(arrays, tmp_path):
    row = found(arrays, tmp_path)
    assert row["points"] == len(arrays["points"]) > 1000
    assert (row["crossings"], row["faults"], row["first_fault"]) == (0, 0, "")


def test_a_crossing_is_found(arrays, tmp_path):
    # Two points on the curve, with their neighbours in one face and far from each other along it,
    # change places: what leads to them crosses what lies between them.
    faces = arrays["faces"]
    inside = (arrays["weights"] > 0).all(axis=1)
    inside &= (np.roll(faces, 1) == faces) & (np.roll(faces, -1) == faces)
    face = np.bincount(faces[inside]).argmax()
    here = np.flatnonzero(inside & (faces == face))
    first, last = here[0], here[-1]
    assert last - first > 50
    order = np.arange(len(faces))
    order[[first, last]] = last, first
    swapped = {name: arrays[name][order] for name in ("points", "faces", "weights")}
    row = found(arrays | swapped, tmp_path)
    assert row["crossings"] > 0 and row["first_fault"].startswith("crossing")


def test_a_point_beside_its_face_is_found(arrays, tmp_path):
    points = arrays["points"].copy()
    points[100] += 1e-12
    row = found(arrays | {"points": points}, tmp_path)
    assert row["first_fault"] == "not in its place: point 100 is off its face"
