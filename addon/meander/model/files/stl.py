# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes in STL files, binary and text: numpy only, no bpy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ... import core
from .polygons import MeshOfFile, left_out, triangles_of
from .text import in_file, read_plain, told_apart
from .whole import FileError

_HEAD = 84  # bytes before the first triangle of a binary file: 80 for people, then the number
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
# Odd numbers without a pattern, by which coordinates are mixed.
_FACTORS = (0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9)

# Words that a text has near its beginning, whatever it begins with.
_WORDS = (b"facet", b"vertex", b"outer")
_LOOKED_AT = 4096
_LONGEST_NAME = 65536


def read_stl(path: Path) -> MeshOfFile:
    """Reads the triangles of an STL file; corners at the same place become one vertex.

    Vertices are in the order in which they first occur. Loops of more than three corners become the
    triangles that Blender makes of them. Normals and attributes are ignored, and so is what stands
    behind the triangles that a binary file counts; coordinates that are not finite are passed on,
    since the library names them.

    Raises FileError: the file cannot be read, is malformed, has no faces.
    """
    data = read_plain(path)
    count, size = int.from_bytes(data[80:_HEAD], "little"), len(data) - _HEAD
    # Binary files may begin with "solid" as well, so their size decides.
    if size >= 0 and size == _TRIANGLE.itemsize * count:
        return _of_bytes(path, data, count)
    if _is_text(data):
        return _of_text(path, data)
    other = told_apart(data, ".stl")
    if other or size < 0:
        raise FileError(f"{path} is {other or 'no STL file'}; export the mesh as STL")
    there = size // _TRIANGLE.itemsize
    if count == 0 or there < count:
        raise FileError(
            f"{path} says that it has {_triangles(count)}, but it has room for {there:,}; export "
            "it again"
        )
    mesh = _of_bytes(path, data, count)
    behind = size - _TRIANGLE.itemsize * count
    mesh.remarks.append(
        f"{path} says that it has {_triangles(count)}, which were read; {_bytes(behind)} "
        "behind them, and were passed over"
    )
    return mesh


def is_stl(data: bytes) -> bool:
    """Whether bytes without a name are an STL file: text that says so, or of just the size."""
    count, size = int.from_bytes(data[80:_HEAD], "little"), len(data) - _HEAD
    if count > 0 and size == _TRIANGLE.itemsize * count:
        return True
    head = data[:_LOOKED_AT].lower()
    return head.lstrip().startswith(b"solid") and b"facet" in head and b"\0" not in head


def facet_colors(path: Path) -> tuple[NDArray[np.float64], NDArray[np.uint32]] | None:
    """The colours of the triangles of a binary STL file, (m, 3) sRGB from 0 to 1, and the vertices
    of read_stl() at their corners, (m, 3); None: it has none.

    Two dialects have them, in 15 bits of the attribute: that of Magics, whose head names the colour
    of triangles without one, and that of VisCAM and SolidView, where they are white.
    """
    data = read_plain(path)
    count = int.from_bytes(data[80:_HEAD], "little")
    if count == 0 or len(data) < _HEAD + _TRIANGLE.itemsize * count:
        return None
    facets = np.frombuffer(data, _TRIANGLE, count, _HEAD)
    bits = facets["attribute"].astype(np.int64)
    place = data[:80].find(b"COLOR=")
    of_magics = 0 <= place <= 80 - 10
    own = (bits & 0x8000 == 0) == of_magics
    if not (own.any() or of_magics):
        return None
    colors = np.column_stack([bits & 31, bits >> 5 & 31, bits >> 10 & 31]) / 31.0
    others = np.frombuffer(data, np.uint8, 3, place + 6) / 255.0 if of_magics else np.ones(3)
    colors = np.where(own[:, None], colors if of_magics else colors[:, ::-1], others)
    return colors, _joined(facets["corners"].reshape(-1, 3))[1].reshape(-1, 3)


def _bytes(count: int) -> str:
    return "1 byte stands" if count == 1 else f"{count:,} bytes stand"


def _triangles(count: int) -> str:
    return "1 triangle" if count == 1 else f"{count:,} triangles"


def _is_text(data: bytes) -> bool:
    # Some systems fill the last block of a text with zeros.
    head = data[:_LOOKED_AT].rstrip(b"\0").lower()
    if b"\0" in head:
        return False
    return head.lstrip().startswith(b"solid") or any(word in head for word in _WORDS)


def _of_bytes(path: Path, data: bytes, count: int) -> MeshOfFile:
    corners = np.frombuffer(data, _TRIANGLE, count, _HEAD)["corners"].reshape(-1, 3)
    if not len(corners):
        raise FileError(f"{path} has no faces; give a mesh with triangles")
    vertices, places = _joined(corners)
    return MeshOfFile(vertices, places.reshape(-1, 3), joined=True)


def _of_text(path: Path, data: bytes) -> MeshOfFile:
    try:
        found = core.read_polygons(data, core.Text.STL)
    except core.MeanderError as problem:
        if problem.status != core.Status.INVALID_MESH:
            raise
        raise in_file(path, problem) from problem
    if not len(found.ends):
        raise FileError(f"{path} has no faces; give a mesh with triangles")
    vertices, places = _joined(found.positions)
    faces, polygons = triangles_of(vertices, places[found.corners], found.ends)
    if not len(faces):
        raise FileError(f"{path} has no faces with an area; give a mesh with triangles")
    mesh = MeshOfFile(
        vertices, faces, left_out(found.left_out), polygons, found.lines, joined=True
    )
    # Cut off between two triangles it reads like a whole one.
    if data[:64].lstrip().lower().startswith(b"solid") and b"endsolid" not in _end_of(data):
        mesh.remarks.append(
            f"{path} has no endsolid, so it may have been cut off; "
            f"{_triangles(len(found.ends))} stood there"
        )
    return mesh


def _end_of(data: bytes) -> bytes:
    """In small letters, with room for a long name."""
    return data[-_LONGEST_NAME:].lower()


def _joined(
    corners: NDArray[np.floating],
) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """The places of corners (c, 3), each once in the order of their first corners, and the place of
    each corner."""
    # Adding zero turns -0.0 into 0.0, which is the same place. The numbers that stand for three
    # coordinates are sorted in a tenth of the time that rows of bytes take.
    corners = np.ascontiguousarray(corners, dtype=np.float64) + 0.0
    words = corners.view(np.uint64)
    mixed = np.zeros(len(words), np.uint64)
    for axis, factor in enumerate(_FACTORS):
        mixed += words[:, axis] * np.uint64(factor)
        mixed ^= mixed >> np.uint64(29)
    _, first, place = np.unique(mixed, return_index=True, return_inverse=True)
    place = place.ravel()
    if (words[first[place]] != words).any():  # two places that have the same number
        rows = words.view(np.dtype((np.void, 24))).ravel()
        _, first, place = np.unique(rows, return_index=True, return_inverse=True)
        place = place.ravel()
    order = np.argsort(first)
    rank = np.empty(len(order), np.uint32)
    rank[order] = np.arange(len(order), dtype=np.uint32)
    return corners[first[order]], rank[place]
