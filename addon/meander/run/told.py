# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run says of itself while it goes. No bpy here."""

from __future__ import annotations

from ..model.estimate import Remaining, in_words, told
from .outcome import Snapshot
from .stepper import Stepper


class Told:
    """How far a session's run is, in figures and in words."""

    stepper: Stepper
    latest: Snapshot | None
    place: str
    _remaining: Remaining

    def progress(self) -> float:
        """How much of the run is done, in [0, 1]: about the share of its time."""
        return self.latest.progress if self.latest is not None else 0.0

    def bar(self) -> float:
        """How much is done of what goes on, in [0, 1]: of the run, of what is done before it, or
        after it."""
        share = self.stepper.share
        return self.progress() if share is None else share

    def progress_text(self) -> str:
        """What the run is about and how long it will still take, in words."""
        share, seconds = self.stepper.share, self._remaining.seconds()
        if share is None:
            return self._placed(told(self._phase(), seconds))
        return f"{self.phase_text()}, {share:.0%}"

    def phase_text(self) -> str:
        """What the run is about, such as "Growing"."""
        return self._placed(told(self._phase(), None))

    def _placed(self, text: str) -> str:
        return f"{self.place}: {text}" if self.place else text

    def left_text(self) -> str:
        """How long it will still take, such as "12 s"; empty while that is not known."""
        seconds = None if self.stepper.preparing else self._remaining.seconds()
        return in_words(seconds) if seconds is not None else ""

    def _phase(self) -> str:
        if self.stepper.preparing:
            return self.stepper.preparing
        latest = self.latest.phase if self.latest is not None else "none"
        return "search" if self.stepper.search.begun else latest
