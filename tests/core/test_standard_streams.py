# SPDX-License-Identifier: GPL-3.0-or-later
"""`-` for the standard input and output of the batch command."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import geometry
import numpy as np
import pytest
from conftest import PACKAGE
from meander.cli import standard
from meander.cli.arguments import parser
from meander.cli.place import Place
from meander.cli.values import BadInput
from meander.model.files import meshes
from sentences import assert_sentence

SHORT = ("--spacing", "0.3", "--iterations", "3")


@pytest.fixture(scope="module")
def mesh(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return geometry.write_obj(tmp_path_factory.mktemp("mesh") / "mesh.obj", geometry.grid(6))


def _run(data: bytes, *options: object) -> subprocess.CompletedProcess:
    command = [sys.executable, str(PACKAGE / "batch.py"), *(str(option) for option in options)]
    return subprocess.run(command, input=data, capture_output=True, timeout=60)


def _ply(mesh: Path) -> bytes:
    points = [line.split()[1:] for line in mesh.read_text().splitlines() if line.startswith("v ")]
    faces = [line.split()[1:] for line in mesh.read_text().splitlines() if line.startswith("f ")]
    head = ["ply", "format ascii 1.0", f"element vertex {len(points)}"]
    head += [f"property double {axis}" for axis in "xyz"]
    head += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    rows = [" ".join(point) for point in points]
    rows += ["3 " + " ".join(str(int(corner) - 1) for corner in face) for face in faces]
    return "\n".join([*head, *rows, ""]).encode()


def _stl(mesh: Path, text: bool) -> bytes:
    vertices, faces = meshes.read_mesh(mesh)
    if text:
        lines = ["solid a"]
        for face in faces:
            lines += ["facet normal 0 0 1", "outer loop"]
            lines += ["vertex {} {} {}".format(*vertices[corner].tolist()) for corner in face]
            lines += ["endloop", "endfacet"]
        return "\n".join([*lines, "endsolid a", ""]).encode()
    rows = np.zeros(len(faces), [("n", "<f4", 3), ("c", "<f4", (3, 3)), ("a", "<u2")])
    rows["c"] = vertices[faces]
    return bytes(80) + len(faces).to_bytes(4, "little") + rows.tobytes()


@pytest.mark.parametrize("kind", ["obj", "ply", "stl text", "stl"])
def test_a_mesh_comes_in_by_any_format(mesh: Path, tmp_path: Path, kind: str) -> None:
    data = {
        "obj": mesh.read_bytes,
        "ply": lambda: _ply(mesh),
        "stl text": lambda: _stl(mesh, text=True),
        "stl": lambda: _stl(mesh, text=False),
    }[kind]()
    output, report = tmp_path / "out.obj", tmp_path / "report.json"
    ended = _run(data, "--input", "-", "--output", output, "--report", report, *SHORT)
    assert ended.returncode == 0, ended.stderr
    assert output.read_bytes().startswith(b"# Meander")
    assert json.loads(report.read_text())["options"]["input"] == "-"


@pytest.mark.parametrize("kind", ["obj", "svg", "json", "gcode"])
def test_a_curve_goes_out_alone(mesh: Path, tmp_path: Path, kind: str) -> None:
    file = tmp_path / f"out.{kind}"
    assert _run(b"", "--input", mesh, "--output", file, *SHORT).returncode == 0
    options = ("--input", "-", "--output", "-", "--output-format", kind, *SHORT)
    ended = _run(mesh.read_bytes(), *options)
    assert ended.returncode == 0, ended.stderr
    # The title of a drawing is the name of its file.
    wanted = file.read_bytes().replace(b"<title>out", b"<title>the standard output")
    assert ended.stdout == wanted.replace(b"; out,", b"; the standard output,")
    assert ended.stderr.startswith(b"meander: ")
    assert ended.stderr.rstrip().endswith(b"meander: wrote the standard output")
    quiet = _run(mesh.read_bytes(), *options, "--quiet")
    assert (quiet.returncode, quiet.stdout, quiet.stderr) == (0, ended.stdout, b"")


def test_a_report_and_a_seed_are_piped(mesh: Path, tmp_path: Path) -> None:
    seed = b"v 0.2 0.5 0\nv 0.8 0.5 0\nl 1 2\n"
    options = ("--input", mesh, "--seed", "-", "--output", tmp_path / "out.obj", *SHORT)
    ended = _run(seed, *options, "--report", "-")
    assert ended.returncode == 0, ended.stderr
    record = json.loads(ended.stdout)
    assert record["options"]["seed"] == record["options"]["report"] == "-"


def test_what_streams_cannot_do_is_said(mesh: Path, tmp_path: Path) -> None:
    given = ("--input", mesh, "--output", tmp_path / "out.obj")
    for options, data, words in (
        (("--input", mesh, "--output", "-"), b"", "--output-format"),
        ((*given, "--output-format", "svg"), b"", "for --output -"),
        (("--input", "-", "--output", tmp_path / "out.obj", "--seed", "-"), b"", "standard input"),
        ((*given[:2], "--output", "-", "--output-format", "obj", "--report", "-"), b"", "both"),
        ((*given, "--cut", "-"), b"", "name a file"),
        (("--input", "-", *given[2:]), b"", "the standard input.obj is empty"),
        (("--input", "-", *given[2:]), b"v 0 0 0\nf 1 2 3\n", "the standard input.obj, line 2"),
        (("--input", "-", *given[2:]), b"PK\3\4 and more", "archive"),
    ):
        ended = _run(data, *options, *SHORT)
        assert (ended.returncode, ended.stdout) == (2, b"")
        said = ended.stderr.decode()
        assert words in said
        assert_sentence(said.removeprefix("meander: ").strip())
    assert not (tmp_path / "out.obj").exists()


def test_blender_keeps_the_standard_output_to_itself(mesh: Path, tmp_path: Path) -> None:
    """It prints there itself."""
    place = Place("a test", print, host=object())
    options = ["--input", str(mesh), "--output", "-", "--output-format", "svg"]
    with pytest.raises(BadInput, match="cannot be used in Blender"):
        with standard.streams(parser(place).parse_args(options), place):
            pass


@pytest.mark.parametrize("name", ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"])
@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="this system has no such names")
def test_a_report_goes_to_the_standard_output_by_its_other_names(
    mesh: Path, tmp_path: Path, name: str
) -> None:
    output = tmp_path / "a.obj"
    ended = _run(b"", "--input", mesh, "--output", output, "--report", name, "--quiet", *SHORT)
    assert (ended.returncode, ended.stderr) == (0, b"")
    assert json.loads(ended.stdout)["version"]


@pytest.mark.skipif(not Path("/dev/stderr").exists(), reason="this system has no such name")
def test_a_report_among_what_is_said(mesh: Path, tmp_path: Path) -> None:
    """It is written behind the lines of a log that somebody has open, and does not replace it."""
    command = [sys.executable, str(PACKAGE / "batch.py"), "--input", str(mesh), *SHORT]
    command += ["--output", str(tmp_path / "a.obj"), "--report", "/dev/stderr", "--quiet"]
    log = tmp_path / "log.txt"
    log.write_text("begun\n")
    with log.open("a") as stream:
        ended = subprocess.run(command, stderr=stream, stdout=subprocess.DEVNULL, timeout=60)
        stream.write("ended\n")
    assert ended.returncode == 0
    text = log.read_text()
    assert text.startswith("begun\n{") and text.endswith("}\nended\n")
