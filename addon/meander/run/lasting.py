# SPDX-License-Identifier: GPL-3.0-or-later
"""What lasts between two events: activities that go on, and what is remembered of objects.

Each is made once, in the module that begins it, and says there whether anything may begin beside
it, what undo does to it and how it ends. Another file and the end of the add-on end all of them.
Nothing else of the rooms `run` and `ui` lasts, so whoever asks what goes on asks here: polls ask
why_busy(), and ui.events passes on every event.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from typing import Generic, TypeVar

T = TypeVar("T")
K = TypeVar("K")

# In the order in which they were made. What builds on others is made, and imported, after them.
_all: list[Activity | Memory] = []


class Activity(Generic[T]):
    """One kind of what goes on, and the one of it that there is.

    current   None: it does not go on
    """

    def __init__(
        self,
        end: Callable[[T], None] | None = None,
        *,
        busy: str | None = None,
        undone: bool = False,
        gone: Callable[[T], bool] | None = None,
        leave: Callable[[T], None] | None = None,
    ) -> None:
        """end     gives back what was borrowed, when it is current no longer; None: nothing was
        busy    why nothing else that owns the status bar and the Esc key may begin meanwhile, in
                a few words; None: anything may
        undone  whether undo and redo end it
        gone    whether what it is about has been deleted, which ends it; None: it looks itself
        leave   ends it where the file goes, and all in it that was borrowed; None: as `end` does
        """
        self.current: T | None = None
        self.busy, self.undone = busy, undone
        self._end, self._gone, self._leave = end, gone, leave
        _all.append(self)

    @property
    def lasts(self) -> bool:
        return self.current is not None

    def begin(self, what: T) -> None:
        """Makes it the one that goes on; the one before it ends first."""
        self.end()
        self.current = what

    def taken(self) -> T | None:
        """What went on, and is the caller's from here on; None: nothing did."""
        taken, self.current = self.current, None
        return taken

    def end(self) -> None:
        """Ends what goes on. May be called at any time, and again."""
        self._ended(self._end)

    def leave(self) -> None:
        """Ends it as the file goes."""
        self._ended(self._leave or self._end)

    def _ended(self, end: Callable[[T], None] | None) -> None:
        ended = self.taken()
        if ended is not None and end is not None:
            end(ended)

    def end_if_gone(self) -> None:
        if self.current is not None and self._gone is not None and self._gone(self.current):
            self.end()


class Memory(dict[K, T]):
    """What is remembered of objects, or windows, for as long as the file is open."""

    def __init__(
        self, *, undone: bool = False, gone: Callable[[K], bool] | None = None
    ) -> None:
        """undone   whether undo and redo make it worthless
        gone     whether what a key stands for has been deleted; None: it harms nobody that it stays
        """
        super().__init__()
        self.busy, self.undone = None, undone
        self._gone = gone
        _all.append(self)

    @property
    def lasts(self) -> bool:
        return len(self) > 0

    end = leave = dict.clear

    def end_if_gone(self) -> None:
        if self._gone is not None:
            for key in [key for key in self if self._gone(key)]:
                del self[key]


def why_busy() -> str | None:
    """Why nothing that owns status bar and Esc key can begin, in a few words; None: it can."""
    return next((one.busy for one in _all if one.busy and one.lasts), None)


def _each(end: Callable[[Activity | Memory], None]) -> None:
    """What was made last ends first, and a defect in one keeps no other from ending."""
    with ExitStack() as stack:
        for one in _all:
            stack.callback(end, one)


def end_all() -> None:
    """The add-on goes, and all that lasts with it."""
    _each(lambda one: one.end())


def leave_file() -> None:
    """Another file is opened."""
    _each(lambda one: one.leave())


def end_undone() -> None:
    """Something was undone or redone."""
    _each(lambda one: one.end() if one.undone else None)


def end_gone(*_event: object) -> None:
    """Objects may have been deleted; also as a handler, which is told the scene."""
    _each(lambda one: one.end_if_gone())
