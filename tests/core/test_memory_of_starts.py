# SPDX-License-Identifier: GPL-3.0-or-later
"""How much memory a full start of many nodes takes while its first curve is laid."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import geometry
import pytest
from conftest import PACKAGE

# The library is loaded and the arrays are there before. With one thread malloc has one arena, and
# two such runs differ by less than a thousandth.
MEASURE = """
import importlib.util, json, math, sys
package, tests, nodes = sys.argv[1:]
place = importlib.util.spec_from_file_location("meander", package + "/__init__.py",
                                               submodule_search_locations=[package])
sys.modules["meander"] = importlib.util.module_from_spec(place)
place.loader.exec_module(sys.modules["meander"])
sys.path.append(tests)
import geometry
from meander import core
def kilobytes(name):
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) for line in file if line.startswith(name))
vertices, faces = geometry.torus(226, 132)
options = core.default_options("even")
options.start = core.Start.FULL
options.iteration_limit = 1
options.threads = 1
with open("/proc/self/clear_refs", "w") as file:
    file.write("5")
before = kilobytes("VmRSS")
surface = core.Surface(vertices, faces)
extent = surface.extent()
options.radius = 1.0
options.radius = math.sqrt(core.estimate_cost(extent, options).nodes / float(nodes))
cost = core.estimate_cost(extent, options)
core.Flow(surface, options).run()
print(json.dumps([1024 * (kilobytes("VmHWM") - before), cost.nodes]))
"""


@pytest.mark.skipif(not Path("/proc/self/clear_refs").exists(), reason="Linux tells of peaks")
def test_a_full_start_takes_at_most_1100_bytes_a_node():
    given = [PACKAGE, Path(geometry.__file__).parent, 560_000]
    done = subprocess.run(
        [sys.executable, "-c", MEASURE, *map(str, given)], capture_output=True, text=True,
        timeout=300, check=True,
    )  # fmt: skip
    taken, nodes = json.loads(done.stdout)
    assert nodes == pytest.approx(560_000, rel=0.01)
    assert taken < 1100 * nodes
