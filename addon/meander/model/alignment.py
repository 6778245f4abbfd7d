# SPDX-License-Identifier: GPL-3.0-or-later
"""Which direction the strands follow: numpy in, numpy out, no bpy.

Directions are lines: their signs and lengths do not matter.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import core
from .field import Computed, FieldOn, evaluating
from .steps import Steps

# Per vertex (n, 3), or what computes them from the surface once that exists.
Directions = NDArray[np.float64] | FieldOn


@dataclass(frozen=True)
class Alignment:
    """What the strands follow, apart from any object: those saved, or those of a command."""

    source: str = "NONE"
    weight: float = 1.0
    across: bool = False
    name: str = ""  # of the attribute, UV map or curve object
    choice: str = ""  # "AUTO", "X", "Y", "Z"; "MIN", "MAX"; "U", "V"
    local: bool = False  # the axis is the object's
    smoothing: float = 2.0  # in units of r
    # What turns it: "NONE", "GROUP", "ATTRIBUTE", "COLOR" or "IMAGE", its name, and an image's map.
    angle_source: str = "NONE"
    angle_name: str = ""
    angle_uv_map: str = ""

    @property
    def kind(self) -> str:
        """One of core.ALIGNMENTS."""
        return "across" if self.across else "along"


@dataclass(frozen=True)
class Axis:
    """An axis to follow: "X", "Y" or "Z", as it lies on a surface.

    vector    (3,), in the space of the surface's vertices
    problem   why it gives no directions, a sentence without its full stop; empty: it does
    """

    name: str
    vector: NDArray[np.float64]
    problem: str = ""

    def directions(self, count: int) -> NDArray[np.float64]:
        """The axis for each of `count` vertices."""
        return np.tile(self.vector, (count, 1))


# An axis of which less than this share lies in the surface stands straight up from it.
_LEAST_SHARE = 1e-6
# And one that lies in it less than this share better than another is no better.
_AS_WELL = 1e-3


def axis_on(
    choice: str,
    frame: NDArray[np.float64],
    vertices: NDArray[np.float64],
    faces: NDArray[np.integer],
) -> Axis:
    """The axis "X", "Y" or "Z" of a frame, whose columns are its axes; of "AUTO" the one that lies
    best in the surface, by area, and of several that lie as well the first.
    """
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    units = normals / np.where(areas > 0.0, areas, 1.0)[:, None]
    axes = frame / np.linalg.norm(frame, axis=0)
    # The mean of the squared length of what lies in the surface of an axis as long as 1.
    shares = 1.0 - (areas[:, None] * (units @ axes) ** 2).sum(axis=0) / max(areas.sum(), 1e-300)
    best = int(np.argmax(shares >= (1.0 - _AS_WELL) * shares.max()))
    chosen = best if choice == "AUTO" else "XYZ".index(choice)
    problem = ""
    if shares[chosen] < _LEAST_SHARE:
        problem = (
            f"The {'XYZ'[chosen]} axis stands straight up from the whole surface, and nothing can "
            f"run along it; choose {'XYZ'[best]}"
        )
    return Axis("XYZ"[chosen], frame[:, chosen], problem)


def computed(kind: str, smoothing: float = 0.0) -> Directions:
    """Directions that the library computes: one of core.DIRECTIONS."""

    def on(surface: core.Surface) -> Steps[NDArray[np.float64]]:
        # Averaging over more than the mesh is no mistake worth stopping for.
        smoothing_here = min(smoothing, surface.statistics()["diagonal"])
        lines = yield surface.directions_work(kind, smoothing_here)
        if not lines.any():
            raise core.MeanderError(_nowhere(kind, surface))
        return lines

    return Computed(on)


def _nowhere(kind: str, surface: core.Surface) -> str:
    """What is said where directions that are computed are nowhere on a surface."""
    if kind != "boundary":
        return (
            "The surface bends nowhere, and so its curvature has no directions; choose a smooth "
            "direction, the boundary or an axis"
        )
    if surface.statistics()["boundary_loops"] == 0:
        return "The surface has no boundary to run along; choose a smooth direction or an axis"
    return (
        "Every vertex of the mesh is a corner of its boundary, where that has no direction; divide "
        "the faces, or choose a smooth direction or an axis"
    )


def turned(directions: Directions, degrees: NDArray[np.float64]) -> Directions:
    """Directions, each turned in the surface by degrees of its own, per vertex."""

    def on(surface: core.Surface) -> Steps[NDArray[np.float64]]:
        lines = yield from evaluating(directions, surface)
        return surface.turned_directions(lines, np.radians(degrees))

    return Computed(on)


def uv_lines(
    places: NDArray[np.float64], uv: NDArray[np.float64], axis: int
) -> NDArray[np.float64]:
    """The lines along u (0) or v (1), where the other stays the same, of triangles (m, 3, 3) with
    coordinates (m, 3, 2).

    Their squared lengths are twice the areas, so that large triangles count more in a mean; zero
    where the coordinates say nothing.
    """
    a, b = places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]
    da, db = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    other = 1 - axis
    # Up to its length and sign, the direction in which the other coordinate stays the same.
    lines = a * db[:, other, None] - b * da[:, other, None]
    flat = np.abs(da[:, 0] * db[:, 1] - da[:, 1] * db[:, 0]) <= 1e-12 * (da**2 + db**2).sum(axis=1)
    lengths = np.linalg.norm(lines, axis=1)
    lines = np.where((flat | (lengths == 0.0))[:, None], 0.0, lines)
    areas = np.linalg.norm(np.cross(a, b), axis=1)
    return lines / np.where(lengths > 0.0, lengths, 1.0)[:, None] * np.sqrt(areas)[:, None]


def mean_lines(
    lines: NDArray[np.float64], faces: NDArray[np.integer], count: int
) -> NDArray[np.float64]:
    """The mean line (count, 3) at the vertices of faces (m, 3) with a line each, of any sign."""
    products = (lines[:, :, None] * lines[:, None, :]).reshape(-1, 9)
    sums = np.zeros((count, 9))
    for corner in range(3):
        for entry in range(9):
            sums[:, entry] += np.bincount(
                faces[:, corner], weights=products[:, entry], minlength=count
            )
    values, vectors = np.linalg.eigh(sums.reshape(-1, 3, 3))
    return np.where(values[:, 2:] > 0.0, vectors[:, :, 2], 0.0)
