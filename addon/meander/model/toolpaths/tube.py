# SPDX-License-Identifier: GPL-3.0-or-later
"""A tube around strands, as triangles; no bpy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..geometry.unit_vectors import unit
from .toolpath import Strand

SIDES = 8
# At a sharper turn the outer edge is cut off: the limit of a mitre, as SVG and PDF have it.
_MITRE = 2.0
# Shorter vectors have no direction.
_NONE = 1e-12


class Tube(NamedTuple):
    """Points with a seam along each strand and, where it is closed, one across.

    points            (n, 3)
    normals           (n, 3), unit, outwards
    along_and_around  (n, 2): the length from the strand's first point, and 0 to 1 around it
    triangles         (m, 3), counterclockwise as seen from outside
    """

    points: NDArray[np.float64]
    normals: NDArray[np.float64]
    along_and_around: NDArray[np.float64]
    triangles: NDArray[np.int64]


def tube_of(strands: Sequence[Strand], radius: float) -> Tube:
    """A tube of SIDES sides around each strand, from the surface's normal on; with caps if open."""
    parts, first = [], 0
    for strand in strands:
        wall = _wall(strand, radius)
        pieces = [wall] if strand.closed else [wall, _cap(wall, 0), _cap(wall, -1)]
        for piece in pieces:
            parts.append(piece._replace(triangles=piece.triangles + first))
            first += len(piece.points)
    return Tube(*(np.vstack([part[k] for part in parts]) for k in range(4)))


def _wall(strand: Strand, radius: float) -> Tube:
    order = np.arange(len(strand.points))
    arcs = strand.arc_lengths
    if strand.closed:
        order, arcs = np.append(order, 0), np.append(arcs, strand.length)
    points, along = strand.points[order], strand.tangents[order]
    aside = unit(np.cross(along, np.eye(3)[np.abs(along).argmin(axis=1)]), along, _NONE)
    up = unit(strand.normals[order] - _shadow(strand.normals[order], along), aside, _NONE)
    side = np.cross(along, up)
    angles = np.linspace(0.0, 2.0 * np.pi, SIDES + 1)
    normals = (
        np.cos(angles)[None, :, None] * up[:, None, :]
        + np.sin(angles)[None, :, None] * side[:, None, :]
    )
    # The last is the first again, to the last bit.
    normals[:, -1] = normals[:, 0]
    bend, stretch = _mitres(strand)
    bend, stretch = bend[order], stretch[order]
    inward = (normals * bend[:, None, :]).sum(axis=2, keepdims=True)
    offsets = normals + (stretch[:, None, None] - 1.0) * inward * bend[:, None, :]
    uv = np.stack(np.broadcast_arrays(arcs[:, None], angles[None, :] / (2.0 * np.pi)), axis=2)
    count, round_ = len(order), SIDES + 1
    here = (np.arange(count - 1)[:, None] * round_ + np.arange(SIDES)[None, :]).ravel()
    triangles = np.vstack(
        [
            np.column_stack([here, here + 1, here + round_]),
            np.column_stack([here + 1, here + round_ + 1, here + round_]),
        ]
    )
    places = points[:, None, :] + radius * offsets
    return Tube(places.reshape(-1, 3), normals.reshape(-1, 3), uv.reshape(-1, 2), triangles)


def _cap(wall: Tube, end: int) -> Tube:
    """A fan over the first ring of an open wall, or over its last."""
    round_ = SIDES + 1
    ring = wall.points[:round_] if end == 0 else wall.points[-round_:]
    other = wall.points[round_ : 2 * round_] if end == 0 else wall.points[-2 * round_ : -round_]
    middle = ring[:SIDES].mean(axis=0)
    outward = unit((middle - other[:SIDES].mean(axis=0))[None, :], wall.normals[:1], _NONE)
    uv = wall.along_and_around[:round_] if end == 0 else wall.along_and_around[-round_:]
    turn = np.arange(SIDES)
    rim = np.column_stack([turn, turn + 1]) if end else np.column_stack([turn + 1, turn])
    return Tube(
        np.vstack([ring, middle]),
        np.tile(outward, (round_ + 1, 1)),
        np.vstack([uv, [uv[0, 0], 0.5]]),
        np.column_stack([rim, np.full(SIDES, round_)]),
    )


def _mitres(strand: Strand) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Towards where each point's turn bends, unit or 0, and how much wider a ring is along that, so
    that the tube keeps its width on both sides of the turn."""
    points = strand.points
    pieces = np.diff(points, axis=0, append=points[:1] if strand.closed else points[-1:])
    after = unit(pieces, strand.tangents, _NONE)
    before = np.roll(after, 1, axis=0)
    if not strand.closed:
        after[-1] = before[-1] if len(points) > 1 else after[-1]
        before[0] = after[0]
    half = np.linalg.norm(before + after, axis=1) / 2.0
    return unit(after - before, least=_NONE), 1.0 / np.maximum(half, 1.0 / _MITRE)


def _shadow(vectors: NDArray[np.float64], onto: NDArray[np.float64]) -> NDArray[np.float64]:
    return (vectors * onto).sum(axis=1, keepdims=True) * onto
