# SPDX-License-Identifier: GPL-3.0-or-later
"""Work of several calls of the library that last, and what is done between them; no bpy.

Whoever does the steps says how: one after the other, or on a thread of the library's, a window
living meanwhile.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import Any, TypeVar

from .. import core

T = TypeVar("T")

# Yields each call that lasts, and is sent what it comes to, or thrown what it raises; or None where
# it has taken a while itself, for a window to live.
Steps = Generator[core.Work[Any] | None, Any, T]


def at_once(steps: Steps[T], context: core.Context | None = None) -> T:
    """What steps come to, each of them done at once.

    context   cancels them, with a core.MeanderError
    """
    try:
        work = next(steps)
        while True:
            try:
                result = None if work is None else work.now(context)
            except BaseException as error:
                work = steps.throw(error)
            else:
                work = steps.send(result)
    except StopIteration as end:
        return end.value


class Background:
    """Steps of which each is done on a thread of the library's.

    done   what they come to, once go_on() has said that there is no other
    """

    def __init__(self, steps: Steps[Any], context: core.Context) -> None:
        """context   shows how far the present one is, and cancels them"""
        self._steps, self._context = steps, context
        self._begun: core.Begun[Any] | None = None
        self.done: Any = None

    def go_on(self, wait: bool = False) -> bool:
        """Begins the next one where none is going. Returns whether there is no other.

        Raises what goes wrong in them; they have ended then.

        wait   for the end of all of them; else it never does
        """
        while wait or self._begun is None or not self._begun.running:
            try:
                work = self._next()
            except StopIteration as end:
                self.done = end.value
                return True
            if work is not None:
                self._begun = work.begin(self._context)
            elif not wait:
                return False
        return False

    def end(self) -> None:
        """Ends them where they are."""
        self._context.cancel()
        begun, self._begun = self._begun, None
        if begun is not None:
            begun.close()
        self._steps.close()

    def _next(self) -> core.Work[Any] | None:
        if self._begun is None:
            return next(self._steps)
        begun, self._begun = self._begun, None
        try:
            result = begun.result()
        except BaseException as error:
            return self._steps.throw(error)
        return self._steps.send(result)
