# SPDX-License-Identifier: GPL-3.0-or-later
"""What fingerprints.py runs: computed meshes and seeds, and the cases made of them.

A mesh is vertices (n, 3) float64 and faces (m, 3) uint32; a seed is what core.Seed takes. Nothing
here uses the library.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Mesh = tuple[Points, NDArray[np.uint32]]


# ------------------------------------------------------------------------------------------------
# Meshes: vertices (n, 3) and faces (m, 3)


def rows_of_quads(rows: int, columns: int, around: bool, closed: bool) -> NDArray[np.uint32]:
    """The triangles of a grid of vertices, joined along its columns (around) and rows (closed)."""
    j, i = np.meshgrid(
        np.arange(rows if closed else rows - 1),
        np.arange(columns if around else columns - 1),
        indexing="ij",
    )
    following, above = (i + 1) % columns, (j + 1) % rows
    a, b = j * columns + i, j * columns + following
    c, d = above * columns + following, above * columns + i
    quads = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=2)
    return quads.reshape(-1, 3).astype(np.uint32)


def sheet(cells: int = 18, noise: float = 0.0, seed: int = 3) -> Mesh:
    """The unit square, its inner vertices shifted and lifted by up to `noise` of a cell."""
    x, y = np.meshgrid(np.linspace(0, 1, cells + 1), np.linspace(0, 1, cells + 1))
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    inner = np.abs(vertices[:, :2] - 0.5).max(axis=1) < 0.5
    shifts = np.random.default_rng(seed).uniform(-noise, noise, (len(vertices), 3)) / cells
    vertices[inner] += shifts[inner]
    return vertices, rows_of_quads(cells + 1, cells + 1, False, False)


def torus(around: int = 40, across: int = 20, tube: float = 0.4) -> Mesh:
    u = 2 * np.pi * np.repeat(np.arange(around), across) / around
    v = 2 * np.pi * np.tile(np.arange(across), around) / across
    ring = 1.0 + tube * np.cos(v)
    vertices = np.stack([ring * np.cos(u), ring * np.sin(u), tube * np.sin(v)], axis=1)
    return vertices, rows_of_quads(around, across, True, True)


def tube(around: int = 26, along: int = 20, height: float = 4.0) -> Mesh:
    """An open tube of radius 1 about the z axis, with a waist."""
    angle = 2 * np.pi * np.tile(np.arange(around), along + 1) / around
    level = np.repeat(np.linspace(0.0, height, along + 1), around)
    wide = 1.0 - 0.25 * np.sin(np.pi * level / height)
    vertices = np.stack([wide * np.cos(angle), wide * np.sin(angle), level], axis=1)
    return vertices, rows_of_quads(along + 1, around, True, False)


def blob(rings: int = 16, around: int = 24) -> Mesh:
    """A closed surface with the topology of a sphere and bumps of several sizes."""
    theta = np.pi * np.arange(1, rings) / rings
    phi = 2 * np.pi * np.arange(around) / around
    t, p = (grid.ravel() for grid in np.meshgrid(theta, phi, indexing="ij"))
    directions = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=1)
    directions = np.vstack([directions, [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]])
    x, y, z = directions.T
    radius = 1.0 + 0.15 * np.sin(3 * x + 1) * np.cos(4 * y) + 0.1 * np.sin(5 * z + 2 * x)
    side = rows_of_quads(rings - 1, around, True, False)[:, ::-1]
    i = np.arange(around)
    after, last = (i + 1) % around, (rings - 2) * around
    top = np.stack([np.full(around, len(x) - 2), i, after], axis=1)
    bottom = np.stack([np.full(around, len(x) - 1), last + after, last + i], axis=1)
    return directions * radius[:, None], np.vstack([side, top, bottom]).astype(np.uint32)


def cube() -> Mesh:
    """[-1, 1]^3 of 12 faces: every face is far larger than a segment."""
    corners = [[x, y, z] for z in (-1.0, 1.0) for y in (-1.0, 1.0) for x in (-1.0, 1.0)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    faces = [corner for a, b, c, d in quads for corner in ((a, b, c), (a, c, d))]
    return np.array(corners), np.array(faces, dtype=np.uint32)


def tetrahedron() -> Mesh:
    """That of the README: no numpy has a part in its numbers."""
    corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]]
    return np.array(corners), np.array([(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)], np.uint32)


def plate(cells: int = 10, thickness: float = 0.02) -> Mesh:
    """A closed thin box over the unit square: its two sheets are much closer than strands."""
    vertices, faces = sheet(cells)
    n, row, edge = len(vertices), cells + 1, np.arange(cells)
    rim = np.concatenate([edge, edge * row + cells, row * row - 1 - edge, (cells - edge) * row])
    after = np.roll(rim, -1)
    walls = np.hstack([[rim, rim + n, after + n], [rim, after + n, after]]).T
    both = np.vstack([vertices, vertices - [0.0, 0.0, thickness]])
    return both, np.vstack([faces, faces[:, ::-1] + n, walls]).astype(np.uint32)


def joined(*parts: Mesh) -> Mesh:
    firsts = np.cumsum([0] + [len(vertices) for vertices, _ in parts])
    faces = [faces + np.uint32(first) for (_, faces), first in zip(parts, firsts)]
    return np.vstack([vertices for vertices, _ in parts]), np.vstack(faces)


def several() -> Mesh:
    vertices, faces = blob(12, 16)
    return joined((vertices, faces), (vertices * 0.6 + [2.5, 0, 0], faces), cube_at(6.0), sheet(6))


def cube_at(x: float) -> Mesh:
    vertices, faces = cube()
    return vertices * 0.5 + [x, 0.0, 0.0], faces


def faulty() -> Mesh:
    """A sheet as loose triangles, some twice or without area, and a fin on one of its edges."""
    vertices, faces = sheet(12, 0.2)
    soup = vertices[faces].reshape(-1, 3)
    loose = np.arange(len(soup), dtype=np.uint32).reshape(-1, 3)
    fin = np.vstack([vertices[[84, 85]], [[vertices[84, 0], vertices[84, 1], 0.3]]])
    extra = np.array([[0, 1, 2], [0, 0 + 3, 1]], dtype=np.uint32) + np.uint32(len(soup))
    points = np.vstack([soup, fin, fin[:1]])
    return points, np.vstack([loose, loose[40:44], extra])


def bow_tie() -> Mesh:
    """Two sheets that share one corner, every third face flipped."""
    vertices, faces = sheet(8, 0.2)
    beyond = faces + np.uint32(len(vertices))
    beyond[faces == 0] = len(vertices) - 1
    both = np.vstack([faces, beyond])
    both[::3] = both[::3, ::-1]
    return np.vstack([vertices, vertices + [1.0, 1.0, 0.0]]), both


# ------------------------------------------------------------------------------------------------
# Seeds, as arguments of core.Seed


def lines(*strands: tuple[Any, bool]) -> dict[str, Any]:
    """Strands of points, closed or open."""
    parts = [np.asarray(points, dtype=np.float64) for points, _closed in strands]
    return {
        "points": np.vstack(parts),
        "offsets": np.cumsum([0] + [len(part) for part in parts]).astype(np.uint32),
        "closed": np.array([closed for _points, closed in strands], dtype=np.uint8),
    }


def circle(x: float, y: float, radius: float, count: int = 24) -> Points:
    angle = 2 * np.pi * np.arange(count) / count
    return np.stack([x + radius * np.cos(angle), y + radius * np.sin(angle), 0 * angle], axis=1)


def stroke() -> dict[str, Any]:
    """One open strand across a sheet whose ends stay."""
    seed = lines(([[0.1, 0.15, 0.0], [0.9, 0.8, 0.0]], False))
    return seed | {"fixed": np.ones(2, dtype=np.uint8)}


def strands() -> dict[str, Any]:
    """Open and closed strands, fixed nodes among them."""
    bend = [[0.1, 0.2, 0.0], [0.3, 0.25, 0.0], [0.4, 0.1, 0.0]]
    seed = lines((bend, False), (circle(0.65, 0.3, 0.08), True), (circle(0.3, 0.7, 0.1), True))
    fixed = np.zeros(len(seed["points"]), dtype=np.uint8)
    fixed[[0, 2, 6, 40]] = 1
    return seed | {"fixed": fixed}


def guides() -> dict[str, Any]:
    """An open and a closed guide, a strand between them, and loops where nothing grows."""
    bar = [[0.1, 0.5, 0.0], [0.6, 0.55, 0.0]]
    seed = lines((bar, False), (circle(0.7, 0.25, 0.15), True), ([[0.2, 0.7, 0], [0.8, 0.8, 0]], 0))
    return seed | {"guides": np.array([1, 1, 0], dtype=np.uint8), "loops": True}


# ------------------------------------------------------------------------------------------------
# Cases


@dataclass
class Case:
    """A run: a mesh, its options, and everything else that is given to it."""

    mesh: Callable[[], Mesh]
    radius: float
    preset: str = "even"
    options: dict[str, Any] = field(default_factory=dict)
    seed: Callable[[], dict[str, Any]] | None = None
    density: Callable[[Points], Points] | None = None
    directions: Callable[[Any, Points], Points] | None = None  # of the surface and its vertices
    kind: str = "along"
    preparation: Callable[[Mesh], dict[str, Any]] | None = None
    outline: float = 0.0  # distance of outlines taken as guides, in radii; 0: none
    motion: tuple[Callable[[Points], Points], ...] = ()  # each followed by three steps


def limited(iterations: int, **options: Any) -> dict[str, Any]:
    return {"iteration_limit": iterations, **options}


def slope(vertices: Points) -> Points:
    """A density from 1 to 4 along x."""
    x = vertices[:, 0]
    return 1.0 + 3.0 * (x - x.min()) / np.ptp(x)


def field_x(_surface: Any, vertices: Points) -> Points:
    return np.tile([1.0, 0.0, 0.0], (len(vertices), 1))


def computed(kind: str, smoothing: float = 0.0) -> Callable[[Any, Points], Points]:
    return lambda surface, _vertices: surface.directions(kind, smoothing)


def bent(share: float) -> Callable[[Points], Points]:
    """Bends a tube sideways and stretches it."""

    def move(vertices: Points) -> Points:
        z = vertices[:, 2]
        return vertices * [1.0, 1.0, 1.0 + 0.2 * share] + np.outer(z * z, [0.06 * share, 0.0, 0.0])

    return move


def mask_of_disk(mesh: Mesh) -> dict[str, Any]:
    vertices, faces = mesh
    left_out = np.zeros(len(faces), dtype=bool)
    left_out[:9] = True
    outside = np.hypot(vertices[:, 0] - 0.55, vertices[:, 1] - 0.5) - 0.2
    return {"vertex_mask": outside, "mask_threshold": 0.013, "face_mask": ~left_out}


def mended(_mesh: Mesh) -> dict[str, Any]:
    return {"merge_distance": 1e-4, "drop_degenerate": True, "split_bow_ties": True,
            "cut_non_manifold": True}  # fmt: skip


def waist(mesh: Mesh) -> dict[str, Any]:
    return {"vertex_mask": mesh[0][:, 2], "mask_threshold": 0.9}


MOTION = (bent(0.3), bent(0.6), bent(1.0))

CASES: dict[str, Case] = {
    # Presets and medial axes, to the end of each run
    "even_torus": Case(torus, 0.074),
    "even_blob": Case(blob, 0.068),
    "even_cube": Case(cube, 0.12),
    "even_tetrahedron": Case(tetrahedron, 0.1),
    "even_sheet": Case(lambda: sheet(16, 0.3), 0.022),
    "finest_torus": Case(torus, 0.099, "finest"),
    "finest_sheet": Case(sheet, 0.031, "finest"),
    "paper_torus": Case(torus, 0.087, "paper"),
    "paper_blob": Case(blob, 0.093, "paper"),
    "geodesic_blob": Case(blob, 0.099, "even", {"medial_axis": "GEODESIC"}),
    "geodesic_plate": Case(plate, 0.037, "even", {"medial_axis": "GEODESIC"}),
    "geodesic_paper_cube": Case(cube, 0.15, "paper", dict(medial_axis="GEODESIC")),
    "geodesic_finest_sheet": Case(sheet, 0.043, "finest", limited(80, medial_axis="GEODESIC")),
    "euclidean_plate": Case(plate, 0.031),
    "even_fine_torus": Case(lambda: torus(130, 60), 0.13),
    "geodesic_fine_torus": Case(lambda: torus(100, 50), 0.16, "even",
                                dict(medial_axis="GEODESIC")),
    # Density, terms of the energy, schedule
    "density_sheet": Case(sheet, 0.037, density=slope),
    "density_paper_blob": Case(blob, 0.11, "paper", density=slope),
    "density_geodesic": Case(blob, 0.15, "even", dict(medial_axis="GEODESIC"),
                             density=slope),
    "powers": Case(blob, 0.087, "even", dict(length_power=3.0, medial_power=4.0)),
    "powers_paper": Case(torus, 0.093, "paper", limited(50, length_power=4.5, medial_power=2.5)),
    "weights": Case(torus, 0.087, "even", dict(length_weight=0.4, bending_weight=0.3,
                                                 medial_weight=1.3)),
    "start_spacing": Case(torus, 0.074, "even", {"start_spacing_factor": 3.0}),
    "start_spacing_density": Case(sheet, 0.031, "even", dict(start_spacing_factor=4.0),
                                  density=slope),
    "segments_and_clamp": Case(blob, 0.087, "even", dict(segment_length=0.05,
                                                           max_radius=0.5, step=0.7)),
    "no_polish": Case(blob, 0.074, "even", {"polish": False}),
    "paper_rule": Case(blob, 0.087, "even", limited(150, stop_rule="PAPER")),
    "few_steps": Case(blob, 0.062, "finest", limited(5)),
    # Directions
    "align_along": Case(sheet, 0.025, "even", dict(alignment_weight=2.0),
                        directions=field_x),
    "align_across": Case(sheet, 0.025, "even", dict(alignment_weight=2.0),
                         directions=field_x, kind="across"),
    "align_curvature_min": Case(torus, 0.087, "even", dict(alignment_weight=1.0),
                                directions=computed("curvature_min", 0.1)),
    "align_curvature_max": Case(blob, 0.087, "paper", dict(alignment_weight=1.0),
                                directions=computed("curvature_max", 0.2)),
    "align_smooth": Case(blob, 0.087, "even", limited(60, alignment_weight=1.0),
                         directions=computed("smooth")),
    # Strands
    "stroke": Case(sheet, 0.022, seed=stroke),
    "stroke_paper": Case(lambda: sheet(14, 0.3), 0.031, "paper", seed=stroke),
    "strands": Case(sheet, 0.025, seed=strands),
    "strands_geodesic": Case(sheet, 0.037, "even", dict(medial_axis="GEODESIC"),
                             seed=strands),
    "guides": Case(lambda: sheet(14, 0.2), 0.022, seed=guides),
    "guides_finest": Case(sheet, 0.031, "finest", limited(60), seed=guides),
    # Boundary, outlines
    "border_distance_0": Case(sheet, 0.025, "even", dict(border_distance=0.0)),
    "border_distance_1": Case(sheet, 0.022, "even", dict(border_distance=1.2)),
    "border_obstacle": Case(sheet, 0.025, "even", limited(60, boundary_rule="OBSTACLE")),
    "border_geodesic": Case(lambda: tube(20, 14), 0.15, "even",
                            dict(border_distance=1.0, medial_axis="GEODESIC")),
    "border_tube": Case(tube, 0.099, "paper"),
    "outline_run": Case(sheet, 0.022, outline=1.0, preparation=mask_of_disk),
    # Components, prepared meshes
    "components": Case(several, 0.074, "even", limited(60)),
    "components_geodesic": Case(several, 0.099, "even", limited(40, medial_axis="GEODESIC")),
    "mended": Case(faulty, 0.031, preparation=mended),
    "bow_tie": Case(bow_tie, 0.035, preparation=mended),
    "masked": Case(sheet, 0.022, preparation=mask_of_disk),
    # Motion
    "motion": Case(tube, 0.14, motion=MOTION),
    "motion_geodesic": Case(tube, 0.19, "even", dict(medial_axis="GEODESIC"), motion=MOTION),
    "motion_density": Case(tube, 0.19, density=lambda v: 1.0 + v[:, 2] / 4, motion=MOTION),
    "motion_masked": Case(tube, 0.14, preparation=waist, motion=MOTION),
    "motion_aligned": Case(tube, 0.15, "even", dict(alignment_weight=1.0),
                           directions=computed("smooth"), motion=MOTION),
}  # fmt: skip
