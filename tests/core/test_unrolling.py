# SPDX-License-Identifier: GPL-3.0-or-later
"""Strands laid flat by maps that keep lengths: nothing is lost, and seams cut where they are."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from flows import flow_on
from meander import core
from meander.model.geometry import simplification
from meander.model.geometry.simplification import Light
from meander.model.geometry.thinning import with_points
from meander.model.toolpaths import toolpath, unrolling

SIDES, ROWS = 24, 10


def cylinder():
    """A prism with a map that rolls it out to its true size, twice as large, and a seam."""
    angle = 2.0 * np.pi * np.arange(SIDES) / SIDES
    side = 2.0 * np.sin(np.pi / SIDES)
    vertices = [
        (np.cos(a), np.sin(a), side * row) for row in range(ROWS + 1) for a in angle
    ]
    faces, uv = [], []
    for row in range(ROWS):
        for column in range(SIDES):
            corners = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)]
            for pick in ((0, 1, 2), (0, 2, 3)):
                faces.append([corners[i][1] * SIDES + corners[i][0] % SIDES for i in pick])
                uv.append([[2.0 * side * c for c in corners[i]] for i in pick])
    mesh = toolpath.Mesh(np.array(vertices), np.array(faces, dtype=np.uint32))
    return mesh, np.array(uv), side


def cube_apart():
    """A cube, every face of which has a square of its own in the map."""
    vertices, faces = geometry.cube()
    mesh = toolpath.Mesh(np.asarray(vertices, float), np.asarray(faces, dtype=np.uint32))
    corners = mesh.vertices[mesh.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    uv = np.zeros((len(faces), 3, 2))
    for index, normal in enumerate(normals):
        axis = int(np.abs(normal).argmax())
        place = 2 * axis + (normal[axis] > 0.0)
        uv[index] = np.delete(corners[index], axis, axis=1) * 0.1 + [place, 0.0]
    return mesh, uv


def filled(mesh, radius):
    with flow_on((mesh.vertices, mesh.faces), radius=radius, iteration_limit=60) as flow:
        flow.run()
        return flow.polylines(), flow.point_data()


def length_of(strands):
    total = 0.0
    for strand in strands:
        points = strand.points
        points = np.vstack([points, points[:1]]) if strand.closed else points
        total += float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    return total


def nearest_in(mesh):
    """The triangle nearest to each point by looking at every one."""

    def nearest(points):
        faces, weights = [], []
        everything = np.arange(len(mesh.faces))
        for point in points:
            found = unrolling._weights(np.tile(point, (len(everything), 1)), everything, mesh)
            found = np.clip(found, 0.0, 1.0)
            found /= found.sum(axis=1, keepdims=True)
            places = np.einsum("nk,nkj->nj", found, mesh.vertices[mesh.faces])
            best = int(np.linalg.norm(places - point, axis=1).argmin())
            faces.append(best)
            weights.append(found[best])
        return np.array(faces), np.array(weights)

    return nearest


@pytest.mark.parametrize("light", [False, True])
def test_a_cylinder_rolls_out_without_loss(light):
    mesh, uv, side = cylinder()
    curve, data = filled(mesh, 0.15)
    strands = toolpath.strands_of(curve, data)
    whole = length_of(strands)
    if light:
        kept = simplification.light_points(curve, Light(0.02), 0.3)
        data = core.PointData(*(values[kept] for values in data))
        strands = toolpath.strands_of(with_points(curve, kept), data)
        assert len(kept) < 0.6 * len(curve.positions)
    flat = unrolling.unrolled(strands, mesh, uv, nearest_in(mesh) if light else None)
    assert length_of(flat) == pytest.approx(whole, rel=0.01 if light else 1e-6)
    points = np.vstack([strand.points for strand in flat])
    wide, high = SIDES * side, ROWS * side
    assert points[:, 0].min() > -1e-6 and points[:, 0].max() < wide + 1e-6
    assert points[:, 1].min() > -1e-6 and points[:, 1].max() < high + 1e-6
    assert (points[:, 2] == 0.0).all()
    # Rolled up again every point is where the surface is, and open ends lie on the seam.
    for strand in flat:
        if not strand.closed:
            ends = strand.points[[0, -1], 0]
            assert np.allclose(np.minimum(ends, wide - ends), 0.0, atol=1e-6)
        steps = np.linalg.norm(np.diff(strand.points, axis=0), axis=1)
        assert steps.max() < 0.3


def test_a_cube_falls_into_squares():
    mesh, uv = cube_apart()
    curve, data = filled(mesh, 0.2)
    strands = toolpath.strands_of(curve, data)
    flat = unrolling.unrolled(strands, mesh, uv)
    assert len(flat) > 10
    # A point beyond an edge by no more than a ten-thousandth of a triangle, whose longest side is
    # 2.83 here, counts as on it.
    beyond = 2.9e-4
    assert length_of(flat) == pytest.approx(length_of(strands), rel=1e-5)
    for strand in flat:
        # Squares of side 2, ten apart; each path stays in one, and ends where that ends.
        square = 10.0 * np.round(strand.points[0, 0] / 10.0)
        own = strand.points[:, :2] - [square, 0.0]
        assert np.abs(own).max() <= 1.0 + 1e-6
        if not strand.closed:
            assert np.allclose(np.abs(own[[0, -1]]).max(axis=1), 1.0, atol=beyond)


def test_a_map_without_area_gives_nothing():
    mesh, uv, _side = cylinder()
    curve, data = filled(mesh, 0.3)
    assert unrolling.unrolled(toolpath.strands_of(curve, data), mesh, 0.0 * uv) == []
