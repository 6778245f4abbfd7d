# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn while a curve grows, as arrays; that it is seen is for tests/ui to say."""

import bpy
import numpy as np
import pytest
from mathutils import Vector
from meander import core
from meander.run.preview import GrowingCurve, _nearer, segments_of
from scenes import sphere


def polylines(counts: list[int], closed: list[bool]) -> core.Polylines:
    rng = np.random.default_rng(sum(counts))
    return core.Polylines(
        positions=rng.random((sum(counts), 3)),
        normals=rng.random((sum(counts), 3)),
        offsets=np.cumsum([0, *counts]).astype(np.uint32),
        closed=np.array(closed),
    )


@pytest.mark.parametrize(
    ("counts", "closed"),
    [
        ([5], [True]),
        ([5], [False]),
        ([2, 4, 3], [False, True, False]),
        ([7, 3], [True, True]),
        ([3, 2], [False, False]),
    ],
)
def test_segments_join_the_points_of_each_strand(counts, closed):
    expected, first = [], 0
    for count, is_closed in zip(counts, closed):
        expected += [(first + i, first + i + 1) for i in range(count - 1)]
        expected += [(first + count - 1, first)] * is_closed
        first += count
    found = segments_of(polylines(counts, closed))
    assert found.dtype == np.int32 and found.flags.c_contiguous  # for the graphics card
    assert found.tolist() == [list(segment) for segment in expected]


def test_a_share_of_the_segments_begins_at_the_first_point_of_each_strand():
    lines = polylines([8, 4, 5], [True, False, True])
    whole = segments_of(lines).tolist()
    assert segments_of(lines, 1.0).tolist() == whole
    assert segments_of(lines, 0.0).tolist() == []
    half = segments_of(lines, 0.5)
    assert half.dtype == np.int32 and half.flags.c_contiguous
    assert half.tolist() == [[i, i + 1] for i in (0, 1, 2, 3, 8, 9, 12, 13, 14)]
    for share in np.linspace(0.1, 0.9, 5):
        assert all(segment in whole for segment in segments_of(lines, share).tolist())


def test_what_is_shown_lies_where_the_curve_is_and_goes_away():
    surface = sphere()
    curve = GrowingCurve(lambda: surface, lambda: bpy.context.scene, np.eye(4))
    lines = polylines([6, 4], [True, False])
    curve.show(lines, 0.25)
    assert curve.point_count == 10
    assert np.allclose(curve._positions, lines.positions, atol=1e-6)
    assert curve._positions.dtype == np.float32
    curve.remove()
    curve.remove()  # harmless


@pytest.mark.parametrize("perspective", [True, False])
def test_it_is_drawn_nearer_to_the_viewer_and_in_its_place(perspective):
    place = Vector((2.0, -1.0, -8.0))  # in a view: to the right, below, eight away
    moved = _nearer(0.25, 8.0, perspective) @ place
    assert np.isclose(moved.z, -7.75)
    if perspective:
        assert np.allclose(np.array(moved.xy) / moved.z, np.array(place.xy) / place.z)
    else:
        assert np.allclose(moved.xy, place.xy)


def test_who_stands_beside_it_sees_it_where_it_is():
    for depth in (0.01, 0.0, -3.0):  # all but at the eye, and behind it
        moved = _nearer(0.25, depth, True) @ Vector((1.0, 1.0, -4.0))
        assert -4.0 <= moved.z < -3.59
