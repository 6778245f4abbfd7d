# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls into the library that last, made at once, or begun on a thread of the library's."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from ctypes import byref, c_void_p
from typing import Any, Generic, TypeVar

from .abi import Status
from .calls import call, new_error, raise_error
from .context import Context, pointer_of
from .handle import Handle
from .interruption import heard
from .named import refuse_other
from .native_library import native

T = TypeVar("T")


class Work(Generic[T]):
    """One such call, which has not been made yet. It holds all that the library reads and fills.

    name       of the function that does it at once, behind meander_
    begins     of the one that begins it, behind meander_opening_start_
    arguments  of both, up to the context
    result     what it comes to, once it has been made
    undo       frees what it has made where nobody gets that, and nothing else
    holds      what else must stay until it has been made
    cancelled  whether a context is the last argument of the function that does it at once
    """

    def __init__(
        self,
        name: str,
        begins: str,
        arguments: tuple[Any, ...],
        result: Callable[[], T],
        undo: Callable[[], None] = lambda: None,
        holds: Any = None,
        cancelled: bool = True,
    ) -> None:
        self._name, self._begins, self._arguments = f"meander_{name}", begins, arguments
        self._result, self._undo = result, undo
        self._holds, self._cancelled = holds, cancelled

    def now(self, context: Context | None = None) -> T:
        """Makes the call, which an interruption from the keyboard cancels."""
        function = getattr(native(), self._name)
        if not self._cancelled:
            call(function, *self._arguments)
            return self._result()
        try:
            with pointer_of(context) as cancelling:
                call(function, *self._arguments, cancelling)
        except BaseException:
            self._undo()
            raise
        return self._result()

    def begin(self, context: Context) -> Begun[T]:
        """Begins the call on a thread of the library's, and returns at once.

        context   cancels it, and shows how far it is
        """
        refuse_other("context", context, Context, "make one")
        return Begun(self, context)


class Begun(Handle, Generic[T]):
    """A call that has been begun; see Work.begin."""

    _what = "call"

    def __init__(self, work: Work[T], context: Context) -> None:
        library, pointer = native(), c_void_p()
        call(library.meander_opening_create, byref(pointer))

        def destroy(opening: int) -> None:
            library.meander_opening_destroy(opening)
            del held[:]

        held = [work]  # what the library reads and fills until its thread has ended
        super().__init__(pointer.value, destroy)
        self._work, self._run = work, ExitStack()
        function = getattr(library, f"meander_opening_start_{work._begins}")
        with ExitStack() as run:
            cancel = run.enter_context(context._use_in_call())
            self._cancel = cancel.now
            call(function, pointer, *work._arguments, cancel._as_parameter_)
            self._run = run.pop_all()
        # The interpreter must not go while the library computes.
        self._finalizer.atexit = True

    @property
    def running(self) -> bool:
        """Whether result() would wait. Costs nothing."""
        return bool(native().meander_opening_is_running(self._alive()))

    def result(self) -> T:
        """Waits for its end; once. Raises what the call would have raised."""
        pointer, error = self._alive(), new_error()
        try:
            wait = native().meander_opening_wait
            status = heard(lambda: wait(pointer, byref(error)), self._cancel)
        finally:
            self.close()
        if status != Status.OK:
            raise_error(status, error)
        return self._work._result()

    def close(self) -> None:
        """Ends it, and frees what it has made where nobody has got that."""
        super().close()
        self._run.close()
