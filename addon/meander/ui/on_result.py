# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators on a result have in common: when they can run."""

from __future__ import annotations

import bpy

from ..run.lasting import why_busy
from ..scene.fillable import is_result, why_not
from ..scene.linked_settings import is_from_file
from ..scene.results import shown_result
from ..scene.settings import surface_of
from .reasons import Reasoned, Reasons, not_in_object_mode

NO_RESULT = "Choose a curve that Meander has made, or its mesh"
LINKED = "The curve is linked from another file"


def is_linked(result: bpy.types.Object) -> bool:
    """Whether a curve is from another file, and what is changed in it would not be saved."""
    return is_from_file(result) or is_from_file(result.data)


class OnSettings(Reasoned):
    """An operator on the settings of the active object."""

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        active = context.active_object
        if surface_of(active) is None:
            yield why_not(active)
        if is_result(active) and is_linked(active):
            yield LINKED


def result_of(context: bpy.types.Context) -> bpy.types.Object | None:
    """The curve that a panel and its buttons are about: the active one, or that of the active
    mesh."""
    return shown_result(context.active_object, context.scene)


class OnResult(Reasoned):
    """An operator that works on a curve which Meander has made: result_of()."""

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        result = result_of(context)
        yield why_busy()
        if result is None or result.meander.surface is None:
            yield NO_RESULT
        yield not_in_object_mode(context)


class OnOwnResult(OnResult):
    """One that changes the curve, which therefore may not come from another file."""

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        yield from super().reasons(context)
        if is_linked(result_of(context)):
            yield LINKED
