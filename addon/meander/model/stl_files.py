# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes in STL files, binary and text: numpy only, no bpy."""

from __future__ import annotations

import re
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .numbers_in_text import NoNumber, numbers_of
from .whole_files import FileError, read_bytes

_HEAD = 84  # bytes before the first triangle of a binary file: 80 for people, then the number
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_CORNER = re.compile(rb"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)", re.IGNORECASE)


def read_stl_mesh(path: str | Path) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Reads the triangles of an STL file; corners at the same place become one vertex.

    Returns vertices (n, 3), in the order in which they first occur, and triangles (m, 3),
    zero-based. Normals and attributes are ignored; coordinates that are not finite are passed on,
    since the library names them.

    Raises FileError: the file cannot be read, is malformed, has no faces.
    """
    path = Path(path)
    data = read_bytes(path)
    count = int.from_bytes(data[80:_HEAD], "little")
    # Binary files may begin with "solid" as well, so their size decides.
    if len(data) >= _HEAD and len(data) == _HEAD + _TRIANGLE.itemsize * count:
        corners = np.frombuffer(data, _TRIANGLE, count, _HEAD)["corners"].reshape(-1, 3)
    elif data.lstrip()[:5].lower() == b"solid":
        corners = _corners_of_text(path, data)
    else:
        raise FileError(f"{path} is no whole STL file; export it again")
    if not len(corners):
        raise FileError(f"{path} has no faces; give a mesh with triangles")
    # Adding zero turns -0.0 into 0.0, which is the same place.
    return _joined(corners.astype(np.float64) + 0.0)


def _corners_of_text(path: Path, data: bytes) -> NDArray[np.float64]:
    found = _CORNER.findall(data)
    if len(found) % 3:
        raise FileError(f"{path} ends within a triangle; export it again")
    try:
        return numbers_of(list(chain.from_iterable(found))).reshape(-1, 3)
    except NoNumber as problem:
        raise FileError(
            f"{path} has a vertex without three coordinates ({problem}); export it again"
        ) from problem


def _joined(corners: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Vertices and triangles of corners (3 m, 3), three a triangle."""
    rows = np.ascontiguousarray(corners).view(np.dtype((np.void, 24))).ravel()
    _, first, place = np.unique(rows, return_index=True, return_inverse=True)
    order = np.argsort(first)  # unique sorts by bytes, which would depend on the machine
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    faces = rank[place.ravel()].reshape(-1, 3).astype(np.uint32)
    return corners[first[order]], faces
