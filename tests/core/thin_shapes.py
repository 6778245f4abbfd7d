# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces of which parts far apart along them lie close together; plain numpy.

All are made for a radius r of 1, about 8 spacings across, with faces of about a spacing.
"""

from __future__ import annotations

import geometry
import numpy as np
from numpy.typing import NDArray

SIZE = 16.0


def sheet(across: int = 8, along: int = 8, size: tuple[float, float] = (SIZE, SIZE)) -> NDArray:
    """A rectangle from the origin in the plane z = 0: (across + 1, along + 1, 3) points."""
    x, y = (np.linspace(0.0, s, n + 1) for s, n in zip(size, (across, along)))
    x, y = np.meshgrid(x, y, indexing="ij")
    return np.stack([x, y, np.zeros_like(x)], axis=-1)


def surface_of(points: NDArray) -> geometry.Mesh:
    """The open mesh over a grid of points, (m, n, 3)."""
    m, n = points.shape[:2]
    corner = np.arange(m * n).reshape(m, n)[:-1, :-1].ravel()
    quad = corner, corner + n, corner + n + 1, corner + 1
    faces = np.concatenate([np.stack([quad[0], quad[k], quad[k + 1]], axis=1) for k in (1, 2)])
    return geometry.Mesh(points.reshape(-1, 3), faces.astype(np.uint32))


def rim_of(m: int, n: int) -> NDArray[np.int64]:
    """The outermost points of a grid, once round."""
    grid = np.arange(m * n).reshape(m, n)
    return np.concatenate([grid[:-1, 0], grid[-1, :-1], grid[:0:-1, -1], grid[0, :0:-1]])


def solid(points: NDArray, thickness: float | NDArray) -> geometry.Mesh:
    """A closed mesh: half the thickness, one for all points or for each, to both sides of a grid
    of points. The second half of the vertices is the lower side's."""
    normal = np.cross(np.gradient(points, axis=0), np.gradient(points, axis=1))
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    offset = normal * (np.broadcast_to(thickness, points.shape[:2])[..., None] / 2)
    upper, lower = surface_of(points + offset), surface_of(points - offset)
    count = np.uint32(len(upper.vertices))
    rim = rim_of(*points.shape[:2])
    after = np.roll(rim, -1)
    walls = np.concatenate(
        [
            np.stack([after, rim, rim + count], axis=1),
            np.stack([after, rim + count, after + count], axis=1),
        ]
    )
    return geometry.Mesh(
        np.concatenate([upper.vertices, lower.vertices]),
        np.concatenate([upper.faces, lower.faces[:, ::-1] + count, walls]).astype(np.uint32),
    )


def plate(thickness: float, cells: int = 8, size: float = SIZE) -> geometry.Mesh:
    """A square plate."""
    return solid(sheet(cells, cells, (size, size)), thickness)


def leaf() -> geometry.Mesh:
    """A wavy sheet with a thickness of 0.1."""
    points = sheet(32, 20, (20.0, 12.0))
    x, y, z = np.moveaxis(points, -1, 0)
    z += 1.8 * np.sin(0.35 * x) * np.cos(0.3 * y)
    return solid(points, 0.1)


def blade() -> geometry.Mesh:
    """A plate that tapers from 1.5 to an edge of 0.01."""
    points = sheet(16, 8, (20.0, 10.0))
    return solid(points, np.maximum(1.5 * (1 - points[..., 1] / 10.0), 0.01))


def folded_cloth() -> geometry.Mesh:
    """An open sheet, folded twice: three layers, 0.1 apart, and round folds between them."""
    width, gap = 10.0, 0.1
    turn = np.linspace(0.0, np.pi, 9)
    right, left = width + gap / 2 * np.sin(turn), -gap / 2 * np.sin(turn)
    rise = gap / 2 * (1 - np.cos(turn))
    there = np.linspace(0.0, width, 8)
    x = np.concatenate([there, right[1:-1], there[::-1], left[1:-1], there])
    flat = np.zeros_like(there)
    z = np.concatenate([flat, rise[1:-1], flat + gap, rise[1:-1] + gap, flat + 2 * gap])
    y = np.linspace(0.0, SIZE, 9)
    points = np.empty((len(x), len(y), 3))
    points[..., 0], points[..., 1], points[..., 2] = x[:, None], y, z[:, None]
    return surface_of(points)


def crossing_sheets() -> geometry.Mesh:
    """Two squares that pass through each other, at 20 degrees."""
    one = surface_of(sheet(9, 9) - [SIZE / 2, SIZE / 2, 0.0])
    c, s = np.cos(np.radians(20)), np.sin(np.radians(20))
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    other = one.vertices @ turn.T + [0.05, 0.03, 0.0]
    faces = np.concatenate([one.faces, one.faces + np.uint32(len(other))])
    return geometry.Mesh(np.concatenate([one.vertices, other]), faces)


def hollow_ball() -> geometry.Mesh:
    """A bumpy sphere with a wall of 0.3: an outer and an inner surface."""
    ball = geometry.icosphere(3)
    x, y, z = ball.vertices.T
    bumps = 1 + 0.12 * np.sin(4 * x + 1) * np.sin(3 * y) * np.cos(4 * z)
    outer = ball.vertices * (4.5 * bumps)[:, None]
    corners = outer[ball.faces]
    of_faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal = np.zeros_like(outer)
    np.add.at(normal, ball.faces.ravel(), np.repeat(of_faces, 3, axis=0))
    inner = outer - 0.3 * normal / np.linalg.norm(normal, axis=1, keepdims=True)
    faces = np.concatenate([ball.faces, ball.faces[:, ::-1] + np.uint32(len(outer))])
    return geometry.Mesh(np.concatenate([outer, inner]), faces.astype(np.uint32))


SHAPES = {
    **{f"plate of {t} r": plate(t) for t in (0.02, 0.1, 0.3, 0.6, 1.0, 1.5)},
    "plate of large faces": plate(0.2, cells=1),
    "wavy leaf": leaf(),
    "blade": blade(),
    "folded cloth": folded_cloth(),
    "crossing sheets": crossing_sheets(),
    "hollow ball": hollow_ball(),
}
