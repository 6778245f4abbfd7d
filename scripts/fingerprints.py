#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fingerprints of curves, to see whether a change of the code changes a single byte of a result.

    fingerprints.py > before.txt             one line a case, half a minute on one core
    fingerprints.py --compare before.txt     exit code 1, and the cases that differ

A line is ``name sha256 nodes iterations stop_reason``; a case of fields or outlines has the number
of values in place of nodes. The digest covers the polylines, nodes, guides, gaps, data of the
points, statistics and history of a run, all but seconds. It holds for one machine with one numpy,
which computes the meshes; it is the same for any number of threads.

Runs go through the public names of `meander.core` only, so that the script also works on a checkout
whose inside is arranged differently: `--package` names the add-on's folder.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

DEFAULT_PACKAGE = Path(__file__).resolve().parents[1] / "addon" / "meander"

# An option that was renamed is the first of these names that there is.
RENAMED = {"border_distance": ("border_distance", "boundary_distance")}

# In this order. Figures that come later are left out, so that old fingerprints stay comparable.
STATISTICS = (
    "stop_reason", "iterations", "nodes", "strands", "closed_strands", "crossings", "polishing",
    "guides", "empty_components", "length", "energy", "mean_step", "spacing_target",
    "spacing_p05", "spacing_median", "spacing_p95",
)  # fmt: skip
HISTORY = ("iteration", "nodes", "length", "mean_step", "energy")
PREPARED = (
    "vertices", "faces", "components", "boundary_loops", "turned_faces", "unused_vertices",
    "merged_vertices", "dropped_faces", "split_vertices", "cut_edges", "masked_faces",
    "clipped_faces", "area", "diagonal",
)  # fmt: skip

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
    """A closed surface of one sphere's topology with bumps of several sizes."""
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
    """Two sheets that share one corner, every third face turned over."""
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
    """A run: a mesh with its options, and what else is given to it."""

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


# ------------------------------------------------------------------------------------------------
# Running them


class Digest:
    """A hash of arrays and numbers, whatever width their integers have."""

    def __init__(self) -> None:
        self._hash = hashlib.sha256()

    def add(self, *values: Any) -> None:
        for value in values:
            array = np.asarray(value)
            dtype = "<f8" if array.dtype.kind == "f" else "<i8"
            self._hash.update(repr(array.shape).encode())
            self._hash.update(np.ascontiguousarray(array, dtype=dtype).tobytes())

    def add_figures(self, figures: dict[str, Any], names: tuple[str, ...]) -> None:
        for name in names:
            value = figures[name]
            self._hash.update(f"{name}={value}".encode() if isinstance(value, str) else b"")
            if not isinstance(value, str):
                self.add(value)

    def text(self) -> str:
        return self._hash.hexdigest()


@dataclass(frozen=True)
class Row:
    """What is printed of a case."""

    name: str
    digest: str
    count: int
    iterations: int
    reason: str

    def __str__(self) -> str:
        return f"{self.name} {self.digest} {self.count} {self.iterations} {self.reason}"


def flow_options(core: ModuleType, case: Case, threads: int) -> Any:
    """The options of a case; raises AttributeError for one that the package does not have."""
    options = core.default_options(case.preset)
    options.radius = case.radius
    options.threads = threads
    enums = {
        "medial_axis": core.MedialAxis,
        "boundary_rule": core.BoundaryRule,
        "stop_rule": core.StopRule,
    }
    for key, value in case.options.items():
        names = [name for name in RENAMED.get(key, (key,)) if hasattr(options, name)]
        if not names:
            raise AttributeError(f"there is no option {key!r}; name its successor in RENAMED")
        setattr(options, names[0], enums[key][value] if key in enums else value)
    return options


def prepared_surface(core: ModuleType, case: Case, mesh: Mesh, threads: int) -> Any:
    preparation = None
    if case.preparation is not None:
        preparation = core.SurfaceOptions(**case.preparation(mesh))
    return core.Surface(*mesh, preparation, threads)


def add_curve(digest: Digest, flow: Any) -> None:
    """The state of a flow."""
    digest.add(*flow.polylines(), *flow.nodes(), flow.guides())
    digest.add(*flow.point_data())
    gaps = flow.gaps()
    digest.add(gaps.positions, gaps.radii, gaps.sizes, gaps.faces)
    digest.add_figures(flow.statistics(), STATISTICS)
    for record in flow.history():
        digest.add_figures(record, HISTORY)


def run_case(core: ModuleType, name: str, threads: int) -> Row:
    case, digest = CASES[name], Digest()
    mesh = case.mesh()
    with prepared_surface(core, case, mesh, threads) as surface:
        digest.add_figures(surface.statistics(), PREPARED)
        seed = None if case.seed is None else core.Seed(**case.seed())
        if case.outline:
            seed, skipped = surface.outlines(case.outline * case.radius, 2 * case.radius)
            digest.add(skipped)
        density = None if case.density is None else case.density(mesh[0])
        directions = None if case.directions is None else case.directions(surface, mesh[0])
        flow = core.Flow(surface, flow_options(core, case, threads), seed, density)
    with flow:
        if directions is not None:
            flow.set_directions(directions, case.kind)
        reason = flow.run()
        add_curve(digest, flow)
        for move in case.motion:
            flow.set_vertices(move(mesh[0]))
            digest.add(*flow.polylines())
            for _ in range(3):
                flow.step()
            add_curve(digest, flow)
        figures = flow.statistics()
    return Row(name, digest.text(), figures["nodes"], figures["iterations"], reason)


