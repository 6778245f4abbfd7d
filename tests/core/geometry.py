# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes to test on, and checks of a curve that share nothing with the library: plain numpy.

Brute force throughout, since these have to be right rather than fast.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from meander.core import Polylines


class Mesh(NamedTuple):
    """vertices (n, 3) float64; faces (m, 3) uint32."""

    vertices: NDArray[np.float64]
    faces: NDArray[np.uint32]


def mesh(vertices: ArrayLike, faces: ArrayLike) -> Mesh:
    """A mesh from nested lists, or arrays of any shape."""
    return Mesh(
        np.array(vertices, dtype=np.float64).reshape(-1, 3),
        np.array(faces, dtype=np.uint32).reshape(-1, 3),
    )


def obj_text(mesh: Mesh) -> str:
    """A mesh as an OBJ file that holds every bit of it."""
    lines = ["v {!r} {!r} {!r}".format(*place) for place in mesh.vertices.tolist()]
    lines += ["f {} {} {}".format(*face) for face in (mesh.faces.astype(int) + 1).tolist()]
    return "\n".join(lines) + "\n"


def write_obj(path: Path, mesh: Mesh) -> Path:
    path.write_text(obj_text(mesh), encoding="ascii")
    return path


def write_lines(path: Path, *strands: Sequence) -> Path:
    """Strands as the lines of an OBJ file."""
    text, count = "", 0
    for points in strands:
        text += "".join("v {} {} {}\n".format(*point) for point in points)
        text += "l " + " ".join(str(count + k + 1) for k in range(len(points))) + "\n"
        count += len(points)
    path.write_text(text, encoding="ascii")
    return path


# ------------------------------------------------------------------------------------------------
# Meshes


def cube() -> Mesh:
    """The cube [-1, 1]^3 of 12 faces: every face is far larger than a segment."""
    corners = [[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    faces = [triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))]
    return mesh(corners, faces)


def octahedron() -> Mesh:
    """A closed surface with coordinates that no format rounds."""
    corners = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    return mesh(corners, faces)


def surface_over(rows: NDArray[np.float64], closed: bool = False) -> Mesh:
    """The quads between rows of points (m, n, 3), two faces each; `closed`: each row is."""
    number = np.arange(rows.shape[0] * rows.shape[1]).reshape(rows.shape[:2])
    if closed:
        number = np.column_stack([number, number[:, 0]])
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    return mesh(rows, np.stack([a, b, c, a, c, d], axis=-1))


def tube(around: int, along: int, height: float, radius: float = 1.0) -> Mesh:
    """A pipe about the z axis, open at both ends."""
    angles = 2 * np.pi * np.arange(around) / around
    angle, level = np.meshgrid(angles, np.linspace(0.0, height, along + 1))
    return surface_over(
        np.stack([radius * np.cos(angle), radius * np.sin(angle), level], axis=-1), closed=True
    )


