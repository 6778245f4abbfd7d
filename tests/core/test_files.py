# SPDX-License-Identifier: GPL-3.0-or-later
"""OBJ files in and out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from meander import core
from meander.model.files import meshes, obj, whole
from sentences import assert_sentence

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


@pytest.fixture
def file_of(tmp_path: Path):
    def write(text: str) -> Path:
        path = tmp_path / "given.obj"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def complaint(call, *arguments) -> str:
    with pytest.raises(whole.FileError) as caught:
        call(*arguments)
    assert_sentence(str(caught.value))
    return str(caught.value)


# ------------------------------------------------------------------------------------------------
# Meshes


@pytest.mark.parametrize(
    ("face", "triangles"),
    [
        ("f 1 2 3", [[0, 1, 2]]),
        ("f 1/5 2/6 3/7", [[0, 1, 2]]),
        ("f 1//5 2//6 3//7", [[0, 1, 2]]),
        ("f 1/5/1 2/6/1 3/7/1", [[0, 1, 2]]),
        ("f -4 -3 -1", [[0, 1, 3]]),
        ("f 1 2 3 4", [[0, 1, 2], [0, 2, 3]]),
        ("f 1 2 \\\n 3", [[0, 1, 2]]),
        ("f 1 2 3\nf 1 3 4", [[0, 1, 2], [0, 2, 3]]),
        # for the library to name:
        ("f 1 2 2", [[0, 1, 1]]),
    ],
)
def test_faces(file_of, face: str, triangles: list) -> None:
    vertices, faces = meshes.read_mesh(file_of(SQUARE + face + "\n"))
    assert faces.tolist() == triangles
    assert vertices.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert (vertices.dtype, faces.dtype) == (np.float64, np.uint32)


def test_everything_else_in_a_file_is_ignored(file_of) -> None:
    text = (
        "# comment\r\nmtllib a.mtl\r\no thing\r\nv 0 0 0 1.0\r\n\tv 1e0 0 0 0.5 0.5 0.5\r\n"
        "v +1 1 -0\r\nvt 0 0\r\nvn 0 0 1\r\n\r\ns off\r\nusemtl x\r\nf 1 2 3\r\nl 1 2\r\n"
    )
    vertices, faces = meshes.read_mesh(file_of(text))
    assert vertices.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0]]
    assert faces.tolist() == [[0, 1, 2]]


def test_not_a_number_is_left_to_the_library(file_of) -> None:
    vertices, _ = meshes.read_mesh(file_of("v nan 0 0\nv 1 0 inf\nv 1 1 0\nf 1 2 3\n"))
    assert np.isnan(vertices[0, 0]) and np.isinf(vertices[1, 2])


@pytest.mark.parametrize(
    "text",
    [
        "f\n",
        SQUARE + "f 1 2\n",
        SQUARE + "f 1 2 1.5\n",
        SQUARE + "f 1 2 99999999999\n",
        "v a b c\nf 1 1 1\n",
        "v\nf 1 1 1\n",
    ],
)
def test_malformed_mesh_beside_those_of_file_cases(file_of, text: str) -> None:
    path = file_of(text)
    assert str(path) in complaint(obj.read_obj, path)


def test_missing_file(tmp_path: Path) -> None:
    complaint(obj.read_obj, tmp_path / "nothing.obj")
    complaint(obj.read_obj_curve, tmp_path / "nothing.obj")
    complaint(obj.read_obj, tmp_path)


# ------------------------------------------------------------------------------------------------
# Curves


@pytest.mark.parametrize(
    ("lines", "strands", "closed"),
    [
        ("l 1 2 3 4", [[0, 1, 2, 3]], [0]),
        ("l 1 2 3 4 1", [[0, 1, 2, 3]], [1]),
        ("l 1/1 2/2 3/3", [[0, 1, 2]], [0]),
        ("l -4 -3 -2", [[0, 1, 2]], [0]),
        ("l 1 2\nl 2 3\nl 3 4", [[0, 1, 2, 3]], [0]),
        ("l 1 2\nl 2 3\nl 3 4\nl 4 1", [[0, 1, 2, 3]], [1]),
        ("l 2 3\nl 1 2\nl 4 3", [[0, 1, 2, 3]], [0]),
        ("l 1 2 3\nl 3 4 1", [[0, 1, 2, 3]], [1]),
        ("l 3 4\nl 1 2", [[2, 3], [0, 1]], [0, 0]),
        ("l 1 1 2 3", [[0, 1, 2]], [0]),
    ],
)
def test_strands(file_of, lines: str, strands: list, closed: list) -> None:
    seed = obj.read_obj_curve(file_of(SQUARE + lines + "\n"))
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    assert seed.points.tolist() == corners[np.concatenate(strands)].tolist()
    assert seed.offsets.tolist() == np.cumsum([0] + [len(s) for s in strands]).tolist()
    assert seed.closed.tolist() == closed
    assert seed.fixed is None
    assert (seed.points.dtype, seed.offsets.dtype, seed.closed.dtype) == (
        np.float64,
        np.uint32,
        np.uint8,
    )


def test_same_place_at_both_ends_is_closed(file_of) -> None:
    seed = obj.read_obj_curve(file_of(SQUARE + "v 0 0 0\nl 1 2 3 4 5\n"))
    assert seed.closed.tolist() == [1] and len(seed.points) == 4


@pytest.mark.parametrize(
    "text",
    [
        "",
        SQUARE,
        SQUARE + "f 1 2 3\n",
        SQUARE + "l 1\n",
        SQUARE + "l 2 2\n",
        SQUARE + "l 0 1\n",
        SQUARE + "l 1 b\n",
        SQUARE + "l 1 9\n",
        SQUARE + "l -8 1\n",
        SQUARE + "l 1 2\nl 2 1\n",
        SQUARE + "l 1 2 3\nl 2 4\n",  # a branch
        SQUARE + "l 1 2 3 4 2\n",  # a loop on a stem
    ],
)
def test_malformed_curve(file_of, text: str) -> None:
    complaint(obj.read_obj_curve, file_of(text))


def some_curve() -> core.Polylines:
    random = np.random.default_rng(7)
    positions = random.normal(size=(12, 3)) * 10.0 ** random.integers(-9, 9, size=(12, 3))
    return core.Polylines(
        positions,
        np.zeros_like(positions),
        np.array([0, 5, 8, 12], dtype=np.uint32),
        np.array([1, 0, 1], dtype=np.uint8),
    )


def test_curve_survives_a_file(tmp_path: Path) -> None:
    curve = some_curve()
    path = tmp_path / "curve.obj"
    obj.write_obj_curve(path, curve)
    seed = obj.read_obj_curve(path)
    assert seed.points.tobytes() == curve.positions.tobytes()
    assert seed.offsets.tolist() == curve.offsets.tolist()
    assert seed.closed.tolist() == curve.closed.tolist()
    assert [item.name for item in tmp_path.iterdir()] == ["curve.obj"]


def test_failed_writing_leaves_all_as_it_was(tmp_path: Path) -> None:
    path = tmp_path / "kept.obj"
    path.write_text("before")
    with pytest.raises(RuntimeError), whole.whole_file(path) as temporary:
        temporary.write_text("half")
        raise RuntimeError
    assert path.read_text() == "before"
    assert [item.name for item in tmp_path.iterdir()] == ["kept.obj"]
    complaint(obj.write_obj_curve, tmp_path / "no" / "folder.obj", some_curve())


def test_who_starts_a_process_names_its_temporary_files(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setenv(whole.TEMPORARY_NAMES, "ours-")
    names = set()
    for _ in range(2):
        with whole.whole_file(tmp_path / "out.obj") as temporary:
            names.add(temporary.name)
            temporary.write_text("x")
    assert all(name.startswith(".ours-") and name.endswith(".tmp.obj") for name in names)
    assert len(names) == 2
