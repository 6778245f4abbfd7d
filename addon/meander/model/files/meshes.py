# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes in files of their own, by the file's suffix: numpy only, no bpy."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ... import core
from .obj import read_obj
from .ply import read_ply
from .polygons import MeshOfFile
from .stl import read_stl
from .text import read_plain
from .whole import FileError

_READERS = {".obj": read_obj, ".ply": read_ply, ".stl": read_stl}
SUFFIXES = tuple(_READERS)


def read(path: str | Path) -> MeshOfFile:
    """Reads the mesh in an OBJ, PLY or STL file, in the file's own coordinates.

    Polygons become the triangles that Blender makes of them. What is wrong with the mesh itself is
    passed on, since the library names it; see in_file().

    Raises FileError: the file cannot be read, is of another kind or malformed, has no faces.
    """
    path = Path(path)
    reader = _READERS.get(path.suffix.lower())
    if reader is None:
        kinds = ", ".join(SUFFIXES[:-1])
        raise FileError(f"{path} is no {kinds} or {SUFFIXES[-1]} file; export the mesh as one")
    mesh = reader(path)
    mesh.path = path
    return mesh


def read_mesh(path: str | Path) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """The vertices (n, 3) and triangles (m, 3), zero-based, of read()."""
    mesh = read(path)
    return mesh.vertices, mesh.faces


def in_file(error: core.MeanderError, mesh: MeshOfFile) -> core.MeanderError:
    """An error about a mesh, with its faces and vertices as the file counts them; others as they
    are."""
    if error.status != core.Status.INVALID_MESH:
        return error

    def face(match: re.Match[str]) -> str:
        number = int(match[0])
        if number >= len(mesh.faces):
            return match[0]
        polygon = number if mesh.polygons is None else int(mesh.polygons[number])
        line = ""
        if mesh.lines is not None and polygon < len(mesh.lines):
            line = f" (line {mesh.lines[polygon]})"
        return f"{polygon + mesh.first}{line}"

    def line_of_vertex(number: int) -> str:
        """Looked for in the file again: nobody else wants to know."""
        if mesh.path is None or mesh.path.suffix.lower() != ".obj":
            return ""
        try:
            text = read_plain(mesh.path)
        except FileError:  # it has gone meanwhile
            return ""
        places = re.finditer(rb"^[ \t]*v[ \t]", text.replace(b"\r\n", b"\n"), re.MULTILINE)
        found = next(itertools.islice(places, number, None), None)
        if found is None:
            return ""
        line = found.string.count(b"\n", 0, found.start()) + 1
        return f" (line {line})"

    def vertex(match: re.Match[str]) -> str:
        number = int(match[0])
        if not mesh.joined:
            return f"{number + mesh.first}{line_of_vertex(number)}"
        x, y, z = mesh.vertices[number]
        return f"at {x:.6g} {y:.6g} {z:.6g}"

    def each(change: Callable[[re.Match[str]], str]) -> Callable[[re.Match[str]], str]:
        return lambda match: re.sub(r"\d+", change, match[0])

    text = re.sub(r"(?<=[Ff]ace )\d+|(?<=faces \()[\d, ]+", each(face), str(error))
    text = re.sub(r"(?<=[Vv]ertex )\d+|(?<=vertices )\d+ and \d+", each(vertex), text)
    return core.MeanderError(text, error.status, error.element_kind, error.elements)
