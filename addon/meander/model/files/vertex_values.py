# SPDX-License-Identifier: GPL-3.0-or-later
"""What mesh files say of their surface besides where it is: colours, numbers and UVs; no bpy.

Files are read again for it, so that those who do not ask for it have no memory taken.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .ply import corners_of, read_tables
from .ply_rows import Table
from .stl import facet_colors
from .text import read_plain
from .whole import FileError

# What the colours of a file are called, which have no name in it.
COLORS = "rgb"
_CHANNELS = ("red", "green", "blue")
_PLACE = ("x", "y", "z")
# What programs call the UVs of vertices in a PLY file, and those of the corners of a face.
_UVS = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"), ("texture_s", "texture_t"))
_UVS_OF_FACES = "texcoord"
_OBJ_VERTEX = re.compile(rb"^[ \t]*v[ \t]+([^\r\n#]*)", re.MULTILINE)
_OBJ_GOES_ON = re.compile(rb"\\[ \t]*\r?\n")


class Found(NamedTuple):
    """Values that a file has.

    values     a row for each vertex, or for each corner of a face
    vertices   (c,) of the corners, as the mesh's reader counts them; None: they are of vertices
    """

    values: NDArray[np.float64]
    vertices: NDArray[np.integer] | None = None


def colors_of(path: Path) -> Found:
    """The colours of the vertices, or of the faces, of an OBJ, PLY or STL file, (n, 3), sRGB from 0
    to 1.

    Raises FileError: it has none.
    """
    kind, found = path.suffix.lower(), None
    if kind == ".ply":
        tables = read_tables(path)
        for name in ("vertex", "face"):
            colors = _colors(path, tables.get(name))
            if found is None and colors is not None:
                found = _of(path, tables, name, colors)
    elif kind == ".stl":
        facets = facet_colors(path)
        if facets is not None:
            found = Found(np.repeat(facets[0], 3, axis=0), facets[1].ravel())
    elif kind == ".obj":
        found = _obj_colors(path)
    if found is None:
        raise FileError(
            f"{path} has no colours of vertices or faces; export it as a .ply with them, or give a "
            ".blend to --input"
        )
    return found


def _colors(path: Path, table: Table | None) -> NDArray[np.float64] | None:
    numbers = {} if table is None else table.scalars
    if any(name not in numbers for name in _CHANNELS):
        return None
    columns = [numbers[name] for name in _CHANNELS]
    whole = max((np.iinfo(c.dtype).max for c in columns if c.dtype.kind in "iu"), default=1)
    colors = np.column_stack(columns).astype(np.float64)
    return _scaled(path, colors) if whole == 1 else colors / whole


def _scaled(path: Path, colors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Colours of a text, which has no types: whole numbers of which one is beyond 1 count to 255,
    or to 65535. Raises FileError for what is neither; what is not finite is passed on."""
    known = colors[np.isfinite(colors)]
    most = known.max(initial=0.0)
    if known.min(initial=0.0) < 0.0 or most > 65535.0 or (most > 1.0 and (known % 1.0).any()):
        raise FileError(
            f"{path} has colours that are neither numbers from 0 to 1 nor whole ones from 0 to "
            "255; correct them"
        )
    return colors / (1.0 if most <= 1.0 else 255.0 if most <= 255.0 else 65535.0)


def _of(path: Path, tables: dict[str, Table], name: str, rows: NDArray[np.float64]) -> Found:
    """Rows of a table's elements, which are vertices or faces."""
    if name == "vertex":
        return Found(rows)
    lengths, corners = corners_of(path, tables["face"])
    return Found(np.repeat(rows, lengths, axis=0), corners)


