# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals at the points of a curve: flat on faces beside creases, blended over smooth meshes."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from flows import flow_on
from meander import core
from meander.model.geometry.surface_normals import normals_at

SPACING = 0.25


def grown(mesh: geometry.Mesh, spacing: float) -> tuple[core.Polylines, core.PointData]:
    with flow_on(mesh, radius=spacing / 2, iteration_limit=60) as flow:
        flow.run()
        return flow.polylines(), flow.point_data()


def angles(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Between unit vectors, in degrees."""
    return np.degrees(np.arccos(np.clip((one * other).sum(axis=1), -1.0, 1.0)))


def faces_of(mesh: geometry.Mesh) -> np.ndarray:
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


@pytest.fixture(scope="module")
def on_cube() -> tuple[geometry.Mesh, core.Polylines, core.PointData]:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))]
    mesh = geometry.Mesh(corners, np.array(faces, dtype=np.uint32))
    return mesh, *grown(mesh, SPACING)


def test_a_large_face_is_flat_but_at_its_edges(on_cube) -> None:
    mesh, curve, data = on_cube
    flat = faces_of(mesh)[data.faces]
    assert np.abs(flat).max(axis=1) == pytest.approx(1.0)
    # How far the nearest edge of the cube is: the second largest coordinate says it.
    away = 1.0 - np.sort(np.abs(curve.positions), axis=1)[:, 1]
    lean = angles(curve.normals, flat)
    inner = away > 0.5 * SPACING / 2.0 + 1e-9
    assert inner.mean() > 0.7
    assert lean[inner].max() < 0.01
    # On an edge, away from corners, half of the fold.
    along = 1.0 - np.sort(np.abs(curve.positions), axis=1)[:, 0]
    on_edge = (away < 1e-9) & (along > 0.5 * SPACING)
    assert on_edge.sum() > 10
    assert lean[on_edge] == pytest.approx(45.0, abs=0.1)


def test_normals_turn_steadily(on_cube) -> None:
    """From one point to the next by no more than the fold over the reach."""
    _, curve, _ = on_cube
    step = np.linalg.norm(np.diff(curve.positions, axis=0), axis=1)
    turn = angles(curve.normals[1:], curve.normals[:-1])
    reach = 0.5 * SPACING / 2.0
    assert (turn < 8.0 + 120.0 * step / reach).all()


@pytest.mark.parametrize(("subdivisions", "spacing"), [(4, 0.6), (3, 0.1)])
def test_smooth_meshes_stay_smooth(subdivisions: int, spacing: float) -> None:
    """Also where faces are larger than the spacing: nothing turns at their edges."""
    mesh = geometry.icosphere(subdivisions)
    curve, data = grown(mesh, spacing)
    outward = curve.positions / np.linalg.norm(curve.positions, axis=1, keepdims=True)
    assert angles(curve.normals, outward).max() < 1.0
    found = normals_at(mesh.vertices, mesh.faces, data.faces, data.barycentrics, spacing / 2)
    assert angles(found, outward).max() < 1.0


def test_numpy_has_the_same_normals(on_cube) -> None:
    mesh, curve, data = on_cube
    found = normals_at(mesh.vertices, mesh.faces, data.faces, data.barycentrics, SPACING / 2)
    # But at corners, where the library weights faces by their angles.
    far = (1.0 - np.sort(np.abs(curve.positions), axis=1)[:, 0]) > 0.6 * SPACING
    assert far.mean() > 0.5
    assert angles(found, curve.normals)[far].max() < 0.01
    assert angles(found, curve.normals).max() < 20.0


def test_a_ribbon_lies_on_a_cube(on_cube) -> None:
    """By what is drawn of it: half of the way lies on the faces to a hundredth of a degree."""
    mesh, curve, data = on_cube
    pieces = np.linalg.norm(np.diff(curve.positions, axis=0), axis=1)
    lean = angles(curve.normals, faces_of(mesh)[data.faces])[:-1]
    assert pieces[lean < 0.01].sum() > 0.5 * pieces.sum()


def test_edges_with_one_face_or_three_are_flat() -> None:
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [1, 1, 0]])
    faces = np.array([[0, 1, 2], [1, 0, 3], [0, 1, 4], [1, 5, 2]])
    middle = np.array([[0.5, 0.5, 0.0]] * 2)  # on the edge of three faces, and on a border
    found = normals_at(vertices, faces, np.array([0, 3]), middle, 0.05)
    assert found[0] == pytest.approx(np.array([0.0, 0.0, 1.0]))
    assert found[1, 2] > 0.99
