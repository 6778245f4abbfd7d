# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface and the curve that filling it again updates have the same settings.

Either can be chosen, in the panel and by a script, so each has all of them; what is changed on one
of the two is passed on to the other. A curve that was made earlier keeps its own.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy

from .fillable import is_result
from .linked_settings import is_from_file, owner_of, settings_of
from .preparation import is_region
from .results import is_present, is_result_of, updated_next
from .settings import copied, is_copied

# What names the part that is filled; a region of Edit Mode is that of its curve alone.
_PART = frozenset({"mask_source", "mask_attribute"})


def partner_of(settings: bpy.types.PropertyGroup) -> bpy.types.PropertyGroup | None:
    """The settings of the curve that filling a surface again updates, or of that curve's surface;
    None for those of any other object, and where these cannot be changed.
    """
    thing = owner_of(settings)
    if thing is None:
        return None
    if is_result(thing):
        surface = settings.surface
        if surface is None or updated_next(surface) != thing:
            return None
        return settings_of(surface)
    result = updated_next(thing)
    if not is_result_of(result, thing) or not is_present(result) or is_from_file(result):
        return None
    return result.meander


def pass_on(settings: bpy.types.PropertyGroup, name: str) -> None:
    """Gives the partner of settings the value of one that has changed; nothing where it has it."""
    partner = partner_of(settings)
    if partner is not None:
        for each in _PART if name in _PART else (name,):
            _give(settings, partner, each)


def share(result: bpy.types.Object, surface: bpy.types.PropertyGroup) -> None:
    """Gives the settings of a surface all that its result has."""
    for name in copied(surface):
        _give(result.meander, surface, name)


def _give(
    source: bpy.types.PropertyGroup, target: bpy.types.PropertyGroup, name: str
) -> None:
    if name in _PART and (is_region(source) or is_region(target)):
        return
    value = getattr(source, name)
    if getattr(target, name) != value:
        setattr(target, name, value)


def watched(annotations: dict[str, Any]) -> None:
    """Has each of the declared properties passed on when it is changed, after what it does now."""
    for name, declared in annotations.items():
        if is_copied(name):
            keywords = declared.keywords
            keywords["update"] = _passing_on(name, keywords.get("update"))


def _passing_on(name: str, update: Callable | None) -> Callable:
    def passing_on(settings: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
        if update is not None:
            update(settings, context)
        pass_on(settings, name)

    return passing_on
