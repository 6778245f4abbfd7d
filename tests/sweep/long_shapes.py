# SPDX-License-Identifier: GPL-3.0-or-later
"""Long and narrow surfaces as triangles, of a length and a width in the same unit."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import geometry
import numpy as np
from geometry import Mesh
from numpy.typing import NDArray

Points = NDArray[np.float64]


def band(left: Points, right: Points, closed: bool = False) -> Mesh:
    """The quads between two rows of points (n, 3), each as two faces."""
    n = len(left)
    a = np.arange(n if closed else n - 1)
    b = (a + 1) % n
    faces = np.vstack([np.stack([a, b, b + n], 1), np.stack([a, b + n, a + n], 1)])
    return Mesh(np.vstack([left, right]), faces.astype(np.uint32))


def grid(rows: Points, closed: bool) -> Mesh:
    """The surface over rows of points (m, n, 3); `closed`: each row is."""
    m, n = rows.shape[:2]
    i, j = np.meshgrid(np.arange(m - 1), np.arange(n if closed else n - 1), indexing="ij")
    a, b = i * n + j, i * n + (j + 1) % n
    quads = np.stack([a, b, b + n, a + n], -1).reshape(-1, 4)
    faces = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return Mesh(rows.reshape(-1, 3), faces.astype(np.uint32))


def along(length: float, pieces: int) -> Points:
    points = np.zeros((pieces + 1, 3))
    points[:, 0] = np.linspace(0, length, pieces + 1)
    return points


def sides_of(middle: Points, width: float) -> tuple[Points, Points]:
    """Of a flat ribbon along a line in the plane z = 0, with mitred corners."""
    steps = np.diff(middle[:, :2], axis=0)
    sides = np.stack([-steps[:, 1], steps[:, 0]], 1) / np.linalg.norm(steps, axis=1)[:, None]
    before, after = np.vstack([sides[:1], sides]), np.vstack([sides, sides[-1:]])
    mitre = (before + after) / (1 + (before * after).sum(1))[:, None]
    out = np.hstack([mitre, np.zeros((len(middle), 1))]) * (width / 2)
    return middle - out, middle + out


def strip(length: float, width: float, pieces: int) -> Mesh:
    return band(*sides_of(along(length, pieces), width))


def needle(length: float, width: float, pieces: int) -> Mesh:
    """A flat one: at the far end it has no width."""
    middle = along(length, pieces)
    half = width / 2 * (1 - np.linspace(0, 1, pieces + 1) * (1 - 1e-3))
    side = np.stack([0 * half, half, 0 * half], 1)
    return band(middle - side, middle + side)


def tube(middle: Points, radius: Points, sides: int) -> Mesh:
    """Around a line, whose sections (n,) are as wide as these radii."""
    forward = np.gradient(middle, axis=0)
    forward /= np.linalg.norm(forward, axis=1)[:, None]
    normal = np.cross(forward, [0.0, 0.0, 1.0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    other = np.cross(forward, normal)
    angles = 2 * np.pi * np.arange(sides) / sides
    around = np.cos(angles)[:, None] * normal[:, None] + np.sin(angles)[:, None] * other[:, None]
    return grid(middle[:, None] + radius[:, None, None] * around, closed=True)


def pipe(length: float, width: float, pieces: int, sides: int = 8) -> Mesh:
    """`width` is across."""
    return tube(along(length, pieces), np.full(pieces + 1, width / 2), sides)


def square_pipe(length: float, width: float, pieces: int) -> Mesh:
    return pipe(length, width, pieces, 4)


def hexagon_pipe(length: float, width: float, pieces: int) -> Mesh:
    return pipe(length, width, pieces, 6)


def cone(length: float, width: float, pieces: int) -> Mesh:
    """A pipe that ends in a point, all but."""
    return tube(along(length, pieces), width / 2 * np.linspace(1, 1e-3, pieces + 1), 8)


def helix(length: float, width: float, pieces: int) -> Mesh:
    """A pipe that winds, like a spring whose radius is three widths."""
    radius, rise = 3 * width, 2 * width / (2 * np.pi)
    n = max(pieces, int(length / width))
    t = np.linspace(0, length / np.hypot(radius, rise), n + 1)
    middle = np.stack([radius * np.cos(t), radius * np.sin(t), rise * t], 1)
    return tube(middle, np.full(n + 1, width / 2), 8)


def spiral(length: float, width: float, pieces: int) -> Mesh:
    """A ribbon that winds round itself, flat, with room between its turns."""
    pitch = 2 * width
    turns = np.sqrt(length / (np.pi * pitch) + 1) - 1
    t = np.linspace(0, 1, max(pieces, int(12 * turns) + 2))
    radius = pitch * (1 + turns * t)
    out = np.stack([np.cos(2 * np.pi * turns * t), np.sin(2 * np.pi * turns * t), 0 * t], 1)
    return band((radius + width / 2)[:, None] * out, (radius - width / 2)[:, None] * out)


def zigzag(length: float, width: float, pieces: int) -> Mesh:
    """Legs, each turned by 120 degrees against the one before it: eight of them, or fewer where
    these would be shorter than they are wide, and lie on one another."""
    legs = next(n for n in (8, 4, 2, 1) if length >= n * width or n == 1)
    per_leg = max(pieces // legs, 1)
    corners = np.zeros((legs + 1, 3))
    corners[:, 0] = np.arange(legs + 1) * length / legs / 2
    corners[1::2, 1] = length / legs * np.sqrt(3) / 2
    t = np.arange(per_leg * legs + 1) / per_leg
    left, right = (
        np.stack([np.interp(t, np.arange(legs + 1), side[:, k]) for k in range(3)], 1)
        for side in sides_of(corners, width)
    )
    return band(left, right)


def ring(length: float, width: float, pieces: int, turns: int = 0) -> Mesh:
    """`length` is that of its middle line, unless it has no room for a hole then; turned about that
    so many times."""
    n = max(pieces, 12)
    angles = np.linspace(0, 2 * np.pi, n, endpoint=False)
    out = np.stack([np.cos(angles), np.sin(angles), 0 * angles], 1)
    up = np.array([0.0, 0.0, 1.0])
    side = np.cos(turns * angles)[:, None] * out + np.sin(turns * angles)[:, None] * up
    middle = max(length / (2 * np.pi), 0.75 * width) * out
    return band(middle + width / 2 * side, middle - width / 2 * side, closed=True)


def twisted_ring(length: float, width: float, pieces: int) -> Mesh:
    return ring(length, width, max(pieces, 48), turns=1)


def fork(length: float, width: float, pieces: int, arms: int = 3) -> Mesh:
    """So many arms of this length around a polygon, or a square where they are four."""
    per_arm = max(pieces // arms, 1)
    angles = 2 * np.pi * (np.arange(arms) - 0.5) / arms
    corners = width / (2 * np.sin(np.pi / arms)) * np.stack([np.cos(angles), np.sin(angles)], 1)
    vertices = [np.zeros((1, 2)), corners]
    faces = [[0, 1 + k, 1 + (k + 1) % arms] for k in range(arms)]
    count = 1 + arms
    for k in range(arms):
        ends = np.array([1 + k, 1 + (k + 1) % arms])
        angle = 2 * np.pi * k / arms
        step = length / per_arm * np.array([np.cos(angle), np.sin(angle)])
        for j in range(1, per_arm + 1):
            vertices.append(corners[[k, (k + 1) % arms]] + j * step)
            a, b = ends
            c, d = ends = np.array([count, count + 1])
            count += 2
            faces += [[a, c, d], [a, d, b]]
    flat = np.vstack(vertices)
    return Mesh(np.hstack([flat, np.zeros((len(flat), 1))]), np.array(faces, dtype=np.uint32))


def crossroads(length: float, width: float, pieces: int) -> Mesh:
    return fork(length, width, pieces, arms=4)


def star(length: float, width: float, pieces: int) -> Mesh:
    return fork(length, width, pieces, arms=10)


def cells(used: Sequence[Sequence[bool]], xs: Points, ys: Points) -> Mesh:
    """Those quads of a plane that are used, between places along x and y."""
    x, y = np.meshgrid(xs, ys, indexing="ij")
    mesh = grid(np.stack([x, y, 0 * x], -1), closed=False)
    chosen = np.tile(np.asarray(used, dtype=bool).ravel(), 2)
    kept, faces = np.unique(mesh.faces[chosen], return_inverse=True)
    return Mesh(mesh.vertices[kept], faces.reshape(-1, 3).astype(np.uint32))


def comb(length: float, width: float, pieces: int) -> Mesh:
    """Six teeth on a back, of this length together."""
    teeth, fine = 6, max(pieces // 12, 1)
    tooth = length / (teeth + 2)
    xs = np.unique([width * (2 * k + side) for k in range(teeth) for side in (0.0, 1.0)])
    ys = np.concatenate([[0.0], np.linspace(width, width + tooth, fine + 1)])
    used = np.zeros((len(xs) - 1, len(ys) - 1), dtype=bool)
    used[:, 0] = True
    used[::2] = True
    return cells(used, xs, ys)


def ladder(length: float, width: float, pieces: int) -> Mesh:
    """A ribbon of three such widths with square holes along its middle."""
    holes = max(int(length / (2 * width)), 1)
    xs = np.linspace(0, length, 2 * holes + 2)
    used = np.ones((2 * holes + 1, 3), dtype=bool)
    used[1::2, 1] = False
    return cells(used, xs, width * np.arange(4.0))


def holed(length: float, width: float, pieces: int) -> Mesh:
    """A ribbon with a square hole in its middle, a third as wide."""
    side, half = width / 3, max(pieces // 2, 1)
    xs = np.concatenate(
        [
            np.linspace(0, (length - side) / 2, half + 1),
            np.linspace((length + side) / 2, length, half + 1),
        ]
    )
    used = np.ones((2 * half + 1, 3), dtype=bool)
    used[half, 1] = False
    return cells(used, xs, side * np.arange(4.0))


SHAPES: dict[str, Callable[[float, float, int], Mesh]] = {
    made.__name__: made
    for made in (
        *(strip, ring, spiral, pipe, square_pipe, star, needle, holed),
        *(zigzag, fork, crossroads, comb, ladder, twisted_ring, hexagon_pipe, helix, cone),
    )
}


def square(area: float, pieces: int) -> Mesh:
    """Of as many cells, about."""
    n = max(1, round(pieces**0.5))
    xs = np.linspace(0, area**0.5, n + 1)
    return cells(np.ones((n, n), dtype=bool), xs, xs)


def area_of(mesh: Mesh) -> float:
    return float(geometry.triangle_areas(*mesh).sum())