def icosphere(subdivisions: int) -> Mesh:
    """A unit sphere of 20 * 4^subdivisions faces."""
    g = (1 + 5**0.5) / 2
    vertices = [
        np.array(p) / np.linalg.norm(p)
        for p in (
            (-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
            (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1),
        )
    ]  # fmt: skip
    faces = [
        (0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
        (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
        (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1),
    ]  # fmt: skip
    for _ in range(subdivisions):
        middles: dict[tuple[int, int], int] = {}

        def middle(a: int, b: int, middles: dict = middles) -> int:
            key = (min(a, b), max(a, b))
            if key not in middles:
                point = vertices[a] + vertices[b]
                vertices.append(point / np.linalg.norm(point))
                middles[key] = len(vertices) - 1
            return middles[key]

        finer = []
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    return mesh(vertices, faces)


def torus(around: int, across: int, radius: float = 1.0, tube: float = 0.4) -> Mesh:
    """A torus about the z axis of 2 * around * across faces."""
    vertices = []
    faces = []
    for i in range(around):
        for j in range(across):
            u, v = 2 * np.pi * i / around, 2 * np.pi * j / across
            ring = radius + tube * np.cos(v)
            vertices.append((ring * np.cos(u), ring * np.sin(u), tube * np.sin(v)))
            a, b = i * across + j, (i + 1) % around * across + j
            c, d = (i + 1) % around * across + (j + 1) % across, i * across + (j + 1) % across
            faces += [(a, b, c), (a, c, d)]
    return mesh(vertices, faces)


def rectangle(low: Sequence, high: Sequence, across: int, up: int) -> Mesh:
    """From one corner to the other in the plane z = 0, in so many cells of two faces."""
    x, y = np.meshgrid(
        np.linspace(low[0], high[0], across + 1), np.linspace(low[1], high[1], up + 1)
    )
    return surface_over(np.stack([x, y, np.zeros_like(x)], axis=-1))


def grid(cells: int, size: float = 1.0) -> Mesh:
    """The square [0, size]^2 in the plane z = 0 of 2 * cells^2 faces."""
    return rectangle((0.0, 0.0), (size, size), cells, cells)


def disc(cells: int, diameter: float) -> Mesh:
    """About the origin: the squares around the middle of a grid become rings."""
    square = rectangle((-1.0, -1.0), (1.0, 1.0), cells, cells)
    largest = np.abs(square.vertices).max(axis=1, keepdims=True)
    away = np.linalg.norm(square.vertices, axis=1, keepdims=True)
    return Mesh(0.5 * diameter * square.vertices * largest / np.maximum(away, 1e-9), square.faces)


def two_spheres() -> Mesh:
    """Two unit spheres, one unit apart."""
    one = icosphere(2)
    count = len(one.vertices)
    return Mesh(
        np.vstack([one.vertices, one.vertices + (3.0, 0.0, 0.0)]),
        np.vstack([one.faces, one.faces + np.uint32(count)]),
    )


def moebius(steps: int = 12) -> Mesh:
    """A strip with half a twist: it has one side only."""
    vertices = []
    for i in range(steps):
        u = 2 * np.pi * i / steps
        for v in (-0.3, 0.3):
            ring = 1 + v * np.cos(u / 2)
            vertices.append((ring * np.cos(u), ring * np.sin(u), v * np.sin(u / 2)))
    faces = []
    for i in range(steps):
        a, b = 2 * i, 2 * i + 1
        c, d = (2 * i + 2, 2 * i + 3) if i + 1 < steps else (1, 0)
        faces += [(a, c, b), (b, c, d)]
    return mesh(vertices, faces)


# ------------------------------------------------------------------------------------------------
# Curves


def points_at(surface: Mesh, faces: NDArray, barycentrics: NDArray) -> NDArray[np.float64]:
    """The positions (n, 3) of points given by face and barycentric coordinates."""
    return np.einsum("nk,nkd->nd", barycentrics, surface.vertices[surface.faces[faces]])


def pieces_of(offsets: NDArray, closed: NDArray) -> NDArray[np.int64]:
    """The straight pieces of a curve as pairs of point indices (k, 2), closing pieces included."""
    pieces = []
    for start, stop, is_closed in zip(offsets[:-1], offsets[1:], closed, strict=True):
        indices = np.arange(start, stop, dtype=np.int64)
        after = np.roll(indices, -1)
        pairs = np.stack([indices, after], axis=1)
        pieces.append(pairs if is_closed else pairs[:-1])
    return np.concatenate(pieces)


def off_faces(surface: Mesh, points: NDArray) -> NDArray[np.float64]:
    """How far each point is from each face, (n, m): its height over the plane of the face or, if
    greater, how far it is outside of one of the three sides."""
    a, b, c = (surface.vertices[surface.faces[:, corner]] for corner in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    distance = np.abs(points @ normal.T - np.sum(a * normal, axis=1))
    for start, end in ((a, b), (b, c), (c, a)):
        outward = np.cross(end - start, normal)
        outward /= np.linalg.norm(outward, axis=1, keepdims=True)
        outside = points @ outward.T - np.sum(start * outward, axis=1)
        np.maximum(distance, outside, out=distance)
    return distance


def off_surface(surface: Mesh, points: NDArray) -> NDArray[np.float64]:
    """How far each point is from the nearest face, in the sense of `off_faces`."""
    parts = [points[start : start + 2000] for start in range(0, len(points), 2000)]
    return np.concatenate([off_faces(surface, part).min(axis=1) for part in parts])


def crossings(
    surface: Mesh, positions: NDArray, offsets: NDArray, closed: NDArray
) -> list[tuple[int, int]]:
    """Pairs of pieces that cross inside a face, every pair in every face being tried.

    A piece belongs to each face that its middle lies in. Pieces that share a point are left out.
    """
    pieces = pieces_of(offsets, closed)
    start, end = positions[pieces[:, 0]], positions[pieces[:, 1]]
    tolerance = 1e-9 * np.ptp(surface.vertices, axis=0).max()
    inside: dict[int, list[int]] = {}
    for first in range(0, len(pieces), 2000):
        middles = (start[first : first + 2000] + end[first : first + 2000]) / 2
        rows, columns = np.nonzero(off_faces(surface, middles) < tolerance)
        for row, column in zip(rows.tolist(), columns.tolist(), strict=True):
            inside.setdefault(column, []).append(first + row)
    # Every face has its first vertex for an origin, and its first side for the x axis.
    origin, second, third = (surface.vertices[surface.faces[:, corner]] for corner in range(3))
    x, normal = second - origin, np.cross(second - origin, third - origin)
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    axes = np.stack([x, np.cross(normal, x)], axis=2)
    found = []
    for face, members in inside.items():
        if len(members) == 1:
            continue
        p, q = ((of[members] - origin[face]) @ axes[face] for of in (start, end))

        # side[i, j]: on which side of piece i the point j lies
        direction = q - p
        side_p = _cross(direction[:, None], p[None, :] - p[:, None])
        side_q = _cross(direction[:, None], q[None, :] - p[:, None])
        separates = side_p * side_q < 0
        # Of pieces on one line, far apart, rounding may say anything.
        low, high = np.minimum(p, q), np.maximum(p, q)
        separates &= (low[:, None] <= high[None, :]).all(axis=2)
        ends = pieces[members]
        shares = (ends[:, None, :, None] == ends[None, :, None, :]).any(axis=(2, 3))
        for i, j in np.argwhere(separates & separates.T & ~shares):
            if i < j:
                found.append((members[i], members[j]))
    return found


def _cross(a: NDArray, b: NDArray) -> NDArray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def triangle_areas(vertices: NDArray, faces: NDArray) -> NDArray[np.float64]:
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def sample_surface(surface: Mesh, count: int, seed: int = 1) -> NDArray[np.float64]:
    """Random points on a surface, evenly by area."""
    random = np.random.default_rng(seed)
    a, b, c = (surface.vertices[surface.faces[:, corner]] for corner in range(3))
    area = triangle_areas(*surface)
    face = random.choice(len(area), count, p=area / area.sum())
    u, v = random.random((2, count, 1))
    flip = u + v > 1
    u, v = np.where(flip, 1 - u, u), np.where(flip, 1 - v, v)
    return a[face] + u * (b - a)[face] + v * (c - a)[face]


def samples_of(positions: NDArray, offsets: NDArray, closed: NDArray, gap: float) -> NDArray:
    """Points along a curve, evenly spaced by at most `gap` on each piece: (k, 3)."""
    samples, _ = weighted_samples(positions, offsets, closed, gap)
    return samples


def weighted_samples(
    positions: NDArray, offsets: NDArray, closed: NDArray, gap: float
) -> tuple[NDArray, NDArray]:
    """As `samples_of`, and the length of curve that each sample stands for: (k, 3), (k,)."""
    pieces = pieces_of(offsets, closed)
    start, end = positions[pieces[:, 0]], positions[pieces[:, 1]]
    length = np.linalg.norm(end - start, axis=1)
    count = np.maximum(1, np.ceil(length / gap).astype(int))
    piece = np.repeat(np.arange(len(pieces)), count)
    within = np.arange(len(piece)) - np.repeat(np.cumsum(count) - count, count)
    share = ((within + 0.5) / count[piece])[:, None]
    return start[piece] + share * (end - start)[piece], (length / count)[piece]


def distance_to_samples(points: NDArray, samples: NDArray) -> NDArray[np.float64]:
    """The distance of each point to the nearest sample, straight through space."""
    nearest = []
    for block in blocks_of(points, len(samples)):
        squares = sum((block[:, k, None] - samples[:, k]) ** 2 for k in range(3))
        nearest.append(np.sqrt(squares.min(axis=1)))
    return np.concatenate(nearest)


def blocks_of(points: NDArray, others: int) -> list[NDArray]:
    """So few points each that a figure for all pairs with others stays in the processor's cache."""
    count = max(1, 50_000 // others)
    return [points[start : start + count] for start in range(0, len(points), count)]


def distance_to_pieces(points: NDArray, begin: NDArray, end: NDArray) -> NDArray[np.float64]:
    """The distance of each point to the nearest straight piece, in the plane or in space."""
    along = end - begin
    squares = np.maximum((along**2).sum(axis=1), 1e-300)
    axes = range(points.shape[1])
    nearest = []
    for block in blocks_of(points, len(begin)):
        away = [block[:, k, None] - begin[:, k] for k in axes]
        share = np.clip(sum(away[k] * along[:, k] for k in axes) / squares, 0.0, 1.0)
        apart = sum((away[k] - share * along[:, k]) ** 2 for k in axes)
        nearest.append(np.sqrt(apart.min(axis=1)))
    return np.concatenate(nearest)


def farthest(points: NDArray, way: NDArray) -> float:
    """The largest distance of points from a polyline, in the plane or in space."""
    return float(distance_to_pieces(points, way[:-1], way[1:]).max())


def plane_crossings(begin: NDArray, end: NDArray) -> int:
    """Pairs of pieces in the plane z = 0 that cross, by the signs of four areas."""
    a, b = begin[:, :2], end[:, :2]

    def side(p: NDArray, q: NDArray, r: NDArray) -> NDArray:
        return np.sign(_cross(q - p, r - p))

    i, j = np.triu_indices(len(a), 1)
    proper = (side(a[i], b[i], a[j]) * side(a[i], b[i], b[j]) < 0) & (
        side(a[j], b[j], a[i]) * side(a[j], b[j], b[i]) < 0
    )
    return int(proper.sum())


def ends_of(curve: Polylines) -> tuple[NDArray, NDArray]:
    """Where the straight pieces of a curve begin and end, (n, 3) each."""
    begin, end = curve.positions[pieces_of(curve.offsets, curve.closed)].swapaxes(0, 1)
    return begin, end


def curve_length(positions: NDArray, offsets: NDArray, closed: NDArray) -> float:
    """The length of a curve, closing pieces included."""
    pieces = pieces_of(offsets, closed)
    return float(np.linalg.norm(positions[pieces[:, 1]] - positions[pieces[:, 0]], axis=1).sum())
