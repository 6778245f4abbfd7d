# SPDX-License-Identifier: GPL-3.0-or-later
"""Data-blocks that are found again whatever they are called meanwhile, and after undo and redo.

References to Blender's data die with undo, names change when somebody renames. What stays is the
session's own number of a data-block, from Blender 4.1 on `ID.session_uid`. Before that it is the
address: undo and redo read what they restore into its old place, and only what had gone meanwhile
comes back elsewhere. After an undo or a redo such a block is found by its last names.
"""

from __future__ import annotations

import bpy

from .blender_versions import session_number

_COLLECTIONS = {
    bpy.types.Object: "objects",
    bpy.types.Scene: "scenes",
    bpy.types.WorkSpace: "workspaces",
}

# How many times something was undone or redone.
_undos = 0


def number_of(block: bpy.types.ID) -> int:
    """What a data-block is known by as long as it exists, whatever its name.

    Before Blender 4.1 an address, which another block may get when this one has gone.
    """
    uid = session_number(block)
    return block.as_pointer() if uid is None else uid


class Key:
    """How to find an object, a scene or a workspace again. Two keys of one block are not equal."""

    def __init__(self, block: bpy.types.ID) -> None:
        self._collection = next(
            name for kind, name in _COLLECTIONS.items() if isinstance(block, kind)
        )
        self._number = number_of(block)
        self._by_address = session_number(block) is None
        # With the library that a linked block comes from; the newest is the last.
        self._names: list[tuple[str, str | None]] = []
        self._note(block)

    def _note(self, block: bpy.types.ID) -> None:
        name = (block.name, block.library.filepath if block.library else None)
        if not self._names or self._names[-1] != name:
            if name in self._names:
                self._names.remove(name)
            self._names.append(name)
        self._undos = _undos

    def find(self) -> bpy.types.ID | None:
        """The block, or None while it does not exist. To be asked again after every tick."""
        blocks = getattr(bpy.data, self._collection)
        block = blocks.get(self._names[-1])
        if block is None or number_of(block) != self._number:
            block = next((other for other in blocks if number_of(other) == self._number), None)
        if block is None and self._by_address and self._undos != _undos:
            found = (blocks.get(name) for name in reversed(self._names))
            block = next((other for other in found if other is not None), None)
            if block is not None:
                self._number = number_of(block)
        if block is not None:
            self._note(block)
        return block


def on_undo() -> None:
    """Undo and redo may give every object another address."""
    global _undos
    _undos += 1
