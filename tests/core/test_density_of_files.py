# SPDX-License-Identifier: GPL-3.0-or-later
"""Spacings by the colours and numbers that OBJ and PLY files give to their vertices."""

from __future__ import annotations

import json
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch
from meander.cli import density
from meander.model.density import Choice
from meander.model.files import meshes
from sentences import assert_sentence

MESH = geometry.grid(8)
ACROSS = np.asarray(MESH.vertices)[:, 0]  # from 0 to 1


def _ply(path: Path, columns: dict[str, tuple[str, np.ndarray]], binary: bool) -> Path:
    """A PLY file with more columns behind those of the places."""
    places = {axis: ("double", MESH.vertices[:, k]) for k, axis in enumerate("xyz")}
    every = places | columns
    form = "binary_little_endian" if binary else "ascii"
    head = ["ply", f"format {form} 1.0", f"element vertex {len(MESH.vertices)}"]
    head += [f"property {kind} {name}" for name, (kind, _values) in every.items()]
    head += [f"element face {len(MESH.faces)}", "property list uchar int vertex_indices"]
    text = "\n".join([*head, "end_header", ""]).encode()
    if binary:
        kinds = {"double": "<f8", "float": "<f4", "uchar": "u1", "ushort": "<u2"}
        rows = np.empty(len(MESH.vertices), [(n, kinds[k]) for n, (k, _v) in every.items()])
        for name, (_kind, values) in every.items():
            rows[name] = values
        text += rows.tobytes()
        text += b"".join(b"\3" + np.asarray(f, dtype="<i4").tobytes() for f in MESH.faces)
    else:
        table = np.column_stack([values for _kind, values in every.values()])
        text += "".join(" ".join(f"{v:.17g}" for v in row) + "\n" for row in table).encode()
        text += "".join("3 {} {} {}\n".format(*face) for face in MESH.faces).encode()
    path.write_bytes(text)
    return path


def _grey(values: np.ndarray, kind: str) -> dict[str, tuple[str, np.ndarray]]:
    return {name: (kind, values) for name in ("red", "green", "blue")}


def _obj(path: Path, extra: str = "{0:.9g} {0:.9g} {0:.9g}") -> Path:
    lines = [
        "v {:.17g} {:.17g} {:.17g} ".format(*place) + extra.format(grey)
        for place, grey in zip(MESH.vertices.tolist(), _encoded(ACROSS).tolist())
    ]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in MESH.faces.tolist()]
    path.write_text("\n".join([*lines, ""]))
    return path


def _encoded(linear: np.ndarray) -> np.ndarray:
    """sRGB of a brightness."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


EIGHT = np.round(255 * _encoded(ACROSS))
FILES = {
    "bytes": lambda f: _ply(f / "a.ply", _grey(EIGHT, "uchar"), binary=True),
    "bytes in text": lambda f: _ply(f / "a.ply", _grey(EIGHT, "uchar"), binary=False),
    "two bytes": lambda f: _ply(
        f / "a.ply", _grey(np.round(65535 * _encoded(ACROSS)), "ushort"), binary=True
    ),
    "floats": lambda f: _ply(f / "a.ply", _grey(_encoded(ACROSS), "float"), binary=True),
    "floats in text": lambda f: _ply(f / "a.ply", _grey(_encoded(ACROSS), "float"), binary=False),
    "obj": lambda f: _obj(f / "a.obj"),
    "obj with weights": lambda f: _obj(f / "a.obj", "1 {0:.9g} {0:.9g} {0:.9g}"),
}


@pytest.mark.parametrize("name", FILES)
def test_colours_are_a_density(tmp_path: Path, name: str) -> None:
    path = FILES[name](tmp_path)
    found = density.of_file(Choice("COLOR", "rgb", factors=(1.0, 0.5)), path)
    assert len(found) == len(meshes.read(path).vertices)
    assert found == pytest.approx((1.0 - 0.5 * ACROSS) ** -2.0, rel=0.02)


@pytest.mark.parametrize("binary", [False, True])
def test_numbers_of_a_ply_are_a_density(tmp_path: Path, binary: bool) -> None:
    path = _ply(tmp_path / "a.ply", {"quality": ("float", 7 * ACROSS - 3)}, binary)
    found = density.of_file(Choice("ATTRIBUTE", "quality", factors=(1.0, 0.5)), path)
    assert found == pytest.approx((1.0 - 0.5 * ACROSS) ** -2.0, rel=1e-5)


def _run(path: Path, *extra: object) -> int:
    given = ("--input", path, "--output", path.with_suffix(".json"), "--spacing", 0.12)
    return batch.main([str(each) for each in (*given, "--quiet", *extra)])


def test_the_curve_is_closer_where_it_is_bright(tmp_path: Path) -> None:
    path = _obj(tmp_path / "a.obj")
    assert _run(path, "--density-color", "rgb", "--spacing-factors", 1, 0.3) == 0
    strands = json.loads(path.with_suffix(".json").read_text())["strands"]
    points = np.concatenate([strand["points"] for strand in strands])
    assert (points[:, 0] > 0.5).sum() > 1.5 * (points[:, 0] < 0.5).sum()


@pytest.mark.parametrize(
    ("make", "extra", "words"),
    [
        (FILES["obj"], ("--density-color", "Col"), "are called rgb"),
        (lambda f: _obj(f / "a.obj", ""), ("--density-color", "rgb"), "no colours"),
        (lambda f: _ply(f / "a.ply", {}, True), ("--density-color", "rgb"), "no colours"),
        (lambda f: _obj(f / "a.obj", "a b c"), ("--density-color", "rgb"), "no numbers"),
        (FILES["floats"], ("--density-attribute", "quality"), "it has 'red'"),
        (lambda f: _ply(f / "a.ply", {}, True), ("--density-attribute", "q"), "export it as"),
        (
            lambda f: _ply(f / "a.ply", {"q": ("float", ACROSS * np.nan)}, True),
            ("--density-attribute", "q"),
            "not a finite number at vertex 0",
        ),
        (FILES["obj"], ("--density-attribute", "q"), "a .obj file has none"),
    ],
)
def test_what_is_missing_is_said(
    tmp_path: Path, capsys: pytest.CaptureFixture, make, extra: tuple, words: str
) -> None:
    assert _run(make(tmp_path), *extra) == 2
    said = capsys.readouterr().err
    assert words in said
    assert_sentence(said.removeprefix("meander: ").strip())
