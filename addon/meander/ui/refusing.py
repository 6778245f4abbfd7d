# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators do with what cannot be done: scripts get an error, somebody at a window a note.

What pops up for an error lies under the cursor, over the button that was pressed.
"""

from __future__ import annotations

import functools
from collections.abc import Callable

import bpy

from .. import core
from ..model.files.whole import FileError
from ..run import notes
from ..scene.errors import DataError
from ..scene.identity import Key

Execute = Callable[[bpy.types.Operator, bpy.types.Context], set[str]]


def sentence_of(error: Exception | str) -> str:
    """The error's text as a sentence of its own: Blender shows it without any context."""
    text = str(error)
    return text[:1].upper() + text[1:]


def refusing(execute: Execute) -> Execute:
    """For an operator's execute(), which may raise what cannot be done; it cancels the operator.

    The note on the active object goes when the same operator succeeds.
    """

    @functools.wraps(execute)
    def done(self: bpy.types.Operator, context: bpy.types.Context) -> set[str]:
        active = context.active_object
        key = None if active is None else Key(active)
        try:
            outcome = execute(self, context)
        except (DataError, core.MeanderError, FileError) as error:
            refuse(self, None if key is None else key.find(), sentence_of(error))
            return {"CANCELLED"}
        if key is not None:
            notes.clear(key.find(), self.bl_idname)
        return outcome

    return done


def refuse(operator: bpy.types.Operator, thing: bpy.types.Object | None, sentence: str) -> None:
    """Says why an operator does nothing."""
    at_window = operator.options.is_invoke and not bpy.app.background
    if at_window:
        notes.keep(thing, sentence, operator.bl_idname)
    operator.report({"WARNING" if at_window else "ERROR"}, sentence)
