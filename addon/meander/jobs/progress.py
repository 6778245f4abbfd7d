# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a job is: lines while it runs, what failed at the end, and all of it as JSON."""

from __future__ import annotations

import json
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..cli.exit_code import while_heard
from ..model.files.whole import whole_file
from .items import Item


@dataclass(frozen=True)
class _Outcome:
    item: Item
    state: str
    sentence: str
    seconds: float | None


class Progress:
    """Counts items and says how far a job is, on stderr.

    total    items in all
    at_once  how many run at the same time, for the time that is left
    quiet    say nothing but what failed
    """

    def __init__(self, total: int, at_once: int, quiet: bool) -> None:
        self._total, self._at_once, self._quiet = total, at_once, quiet
        self._outcomes: list[_Outcome] = []
        self._began = time.monotonic()
        self._said_that_it_waits = False

    def was_done(self, item: Item) -> None:
        """An item that was finished before."""
        self._outcomes.append(_Outcome(item, "done", "", None))

    def done(self, item: Item, seconds: float) -> None:
        """An item that has just been finished."""
        self._outcomes.append(_Outcome(item, "done", "", seconds))
        if not self._quiet:
            said(f"{item.name} done in {seconds:.1f} s ({self._so_far()})")

    def had_failed(self, item: Item, sentence: str) -> None:
        """An item that failed before."""
        self._outcomes.append(_Outcome(item, "failed", sentence, None))

    def failed(self, item: Item, sentence: str, seconds: float | None) -> None:
        """An item that has failed just now, here (`seconds`: how long it took) or elsewhere."""
        self._outcomes.append(_Outcome(item, "failed", sentence, seconds))
        said(f"{item.name} FAILED: {sentence} ({self._so_far()})")

    def waits(self, count: int) -> None:
        """All that is left is being run by other processes."""
        if not self._said_that_it_waits and not self._quiet:
            said(f"waiting for {_items(count)} that other processes are at")
        self._said_that_it_waits = True

    @property
    def failures(self) -> int:
        return sum(outcome.state == "failed" for outcome in self._outcomes)

    @property
    def left(self) -> int:
        return self._total - len(self._outcomes)

    def conclude(self, interrupted: bool) -> None:
        """The last lines: what failed, by name, and the sum."""
        failures = [outcome for outcome in self._outcomes if outcome.state == "failed"]
        for outcome in failures:
            said(f"failed: {outcome.item.name}: {outcome.sentence}")
        done = len(self._outcomes) - len(failures)
        ending = f"{done} of {_items(self._total)} done, {len(failures)} failed, {self.left} left"
        if interrupted:
            ending = f"interrupted: {ending}; the same command goes on from here"
        elif self._quiet and not failures:
            return
        said(f"{ending}, after {_duration(time.monotonic() - self._began)}")

    def summary(self) -> dict[str, Any]:
        """All figures, in types that JSON knows."""
        return {
            "items": self._total,
            "done": len(self._outcomes) - self.failures,
            "failed": self.failures,
            "left": self.left,
            "seconds": round(time.monotonic() - self._began, 3),
            "results": [
                {
                    "name": outcome.item.name,
                    "state": outcome.state,
                    "sentence": outcome.sentence,
                    "seconds": None if outcome.seconds is None else round(outcome.seconds, 3),
                    "output": str(outcome.item.options.output),
                    "report": str(outcome.item.report),
                    "log": str(outcome.item.log),
                }
                for outcome in sorted(self._outcomes, key=lambda outcome: outcome.item.name)
            ],
        }

    def _so_far(self) -> str:
        done = len(self._outcomes) - self.failures
        text = f"{done} of {self._total} done, {self.failures} failed, {self.left} left"
        # Many fail at once, for reasons that say nothing about the time the others take.
        times = [
            outcome.seconds
            for outcome in self._outcomes
            if outcome.seconds is not None and outcome.state == "done"
        ]
        if times and self.left:
            rounds = self.left / min(self._at_once, self.left)
            text += f", about {_duration(rounds * sum(times) / len(times))} to go"
        return text


def said(text: str) -> None:
    """Says a line on stderr, if somebody hears it."""
    while_heard(print, f"meander: {text}", file=sys.stderr, flush=True)


def write_summary(path: Path, summary: dict[str, Any]) -> None:
    """Writes it whole. Raises FileError."""
    text = json.dumps(summary, indent=2, ensure_ascii=False) + "\n"
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _items(count: int) -> str:
    return "1 item" if count == 1 else f"{count} items"


def _duration(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.0f} s"
    if seconds < 6000:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / 3600:.1f} h"
