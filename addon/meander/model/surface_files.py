# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes in files of their own, by the file's suffix: numpy only, no bpy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .mesh_files import read_obj_mesh
from .ply_files import read_ply_mesh
from .stl_files import read_stl_mesh
from .whole_files import FileError

_READERS = {".obj": read_obj_mesh, ".ply": read_ply_mesh, ".stl": read_stl_mesh}
SUFFIXES = tuple(_READERS)


def read_mesh(path: str | Path) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Reads the mesh in an OBJ, PLY or STL file, in the file's own coordinates.

    Returns vertices (n, 3) and triangles (m, 3), zero-based; polygons are fanned from their first
    corner. What is wrong with the mesh itself is passed on, since the library names it.

    Raises FileError: the file cannot be read, is of another kind or malformed, has no faces.
    """
    path = Path(path)
    reader = _READERS.get(path.suffix.lower())
    if reader is None:
        kinds = ", ".join(SUFFIXES[:-1])
        raise FileError(f"{path} is no {kinds} or {SUFFIXES[-1]} file; export the mesh as one")
    return reader(path)
