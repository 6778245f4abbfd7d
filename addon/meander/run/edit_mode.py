# SPDX-License-Identifier: GPL-3.0-or-later
"""Writing results while meshes are in Edit Mode, whose undo knows nothing of objects."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy

from ..scene.identity import Key


@contextmanager
def left(context: bpy.types.Context) -> Iterator[None]:
    """Leaves Edit Mode of meshes for the block, and comes back to it with the same objects.

    What the block makes has an undo step of Object Mode: with one of Edit Mode only, undo and redo
    would lose it. Does nothing in other modes.
    """
    if context.mode != "EDIT_MESH":
        yield
        return
    view_layer = context.view_layer
    active = Key(view_layer.objects.active)
    edited = [Key(thing) for thing in context.objects_in_mode]
    bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        for thing in list(context.selected_objects):
            thing.select_set(False)
        for key in edited:
            key.find().select_set(True)
        view_layer.objects.active = active.find()
        push_undo()
        bpy.ops.object.mode_set(mode="EDIT")


def push_undo(message: str = "Fill with Curve") -> None:
    """An undo step of what an operator has done so far; nothing in background, which has none."""
    if not bpy.app.background:
        bpy.ops.ed.undo_push(message=message)
