# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes whose faces, numbers or faults are hard, whatever their shape; plain numpy.

They join `SHAPES` of shapes.py. Those of `FAULTY` cannot be filled as they are: the library has to
refuse each with a sentence.
"""

from __future__ import annotations

import geometry
import numpy as np
from geometry import Mesh
from numpy.typing import NDArray
from shapes import Shape, fan, joined, moved, ring_of, shape, tetrahedron, turned

# ------------------------------------------------------------------------------------------------
# Faces


def _sheet_over(x: NDArray, y: NDArray) -> Mesh:
    """A flat sheet with its vertices at the given x and y, both rising."""
    cells = len(x) - 1
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    faces = geometry.grid(cells).faces
    return Mesh(np.column_stack([points, np.zeros(len(points))]), faces)


@shape
def needles() -> Mesh:
    """A sheet in which every other column of faces is needles of .0001 rad."""
    x = np.sort(np.concatenate([np.linspace(0, 1, 13), np.linspace(0, 1, 13)[:-1] + 8e-6]))
    return _sheet_over(x, np.linspace(0, 1, 25))


@shape
def caps() -> Mesh:
    """A sheet with caps, faces of which an angle is .0001 rad short of a straight one."""
    flat = geometry.grid(10)
    vertices, faces = list(flat.vertices), []
    for i, (a, b, c) in enumerate(flat.faces.tolist()):
        if i % 2:
            faces.append((a, b, c))
            continue
        # A vertex just inside of the longest edge, c a.
        middle = (flat.vertices[a] + flat.vertices[c]) / 2
        vertices.append(middle + 7e-5 * (flat.vertices[b] - middle))
        faces += [(a, b, len(vertices) - 1), (b, c, len(vertices) - 1), (c, a, len(vertices) - 1)]
    return geometry.mesh(vertices, faces)


@shape
def thinnest_allowed() -> Mesh:
    """A sheet with a column of faces twice as high as what counts as no area."""
    x = np.concatenate([np.linspace(0, 0.5, 7), np.linspace(0, 0.5, 6) + 0.5 + 4e-8])
    return _sheet_over(x, np.linspace(0, 1, 13))


@shape
def faces_of_all_sizes() -> Mesh:
    """A sheet of which the largest face has a million million times the area of the smallest."""
    steps = np.concatenate([[0.0], np.cumsum(1.78 ** np.arange(24))])
    return _sheet_over(steps / steps[-1], steps / steps[-1])


@shape
def ball_of_small_and_large_faces() -> Mesh:
    """A ball with rings that crowd at one pole: faces a million times larger than others."""
    z = 1 - 2 * np.concatenate([[0], 1e-6 * 1.6 ** np.arange(29), [1]])[::-1]
    return turned(np.sqrt(1 - z[1:-1] ** 2), z)


@shape
def valence_3() -> Mesh:
    """A ball of which every face is divided at a vertex of valence 3, twice."""
    mesh = geometry.icosphere(2)
    for _ in range(2):
        n = len(mesh.vertices)
        a, b, c = mesh.faces.astype(np.int64).T
        middle = n + np.arange(len(mesh.faces))
        faces = np.stack([[a, b, middle], [b, c, middle], [c, a, middle]]).transpose(2, 0, 1)
        centres = mesh.vertices[mesh.faces].mean(axis=1)
        mesh = Mesh(np.vstack([mesh.vertices, centres]), faces.reshape(-1, 3).astype(np.uint32))
    return mesh


@shape
def valence_3000() -> Mesh:
    """A disk of 3,000 faces about its centre."""
    angle = 2 * np.pi * np.arange(3000) / 3000
    return fan(np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1), np.zeros(3))


@shape
def two_vertices_of_valence_3000() -> Mesh:
    """A closed double cone of 6,000 faces."""
    return turned(np.array([1.0]), np.array([-0.7, 0.0, 0.7]), 3000)


@shape
def strip_of_one_row() -> Mesh:
    """An open strip one face wide, 300 faces long, as wide as r."""
    k = np.arange(302)
    vertices = np.stack([0.4 * k, k % 2, 0 * k], axis=1).astype(float)
    faces = np.stack([k[:-2], k[:-2] + 1 + k[:-2] % 2, k[:-2] + 2 - k[:-2] % 2], axis=1)
    return Mesh(vertices, faces.astype(np.uint32))


@shape
def hoop_of_one_row() -> Mesh:
    """A band one face wide, with two boundaries."""
    angle = 2 * np.pi * np.arange(80) / 80
    circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    return ring_of(np.stack([circle, circle + [0.0, 0.0, 0.2]]))


@shape
def one_face() -> Mesh:
    """A single triangle."""
    return geometry.mesh([(0, 0, 0), (1, 0, 0), (0.3, 0.8, 0)], [(0, 1, 2)])


@shape
def one_needle() -> Mesh:
    """A single triangle with an angle of .0001 rad."""
    return geometry.mesh([(0, 0, 0), (1, 0, 0), (1, 1e-4, 0)], [(0, 1, 2)])


@shape
def fine_ball() -> Mesh:
    """81,920 faces, each far smaller than a segment."""
    return geometry.icosphere(6)


@shape
def crumpled_sheet() -> Mesh:
    """Inner vertices moved in all directions by up to half a cell."""
    flat = geometry.grid(24)
    inner = np.abs(flat.vertices[:, :2] - 0.5).max(axis=1) < 0.499
    shifts = np.random.default_rng(5).uniform(-0.5, 0.5, flat.vertices.shape) / 24
    return Mesh(flat.vertices + shifts * inner[:, None], flat.faces)


@shape
def stretched_sheet() -> Mesh:
    """Faces 1,000 times as long as wide."""
    return moved(geometry.grid(30), (1.0, 0.001, 1.0))


@shape
def pillow_without_thickness() -> Mesh:
    """Two disks in the same place, joined along their rims: a closed surface of no volume."""
    angle = 2 * np.pi * np.arange(24) / 24
    rim = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    disk = fan(rim, np.zeros(3))
    beneath = np.where(disk.faces == 24, 25, disk.faces)[:, ::-1]
    vertices = np.vstack([disk.vertices, np.zeros((1, 3))])
    return Mesh(vertices, np.vstack([disk.faces, beneath]).astype(np.uint32))


@shape
def unordered_faces() -> Mesh:
    """A ball with its faces in any order, a third of them flipped, and vertices that none uses."""
    ball = geometry.icosphere(3)
    random = np.random.default_rng(9)
    faces = ball.faces[random.permutation(len(ball.faces))]
    faces[::3] = faces[::3, ::-1]
    return Mesh(np.vstack([ball.vertices, np.full((7, 3), 40.0)]), faces)


# ------------------------------------------------------------------------------------------------
# Numbers


@shape
def far_from_the_origin() -> Mesh:
    """Coordinates around a million on a torus of size 1."""
    return moved(geometry.torus(40, 20), 1.0, 1e6)


@shape
def very_far_from_the_origin() -> Mesh:
    """Coordinates around a thousand million: a face has 20 bits left for its shape."""
    return moved(geometry.torus(30, 15), 1.0, 1e9)


@shape
def tiny() -> Mesh:
    """A torus of size 1e-9."""
    return moved(geometry.torus(40, 20), 1e-9)


@shape
def huge() -> Mesh:
    """A torus of size 1e9."""
    return moved(geometry.torus(40, 20), 1e9)


@shape
def in_single_precision() -> Mesh:
    """A torus at 10,000 whose coordinates have been floats."""
    mesh = moved(geometry.torus(60, 30), 1.0, 1e4)
    return Mesh(mesh.vertices.astype(np.float32).astype(np.float64), mesh.faces)


# ------------------------------------------------------------------------------------------------
# Faults: none of these is a surface

FAULTY: dict[str, Shape] = {}


def faulty(function: Shape) -> Shape:
    """Adds a mesh that has to be refused."""
    FAULTY[function.__name__] = function
    return function


@faulty
def moebius_strip() -> Mesh:
    """It has one side only."""
    return geometry.moebius()


@faulty
def bow_tie() -> Mesh:
    """Two tetrahedra that share a vertex."""
    pair = joined(tetrahedron(), moved(tetrahedron(), -1.0, 2.0))
    return Mesh(pair.vertices, np.where(pair.faces == 4, 0, pair.faces).astype(np.uint32))


@faulty
def three_faces_on_an_edge() -> Mesh:
    """A sheet with a fin."""
    flat = geometry.grid(2)
    vertices = np.vstack([flat.vertices, [[0.5, 0.5, 1.0]]])
    return Mesh(vertices, np.vstack([flat.faces, [[1, 4, 9]]]).astype(np.uint32))


@faulty
def face_without_area() -> Mesh:
    """A face of which all corners are in a line."""
    return geometry.mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])


@faulty
def face_with_a_vertex_twice() -> Mesh:
    """A face that is an edge."""
    return geometry.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 1, 1)])


@faulty
def not_a_number() -> Mesh:
    """A coordinate that is NaN."""
    mesh = geometry.grid(4)
    mesh.vertices[7, 1] = np.nan
    return mesh


@faulty
def index_out_of_range() -> Mesh:
    """A face at a vertex that does not exist."""
    return geometry.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 3)])


@faulty
def same_face_three_times() -> Mesh:
    """Three faces with the same corners."""
    return geometry.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 1), (0, 1, 2)])
