# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces that are hard to fill, each a small function; plain numpy.

`SHAPES` has them by name, and the docstring of each says what is hard about it. Lengths in r mean
the nominal radius, a 20th of the root of the area. meshes_at_the_limit.py adds meshes that are hard
for their faces rather than for their shape.
"""

from __future__ import annotations

from collections.abc import Callable

import geometry
import numpy as np
import thin_shapes
from geometry import Mesh
from numpy.typing import NDArray

Shape = Callable[[], Mesh]

SHAPES: dict[str, Shape] = {}


def shape(function: Shape) -> Shape:
    """Adds a function to the shapes of the sweep."""
    SHAPES[function.__name__] = function
    return function


def area_of(mesh: Mesh) -> float:
    """The area of all faces."""
    return float(geometry.triangle_areas(*mesh).sum())


def nominal_radius(mesh: Mesh) -> float:
    """A 20th of the root of the area: about 700 nodes."""
    return area_of(mesh) ** 0.5 / 20


def joined(*parts: Mesh) -> Mesh:
    """All parts in one mesh, as components of their own."""
    firsts = np.cumsum([0] + [len(part.vertices) for part in parts[:-1]])
    faces = [part.faces + np.uint32(first) for part, first in zip(parts, firsts)]
    return Mesh(np.vstack([part.vertices for part in parts]), np.vstack(faces))


def moved(mesh: Mesh, scale: object = 1.0, offset: object = 0.0) -> Mesh:
    """The vertices times `scale` plus `offset`, numbers or triples."""
    return Mesh(mesh.vertices * np.asarray(scale) + np.asarray(offset), mesh.faces)


def ring_of(rows: NDArray, closed: bool = False) -> Mesh:
    """The surface over rows of points (m, n, 3), each closed; `closed`: also the last to the first.

    Without `closed` the first and the last row are boundaries.
    """
    m, n = rows.shape[:2]
    i, j = np.meshgrid(np.arange(m if closed else m - 1), np.arange(n), indexing="ij")
    a, b = i * n + j, i * n + (j + 1) % n
    c, d = (i + 1) % m * n + (j + 1) % n, (i + 1) % m * n + j
    faces = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=2)
    return Mesh(rows.reshape(-1, 3), faces.reshape(-1, 3).astype(np.uint32))


def turned(radii: NDArray, heights: NDArray, around: int = 24) -> Mesh:
    """A closed surface of revolution about z, with a pole below the first ring and above the last.

    `radii` (m,) of the rings; `heights` (m + 2,) of the lower pole, the rings and the upper pole.
    """
    angle = 2 * np.pi * np.arange(around) / around
    circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    rows = radii[:, None, None] * circle + heights[1:-1, None, None] * np.array([0.0, 0.0, 1.0])
    side = ring_of(rows)
    n, j = len(side.vertices), np.arange(around)
    after, last = (j + 1) % around, n - around
    lower = np.stack([np.full(around, n), after, j], axis=1)
    upper = np.stack([np.full(around, n + 1), last + j, last + after], axis=1)
    poles = [[0.0, 0.0, heights[0]], [0.0, 0.0, heights[-1]]]
    faces = np.vstack([side.faces, lower, upper]).astype(np.uint32)
    return Mesh(np.vstack([side.vertices, poles]), faces)


def fan(rim: NDArray, centre: NDArray, closed: bool = True) -> Mesh:
    """Faces from a centre to a rim of points (n, 3)."""
    n = len(rim)
    j = np.arange(n if closed else n - 1)
    faces = np.stack([np.full(len(j), n), j, (j + 1) % n], axis=1).astype(np.uint32)
    return Mesh(np.vstack([rim, centre]), faces)


def noisy(mesh: Mesh, along: NDArray, seed: int, amount: float) -> Mesh:
    """Octaves of waves, each half as long and nearly half as high, along the given normals."""
    random = np.random.default_rng(seed)
    height = np.zeros(len(mesh.vertices))
    for octave in range(6):
        for _ in range(4):
            wave = random.normal(size=3) * 3 * 2.0**octave
            height += np.sin(mesh.vertices @ wave + random.uniform(0, 6)) * 0.6**octave
    return Mesh(mesh.vertices + amount * height[:, None] * along, mesh.faces)


# ------------------------------------------------------------------------------------------------
# Thin


@shape
def plate_of_a_hundredth_of_r() -> Mesh:
    """A closed plate .01 r thick: its sides are closer than anything the flow measures."""
    return thin_shapes.plate(0.0113)


@shape
def plate_of_a_tenth_of_r() -> Mesh:
    """A closed plate .1 r thick, of 4 faces a side."""
    return thin_shapes.plate(0.113, cells=1)


@shape
def plate_of_one_r() -> Mesh:
    """A closed plate r thick: the walls are as wide as half a spacing."""
    return thin_shapes.plate(1.13)


@shape
def blade() -> Mesh:
    """A plate that tapers to an edge of .01 r."""
    return thin_shapes.blade()


@shape
def folded_cloth() -> Mesh:
    """Three layers of one open sheet, a tenth of r apart, with round folds."""
    return thin_shapes.folded_cloth()


@shape
def sharp_fold() -> Mesh:
    """Two halves of a sheet that meet at an angle of .001 rad."""
    flat = geometry.grid(12)
    x = np.abs(flat.vertices[:, 0] - 0.5)
    side = np.where(flat.vertices[:, 0] < 0.5, -1.0, 1.0)
    vertices = np.stack([x, flat.vertices[:, 1], side * x * 0.0005], axis=1)
    return Mesh(vertices, flat.faces)


@shape
def pleats() -> Mesh:
    """A sheet folded to and fro forty times, closer than r."""
    flat = geometry.grid(40, 2.0)
    steps = np.rint(flat.vertices[:, 0] / 0.05).astype(int)
    vertices = np.stack([0.002 * steps, flat.vertices[:, 1], 0.5 * (steps % 2)], axis=1)
    return Mesh(vertices, flat.faces)


@shape
def hollow_ball() -> Mesh:
    """A bumpy ball inside another one."""
    return thin_shapes.hollow_ball()


@shape
def torus_thinner_than_r() -> Mesh:
    """A ring whose tube has a tenth of r as its radius: no two strands fit beside each other."""
    return geometry.torus(120, 6, 1.0, 0.0005)


@shape
def torus_as_thin_as_r() -> Mesh:
    """A ring whose tube has the radius r."""
    return geometry.torus(80, 8, 1.0, 0.1)


@shape
def annulus_thinner_than_r() -> Mesh:
    """A flat ring a tenth of r wide, of one row of faces."""
    angle = 2 * np.pi * np.arange(60) / 60
    circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    return ring_of(np.stack([circle, 1.0002 * circle]))


@shape
def comb() -> Mesh:
    """A sheet with forty teeth narrower than r."""
    vertices, faces = [], []
    for i in range(41):
        x = i / 40
        vertices += [(x, 0, 0), (x, 0.1, 0), (x + 0.012, 0.1, 0)]
        vertices += [(x + 0.006, 1, 0), (x + 0.012, 0, 0)]
    for i in range(40):
        a, b = 5 * i, 5 * i + 5
        faces += [(a, a + 4, a + 2), (a, a + 2, a + 1), (a + 1, a + 2, a + 3)]
        faces += [(a + 4, b, b + 1), (a + 4, b + 1, a + 2)]
    return geometry.mesh(vertices[: 5 * 40 + 2], faces)


# ------------------------------------------------------------------------------------------------
# Sharp


@shape
def cube_of_12_faces() -> Mesh:
    """Every face is far larger than a segment."""
    return geometry.cube()


@shape
def tetrahedron() -> Mesh:
    """The fewest faces of a closed surface."""
    corners = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    return geometry.mesh(corners, [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])


@shape
def needle_tetrahedron() -> Mesh:
    """A closed needle: angles of .0001 rad at its tip."""
    corners = [(0, 0, 0), (1e-4, 0, 0), (0, 1e-4, 0), (0, 0, 1)]
    return geometry.mesh(corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])


@shape
def cone_with_a_needle_tip() -> Mesh:
    """A cone 1,000 times as high as wide, without a base."""
    angle = 2 * np.pi * np.arange(12) / 12
    rim = np.stack([0.01 * np.cos(angle), 0.01 * np.sin(angle), 0 * angle], axis=1)
    return fan(rim, np.array([0.0, 0.0, 10.0]))


@shape
def spiky_ball() -> Mesh:
    """A ball with 42 spikes as long as its radius, on one vertex each."""
    ball = geometry.icosphere(3)
    vertices = ball.vertices.copy()
    vertices[:42] *= 2.0
    return Mesh(vertices, ball.faces)


@shape
def one_long_spike() -> Mesh:
    """A ball with a spike of 50 radii on one vertex."""
    ball = geometry.icosphere(3)
    vertices = ball.vertices.copy()
    vertices[0] *= 50.0
    return Mesh(vertices, ball.faces)


@shape
def star() -> Mesh:
    """A flat disk with 24 points of 5 degrees."""
    angle = 2 * np.pi * np.arange(48) / 48
    far = np.where(np.arange(48) % 2, 0.35, 1.0)
    return fan(np.stack([far * np.cos(angle), far * np.sin(angle), 0 * angle], axis=1), np.zeros(3))


@shape
def saw() -> Mesh:
    """A sheet of ridges of 10 degrees, as wide as r."""
    flat = geometry.grid(40)
    height = np.where(np.rint(flat.vertices[:, 0] * 40) % 2, 0.14, 0.0)
    return Mesh(np.stack([*flat.vertices[:, :2].T, height], axis=1), flat.faces)


@shape
def fractal_sheet() -> Mesh:
    """Noise of six octaves, the shortest as long as a face."""
    flat = geometry.grid(40)
    return noisy(flat, np.array([0.0, 0.0, 1.0]), 3, 0.03)


@shape
def fractal_ball() -> Mesh:
    """Noise of six octaves on a ball."""
    ball = geometry.icosphere(4)
    return noisy(ball, ball.vertices, 4, 0.03)


@shape
def flat_ball() -> Mesh:
    """A ball 1,000 times as wide as high."""
    return moved(geometry.icosphere(3), (1.0, 1.0, 0.001))


@shape
def long_ball() -> Mesh:
    """A ball 1,000 times as long as wide."""
    return moved(geometry.icosphere(3), (0.001, 0.001, 1.0))


@shape
def ruffle() -> Mesh:
    """A disk with far too much rim: faces of 16 right angles about its centre."""
    k = np.arange(64)
    angle = 2 * np.pi * k / 64
    rim = np.stack([np.cos(angle), np.sin(angle), 1.5 * (-1.0) ** k], axis=1)
    return fan(rim, np.zeros(3))


@shape
def helicoid() -> Mesh:
    """A spiral stair of eight turns, closer than r."""
    turn = np.linspace(0, 16 * np.pi, 200)
    across = np.linspace(0.1, 1.0, 5)
    x, y = (f(turn)[:, None] * across for f in (np.cos, np.sin))
    z = np.broadcast_to(0.02 * turn[:, None] / np.pi, x.shape)
    return thin_shapes.surface_of(np.stack([x, y, z], axis=2))


# ------------------------------------------------------------------------------------------------
# Topology


@shape
def through_each_other() -> Mesh:
    """Two squares that pass through each other at 20 degrees."""
    return thin_shapes.crossing_sheets()


@shape
def balls_in_each_other() -> Mesh:
    """Five balls of which each passes through its neighbours."""
    ball = geometry.icosphere(2)
    return joined(*(moved(ball, 1.0, (0.7 * k, 0.1 * k, 0.0)) for k in range(5)))


@shape
def doubled_sheet() -> Mesh:
    """Two sheets in the same place."""
    return joined(geometry.grid(8), geometry.grid(8))


@shape
def ten_thousand_components() -> Mesh:
    """10,000 tetrahedra, each as large as a spacing."""
    i = np.arange(10_000)
    places = np.stack([i % 22, i // 22 % 22, i // 484], axis=1)
    one = tetrahedron()
    vertices = (one.vertices[None] * 0.3 + places[:, None]).reshape(-1, 3)
    faces = (one.faces[None] + 4 * i[:, None, None]).reshape(-1, 3)
    return Mesh(vertices, faces.astype(np.uint32))


@shape
def components_of_all_sizes() -> Mesh:
    """40 cubes, the largest 3,000 times as large as the smallest."""
    sizes = 3000.0 ** (-np.arange(40) / 39)
    places = np.cumsum(3 * sizes)
    return joined(*(moved(geometry.cube(), s, (x, 0, 0)) for s, x in zip(sizes, places)))


@shape
def sheet_of_400_holes() -> Mesh:
    """A sheet without every ninth cell, in rows: spaces of r between holes."""
    flat = geometry.grid(60)
    cell = np.arange(len(flat.faces)) // 2
    hole = (cell % 60 % 3 == 1) & (cell // 60 % 3 == 1)
    return Mesh(flat.vertices, flat.faces[~hole])


@shape
def pinhole() -> Mesh:
    """A sheet with a hole of a thousandth of r."""
    angle = 2 * np.pi * np.arange(16) / 16
    circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    return ring_of(np.stack([circle * far for far in (5e-5, 1e-3, 2e-2, 0.3, 1.0)]))


@shape
def lattice() -> Mesh:
    """A cube with square tunnels along every axis: genus 5, right angles only."""
    full = np.ones((3, 3, 3), dtype=bool)
    for axis in range(3):
        index: list[slice | int] = [1, 1, 1]
        index[axis] = slice(None)
        full[tuple(index)] = False
    return _surface_of_cells(full)


def _surface_of_cells(full: NDArray[np.bool_]) -> Mesh:
    """The boundary of a set of unit cells."""
    numbers: dict[tuple[int, ...], int] = {}
    faces = []
    padded = np.pad(full, 1)
    for place in np.argwhere(padded):
        for axis in range(3):
            for side in (0, 1):
                beyond = place.copy()
                beyond[axis] += 2 * side - 1
                if padded[tuple(beyond)]:
                    continue
                corner = place.copy()
                corner[axis] += side
                u, v = np.eye(3, dtype=int)[[(axis + 1) % 3, (axis + 2) % 3]]
                square = [corner, corner + u, corner + u + v, corner + v]
                quad = [numbers.setdefault(tuple(map(int, c)), len(numbers)) for c in square]
                a, b, c, d = quad if side else quad[::-1]
                faces += [(a, b, c), (a, c, d)]
    return geometry.mesh(list(numbers), faces)


@shape
def knot() -> Mesh:
    """A tube of radius r in a trefoil knot."""
    t = 2 * np.pi * np.arange(160) / 160
    line = np.stack(
        [np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], axis=1
    )
    along = np.roll(line, -1, axis=0) - np.roll(line, 1, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    one = np.cross(along, [0.0, 0.0, 1.0])
    one /= np.linalg.norm(one, axis=1, keepdims=True)
    other = np.cross(along, one)
    angle = 2 * np.pi * np.arange(8) / 8
    rows = line[:, None] + 0.3 * (
        np.cos(angle)[None, :, None] * one[:, None] + np.sin(angle)[None, :, None] * other[:, None]
    )
    return ring_of(rows, closed=True)


@shape
def hourglass() -> Mesh:
    """Two bulbs joined by a neck of a hundredth of r."""
    z = np.linspace(-1, 1, 31)
    radii = np.maximum(np.abs(np.sin(np.pi * z)), 0.0015)[1:-1]
    return turned(radii, z)


@shape
def string_of_beads() -> Mesh:
    """Eight bulbs on necks of r / 10."""
    z = np.linspace(0, 8, 81)
    radii = np.maximum(0.5 * np.abs(np.sin(np.pi * z)), 0.02)[1:-1]
    return turned(radii, z)


@shape
def dimple() -> Mesh:
    """A ball pushed in from above until its sides nearly meet."""
    z = np.cos(np.linspace(np.pi, 0, 41))
    radii = np.sqrt(np.maximum(1 - z * z, 0))[1:-1]
    return turned(radii, np.where(z > 0, 0.02 - 0.97 * z, z))
