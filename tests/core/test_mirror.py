# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry: one half of a surface is filled and mirrored, judged by brute force."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import geometry
import numpy as np
import pytest
from flows import fill, options_of
from meander import core
from meander.model.geometry.half_mesh import above, section
from meander.model.geometry.reflection import Mirror, mirror_of
from meander.model.mirror_whole import whole_of
from meander.model.opening import open_flow
from meander.model.problem import Problem
from sentences import assert_sentence


@dataclass(frozen=True)
class Filled:
    mesh: geometry.Mesh
    spacing: float
    mirror: Mirror
    curve: core.Polylines
    data: core.PointData
    guides: np.ndarray
    statistics: dict[str, Any]
    figures: dict[str, Any]
    sources: np.ndarray

    def heights(self) -> np.ndarray:
        return self.mirror.heights(self.curve.positions)

    def crossings(self) -> list[tuple[int, int]]:
        curve = self.curve
        return geometry.crossings(self.mesh, curve.positions, curve.offsets, curve.closed)


def filled(
    mesh: geometry.Mesh,
    spacing: float,
    mirror: Mirror | str = "x",
    begin: Callable[[Problem], object] = lambda problem: None,
    **changes,
) -> Filled:
    """A run with symmetry to its end; `changes` are options, and parts of a problem.

    begin   called with the problem before it is opened
    """
    options = core.default_options(changes.pop("preset", "even"))
    options.radius = spacing / 2
    for name in [name for name in changes if hasattr(options, name)]:
        setattr(options, name, changes.pop(name))
    if isinstance(mirror, str):
        mirror = mirror_of(mirror)
    problem = Problem(mesh.vertices, mesh.faces, options, mirror=mirror, **changes)
    begin(problem)
    opened = open_flow(problem)
    with opened.flow as flow:
        flow.run()
        whole = whole_of(opened.part, flow, options)
        with whole.flow as of_whole:
            return Filled(
                mesh, spacing, opened.part.mirror,
                of_whole.polylines(), of_whole.point_data(), of_whole.guides(),
                whole.statistics(opened.part, flow), whole.figures(opened.part), whole.sources,
            )  # fmt: skip


def refused(mesh: geometry.Mesh, spacing: float, axis: str = "x", **changes) -> str:
    with pytest.raises(core.MeanderError) as refusal:
        filled(mesh, spacing, axis, **changes)
    assert_sentence(str(refusal.value))
    return str(refusal.value)


def bumpy(subdivisions: int, cells: float = 3.0) -> geometry.Mesh:
    """A ball with bumps that is its own mirror image in x, and not in its other axes; its
    triangles are not mirrored."""
    ball = geometry.icosphere(subdivisions)
    turn = np.array([[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]])
    places = ball.vertices @ turn.T
    x, y, z = places.T
    swell = 1.0 + 0.1 * np.cos(cells * x) * np.sin(2.0 * y + 1.0) + 0.1 * z
    return geometry.Mesh(places * swell[:, None], ball.faces)


MODELS = {
    "ball": (geometry.icosphere(3), 0.24, "x"),
    "torus": (geometry.torus(40, 20), 0.2, "x"),
    "flat torus": (geometry.torus(40, 20), 0.2, "z"),
    "cube": (geometry.cube(), 0.3, "y"),
    "other triangles": (bumpy(4), 0.2, "x"),
}


@pytest.fixture(scope="module", params=MODELS)
def run(request: pytest.FixtureRequest) -> Filled:
    mesh, spacing, axis = MODELS[request.param]
    return filled(mesh, spacing, axis)


def test_it_is_one_closed_line_that_crosses_nothing(run: Filled) -> None:
    assert run.curve.closed.tolist() == [1]
    assert run.crossings() == []
    assert run.figures["joined"] == 1 and run.figures["why"] is None


def test_it_goes_through_the_plane_twice(run: Filled) -> None:
    heights = run.heights()
    sides = np.sign(heights[np.abs(heights) > 1e-9 * run.spacing])
    assert np.count_nonzero(sides != np.roll(sides, -1)) == 2
    assert run.figures["crossings"] == 2


