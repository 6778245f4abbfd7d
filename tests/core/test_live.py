# SPDX-License-Identifier: GPL-3.0-or-later
"""Another spacing, density or other options for a flow that goes on, through the bridge."""

import numpy as np
import pytest
from flows import options_of
from geometry import icosphere
from meander import core


@pytest.fixture
def grown():
    vertices, faces = icosphere(3)
    options = options_of(radius=0.12, threads=1)
    with core.Surface(vertices, faces) as surface:
        flow = core.Flow(surface, options)
    with flow:
        flow.run()
        yield vertices, options, flow


def _changed(flow, change):
    """Lets the flow go on after a change: its figures, and in how many iterations."""
    before = len(flow.history())
    change()
    assert flow.run() == "converged"
    figures = flow.statistics()
    assert figures["crossings"] == 0
    assert figures["strands"] == 1
    return figures, len(flow.history()) - before


def test_each_change_reaches_the_curve(grown):
    vertices, options, flow = grown
    from_scratch, first = len(flow.history()), flow.statistics()
    closer, iterations = _changed(flow, lambda: flow.set_radius(0.108))
    assert closer["spacing_target"] == pytest.approx(0.216)
    assert closer["spacing_median"] == pytest.approx(0.216, rel=0.05)
    assert closer["length"] > 1.05 * first["length"]
    assert iterations < from_scratch / 4

    density = np.where(vertices[:, 2] > 0.0, 2.0, 1.0)
    denser, _ = _changed(flow, lambda: flow.set_density(density))
    # Half of the surface has strands by sqrt(2) closer.
    expected = (1.0 + np.sqrt(2.0)) / 2.0
    assert denser["length"] / closer["length"] == pytest.approx(expected, rel=0.06)

    # A curve that has to become shorter keeps a little: 5 to 8.4 % from six first faces.
    even, _ = _changed(flow, lambda: flow.set_density(None))
    assert even["length"] == pytest.approx(closer["length"], rel=0.1)
    options.length_weight = 0.3
    again, _ = _changed(flow, lambda: flow.set_options(options))
    assert again["spacing_target"] == pytest.approx(0.24)


def test_a_refusal_says_why_and_changes_nothing(grown):
    _vertices, options, flow = grown
    before = flow.polylines().positions
    with pytest.raises(core.MeanderError, match="spacing must be a positive number"):
        flow.set_radius(-1.0)
    with pytest.raises(core.MeanderError, match="one for each of the"):
        flow.set_density(np.ones(3))
    options.length_power = 99.0
    with pytest.raises(core.MeanderError, match="length_power"):
        flow.set_options(options)
    np.testing.assert_array_equal(flow.polylines().positions, before)
    assert flow.statistics()["stop_reason"] == "converged"
    flow.start()
    with pytest.raises(core.MeanderError, match="belongs to its run"):
        flow.set_radius(0.1)
    flow.wait()
