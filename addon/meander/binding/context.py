# SPDX-License-Identifier: GPL-3.0-or-later
"""What cancels a flow and tells how far it is, from any thread."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from ctypes import byref, c_void_p

from .calls import call
from .choices import PHASES
from .errors import MeanderError
from .handle import Handle
from .interruption import Cancel, is_heard
from .named import refuse_other
from .native_library import native


class Context(Handle):
    """Cancels a flow and reports its progress, from any thread at any time.

    A cancel is sticky: every call that was given this context returns 'cancelled' within one
    iteration, and so do later ones, until `reset`.
    """

    _what = "context"

    def __init__(self) -> None:
        library = native()
        pointer = c_void_p()
        call(library.meander_context_create, byref(pointer))
        super().__init__(pointer.value, library.meander_context_destroy)
        # Counts the calls that use the native context, so that close() cannot pull it away.
        self._lock = threading.Lock()
        self._users = 0
        self._closing = False
        self._cancelled = False  # by somebody, not by an interruption

    @contextmanager
    def _use(self) -> Iterator[int]:
        with self._lock:
            if self._closing:
                raise MeanderError("this context has been closed; make a new one")
            pointer = self._alive()
            self._users += 1
        try:
            yield pointer
        finally:
            with self._lock:
                self._users -= 1
                if self._closing and self._users == 0:
                    super().close()

    @contextmanager
    def _use_in_call(self) -> Iterator[Cancel]:
        """The context for a call that an interruption cancels; it is usable again after that."""
        with self._use() as pointer:
            interrupted = []

            def cancel() -> None:
                interrupted.append(True)
                native().meander_context_cancel(pointer)

            try:
                yield Cancel(pointer, cancel)
            finally:
                with self._lock:
                    if interrupted and not self._cancelled and self._users == 1:
                        native().meander_context_reset(pointer)

    def cancel(self) -> None:
        """Asks the calls that use this context to end within one iteration."""
        with self._use() as pointer:
            self._cancelled = True
            native().meander_context_cancel(pointer)

    def reset(self) -> None:
        """Takes a cancel back, so that the context can be used again."""
        with self._use() as pointer:
            self._cancelled = False
            native().meander_context_reset(pointer)

    @property
    def progress(self) -> float:
        """How far the present run of a flow is, from 0 to 1; never falls during one run."""
        with self._use() as pointer:
            return native().meander_context_progress(pointer)

    @property
    def phase(self) -> str:
        """What the present run is about: one of PHASES."""
        with self._use() as pointer:
            return PHASES[native().meander_context_phase(pointer)]

    def close(self) -> None:
        """Frees the context, at once or as soon as the last call that uses it has ended."""
        with self._lock:
            self._closing = True
            if self._users == 0:
                super().close()


@contextmanager
def pointer_of(context: Context | None) -> Iterator[Cancel | None]:
    """The native context for the time of a call, which an interruption from the keyboard cancels;
    null where there is none and nothing could interrupt."""
    if context is not None:
        refuse_other("context", context, Context, "make one, or leave it out")
        with context._use_in_call() as pointer:
            yield pointer
    elif is_heard():
        with Context() as own, own._use_in_call() as pointer:
            yield pointer
    else:
        yield None
