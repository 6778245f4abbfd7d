# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the flow of the batch command to its end, and says how far it is."""

from __future__ import annotations

import time
from typing import Any

from .. import core

# A line of progress for every so many iterations, or seconds.
_PROGRESS_ITERATIONS = 10
_PROGRESS_SECONDS = 10.0
# The longest time between two polls of a run, in seconds.
_LONGEST_PAUSE = 0.1


def run(flow: core.Flow, iteration_limit: int, quiet: bool) -> str:
    """Runs the flow to its end and returns the stop reason.

    The library runs it on a thread of its own, so that this one can print and hear an interruption;
    asking the flow itself between steps would cost a medial axis each time.
    """
    started = time.monotonic()
    printed, printed_at = 0.0, started
    interval = _PROGRESS_ITERATIONS / iteration_limit
    pause = 0.001
    with core.Context() as context:
        flow.start(context)
        try:
            while flow.running:
                time.sleep(pause)
                pause = min(2 * pause, _LONGEST_PAUSE)  # a short run is not waited for
                progress, now = context.progress, time.monotonic()
                due = progress >= printed + interval or now >= printed_at + _PROGRESS_SECONDS
                if due and not quiet and flow.running:
                    print(
                        f"meander: {progress:.1%} of at most {iteration_limit} iterations after "
                        f"{now - started:.1f} s",
                        flush=True,
                    )
                    printed, printed_at = progress, now
        except BaseException:  # an interruption from the keyboard, above all
            context.cancel()
            flow.wait()
            raise
        return flow.wait()


def summary(reason: str, figures: dict[str, Any]) -> str:
    ending = {
        "converged": "converged",
        "iteration_limit": "reached the iteration limit",
        "stalled": "stalled",
        "cancelled": "was cancelled",
    }.get(reason, reason)
    return (
        f"meander: {ending} after {figures['iterations']} iterations and "
        f"{figures['seconds_total']:.2f} s: {figures['nodes']} nodes, length "
        f"{figures['length']:.6g}, spacing {figures['spacing_median']:.4g} in the median "
        f"({figures['spacing_target']:.4g} wanted)"
    )