def test_it_lies_on_the_surface(run: Filled) -> None:
    size = np.linalg.norm(np.ptp(run.mesh.vertices, axis=0))
    assert geometry.off_surface(run.mesh, run.curve.positions).max() < 1e-9 * size


def test_each_half_is_the_image_of_the_other(run: Filled) -> None:
    """Within the tolerance, by which the surface may lie beside its image: none of these does by
    more than its triangles are chords of it."""
    curve = run.curve
    images = run.mirror.images(curve.positions)[::7]
    samples = geometry.samples_of(curve.positions, curve.offsets, curve.closed, run.spacing / 30)
    assert geometry.distance_to_samples(images, samples).max() < 0.03 * run.spacing


def test_strands_beside_the_plane_are_as_far_apart_as_elsewhere(run: Filled) -> None:
    """Half the room of points beside the plane, but of those at the crossings."""
    heights = np.abs(run.heights())
    beside = (heights > 0.2 * run.spacing) & (heights < 0.8 * run.spacing)
    room = 2.0 * run.data.radii / run.spacing
    here, elsewhere = np.median(room[beside]), np.median(room[~beside])
    assert beside.sum() > 20
    assert abs(here - elsewhere) < 0.08
    assert heights.min() < 1e-8  # the crossings have a point in the plane
    assert np.quantile(heights, 0.02) > 0.2 * run.spacing


def assert_nothing_is_left_empty(run: Filled) -> None:
    samples = geometry.samples_of(*run.curve[:1], *run.curve[2:], run.spacing / 20)
    places = geometry.sample_surface(run.mesh, 3000)
    far = geometry.distance_to_samples(places, samples) / (run.spacing / 2)
    assert far.max() < 2.0
    assert np.mean(far > 1.3) < 0.02


def test_nothing_is_left_empty(run: Filled) -> None:
    assert_nothing_is_left_empty(run)


def test_the_same_bytes_for_any_number_of_threads() -> None:
    curves = [filled(bumpy(3), 0.24, threads=threads).curve for threads in (1, 2, 1)]
    assert curves[0].positions.tobytes() == curves[1].positions.tobytes()
    assert curves[0].positions.tobytes() == curves[2].positions.tobytes()


