# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the shape of an object has changed since somebody looked, without looking at its points.

The dependency graph says which objects it has evaluated anew; those that somebody has asked for are
counted here. Selecting, renaming and the settings of this add-on do not count.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
from bpy.app.handlers import persistent

from .identity import number_of

# Of the objects that somebody has asked for.
_counts: dict[int, int] = {}
# Where counting begins; never goes back, so that no count is met twice.
_first = 0
_counting = True


def shape_count(object: bpy.types.Object) -> int:
    """A number that is another one after every change of the object's shape."""
    return _counts.setdefault(number_of(object), _first)


@contextmanager
def uncounted() -> Iterator[None]:
    """What the dependency graph evaluates within the block counts as no change."""
    global _counting
    _counting = False
    try:
        yield
    finally:
        _counting = True


@persistent
def _on_update(_scene: bpy.types.Scene, depsgraph: Any = None) -> None:
    if depsgraph is None or not _counts or not _counting:
        return
    for update in depsgraph.updates:
        if update.is_updated_geometry and isinstance(update.id, bpy.types.Object):
            number = number_of(update.id.original)
            if number in _counts:
                _counts[number] += 1


@persistent
def _on_load(*_arguments: object) -> None:
    """In another file the same address may be another object's."""
    global _first
    _first = max(_counts.values(), default=_first) + 1
    _counts.clear()


_HANDLERS = (
    ("depsgraph_update_post", _on_update),
    ("frame_change_post", _on_update),
    ("load_post", _on_load),
)


def register() -> None:
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).remove(handler)
    _counts.clear()
