# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances along the surface: every sheet is filled by itself, however near another one is."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
import thin_shapes
from distances_along import distances_along
from flows import flow_on
from meander import core
from numpy.typing import NDArray
from thin_shapes import SHAPES

# Nothing may be farther from the curve than this, along the surface and in r: two hairpins before a
# straight strand leave 1.5 at most.
FARTHEST = 1.5
# Two turns side by side before a boundary that is r away leave sqrt(8) - 1 = 1.83 on it. That they
# come to lie there is rare: of the largest distances on nine curves from different first faces on
# the folded cloth one was over 1.6, and on two revisions before two and none.
FARTHEST_AT_BOUNDARY, FARTHEST_MOSTLY = 1.83, 1.6
OPEN = ("folded cloth", "crossing sheets")
# Length times spacing over area; 1 for parallel strands. From nine first faces each it was 1.01 to
# 1.054, and up to 1.069 on the plate of .6 r.
PACKING = {name: (0.96, 1.06) for name in SHAPES} | {"plate of 0.6 r": (0.96, 1.08)}


def grown(mesh: geometry.Mesh, radius: float = 1.0, **named) -> core.Flow:
    flow = flow_on(mesh, radius=radius, **named)
    assert flow.run() == "converged"
    return flow


def places_on(mesh: geometry.Mesh, count: int = 3000) -> tuple[NDArray, NDArray]:
    """Random points on a surface, evenly by area, and their faces."""
    random = np.random.default_rng(4)
    areas = geometry.triangle_areas(*mesh)
    faces = random.choice(len(areas), count, p=areas / areas.sum())
    return geometry.points_at(mesh, faces, random.dirichlet([1, 1, 1], count)), faces


def distances_to(
    flow: core.Flow, mesh: geometry.Mesh, places: tuple[NDArray, NDArray], gap: float = 0.25
) -> NDArray[np.float64]:
    """From each place to the curve, along the surface."""
    curve = flow.polylines().positions, flow.point_data().faces
    return distances_along(mesh, curve, places, gap)


def packing(flow: core.Flow, mesh: geometry.Mesh) -> float:
    figures = flow.statistics()
    return figures["spacing_target"] * figures["length"] / geometry.triangle_areas(*mesh).sum()


def on_lower_side(mesh: geometry.Mesh, faces: NDArray) -> NDArray[np.bool_]:
    """Of faces of a plate: all of their vertices belong to the lower side."""
    return mesh.faces[faces].min(axis=1) >= len(mesh.vertices) // 2


def brute_crossings(flow: core.Flow, mesh: geometry.Mesh) -> list[tuple[int, int]]:
    """Of pieces long enough that the face that they cross can be told from those beside it."""
    curve = flow.polylines()
    found = geometry.crossings(mesh, curve.positions, curve.offsets, curve.closed)
    pieces = curve.positions[geometry.pieces_of(curve.offsets, curve.closed)]
    shortest = 1e-8 * np.ptp(mesh.vertices, axis=0).max()
    long = np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1) > shortest
    return [(i, j) for i, j in found if long[i] and long[j]]


# ------------------------------------------------------------------------------------------------
# Filling


def place_at(mesh: geometry.Mesh, point: list[float]) -> tuple[NDArray, NDArray]:
    """A point of the surface, and the nearest face."""
    return np.array([point]), geometry.off_faces(mesh, np.array([point])).argmin(axis=1)


@pytest.mark.parametrize("y", [8.1, 9.3, 11.0])
def test_the_distances_of_these_tests_go_round_the_rim(y: float) -> None:
    mesh, thickness = SHAPES["plate of 1.5 r"], 1.5
    above, below = place_at(mesh, [2.0, 8.1, 0.75]), place_at(mesh, [3.0, y, -0.75])
    shortest = np.hypot(2.0 + thickness + 3.0, y - 8.1)
    assert distances_along(mesh, above, below, 0.25)[0] == pytest.approx(shortest, rel=0.005)


def farthest_from_strands(name: str, first_face: int = 0) -> float:
    """The largest distance from the curve on a shape that was filled from a face on."""
    mesh = SHAPES[name]
    mesh = geometry.Mesh(mesh.vertices, np.roll(mesh.faces, -first_face, axis=0))
    flow = grown(mesh)
    assert flow.statistics()["crossings"] == 0
    assert brute_crossings(flow, mesh) == []
    least, most = PACKING[name]
    assert least < packing(flow, mesh) < most
    return distances_to(flow, mesh, places_on(mesh)).max()


