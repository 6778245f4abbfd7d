# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender properties and panel rows made from the table of options."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from ..model.option import Option
from ..model.options import BY_SETTING, in_panel


def declared(options: Iterable[Option], update: Callable | None = None) -> dict[str, Any]:
    """The annotations of a class of settings.

    update   called with settings and context when the user has changed one
    """
    return {option.setting: _property(option, update) for option in options}


def _property(option: Option, update: Callable | None) -> Any:
    given: dict[str, Any] = {
        "name": option.label,
        "description": option.tip,
        "default": option.default,
        "options": set(),
        "update": update,
        "min": option.least,
        "max": option.greatest,
        "soft_min": option.soft_least,
        "soft_max": option.soft_greatest,
    }
    kind: Callable[..., Any] = {bool: BoolProperty, int: IntProperty, float: FloatProperty}.get(
        option.kind, EnumProperty
    )
    if option.kind is float:
        given |= {"precision": option.digits, "step": option.step}
        if option.unit == "length":
            given["unit"] = "LENGTH"
        elif option.unit == "share":
            given["subtype"] = "FACTOR"
    elif option.kind is str:
        # Identifiers in capitals, as Blender's own are, and as .blend files have them.
        numbers = option.numbers or range(len(option.choices))
        given["items"] = tuple(
            (name.upper(), label, tip, number)
            for (name, label, tip), number in zip(option.choices, numbers)
        )
        given["default"] = option.default.upper()
    return kind(**{name: value for name, value in given.items() if value is not None})


def row(layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup, setting: str) -> None:
    """One option in a panel."""
    short = BY_SETTING[setting].row
    if short:
        layout.prop(settings, setting, text=short)
    else:
        layout.prop(settings, setting)


def rows(
    layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup, panel: str, heading: str = ""
) -> None:
    """Every option of a panel: those with a switch below it, and grey while it is off.

    heading   beside the switch
    """
    column, before = layout.column(align=True), ""
    switches = {option.switch for option in in_panel(panel)}
    for option in in_panel(panel):
        if option.setting in switches:
            row(layout.column(heading=heading), settings, option.setting)
            continue
        if option.switch != before:
            column, before = layout.column(align=True), option.switch
            column.active = not option.switch or getattr(settings, option.switch)
        row(column, settings, option.setting)
