# SPDX-License-Identifier: GPL-3.0-or-later
"""What the native library reads of mesh files: the text that has too many lines for Python, and the
triangles of polygons."""

from __future__ import annotations

from ctypes import byref, c_char_p, c_size_t
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .abi import Text
from .native_library import address_of, call, checked_array, native


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
    blanks = text.count(b" ") + text.count(b"\t") + text.count(b"\n") + text.count(b"\r")
    if kind == Text.STL:
        # Others are so few that they are read twice.
        point_room = text.count(b"vertex") + text.count(b"VERTEX")
        corner_room, polygon_room = point_room, point_room // 3 + 1
    else:
        point_room = text.count(b"v ") + text.count(b"v\t")
        letter = b"l" if kind == Text.OBJ_LINES else b"f"
        polygon_room = text.count(letter + b" ") + text.count(letter + b"\t")
        corner_room = blanks + 1
    while True:
        # What is not written into takes no memory.
        positions = np.empty((point_room, 3))
        corners = np.empty(corner_room, np.uint32)
        ends, lines = np.empty(polygon_room, np.uint64), np.empty(polygon_room, np.uint32)
        counts = [c_size_t() for _ in range(4)]
        call(
            native().meander_text_read_polygons,
            text,
            len(text),
            int(kind),
            address_of(positions),
            point_room,
            byref(counts[0]),
            address_of(corners),
            corner_room,
            byref(counts[1]),
            address_of(ends),
            address_of(lines),
            polygon_room,
            byref(counts[2]),
            byref(counts[3]),
        )
        points, corner_count, polygons, left_out = (count.value for count in counts)
        if points <= point_room and corner_count <= corner_room and polygons <= polygon_room:
            return TextPolygons(
                positions[:points],
                corners[:corner_count],
                ends[:polygons],
                lines[:polygons],
                left_out,
            )
        point_room, corner_room, polygon_room = points, corner_count, polygons


def read_numbers(text: bytes, begin: int = 0) -> tuple[NDArray[np.float64], int]:
    """The numbers of a text from a place on, and where something else stands, or the text ends.

    See meander_text_read_numbers.
    """
    source = np.frombuffer(text, np.uint8)[begin:]
    # Words are at most one more than what parts them.
    room = 1 + sum(text.count(blank, begin) for blank in (b" ", b"\t", b"\n", b"\r", b"\v", b"\f"))
    numbers = np.empty(room)
    count, end = c_size_t(), c_size_t()
    call(
        native().meander_text_read_numbers,
        c_char_p(address_of(source)),
        len(source),
        address_of(numbers),
        room,
        byref(count),
        byref(end),
    )
    return numbers[: count.value], begin + end.value


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
    room = max(len(corner_array), 1)
    triangles, polygons = np.empty((room, 3), np.uint32), np.empty(room, np.uint32)
    count = c_size_t()
    call(
        native().meander_polygons_triangulate,
        address_of(vertex_array),
        len(vertex_array),
        address_of(corner_array),
        len(corner_array),
        address_of(end_array),
        len(end_array),
        address_of(triangles),
        address_of(polygons),
        room,
        byref(count),
    )
    return triangles[: count.value].copy(), polygons[: count.value].copy()
