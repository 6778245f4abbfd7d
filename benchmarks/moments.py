# SPDX-License-Identifier: GPL-3.0-or-later
"""What has passed between two moments: time, work, and what other programs did."""

from __future__ import annotations

import os
import time


class Tally:
    """What has been counted since the start of a run."""

    def __init__(self) -> None:
        self.redraws = self.panel_redraws = self.shown = self.ticks = 0
        self.tick_cpu = 0.0
        self.begin = Moment()
        self.known = self.begin


def busy_seconds() -> float:
    """Of all processors and all programs since the machine started; 0 where that is unknown."""
    try:
        with open("/proc/stat") as file:
            user, nice, system = (int(ticks) for ticks in file.readline().split()[1:4])
    except OSError:
        return 0.0
    return (user + nice + system) / os.sysconf("SC_CLK_TCK")


class Moment:
    def __init__(self) -> None:
        self.clock, self.cpu = time.perf_counter(), time.process_time()
        self.main_cpu = time.thread_time()
        self.busy = busy_seconds()

    def others_since(self, earlier: Moment) -> float:
        """How many processors other programs kept busy: above 0, clock times say little."""
        others = self.busy - earlier.busy - (self.cpu - earlier.cpu)
        return max(0.0, others / (self.clock - earlier.clock))

    def since(self, earlier: Moment) -> tuple[float, float, float]:
        """Seconds of the clock, of all processors, and of this thread."""
        return (
            self.clock - earlier.clock,
            self.cpu - earlier.cpu,
            self.main_cpu - earlier.main_cpu,
        )
