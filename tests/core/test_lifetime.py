# SPDX-License-Identifier: GPL-3.0-or-later
"""Handles, threads and cancelling."""

from __future__ import annotations

import gc
import subprocess
import sys
import threading
import time
import weakref
from pathlib import Path

import geometry
import numpy as np
import pytest
from conftest import PACKAGE
from flows import flow_on, options_of
from meander import core
from meander.binding import calls, native_library
from meander.binding import runs as flow_module
from sentences import assert_sentence

# A machine under load may let a thread wait this long before a test calls it stuck.
PATIENCE = 30.0


def new_flow(cells: int = 8, radius: float = 0.03) -> core.Flow:
    return flow_on(geometry.grid(cells), radius=radius)


def wait_for(condition) -> None:
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.001)


def test_cancelled_before_a_step_changes_nothing() -> None:
    with new_flow() as flow, core.Context() as context:
        for _ in range(3):
            assert flow.step(context) == "running"
        before = flow.polylines()
        context.cancel()
        context.cancel()  # idempotent
        assert flow.step(context) == "cancelled"
        assert flow.run(context) == "cancelled"  # sticky
        after = flow.polylines()
        assert len(flow.history()) == 3
        for ours, theirs in zip(before, after, strict=True):
            assert ours.tobytes() == theirs.tobytes()
        context.reset()
        assert flow.step(context) == "running"
        assert len(flow.history()) == 4


def test_everything_can_be_asked_before_the_first_step() -> None:
    with new_flow() as flow:
        assert np.all(flow.nodes().radii == 0)
        figures = flow.statistics()
        assert figures["stop_reason"] == "running"
        assert figures["iterations"] == figures["mean_step"] == 0
        assert figures["crossings"] == 0 and figures["length"] > 0
        assert flow.history() == []
        assert len(flow.polylines().positions) >= 3
        # Of the statistics' medial axis. Towards a boundary it may be 0, but not on both sides.
        assert np.all(flow.nodes().radii > 0)


def test_steps_and_a_run_give_the_same_curve() -> None:
    with new_flow(radius=0.06) as stepped, new_flow(radius=0.06) as run:
        reason = run.run()
        for _ in range(run.statistics()["iterations"]):
            assert stepped.statistics()["stop_reason"] == "running"
            stepped.step()
        assert stepped.statistics()["stop_reason"] == reason == "converged"
        for ours, theirs in zip(stepped.polylines(), run.polylines(), strict=True):
            assert ours.tobytes() == theirs.tobytes()


def test_flow_belongs_to_one_thread_at_a_time() -> None:
    context = core.Context()
    with new_flow(16, 0.01) as flow:
        worker = threading.Thread(target=flow.run, args=(context,))
        worker.start()
        wait_for(lambda: context.progress > 0)
        for call in (flow.step, flow.polylines, flow.statistics, flow.close):
            with pytest.raises(core.MeanderError, match="another thread"):
                call()
        context.cancel()
        worker.join(PATIENCE)
        assert len(flow.polylines().positions) > 3


def test_context_closed_during_a_run_is_freed_after_it() -> None:
    context = core.Context()
    with new_flow(16, 0.01) as flow:
        worker = threading.Thread(target=flow.run, args=(context,))
        worker.start()
        wait_for(lambda: context.progress > 0)
        context.cancel()
        context.close()
        worker.join(PATIENCE)
        assert not worker.is_alive()
    with pytest.raises(core.MeanderError, match="closed"):
        context.cancel()


def test_closed_handles_say_so() -> None:
    surface = core.Surface(*geometry.grid(2))
    surface.close()
    surface.close()
    with pytest.raises(core.MeanderError, match="closed"):
        surface.statistics()
    flow = new_flow()
    flow.close()
    flow.close()
    with pytest.raises(core.MeanderError, match="closed"):
        flow.step()