@pytest.mark.parametrize("changes", [
    {"boundary_distance": 0.0}, {"boundary_distance": 1.0},
    {"preset": "paper"}, {"preset": "finest"}, {"start": core.Start.FULL},
])  # fmt: skip
def test_the_spacing_across_the_plane_is_kept(changes: dict[str, Any]) -> None:
    run = filled(bumpy(3), 0.24, **changes)
    heights = np.sort(np.abs(run.heights()))
    nearest = heights[heights > 0.1 * run.spacing][: len(heights) // 50]
    assert np.median(nearest) > 0.3 * run.spacing
    assert run.curve.closed.tolist() == [1] and run.crossings() == []
    assert run.figures["crossings"] == 2


def test_the_plane_goes_with_the_object() -> None:
    """A matrix that turns, moves and stretches along the axes; and a place is told without it."""
    turn, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    matrix = np.eye(4)
    matrix[:3, :3] = turn @ np.diag([2.0, 1.0, 1.5])
    matrix[:3, 3] = [5.0, -3.0, 1.0]
    own = bumpy(3)
    world = geometry.Mesh(own.vertices @ matrix[:3, :3].T + matrix[:3, 3], own.faces)
    mirror = mirror_of("x", matrix)
    assert abs(mirror.heights(world.vertices)) == pytest.approx(2.0 * abs(own.vertices[:, 0]))
    run = filled(world, 0.4, mirror)
    assert run.figures["crossings"] == 2 and run.crossings() == []
    dented = own.vertices.copy()
    top = int(np.argmax(dented[:, 0] + dented[:, 1]))
    dented[top] *= 1.2
    dented = geometry.Mesh(dented @ matrix[:3, :3].T + matrix[:3, 3], own.faces)
    options = options_of(radius=0.2)
    with pytest.raises(core.MeanderError) as refusal:
        open_flow(Problem(dented.vertices, dented.faces, options, mirror=mirror))
    place = str(refusal.value).partition("(")[2].partition(")")[0].split(", ")
    assert np.array(place, dtype=float) == pytest.approx(1.2 * own.vertices[top], abs=2e-3)


def test_two_parts_of_one_side_each_stay_two_lines() -> None:
    spheres = geometry.two_spheres()
    run = filled(geometry.Mesh(spheres.vertices - [1.5, 0.0, 0.0], spheres.faces), 0.3)
    assert run.curve.closed.tolist() == [1, 1]
    assert run.figures == {"axis": "x", "joined": 0, "crossings": 0, "why": None}
    halves = np.split(run.heights(), run.curve.offsets[1:-1])
    assert (halves[0] > 0.0).all() and (halves[1] < 0.0).all()


def on_sheet(*ways: list[tuple[float, float]], closed: bool, guide: bool = False) -> core.Seed:
    points = [[x, y, 0.0] for way in ways for x, y in way]
    return core.Seed(
        np.array(points),
        np.cumsum([0] + [len(way) for way in ways]).astype(np.uint32),
        np.full(len(ways), closed, dtype=np.uint8),
        guides=np.full(len(ways), guide, dtype=np.uint8),
        loops=guide,
    )


def sheet() -> geometry.Mesh:
    grid = geometry.grid(16, 2.0)
    return geometry.Mesh(grid.vertices - [1.0, 1.0, 0.0], grid.faces)


def test_open_strands_stay_one_a_side() -> None:
    run = filled(sheet(), 0.2, seed=on_sheet([(0.3, 0.1), (0.6, 0.3)], closed=False))
    assert run.curve.closed.tolist() == [0, 0] and run.sources.tolist() == [0, 0]
    assert run.figures["why"] == "open strands stay one a side"
    assert run.crossings() == []


def test_the_half_with_the_seed_counts() -> None:
    ring = [(-0.5 + 0.2 * np.cos(a), 0.2 * np.sin(a)) for a in np.arange(12) * np.pi / 6]
    run = filled(sheet(), 0.2, seed=on_sheet(ring, closed=True))
    assert run.mirror.normal[0] == -1.0
    assert run.curve.closed.tolist() == [1] and run.figures["crossings"] == 2


def test_a_seed_across_the_plane_counts_as_far_as_its_half_goes() -> None:
    ring = [(0.5 * np.cos(a), 0.5 * np.sin(a)) for a in np.arange(24) * np.pi / 12 + 0.1]
    run = filled(sheet(), 0.2, seed=on_sheet(ring, closed=True))
    assert run.curve.closed.tolist() == [1] and run.figures["crossings"] == 2
    assert run.crossings() == []


def test_a_grown_line_goes_on_as_one_line() -> None:
    before = filled(sheet(), 0.3)
    curve = before.curve
    run = filled(sheet(), 0.2, seed=core.Seed(curve.positions, curve.offsets, curve.closed))
    assert run.curve.closed.tolist() == [1] and run.figures["crossings"] == 2


def test_guides_are_mirrored_and_stay_as_drawn() -> None:
    guide = [(0.0, 0.4), (0.5, 0.4), (0.5, 0.8)]
    run = filled(sheet(), 0.15, seed=on_sheet(guide, closed=False, guide=True))
    assert run.guides.sum() == 2
    drawn = np.array([[x, y, 0.0] for x, y in guide[1:]])
    for places in (drawn, drawn * [-1.0, 1.0, 1.0]):
        samples = geometry.samples_of(*run.curve[:1], *run.curve[2:], 0.002)
        assert geometry.distance_to_samples(places, samples).max() < 0.01
    grown = ~run.guides
    assert run.curve.closed[grown].all() and run.crossings() == []


def test_the_density_of_one_half_counts() -> None:
    mesh = sheet()
    density = np.where(mesh.vertices[:, 0] > 0.5, 4.0, 1.0)
    density[mesh.vertices[:, 0] < -0.5] = 30.0  # does not count
    run = filled(mesh, 0.08, density=density)
    lengths = geometry.weighted_samples(*run.curve[:1], *run.curve[2:], 0.01)
    x, weights = lengths[0][:, 0], lengths[1]
    right, middle, left = (
        weights[inside].sum() for inside in (x > 0.5, np.abs(x) < 0.25, x < -0.5)
    )
    assert right == pytest.approx(left, rel=1e-3)
    assert right / middle == pytest.approx(2.0, rel=0.15)


def test_directions_of_one_half_count() -> None:
    mesh = sheet()
    slope = np.where(mesh.vertices[:, 0] >= 0.0, 1.0, 0.0)  # on the left, which is not used
    directions = np.column_stack([np.ones(len(mesh.vertices)), slope, np.zeros(len(mesh.vertices))])
    run = filled(mesh, 0.1, directions=directions, alignment_weight=4.0, start=core.Start.FULL)
    pieces = geometry.pieces_of(run.curve.offsets, run.curve.closed)
    steps = run.curve.positions[pieces[:, 1]] - run.curve.positions[pieces[:, 0]]
    middle = run.curve.positions[pieces[:, 0], 0]
    lengths = np.linalg.norm(steps, axis=1)
    for side, sign in ((middle > 0.2, 1.0), (middle < -0.2, -1.0)):
        along = np.abs(steps @ [1.0, sign, 0.0]) / np.sqrt(2.0)
        assert along[side].sum() / lengths[side].sum() > 0.85


def test_the_part_to_fill_is_mirrored() -> None:
    mesh = sheet()
    middles = mesh.vertices[mesh.faces].mean(axis=1)
    mask = (middles[:, 0] > -0.4) & (np.abs(middles[:, 1]) < 0.5)  # of the left part of it
    run = filled(mesh, 0.15, surface_options=core.SurfaceOptions(face_mask=mask))
    x, y, _z = run.curve.positions.T
    assert np.abs(y).max() < 0.5 and x.max() > 0.85 and x.min() < -0.85


def test_what_does_not_go_with_symmetry_is_refused() -> None:
    ball = geometry.icosphere(3)
    assert "outline" in refused(ball, 0.3, outline=0.1)
    assert "bend radius" in refused(ball, 0.3, least_bend_radius=0.1)
    parts = core.SurfaceOptions(smallest_part=0.1)
    assert "smallest part" in refused(ball, 0.3, surface_options=parts)


def test_a_surface_that_is_not_alike_is_refused_with_the_place() -> None:
    mesh = bumpy(3)
    dented = mesh.vertices.copy()
    dented[7] *= 1.0 + 0.3 / np.linalg.norm(dented[7])
    text = refused(geometry.Mesh(dented, mesh.faces), 0.2)
    assert f"({', '.join(f'{value:.4g}' for value in dented[7])})" in text
    told = float(text.partition("lies ")[2].split()[0])
    assert 0.15 < told <= 0.301  # the side of the spike is nearer to its image's tip than 0.3
    assert "a tenth of the spacing" in text
    small = mesh.vertices.copy()
    small[7] *= 1.0 + 0.015 / np.linalg.norm(small[7])
    assert filled(geometry.Mesh(small, mesh.faces), 0.2).figures["crossings"] == 2


def test_a_surface_without_that_half_is_refused() -> None:
    mesh = sheet()
    flat = geometry.Mesh(mesh.vertices[:, [2, 0, 1]], mesh.faces)  # in the plane itself
    assert "positive side" in refused(flat, 0.2)


def test_halves_that_hide_two_sheets_are_refused() -> None:
    """Two sheets within the tolerance of each other on one side: the image would jump."""
    right = sheet()
    right = geometry.Mesh((right.vertices + [1.5, 0.0, 0.0]), right.faces)
    left, count = right.vertices * [-1.0, 1.0, 1.0], len(right.vertices)
    wavy = left + np.column_stack([0.0 * left[:, :2], 0.009 * np.sin(9.0 * left[:, 0])])
    other = left + [0.0, 0.0, 0.004]
    vertices = np.vstack([right.vertices, wavy, other])
    faces = np.vstack([right.faces, right.faces[:, ::-1] + count, right.faces[:, ::-1] + 2 * count])
    text = refused(geometry.Mesh(vertices, faces.astype(np.uint32)), 0.2)
    assert text.startswith("The curve and its mirror image meet")


def test_a_run_with_symmetry_takes_no_other_border() -> None:
    mesh = sheet()
    options = options_of(radius=0.15)
    opened = open_flow(Problem(mesh.vertices, mesh.faces, options, mirror=mirror_of("x")))
    with opened.flow:
        other = options_of(radius=0.1)
        assert opened.part.options_of(other).radius == 0.1
        other.boundary_distance = 0.2
        with pytest.raises(core.MeanderError) as refusal:
            opened.part.options_of(other)
    assert_sentence(str(refusal.value))


def test_a_wide_empty_rim_is_refused_where_there_is_a_rim() -> None:
    assert "boundaries" in refused(sheet(), 0.2, boundary_distance=0.8)
    near = filled(sheet(), 0.2, boundary_distance=0.2)
    assert np.abs(near.curve.positions[:, 1]).max() > 0.93
    heights = np.abs(near.heights())
    assert np.quantile(heights, 0.02) > 0.35 * near.spacing  # and the plane is no border


# ------------------------------------------------------------------------------------------------
# What it is made of


@pytest.mark.parametrize("tilt", [0.0, 0.3])
def test_a_half_has_half_the_area_and_no_holes(tilt: float) -> None:
    mesh = geometry.icosphere(3)
    values = mesh.vertices @ [1.0, tilt, 0.0]
    half = above(mesh.vertices, mesh.faces, values, np.full(len(values), 1e-9))
    with core.Surface(half.vertices, half.faces) as part, core.Surface(*mesh) as whole:
        of_half, of_whole = part.statistics(), whole.statistics()
    assert of_half["area"] == pytest.approx(of_whole["area"] / 2, rel=1e-9)
    assert of_half["boundary_loops"] == 1 and of_half["turned_faces"] == 0
    assert half.carried(values).min() >= -1e-9
    assert half.carried(mesh.vertices) == pytest.approx(half.vertices)
    cut = section(mesh.vertices, mesh.faces, values)
    assert np.abs(cut @ [1.0, tilt, 0.0]).max() < 1e-12
    # Where the plane goes along an edge, that is there from both of its faces.
    cut = np.unique(np.sort(np.round(cut, 9), axis=1).reshape(-1, 6), axis=0).reshape(-1, 2, 3)
    around = np.linalg.norm(cut[:, 1] - cut[:, 0], axis=1).sum()
    assert around == pytest.approx(2 * np.pi, rel=0.01)


# ------------------------------------------------------------------------------------------------
# The batch command


def command(folder: Path, mesh: geometry.Mesh, *extra: object) -> int:
    path = geometry.write_obj(folder / "mesh.obj", mesh)
    return fill(path, folder / "out.obj", "--report", folder / "r.json", "--quiet", *extra)


def test_the_command_mirrors_and_reports(tmp_path: Path) -> None:
    assert command(tmp_path, bumpy(3), "--spacing", 0.25, "--mirror", "x") == 0
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["options"]["mirror"] == "x"
    assert report["mirror"] == {"axis": "x", "joined": 1, "crossings": 2, "why": None}
    assert report["lines"]["count"] == report["lines"]["closed"] == 1
    assert report["strands"] == 1 and report["crossings"] == 0
    assert command(tmp_path, bumpy(3), "--spacing", 0.25) == 0
    plain = json.loads((tmp_path / "r.json").read_text())
    assert plain["mirror"] is None and plain["options"]["mirror"] == "none"
    assert report["length"] == pytest.approx(plain["length"], rel=0.05)
    assert report["surface"] == plain["surface"]


def test_the_command_finds_a_length_with_symmetry(tmp_path: Path) -> None:
    assert command(tmp_path, bumpy(3), "--target-length", 50, "--mirror", "x") == 0
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["length"] == pytest.approx(50, rel=0.05)


def test_the_command_refuses_and_leaves_files_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    assert command(tmp_path, bumpy(3), "--spacing", 0.25, "--mirror", "y") == 2
    assert_sentence(capsys.readouterr().err.strip().removeprefix("meander: "))
    assert not (tmp_path / "out.obj").exists()
