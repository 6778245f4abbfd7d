# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the items of a job, several at once, beside other processes that do the same."""

from __future__ import annotations

import secrets
import signal
import time
from collections import deque
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

from ..model.files.whole import TEMPORARY_NAMES
from . import engine
from .child import Child
from .folder import Claim, Folder
from .items import Item
from .job_file import JobError, JobFile
from .progress import Progress

# Seconds between two looks at the running items, and at items that others are at.
_PAUSE = 0.02
_PAUSE_FOR_OTHERS = 0.5
# numpy would get memory for a thread on every processor, though it has nothing for them to do.
_ENVIRONMENT = {"OPENBLAS_NUM_THREADS": "1"}
# What asks this process to end.
_ENDING = [
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
]


@dataclass
class _Running:
    item: Item
    key: str
    claim: Claim
    child: Child
    temporary: str  # how the names of its temporary files begin


class Worker:
    """Works through the items of a job, beside the workers of other processes.

    at_once  how many run at the same time
    shared   other processes may be at the same items
    again    items that are done are run again
    """

    def __init__(
        self,
        job: JobFile,
        items: list[Item],
        folder: Folder,
        progress: Progress,
        at_once: int,
        shared: bool,
        again: bool,
    ) -> None:
        self._job, self._folder, self._progress = job, folder, progress
        self._at_once, self._shared, self._again = at_once, shared, again
        self._threads = max(1, engine.processors() // at_once)
        self._waiting = deque(items)
        self._elsewhere: deque[Item] = deque()
        self._running: list[_Running] = []
        self._stopping = False

    def run(self) -> bool:
        """Runs until nothing is left, or until the process is asked to end; then returns False.

        Raises JobError and FileError; nothing runs any more then.
        """
        # What is ignored stays so: nohup wants it, and shells for what runs in their background.
        heard = [number for number in _ENDING if signal.getsignal(number) != signal.SIG_IGN]
        before = {number: signal.signal(number, self._stop) for number in heard}
        try:
            self._begun = self._folder.moment()
            while not self._stopping and (self._waiting or self._running or self._elsewhere):
                self._start_some()
                self._look_at_running()
                self._wait()
            return not self._stopping
        finally:
            for running in self._running:
                running.child.end()
                self._clean_up(running)
            for number, handler in before.items():
                # None: in Blender, whose own handler is not Python's.
                signal.signal(number, signal.SIG_DFL if handler is None else handler)

    def _stop(self, _number: int, _frame: FrameType | None) -> None:
        self._stopping = True

    def _start_some(self) -> None:
        while self._waiting and len(self._running) < self._at_once and not self._stopping:
            self._take(self._waiting.popleft())
            self._look_at_running()  # to find out what is done may take long

    def _take(self, item: Item) -> None:
        """Starts an item, unless it is done, has failed elsewhere meanwhile, or is being run."""
        try:
            key = self._folder.key_of(item)
        except JobError as problem:  # what it is made from has gone meanwhile
            self._progress.failed(item, str(problem), None)
            return
        if self._settled(item, key):
            return
        claim = self._folder.claim(item, self._shared)
        if claim is None:
            self._elsewhere.append(item)
            return
        if self._settled(item, key):  # between the first look and the claim
            claim.release()
            return
        temporary = f"{secrets.token_hex(6)}-"
        try:
            command = engine.command_of(self._job, item, self._threads)
            child = Child(
                command, self._job.path.parent, _growing_log(item),
                _ENVIRONMENT | {TEMPORARY_NAMES: temporary},
                item.timeout, item.memory, claim.handle,
            )  # fmt: skip
        except BaseException:
            claim.release()
            raise
        claim.note(child.number)
        self._running.append(_Running(item, key, claim, child, temporary))

    def _settled(self, item: Item, key: str) -> bool:
        """Whether there is nothing to do for an item; it is counted then."""
        if not self._again and self._folder.is_done(item, key):
            self._progress.was_done(item)
            return True
        failure = self._folder.failure_since(item, key, self._begun)
        if failure:
            self._progress.failed(item, failure, None)
        return bool(failure)

    def _look_at_running(self) -> None:
        for running in list(self._running):
            code = running.child.ended()
            if code is not None:
                self._running.remove(running)
                self._finish(running, code)

    def _finish(self, running: _Running, code: int) -> None:
        item, child = running.item, running.child
        seconds = child.seconds
        sentence = child.verdict(code, item.log)
        missing = self._folder.missing(item)
        if not sentence and missing:
            sentence = f"ended well but has not written {missing[0]}; see {item.log}"
        self._clean_up(running, sentence, seconds)
        if sentence:
            self._progress.failed(item, sentence, seconds)
        else:
            self._progress.done(item, seconds)

    def _clean_up(self, running: _Running, sentence: str | None = None, seconds: float = 0) -> None:
        """Takes away what a killed process leaves, and frees the item.

        sentence   what went wrong, for the record; empty: nothing; None: it was not finished
        """
        item = running.item
        for place in {path.parent for path in item.written}:
            for left in place.glob(f".{running.temporary}*"):
                left.unlink(missing_ok=True)
        with suppress(OSError):
            _growing_log(item).replace(item.log)
        try:
            if sentence is not None:
                self._folder.write(item, running.key, sentence, seconds)
        finally:
            running.claim.release()

    def _wait(self) -> None:
        if self._running:
            time.sleep(_PAUSE)
        elif self._elsewhere and not self._waiting:
            self._progress.waits(len(self._elsewhere))
            time.sleep(_PAUSE_FOR_OTHERS)
            self._waiting, self._elsewhere = self._elsewhere, deque()


def _growing_log(item: Item) -> Path:
    """Where the output of an item goes while it runs."""
    return item.log.with_name(f"{item.log.name}.part")
