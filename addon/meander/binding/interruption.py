# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls into the library that an interruption from the keyboard ends.

Python hears a signal between two of its own instructions, in the main thread only, and so not while
a call into the library lasts there. Such a call is made on a thread of its own, and the main thread
waits for it where it can hear.
"""

from __future__ import annotations

import _thread
import contextlib
import signal
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

_Result = TypeVar("_Result")

# How long the main thread waits at a time, in seconds: only Windows hears nothing meanwhile.
_PAUSE = 0.05
# A thread that has not begun after this time, in seconds, never will.
_LATE = 1.0


@dataclass(frozen=True)
class Cancel:
    """A native context as an argument of a call: what an interruption cancels."""

    _as_parameter_: int
    now: Callable[[], None]


def is_heard() -> bool:
    """Whether an interruption would be heard by this thread, and by a handler of Python's.

    Blender's own handler is none; it ends the process.
    """
    if threading.current_thread() is not threading.main_thread():
        return False
    return callable(signal.getsignal(signal.SIGINT))


def heard(work: Callable[[], _Result], cancel: Callable[[], None] | None) -> _Result:
    """Does work inside the library, and returns what it returns, or raises what it raises.

    cancel   has the work end soon. None: nothing can; then it goes on by itself after an
             interruption, and must hold all that it uses

    Raises an interruption, or what else a handler of a signal raises, once the work has ended, or
    at once where nothing can end it.
    """
    if not is_heard():
        return work()
    results: list[_Result] = []
    errors: list[BaseException] = []
    begins, lasts = _thread.allocate_lock(), _thread.allocate_lock()
    lasts.acquire()

    def do() -> None:
        if not begins.acquire(blocking=False):
            return  # it has been interrupted before, or came too late
        try:
            results.append(work())
        except BaseException as error:
            errors.append(error)
        finally:
            lasts.release()

    try:
        # Bare threads cost a fifth of what threading's cost, and do not keep the interpreter.
        try:
            _thread.start_new_thread(do, ())
        except RuntimeError:  # the system gives none: better unheard than not done
            return work()
        waited = 0.0
        while not lasts.acquire(timeout=_PAUSE):
            waited += _PAUSE
            # Without memory a thread may end before it has begun, and nobody is told.
            if waited > _LATE and begins.acquire(blocking=False):
                return work()
    except BaseException:
        if not begins.acquire(blocking=False) and cancel is not None:
            while not results and not errors:
                _end(lasts, cancel)
        raise
    if errors:
        raise errors[0]
    if not results:
        raise MemoryError
    return results[0]


def _end(lasts: _thread.LockType, cancel: Callable[[], None]) -> None:
    """Cancels work and waits for its end, at most for a while. What else interrupts that changes
    nothing: what the work uses goes away after it."""
    with contextlib.suppress(BaseException):
        cancel()
        lasts.acquire(timeout=_PAUSE)
