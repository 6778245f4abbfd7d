# SPDX-License-Identifier: GPL-3.0-or-later
"""What every filled surface has in common, checked by geometry.py without the library."""

from __future__ import annotations

from collections.abc import Callable

import geometry
import numpy as np
import pytest
from conftest import Grown, grow
from flows import options_of
from meander import core

# Rounding of sums of doubles.
ROUNDING = 1e-12


def size_of(mesh: geometry.Mesh) -> float:
    return float(np.ptp(mesh.vertices, axis=0).max())


def curve_of(grown: Grown) -> tuple:
    return grown.curve.positions, grown.curve.offsets, grown.curve.closed


# ------------------------------------------------------------------------------------------------
# By default, on every model


def test_arrays_fit_together(grown: Grown) -> None:
    positions, normals, offsets, closed = grown.curve
    assert positions.shape == normals.shape == (offsets[-1], 3)
    assert offsets[0] == 0 and len(offsets) == len(closed) + 1
    assert np.all(np.diff(offsets.astype(np.int64)) >= 3)
    assert np.isfinite(positions).all()
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, rtol=1e-9)
    assert (positions.dtype, offsets.dtype, closed.dtype) == (float, np.uint32, np.uint8)


def test_one_closed_strand_per_component(grown: Grown) -> None:
    components = grown.surface["components"]
    assert grown.curve.closed.tolist() == [1] * components
    assert grown.statistics["strands"] == grown.statistics["closed_strands"] == components


def test_it_ends_well(grown: Grown) -> None:
    assert grown.reason == grown.statistics["stop_reason"] == "converged"
    assert grown.statistics["crossings"] == 0


def test_points_and_middles_are_on_the_surface(grown: Grown) -> None:
    positions, offsets, closed = curve_of(grown)
    pieces = geometry.pieces_of(offsets, closed)
    middles = positions[pieces].mean(axis=1)
    # 1e-9 r is what the project promises.
    assert geometry.off_surface(grown.mesh, positions).max() <= 1e-9 * grown.radius
    assert geometry.off_surface(grown.mesh, middles).max() <= 1e-9 * grown.radius


def test_no_crossings(grown: Grown) -> None:
    assert geometry.crossings(grown.mesh, *curve_of(grown)) == []


def test_nodes_are_points_of_the_mesh_and_of_the_curve(grown: Grown) -> None:
    nodes = grown.nodes
    assert len(nodes.faces) == grown.statistics["nodes"]
    assert nodes.faces.max() < len(grown.mesh.faces)
    assert nodes.barycentrics.min() >= -ROUNDING
    np.testing.assert_allclose(nodes.barycentrics.sum(axis=1), 1.0, rtol=1e-12)
    assert not nodes.fixed.any()
    assert np.all(nodes.radii > 0)
    positions = geometry.points_at(grown.mesh, nodes.faces, nodes.barycentrics)
    gap = geometry.distance_to_samples(positions, grown.curve.positions)
    assert gap.max() <= 1e-9 * grown.radius


def test_length_is_that_of_the_polylines(grown: Grown) -> None:
    length = geometry.curve_length(*curve_of(grown))
    assert grown.statistics["length"] == pytest.approx(length, rel=1e-9)


def test_surface_is_filled(grown: Grown) -> None:
    samples = geometry.samples_of(*curve_of(grown), gap=0.2 * grown.radius)
    points = geometry.sample_surface(grown.mesh, 3000)
    distance = geometry.distance_to_samples(points, samples) / grown.radius
    # Perfectly parallel strands give 1 at most; hairpins and boundaries leave corners. Straight
    # distances are shorter than those along the surface, and samples 0.2 r apart longer.
    assert np.percentile(distance, 95) < 1.3
    assert distance.max() < 2.5


def test_packing_is_near_one(grown: Grown) -> None:
    area = grown.surface["area"]
    packing = 2 * grown.radius * geometry.curve_length(*curve_of(grown)) / area
    # The range for coarse models; small surfaces have much boundary or curvature.
    assert 0.85 < packing < 1.15


def test_spacing_percentiles_are_in_order(grown: Grown) -> None:
    figures = grown.statistics
    assert figures["spacing_target"] == pytest.approx(2 * grown.radius, rel=1e-12)
    assert figures["spacing_p05"] <= figures["spacing_median"] <= figures["spacing_p95"]
    assert figures["spacing_median"] == pytest.approx(2 * grown.radius, rel=0.25)


def test_history_has_every_iteration(grown: Grown) -> None:
    numbers = [record["iteration"] for record in grown.history]
    assert numbers == list(range(1, grown.statistics["iterations"] + 1))
    last = grown.history[-1]
    assert last["nodes"] == grown.statistics["nodes"]
    assert last["length"] == pytest.approx(grown.statistics["length"], rel=1e-9)
    assert all(record["seconds"] >= 0 for record in grown.history)


