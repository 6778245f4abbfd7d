# SPDX-License-Identifier: GPL-3.0-or-later
"""What is told of a curve whose run has ended, found on a thread of the library's. No bpy here."""

from __future__ import annotations

import contextlib

from .. import core

# The search for what is told of a curve of this many nodes takes so long that a window is not to
# wait for it.
MANY_NODES = 200_000
# The same on a surface of so many faces, of which all are looked at for gaps.
MANY_FACES = 200_000


def lasts(nodes: int, faces: int) -> bool:
    """Whether a window is not to wait for the search on so many faces."""
    return nodes >= MANY_NODES or faces >= MANY_FACES


class Search:
    """One search at a time; from begin() to findings() or end() the flow belongs to it."""

    def __init__(self) -> None:
        self._flow: core.Flow | None = None
        self._context = core.Context()

    def begin(self, flow: core.Flow, gaps: bool, tolerance: float) -> None:
        """gaps, tolerance   of core.Flow.start_finding"""
        self._context.reset()
        flow.start_finding(gaps, tolerance, self._context)
        self._flow = flow

    @property
    def begun(self) -> bool:
        return self._flow is not None

    @property
    def running(self) -> bool:
        """Whether findings() would wait."""
        return self.begun and self._flow.running

    @property
    def progress(self) -> float | None:
        """How much of it is over; None: there is none."""
        return self._context.progress if self.begun else None

    def findings(self) -> core.Findings:
        """Waits for what it finds; raises what went wrong in it."""
        flow, self._flow = self._flow, None
        return flow.found()

    def end(self) -> None:
        """Ends it without findings. May be called at any time."""
        if self.begun:
            self._context.cancel()
            with contextlib.suppress(core.MeanderError):
                self.findings()
