# SPDX-License-Identifier: GPL-3.0-or-later
"""PLY and STL files in: whatever is a way to write a mesh gives that mesh."""

from __future__ import annotations

import random
import struct
import time
import tracemalloc
from collections.abc import Sequence
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch
from meander.model.files import meshes, whole
from sentences import assert_sentence

CORNERS = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.25), (1.0, 1.0, 0.0), (0.0, 1.0, -0.5), (2.0, 0.5, 0.125)]
POLYGONS = [(0, 1, 2, 3), (1, 4, 2)]
TRIANGLES = [[0, 1, 2], [0, 2, 3], [1, 4, 2]]
ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


def complaint(path: Path) -> str:
    with pytest.raises(whole.FileError) as caught:
        meshes.read_mesh(path)
    assert_sentence(str(caught.value))
    assert str(path) in str(caught.value)
    assert str(caught.value).isprintable()
    assert len(str(caught.value)) < 200 + len(str(path))
    return str(caught.value)


# ------------------------------------------------------------------------------------------------
# PLY


def row(order: str, kinds: str, values: Sequence[float]) -> bytes:
    """Values of types as struct calls them, as a line of text or as bytes."""
    if not order:
        words = [str(int(v)) if kind in "bBhHiI" else repr(v) for kind, v in zip(kinds, values)]
        return " ".join(words).encode() + b"\n"
    return struct.pack(order + kinds, *(int(v) if k in "bBhHiI" else v
                                        for k, v in zip(kinds, values)))  # fmt: skip


def ply(form: str, head: str, rows: list[tuple[str, Sequence[float]]]) -> bytes:
    text = f"ply\nformat {form} 1.0\ncomment made by hand\n{head}end_header\n"
    return text.encode() + b"".join(row(ORDERS[form], *entry) for entry in rows)


def plain(form: str, polygons: Sequence[Sequence[int]]) -> bytes:
    head = (
        f"element vertex {len(CORNERS)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(polygons)}\nproperty list uchar int vertex_indices\n"
    )
    rows = [("fff", corner) for corner in CORNERS]
    rows += [("B" + "i" * len(polygon), (len(polygon), *polygon)) for polygon in polygons]
    return ply(form, head, rows)


def crowded(form: str) -> bytes:
    """The mesh among all that other programs write: columns between, lists, other elements."""
    head = (
        "element material 2\nproperty uchar red\nproperty list uchar float shine\n"
        f"element vertex {len(CORNERS)}\nproperty short group\nproperty double z\n"
        "property double x\nproperty uchar red\nproperty double y\n"
        "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
        f"element face {len(POLYGONS)}\nproperty list uint8 float32 texcoord\nproperty int flags\n"
        "property list ushort uint vertex_index\nproperty uchar red\n"
        "element rest 1\nproperty float x\n"
    )
    rows: list[tuple[str, Sequence[float]]] = [("BB", (1, 0)), ("BBff", (1, 2, 0.5, 0.25))]
    rows += [("hddBd", (-7, z, x, 200, y)) for x, y, z in CORNERS]
    rows += [("ii", (0, 1))]
    for polygon in POLYGONS:
        corners = len(polygon)
        kinds = "B" + "ff" * corners + "i" + "H" + "I" * corners + "B"
        rows.append((kinds, (2 * corners, *[0.5] * (2 * corners), 3, corners, *polygon, 9)))
    return ply(form, head, [*rows, ("f", (1.0,))])


@pytest.mark.parametrize("form", ORDERS)
@pytest.mark.parametrize(
    ("make", "triangles"),
    [
        (lambda form: plain(form, POLYGONS), TRIANGLES),
        (lambda form: plain(form, TRIANGLES), TRIANGLES),
        (lambda form: plain(form, TRIANGLES).replace(b"\n", b"\r\n", 8), TRIANGLES),
        (crowded, TRIANGLES),
    ],
    ids=["polygons", "triangles", "returns", "crowded"],
)
def test_a_ply_file(tmp_path: Path, form: str, make, triangles: list) -> None:
    path = tmp_path / "mesh.PLY"
    path.write_bytes(make(form))
    vertices, faces = meshes.read_mesh(path)
    assert vertices.tolist() == [list(corner) for corner in CORNERS]
    assert faces.tolist() == triangles
    assert (vertices.dtype, faces.dtype) == (np.float64, np.uint32)


@pytest.mark.parametrize("form", ORDERS)
def test_what_is_wrong_with_the_mesh_is_left_to_the_library(tmp_path: Path, form: str) -> None:
    path = tmp_path / "mesh.ply"
    path.write_bytes(plain(form, [(0, 1, 1), (0, 1, 77)]))
    assert meshes.read_mesh(path)[1].tolist() == [[0, 1, 1], [0, 1, 77]]


