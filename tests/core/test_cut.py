# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces cut along a curve that fills them, as numpy arrays."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from flows import flow_on
from geometry import triangle_areas
from meander import core


def grown(mesh: geometry.Mesh, radius: float, seed: core.Seed | None = None) -> core.Flow:
    flow = flow_on(mesh, seed=seed, radius=radius)
    flow.run()
    return flow


def check(mesh: geometry.Mesh, flow: core.Flow, cut: core.CutSurface) -> None:
    """What holds for the cut of any closed curve on a closed surface."""
    curve = flow.polylines()
    assert np.allclose(cut.positions[cut.line_vertices], curve.positions, rtol=0, atol=1e-12)
    assert np.array_equal(cut.offsets, curve.offsets)
    assert np.array_equal(cut.closed, curve.closed)
    # Corners and vertices are where their weights say.
    corners = np.einsum("fkw,fwx->fkx", cut.corner_weights, mesh.vertices[mesh.faces[cut.origins]])
    assert np.allclose(corners, cut.positions[cut.faces], rtol=0, atol=1e-12)
    assert np.allclose(
        geometry.points_at(mesh, cut.vertex_faces, cut.vertex_weights),
        cut.positions,
        rtol=0,
        atol=1e-12,
    )
    share = np.bincount(cut.origins, triangle_areas(cut.positions, cut.faces), len(mesh.faces))
    assert np.allclose(share, triangle_areas(*mesh), rtol=1e-9)
    # Every edge once in each direction: watertight.
    edges = np.concatenate([cut.faces[:, (k, (k + 1) % 3)] for k in range(3)]).astype(np.int64)
    n = len(cut.positions)
    keys = np.sort(edges[:, 0] * n + edges[:, 1])
    assert len(np.unique(keys)) == len(keys)
    assert np.array_equal(keys, np.sort(edges[:, 1] * n + edges[:, 0]))
    # The curve's edges are among them, and other sides meet there and nowhere else.
    line = cut.line_edges().astype(np.int64)
    face_of = dict(zip((edges[:, 0] * n + edges[:, 1]).tolist(), range(len(edges))))
    m = len(cut.faces)
    left = np.array([face_of[k] % m for k in (line[:, 0] * n + line[:, 1]).tolist()])
    right = np.array([face_of[k] % m for k in (line[:, 1] * n + line[:, 0]).tolist()])
    assert (cut.nearest_sides[left] == 1).all() and (cut.nearest_sides[right] == -1).all()
    assert (cut.sides[left] == -cut.sides[right]).all()
    assert (cut.distances[cut.line_vertices] == 0).all()
    assert (cut.face_distances >= 0).all()


def test_a_curve_parts_a_coarse_cube_in_two() -> None:
    mesh = geometry.cube()
    flow = grown(mesh, 0.1)
    whole = core.cut_surface(flow)
    fine = core.cut_surface(flow, detail=0.05, middle_lines=True)
    for cut in (whole, fine):
        check(mesh, flow, cut)
        assert cut.regions.max() == 1
        # Both sides are as wide.
        sides = [triangle_areas(cut.positions, cut.faces[cut.sides == k]).sum() for k in (1, -1)]
        assert sides[0] == pytest.approx(sides[1], rel=0.05)
    # Most of the ridges are r from the curve, as in the middle between turns.
    ridge = np.percentile(fine.distances, 95)
    assert 0.9 < ridge / 0.1 < 1.15
    # No face of the fine one reaches from turn to turn.
    assert np.percentile(np.ptp(fine.along, axis=1), 99.5) < 2 * 0.1


def test_the_same_at_any_scale_and_again() -> None:
    mesh = geometry.icosphere(2)
    large = geometry.mesh(1024.0 * mesh.vertices, mesh.faces)
    one, other = (
        core.cut_surface(grown(m, r), detail=r / 4, middle_lines=True)
        for m, r in ((mesh, 0.2), (large, 204.8))
    )
    assert np.array_equal(one.faces, other.faces)
    assert np.array_equal(1024.0 * one.positions, other.positions)
    assert np.allclose(1024.0 * one.distances, other.distances, rtol=1e-9)


def test_what_does_not_part_the_surface_has_sides_of_the_nearest_strand() -> None:
    mesh = geometry.grid(6)
    points = np.array([[0.3, 0.52, 0.0], [0.7, 0.52, 0.0]])
    seed = core.Seed(points, [0, 2], [0], fixed=[1, 1])
    flow = flow_on(mesh, seed=seed, radius=0.1)
    cut = core.cut_surface(flow, detail=0.05, middle_lines=True)
    assert cut.regions.max() == 0
    assert np.array_equal(cut.sides, cut.nearest_sides)
    # Beyond the ends the sides meet somewhere in front of them.
    middles = cut.positions[cut.faces].mean(axis=1)
    beside = (cut.positions[cut.faces, 0] > 0.3).all(axis=1)
    beside &= (cut.positions[cut.faces, 0] < 0.7).all(axis=1)
    assert beside.sum() > 100
    assert np.array_equal(cut.sides[beside] > 0, middles[beside, 1] > 0.52)
    # The plain distance from a segment, and how far along it.
    x, y = cut.positions[:, 0], cut.positions[:, 1]
    along = np.clip(x, 0.3, 0.7)
    assert np.allclose(cut.distances, np.hypot(x - along, y - 0.52), rtol=0, atol=1e-5)
    assert np.allclose(cut.along, along[cut.faces] - 0.3, rtol=0, atol=1e-5)


def test_guides_are_left_out_and_parts_without_a_strand_are_kept() -> None:
    mesh = geometry.two_spheres()
    turn = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    circle = np.stack((0.8 * np.cos(turn), 0.8 * np.sin(turn), np.full(60, 0.6)), axis=1)
    guide = circle * (1, 1, -1)
    seed = core.Seed(np.concatenate((circle, guide)), [0, 60, 120], [1, 1], guides=[0, 1])
    flow = flow_on(mesh, seed=seed, radius=0.2)
    cut = core.cut_surface(flow)
    assert cut.line_strands.tolist() == [0]
    empty = cut.strands == core.NO_STRAND
    assert 0 < empty.sum() < len(cut.faces)
    assert (cut.sides[empty] == 0).all() and (cut.sides[~empty] != 0).all()
    assert np.isinf(cut.distances[np.unique(cut.faces[empty])]).all()
    # Two caps of one sphere, and the other sphere.
    assert cut.regions.max() == 2


@pytest.mark.parametrize("detail", [-1.0, float("nan"), float("inf"), 1e-9])
def test_a_detail_that_cannot_be_is_refused(detail: float) -> None:
    mesh = geometry.icosphere(1)
    flow = flow_on(mesh, radius=0.3)
    with pytest.raises(core.MeanderError, match="detail"):
        core.cut_surface(flow, detail)
