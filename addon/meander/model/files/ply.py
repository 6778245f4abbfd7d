# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes in PLY files, binary and text: numpy only, no bpy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ... import core
from .polygons import MeshOfFile, left_out, triangles_of
from .text import read_plain, told_apart
from .whole import FileError

# Both generations of names.
_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "int64": "i8", "uint64": "u8",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip
# The byte order of each format; None: text.
_ORDERS = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}
_CORNERS = ("vertex_indices", "vertex_index")
_LARGEST_INDEX = 0xFFFFFFFF
_WANTED = {"vertex", "face", "tristrips"}
_QUOTED = 40


@dataclass(frozen=True)
class _Property:
    """A column: its type in numpy's words, and for a list that of the number before it."""

    name: str
    kind: str
    length_kind: str = ""


@dataclass
class _Element:
    name: str
    count: int
    properties: list[_Property] = field(default_factory=list)


@dataclass(frozen=True)
class _Table:
    """The rows of an element: scalars by name, and of each list its lengths and all its items."""

    scalars: dict[str, NDArray]
    lists: dict[str, tuple[NDArray, NDArray]]


class _Malformed(Exception):
    """What is wrong with a file, as the middle of a sentence."""


class _Short(_Malformed):
    """It ends before what its header counts."""


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
    except _Malformed as problem:
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


def read_ply_mesh(path: str | Path) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """The vertices (n, 3) and triangles (m, 3), zero-based, of read_ply()."""
    mesh = read_ply(Path(path))
    return mesh.vertices, mesh.faces


def read_vertex_numbers(path: Path) -> dict[str, NDArray]:
    """The columns of the vertices of a PLY file, (n,) each, that are no lists, by name; in a text
    float64 whatever their type.

    Raises FileError as read_ply() does.
    """
    data = read_plain(path)
    try:
        order, elements, begin = _header(data)
        table = _tables(data, begin, order, elements).get("vertex")
    except _Malformed as problem:
        raise FileError(f"{path} {problem}; export it again") from problem
    return {} if table is None else {name: column for name, column in table.scalars.items()}


def _header(data: bytes) -> tuple[str | None, list[_Element], int]:
    """The byte order, the elements in their order, and where the rows begin."""
    if data[:3] != b"ply":
        raise _Malformed("is no PLY file")
    order: str | None = ""
    elements: list[_Element] = []
    at = 0
    while True:
        end = data.find(b"\n", at)
        if end < 0:
            raise _Malformed("has no end of its PLY header")
        words = data[at:end].decode("latin-1").split()
        at = end + 1
        try:
            if words[:1] == ["end_header"]:
                break
            if words[:1] == ["format"]:
                order = _ORDERS[words[1]]
            elif words[:1] == ["element"]:
                elements.append(_Element(words[1], int(words[2])))
                if elements[-1].count < 0:
                    raise ValueError
            elif words[:1] == ["property"]:
                found = _property(words[1:])
                if any(other.name == found.name for other in elements[-1].properties):
                    raise _Malformed(f"has a property {_quoted(found.name)} twice")
                elements[-1].properties.append(found)
        except (KeyError, IndexError, ValueError):
            line = _quoted(" ".join(words))
            raise _Malformed(f"has a line in its PLY header that means nothing ({line})") from None
    if order == "":
        raise _Malformed("does not say its format in its PLY header")
    return order, elements, at


def _quoted(text: str) -> str:
    """The beginning of what stands in a header, without control characters."""
    return repr(text[:60])[1:-1]


def _property(words: list[str]) -> _Property:
    if words[0] == "list":
        length_kind = _TYPES[words[1]]
        if length_kind[0] == "f":
            raise ValueError
        return _Property(words[3], _TYPES[words[2]], length_kind)
    return _Property(words[1], _TYPES[words[0]])


def _tables(
    data: bytes, begin: int, order: str | None, elements: list[_Element]
) -> dict[str, _Table]:
    """The rows of the elements up to the last one that is wanted."""
    wanted = _WANTED & {element.name for element in elements}
    source: NDArray | bytes = data
    no_number = -1
    if order is None:
        source, end = core.read_numbers(data, begin)
        begin = 0
        no_number = end if data[end : end + 1] else -1
    tables: dict[str, _Table] = {}
    for element in elements:
        if wanted <= tables.keys():
            break
        rows = _Rows(element, source, begin, order)
        try:
            tables[element.name] = rows.table()
        except _Short:
            if no_number < 0:
                raise
            word = data[no_number : no_number + _QUOTED].split(None, 1)[0]
            line = data.count(b"\n", 0, no_number) + 1
            raise _Malformed(
                f"holds something that is no number in line {line} "
                f"({_quoted(repr(word.decode('latin-1')))})"
            ) from None
        begin = rows.end
    return tables


