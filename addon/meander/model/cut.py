# SPDX-License-Identifier: GPL-3.0-or-later
"""What is made of a surface that has been cut along its curve; numpy only."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .. import core

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
    lengths = np.linalg.norm(blended, axis=1, keepdims=True)
    return np.divide(blended, lengths, out=np.zeros_like(blended), where=lengths > 0.0)


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
