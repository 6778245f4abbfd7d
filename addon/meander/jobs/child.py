# SPDX-License-Identifier: GPL-3.0-or-later
"""The process of one item: started, kept within its limits, ended with all that it has started."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from .job_file import JobError

_ON_WINDOWS = os.name == "nt"
_MEGABYTE = 1_000_000
# The log is read as UTF-8, whatever the console of this system is in.
_IN_UTF_8 = {"PYTHONUTF8": "1", "PYTHONIOENCODING": "utf-8:backslashreplace"}
# What the library says, and what Python does, of memory that they were not given.
_NO_MEMORY = re.compile(r"meander: There is not enough memory|MemoryError")
_SIGNALS = {int(number): number.name for number in signal.Signals}


class Child:
    """A running command. Its output, errors too, goes into a log that grows while it runs.

    command   the program and its arguments
    folder    in which it runs
    log       where its output goes
    environment   added to that of this process
    timeout   seconds after which it is ended; None: never
    memory    megabytes that it may ask the system for, on Linux; None: any
    kept_open a file descriptor that the process inherits; None: none

    Raises JobError when the command cannot be started.
    """

    def __init__(
        self,
        command: Sequence[str],
        folder: Path,
        log: Path,
        environment: Mapping[str, str],
        timeout: float | None,
        memory: float | None,
        kept_open: int | None,
    ) -> None:
        self.started = time.monotonic()
        self._log, self._timeout, self._memory = log, timeout, memory
        self._timed_out = False
        options: dict[str, object] = {}
        if _ON_WINDOWS:
            options["creationflags"] = subprocess.CREATE_NEW_PROCESS_GROUP
        else:
            options["start_new_session"] = True  # a group that can be ended at once
            options["pass_fds"] = () if kept_open is None else (kept_open,)
            options["preexec_fn"] = _limit(memory)
        try:
            with log.open("wb") as output:
                self._process = subprocess.Popen(
                    command,
                    cwd=folder,
                    stdin=subprocess.DEVNULL,
                    stdout=output,
                    stderr=subprocess.STDOUT,
                    env={**os.environ, **_IN_UTF_8, **environment},
                    **options,
                )
        except OSError as problem:
            raise JobError(f"{command[0]!r} cannot be started ({problem.strerror})") from problem

    @property
    def number(self) -> int:
        """Of the process, and of its group."""
        return self._process.pid

    @property
    def seconds(self) -> float:
        """Since it was started."""
        return time.monotonic() - self.started

    def ended(self) -> int | None:
        """The exit code, negative for a signal, or None while it runs; ends what takes too long."""
        code = self._process.poll()
        if code is None and self._timeout is not None and self.seconds >= self._timeout:
            self._timed_out = True
            code = self.end()
        if code:
            end_group(self._process.pid)  # what it may have left behind
        return code

    def verdict(self, code: int, log: Path) -> str:
        """What went wrong, as a sentence; empty when the command ended well.

        code   as ended() returns it
        log    where to look for more
        """
        if self._timed_out:
            return (
                f"was ended at its time limit of {self._timeout:g} s; raise timeout, or the spacing"
            )
        if code < 0 or code > 128:  # the second is what shells make of a signal
            name = _SIGNALS.get(-code if code < 0 else code - 128, f"exit code {code}")
            memory = "" if self._memory is None else f" with no more than {self._memory:g} MB"
            return f"crashed or was ended from outside ({name}{memory}); see {log}"
        if code == 0:
            return ""
        lines = _last_lines(self._log)
        said = [line for line in lines if line.startswith("meander: ")]
        if self._memory is not None and lines and _NO_MEMORY.match(lines[-1]):
            return f"needs more than {self._memory:g} MB; raise memory, or the spacing"
        if code in (2, 3) and said:  # bad input, and gaps where --fail-on-gaps asks for none
            return said[-1].removeprefix("meander: ")
        return f"ended with exit code {code}; see {log}"

    def end(self) -> int:
        """Ends it with all that it has started, and waits for it."""
        end_group(self._process.pid)
        return self._process.wait()


def end_group(number: int) -> None:
    """Ends all processes of a group that is ours; none is left is no error."""
    if _ON_WINDOWS:
        subprocess.run(["taskkill", "/T", "/F", "/PID", str(number)], capture_output=True)
        return
    try:
        os.killpg(number, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        return  # nothing is left, or (on macOS) only what has ended and was not waited for


def _limit(memory: float | None) -> Callable[[], None] | None:
    """What a new process does to itself before it becomes the command."""
    if memory is None:
        return None
    import resource

    # What is allocated, in contrast to files that are mapped: Blender maps hundreds of megabytes.
    most = int(memory * _MEGABYTE)

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_DATA, (most, most))

    return limit


def _last_lines(log: Path) -> list[str]:
    return log.read_bytes()[-65536:].decode("utf-8", "replace").splitlines()
