# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators on a result have in common: when they can run."""

from __future__ import annotations

import bpy

from ..run.lasting import why_busy
from ..scene.fillable import is_result, why_not
from ..scene.linked_settings import is_from_file
from ..scene.results import shown_result
from ..scene.settings import surface_of

NO_RESULT = "Choose a curve that Meander has made, or its mesh"
LINKED = "The curve is linked from another file"


def is_linked(result: bpy.types.Object) -> bool:
    """Whether a curve is from another file, and what is changed in it would not be saved."""
    return is_from_file(result) or is_from_file(result.data)


def can_choose(cls: type[bpy.types.Operator], context: bpy.types.Context) -> bool:
    """Whether the active object has settings that can be chosen; else the message says why not."""
    active = context.active_object
    if surface_of(active) is None:
        cls.poll_message_set(why_not(active))
        return False
    if is_result(active) and is_linked(active):
        cls.poll_message_set(LINKED)
        return False
    return True


def result_of(context: bpy.types.Context) -> bpy.types.Object | None:
    """The curve that a panel and its buttons are about: the active one, or that of the active
    mesh."""
    return shown_result(context.active_object, context.scene)


class OnResult:
    """An operator that works on a curve which Meander has made: result_of()."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        result = result_of(context)
        if (busy := why_busy()) is not None:
            cls.poll_message_set(busy)
        elif result is None or result.meander.surface is None:
            cls.poll_message_set(NO_RESULT)
        elif context.mode != "OBJECT":
            cls.poll_message_set("Works in Object Mode")
        else:
            return True
        return False


class OnOwnResult(OnResult):
    """One that changes the curve, which therefore may not come from another file."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not super().poll(context):
            return False
        if is_linked(result_of(context)):
            cls.poll_message_set(LINKED)
            return False
        return True
