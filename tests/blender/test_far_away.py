# SPDX-License-Identifier: GPL-3.0-or-later
"""A curve of a millimetre ten kilometres from the origin, as on a map or in a city: points stick to
their triangles, hide and are exported as at the origin. World coordinates in single precision are a
millimetre apart there."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
import scenes
from meander.model.toolpaths.toolpath import Strand, strand_of
from meander.run.motion import StickingFollower
from meander.scene import points as scene_points
from meander.scene.visible import visible_strands

SIZE = 1e-3
PLACE = np.array([1e4, 1e4, 0.0])
# Coordinates there are rounded to 2e-12.
ROUNDING = 1e-11


@pytest.fixture
def ball() -> bpy.types.Object:
    thing = scenes.sphere(subdivisions=4)
    thing.scale = (SIZE,) * 3
    thing.location = PLACE
    bpy.context.view_layer.update()
    return thing


def triangles(ball: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    return scene_points.triangles_of(ball, bpy.context.evaluated_depsgraph_get())


def around(latitude: float, tilt: float = 0.3) -> np.ndarray:
    """A line around the ball, on it about."""
    a = 2 * np.pi * np.arange(200) / 200
    flat = np.column_stack([np.cos(a), np.sin(a), np.full(200, latitude)])
    flat[:, 2] += tilt * np.sin(a)
    return flat / np.linalg.norm(flat, axis=1, keepdims=True)


def test_points_are_bound_to_the_triangles_that_hold_them(ball: bpy.types.Object) -> None:
    vertices, faces = triangles(ball)
    middles = vertices[faces].mean(axis=1)
    index, weights = scene_points.bind(middles, vertices, faces)
    assert np.array_equal(index, np.arange(len(faces)))
    assert np.abs(weights - 1 / 3).max() < 1e-6
    assert scene_points.farthest(middles, vertices, faces) < ROUNDING


def test_they_stick_where_they_are(ball: bpy.types.Object) -> None:
    vertices, faces = triangles(ball)
    points = vertices[faces].mean(axis=1)
    offsets, closed = np.array([0, len(points)]), np.zeros(1, dtype=np.uint8)
    follower = StickingFollower(points, offsets, closed, None, vertices, faces)
    there = follower.moved(vertices + [0.0, 0.0, 5.0], faces)
    assert np.abs(there.positions - points - [0.0, 0.0, 5.0]).max() < ROUNDING


def test_what_is_hidden_is_what_is_hidden_at_the_origin(ball: bpy.types.Object) -> None:
    vertices, faces = triangles(ball)

    def seen(factor: float, place: np.ndarray) -> list[Strand]:
        lines = [1.001 * around(latitude) for latitude in (-0.8, -0.1, 0.1, 0.8)]
        strands = [strand_of(factor * line + place, line, True) for line in lines]
        mesh = (vertices - PLACE) / SIZE * factor + place
        return visible_strands(strands, (1, 0, 0), (0, 1, 0), mesh, faces)

    expected, found = seen(1.0, np.zeros(3)), seen(SIZE, PLACE)
    whole = sum(strand.length for strand in expected)
    assert 2 * np.pi < whole < 4 * np.pi  # about half of each, all of one and none of another
    assert sum(strand.length for strand in found) == pytest.approx(whole * SIZE, rel=0.01)
    heights = np.concatenate([strand.points[:, 2] for strand in found]) / SIZE
    assert heights.min() > -0.1  # where the ball turns away from the eye


def test_a_filled_ball_exports_its_own_triangles(ball: bpy.types.Object) -> None:
    result = scenes.fill(ball, 0.4 * SIZE)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    vertices, faces = triangles(ball)
    for strand in scene_points.strands_of_result(result, depsgraph):
        corners = vertices[faces[strand.faces]]
        held = np.einsum("nk,nkj->nj", strand.weights, corners)
        assert np.abs(held - strand.points).max() < 1e-6 * SIZE
        outward = (strand.points - PLACE) / SIZE
        assert (strand.normals * outward).sum(axis=1).min() > 0.98
