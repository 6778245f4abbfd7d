# SPDX-License-Identifier: GPL-3.0-or-later
"""The checks themselves: they find what they are there to find."""

from __future__ import annotations

import geometry
import numpy as np
import pytest

OPEN = np.array([0], dtype=np.uint8)


def whole(points: np.ndarray) -> np.ndarray:
    return np.array([0, len(points)], dtype=np.uint32)


def test_crossing_is_found() -> None:
    # All pieces in the lower right face of a grid of one cell.
    points = np.array([[0.5, 0.1, 0], [0.9, 0.3, 0], [0.9, 0.1, 0], [0.5, 0.3, 0]])
    assert geometry.crossings(geometry.grid(1), points, whole(points), OPEN) == [(0, 2)]


def test_near_miss_is_no_crossing() -> None:
    points = np.array([[0.5, 0.1, 0], [0.9, 0.3, 0], [0.9, 0.1, 0], [0.7001, 0.2, 0]])
    assert geometry.crossings(geometry.grid(1), points, whole(points), OPEN) == []


def test_crossing_of_closing_piece_is_found() -> None:
    points = np.array([[0.5, 0.1, 0], [0.9, 0.3, 0], [0.9, 0.1, 0], [0.5, 0.3, 0]])
    closed = np.array([1], dtype=np.uint8)
    points = points[[1, 2, 3, 0]]
    assert geometry.crossings(geometry.grid(1), points, whole(points), closed) == [(1, 3)]


def test_other_sheet_does_not_cross() -> None:
    lower = geometry.grid(1)
    sheets = geometry.Mesh(
        np.vstack([lower.vertices, lower.vertices + (0, 0, 0.1)]),
        np.vstack([lower.faces, lower.faces + np.uint32(4)]),
    )
    points = np.array([[0.5, 0.1, 0], [0.9, 0.3, 0], [0.9, 0.1, 0.1], [0.5, 0.3, 0.1]])
    offsets = np.array([0, 2, 4], dtype=np.uint32)
    assert geometry.crossings(sheets, points, offsets, np.zeros(2, dtype=np.uint8)) == []


def test_distance_from_the_surface_is_seen_in_every_direction() -> None:
    points = np.array([[0.5, 0.5, 0], [0.5, 0.5, 0.01], [1.01, 0.5, 0], [0.5, -0.01, 0]])
    found = geometry.off_surface(geometry.grid(3), points)
    np.testing.assert_allclose(found, [0, 0.01, 0.01, 0.01], atol=1e-15)


def test_lengths() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    assert geometry.curve_length(points, whole(points), OPEN) == 3
    assert geometry.curve_length(points, whole(points), 1 - OPEN) == 4
    samples, lengths = geometry.weighted_samples(points, whole(points), 1 - OPEN, 0.1)
    assert lengths.sum() == pytest.approx(4) and len(samples) == 40


@pytest.mark.parametrize(
    ("mesh", "characteristic"),
    [
        (geometry.icosphere(2), 2),
        (geometry.torus(8, 6), 0),
        (geometry.cube(), 2),
        (geometry.grid(3), 1),
        (geometry.two_spheres(), 4),
        (geometry.moebius(), 0),
    ],
)
def test_meshes_are_what_they_are_called(mesh: geometry.Mesh, characteristic: int) -> None:
    edges = np.sort(mesh.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges = np.unique(edges, axis=0)
    assert len(mesh.vertices) - len(edges) + len(mesh.faces) == characteristic


def test_samples_lie_on_the_surface() -> None:
    mesh = geometry.icosphere(1)
    points = geometry.sample_surface(mesh, 200)
    assert geometry.off_surface(mesh, points).max() < 1e-12
    assert np.abs(points.mean(axis=0)).max() < 0.2
