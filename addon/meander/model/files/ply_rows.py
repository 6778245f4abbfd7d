# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the elements of a .ply file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

# Both generations of names.
TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "int64": "i8", "uint64": "u8",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip


CORNERS = ("vertex_indices", "vertex_index")


LARGEST_INDEX = 0xFFFFFFFF


@dataclass(frozen=True)
class Property:
    """A column: its type in numpy's words, and for a list that of the number before it."""

    name: str
    kind: str
    length_kind: str = ""


@dataclass
class Element:
    name: str
    count: int
    properties: list[Property] = field(default_factory=list)


@dataclass(frozen=True)
class Table:
    """The rows of an element: scalars by name, and of each list its lengths and all its items."""

    scalars: dict[str, NDArray]
    lists: dict[str, tuple[NDArray, NDArray]]


class Malformed(Exception):
    """What is wrong with a file, as the middle of a sentence."""


class Short(Malformed):
    """It ends before what its header counts."""


class Rows:
    """Reads the rows of one element, from the numbers of a text or from bytes."""

    def __init__(
        self, element: Element, source: NDArray | bytes, begin: int, order: str | None
    ) -> None:
        self.element, self.source, self.end, self.order = element, source, begin, order

    def table(self) -> Table:
        """All rows; `end` is behind them afterwards."""
        if not self.element.count or not self.element.properties:
            return Table({}, {})
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

    def _uniform(self, lengths: list[int]) -> Table | None:
        """All rows, if their lists are as long as these; None: they are not."""
        count, given = self.element.count, iter(lengths)
        # Of each column: the property, or None for the length of a list; its type; its width.
        columns: list[tuple[Property | None, str, int]] = []
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
        table = Table({}, {})
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

    def _one_by_one(self) -> Table:
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
        return Table(
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

    def _short(self) -> Short:
        element = self.element
        return Short(
            f"ends before the last {quoted(element.name)} that its header counts "
            f"({element.count:,})"
        )


def _length(value: float) -> int:
    if not (0 <= value <= LARGEST_INDEX and value == int(value)):
        raise Malformed(f"has a list of {value:g} values")
    return int(value)


def _runs(begins: list[int], lengths: list[int], width: int) -> NDArray[np.int64]:
    """The places of all items of lists that begin at places and have lengths."""
    counts = np.array(lengths, dtype=np.int64)
    before = np.cumsum(counts) - counts
    within = np.arange(counts.sum()) - np.repeat(before, counts)
    return np.repeat(np.array(begins, dtype=np.int64), counts) + width * within


def quoted(text: str) -> str:
    """The beginning of what stands in a header, without control characters."""
    return repr(text[:60])[1:-1]
