# SPDX-License-Identifier: GPL-3.0-or-later
"""The plane of symmetry, and the mirror images of points, vectors and curves in it. numpy only, no
bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ... import core

AXES = ("x", "y", "z")


@dataclass(frozen=True)
class Mirror:
    """The plane through an object's origin that one of its own axes stands on.

    axis       one of AXES
    origin     (3,), in the space of the surface's vertices
    normal     (3,), unit, there; it points to the axis' positive side
    to_object  (4, 4), from there to the object's own space, in which places are told
    across     whether strands are to cross it
    """

    axis: str
    origin: NDArray[np.float64]
    normal: NDArray[np.float64]
    to_object: NDArray[np.float64]
    across: bool = False

    def heights(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """How far points (n, 3) are above the plane: (n,)."""
        return (points - self.origin) @ self.normal

    def images(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """The mirror images of points (n, 3)."""
        return points - 2.0 * np.outer(self.heights(points), self.normal)

    def turned(self, vectors: NDArray[np.float64]) -> NDArray[np.float64]:
        """The mirror images of vectors (n, 3)."""
        return vectors - 2.0 * np.outer(vectors @ self.normal, self.normal)

    def polylines(self, curve: core.Polylines) -> core.Polylines:
        """A curve and its mirror image, strand by strand, as a run is shown."""
        count = len(curve.positions)
        return core.Polylines(
            np.vstack([curve.positions, self.images(curve.positions)]),
            np.vstack([curve.normals, self.turned(curve.normals)]),
            np.concatenate([curve.offsets, curve.offsets[1:] + count]).astype(np.uint32),
            np.tile(curve.closed, 2),
        )


def mirror_of(axis: str, matrix: ArrayLike | None = None, across: bool = False) -> Mirror:
    """The plane of an axis, one of AXES.

    matrix   (4, 4), from the object's space to that of the surface's vertices; None: they are one
    across   whether strands are to cross it
    """
    to_world = np.eye(4) if matrix is None else np.asarray(matrix, dtype=np.float64)
    to_object = np.linalg.inv(to_world)
    normal = to_object[AXES.index(axis), :3]  # normals go by the transposed inverse
    normal = normal / np.linalg.norm(normal)
    return Mirror(axis, to_world[:3, 3].copy(), normal, to_object, across)
