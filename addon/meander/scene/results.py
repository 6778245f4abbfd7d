# SPDX-License-Identifier: GPL-3.0-or-later
"""Which curve object is the result that a surface's next run updates."""

from __future__ import annotations

import bpy

from .drawn_line import drawn_of, remove_unused
from .fillable import has_faces, is_result
from .linked_settings import settings_of, settings_to_change
from .made import let_go


def is_present(thing: bpy.types.Object | None) -> bool:
    """Whether an object is in a scene. One that was deleted lives on while something names it."""
    return thing is not None and bool(thing.users_scene)


def is_result_of(thing: bpy.types.Object | None, surface: bpy.types.Object) -> bool:
    """Whether an object is a curve that a run on this surface has made, and not on a copy of it."""
    return thing is not None and thing.type == "CURVE" and thing.meander.surface == surface


def last_result(
    surface: bpy.types.Object | None, scene: bpy.types.Scene
) -> bpy.types.Object | None:
    """The curve that filling a surface again updates; None where that makes a new one.

    None also for what cannot be changed, and for a duplicate of the surface: what it names is the
    result of the original.
    """
    if not has_faces(surface):
        return None
    found = updated_next(surface)
    if not is_result_of(found, surface) or scene not in found.users_scene[:]:
        return None
    return found if found.library is None and found.data.library is None else None


def updated_next(surface: bpy.types.Object) -> bpy.types.Object | None:
    """The curve that a surface names as its last result; where the user has deleted that one, the
    one of those left that a run has updated last.
    """
    found = settings_of(surface).last_result
    if found is None or is_present(found):
        return found
    left = [
        thing
        for scene in surface.users_scene
        for thing in scene.objects
        if is_result_of(thing, surface) and thing.library is None and thing.data.library is None
    ]
    return max(left, key=lambda thing: thing.meander.figures.run_number, default=None)


def shown_result(
    active: bpy.types.Object | None, scene: bpy.types.Scene
) -> bpy.types.Object | None:
    """The curve that a panel is about: what is active itself, or the last result of a surface."""
    return active if is_result(active) else last_result(active, scene)


def next_variation(surface: bpy.types.Object, chosen: int) -> int:
    """Of the curves of the same settings the next that a surface does not have; the chosen one
    where it has none."""
    made = [
        thing.meander.figures.variation
        for scene in surface.users_scene
        for thing in scene.objects
        if is_result_of(thing, surface)
    ]
    return 1 + max(made) if made else chosen


def made_spacing(result: bpy.types.Object) -> float:
    """The spacing that a curve was made with, in world units; the setting is that of its next
    run."""
    return result.meander.figures.spacing or result.meander.spacing


def remember(result: bpy.types.Object, surface: bpy.types.Object) -> None:
    """Makes a curve the one that filling its surface again updates."""
    settings_to_change(surface).last_result = result
    of_others = (
        thing.meander.figures.run_number
        for thing in bpy.data.objects
        if thing != result and is_result_of(thing, surface)
    )
    result.meander.figures.run_number = 1 + max(of_others, default=0)


def forget_deleted(surface: bpy.types.Object) -> None:
    """Lets go of a last result that the user has deleted, which only its surface still names.

    Else it would stay in the file, and keep its name from the next one.
    """
    found = settings_of(surface).last_result
    if found is None or is_present(found):
        return
    settings_to_change(surface).last_result = None
    let_go(found)
    if found.users == 0 and found.library is None:
        drawn = drawn_of(found)
        remove_unused(found)
        if drawn is not None:
            remove_unused(drawn)
