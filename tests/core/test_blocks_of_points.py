# SPDX-License-Identifier: GPL-3.0-or-later
"""What is computed of points block by block is what is computed of all at once."""

from __future__ import annotations

import numpy as np
import pytest
from meander import core
from meander.model import profile
from meander.model.geometry import blocks, thinning


@pytest.fixture(params=[1, 2, 7, 10**6])
def size(request, monkeypatch: pytest.MonkeyPatch) -> int:
    monkeypatch.setattr(blocks, "SIZE", request.param)
    return request.param


def line(count: int) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(count)
    return np.cumsum(random.normal(size=(count, 3)), axis=0), random.normal(size=(count, 3))


def directions(points: np.ndarray, cyclic: bool) -> np.ndarray:
    """One point after another."""
    made = []
    for k, point in enumerate(points):
        last = k + 1 == len(points)
        after = points[0 if last else k + 1] - point if cyclic or not last else None
        before = point - points[k - 1] if cyclic or k else None
        pieces = [each / np.linalg.norm(each) for each in (before, after) if each is not None]
        made.append(sum(pieces) / np.linalg.norm(sum(pieces)))
    return np.array(made)


@pytest.mark.parametrize("cyclic", [True, False])
@pytest.mark.parametrize("count", [3, 7, 8, 40])
def test_directions_and_tilts(size, count, cyclic) -> None:
    points, normals = line(count)
    along = directions(points, cyclic)
    assert np.allclose(profile.directions(points, cyclic), along, atol=1e-12)
    tilts = profile.tilts(points, normals, cyclic)
    assert np.abs(np.diff(tilts)).max() <= np.pi * (1 + 1e-12)
    up = np.array([0.0, 0.0, 1.0]) - along * along[:, 2:]
    up /= np.linalg.norm(up, axis=1)[:, None]
    side = np.cross(along, up)
    # Turned by the tilt about the direction, the frame has the normal's part across it as its X.
    y = np.cos(tilts)[:, None] * up + np.sin(tilts)[:, None] * side
    across = normals - along * (normals * along).sum(1)[:, None]
    across /= np.linalg.norm(across, axis=1)[:, None]
    assert np.allclose((across * y).sum(1), 0.0, atol=1e-9)


def test_a_strand_of_one_point_has_no_direction(size) -> None:
    for cyclic in (True, False):
        assert np.array_equal(profile.directions(np.ones((1, 3)), cyclic), np.zeros((1, 3)))


@pytest.mark.parametrize("closed", [0, 1])
def test_points_that_nearly_coincide(size, closed) -> None:
    points = np.repeat(line(20)[0], 2, axis=0)
    points[1::2] += 1e-6
    curve = core.Polylines(points, points, np.array([0, 40], np.uint32), np.array([closed]))
    assert len(thinning.kept_points(curve, 1e-3)) == 20
