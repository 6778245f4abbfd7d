# SPDX-License-Identifier: GPL-3.0-or-later
"""What takes long can be cancelled, and in the main thread interrupted from the keyboard."""

from __future__ import annotations

import _thread
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import geometry
import pytest
from conftest import PACKAGE
from flows import options_of
from meander import core
from meander.binding.interruption import heard
from meander.model.opening import open_flow
from meander.model.problem import Problem

# However slow the machine is; what waits for so long has hung.
_PATIENCE = 60.0


def _sheet() -> Problem:
    mesh = geometry.grid(4)
    options = options_of(radius=0.05)
    return Problem(mesh.vertices, mesh.faces, options, outline=0.05)


def _cancelled() -> core.Context:
    context = core.Context()
    context.cancel()
    return context


def _refused_as_cancelled(work) -> None:
    with pytest.raises(core.MeanderError) as refusal:
        work()
    assert refusal.value.status == core.Status.CANCELLED


def test_what_makes_a_flow_heeds_a_cancelled_context():
    problem = _sheet()
    with _cancelled() as context:
        _refused_as_cancelled(
            lambda: core.Surface(problem.vertices, problem.faces, context=context)
        )
        with core.Surface(problem.vertices, problem.faces) as surface:
            _refused_as_cancelled(lambda: surface.outlines(0.05, 0.1, context))
            _refused_as_cancelled(lambda: core.Flow(surface, problem.options, context=context))
            _refused_as_cancelled(lambda: surface.curvature("mean", 0.1, context))
            _refused_as_cancelled(lambda: surface.directions("smooth", context=context))
            stroke = [[0.1, 0.1, 0.0], [0.9, 0.2, 0.0]]
            _refused_as_cancelled(lambda: surface.extended_directions(stroke, [0, 2], context))
            with core.Flow(surface, problem.options) as flow:
                _refused_as_cancelled(lambda: core.cut_surface(flow, context=context))
                assert len(core.cut_surface(flow).faces) > 0
            # Nothing of it stays: the same surface goes on to work.
            assert len(surface.outlines(0.05, 0.1)[0].closed) == 1
        _refused_as_cancelled(lambda: open_flow(problem, context))


def test_a_field_that_takes_long_ends_when_it_is_cancelled():
    # Directions of curvature of 40,000 vertices take seconds, and so does their density.
    mesh = geometry.grid(200)
    options = options_of(radius=0.05)
    for field in ("density", "directions"):
        computed = []

        def on(surface: core.Surface, context: core.Context | None, name=field, done=computed):
            timer = threading.Timer(0.05, context.cancel)
            timer.start()
            found = surface.directions("curvature_min", 0.2, context)
            done.append(found)
            return found[:, 0] + 2.0 if name == "density" else found

        problem = Problem(mesh.vertices, mesh.faces, options, **{field: on})
        with core.Context() as context:
            _refused_as_cancelled(lambda p=problem, c=context: open_flow(p, c))
        assert not computed


# ------------------------------------------------------------------------------------------------
# Calls in the main thread of a process that is sent SIGINT


# Every call that takes long on this sheet, as a process of its own makes it; each ends by an
# interruption, and gives what comes after it.
CALLS = {
    "run": "flow.run()",
    "run with a context": "flow.run(shared)",
    "step": "long.step()",
    "wait": "flow.start(); flow.wait()",
    "wait with a context": "flow.start(shared); flow.wait()",
    "wait with a closed context": "c = core.Context(); flow.start(c); c.close(); flow.wait()",
    "surface": "core.Surface(large.vertices, large.faces)",
    "flow": "core.Flow(surface, options)",
    "gaps": "long.gaps()",
    "cut": "core.cut_surface(long, 0.003, True)",
    "curvature": "surface.curvature('mean', 0.2)",
    "directions": "surface.directions('curvature_min', 0.2)",
    "smooth directions": "surface.directions('smooth')",
    "strokes": "surface.extended_directions([[0.1, 0.1, 0], [0.9, 0.2, 0]], [0, 2])",
    "closest": "surface.find_closest(np.random.default_rng(1).random((300000, 3)))",
    "faults": "core.find_faults(large.vertices, large.faces, 1e-4)",
}

# What makes several calls, and may hear it between two of them.
SEVERAL = {"opened": "opening.open_flow(problem.Problem(mesh.vertices, mesh.faces, options))"}

# Calls that nothing can cancel: they go on alone, and the flow waits for them.
ALONE = {
    "density": "long.set_density(np.full(len(mesh.vertices), 1.5))",
    "radius": "long.set_radius(0.011)",
    "options": "long.set_options(options)",
    "triangles": "core.triangulated(mesh.vertices, mesh.faces.ravel(), 3 * np.arange(1, 80001))",
    "text": "core.read_polygons(b'v 0 0 0\\n' * 300000 + b'f 1 2 3\\n', core.Text.OBJ_FACES)",
}

