# SPDX-License-Identifier: GPL-3.0-or-later
"""All that is told of a curve, found in the background: the same as by the calls for one thing."""

from __future__ import annotations

from dataclasses import astuple

import geometry
import numpy as np
import pytest
from meander import core


@pytest.fixture
def flow():
    options = core.default_options()
    options.radius = 0.05
    options.iteration_limit = 30
    with core.Flow(core.Surface(*geometry.icosphere(3)), options) as made:
        made.run()
        yield made


def same(one: tuple, other: tuple) -> bool:
    return all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))


def test_it_finds_what_the_other_calls_find(flow) -> None:
    with core.Context() as context:
        flow.start_finding(True, 0.12, context)
        found = flow.found()
        assert context.progress == 1.0
    assert same(found.polylines, flow.polylines())
    assert np.array_equal(found.guides, flow.guides())
    assert same(found.point_data, flow.point_data())
    assert found.statistics == flow.statistics()
    assert same(astuple(found.gaps), astuple(flow.gaps()))
    for one, other in zip(found.drawn, flow.rounded(0.12), strict=True):
        assert same(one, other)
    assert found.polylines.normals is found.point_data.normals, "held once"


def test_what_is_not_asked_for_is_left_out(flow) -> None:
    flow.start_finding(gaps=False)
    found = flow.found()
    assert found.gaps is None and found.drawn is None


def test_the_flow_belongs_to_it(flow) -> None:
    flow.start_finding()
    with pytest.raises(core.MeanderError, match="has been started"):
        flow.statistics()
    with pytest.raises(core.MeanderError, match="has been started"):
        flow.start_finding()
    assert len(flow.found().polylines.positions) > 100
    with pytest.raises(core.MeanderError, match="start"):
        flow.found()


def test_it_can_be_cancelled_and_the_flow_closed(flow) -> None:
    with core.Context() as context:
        flow.start_finding(True, 0.12, context)
        context.cancel()
        try:
            flow.found()
        except core.MeanderError as error:
            assert error.status == core.Status.CANCELLED
        context.reset()
        flow.start_finding(True, 0.12, context)
        flow.close()


def test_what_it_has_found_outlives_the_flow(flow) -> None:
    flow.start_finding(True, 0.12)
    found = flow.found()
    positions = found.drawn[0].positions.copy()
    flow.close()
    assert np.array_equal(found.drawn[0].positions, positions)


def test_a_run_that_is_found_has_found_nothing(flow) -> None:
    flow.start()
    with pytest.raises(core.MeanderError, match="start_finding"):
        flow.found()


def test_other_tolerances_are_refused(flow) -> None:
    with pytest.raises(core.MeanderError, match="tolerance"):
        flow.start_finding(True, 0.7)
    assert not flow.running
