# SPDX-License-Identifier: GPL-3.0-or-later
"""How much memory a full start of many nodes takes while its first curve is laid."""

from __future__ import annotations

import peaks
import pytest

# With one thread malloc has one arena, and two such runs differ by less than a thousandth.
PREPARE = """
vertices, faces = geometry.torus(226, 132)
options = core.default_options("even")
options.start = core.Start.FULL
options.iteration_limit = 1
options.threads = 1
"""
LAY = """
surface = core.Surface(vertices, faces)
extent = surface.extent()
options.radius = 1.0
options.radius = math.sqrt(core.estimate_cost(extent, options).nodes / float(given[0]))
told = core.estimate_cost(extent, options).nodes
core.Flow(surface, options).run()
"""


@peaks.linux_tells
def test_a_full_start_takes_at_most_1100_bytes_a_node():
    taken, nodes = peaks.peak_of(PREPARE, LAY, 560_000)
    assert nodes == pytest.approx(560_000, rel=0.01)
    assert taken < 1100 * nodes
