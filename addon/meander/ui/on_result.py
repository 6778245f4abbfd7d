# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators on a result have in common: when they can run."""

from __future__ import annotations

import bpy

from ..run import session
from ..scene.fillable import is_result, why_not
from ..scene.linked_settings import is_from_file
from ..scene.settings import surface_of

NO_RESULT = "Choose a curve that Meander has made"
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


class OnResult:
    """An operator that works on the active curve, which Meander has made."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        active = context.active_object
        if session.current() is not None:
            cls.poll_message_set("A curve is growing")
        elif active is None or active.type != "CURVE" or active.meander.surface is None:
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
        if is_linked(context.active_object):
            cls.poll_message_set(LINKED)
            return False
        return True
