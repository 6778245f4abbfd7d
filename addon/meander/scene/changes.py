# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the shape of an object has changed since somebody looked, without looking at its points.

The dependency graph says which objects it has evaluated anew; those that somebody has asked for are
counted here. Selecting, renaming and the settings of this add-on do not count. A count is a hint:
what goes on from an earlier run compares the points as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import bpy

from .identity import number_of


class _Changes:
    """The counts of one session, and what of it is being undone."""

    def __init__(self) -> None:
        # Of the objects that somebody has asked for.
        self.counts: dict[int, int] = {}
        # Where counting begins; never goes back, so that no count is met twice.
        self.first = 0
        self.counting = True
        # Whether something is being undone, or was since the last evaluation.
        self.undoing = self.undone = False

    def count(self, depsgraph: Any, is_shape: Callable[[Any], bool]) -> None:
        """is_shape   whether an object counts of which all is evaluated anew, its place as well"""
        if depsgraph is None or not self.counts or not self.counting:
            return
        for update in depsgraph.updates:
            if not update.is_updated_geometry or not isinstance(update.id, bpy.types.Object):
                continue
            thing = update.id.original
            number = number_of(thing)
            if number in self.counts and (not update.is_updated_transform or is_shape(thing)):
                self.counts[number] += 1


_changes = _Changes()


def shape_count(object: bpy.types.Object) -> int:
    """A number that is another one after every change of the object's shape."""
    return _changes.counts.setdefault(number_of(object), _changes.first)


@contextmanager
def uncounted() -> Iterator[None]:
    """What the dependency graph evaluates within the block counts as no change."""
    _changes.counting = False
    try:
        yield
    finally:
        _changes.counting = True


def on_update(_scene: bpy.types.Scene, depsgraph: Any = None) -> None:
    # Blender evaluates all of an object when a panel changes any setting of an add-on on it; and of
    # one in Edit Mode when something is undone there, after which its shape is another.
    undo = _changes.undoing or _changes.undone
    _changes.count(depsgraph, lambda thing: undo and thing.mode == "EDIT")
    _changes.undone = False


def on_frame(_scene: bpy.types.Scene, depsgraph: Any = None) -> None:
    _changes.count(depsgraph, lambda _thing: True)


def on_undo_begin() -> None:
    _changes.undoing = True


def on_undo_end() -> None:
    _changes.undoing, _changes.undone = False, True


def on_load() -> None:
    """In another file the same address may be another object's."""
    _changes.first = max(_changes.counts.values(), default=_changes.first) + 1
    _changes.counts.clear()