WHOLE = plain("binary_little_endian", POLYGONS)
TEXT = plain("ascii", POLYGONS)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "is empty"),
        (b"ply\nformat ascii 1.0\n", "no end"),
        (WHOLE[:-1], "before the last face"),
        (WHOLE[:-30], "before the last"),
        (WHOLE.replace(b"vertex 5", b"vertex 4000000000"), "before the last vertex"),
        (WHOLE.replace(b"face 2", b"face 4000000000"), "before the last face"),
        (WHOLE.replace(b"face 2", b"face two"), "face two"),
        (WHOLE.replace(b"face 2", b"face -2"), "face -2"),
        (WHOLE.replace(b"vertex_indices", b"edges"), "no faces"),
        (WHOLE.replace(b"binary_little", b"binary_middle"), "binary_middle_endian"),
        (WHOLE.replace(b"format binary_little_endian 1.0\n", b""), "its format"),
        (WHOLE.replace(b"float z", b"float w"), "x, y and z"),
        (WHOLE.replace(b"uchar int", b"float int"), "float int"),
        (WHOLE.replace(b"float z", b"float"), "property float"),
        (TEXT.replace(b"4 0 1 2 3", b"4 0 1 2 -3"), "vertex -3"),
        (TEXT.replace(b"4 0 1 2 3", b"4 0 1 2 0.5"), "vertex 0.5"),
        (TEXT.replace(b"4 0 1 2 3", b"-4 0 1 2 3"), "-4"),
        (TEXT.replace(b"4 0 1 2 3", b"nan 0 1 2 3"), "nan"),
        (TEXT.replace(b"4 0 1 2 3", b"inf 0 1 2 3"), "inf"),
        (TEXT.replace(b"4 0 1 2 3", b"9 0 1 2 3"), "before the last"),
        # A column twice, where rows are read one by one.
        (crowded("binary_little_endian").replace(b"short group", b"short x"), "property x twice"),
        (TEXT.replace(b"float z", b"float z\nproperty float z"), "property z twice"),
        (WHOLE.replace(b"face 2", b"face \x1b[2J"), r"face \x1b"),
        (
            WHOLE.replace(
                b"element vertex",
                b"element \x1b[2J 4000000000\nproperty int a\nelement vertex",
            ),
            r"last \x1b",
        ),
        (TEXT.replace(b"4 0 1 2 3", b"4 0 1 2 " + b"x" * 999), "no number"),
    ],
)
def test_a_ply_file_that_is_malformed(tmp_path: Path, data: bytes, words: str) -> None:
    path = tmp_path / "mesh.ply"
    path.write_bytes(data)
    assert words in complaint(path)


# ------------------------------------------------------------------------------------------------
# STL


def stl(triangles: Sequence[Sequence[Sequence[float]]], head: bytes = b"") -> bytes:
    records = [head.ljust(80, b"\0"), struct.pack("<I", len(triangles))]
    for corners in triangles:
        places = (x for corner in corners for x in corner)
        records.append(struct.pack("<12fH", 0, 0, 1, *places, 513))
    return b"".join(records)


def stl_text(triangles: Sequence[Sequence[Sequence[float]]]) -> bytes:
    lines = ["solid by hand"]
    for corners in triangles:
        lines += ["facet normal 0 0 1", " outer loop"]
        lines += ["  vertex {!r} {!r} {!r}".format(*map(float, corner)) for corner in corners]
        lines += [" endloop", "endfacet"]
    return "\n".join([*lines, "endsolid by hand", ""]).encode()


PLACES = [[CORNERS[vertex] for vertex in triangle] for triangle in TRIANGLES]
# What they join to: vertices in the order in which they come.
IN_ORDER = [CORNERS[vertex] for vertex in (0, 1, 2, 3, 4)]