class _Rows:
    """Reads the rows of one element, from the numbers of a text or from bytes."""

    def __init__(
        self, element: _Element, source: NDArray | bytes, begin: int, order: str | None
    ) -> None:
        self.element, self.source, self.end, self.order = element, source, begin, order

    def table(self) -> _Table:
        """All rows; `end` is behind them afterwards."""
        if not self.element.count or not self.element.properties:
            return _Table({}, {})
        begin = self.end
        # Most files have rows of one shape: that of the first one.
        lengths = self._row_lengths()
        self.end = begin
        return self._uniform(lengths) or self._one_by_one()

    def _take(self, kind: str, count: int) -> NDArray:
        """The next values, behind which `end` is then."""
        if self.order is None:
            taken = self.source[self.end : self.end + count]
            if len(taken) < count:
                raise self._short()
            self.end += count
            return taken
        dtype = np.dtype(self.order + kind)
        if self.end + count * dtype.itemsize > len(self.source):
            raise self._short()
        taken = np.frombuffer(self.source, dtype, count, self.end)
        self.end += count * dtype.itemsize
        return taken

    def _row_lengths(self) -> list[int]:
        """Of the lists of the row that begins here."""
        lengths = []
        for row_property in self.element.properties:
            if row_property.length_kind:
                lengths.append(_length(self._take(row_property.length_kind, 1)[0]))
                self._take(row_property.kind, lengths[-1])
            else:
                self._take(row_property.kind, 1)
        return lengths

    def _uniform(self, lengths: list[int]) -> _Table | None:
        """All rows, if their lists are as long as these; None: they are not."""
        count, given = self.element.count, iter(lengths)
        # Of each column: the property, or None for the length of a list; its type; its width.
        columns: list[tuple[_Property | None, str, int]] = []
        for row_property in self.element.properties:
            width = 1
            if row_property.length_kind:
                width = next(given)
                columns.append((None, row_property.length_kind, 1))
            columns.append((row_property, row_property.kind, width))
        blocks = self._blocks([(kind, width) for _property, kind, width in columns])
        if blocks is None:
            if not lengths:
                raise self._short()
            return None
        table = _Table({}, {})
        wanted = None
        for (row_property, _kind, width), block in zip(columns, blocks):
            if row_property is None:
                wanted = block
                continue
            if not row_property.length_kind:
                table.scalars[row_property.name] = block.reshape(-1)
            elif (wanted != width).any():
                return None
            else:
                table.lists[row_property.name] = (np.full(count, width), block.reshape(-1))
        self.end += self._row_size([(kind, width) for _property, kind, width in columns]) * count
        return table

    def _row_size(self, shape: list[tuple[str, int]]) -> int:
        """Of a row of columns of these types and widths: in numbers of a text, or in bytes."""
        if self.order is None:
            return sum(width for _kind, width in shape)
        return sum(width * np.dtype(kind).itemsize for kind, width in shape)

    def _blocks(self, shape: list[tuple[str, int]]) -> list[NDArray] | None:
        """Columns of these types and widths, each (count, width); None: there are not as many."""
        count, size = self.element.count, self._row_size(shape)
        if self.end + count * size > len(self.source):
            return None
        rows = self.source[self.end : self.end + count * size]
        if self.order is None:
            ends = np.cumsum([width for _kind, width in shape])
            return np.split(rows.reshape(count, size), ends[:-1], axis=1)
        names = [str(number) for number in range(len(shape))]
        row = np.dtype([
            (name, self.order + kind, (width,)) for name, (kind, width) in zip(names, shape)
        ])  # fmt: skip
        table = np.frombuffer(rows, row, count)
        return [table[name] for name in names]

    def _width(self, kind: str) -> int:
        """Of a value: in numbers of a text, or in bytes."""
        return 1 if self.order is None else np.dtype(kind).itemsize

    def _one_by_one(self) -> _Table:
        """Rows of different lengths: first where everything lies, one row after the other."""
        properties = self.element.properties
        scalars: dict[str, tuple[str, list[int]]] = {}
        lists: dict[str, tuple[str, list[int], list[int]]] = {}
        # Per column: width of a value; for a list the type and the width of its length, and where
        # its begins and lengths go; for others where their places go.
        steps = []
        for row_property in properties:
            width = self._width(row_property.kind)
            if row_property.length_kind:
                begins: list[int] = []
                lengths: list[int] = []
                lists[row_property.name] = (row_property.kind, begins, lengths)
                kind = row_property.length_kind
                steps.append((width, kind, self._width(kind), begins, lengths))
            else:
                places: list[int] = []
                scalars[row_property.name] = (row_property.kind, places)
                steps.append((width, "", 0, places, places))
        at, size = self.end, len(self.source)
        read = self._length_reader()
        for _row in range(self.element.count):
            for width, kind, length_width, begins, lengths in steps:
                if not kind:
                    begins.append(at)
                    at += width
                    continue
                if at + length_width > size:
                    raise self._short()
                length = read(at, kind)
                at += length_width
                begins.append(at)
                lengths.append(length)
                at += length * width
            if at > size:
                raise self._short()
        self.end = at
        return _Table(
            {
                name: self._gathered(kind, np.array(places))
                for name, (kind, places) in scalars.items()
            },
            {
                name: (
                    np.array(lengths),
                    self._gathered(kind, _runs(begins, lengths, self._width(kind))),
                )
                for name, (kind, begins, lengths) in lists.items()
            },
        )

    def _length_reader(self) -> Callable[[int, str], int]:
        """What reads the length of a list at a place."""
        source, order = self.source, self.order
        if order is None:
            return lambda at, _kind: _length(source[at])
        end = "little" if order == "<" else "big"

        def read(at: int, kind: str) -> int:
            if kind == "u1":
                return source[at]
            width = int(kind[1:])
            taken = int.from_bytes(source[at : at + width], end, signed=kind[0] == "i")
            return _length(taken)

        return read

    def _gathered(self, kind: str, places: NDArray[np.int64]) -> NDArray:
        """The values at places of the source."""
        if self.order is None:
            return self.source[places]
        dtype = np.dtype(self.order + kind)
        data = np.frombuffer(self.source, np.uint8)
        taken = np.empty((len(places), dtype.itemsize), np.uint8)
        for byte in range(dtype.itemsize):
            taken[:, byte] = data[places + byte]
        return taken.view(dtype).reshape(-1)

    def _short(self) -> _Short:
        element = self.element
        return _Short(
            f"ends before the last {_quoted(element.name)} that its header counts "
            f"({element.count:,})"
        )


