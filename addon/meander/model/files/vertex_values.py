# SPDX-License-Identifier: GPL-3.0-or-later
"""What mesh files say of their vertices besides where they are: colours and numbers; no bpy.

Files are read again for it, so that those who do not ask for it have no memory taken.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .ply import read_vertex_numbers
from .text import read_plain
from .whole import FileError

# What the colours of a file are called, which have no name in it.
COLORS = "rgb"
_CHANNELS = ("red", "green", "blue")
_PLACE = ("x", "y", "z")
_OBJ_VERTEX = re.compile(rb"^[ \t]*v[ \t]+([^\r\n#]*)", re.MULTILINE)


def vertex_colors(path: Path) -> NDArray[np.float64]:
    """The colours of the vertices of an OBJ or PLY file, (n, 3), sRGB from 0 to 1.

    Raises FileError: it has none.
    """
    kind = path.suffix.lower()
    if kind == ".ply":
        numbers = read_vertex_numbers(path)
        if all(name in numbers for name in _CHANNELS):
            columns = [numbers[name] for name in _CHANNELS]
            whole = max(
                (np.iinfo(c.dtype).max for c in columns if c.dtype.kind in "iu"), default=1
            )
            colors = np.column_stack(columns).astype(np.float64)
            # Text has no types; whole numbers count to 255.
            return colors / (255.0 if whole == 1 and colors.max(initial=0.0) > 1.0 else whole)
    elif kind == ".obj":
        rows = [row.split() for row in _OBJ_VERTEX.findall(read_plain(path))]
        if rows and all(len(row) >= 6 for row in rows):
            # With seven numbers the fourth is the weight of a point.
            first = 4 if all(len(row) == 7 for row in rows) else 3
            try:
                return np.array([row[first : first + 3] for row in rows]).astype(np.float64)
            except ValueError:
                raise FileError(f"{path} has colours that are no numbers; correct them") from None
    raise FileError(
        f"{path} has no colours of vertices; export it as a .ply with them, or give a .blend to "
        "--input"
    )


def vertex_numbers(path: Path, name: str) -> NDArray[np.float64]:
    """The values of a property of the vertices of a PLY file, (n,). Raises FileError: none is
    called so."""
    numbers = read_vertex_numbers(path) if path.suffix.lower() == ".ply" else {}
    if name in numbers:
        return numbers[name].astype(np.float64)
    known = ", ".join(f"'{each}'" for each in numbers if each not in _PLACE)
    raise FileError(
        f"{path} has no numbers '{name}' of vertices; "
        + (f"it has {known}" if known else "export it as a .ply with them")
    )
