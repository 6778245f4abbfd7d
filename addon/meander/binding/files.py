# SPDX-License-Identifier: GPL-3.0-or-later
"""What the native library reads and writes of files: the text that has too many lines for Python,
and the triangles of polygons.

Nothing cancels these; an interruption leaves them alone with what they were given."""

from __future__ import annotations

from ctypes import byref, c_char_p, c_size_t
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .abi import PolygonsRecord, Text, TrianglesRecord
from .calls import Found, call
from .handle import address_of, checked_array
from .interruption import heard
from .native_library import native


class TextPolygons(NamedTuple):
    """Points and polygons of a text.

    positions  (n, 3) float64
    corners    (c,) uint32: places in `positions`, of one polygon after another
    ends       (m,) uint64: where the corners of each polygon end
    lines      (m,) uint32: in which line of the text it begins, from 1
    left_out   faces of fewer than three corners
    """

    positions: NDArray[np.float64]
    corners: NDArray[np.uint32]
    ends: NDArray[np.uint64]
    lines: NDArray[np.uint32]
    left_out: int


def read_polygons(text: bytes, kind: Text) -> TextPolygons:
    """See meander_text_read_polygons.

    Raises MeanderError of the status INVALID_MESH, whose sentence begins with the line.
    """
    found = Found(PolygonsRecord)
    record = heard(
        lambda: found.fill(native().meander_text_read_polygons, text, len(text), int(kind)), None
    )
    return TextPolygons(
        found.array("positions", record.point_count, 3),
        found.array("corners", record.corner_count),
        found.array("ends", record.polygon_count),
        found.array("lines", record.polygon_count),
        record.left_out,
    )


def read_numbers(text: bytes, begin: int = 0) -> tuple[NDArray[np.float64], int]:
    """The numbers of a text from a place on, and where something else stands, or the text ends.

    See meander_text_read_numbers.
    """
    source = np.frombuffer(text, np.uint8)[begin:]
    # Words are at most one more than what parts them.
    room = 1 + sum(text.count(blank, begin) for blank in (b" ", b"\t", b"\n", b"\r", b"\v", b"\f"))
    numbers = np.empty(room)
    count, end = c_size_t(), c_size_t()
    heard(
        lambda: call(
            native().meander_text_read_numbers,
            c_char_p(address_of(source)),
            len(source),
            address_of(numbers),
            room,
            byref(count),
            byref(end),
        ),
        None,
    )
    return numbers[: count.value], begin + end.value


def text_rows(pattern: str, values: ArrayLike) -> bytes:
    """The text of rows of numbers, (n, columns) float64; see meander_text_write_rows.

    pattern   what a row is, with a form for each column, such as "v %.17g %.17g %.17g\\n". %.3r is
              %.3f without zeros at the end, and without the sign of 0; %% is a %

    A call lasts as long as its rows are many: give some ten thousand, so that an interruption is
    heard. Raises MeanderError for a pattern that means nothing, or has another number of columns.
    """
    table = np.ascontiguousarray(values, dtype=np.float64)
    of_pattern, (count, columns) = pattern.encode("ascii"), table.shape
    parts, done, size, rows = [], 0, c_size_t(), c_size_t()
    # Enough for all in most cases, and always for one of them.
    text = np.empty(330 * columns + (24 * columns + len(of_pattern)) * (count + 1), np.uint8)
    while True:
        call(
            native().meander_text_write_rows,
            of_pattern,
            address_of(table[done:]),
            count - done,
            columns,
            c_char_p(address_of(text)),
            len(text),
            byref(size),
            byref(rows),
        )
        parts.append(text[: size.value].tobytes())
        done += rows.value
        if done == count:
            return b"".join(parts)


def triangulated(
    vertices: ArrayLike, corners: ArrayLike, ends: ArrayLike
) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]:
    """The triangles of polygons as Blender makes them, (m, 3), and the polygon of each, (m,).

    vertices  (n, 3) float64
    corners   (c,) uint32, of one polygon after another
    ends      (p,) where the corners of each polygon end

    See meander_polygons_triangulate. Raises MeanderError for ends that do not fit.
    """
    vertex_array = checked_array("vertices", vertices, np.float64, 3)
    corner_array = checked_array("corners", corners, np.uint32, None)
    end_array = checked_array("ends", ends, np.uint64, None)
    found = Found(TrianglesRecord)
    record = heard(
        lambda: found.fill(
            native().meander_polygons_triangulate,
            address_of(vertex_array),
            len(vertex_array),
            address_of(corner_array),
            len(corner_array),
            address_of(end_array),
            len(end_array),
        ),
        None,
    )
    return found.array("corners", record.count, 3), found.array("polygons", record.count)
