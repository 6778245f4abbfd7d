# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run of the sweep is given: a mesh and a seed, in the file that sweep_run reads."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import geometry
import numpy as np
from geometry import Mesh
from numpy.typing import NDArray


class Seed(NamedTuple):
    """Strands, as core.Seed has them: points (k, 3), and flags of strands and points."""

    points: NDArray[np.float64]
    offsets: NDArray[np.uint64]
    closed: NDArray[np.uint8]
    guides: NDArray[np.uint8]
    fixed: NDArray[np.uint8]
    fill_regions: bool


def components_of(mesh: Mesh) -> NDArray[np.int64]:
    """A number for the component of every face."""
    parents = list(range(len(mesh.vertices)))

    def root(v: int) -> int:
        while parents[v] != v:
            parents[v] = parents[parents[v]]
            v = parents[v]
        return v

    for a, b, c in mesh.faces.tolist():
        parents[root(a)] = parents[root(b)] = root(c)
    return np.array([root(face[0]) for face in mesh.faces.tolist()])


def _strands(*strands: tuple[NDArray, bool, bool, list[int]]) -> Seed:
    """Of points, closed, guide, and which points are fixed."""
    points = [strand[0] for strand in strands]
    fixed = np.zeros(sum(len(part) for part in points), dtype=np.uint8)
    offsets = np.cumsum([0, *(len(part) for part in points)])
    for first, strand in zip(offsets, strands):
        fixed[first + np.array(strand[3], dtype=int)] = 1
    return Seed(
        np.vstack(points),
        offsets.astype(np.uint64),
        np.array([strand[1] for strand in strands], dtype=np.uint8),
        np.array([strand[2] for strand in strands], dtype=np.uint8),
        fixed,
        True,
    )


def seed_of(mesh: Mesh, number: int) -> Seed | None:
    """The seeds of the sweep, all with loops on the components that they leave out.

    1  none: the library's loops
    2  one stroke between two fixed points of the largest component
    3  a triangle with a fixed corner, and a guide, in faces of that component
    """
    if number == 1:
        return None
    random = np.random.default_rng(number)
    a, b, c = (mesh.vertices[mesh.faces[:, corner]] for corner in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    components = components_of(mesh)
    largest = components[np.argmax(np.bincount(components, area)[components])]
    inside = np.flatnonzero(components == largest)
    chance = area[inside] / area[inside].sum()

    def points(face: int, *weights: tuple[float, float, float]) -> NDArray[np.float64]:
        rows = np.array(weights)
        return geometry.points_at(mesh, np.full(len(rows), face), rows)

    one, other = random.choice(inside, 2, p=chance)
    if number == 2:
        stroke = np.vstack([points(one, (0.6, 0.2, 0.2)), points(other, (0.2, 0.2, 0.6))])
        return _strands((stroke, False, False, [0, 1]))
    corners = points(one, (0.4, 0.3, 0.3), (0.3, 0.4, 0.3), (0.3, 0.3, 0.4))
    guide = points(other, (0.7, 0.15, 0.15), (0.55, 0.3, 0.15))
    return _strands((corners, True, False, [0]), (guide, False, True, []))


def write_input(path: Path, mesh: Mesh, seed: Seed | None) -> None:
    """Writes the file that sweep_run.cpp reads."""
    if seed is None:
        none = np.zeros(0)
        seed = Seed(none.reshape(0, 3), np.zeros(1), none, none, none, False)
    counts = [len(mesh.vertices), len(mesh.faces), len(seed.points), len(seed.closed)]
    arrays = (
        np.array([*counts, seed.fill_regions], dtype=np.uint64),
        mesh.vertices.astype(np.float64),
        mesh.faces.astype(np.uint32),
        seed.points.astype(np.float64),
        seed.offsets.astype(np.uint64),
        seed.closed.astype(np.uint8),
        seed.guides.astype(np.uint8),
        seed.fixed.astype(np.uint8),
    )
    path.write_bytes(b"".join(np.ascontiguousarray(array).tobytes() for array in arrays))
