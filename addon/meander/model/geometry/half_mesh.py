# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of a triangle mesh on one side of a level of a function. numpy only, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class HalfMesh:
    """Faces where the function is above 0, those that it cuts clipped exactly.

    vertices       (n, 3) float64
    faces          (m, 3) uint32, turned as they were
    before, after  (n,) int64: every vertex lies between these two of the given ones,
    share          (n,) float64: so far from the one to the other
    sources        (m,) int64, the given face that each is, or is a piece of
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.uint32]
    before: NDArray[np.int64]
    after: NDArray[np.int64]
    share: NDArray[np.float64]
    sources: NDArray[np.int64]

    def carried(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """What is known of the given vertices, (k,) or (k, d), at the vertices of this."""
        values = np.asarray(values, dtype=np.float64)
        share = self.share if values.ndim == 1 else self.share[:, None]
        between = (1.0 - share) * values[self.before] + share * values[self.after]
        return np.where(share == 0.0, values[self.before], between)

    def carried_lines(self, directions: NDArray[np.float64]) -> NDArray[np.float64]:
        """The same of directions (k, 3) whose signs mean nothing."""
        begin, end = directions[self.before], directions[self.after]
        turned = np.where((begin * end).sum(axis=1) < 0.0, -1.0, 1.0)[:, None]
        share = self.share[:, None]
        return np.where(share == 0.0, begin, (1.0 - share) * begin + share * turned * end)


def above(
    vertices: NDArray[np.float64],
    faces: NDArray[np.integer],
    values: NDArray[np.float64],
    tolerance: NDArray[np.float64],
) -> HalfMesh:
    """The part of a mesh where a function, linear in every face, is above 0.

    values      (n,) at the vertices
    tolerance   (n,): a vertex whose value is that small lies on the boundary itself, so that no
                face is cut into a sliver; it stays where it is
    """
    faces = np.asarray(faces, dtype=np.int64)
    signs = np.where(values > tolerance, 1, np.where(values < -tolerance, -1, 0))
    count = len(vertices)
    pieces, sources, names = _cut_faces(faces, signs[faces], count)
    edges, number = np.unique(names, axis=0, return_inverse=True)
    every = np.concatenate([np.arange(count), count + number.ravel()])[pieces]
    used, local = np.unique(every, return_inverse=True)
    values = values.astype(np.float64)
    ends = values[edges]
    shares = ends[:, 0] / (ends[:, 0] - ends[:, 1]) if len(edges) else np.zeros(0)
    before = np.concatenate([np.arange(count), edges[:, 0]])[used]
    after = np.concatenate([np.arange(count), edges[:, 1]])[used]
    share = np.concatenate([np.zeros(count), shares])[used]
    half = HalfMesh(
        np.zeros((0, 3)), local.reshape(-1, 3).astype(np.uint32), before, after, share, sources
    )
    return replace(half, vertices=half.carried(vertices))


def _cut_faces(
    faces: NDArray[np.int64], of_faces: NDArray[np.int64], count: int
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """The faces above, whole ones and parts of those that are cut: their corners, the face that
    each came from, and the ends of the edge, smaller first, on which each new vertex lies.

    of_faces   the signs of the corners (m, 3)
    count      of the vertices; new ones have the numbers from there on, several on one edge
    """
    kept = np.flatnonzero((of_faces.min(axis=1) >= 0) & (of_faces.max(axis=1) > 0))
    pieces, sources = [faces[kept]], [kept]
    names: list[NDArray[np.int64]] = [np.zeros((0, 2), dtype=np.int64)]
    taken = 0

    def new(one: NDArray[np.int64], other: NDArray[np.int64]) -> NDArray[np.int64]:
        nonlocal taken
        names.append(np.sort(np.column_stack([one, other]), axis=1))
        taken += len(one)
        return np.arange(count + taken - len(one), count + taken)

    for turn in range(3):
        a, b, c = np.roll(faces, -turn, axis=1).T
        sign = np.roll(of_faces, -turn, axis=1)

        def where(*wanted: int, sign: NDArray[np.int64] = sign) -> NDArray[np.int64]:
            return np.flatnonzero(np.all(sign == wanted, axis=1))

        tip = where(1, -1, -1)
        pieces.append(np.column_stack([a[tip], new(a[tip], b[tip]), new(a[tip], c[tip])]))
        sources.append(tip)
        for pattern in ((0, 1, -1), (0, -1, 1)):
            split = where(*pattern)
            cut = new(b[split], c[split])
            halves = [a[split], b[split], cut] if pattern[1] > 0 else [a[split], cut, c[split]]
            pieces.append(np.column_stack(halves))
            sources.append(split)
        trunk = where(-1, 1, 1)
        first, second = new(a[trunk], b[trunk]), new(a[trunk], c[trunk])
        pieces += [
            np.column_stack([first, b[trunk], c[trunk]]),
            np.column_stack([first, c[trunk], second]),
        ]
        sources += [trunk, trunk]
    return np.vstack(pieces), np.concatenate(sources), np.vstack(names)


def section(
    vertices: NDArray[np.float64], faces: NDArray[np.integer], values: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Where a function, linear in every face, is 0: pieces (k, 2, 3), one a face, in no order."""
    faces = np.asarray(faces, dtype=np.int64)
    of_faces = values[faces]
    met = np.flatnonzero((of_faces.min(axis=1) <= 0.0) & (of_faces.max(axis=1) >= 0.0))
    faces, of_faces = faces[met], of_faces[met]
    ends = np.full((len(faces), 2, 3), np.nan)
    counts = np.zeros(len(faces), dtype=np.int64)

    def add(which: NDArray[np.int64], places: NDArray[np.float64]) -> None:
        room = counts[which] < 2
        which, places = which[room], places[room]
        ends[which, counts[which]] = places
        counts[which] += 1

    for corner in range(3):
        one, other = faces[:, corner], faces[:, (corner + 1) % 3]
        here, there = of_faces[:, corner], of_faces[:, (corner + 1) % 3]
        on = np.flatnonzero(here == 0.0)
        add(on, vertices[one[on]])
        cross = np.flatnonzero(here * there < 0.0)
        share = (here[cross] / (here[cross] - there[cross]))[:, None]
        add(cross, (1.0 - share) * vertices[one[cross]] + share * vertices[other[cross]])
    return ends[counts == 2]
