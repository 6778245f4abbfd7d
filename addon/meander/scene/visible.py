# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts of strands that can be seen: what a surface hides is left out."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

from ..model.toolpaths.drawing import ring
from ..model.toolpaths.toolpath import Strand, strand_of

# Shares of the diagonal of the surface's box. So far a point is moved towards the eye before it is
# asked what hides it, or rounding would let it hide itself.
_LIFT = 1e-4
_LONGEST, _SHORTEST = 0.005, 0.002
# How often the place where a strand goes out of sight is halved.
_HALVINGS = 10


def visible_strands(
    strands: Sequence[Strand],
    right: Sequence[float],
    up: Sequence[float],
    vertices: np.ndarray,
    faces: np.ndarray,
) -> list[Strand]:
    """What can be seen of strands on a surface from far away, in their order.

    right, up        the axes of the picture in space, unit and at right angles
    vertices, faces  of the surface, which hides

    A strand of which a part is hidden becomes open ones. What it knew of its points, except for
    normals, is lost.
    """
    eye = np.cross(np.asarray(right, float), np.asarray(up, float))
    size = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    seen = _Sight(vertices, faces, eye, _LIFT * size)
    return seen_parts(strands, seen, lambda points: points, _LONGEST * size, _SHORTEST * size)


def seen_parts(
    strands: Sequence[Strand],
    seen: Callable[[np.ndarray], np.ndarray],
    placed: Callable[[np.ndarray], np.ndarray],
    longest: float,
    shortest: float,
) -> list[Strand]:
    """What can be seen of strands, in their order; see visible_strands().

    seen      which of points (n, 3) can be, (n,) bool
    placed    where these lie in the picture, (n, any)
    longest   in the picture: no piece is longer, so that something narrow does not hide the middle
              of one unseen
    shortest  in the picture: shorter parts are where the surface turns away from the eye, and
              flicker
    """
    found = []
    for strand in strands:
        points, normals = _divided(strand, placed, longest)
        visible = seen(points)
        if visible.all():
            found.append(strand)
            continue
        if strand.closed:
            # It begins where it is hidden, so that no visible part is cut.
            first = int(np.argmin(visible[:-1]))
            order = (first + np.arange(len(points))) % (len(points) - 1)
            points, normals, visible = points[order], normals[order], visible[order]
        found += [
            strand_of(*part, False)
            for part in _parts(points, normals, visible, seen)
            if np.linalg.norm(np.diff(placed(part[0]), axis=0), axis=1).sum() > shortest
        ]
    return found


class _Sight:
    """Tells which points nothing hides."""

    def __init__(
        self, vertices: np.ndarray, faces: np.ndarray, eye: np.ndarray, lift: float
    ) -> None:
        # The tree rounds to single precision: around the origin, and of the size 1.
        self._middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2.0
        self._size = float(np.ptp(vertices, axis=0).max()) or 1.0
        self._tree = BVHTree.FromPolygons(self._inside(vertices).tolist(), faces.tolist())
        self._eye, self._lift = Vector(eye.tolist()), lift * eye

    def _inside(self, points: np.ndarray) -> np.ndarray:
        return (points - self._middle) / self._size

    def __call__(self, points: np.ndarray) -> np.ndarray:
        cast, eye = self._tree.ray_cast, self._eye
        starts = self._inside(points + self._lift)
        return np.array([cast(start, eye)[0] is None for start in starts.tolist()], dtype=bool)


def _divided(
    strand: Strand, placed: Callable[[np.ndarray], np.ndarray], longest: float
) -> tuple[np.ndarray, np.ndarray]:
    """Points and normals of a strand, closed ones with the first at the end, no piece longer."""
    points = ring(strand)
    normals = np.vstack([strand.normals, strand.normals[:1]])[: len(points)]
    steps = np.linalg.norm(np.diff(placed(points), axis=0), axis=1)
    counts = np.maximum(np.ceil(steps / longest).astype(np.int64), 1)
    piece = np.repeat(np.arange(len(steps)), counts)
    number = np.arange(len(piece)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = (number / counts[piece])[:, None]
    return tuple(
        np.vstack([(1.0 - share) * values[piece] + share * values[piece + 1], values[-1:]])
        for values in (points, normals)
    )


def _parts(
    points: np.ndarray,
    normals: np.ndarray,
    visible: np.ndarray,
    seen: Callable[[np.ndarray], np.ndarray],
) -> list[tuple[np.ndarray, np.ndarray]]:
    """The visible runs of points, each up to the places where it goes out of sight."""
    edges = np.flatnonzero(visible[1:] != visible[:-1])
    on = np.where(visible[edges][:, None], points[edges], points[edges + 1])
    off = np.where(visible[edges][:, None], points[edges + 1], points[edges])
    for _ in range(_HALVINGS):
        middle = (on + off) / 2.0
        there = seen(middle)[:, None]
        on, off = np.where(there, middle, on), np.where(there, off, middle)
    parts = []
    bounds = [0, *(edges + 1).tolist(), len(points)]
    for place, (begin, end) in enumerate(zip(bounds[:-1], bounds[1:])):
        if not visible[begin]:
            continue
        before, after = on[place - 1 : place], on[place : place + 1]
        before = before if begin > 0 else before[:0]
        run = np.vstack([before, points[begin:end], after])
        across = np.vstack(
            [normals[begin : begin + len(before)], normals[begin:end], normals[end - 1 : end]]
        )
        parts.append((run, across[: len(run)]))
    return parts
