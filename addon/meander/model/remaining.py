# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a run will still take, from how far it has come; no bpy."""

from __future__ import annotations

# What a run is about, as a user reads it, by core.Context.phase.
PHASE_TEXTS = {
    "none": "Preparing",
    "growth": "Growing",
    "hairpin_removal": "Removing hairpins",
    "polish": "Evening out",
}
# Seconds and share of the work before which a guess would jump about.
_LEAST_SECONDS = 0.5
_LEAST_SHARE = 0.05


class Remaining:
    """The seconds that a run will still take.

    note() whenever there is news. A run that goes on after a pause, or whose work has become more
    meanwhile, is measured from there on.
    """

    def __init__(self, expected: float | None = None) -> None:
        """expected   what the whole run was thought to take, which counts until more is known"""
        self._expected = expected
        self._begin: tuple[float, float] | None = None
        self._latest = (0.0, 0.0)

    def note(self, now: float, progress: float) -> None:
        """now   seconds of any clock that does not go back
        progress   the share of the work that is done, in [0, 1]
        """
        if self._begin is None or progress < self._latest[1]:
            self._begin = (now, progress)
        self._latest = (now, progress)

    def seconds(self) -> float | None:
        """None while too little is known."""
        if self._begin is None:
            return self._expected
        spent = self._latest[0] - self._begin[0]
        done = self._latest[1] - self._begin[1]
        if spent < _LEAST_SECONDS or done < _LEAST_SHARE:
            return None if self._expected is None else max(0.0, self._expected - spent)
        return spent / done * (1.0 - self._latest[1])


def told(phase: str, seconds: float | None) -> str:
    """Such as "Growing, 12 s left"; without the seconds where they are not known.

    Rounded up to two digits, so that the last second is not "0 s".
    """
    text = PHASE_TEXTS[phase]
    return text if seconds is None else f"{text}, {in_words(seconds)} left"


def in_words(seconds: float) -> str:
    """Such as "12 s" and "3 min", never less than "1 s"."""
    for limit, unit, name in ((90.0, 1.0, "s"), (5400.0, 60.0, "min")):
        if seconds < limit:
            return f"{max(1, round(seconds / unit))} {name}"
    return f"{max(1, round(seconds / 3600.0)):,} h"
