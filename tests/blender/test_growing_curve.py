# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn while a curve grows, as arrays; that it is seen is for tests/ui to say."""

import bpy
import numpy as np
import pytest
from meander import core
from meander.run.growing_curve import GrowingCurve, segments_of
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


def test_what_is_shown_lies_above_the_surface_and_goes_away():
    surface = sphere()
    curve = GrowingCurve(lambda: surface, lambda: bpy.context.scene, np.eye(4))
    lines = polylines([6, 4], [True, False])
    curve.show(lines, 0.25)
    assert curve.point_count == 10
    assert np.allclose(curve._positions, lines.positions + 0.25 * lines.normals, atol=1e-6)
    assert curve._positions.dtype == np.float32
    curve.remove()
    curve.remove()  # harmless
