# SPDX-License-Identifier: GPL-3.0-or-later
"""Spacings by the colours, numbers and UVs that OBJ, PLY and STL files have."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import fill
from meander import batch
from meander.cli import density
from meander.model.density import Choice
from meander.model.files import meshes
from meander.model.picture.image import read_image
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


def _density(choice: Choice, path: Path) -> np.ndarray:
    count = len(meshes.read(path).vertices)
    return choice.density(density.values_of_file(choice, path, count, read_image))


@pytest.mark.parametrize("name", FILES)
def test_colours_are_a_density(tmp_path: Path, name: str) -> None:
    path = FILES[name](tmp_path)
    found = _density(Choice("COLOR", "rgb", factors=(1.0, 0.5)), path)
    assert len(found) == len(meshes.read(path).vertices)
    assert found == pytest.approx((1.0 - 0.5 * ACROSS) ** -2.0, rel=0.02)


@pytest.mark.parametrize("binary", [False, True])
def test_numbers_of_a_ply_are_a_density(tmp_path: Path, binary: bool) -> None:
    path = _ply(tmp_path / "a.ply", {"quality": ("float", 7 * ACROSS - 3)}, binary)
    found = _density(Choice("ATTRIBUTE", "quality", factors=(1.0, 0.5)), path)
    assert found == pytest.approx((1.0 - 0.5 * ACROSS) ** -2.0, rel=1e-5)


def _run(path: Path, *extra: object) -> int:
    return fill(path, path.with_suffix(".json"), "--spacing", 0.12, "--quiet", *extra)


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
        (
            lambda f: _obj(f / "a.obj", "1 nan 1"),
            ("--density-color", "rgb"),
            "not a finite number at vertex 1 of",
        ),
        (FILES["obj"], ("--density-attribute", "q"), "a .obj file has none"),
        (lambda f: _stl(f, [0] * 128), ("--density-color", "rgb"), "no colours of vertices or"),
        (lambda f: _stl(f, [0] * 128), ("--density-attribute", "q"), "a .stl file has none"),
        (lambda f: _stl(f, [0] * 128), ("--density-image", "image.png"), "needs UVs, which a .stl"),
        (FILES["obj"], ("--density-image", "image.png"), "has no UVs; unwrap the mesh"),
        (FILES["floats"], ("--tone-image", "image.png", "--pen", 0.01), "has no UVs; unwrap"),
        (lambda f: _mapped(f), ("--density-image", "none.png"), "none.png does not exist"),
        (lambda f: _mapped(f), ("--density-image", "folder"), "--density-image folder is a folder"),
        (lambda f: _mapped(f), ("--density-image", "text.png"), "cannot be read as a picture"),
        (
            lambda f: _mapped(f),
            ("--density-image", "image.png", "--uv-map", "Two"),
            "--uv-map Two names one of a .blend; a .obj file has one at most",
        ),
        (lambda f: _mapped(f, "vt nan 0"), ("--density-image", "image.png"), "not finite numbers"),
        (lambda f: _mapped(f, "vt a b"), ("--density-image", "image.png"), "UVs that are no numb"),
        (lambda f: _mapped(f, corner="{0}/999"), ("--density-image", "image.png"), "is not there"),
        (
            lambda f: _mapped(f, more="f 1 2 3"),
            ("--density-image", "image.png"),
            "faces without UVs",
        ),
        (lambda f: _wedges(f, 4), ("--density-image", "image.png"), "faces without UVs"),
    ],
)
def test_what_is_missing_is_said(
    tmp_path: Path,
    capsys: pytest.CaptureFixture,
    monkeypatch: pytest.MonkeyPatch,
    make,
    extra: tuple,
    words: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    if "image.png" in extra:
        _picture(tmp_path)
    (tmp_path / "folder").mkdir()
    (tmp_path / "text.png").write_text("no picture")
    assert _run(make(tmp_path), *extra) == 2
    said = capsys.readouterr().err
    assert words in said
    assert_sentence(said.removeprefix("meander: ").strip())


# ------------------------------------------------------------------------------------------------
# Faces and their corners


def _stl(folder: Path, attributes: list[int], head: bytes = b"") -> Path:
    """A binary STL file of the same mesh, with an attribute for each triangle."""
    corners = np.asarray(MESH.vertices, dtype="<f4")[np.asarray(MESH.faces)]
    path = folder / "a.stl"
    rows = [
        bytes(12) + three.tobytes() + struct.pack("<H", attribute)
        for three, attribute in zip(corners, attributes, strict=True)
    ]
    path.write_bytes(head.ljust(80, b"\0") + struct.pack("<I", len(rows)) + b"".join(rows))
    return path


def _middle(face: np.ndarray) -> float:
    return float(ACROSS[np.asarray(face)].mean())


# Red to the left of the middle, white to the right of it.
LEFT = [_middle(face) < 0.5 for face in MESH.faces]
RED = 0.2126  # its brightness


@pytest.mark.parametrize("dialect", ["solidview", "magics", "magics, by the head"])
def test_colours_of_the_triangles_of_an_stl(tmp_path: Path, dialect: str) -> None:
    white = 0x7FFF
    if dialect == "solidview":
        head, values = b"", [0x8000 | (31 << 10) if left else 0x8000 | white for left in LEFT]
    elif dialect == "magics":
        head, values = b"COLOR=" + bytes(4), [31 if left else white for left in LEFT]
    else:
        head, values = b"COLOR=\xff\0\0\xff", [0x8000 if left else white for left in LEFT]
    path = _stl(tmp_path, values, head)
    choice = Choice("COLOR", "rgb")
    places = meshes.read(path).vertices[:, 0]
    found = density.values_of_file(choice, path, len(places), read_image)
    assert found[places < 0.45] == pytest.approx(RED, abs=1e-9)
    assert found[places > 0.55] == pytest.approx(1.0, abs=1e-9)


def _faces_ply(folder: Path, columns: str, rows: list[str]) -> Path:
    """A text PLY whose faces have more columns, with a vertex more that no face has."""
    path = folder / "a.ply"
    head = ["ply", "format ascii 1.0", f"element vertex {len(MESH.vertices) + 1}"]
    head += [f"property double {axis}" for axis in "xyz"]
    head += [f"element face {len(MESH.faces)}", "property list uchar int vertex_indices"]
    places = ["{} {} {}".format(*place) for place in np.asarray(MESH.vertices).tolist()]
    faces = [
        "3 {} {} {} ".format(*face) + row
        for face, row in zip(np.asarray(MESH.faces).tolist(), rows, strict=True)
    ]
    path.write_text("\n".join([*head, columns, "end_header", *places, "0.5 0.5 0", *faces, ""]))
    return path


def test_colours_and_numbers_of_faces_of_a_ply(tmp_path: Path) -> None:
    channels = "\n".join(f"property uchar {name}" for name in ("red", "green", "blue"))
    path = _faces_ply(tmp_path, channels, ["255 0 0" if left else "255 255 255" for left in LEFT])
    count = len(MESH.vertices) + 1
    found = density.values_of_file(Choice("COLOR", "rgb"), path, count, read_image)[:-1]
    assert found[ACROSS < 0.45] == pytest.approx(RED, abs=1e-9)
    assert found[ACROSS > 0.55] == pytest.approx(1.0, abs=1e-9)
    path = _faces_ply(tmp_path, "property int part", ["3" if left else "5" for left in LEFT])
    found = density.values_of_file(Choice("ATTRIBUTE", "part"), path, count, read_image)
    assert found[:-1][ACROSS < 0.45] == pytest.approx(3.0)
    assert found[:-1][ACROSS > 0.55] == pytest.approx(5.0)
    # What no face has does not widen the range.
    assert found.min() == 3.0


def _picture(folder: Path) -> Path:
    """An image that is dark at the bottom and bright at the top, in steps of sRGB."""
    pillow = pytest.importorskip("PIL.Image")
    rows = np.linspace(255, 0, 64).round().astype(np.uint8)
    path = folder / "image.png"
    pillow.fromarray(np.tile(rows[:, None], (1, 8))).save(path)
    return path


def _mapped(
    folder: Path, first: str = "", corner: str = "{0}/{0}", more: str = "", turn: int = 0
) -> Path:
    """An OBJ whose UVs are its places: u along x, v along y, moved by whole squares."""
    path = folder / "a.obj"
    places = np.asarray(MESH.vertices).tolist()
    lines = ["v {} {} {}".format(*place) for place in places]
    uvs = [f"vt {place[0] + turn} {place[1] + turn}" for place in places]
    lines += [first or uvs[0], *uvs[1:]]
    for face in np.asarray(MESH.faces).tolist():
        lines.append("f " + " ".join(corner.format(k + 1, k - len(places)) for k in face))
    path.write_text("\n".join([*lines, more, ""]))
    return path


def _wedges(folder: Path, count: int = 6) -> Path:
    places = np.asarray(MESH.vertices)
    rows = [
        " ".join(map(str, [count, *places[face][:, :2].ravel()[:count]]))
        for face in np.asarray(MESH.faces)
    ]
    return _faces_ply(folder, "property list uchar float texcoord", rows)


UP = np.asarray(MESH.vertices)[:, 1]
MAPPED = {
    "obj": lambda f: _mapped(f),
    "obj, from the end": lambda f: _mapped(f, corner="{1}/{1}"),
    "obj, with normals": lambda f: _mapped(f, corner="{0}/{0}/1"),
    "obj, another square": lambda f: _mapped(f, turn=-3),
    "ply, of corners": _wedges,
    "ply, of vertices": lambda f: _ply(
        f / "a.ply", {"s": ("float", ACROSS), "t": ("float", UP)}, binary=True
    ),
}


@pytest.mark.parametrize("name", MAPPED)
def test_an_image_lies_on_the_uvs_of_a_file(tmp_path: Path, name: str) -> None:
    path, image = MAPPED[name](tmp_path), _picture(tmp_path)
    count = len(meshes.read(path).vertices)
    found = density.values_of_file(Choice("IMAGE", str(image)), path, count, read_image)
    wanted = np.where(UP <= 0.04045, UP / 12.92, ((UP + 0.055) / 1.055) ** 2.4)
    # At its edges it is repeated, and the two rows there are the brightest and the darkest.
    inside = (UP > 0.05) & (UP < 0.95)
    assert found[: len(UP)][inside] == pytest.approx(wanted[inside], abs=0.02)


def test_the_curve_is_closer_where_an_image_is_bright(tmp_path: Path) -> None:
    path, image = _mapped(tmp_path), _picture(tmp_path)
    assert _run(path, "--density-image", image, "--spacing-factors", 1, 0.3) == 0
    strands = json.loads(path.with_suffix(".json").read_text())["strands"]
    points = np.concatenate([strand["points"] for strand in strands])
    assert (points[:, 1] > 0.5).sum() > 1.3 * (points[:, 1] < 0.5).sum()


@pytest.mark.parametrize("option", ["--output", "--report"])
def test_the_image_is_not_overwritten(
    tmp_path: Path, option: str, capsys: pytest.CaptureFixture
) -> None:
    path, image = _mapped(tmp_path), _picture(tmp_path)
    victim = image.rename(tmp_path / "image.json")
    before = victim.read_bytes()
    assert _run(path, "--density-image", victim, option, victim) == 2
    assert f"{option} would overwrite --density-image" in capsys.readouterr().err
    assert victim.read_bytes() == before


@pytest.mark.parametrize(
    ("most", "kind"),
    [(255, "{0:.0f} {0:.0f} {0:.0f}"), (65535, "{0:.0f} {0:.0f} {0:.0f}")],
)
def test_whole_numbers_of_an_obj_count_to_their_most(tmp_path: Path, most: int, kind: str) -> None:
    whole = _obj(tmp_path / "whole.obj", kind)
    scaled = [
        " ".join([*words[:4], *(f"{round(most * float(word))}" for word in words[4:])])
        for words in (line.split() for line in _obj(tmp_path / "one.obj").read_text().splitlines())
        if words[0] == "v"
    ]
    faces = [line for line in whole.read_text().splitlines() if line.startswith("f ")]
    whole.write_text("\n".join([*scaled, *faces, ""]))
    found, wanted = (
        density.values_of_file(Choice("COLOR", "rgb"), path, len(MESH.vertices), read_image)
        for path in (whole, tmp_path / "one.obj")
    )
    assert np.allclose(found, wanted, atol=2.5 / most)
    assert wanted.min() == 0.0 and wanted.max() == 1.0


@pytest.mark.parametrize("color", ["-1 0 0", "1.5 0 0", "70000 0 0"])
def test_colours_that_are_none_are_said(tmp_path: Path, color: str, capsys) -> None:
    mesh = _obj(tmp_path / "a.obj", color)
    output = ["--output", str(tmp_path / "o.obj"), "--spacing", "0.2", "--density-color", "rgb"]
    assert batch.main(["--input", str(mesh), *output]) == 2
    said = capsys.readouterr().err.strip()
    assert "has colours that are neither numbers from 0 to 1 nor whole ones from 0 to 255" in said
    assert_sentence(said.removeprefix("meander: "))


@pytest.mark.parametrize(
    ("extra", "color", "words"),
    [
        ([], "0.5 0.5 0.5", "everywhere"),
        (["--density-range", "2", "3"], "{0:.9g} {0:.9g} {0:.9g}", "another --density-range"),
        (["--spacing-factors", "1", "1"], "{0:.9g} {0:.9g} {0:.9g}", "or other factors"),
        ([], "{0:.9g} {0:.9g} {0:.9g}", ""),
    ],
)
def test_a_density_without_effect_is_said(tmp_path, capsys, extra, color, words) -> None:
    mesh = _obj(tmp_path / "a.obj", color)
    report = tmp_path / "r.json"
    argv = ["--input", mesh, "--output", tmp_path / "o.obj", "--spacing", "0.2", "--quiet"]
    argv += ["--iterations", "2", "--density-color", "rgb", "--report", report, *extra]
    assert batch.main([str(word) for word in argv]) == 0
    said = capsys.readouterr().err
    warnings = json.loads(report.read_text())["warnings"]
    assert ("the density makes the spacing" in said) == bool(words) == bool(warnings)
    for warning in warnings:
        assert_sentence(warning)
    assert words in said


def test_factors_may_be_as_far_apart_as_each_may_be(tmp_path: Path) -> None:
    mesh = _obj(tmp_path / "a.obj")
    argv = ["--input", mesh, "--output", tmp_path / "o.obj", "--spacing", "0.2", "--quiet"]
    argv += ["--iterations", "1", "--density-color", "rgb", "--spacing-factors", "5", "0.05"]
    assert batch.main([str(word) for word in argv]) == 0
