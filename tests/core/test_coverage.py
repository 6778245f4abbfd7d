# SPDX-License-Identifier: GPL-3.0-or-later
"""How well a curve that has grown covers the surface, by samples of that."""

from __future__ import annotations

import geometry
import numpy as np
from flows import flow_on

RADIUS = 0.09
SAMPLES = 6000


def test_hardly_any_place_is_farther_than_half_a_spacing() -> None:
    """The 99th percentile of the distance to the curve, in half spacings, over four first faces."""
    mesh = geometry.torus(48, 24)
    farthest = []
    for variation in range(4):
        with flow_on(mesh, radius=RADIUS, variation=variation) as flow:
            assert flow.run() == "converged"
            begin, end = geometry.ends_of(flow.polylines())
        places = geometry.sample_surface(mesh, SAMPLES)
        distance = geometry.distance_to_pieces(places, begin, end)
        farthest.append(np.percentile(distance, 99) / RADIUS)
    assert np.mean(farthest) < 1.06
