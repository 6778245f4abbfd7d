# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes in PLY files, binary and text: numpy only, no bpy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ... import core
from .ply_rows import (
    CORNERS,
    LARGEST_INDEX,
    TYPES,
    Element,
    Malformed,
    Property,
    Rows,
    Short,
    Table,
    quoted,
)
from .polygons import MeshOfFile, left_out, triangles_of
from .text import read_plain, told_apart
from .whole import FileError

# The byte order of each format; None: text.
_ORDERS = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}
_WANTED = {"vertex", "face", "tristrips"}
_QUOTED = 40


def read_ply(path: Path) -> MeshOfFile:
    """Reads the vertices, faces and triangle strips of a PLY file; whatever else it holds is
    ignored, also behind the last of them.

    Polygons become the triangles that Blender makes of them; faces of fewer than three corners are
    left out. Indices past the last vertex and coordinates that are not finite are passed on, since
    the library names them.

    Raises FileError: the file cannot be read, is malformed, has no faces.
    """
    data = read_plain(path)
    other = told_apart(data, ".ply")
    if other:
        raise FileError(f"{path} is {other}, and no PLY file; export the mesh as one")
    try:
        order, elements, begin = _header(data)
        tables = _tables(data, begin, order, elements)
        vertices = _vertices(tables.get("vertex"))
        lengths, corners = _polygons(tables.get("face"))
        strips = _strips(tables.get("tristrips"))
    except Malformed as problem:
        raise FileError(f"{path} {problem}; export it again") from problem
    few = lengths < 3
    numbers = None
    if few.any():
        numbers = np.flatnonzero(~few)
        corners, lengths = corners[np.repeat(~few, lengths)], lengths[~few]
    faces, polygons = triangles_of(vertices, corners, np.cumsum(lengths))
    if numbers is not None:
        polygons = numbers if polygons is None else numbers[polygons]
    if len(strips):
        faces, polygons = np.concatenate([faces, strips]), None
    if not len(faces):
        raise FileError(f"{path} has no faces; give a mesh with triangles")
    return MeshOfFile(vertices, faces, left_out(int(few.sum())), polygons, first=0)


def read_tables(path: Path) -> dict[str, Table]:
    """The rows of the vertices, "vertex", and of the faces, "face", of a PLY file, where it has
    them; numbers of a text are float64 whatever their type.

    Raises FileError as read_ply() does.
    """
    data = read_plain(path)
    try:
        order, elements, begin = _header(data)
        return _tables(data, begin, order, elements)
    except Malformed as problem:
        raise FileError(f"{path} {problem}; export it again") from problem


def corners_of(path: Path, faces: Table) -> tuple[NDArray[np.int64], NDArray[np.uint32]]:
    """How many corners every face of read_tables() has, and the vertices of all corners."""
    try:
        return _polygons(faces)
    except Malformed as problem:
        raise FileError(f"{path} {problem}; export it again") from problem


def _header(data: bytes) -> tuple[str | None, list[Element], int]:
    """The byte order, the elements in their order, and where the rows begin."""
    if data[:3] != b"ply":
        raise Malformed("is no PLY file")
    order: str | None = ""
    elements: list[Element] = []
    at = 0
    line_end = b"\r" if data[3:4] == b"\r" and data[4:5] != b"\n" else b"\n"
    while True:
        end = data.find(line_end, at)
        if end < 0:
            raise Malformed("has no end of its PLY header")
        words = data[at:end].decode("latin-1").split()
        at = end + 1
        try:
            if words[:1] == ["end_header"]:
                break
            if words[:1] == ["format"]:
                order = _ORDERS[words[1]]
            elif words[:1] == ["element"]:
                elements.append(Element(words[1], int(words[2])))
                if elements[-1].count < 0:
                    raise ValueError
            elif words[:1] == ["property"]:
                found = _property(words[1:])
                if any(other.name == found.name for other in elements[-1].properties):
                    raise Malformed(f"has a property {quoted(found.name)} twice")
                elements[-1].properties.append(found)
        except (KeyError, IndexError, ValueError):
            line = quoted(" ".join(words))
            raise Malformed(f"has a line in its PLY header that means nothing ({line})") from None
    if order == "":
        raise Malformed("does not say its format in its PLY header")
    return order, elements, at


def _property(words: list[str]) -> Property:
    if words[0] == "list":
        length_kind = TYPES[words[1]]
        if length_kind[0] == "f":
            raise ValueError
        return Property(words[3], TYPES[words[2]], length_kind)
    return Property(words[1], TYPES[words[0]])


def _tables(
    data: bytes, begin: int, order: str | None, elements: list[Element]
) -> dict[str, Table]:
    """The rows of the elements up to the last one that is wanted."""
    wanted = _WANTED & {element.name for element in elements}
    source: NDArray | bytes = data
    no_number = -1
    if order is None:
        source, end = core.read_numbers(data, begin)
        begin = 0
        no_number = end if data[end : end + 1] else -1
    tables: dict[str, Table] = {}
    for element in elements:
        if wanted <= tables.keys():
            break
        rows = Rows(element, source, begin, order)
        try:
            tables[element.name] = rows.table()
        except Short:
            if no_number < 0:
                raise
            word = data[no_number : no_number + _QUOTED].split(None, 1)[0]
            line = data.count(b"\n", 0, no_number) + 1
            raise Malformed(
                f"holds something that is no number in line {line} "
                f"({quoted(repr(word.decode('latin-1')))})"
            ) from None
        begin = rows.end
    return tables


def _vertices(table: Table | None) -> NDArray[np.float64]:
    try:
        if table is None:
            raise KeyError
        columns = [np.asarray(table.scalars[axis]).reshape(-1) for axis in "xyz"]
    except KeyError:
        raise Malformed("has no vertices with x, y and z") from None
    return np.column_stack(columns).astype(np.float64)


def _polygons(table: Table | None) -> tuple[NDArray[np.int64], NDArray[np.uint32]]:
    """How many corners every face has, and all corners."""
    found = [table.lists[name] for name in CORNERS if table is not None and name in table.lists]
    if not found:
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.uint32)
    lengths, corners = found[0]
    return lengths, _indices(corners, 0).astype(np.uint32)


def _indices(corners: NDArray, least: int) -> NDArray:
    wrong = ~((corners >= least) & (corners < LARGEST_INDEX) & (corners == np.floor(corners)))
    if wrong.any():
        raise Malformed(f"has a face with a vertex {corners[np.argmax(wrong)]:g}")
    return corners


def _strips(table: Table | None) -> NDArray[np.uint32]:
    """The triangles of strips: every second one is turned, and -1 ends a strip."""
    found = [table.lists[name] for name in CORNERS if table is not None and name in table.lists]
    triangles = [np.empty((0, 3), dtype=np.int64)]
    for lengths, corners in found[:1]:
        corners = _indices(corners, -1).astype(np.int64)
        for strip in np.split(corners, np.cumsum(lengths)[:-1]):
            for run in np.split(strip, np.flatnonzero(strip < 0)):
                run = run[run >= 0]
                if len(run) < 3:
                    continue
                three = np.column_stack([run[:-2], run[1:-1], run[2:]])
                three[1::2] = three[1::2][:, [1, 0, 2]]
                # Corners that are repeated steer a strip, and are no faces.
                a, b, c = three.T
                triangles.append(three[(a != b) & (b != c) & (c != a)])
    return np.concatenate(triangles).astype(np.uint32)