def test_forgotten_handles_are_freed() -> None:
    surface = core.Surface(*geometry.grid(2))
    finalizer = surface._finalizer
    del surface
    gc.collect()
    assert not finalizer.alive


def test_arrays_of_the_caller_are_not_kept() -> None:
    mesh = geometry.grid(8)
    vertices, faces = mesh.vertices.copy(), mesh.faces.copy()
    options = options_of(radius=0.05)
    with core.Surface(vertices, faces) as surface:
        vertices.fill(np.nan)
        faces.fill(0)
        with core.Flow(surface, options) as flow:
            flow.step()
            assert np.isfinite(flow.polylines().positions).all()


def test_results_last_as_long_as_any_of_their_arrays(monkeypatch) -> None:
    destroyed: list[int] = []

    library = native_library.native()

    class Watched:
        """The library, which tells what it frees."""

        def __getattr__(self, name: str) -> object:
            return getattr(library, name)

        def meander_result_destroy(self, result: int) -> None:
            destroyed.append(result)
            library.meander_result_destroy(result)

    flow = new_flow(radius=0.1)
    flow.step()
    monkeypatch.setattr(calls, "native", Watched)
    gaps = flow.gaps()
    flow.close()
    assert len(gaps) >= 1
    kept = gaps.positions[:1].T
    before = kept.copy()
    del gaps
    gc.collect()
    assert destroyed == [], "a part of an array holds all of the result"
    assert kept.tobytes() == before.tobytes()
    del kept
    gc.collect()
    assert len(destroyed) == 1


# ------------------------------------------------------------------------------------------------
# Runs on a thread of the library's


def watch(flow: core.Flow, copies: int) -> list[core.Preview]:
    """So many previews of a started run; fewer when it ends before."""
    previews: list[core.Preview] = []

    def enough() -> bool:
        preview = flow.preview()
        if preview is not None:
            previews.append(preview)
        return len(previews) >= copies or not flow.running

    wait_for(enough)
    return previews


def test_previews_are_whole_curves_that_grow() -> None:
    mesh = geometry.grid(16)
    with new_flow(16, 0.01) as flow:
        seed = flow.polylines()
        flow.start()
        previews = watch(flow, 12)
        assert flow.running, "the run was over before it could be watched"
        flow.close()
    assert len(previews) == 12
    for name in ("positions", "offsets", "closed"):
        ours, theirs = (getattr(curve, name) for curve in (previews[0].polylines, seed))
        assert ours.tobytes() == theirs.tobytes()
    assert previews[0].iterations == 0
    assert np.all(np.diff([preview.iterations for preview in previews]) > 0)
    assert np.all(np.diff([preview.seconds for preview in previews]) > 0)
    for preview in previews:
        curve = preview.polylines
        assert np.isfinite(curve.positions).all()
        assert curve.normals.shape == (0, 3)
        assert geometry.off_surface(mesh, curve.positions).max() <= 1e-9
        assert curve.offsets.tolist() == [0, len(curve.positions)]
        assert curve.closed.tolist() == [1]
        assert 3 <= preview.nodes <= len(curve.positions)
        length = geometry.curve_length(curve.positions, curve.offsets, curve.closed)
        assert preview.length == pytest.approx(length, rel=1e-6)


def test_cancel_ends_a_started_run_within_one_step() -> None:
    context = core.Context()
    with new_flow(16, 0.01) as flow:
        flow.start(context)
        wait_for(lambda: context.progress > 0)
        context.cancel()
        cancelled_at = time.monotonic()
        assert flow.wait() == "cancelled"
        waited = time.monotonic() - cancelled_at
        assert flow.statistics()["stop_reason"] == "cancelled"
        assert flow.statistics()["crossings"] == 0
        history = flow.history()
        # Within one step: no longer than the slowest so far, with room for a busy machine.
        assert waited <= 5 * max(record["seconds"] for record in history) + 1.0
        context.reset()
        flow.start(context)
        wait_for(lambda: context.progress > 0)
        context.close()  # the run keeps what it needs of it
        assert flow.running
        assert watch(flow, 3)[-1].iterations > len(history)


