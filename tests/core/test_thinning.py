# SPDX-License-Identifier: GPL-3.0-or-later
"""Points that nearly coincide are merged, and the curve stays where it is."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from conftest import polylines
from meander.model.geometry import thinning


def walk(count: int, seed: int, closed: bool) -> np.ndarray:
    """A winding line whose steps are long, short, and next to nothing."""
    rng = np.random.default_rng(seed)
    scale = rng.choice([1.0, 0.02, 0.004, 0.0], size=count, p=[0.4, 0.3, 0.2, 0.1])
    steps = rng.normal(size=(count, 3)) * scale[:, None]
    points = np.cumsum(steps, axis=0)
    if closed:  # so that it also ends near its beginning
        points[-2:] = points[0] + 0.004 * steps[:2]
    return points


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_the_curve_moves_by_less_than_the_distance(closed, seed):
    strands = [walk(120, seed, closed), walk(90, seed + 100, closed) + 50.0]
    before = polylines(*((strand, closed) for strand in strands))
    before = before._replace(normals=np.arange(3.0 * len(before.positions)).reshape(-1, 3))
    distance = 0.05
    after = thinning.with_points(before, thinning.kept_points(before, distance))
    assert after.closed.tolist() == before.closed.tolist()
    assert len(after.positions) < 0.8 * len(before.positions)
    for strand, points in enumerate(strands):
        kept = after.positions[after.offsets[strand] : after.offsets[strand + 1]]
        assert (kept[0] == points[0]).all()
        assert closed or (kept[-1] == points[-1]).all()
        loop = [kept[:1]] if closed else []
        line, original = np.vstack([kept, *loop]), np.vstack([points, *(points[:1],) * closed])
        # The last step may be short: nothing after it has to give way.
        assert (np.linalg.norm(np.diff(line, axis=0), axis=1)[:-1] >= distance).all()
        middles = (original[1:] + original[:-1]) / 2.0
        assert geometry.farthest(np.vstack([original, middles]), line) <= distance
    # Normals stay with their points.
    rows = {point.tobytes(): normal for point, normal in zip(before.positions, before.normals)}
    for point, normal in zip(after.positions, after.normals):
        assert point.tobytes() in rows
        if sum(p.tobytes() == point.tobytes() for p in before.positions) == 1:
            assert (rows[point.tobytes()] == normal).all()


def test_what_is_small_as_a_whole_stays():
    ring = 1e-3 * np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]])
    line = 1e-3 * np.array([[0.0, 0, 5], [0, 0, 5.1], [0, 0, 5.2]])
    kept = thinning.kept_points(polylines((ring, True), (line, False)), 0.5)
    assert kept.tolist() == [0, 1, 2, 3, 4, 6]


def test_the_distance_follows_the_densest_place():
    assert thinning.least_spacing(0.5, None) == pytest.approx(1.0)
    assert thinning.least_spacing(0.5, np.array([1.0, 4.0])) == pytest.approx(0.5)
