# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the flow of the batch command to its end, and says how far it is."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from .. import core
from ..model.empty import Empty, percent
from ..model.estimate import PHASE_TEXTS

# A line of progress after each such share of the run, or after this many seconds.
_PROGRESS_SHARE = 0.1
_PROGRESS_SECONDS = 10.0
# The first line comes no later, so that whoever waits knows that something is done.
_FIRST_SECONDS = 1.0
# From this many nodes on it is said what lasts before and after a run.
LARGE = 200_000
# The longest time between two polls of a run, in seconds.
_LONGEST_PAUSE = 0.1


def run(flow: core.Flow, say: Callable[[str], None]) -> str:
    """Runs the flow to its end and returns the stop reason.

    say   prints a line of how far it is

    The library runs it on a thread of its own, so that this one can print and hear an interruption;
    asking the flow itself between steps would cost a medial axis each time.
    """
    started = time.monotonic()
    printed, next_at = 0.0, started + _FIRST_SECONDS
    pause = 0.001
    with core.Context() as context:
        flow.start(context)
        try:
            while flow.running:
                time.sleep(pause)
                pause = min(2 * pause, _LONGEST_PAUSE)  # a short run is not waited for
                progress, now = context.progress, time.monotonic()
                due = progress >= printed + _PROGRESS_SHARE or now >= next_at
                if due and flow.running:
                    about = PHASE_TEXTS[context.phase].lower()
                    say(f"meander: {about}, {progress:.0%} after {now - started:.1f} s")
                    printed, next_at = progress, now + _PROGRESS_SECONDS
        except BaseException:  # an interruption from the keyboard, above all
            context.cancel()
            flow.wait()
            raise
        return flow.wait()


@contextmanager
def told(
    context: core.Context | None,
    what: str | Callable[[], str],
    say: Callable[[str], None],
    large: bool = True,
) -> Iterator[None]:
    """Says how far a call that was given this context is, as `run` does.

    context   None: how far it is nobody knows
    what      is done, in words; or what says so, for a call of several parts
    large     it is known to last; else nothing is said of what takes less than a second
    """
    started = time.monotonic()
    ended = threading.Event()
    words = what if callable(what) else lambda: what

    def tell() -> None:
        printed, before = 0.0, words() if large else ""
        next_at = started + (_PROGRESS_SECONDS if large else _FIRST_SECONDS)
        while not ended.wait(_LONGEST_PAUSE):
            progress, now = 0.0 if context is None else context.progress, time.monotonic()
            begun, about = large or now >= started + _FIRST_SECONDS, words()
            printed = printed if about == before else -_PROGRESS_SHARE
            if now < next_at and not (begun and progress >= printed + _PROGRESS_SHARE):
                continue
            far = "" if context is None else f" {progress:.0%}"
            say(f"meander: {about},{far} after {now - started:.1f} s")
            printed, before, next_at = progress, about, now + _PROGRESS_SECONDS

    if large:
        say(f"meander: {words()}")
    teller = threading.Thread(target=tell, daemon=True)
    teller.start()
    try:
        yield
    finally:
        ended.set()
        teller.join()


def summary(figures: dict[str, Any], empty: Empty) -> str:
    """How a run has ended, in a line."""
    reason = figures["stop_reason"]
    ending = {
        "converged": "converged",
        "iteration_limit": "reached the iteration limit",
        "stalled": "stalled",
        "cancelled": "was cancelled",
    }.get(reason, reason)
    if empty.matters:
        ending = f"{ending}, with {percent(empty.share)} of the surface empty,"
    spacing = f"spacing {figures['spacing_target']:.4g} wanted"
    if figures["spacing_median"] > 0.0:  # else there is no strand beside another
        spacing = (
            f"spacing {figures['spacing_median']:.4g} in the median "
            f"({figures['spacing_target']:.4g} wanted)"
        )
    return (
        f"{ending} after {figures['iterations']} iterations and "
        f"{figures['seconds_total']:.2f} s: {figures['nodes']} nodes, length "
        f"{figures['length']:.6g}, {spacing}"
    )
