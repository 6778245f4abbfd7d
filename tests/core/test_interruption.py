# SPDX-License-Identifier: GPL-3.0-or-later
"""What takes long before the first iteration can be cancelled, and interrupted by keyboard."""

from __future__ import annotations

import _thread
import threading

import geometry
import pytest
from meander import core
from meander.cli.watching import interruptible
from meander.model.problem import Problem, open_flow

# However slow the machine is; what waits for so long has hung.
_PATIENCE = 60.0


def _sheet() -> Problem:
    mesh = geometry.grid(4)
    options = core.default_options("even")
    options.radius = 0.05
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
    options = core.default_options("even")
    options.radius = 0.05
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


def test_an_interruption_cancels_the_work_and_waits_for_its_end():
    begun, ended = threading.Event(), threading.Event()

    def work(context: core.Context) -> None:
        begun.set()
        # Asks the library, as real work does: there is no other way to see a cancel.
        problem = _sheet()
        for _ in range(1000000):
            try:
                core.Surface(problem.vertices, problem.faces, context=context).close()
            except core.MeanderError:
                ended.set()
                raise

    def interrupt() -> None:
        begun.wait(_PATIENCE)
        _thread.interrupt_main()

    threading.Thread(target=interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        interruptible(work)
    assert ended.is_set()


def test_work_returns_what_it_returns_and_raises_what_it_raises():
    opened = interruptible(lambda context: open_flow(_sheet(), context))
    with opened.flow as flow:
        assert flow.statistics()["guides"] == 1
    problem = _sheet()
    problem.options.radius = -1.0
    with pytest.raises(core.MeanderError, match="must be positive"):
        interruptible(lambda context: open_flow(problem, context))
