# SPDX-License-Identifier: GPL-3.0-or-later
"""One harmless element refuses no file, and what is refused is named: see file_cases.py."""

from __future__ import annotations

import struct
import subprocess
import sys
from pathlib import Path

import geometry
import numpy as np
import pytest
from file_cases import CASES, Case
from meander import batch
from meander.model.files import meshes, whole
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


def test_a_file_is_read_or_refused_as_the_page_says(case: Case, path: Path) -> None:
    if not case.area:
        with pytest.raises(whole.FileError) as caught:
            meshes.read(path)
        assert_sentence(str(caught.value))
        assert str(caught.value) == f"{path}{case.said}"
        return
    mesh = meshes.read(path)
    area = geometry.triangle_areas(mesh.vertices, mesh.faces).sum()
    assert area == pytest.approx(case.area, rel=1e-6)
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


MEASURED = """
import resource, sys, time
sys.path.insert(0, sys.argv[1])
import conftest
from meander import core
from meander.model.files import meshes
core.library_version()
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
started = time.process_time()
mesh = meshes.read(sys.argv[2])
seconds = time.process_time() - started
more = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
print(len(mesh.faces), seconds, 1024 * more)
"""


def large(kind: str, count: int) -> bytes:
    """A sheet of 2 count^2 triangles."""
    x, y = np.meshgrid(np.arange(count + 1) / count, np.arange(count + 1) / count)
    places = np.column_stack([x.ravel(), y.ravel(), np.sin(9 * x.ravel())])
    a = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    quads = np.column_stack([a, a + 1, a + count + 2, a + count + 1])
    triangles = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    numbers = tuple(places.ravel().tolist())
    if kind == "obj":
        text = ("v %.6f %.6f %.6f\n" * len(places)) % numbers
        return (text + ("f %d %d %d\n" * len(triangles)) % tuple((triangles + 1).ravel())).encode()
    head = (
        f"element vertex {len(places)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    if kind == "ply":
        text = "ply\nformat ascii 1.0\n" + head + ("%.6f %.6f %.6f\n" * len(places)) % numbers
        return (text + ("3 %d %d %d\n" * len(triangles)) % tuple(triangles.ravel())).encode()
    corners = places[triangles].astype("<f4")
    if kind == "stl":
        rows = np.zeros(len(corners), [("n", "<f4", 3), ("c", "<f4", (3, 3)), ("a", "<u2")])
        rows["c"] = corners
        return bytes(80) + struct.pack("<I", len(rows)) + rows.tobytes()
    loop = "facet normal 0 0 1\nouter loop\n" + "vertex %.6f %.6f %.6f\n" * 3
    text = ((loop + "endloop\nendfacet\n") * len(corners)) % tuple(corners.ravel().tolist())
    return ("solid a\n" + text + "endsolid a\n").encode()


@pytest.mark.parametrize("kind", ["obj", "ply", "stl", "stl in text"])
def test_a_large_file_is_read_in_a_moment_and_in_little_memory(kind: str, tmp_path: Path) -> None:
    """A sixth of a file of 950,000 faces, with four times its size; what Python and the library
    take anyway is a few MB."""
    path = tmp_path / f"large.{kind[:3]}"
    path.write_bytes(large(kind, 280))
    code = [sys.executable, "-c", MEASURED, REPOSITORY / "tests" / "core", path]
    done = subprocess.run(code, capture_output=True, text=True, check=True)
    faces, seconds, memory = map(float, done.stdout.split())
    size = path.stat().st_size
    assert faces == 2 * 280**2
    # Half a second for 950,000 faces on an idle machine; a line at a time in Python it was 6.
    assert seconds < 4.0 * max(size / 40e6, faces / 950_000)
    assert memory < 4 * size + 8e6


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.obj", "# x\nv 0 0 0\n\nv nan 0 0\nv 1 1 0\nf 1 2 3\n", "Vertex 2 (line 4) has a"),
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no b\nf 1 2 3 4\nf 1 2 2\n",
         "Face 2 (line 7) uses vertex 2 (line 2) twice"),
        ("a.ply", "vertex 3|nan 0 0\n1 0 0\n1 1 0\n|face 1|3 0 1 2\n", "Vertex 0 has a"),
        ("a.ply", "vertex 3|0 0 0\n1 0 0\n1 1 0\n|face 1|3 0 1 9\n", "refers to vertex 9"),
        ("a.stl", "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex inf 1 0\nendloop\n",
         "Vertex at inf 1 0 has a"),
    ],
)  # fmt: skip
def test_elements_are_counted_as_the_file_does(name, text, words, tmp_path, capsys) -> None:
    path = tmp_path / name
    if name.endswith(".ply"):
        vertices, places, faces, rows = text.split("|")
        text = (
            f"ply\nformat ascii 1.0\nelement {vertices}\nproperty float x\nproperty float y\n"
            f"property float z\nelement {faces}\nproperty list uchar int vertex_indices\n"
            f"end_header\n{places}{rows}"
        )
    path.write_text(text)
    given = ["--input", str(path), "--output", str(tmp_path / "o.obj"), "--spacing", "0.3"]
    assert batch.main([*given, "--quiet", "--strict"]) == 2
    assert words in capsys.readouterr().err


def test_every_cause_has_a_wording_of_its_own() -> None:
    said = [(case.kind, case.said) for case in CASES if not case.area]
    assert len(set(said)) == len(said) and len(said) >= 10
