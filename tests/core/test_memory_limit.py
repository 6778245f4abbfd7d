# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the system gives no more memory (ulimit -v), calls return a status, and work afterwards."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the limit is Linux's")

# In a process of its own, since its limit holds for everything in it. Limits count from what the
# process has when a call begins, and are lifted after it.
_PRELUDE = """
import json, resource, signal, sys
# No interruption is heard, so calls are made by this thread: Python says of its own threads that
# they have no memory, and says it on stderr.
signal.signal(signal.SIGINT, signal.SIG_DFL)
sys.path[:0] = json.loads(sys.argv[1])
import geometry
from meander import core

mesh = geometry.icosphere(6)
options = core.default_options("even")
options.radius = 0.03
options.iteration_limit = 2
options.threads = 3


def within(extra, work):
    pages = int(open("/proc/self/statm").read().split()[0])
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + extra, hard))
    try:
        return work(), "ok"
    except core.MeanderError as refusal:
        assert refusal.status == core.Status.OUT_OF_MEMORY, refusal
        return None, str(refusal)
    except MemoryError:  # Python's own
        return None, "python"
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
"""

_CALLS = """
outcomes = {"surface": [], "flow": [], "run": []}
expected = None
for extra in [k << 20 for k in (*range(0, 24, 4), *range(24, 100, 16), 1024)]:
    surface, outcome = within(extra, lambda: core.Surface(mesh.vertices, mesh.faces))
    outcomes["surface"].append(outcome)
    surface = surface or core.Surface(mesh.vertices, mesh.faces)
    flow, outcome = within(extra, lambda: core.Flow(surface, options))
    outcomes["flow"].append(outcome)
    flow = flow or core.Flow(surface, options)
    outcomes["run"].append(within(extra, flow.run)[1])
    flow.run()
    curve = flow.polylines().positions.tobytes()
    expected = expected or curve
    assert curve == expected, extra
    flow.close()
    surface.close()
print(json.dumps(outcomes))
"""

_THREAD = """
options.threads = 1
# By one thread: stacks of threads that have ended would be used again.
surface = core.Surface(mesh.vertices, mesh.faces, threads=1)
flow = core.Flow(surface, options)
outcome = within(2 << 20, flow.start)[1]
assert not flow.running
flow.start()
flow.wait()
print(json.dumps([outcome, len(flow.history())]))
"""


def _in_child(program: str):
    here = Path(__file__).resolve()
    paths = json.dumps([str(here.parents[2] / "addon"), str(here.parent)])
    child = subprocess.run(
        [sys.executable, "-c", _PRELUDE + program, paths],
        check=False,
        capture_output=True,
        text=True,
    )
    assert child.returncode == 0, child.stderr
    assert child.stderr == ""
    return json.loads(child.stdout)


def test_calls_without_memory_return_a_status_and_work_afterwards():
    for name, outcomes in _in_child(_CALLS).items():
        assert outcomes[-1] == "ok", (name, outcomes)
        refused = [outcome for outcome in outcomes if "memory" in outcome]
        # What comes later may do with what the heap still has.
        assert refused or name != "surface", (name, outcomes)


def test_a_thread_that_cannot_begin_is_a_status():
    outcome, iterations = _in_child(_THREAD)
    assert "The system gives no thread" in outcome
    assert iterations == 2