def field_rows(core: ModuleType, threads: int) -> dict[str, Callable[[], Row]]:
    """Cases without a flow: curvature, directions, outlines."""

    def row(name: str, mesh: Mesh, values_of: Callable[[Any], tuple[Any, ...]], **options) -> Row:
        digest = Digest()
        with core.Surface(*mesh, core.SurfaceOptions(**options), threads) as surface:
            values = values_of(surface)
        digest.add(*values)
        return Row(name, digest.text(), sum(np.size(value) for value in values), 0, "-")

    def curvature(smoothing: float) -> Callable[[Any], tuple[Any, ...]]:
        return lambda surface: tuple(surface.curvature(k, smoothing) for k in core.CURVATURES)

    def directions(smoothing: float) -> Callable[[Any], tuple[Any, ...]]:
        return lambda surface: tuple(surface.directions(k, smoothing) for k in core.DIRECTIONS)

    def extended(surface: Any) -> tuple[Any, ...]:
        seed = strands()
        return (surface.extended_directions(seed["points"], seed["offsets"]),)

    def outlines(distance: float, spacing: float) -> Callable[[Any], tuple[Any, ...]]:
        def of(surface: Any) -> tuple[Any, ...]:
            seed, skipped = surface.outlines(distance, spacing)
            return seed.points, seed.offsets, seed.closed, seed.guides, skipped

        return of

    rough, holes = sheet(24, 0.3), mask_of_disk(sheet(24, 0.3))
    return {
        "field_curvature": lambda: row("field_curvature", blob(24, 36), curvature(0.0)),
        "field_curvature_mean": lambda: row("field_curvature_mean", blob(24, 36), curvature(0.3)),
        "field_curvature_open": lambda: row("field_curvature_open", tube(), curvature(0.2)),
        "field_directions": lambda: row("field_directions", blob(24, 36), directions(0.2)),
        "field_directions_open": lambda: row("field_directions_open", tube(), directions(0.0)),
        "field_extended": lambda: row("field_extended", rough, extended),
        "outlines_sheet": lambda: row("outlines_sheet", rough, outlines(0.06, 0.05)),
        "outlines_holes": lambda: row("outlines_holes", rough, outlines(0.02, 0.04), **holes),
        "outlines_tube": lambda: row("outlines_tube", tube(), outlines(0.3, 0.2)),
    }


def rows(core: ModuleType, wanted: str, threads: int) -> Iterator[Row]:
    """The cases whose names contain `wanted`, in their order."""
    others = field_rows(core, threads)
    names = [name for name in (*CASES, *others) if wanted in name]
    if not names:
        sys.exit(f"fingerprints.py: no case has {wanted!r} in its name")
    for name in names:
        yield run_case(core, name, threads) if name in CASES else others[name]()


def load_core(package: Path) -> ModuleType:
    """`meander.core` of an add-on's folder, whatever is installed."""
    if not (package / "__init__.py").is_file():
        sys.exit(f"fingerprints.py: {package} is not the folder of the add-on; see --package")
    spec = importlib.util.spec_from_file_location(
        "meander", package / "__init__.py", submodule_search_locations=[str(package)]
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules["meander"] = module
    spec.loader.exec_module(module)
    return importlib.import_module("meander.core")


def differing(found: dict[str, str], saved: Path, wanted: str) -> list[str]:
    """The names of cases that are not as saved, in the order of the file and then of the run."""
    lines_of_file = saved.read_text().splitlines()
    before = {line.split()[0]: line for line in lines_of_file if line.strip()}
    names = [name for name in before if wanted in name]
    names += [name for name in found if name not in before]
    return [name for name in names if found.get(name) != before.get(name)]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--package", type=Path, default=DEFAULT_PACKAGE, help="the add-on's folder")
    parser.add_argument("--compare", type=Path, metavar="FILE", help="a saved output")
    parser.add_argument("--only", default="", metavar="SUBSTRING", help="of the names of cases")
    parser.add_argument("--threads", type=int, default=1, help="of a run; 0: all of the machine")
    arguments = parser.parse_args()
    core = load_core(arguments.package.resolve())
    found: dict[str, str] = {}
    for row in rows(core, arguments.only, arguments.threads):
        found[row.name] = str(row)
        print(row, flush=True)
    if arguments.compare is None:
        return 0
    names = differing(found, arguments.compare, arguments.only)
    for name in names:
        print(f"fingerprints.py: {name} differs", file=sys.stderr)
    return 1 if names else 0


if __name__ == "__main__":
    sys.exit(main())
