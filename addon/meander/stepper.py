# SPDX-License-Identifier: GPL-3.0-or-later
"""One run of the flow: the same class on the caller's thread and on one of its own. No bpy here.

The native calls release Python's lock, so that a host stays responsive while the worker runs.
Nobody but the worker may touch the flow. Watched, it goes step by step, and copies the curve out
between two steps whenever the host has taken the last copy; unwatched, it is one native run. Both
give the same curve to the last bit.
"""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import core

# The least time between two copies of the curve.
SNAPSHOT_SECONDS = 0.1


@dataclass(frozen=True)
class Snapshot:
    """The curve at one moment, and what a user wants to know of it."""

    polylines: core.Polylines
    iterations: int
    nodes: int
    length: float
    seconds: float
    progress: float  # length over the expected length, in [0, 1]


@dataclass(frozen=True)
class Problem:
    """What to solve: arrays and options, nothing of a host."""

    vertices: np.ndarray
    faces: np.ndarray
    options: core.FlowOptions
    seed: core.Seed | None = None
    density: np.ndarray | None = None

    def expected_length(self) -> float:
        """The length of a curve that fills the surface: area over spacing, face by face."""
        a, b, c = (self.vertices[self.faces[:, corner]] for corner in range(3))
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0
        if self.density is not None:
            areas = areas * np.sqrt(self.density[self.faces]).mean(axis=1)
        return float(areas.sum() / (2.0 * self.options.radius))


class Stepper:
    """Runs one Problem.

    With a thread: start(), then poll() until `finished`, then result(). Without: run(), then
    result(). cancel() may be called at any time from any thread; the curve of the last whole
    iteration stays available.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self._context = core.Context()
        self._abandoned = False
        self._flow: core.Flow | None = None
        self._thread: threading.Thread | None = None
        self._error: BaseException | None = None
        self._stop_reason = "running"
        self._statistics: dict[str, Any] = {}
        self._expected_length = problem.expected_length()
        self._latest: Snapshot | None = None
        # The host has had the last copy, so that there is room for another.
        self._consumed = True

    # -- the host's side ---------------------------------------------------------------------

    def start(self) -> None:
        """Begins the run on a thread of its own."""
        # A daemon, so that a host that dies without join() does not hang in the interpreter's exit.
        self._thread = threading.Thread(target=self._work, name="meander", daemon=True)
        self._thread.start()

    @property
    def finished(self) -> bool:
        """Whether the worker has ended, for whatever reason."""
        return self._thread is not None and not self._thread.is_alive()

    def poll(self) -> Snapshot | None:
        """The newest copy of the curve, once; None while there is none. Never waits.

        The worker makes the next one only when this one has been taken.
        """
        snapshot, self._latest = self._latest, None
        if snapshot is not None:
            self._consumed = True
        return snapshot

    def cancel(self) -> None:
        """Asks the run to end after the present iteration at the latest; does not wait."""
        self._context.cancel()

    def abandon(self) -> None:
        """cancel() by a host that will not ask for the result: nothing more is computed."""
        self._abandoned = True
        self.cancel()

    def join(self) -> None:
        """Waits for the worker. Does nothing without one."""
        if self._thread is not None:
            self._thread.join()

    def result(self) -> tuple[Snapshot, dict[str, Any], str]:
        """Waits for the end: the last curve, the full statistics, and the reason of the stop.

        Raises what the worker raised.
        """
        self.join()
        if self._error is not None:
            raise self._error
        return self._snapshot(), self._statistics, self._stop_reason

    def run(self) -> None:
        """The whole run on the caller's thread; result() then returns at once."""
        self._work(watched=False)

    # -- the worker's side -------------------------------------------------------------------

    def _work(self, watched: bool = True) -> None:
        try:
            problem = self.problem
            surface = core.Surface(problem.vertices, problem.faces)
            if self._abandoned:
                return
            self._flow = core.Flow(surface, problem.options, problem.seed, problem.density)
            if watched:
                self._consumed = False
                self._latest = self._snapshot()
                self._stop_reason = self._run_watched()
            else:
                self._stop_reason = self._flow.run(self._context)
            if not self._abandoned:
                self._statistics = self._flow.statistics()
        except BaseException as error:  # carried to the host: result() raises it there
            self._error = error

    def _run_watched(self) -> str:
        last_copy = time.monotonic()
        while True:
            reason = self._flow.step(self._context)
            if reason != "running":
                return reason
            now = time.monotonic()
            if self._consumed and now - last_copy >= SNAPSHOT_SECONDS:
                last_copy = now
                self._consumed = False
                self._latest = self._snapshot()

    def _snapshot(self) -> Snapshot:
        polylines = self._flow.polylines()
        history = self._flow.history()
        last = history[-1] if len(history) else None
        length = _length(polylines)
        return Snapshot(
            polylines=polylines,
            iterations=len(history),
            nodes=int(last["nodes"]) if last is not None else 0,
            length=length,
            seconds=float(sum(record["seconds"] for record in history)),
            progress=min(1.0, length / self._expected_length),
        )


def _length(polylines: core.Polylines) -> float:
    positions = polylines.positions
    offsets = np.asarray(polylines.offsets, dtype=np.int64)
    pieces = np.linalg.norm(np.diff(positions, axis=0), axis=1)
    # From the last point of a strand to the first of the next is no piece of the curve.
    total = pieces.sum() - pieces[offsets[1:-1] - 1].sum()
    for begin, end, closed in zip(offsets[:-1], offsets[1:], polylines.closed, strict=True):
        if closed:
            total += np.linalg.norm(positions[end - 1] - positions[begin])
    return float(total)
