# SPDX-License-Identifier: GPL-3.0-or-later
"""What is made of a surface that has been cut along its curve, and it as a file; numpy only."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .. import core
from .geometry.unit_vectors import unit

_OF_VERTICES = ("positions", "distances", "vertex_faces", "vertex_weights")
_OF_FACES = (
    "faces",
    "origins",
    "strands",
    "regions",
    "sides",
    "nearest_sides",
    "along",
    "face_distances",
    "corner_weights",
)
# Lights that stand still: from one to the next in spacings, how much of them is left at the end of
# the tail, and the colours between and in them, linear.
_PERIOD, _FAINTEST = 24.0, 0.3
_DARK, _GLOW = np.array((0.03, 0.03, 0.05)), np.array((1.0, 0.36, 0.06))


def is_parted(cut: core.CutSurface) -> bool:
    """Whether the curve has two sides everywhere: its regions can be coloured with two colours.

    Closed strands part a sphere so; an open one has both of its sides in one region.
    """
    if not len(cut.faces):
        return False
    highest = np.full(int(cut.regions.max()) + 1, -2)
    lowest = np.full(len(highest), 2)
    np.maximum.at(highest, cut.regions, cut.sides)
    np.minimum.at(lowest, cut.regions, cut.sides)
    return bool((highest == lowest).all())


def ribbon_uv(cut: core.CutSurface, spacing: float) -> NDArray[np.float64]:
    """The UV map that goes along the curve, (m, 3, 2), for each corner of each face.

    U is the arc length along the strand, V goes across it from 0 on the right to 1 on the left,
    with the curve at 0.5; both are in spacings, so that nothing is stretched.
    """
    across = cut.nearest_sides[:, None] * cut.face_distances / spacing
    return np.stack((cut.along / spacing, np.clip(0.5 + across, 0.0, 1.0)), axis=2)


def light_colours(uv: NDArray[np.floating]) -> NDArray[np.float64]:
    """What the running lights look like that stand still, (n, 3), from the map along the curve.

    uv   (n, 2), of ribbon_uv()
    """
    head = (uv[:, 0] / _PERIOD) % 1.0
    near = np.clip(1.0 - 2.0 * np.abs(uv[:, 1] - 0.5), 0.0, 1.0)
    glow = near * (_FAINTEST + (1.0 - _FAINTEST) * head)
    return _DARK + glow[:, None] * (_GLOW - _DARK)


def along_shares(cut: core.CutSurface) -> NDArray[np.float64]:
    """How far along its strand each corner is, (m, 3): 0 at the first point, 1 at the last."""
    lengths = np.ones(int(cut.line_strands.max()) + 2 if len(cut.line_strands) else 1)
    lengths[cut.line_strands] = cut.lengths
    # Faces of components without a strand have no number of their own.
    strands = np.minimum(cut.strands, len(lengths) - 1)
    return cut.along / lengths[strands][:, None]


def smooth_normals(
    cut: core.CutSurface, normals: NDArray[np.float64], faces: NDArray[np.uint32]
) -> NDArray[np.float64]:
    """Normals of the cut's vertices, (n, 3), between those of the surface's own vertices.

    normals  (v, 3), of the vertices of the surface
    faces    (f, 3), of the surface
    """
    blended = np.einsum("nw,nwx->nx", cut.vertex_weights, normals[faces[cut.vertex_faces]])
    return unit(blended)


def one_side(cut: core.CutSurface, side: int) -> core.CutSurface:
    """The faces of one side, 1 or -1, with the vertices and the parts of the curve that they have.

    Strands stay whole: both sides have all of the curve along their boundaries.
    """
    kept = cut.sides == side
    used = np.zeros(len(cut.positions), dtype=bool)
    used[cut.faces[kept].ravel()] = True
    used[cut.line_vertices] = True
    number = np.cumsum(used, dtype=np.uint32) - np.uint32(1)
    changed = {name: getattr(cut, name)[used] for name in _OF_VERTICES}
    changed |= {name: getattr(cut, name)[kept] for name in _OF_FACES}
    changed["faces"] = number[changed["faces"]]
    return replace(cut, **changed, line_vertices=number[cut.line_vertices])


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
