# SPDX-License-Identifier: GPL-3.0-or-later
"""A cut surface as an OBJ or a PLY file: numpy only, no bpy."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .. import core
from .cut import ribbon_uv

SUFFIXES = (".obj", ".ply")
# Of the two sides, in the order in which OBJ files name them.
SIDES = {1: "side_1", -1: "side_2", 0: "no_side"}

_VERTEX = np.dtype([("position", "<f8", 3), ("distance", "<f8")])
_FACE = np.dtype(
    [
        ("count", "u1"),
        ("vertices", "<i4", 3),
        ("side", "<i4"),
        ("strand", "<i4"),
        ("region", "<i4"),
        ("uv_count", "u1"),
        ("uv", "<f4", 6),
    ]
)
_HEADER = """\
ply
format binary_little_endian 1.0
comment surface cut along a curve by Meander {version}
element vertex {vertices}
property double x
property double y
property double z
property double distance
element face {faces}
property list uchar int vertex_indices
property int side
property int strand
property int region
property list uchar float texcoord
element edge {edges}
property int vertex1
property int vertex2
end_header
"""


def write(path: Path, cut: core.CutSurface, spacing: float) -> None:
    """Writes a cut in the format of the file's suffix, one of SUFFIXES.

    Both have the faces with their side and the UV map along the curve. OBJ has the sides as
    materials and the curve as l lines; PLY has the distance at each vertex, strand and region of
    each face (-1: none), and the curve as edges.
    """
    if path.suffix.lower() == ".obj":
        _write_obj(path, cut, spacing)
    else:
        _write_ply(path, cut, spacing)


def _write_obj(path: Path, cut: core.CutSurface, spacing: float) -> None:
    uv = ribbon_uv(cut, spacing).reshape(-1, 2)
    with path.open("w", encoding="ascii", newline="\n") as file:
        file.write("# surface cut along a curve by Meander\n")
        file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in cut.positions.tolist())
        file.writelines(f"vt {u:.9g} {v:.9g}\n" for u, v in uv.tolist())
        for side, name in SIDES.items():
            of_side = np.flatnonzero(cut.sides == side)
            if not len(of_side):
                continue
            file.write(f"g {name}\nusemtl {name}\n")
            corners = np.empty((len(of_side), 6), dtype=np.int64)
            corners[:, 0::2] = cut.faces[of_side].astype(np.int64) + 1
            corners[:, 1::2] = 3 * of_side[:, None] + np.arange(1, 4)
            file.writelines(f"f {a}/{i} {b}/{j} {c}/{k}\n" for a, i, b, j, c, k in corners.tolist())
        for begin, end, closed in zip(cut.offsets[:-1], cut.offsets[1:], cut.closed):
            line = (cut.line_vertices[begin:end].astype(np.int64) + 1).tolist()
            file.write("l " + " ".join(map(str, line + line[:1] if closed else line)) + "\n")


def _write_ply(path: Path, cut: core.CutSurface, spacing: float) -> None:
    vertices = np.empty(len(cut.positions), dtype=_VERTEX)
    vertices["position"], vertices["distance"] = cut.positions, cut.distances
    faces = np.empty(len(cut.faces), dtype=_FACE)
    faces["count"], faces["uv_count"] = 3, 6
    faces["vertices"], faces["side"], faces["region"] = cut.faces, cut.sides, cut.regions
    faces["strand"] = np.where(cut.strands == core.NO_STRAND, -1, cut.strands.astype(np.int64))
    faces["uv"] = ribbon_uv(cut, spacing).reshape(-1, 6)
    edges = cut.line_edges().astype(np.int32)
    header = _HEADER.format(
        version=core.VERSION, vertices=len(vertices), faces=len(faces), edges=len(edges)
    )
    with path.open("wb") as file:
        file.write(header.encode("ascii"))
        for rows in (vertices, faces, np.ascontiguousarray(edges)):
            file.write(rows.tobytes())