@pytest.mark.parametrize("name", [name for name in SHAPES if name not in OPEN])
def test_every_sheet_is_filled(name: str) -> None:
    assert farthest_from_strands(name) < FARTHEST


@pytest.mark.parametrize("name", OPEN)
def test_open_sheets_are_filled(name: str) -> None:
    faces = len(SHAPES[name].faces)
    farthest = [farthest_from_strands(name, share * faces // 3) for share in range(3)]
    assert np.median(farthest) < FARTHEST_MOSTLY and max(farthest) < FARTHEST_AT_BOUNDARY


@pytest.mark.parametrize("name", ["plate of 0.02 r", "plate of large faces", "folded cloth"])
def test_through_space_one_sheet_covers_the_next(name: str) -> None:
    mesh = SHAPES[name]
    flow = flow_on(mesh, radius=1.0, medial_axis=core.MedialAxis.EUCLIDEAN)
    flow.run()  # where two sheets quarrel about one place it may go on until it is stopped
    assert flow.statistics()["crossings"] == 0
    bare = distances_to(flow, mesh, places_on(mesh)) > FARTHEST
    assert bare.mean() > 0.25


def test_through_space_strands_keep_clear_of_a_sheet_that_they_cross() -> None:
    mesh = SHAPES["crossing sheets"]
    places = places_on(mesh)
    through = grown(mesh, medial_axis=core.MedialAxis.EUCLIDEAN)
    assert (distances_to(through, mesh, places) > FARTHEST).mean() > 0.02


@pytest.mark.parametrize("preset", core.PRESETS)
def test_the_preset_chooses_the_measure(preset: str) -> None:
    through_space = preset == "paper"
    assert core.default_options(preset).medial_axis == core.MedialAxis(not through_space)


# ------------------------------------------------------------------------------------------------
# What holds in any mode


def test_noise_in_the_vertices_does_not_matter() -> None:
    """Normals that point anywhere: every vertex is moved by up to 0.3 edge lengths."""
    smooth = geometry.icosphere(3)
    edge = np.linalg.norm(np.diff(smooth.vertices[smooth.faces[:, :2]], axis=1), axis=2).mean()
    random = np.random.default_rng(1)
    away = random.normal(size=smooth.vertices.shape)
    away *= 0.3 * edge / np.linalg.norm(away, axis=1)[:, None]
    away *= random.random((len(away), 1)) ** (1 / 3)
    mesh = geometry.Mesh(smooth.vertices + away, smooth.faces)
    radius = 1.5 * edge
    for axis in core.MedialAxis:
        flow = grown(mesh, radius, medial_axis=axis)
        assert flow.statistics()["crossings"] == 0
        distances = distances_to(flow, mesh, places_on(mesh), 0.25 * radius)
        assert np.quantile(distances, 0.99) / radius < 1.25


# ------------------------------------------------------------------------------------------------
# Together with what else a flow can do


def test_an_empty_side_of_a_plate_is_a_gap_along_the_surface() -> None:
    """The same curve, laid with both kinds of distance: through space one side covers the other."""
    mesh = thin_shapes.plate(0.2)
    curve = grown(mesh, medial_axis=core.MedialAxis.EUCLIDEAN).polylines()
    seed = core.Seed(curve.positions, curve.offsets, curve.closed)
    found = {}
    for axis in core.MedialAxis:
        flow = flow_on(mesh, seed=seed, radius=1.0, medial_axis=axis)
        nodes = flow.polylines().positions
        found[axis] = flow.gaps()
        assert flow.gaps().sizes.tobytes() == found[axis].sizes.tobytes()
    through, along = found[core.MedialAxis.EUCLIDEAN], found[core.MedialAxis.GEODESIC]
    assert np.max(through.sizes, initial=0) < 1.5
    assert along.sizes[0] > 1.7
    # The nearest node on its own side of the plate is not much farther than the curve there.
    for place, radius in zip(along.positions[:5], along.radii):
        same_side = nodes[(nodes[:, 2] > 0) == (place[2] > 0)]
        distance = np.linalg.norm(same_side - place, axis=1).min()
        assert radius <= distance * (1 + 1e-6)
        assert radius > min(distance - 0.4, 2.99)  # sizes end at 3 here


def test_density_holds_on_both_sides() -> None:
    mesh = thin_shapes.plate(0.1, cells=16)
    density = np.where(mesh.vertices[:, 0] < 8.0, 4.0, 1.0)
    flow = grown(mesh, density=density)
    assert flow.statistics()["crossings"] == 0
    places, faces = places_on(mesh)
    distances = distances_to(flow, mesh, (places, faces))
    lower = on_lower_side(mesh, faces)
    for side in (lower, ~lower):
        fine, coarse = (
            distances[side & (places[:, 0] < 6.0)],
            distances[side & (places[:, 0] > 9.0)],
        )
        assert fine.max() < 0.5 * FARTHEST and coarse.max() < FARTHEST
        # The mean distance of a place from strands 2 r apart is r / 2.
        assert coarse.mean() / fine.mean() == pytest.approx(2.0, rel=0.15)


def test_a_plate_that_bends_stays_filled_on_both_sides() -> None:
    """Bent to a third of a circle, without a change of length in its middle."""
    mesh = thin_shapes.plate(0.1, cells=16)
    flow = grown(mesh)
    x, y, z = mesh.vertices.T
    for frame in range(1, 9):
        curvature = frame / 8 * np.radians(120) / thin_shapes.SIZE
        angle, out = curvature * (x - 8.0), 1 / curvature + z
        bent = np.column_stack([out * np.sin(angle), y, out * np.cos(angle) - 1 / curvature])
        flow.set_vertices(bent)
        for _ in range(3):
            flow.step()
        assert flow.statistics()["crossings"] == 0
    assert flow.run() == "converged"
    moved = geometry.Mesh(bent, mesh.faces)
    least, most = PACKING["plate of 0.1 r"]
    assert least < packing(flow, moved) < most
    assert distances_to(flow, moved, places_on(moved)).max() < FARTHEST


def circle(radius: float, height: float) -> NDArray[np.float64]:
    angle = np.linspace(0.0, 2 * np.pi, 40, endpoint=False)
    return np.column_stack(
        [8 + radius * np.cos(angle), 8 + radius * np.sin(angle), np.full(40, height)]
    )


def test_a_seed_on_one_side_fills_both() -> None:
    mesh = SHAPES["plate of 0.1 r"]
    points = circle(3.0, 0.05)
    flow = grown(mesh, seed=core.Seed(points, np.array([0, 40], np.uint32), np.ones(1, np.uint8)))
    assert flow.statistics()["crossings"] == 0 and len(flow.polylines().closed) == 1
    assert distances_to(flow, mesh, places_on(mesh)).max() < FARTHEST


def test_a_guide_keeps_off_strands_of_its_own_side_only() -> None:
    """A straight guide on the upper side: nothing crosses it, and below it the plate is filled."""
    mesh = SHAPES["plate of 0.1 r"]
    line = np.linspace([3.0, 8.0, 0.05], [13.0, 8.0, 0.05], 30)
    seed = core.Seed(line, np.array([0, 30], np.uint32), np.zeros(1, np.uint8))
    seed.guides, seed.loops = np.ones(1, np.uint8), True
    flow = grown(mesh, seed=seed)
    assert flow.statistics()["crossings"] == 0
    assert distances_to(flow, mesh, places_on(mesh)).max() < FARTHEST
    guide, curve, faces = flow.guides(), flow.polylines(), flow.point_data().faces
    assert guide.tolist() == [True] + [False] * (len(guide) - 1)
    first = curve.offsets[1]
    positions, lower = curve.positions[first:], on_lower_side(mesh, faces[first:])
    beside = (positions[:, 0] > 4.0) & (positions[:, 0] < 12.0)
    above, below = (np.abs(positions[beside & side, 1] - 8.0) for side in (~lower, lower))
    assert above.min() > 1.0
    assert below.min() < 0.5


@pytest.mark.parametrize("first", [7, 21])
def test_a_rim_holds_no_growing_curve_up(first: int):
    """While strands on both sides of it kept each other away, this took 342 to 435 iterations."""
    plate = thin_shapes.plate(0.6, cells=20, size=40.0)
    turned = geometry.Mesh(plate.vertices, np.roll(plate.faces, -first, axis=0))
    with grown(turned) as flow:
        assert flow.statistics()["iterations"] < 260
