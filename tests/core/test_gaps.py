# SPDX-License-Identifier: GPL-3.0-or-later
"""Gaps of a curve that fills its surface; what gaps are is in tests/native/test_gaps.cpp."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import MODELS
from flows import flow_on
from meander import core
from sentences import assert_sentence


def flow_of(name: str) -> tuple[float, core.Flow]:
    make, radius = MODELS[name]
    return radius, flow_on(make(), radius=radius)


def test_a_filled_surface_has_small_gaps() -> None:
    radius, flow = flow_of("torus")
    with flow:
        flow.step()
        assert flow.gaps().sizes[0] > 3
        flow.run()
        before = flow.polylines().positions.tobytes()
        gaps = flow.gaps()
        assert flow.polylines().positions.tobytes() == before
        assert len(flow.gaps(100.0)) == 0
    # Two hairpins before a straight strand that do not give way would leave 1.5.
    assert np.all((gaps.sizes >= 1.2) & (gaps.sizes < 1.6))
    np.testing.assert_allclose(gaps.radii, gaps.sizes * radius, rtol=1e-9)


@pytest.mark.parametrize("size", [0.5, -1.0, float("nan"), float("inf")])
def test_sizes_out_of_range_are_refused(size: float) -> None:
    _radius, flow = flow_of("cube")
    with flow, pytest.raises(core.MeanderError) as refusal:
        flow.gaps(size)
    assert_sentence(str(refusal.value))