def test_every_component_is_filled(model: Callable[[str], Grown]) -> None:
    grown = model("two_spheres")
    lengths = [
        geometry.curve_length(
            grown.curve.positions, grown.curve.offsets[at : at + 2], grown.curve.closed[at : at + 1]
        )
        for at in range(2)
    ]
    assert lengths[0] == pytest.approx(lengths[1], rel=0.1)


# ------------------------------------------------------------------------------------------------
# The paper's preset


def test_paper_preset_fills_as_well() -> None:
    grown = grow(geometry.icosphere(3), 0.15, preset="paper")
    assert grown.reason == "converged"
    assert geometry.crossings(grown.mesh, *curve_of(grown)) == []
    packing = 2 * grown.radius * geometry.curve_length(*curve_of(grown)) / grown.surface["area"]
    assert 0.8 < packing < 1.15


# ------------------------------------------------------------------------------------------------
# Invariance


@pytest.mark.parametrize("scale", [1e-3, 1e3, 2.0**-10, 2.0**10])
def test_scale_changes_nothing_else(scale: float, model: Callable[[str], Grown]) -> None:
    nominal = model("icosphere")
    mesh = geometry.Mesh(nominal.mesh.vertices * scale, nominal.mesh.faces)
    scaled = grow(mesh, nominal.radius * scale)
    assert scaled.reason == nominal.reason
    assert scaled.statistics["iterations"] == nominal.statistics["iterations"]
    assert scaled.curve.offsets.tolist() == nominal.curve.offsets.tolist()
    # Relative to the size of the mesh: single coordinates pass through zero.
    np.testing.assert_allclose(
        scaled.curve.positions / scale,
        nominal.curve.positions,
        rtol=0,
        atol=1e-9 * size_of(nominal.mesh),
    )


def test_density_four_halves_the_spacing() -> None:
    mesh = geometry.grid(32)
    density = np.where(mesh.vertices[:, 0] < 0.5 - 1e-9, 4.0, 1.0)
    grown = grow(mesh, 0.025, density=density)
    samples, lengths = geometry.weighted_samples(*curve_of(grown), gap=0.005)
    x, y = samples[:, 0], samples[:, 1]
    # Away from the boundary, and from the column of cells in which the density changes.
    inner = (y > 0.1) & (y < 0.9)
    left = lengths[inner & (x > 0.1) & (x < 0.4)].sum()
    right = lengths[inner & (x > 0.6) & (x < 0.9)].sum()
    # Equal areas: the mean spacing is the inverse of the length.
    assert right / left == pytest.approx(0.5, rel=0.1)


# ------------------------------------------------------------------------------------------------
# Seeds


def strand(points: list, closed: bool, fixed: list | None = None) -> core.Seed:
    return core.Seed(
        np.array(points, dtype=np.float64),
        np.array([0, len(points)], dtype=np.uint32),
        np.array([closed], dtype=np.uint8),
        None if fixed is None else np.array(fixed, dtype=np.uint8),
    )


def test_strand_on_one_component_leaves_the_other_alone() -> None:
    mesh = geometry.two_spheres()
    seed = strand([[0.3, 0.0, 0.95], [-0.2, 0.3, 0.95], [-0.2, -0.3, 0.95]], True)
    grown = grow(mesh, 0.15, seed)
    assert grown.curve.closed.tolist() == [1]
    assert grown.curve.positions[:, 0].max() < 1.5


@pytest.mark.parametrize("preset", ["even", "paper"])
def test_a_sliver_for_a_first_face_is_no_trap(preset: str) -> None:
    # The curve begins in the first face; in a sliver its outline would have no room to move in.
    vertices = np.zeros((7, 3))
    vertices[:3, :2] = [(0, 0), (0.6, 0), (0.25, 0.016)]
    vertices[3:, :2] = [(-1, -1), (2, -1), (2, 2), (-1, 2)]
    p, q, s, a, b, c, d = range(7)
    faces = [(p, q, s), (a, b, q), (a, q, p), (b, c, q), (q, c, s), (s, c, d), (s, d, p), (d, a, p)]
    options = options_of(preset, radius=0.1)
    with core.Flow(core.Surface(vertices, np.array(faces, dtype=np.uint32)), options) as flow:
        assert len(set(flow.nodes().faces)) > 1
        first = flow.polylines().positions
        assert np.ptp(first[:, 1]) > options.radius  # a circle, wide enough to turn round in
        flow.run()
        figures = flow.statistics()
    assert figures["crossings"] == 0
    assert figures["length"] * 2 * options.radius > 0.9 * 9  # of the area