PREAMBLE = """
import os, signal, threading, time
import numpy as np
import geometry
from meander import core
from meander.binding import calls, files, runs as flows
from meander.model import opening, problem

armed, ended = [], []
real = calls.heard

def watched(work, cancel):
    def noted():
        if armed:
            threading.Timer(armed.pop(), os.kill, (os.getpid(), signal.SIGINT)).start()
        ended.append(work())
        return ended[-1]
    return real(noted, cancel)

for module in (files, flows, calls):
    module.heard = watched
mesh, large = geometry.grid(200), geometry.grid(450)
options = core.default_options("even")
options.radius = 0.01
options.start = core.Start.FULL
surface = core.Surface(mesh.vertices, mesh.faces)
flow, long, shared = core.Flow(surface, options), core.Flow(surface, options), core.Context()
"""

# Each call is interrupted a moment after it has begun, and leaves all as it was.
EACH = """
ended.clear()
armed.append(0.005)
try:
    {call}
    time.sleep(20.0)  # on a busy machine what interrupts comes late
    said = "no interruption"
except KeyboardInterrupt:
    said = "interrupted"
print({name!r}, said, *ended[-1:], sep="|")
assert len(long.nodes().faces) > 0 and surface.statistics()["faces"] == len(mesh.faces)
"""

AT_THE_END = """
assert (flow.step(shared), long.step()) == ("running", "running")
assert len(long.polylines().positions) > 0
flow.close()
"""


def said_by_calls(calls: dict[str, str]) -> dict[str, list[str]]:
    each = (EACH.format(name=name, call=call) for name, call in calls.items())
    script = "".join((PREAMBLE, *each, AT_THE_END))
    here = Path(__file__).parent
    done = subprocess.run(
        [sys.executable, "-c", script],
        env=os.environ | {"PYTHONPATH": f"{PACKAGE.parent}{os.pathsep}{here}"},
        capture_output=True, text=True, timeout=240,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    rows = [line.split("|") for line in done.stdout.splitlines()]
    return {name: said for name, *said in rows}


def test_an_interruption_from_the_keyboard_cancels_what_lasts():
    said = said_by_calls(CALLS)
    cancelled = ["interrupted", str(int(core.Status.CANCELLED))]
    assert {name: said[name] for name in CALLS if said[name] != cancelled} == {}


def test_what_makes_several_calls_is_interrupted():
    assert said_by_calls(SEVERAL)["opened"][0] == "interrupted"


def test_what_nothing_can_cancel_goes_on_alone_after_an_interruption():
    said = said_by_calls(ALONE)
    assert {name: said[name] for name in ALONE if said[name] [0] != "interrupted"} == {}


def test_the_handler_of_a_program_decides_what_an_interruption_does():
    # One that only notes it lets the call come to its end, as a graceful end of a loop needs.
    script = PREAMBLE + (
        "noted = []\n"
        "signal.signal(signal.SIGINT, lambda *_: noted.append(True))\n"
        "armed.append(0.005)\n"
        "again = core.Surface(mesh.vertices, mesh.faces)\n"
        "for _ in range(200):\n"
        "    if not noted: time.sleep(0.1)\n"
        "print(len(noted), again.vertex_count == len(mesh.vertices))\n"
    )
    here = Path(__file__).parent
    done = subprocess.run(
        [sys.executable, "-c", script],
        env=os.environ | {"PYTHONPATH": f"{PACKAGE.parent}{os.pathsep}{here}"},
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (0, "1 True\n"), done.stderr


def test_another_thread_than_the_main_one_calls_the_library_itself():
    threads = []

    def work() -> None:
        heard(lambda: threads.append(threading.get_ident()), None)

    other = threading.Thread(target=work)
    other.start()
    other.join()
    assert threads == [other.ident]


def test_work_that_is_interrupted_twice_is_still_waited_for():
    begun, ended = threading.Event(), threading.Event()
    cancels = []

    def work() -> None:
        begun.set()
        while len(cancels) < 3:
            time.sleep(0.001)
        ended.set()

    def cancel() -> None:
        cancels.append(True)
        _thread.interrupt_main()

    def interrupt() -> None:
        begun.wait(_PATIENCE)
        _thread.interrupt_main()

    threading.Thread(target=interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        heard(work, cancel)
        time.sleep(_PATIENCE)  # where the last one arrives late
    assert ended.is_set()


def test_work_returns_what_it_returns_and_raises_what_it_raises():
    assert heard(lambda: 3, lambda: None) == 3
    problem = _sheet()
    problem.options.radius = -1.0
    with pytest.raises(core.MeanderError, match="must be positive"):
        open_flow(problem)
