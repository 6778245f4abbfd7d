# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles cut off at planes, and divided until what changes along them changes little; no bpy.

New vertices lie on edges, one for both faces beside an edge, so the mesh stays as it was joined.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

# Nearer to a plane than this share of the mesh, a vertex lies in it, and no face is cut beside
# it: the piece would be too thin.
_ON_PLANE = 1e-6


@dataclass(frozen=True)
class Triangles:
    """Faces with what is known at their vertices.

    vertices   (n, 3)
    faces      (m, 3) int64
    values     (n,), linear along edges; None: there are none
    lines      (n, 3), directions without a sign; None: there are none
    normals    (n, 3), of what is shaded smooth, not of unit length; 0 elsewhere; None: unknown
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    values: NDArray[np.float64] | None = None
    lines: NDArray[np.float64] | None = None
    normals: NDArray[np.float64] | None = None

    def clipped(self, planes: NDArray[np.float64]) -> Triangles:
        """What lies inside of all planes (k, 4), where plane @ (x, y, z, 1) >= 0."""
        found = self
        for plane in planes:
            if len(found.faces):
                found = found._on_one_side(plane)
        return found._compact()

    def divided(
        self, size: Callable[[NDArray[np.float64]], NDArray[np.float64]], most: float
    ) -> Triangles:
        """The same surface with edges halved until no `size` at one end is more than `most` times
        that at the other.

        size   of points (n, 3), positive
        most   greater than 1
        """

        def too_long(points: NDArray[np.float64], edges: NDArray[np.int64]) -> NDArray[np.bool_]:
            sizes = size(points)[edges]
            return sizes.max(axis=1) > most * sizes.min(axis=1)

        return self.halved(too_long)

    def halved(
        self,
        too_long: Callable[[NDArray[np.float64], NDArray[np.int64]], NDArray[np.bool_]],
    ) -> Triangles:
        """The same surface with edges halved until none is too long.

        too_long   of points (n, 3) and edges (e, 2) between them, (e,)
        """
        found = self
        while True:
            edges, owners = found.edges()
            marked = too_long(found.vertices, edges)
            if not marked.any():
                return found
            middles = np.full(len(edges), -1, dtype=np.int64)
            middles[marked] = len(found.vertices) + np.arange(np.count_nonzero(marked))
            faces = _split(found.faces, middles[owners])
            found = replace(found._with_vertices(edges[marked], 0.5), faces=faces)

    def _on_one_side(self, plane: NDArray[np.float64]) -> Triangles:
        height = self.vertices @ plane[:3] + plane[3]
        extent = float(np.linalg.norm(np.ptp(self.vertices, axis=0)))
        least = _ON_PLANE * extent * float(np.linalg.norm(plane[:3]))
        side = np.where(np.abs(height) <= least, 0, np.sign(height)).astype(np.int64)
        inside, outside = ((side[self.faces] == sign).sum(axis=1) for sign in (1, -1))
        if not outside.any():
            return self
        edges, owners = self.edges()
        cut = side[edges[:, 0]] * side[edges[:, 1]] < 0
        places = np.full(len(edges), -1, dtype=np.int64)
        places[cut] = len(self.vertices) + np.arange(np.count_nonzero(cut))
        places = places[owners]
        ends = height[edges[cut]]
        pieces = [self.faces[(outside == 0) & (inside > 0)]]

        def begun_at(sign: int, chosen: NDArray[np.bool_]) -> tuple[NDArray, NDArray]:
            """Chosen faces and the places on their edges, from the corner on that side on."""
            faces = self.faces[chosen]
            return _turned(faces, places[chosen], np.argmax(side[faces] == sign, axis=1))

        faces, on = begun_at(1, (inside == 1) & (outside == 2))
        pieces.append(np.column_stack([faces[:, 0], on[:, 0], on[:, 2]]))
        faces, on = begun_at(-1, (inside == 2) & (outside == 1))
        pieces.append(np.column_stack([faces[:, 1], faces[:, 2], on[:, 2]]))
        pieces.append(np.column_stack([faces[:, 1], on[:, 2], on[:, 0]]))
        faces, on = begun_at(0, (inside == 1) & (outside == 1))
        second = side[faces[:, 1]] > 0
        pieces.append(
            np.column_stack(
                [
                    faces[:, 0],
                    np.where(second, faces[:, 1], on[:, 1]),
                    np.where(second, on[:, 1], faces[:, 2]),
                ]
            )
        )
        share = ends[:, 0] / (ends[:, 0] - ends[:, 1])
        return replace(self._with_vertices(edges[cut], share), faces=np.vstack(pieces))

    def edges(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """The ends of every edge, (e, 2), and which edges each face has, (m, 3): from its corner 0
        to 1, 1 to 2, and 2 to 0."""
        pairs = np.stack([self.faces, np.roll(self.faces, -1, axis=1)], axis=2).reshape(-1, 2)
        edges, owners = np.unique(np.sort(pairs, axis=1), axis=0, return_inverse=True)
        return edges, owners.reshape(-1, 3)

    def _with_vertices(
        self, edges: NDArray[np.int64], share: NDArray[np.float64] | float
    ) -> Triangles:
        """With a vertex more for each edge, so far on its way."""
        share = np.broadcast_to(np.asarray(share, float), len(edges))
        first, second = edges.T

        def between(values: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray:
            t = share.reshape((-1,) + (1,) * (values.ndim - 1))
            return np.concatenate([values, (1.0 - t) * values[first] + t * other])

        vertices = between(self.vertices, self.vertices[second])
        values = None if self.values is None else between(self.values, self.values[second])
        lines = self.lines
        if lines is not None:
            turned = np.einsum("ij,ij->i", lines[first], lines[second]) < 0.0
            lines = between(lines, np.where(turned[:, None], -lines[second], lines[second]))
        normals = None if self.normals is None else between(self.normals, self.normals[second])
        return replace(self, vertices=vertices, values=values, lines=lines, normals=normals)

    def _compact(self) -> Triangles:
        """Without vertices that no face has."""
        used, faces = np.unique(self.faces, return_inverse=True)
        return Triangles(
            self.vertices[used],
            faces.reshape(-1, 3),
            None if self.values is None else self.values[used],
            None if self.lines is None else self.lines[used],
            None if self.normals is None else self.normals[used],
        )


def _turned(
    faces: NDArray[np.int64], marks: NDArray[np.int64], first: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Faces and the marks of their edges, each begun at another corner."""
    order = (first[:, None] + np.arange(3)) % 3
    return np.take_along_axis(faces, order, 1), np.take_along_axis(marks, order, 1)


def _split(faces: NDArray[np.int64], middles: NDArray[np.int64]) -> NDArray[np.int64]:
    """Faces divided at the middles of their edges, -1 where an edge has none."""
    marked = middles >= 0
    count = marked.sum(axis=1)
    pieces = [faces[count == 0]]

    def add(*corners: NDArray[np.int64]) -> None:
        pieces.append(np.column_stack(corners))

    one = count == 1
    (a, b, c), (ab, _bc, _ca) = (
        each.T for each in _turned(faces[one], middles[one], np.argmax(marked[one], axis=1))
    )
    add(a, ab, c)
    add(ab, b, c)
    two = count == 2  # beginning behind the edge that has no middle
    (a, b, c), (ab, bc, _ca) = (
        each.T
        for each in _turned(faces[two], middles[two], (np.argmin(marked[two], axis=1) + 1) % 3)
    )
    add(ab, b, bc)
    add(a, ab, bc)
    add(a, bc, c)
    (a, b, c), (ab, bc, ca) = faces[count == 3].T, middles[count == 3].T
    add(a, ab, ca)
    add(ab, b, bc)
    add(ca, bc, c)
    add(ab, bc, ca)
    return np.vstack(pieces)
