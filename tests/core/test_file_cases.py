# SPDX-License-Identifier: GPL-3.0-or-later
"""One harmless element refuses no file, and what is refused is named: see file_cases.py."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from file_cases import CASES, Case
from meander import batch
from meander.model import surface_files, whole_files
from sentences import assert_sentence

REPOSITORY = Path(__file__).resolve().parents[2]


@pytest.fixture(params=CASES, ids=lambda case: f"{case.kind}: {case.title}")
def case(request: pytest.FixtureRequest) -> Case:
    return request.param


@pytest.fixture
def path(case: Case, tmp_path: Path) -> Path:
    path = tmp_path / f"mesh.{case.kind}"
    path.write_bytes(case.data)
    return path


def area_of(vertices: np.ndarray, faces: np.ndarray) -> float:
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def test_a_file_is_read_or_refused_as_the_page_says(case: Case, path: Path) -> None:
    if not case.area:
        with pytest.raises(whole_files.FileError) as caught:
            surface_files.read(path)
        assert_sentence(str(caught.value))
        assert str(caught.value) == f"{path}{case.said}"
        return
    mesh = surface_files.read(path)
    assert area_of(mesh.vertices, mesh.faces) == pytest.approx(case.area, rel=1e-6)
    assert [remark.removeprefix(str(path)) for remark in mesh.remarks] == (
        [case.said] if case.said else []
    )


def test_the_command_says_the_same(case: Case, path: Path, tmp_path: Path, capsys) -> None:
    out = tmp_path / "out.obj"
    given = ["--input", str(path), "--output", str(out), "--quiet", "--spacing", "0.3"]
    code = batch.main([*given, "--iterations", "1"])
    said = capsys.readouterr().err
    assert code == (0 if case.area else 2), said
    assert out.exists() == bool(case.area)
    assert case.said in said


def test_the_page_is_made_from_the_cases() -> None:
    command = [sys.executable, REPOSITORY / "scripts/write_files_page.py", "--check"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
