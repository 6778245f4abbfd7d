# SPDX-License-Identifier: GPL-3.0-or-later
"""Outlines: fixed strands along the border, at the distance asked for, and the rest filled."""

from __future__ import annotations

import numpy as np
import pytest
from flows import options_of
from meander import core
from sentences import assert_sentence
from test_border import HOLES, distances, square_outline, with_holes
from test_prepared_mesh import grid

SPACING = 0.12


def border_distance(points: np.ndarray, holes: bool) -> np.ndarray:
    x, y = points[:, 0], points[:, 1]
    result = np.minimum(np.minimum(x, 3.0 - x), np.minimum(y, 3.0 - y))
    for cx, cy, radius in HOLES if holes else ():
        result = np.minimum(result, np.hypot(x - cx, y - cy) - radius)
    return result


@pytest.mark.parametrize("share", [0.25, 0.5, 1.0, 2.0])
def test_outlines_run_at_the_distance(share: float) -> None:
    for surface, holes in ((core.Surface(*grid(1)), False), (with_holes(), True)):
        seed, skipped = surface.outlines(share * SPACING, SPACING)
        away = border_distance(seed.points, holes) / SPACING
        assert np.median(away) == pytest.approx(share, rel=0.01)
        # The holes are polygons of 30 or so sides, cut at straight lines.
        assert np.abs(away - share).max() < (0.12 if holes else 0.05)
        assert seed.guides.all()
        if share < 2.0:  # two spacings from both sides there is no room between the holes
            assert seed.closed.all() and skipped == 0
            assert len(seed.closed) == (3 if holes else 1)
        elif holes:
            assert not seed.closed.all() and skipped > 0


@pytest.mark.parametrize("share", [0.5, 1.0])
def test_the_rest_is_filled_and_the_outline_stays(share: float) -> None:
    surface = with_holes()
    seed, _skipped = surface.outlines(share * SPACING, SPACING)
    options = options_of(radius=SPACING / 2, boundary_distance=share)
    flow = core.Flow(surface, options, seed)
    before = flow.polylines()
    flow.run()
    figures = flow.statistics()
    # One strand fills it: the strip along the border gets none.
    assert (figures["strands"], figures["guides"], figures["crossings"]) == (4, 3, 0)
    curve = flow.polylines()
    for k in range(3):
        old = before.positions[before.offsets[k] : before.offsets[k + 1]]
        new = curve.positions[curve.offsets[k] : curve.offsets[k + 1]]
        assert np.abs(old - new).max() < 1e-12 if len(old) == len(new) else True
        line = core.Polylines(old, old, np.array([0, len(old)]), np.array([1]))
        assert distances(new, line).max() < 1e-6
    assert np.median(distances(square_outline(), curve)) == pytest.approx(
        share * SPACING, rel=0.02
    )
    inner = curve.positions[curve.offsets[3] :]
    assert border_distance(inner, True).min() > (share + 0.3) * SPACING
    # Every part of the surface within the outlines is near a strand.
    points = np.random.default_rng(2).uniform(0.0, 3.0, (4000, 3)) * [1.0, 1.0, 0.0]
    points = points[border_distance(points, True) > share * SPACING]
    assert np.percentile(distances(points, curve), 99) < 1.25 * SPACING / 2


def test_a_closed_surface_has_none_and_nonsense_is_refused() -> None:
    vertices = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], dtype=float)
    closed = core.Surface(vertices, np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]))
    seed, skipped = closed.outlines(0.1, 0.2)
    assert (len(seed.closed), skipped) == (0, 0)
    surface = core.Surface(*grid(2))
    for distance, spacing in ((0.0, 0.1), (0.3, 0.1), (0.1, 0.0), (float("nan"), 0.1), (0.1, 99.0)):
        with pytest.raises(core.MeanderError) as refusal:
            surface.outlines(distance, spacing)
        assert_sentence(str(refusal.value))