def _length(value: float) -> int:
    if not (0 <= value <= _LARGEST_INDEX and value == int(value)):
        raise _Malformed(f"has a list of {value:g} values")
    return int(value)


def _runs(begins: list[int], lengths: list[int], width: int) -> NDArray[np.int64]:
    """The places of all items of lists that begin at places and have lengths."""
    counts = np.array(lengths, dtype=np.int64)
    before = np.cumsum(counts) - counts
    within = np.arange(counts.sum()) - np.repeat(before, counts)
    return np.repeat(np.array(begins, dtype=np.int64), counts) + width * within


def _vertices(table: _Table | None) -> NDArray[np.float64]:
    try:
        if table is None:
            raise KeyError
        columns = [np.asarray(table.scalars[axis]).reshape(-1) for axis in "xyz"]
    except KeyError:
        raise _Malformed("has no vertices with x, y and z") from None
    return np.column_stack(columns).astype(np.float64)


def _polygons(table: _Table | None) -> tuple[NDArray[np.int64], NDArray[np.uint32]]:
    """How many corners every face has, and all corners."""
    found = [table.lists[name] for name in _CORNERS if table is not None and name in table.lists]
    if not found:
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.uint32)
    lengths, corners = found[0]
    return lengths, _indices(corners, 0).astype(np.uint32)


def _indices(corners: NDArray, least: int) -> NDArray:
    wrong = ~((corners >= least) & (corners < _LARGEST_INDEX) & (corners == np.floor(corners)))
    if wrong.any():
        raise _Malformed(f"has a face with a vertex {corners[np.argmax(wrong)]:g}")
    return corners


def _strips(table: _Table | None) -> NDArray[np.uint32]:
    """The triangles of strips: every second one is turned, and -1 ends a strip."""
    found = [table.lists[name] for name in _CORNERS if table is not None and name in table.lists]
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