def test_a_started_flow_refuses_everything_else() -> None:
    with flow_on(geometry.grid(8), radius=0.03, iteration_limit=3) as flow:
        for call in (flow.wait, flow.preview):
            with pytest.raises(core.MeanderError, match="started") as refusal:
                call()
            assert_sentence(str(refusal.value))
        assert not flow.running
        flow.start()
        # While it runs, and after it has ended by itself: a matter of the calls, not of luck.
        for _ in range(2):
            for call in (
                flow.start,
                flow.step,
                flow.run,
                flow.polylines,
                flow.nodes,
                flow.statistics,
                flow.history,
                flow.gaps,
            ):
                with pytest.raises(core.MeanderError, match="belongs to its run") as refusal:
                    call()
                assert refusal.value.status == core.Status.INVALID_ARGUMENT
                assert_sentence(str(refusal.value))
            wait_for(lambda: not flow.running)
        assert flow.wait() == "iteration_limit"
        with pytest.raises(core.MeanderError, match="started"):
            flow.wait()
        assert flow.statistics()["iterations"] == 3


def test_a_running_flow_can_be_closed_and_forgotten() -> None:
    flow = new_flow(16, 0.01)
    flow.start(core.Context())  # which is forgotten at once
    watch(flow, 3)
    flow.close()
    with pytest.raises(core.MeanderError, match="closed"):
        assert flow.running
    flow = new_flow(16, 0.01)
    finalizer = flow._finalizer
    flow.start()
    del flow
    gc.collect()
    assert not finalizer.alive


def test_a_flow_is_not_closed_under_a_thread_that_asks_whether_it_runs(monkeypatch) -> None:
    library = native_library.native()
    asking, calls = threading.Event(), []

    class Slow:
        """The library, where the question takes longer than closing the flow."""

        def __getattr__(self, name: str) -> object:
            return getattr(library, name)

        def meander_flow_is_running(self, pointer: int) -> int:
            asking.set()
            time.sleep(0.3)
            calls.append("asked")
            return library.meander_flow_is_running(pointer) if len(calls) == 1 else 0

    flow = new_flow(16, 0.01)
    pointer = flow._pointer
    flow._finalizer.detach()
    flow._finalizer = weakref.finalize(
        flow, lambda: (calls.append("destroyed"), library.meander_flow_destroy(pointer))
    )
    flow.start()
    monkeypatch.setattr(flow_module, "native", Slow)
    answers: list[bool] = []
    looker = threading.Thread(target=lambda: answers.append(flow.running))
    looker.start()
    assert asking.wait(PATIENCE)
    flow.close()
    looker.join()
    assert calls == ["asked", "destroyed"]
    assert answers == [True]
    with pytest.raises(core.MeanderError, match="closed"):
        assert flow.running


def test_the_interpreter_may_exit_under_a_run() -> None:
    script = f"""
import sys
sys.path[:0] = [{str(PACKAGE.parent)!r}, {str(Path(geometry.__file__).parent)!r}]
import geometry
from meander import core
options = core.default_options()
options.radius = 0.01
flow = core.Flow(core.Surface(*geometry.grid(16)), options)
flow.start(core.Context())
while flow.preview() is not None:
    pass
print(flow.running)
"""
    ended = subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "True\n", "")


def test_spacing_is_that_of_the_medial_radii() -> None:
    """Also of a wide loop that sees nothing, whose radii the flow changes to set it in motion."""
    with flow_on(geometry.cube(), radius=0.02) as flow:
        figures = flow.statistics()
        radii = flow.nodes().radii
        assert figures["spacing_p95"] <= 2 * radii.max() * (1 + 1e-12)
        assert figures["spacing_p95"] <= 2 * 3 * 0.02 / 0.968 * (1 + 1e-9)
