# SPDX-License-Identifier: GPL-3.0-or-later
"""Contours of surfaces, seen from far away along z."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from meander.model.geometry.clipped_mesh import Triangles
from meander.model.geometry.contours import contours

UP = np.array([0.0, 0.0, 1.0])


def lines_of(vertices: np.ndarray, faces: np.ndarray, view: np.ndarray, smooth: bool = False):
    vertices = np.asarray(vertices, float)
    normals = vertices.copy() if smooth else None
    mesh = Triangles(vertices, np.asarray(faces, np.int64), normals=normals)
    return contours(mesh, np.tile(view / np.linalg.norm(view), (len(vertices), 1)))


def test_a_smooth_ball_has_one_circle() -> None:
    vertices, faces = geometry.icosphere(3)
    vertices = vertices / np.linalg.norm(vertices, axis=1)[:, None]
    ((points, normals, closed),) = lines_of(vertices, faces, np.array([1.0, 2.0, 3.0]), True)
    assert closed and np.linalg.norm(points, axis=1) == pytest.approx(1.0, abs=0.02)
    assert points @ [1.0, 2.0, 3.0] == pytest.approx(0.0, abs=0.02)
    assert np.abs(normals @ [1.0, 2.0, 3.0]).max() < 0.02


def test_a_flat_ball_has_edges_between_what_is_seen_and_what_is_not() -> None:
    vertices, faces = geometry.icosphere(3)
    found = lines_of(vertices, faces, np.array([0.1, 0.2, 1.0]))
    assert len(found) == 1 and found[0][2]
    assert len(found[0][0]) > 30


def test_a_cube_has_nine_edges_in_sight() -> None:
    vertices, faces = geometry.cube()
    found = lines_of(vertices, faces, np.array([1.0, 0.7, 0.5]))
    side = np.ptp(np.asarray(vertices), axis=0)[0]
    length = sum(
        np.linalg.norm(np.diff(np.vstack([points, points[:1]]) if closed else points, axis=0),
                       axis=1).sum()
        for points, _normals, closed in found
    )  # fmt: skip
    assert length == pytest.approx(9 * side, rel=0.06)


def test_a_sheet_has_its_boundary_from_both_sides() -> None:
    vertices, faces = geometry.grid(4)
    for view in (UP, -UP):
        ((points, _normals, closed),) = lines_of(vertices, faces, view)
        assert closed and len(points) == 16