@pytest.mark.parametrize(
    "data",
    [stl(PLACES), stl(PLACES, b"solid as some programs begin"), stl_text(PLACES),
     stl_text(PLACES).upper()],
    ids=["binary", "binary that begins as text", "text", "capitals"],
)  # fmt: skip
def test_an_stl_file(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "mesh.stl"
    path.write_bytes(data)
    vertices, faces = meshes.read_mesh(path)
    assert vertices.tolist() == [list(corner) for corner in IN_ORDER]
    assert faces.tolist() == TRIANGLES
    assert (vertices.dtype, faces.dtype) == (np.float64, np.uint32)


def test_zero_has_no_sign(tmp_path: Path) -> None:
    path = tmp_path / "mesh.stl"
    here, there = [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(-0.0, 0, -0.0), (0, 1, 0), (-1, 0, 0)]
    path.write_bytes(stl([here, there]))
    vertices, faces = meshes.read_mesh(path)
    assert len(vertices) == 4
    assert faces.tolist() == [[0, 1, 2], [0, 2, 3]]


# ------------------------------------------------------------------------------------------------
# All of them


def test_a_file_of_another_kind(tmp_path: Path) -> None:
    assert ".obj, .ply or .stl" in complaint(tmp_path / "mesh.fbx")


@pytest.mark.parametrize("suffix", meshes.SUFFIXES)
def test_a_file_that_is_not_there(tmp_path: Path, suffix: str) -> None:
    complaint(tmp_path / f"nothing{suffix}")


def corrupted(data: bytes, rng: random.Random) -> bytes:
    """The same with a few bytes changed, taken out, put in, or there twice."""
    changed = bytearray(data)
    for _ in range(rng.randint(1, 4)):
        at, other = rng.randrange(len(changed) + 1), rng.randrange(len(changed) + 1)
        length = rng.randint(0, 6)
        changed[at : at + length] = rng.choice(
            (bytes([rng.randrange(256)]), b"", b"4000000000", b"-1", b"nan", b"1e999", b"list",
             changed[other : other + 20])
        )  # fmt: skip
    return bytes(changed)


@pytest.mark.parametrize("suffix", [".ply", ".stl"])
def test_whatever_is_in_a_file_it_is_a_mesh_or_a_sentence(tmp_path: Path, suffix: str) -> None:
    rng = random.Random(7)
    path = tmp_path / f"mesh{suffix}"
    wholes = [stl(PLACES), stl_text(PLACES)]
    if suffix == ".ply":
        wholes = [make(form) for make in (crowded, lambda form: plain(form, TRIANGLES))
                  for form in ORDERS]  # fmt: skip
    refused = 0
    for number in range(600):
        path.write_bytes(corrupted(wholes[number % len(wholes)], rng))
        try:
            vertices, faces = meshes.read_mesh(path)
        except whole.FileError as refusal:
            refused += 1
            assert "\n" not in str(refusal)
        else:
            assert vertices.shape == (len(vertices), 3) and vertices.dtype == np.float64
            assert faces.shape == (len(faces), 3) and faces.dtype == np.uint32
    assert 60 < refused < 600


@pytest.mark.parametrize("suffix", [".ply", ".stl"])
def test_memory_grows_with_the_file_not_with_its_longest_word(tmp_path: Path, suffix: str) -> None:
    """Of 20,000 words one has 20,000 letters: room for the longest for all is 400 MB."""
    path = tmp_path / f"mesh{suffix}"
    long = b"x" * 20_000
    if suffix == ".ply":
        head = b"ply\nformat ascii 1.0\nelement vertex 20000\nproperty float x\nend_header\n"
        path.write_bytes(head + b"1 " * 19_999 + long)
    else:
        path.write_bytes(b"solid\n" + b"vertex 1 2 3\n" * 6_665 + b"vertex 1 2 " + long)
    tracemalloc.start()
    try:
        complaint(path)
        assert tracemalloc.get_traced_memory()[1] < 100 * path.stat().st_size
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("suffix", [".ply", ".stl"])
def test_reading_is_fast(tmp_path: Path, suffix: str) -> None:
    """50,000 triangles in seconds, also where their rows differ."""
    sheet = geometry.grid(160)
    path = tmp_path / f"sheet{suffix}"
    if suffix == ".stl":
        path.write_bytes(stl(sheet.vertices[sheet.faces].tolist()))
    else:
        head = (
            f"element vertex {len(sheet.vertices)}\nproperty double x\nproperty double y\n"
            f"property double z\nelement face {len(sheet.faces) - 1}\n"
            "property list uchar int vertex_indices\n"
        )
        rows = [("ddd", place) for place in sheet.vertices.tolist()]
        a, b, c = sheet.faces[0].tolist()
        d = (set(sheet.faces[1].tolist()) - {a, b, c}).pop()
        rows += [("Biiii", (4, a, b, c, d))]  # so that every row is read by itself
        rows += [("Biii", (3, *face)) for face in sheet.faces[2:].tolist()]
        path.write_bytes(ply("binary_little_endian", head, rows))
    begin = time.process_time()
    vertices, faces = meshes.read_mesh(path)
    assert time.process_time() - begin < 5.0
    assert len(faces) == len(sheet.faces)
    assert len(vertices) == len(sheet.vertices)


def test_the_command_fills_the_same_mesh_from_every_kind_of_file(tmp_path: Path) -> None:
    """Coordinates that single precision holds give the same curve to the last byte."""
    mesh = geometry.grid(8)  # eighths
    assert (mesh.vertices.astype(np.float32) == mesh.vertices).all()
    # In the order in which an STL file has them.
    order = list(dict.fromkeys(mesh.faces.ravel().tolist()))
    vertices = mesh.vertices[order]
    faces = np.argsort(order)[mesh.faces]
    geometry.write_obj(tmp_path / "mesh.obj", geometry.Mesh(vertices, faces))
    (tmp_path / "mesh.stl").write_bytes(stl(vertices[faces].tolist()))
    head = (
        f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\n"
    )
    rows = [("fff", place) for place in vertices.tolist()]
    rows += [("Biii", (3, *face)) for face in faces.tolist()]
    (tmp_path / "mesh.ply").write_bytes(ply("binary_big_endian", head, rows))
    curves = []
    for suffix in meshes.SUFFIXES:
        out = tmp_path / f"curve_{suffix[1:]}.obj"
        given = ["--input", str(tmp_path / f"mesh{suffix}"), "--output", str(out), "--quiet"]
        assert batch.main([*given, "--spacing", "0.2"]) == 0
        curves.append(out.read_bytes())
    assert curves[0] == curves[1] == curves[2]
