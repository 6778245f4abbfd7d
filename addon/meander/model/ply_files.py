# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes in PLY files, binary and text: numpy only, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .numbers_in_text import NoNumber, numbers_of
from .whole_files import FileError, read_bytes

# Both generations of names.
_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip
# The byte order of each format; None: text.
_ORDERS = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}
_CORNERS = ("vertex_indices", "vertex_index")
_LARGEST_INDEX = 0xFFFFFFFF


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


def read_ply_mesh(path: str | Path) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Reads the vertices and faces of a PLY file; whatever else it holds is ignored.

    Returns vertices (n, 3) and triangles (m, 3), zero-based; polygons are fanned from their first
    corner. Indices past the last vertex and coordinates that are not finite are passed on, since
    the library names them.

    Raises FileError: the file cannot be read, is malformed, has no faces.
    """
    path = Path(path)
    data = read_bytes(path)
    try:
        order, elements, begin = _header(data)
        tables = _tables(data, begin, order, elements)
        vertices = _vertices(tables.get("vertex"))
        faces = _triangles(tables.get("face"))
    except _Malformed as problem:
        raise FileError(f"{path} {problem}; export it again") from problem
    if not len(faces):
        raise FileError(f"{path} has no faces; give a mesh with triangles")
    return vertices, faces


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
    """The rows of the elements up to vertices and faces."""
    values = None
    if order is None:
        try:
            values = numbers_of(data[begin:].split())
        except NoNumber as problem:
            raise _Malformed(f"holds something that is no number ({problem})") from None
        begin = 0
    tables: dict[str, _Table] = {}
    for element in elements:
        if {"vertex", "face"} <= tables.keys():
            break
        rows = _Rows(element, values if values is not None else data, begin, order)
        tables[element.name] = rows.table()
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

    def _length(self, row_property: _Property) -> int:
        value = self._take(row_property.length_kind, 1)[0]
        if not (0 <= value <= _LARGEST_INDEX and value == int(value)):
            raise _Malformed(f"has a list of {value:g} values")
        return int(value)

    def _row_lengths(self) -> list[int]:
        """Of the lists of the row that begins here."""
        lengths = []
        for row_property in self.element.properties:
            if row_property.length_kind:
                lengths.append(self._length(row_property))
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

    def _one_by_one(self) -> _Table:
        """Rows of different lengths."""
        properties = self.element.properties
        scalars: dict[str, list] = {p.name: [] for p in properties if not p.length_kind}
        lists: dict[str, list] = {p.name: [] for p in properties if p.length_kind}
        for _row in range(self.element.count):
            for row_property in properties:
                if row_property.length_kind:
                    taken = self._take(row_property.kind, self._length(row_property))
                    lists[row_property.name].append(taken)
                else:
                    scalars[row_property.name].append(self._take(row_property.kind, 1))
        return _Table(
            {name: np.concatenate(found) for name, found in scalars.items()},
            {
                name: (np.array([len(taken) for taken in found]), np.concatenate(found))
                for name, found in lists.items()
            },
        )

    def _short(self) -> _Malformed:
        name = _quoted(self.element.name)
        return _Malformed(f"ends before the last {name} that its header counts")


def _vertices(table: _Table | None) -> NDArray[np.float64]:
    try:
        if table is None:
            raise KeyError
        columns = [np.asarray(table.scalars[axis]).reshape(-1) for axis in "xyz"]
    except KeyError:
        raise _Malformed("has no vertices with x, y and z") from None
    return np.column_stack(columns).astype(np.float64)


def _triangles(table: _Table | None) -> NDArray[np.uint32]:
    """Polygons fanned from their first corners."""
    found = [table.lists[name] for name in _CORNERS if table is not None and name in table.lists]
    if not found:
        return np.empty((0, 3), dtype=np.uint32)
    lengths, corners = found[0]
    if (lengths < 3).any():
        face = int(np.argmax(lengths < 3))
        raise _Malformed(f"has a face, number {face} from 0, of fewer than three vertices")
    wrong = ~((corners >= 0) & (corners < _LARGEST_INDEX) & (corners == np.floor(corners)))
    if wrong.any():
        raise _Malformed(f"has a face with a vertex {corners[np.argmax(wrong)]:g}")
    corners = corners.astype(np.uint32)
    fans = lengths - 2
    # Of every triangle: where its polygon begins, and its place in the fan.
    first = np.repeat(np.cumsum(lengths) - lengths, fans)
    place = np.arange(fans.sum()) - np.repeat(np.cumsum(fans) - fans, fans)
    return np.column_stack([corners[first], corners[first + place + 1], corners[first + place + 2]])