def _obj_colors(path: Path) -> Found | None:
    rows = [row.split() for row in _OBJ_VERTEX.findall(read_plain(path))]
    if not rows or any(len(row) < 6 for row in rows):
        return None
    # With seven numbers the fourth is the weight of a point.
    first = 4 if all(len(row) == 7 for row in rows) else 3
    try:
        colors = np.array([row[first : first + 3] for row in rows]).astype(np.float64)
    except ValueError:
        raise FileError(f"{path} has colours that are no numbers; correct them") from None
    return Found(_scaled(path, colors))


def numbers_of(path: Path, name: str) -> Found:
    """The values of a property of the vertices, or else of the faces, of a PLY file, (n,). Raises
    FileError: none is called so."""
    tables = read_tables(path) if path.suffix.lower() == ".ply" else {}
    known: dict[str, None] = {}
    for element in ("vertex", "face"):
        numbers = tables[element].scalars if element in tables else {}
        if name in numbers:
            return _of(path, tables, element, numbers[name].astype(np.float64))
        known |= dict.fromkeys(numbers)
    names = ", ".join(f"'{each}'" for each in known if each not in _PLACE)
    raise FileError(
        f"{path} has no numbers '{name}' of vertices or faces; "
        + (f"it has {names}" if names else "export it as a .ply with them")
    )


def uvs_of(path: Path) -> Found:
    """The UVs of an OBJ or PLY file, (n, 2), v upward.

    Raises FileError: it has none, not of all faces, or no numbers.
    """
    found = _ply_uvs(path) if path.suffix.lower() == ".ply" else _obj_uvs(path)
    if found is None:
        raise FileError(
            f"{path} has no UVs; unwrap the mesh and export it with them, as .obj or .ply"
        )
    if not np.isfinite(found.values).all():
        raise FileError(f"{path} has UVs that are not finite numbers; unwrap the mesh again")
    return found


def _ply_uvs(path: Path) -> Found | None:
    tables = read_tables(path)
    numbers = tables["vertex"].scalars if "vertex" in tables else {}
    for u, v in _UVS:
        if u in numbers and v in numbers:
            return Found(np.column_stack([numbers[u], numbers[v]]).astype(np.float64))
    faces = tables.get("face")
    if faces is None or _UVS_OF_FACES not in faces.lists:
        return None
    lengths, corners = corners_of(path, faces)
    counts, values = faces.lists[_UVS_OF_FACES]
    if (np.asarray(counts) != 2 * lengths).any():
        raise FileError(f"{path} has faces without UVs; unwrap all of the mesh")
    return Found(np.asarray(values, dtype=np.float64).reshape(-1, 2), corners)


def _obj_uvs(path: Path) -> Found | None:
    uvs: list[list[bytes]] = []
    vertices: list[int] = []
    places: list[int] = []
    points = bare = 0
    text = _OBJ_GOES_ON.sub(b" ", read_plain(path))
    for line in text.splitlines():
        words = line.partition(b"#")[0].split()
        if not words:
            continue
        if words[0] == b"v":
            points += 1
        elif words[0] == b"vt":
            uvs.append([*words[1:3], b"0"][:2])
        elif words[0] == b"f" and len(words) > 3:
            for corner in words[1:]:
                point, _, rest = corner.partition(b"/")
                place = rest.partition(b"/")[0]
                if not place:
                    bare += 1
                    continue
                # From the end of what stands above it, where it is negative.
                numbers = [int(point), int(place)]
                vertices.append(numbers[0] - 1 if numbers[0] > 0 else numbers[0] + points)
                places.append(numbers[1] - 1 if numbers[1] > 0 else numbers[1] + len(uvs))
    if not places:
        return None
    if bare:
        raise FileError(f"{path} has faces without UVs; unwrap all of the mesh")
    chosen = np.array(places)
    if chosen.min() < 0 or chosen.max() >= len(uvs):
        raise FileError(f"{path} has a face with a UV that is not there; export it again")
    try:
        return Found(np.array(uvs).astype(np.float64)[chosen], np.array(vertices))
    except ValueError:
        raise FileError(f"{path} has UVs that are no numbers; export it again") from None
