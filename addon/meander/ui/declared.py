# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender properties and panel rows made from the table of options."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from ..model.options.option import Option
from ..model.options.table import BY_SETTING, in_panel
from ..scene.settings import IN_SPACINGS


def declared(options: Iterable[Option], update: Callable | None = None) -> dict[str, Any]:
    """The annotations of a class of settings.

    update   called with settings and context when the user has changed one
    """
    properties = {}
    for option in options:
        properties[option.setting] = _property(option, update)
        if option.unit == "r":
            properties[option.setting + IN_SPACINGS] = _in_spacings(option)
    return properties


def _in_spacings(option: Option) -> Any:
    """A setting that counts in halves of the spacing, as a panel shows it: in spacings.

    Files, scripts and the library keep the halves; this one holds nothing of its own.
    """

    def get(settings: bpy.types.PropertyGroup) -> float:
        return getattr(settings, option.setting) / 2.0

    def put(settings: bpy.types.PropertyGroup, value: float) -> None:
        setattr(settings, option.setting, 2.0 * value)

    limits = {
        "min": option.least,
        "max": option.greatest,
        "soft_min": option.soft_least,
        "soft_max": option.soft_greatest,
    }
    return FloatProperty(
        name=option.row or option.label,
        description=option.tip,
        precision=option.digits,
        step=option.step,
        options={"SKIP_SAVE"},
        get=get,
        set=put,
        **{name: limit / 2.0 for name, limit in limits.items() if limit is not None},
    )


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


def share_of(option: Option) -> dict[str, Any]:
    """What an operator's own property of a share is declared with."""
    return {
        "name": option.label,
        "description": option.tip,
        "default": option.default,
        "min": option.least,
        "max": option.greatest,
        "precision": option.digits,
        "subtype": "FACTOR",
    }


def switch(
    layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup, setting: str, text: str = ""
) -> None:
    """A check box over the whole width of a panel, which has room for its label."""
    line = layout.row()
    line.use_property_split = False
    if text:
        line.prop(settings, setting, text=text)
    else:
        line.prop(settings, setting)


def row(layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup, setting: str) -> None:
    """One option in a panel."""
    option = BY_SETTING[setting]
    if option.unit == "r":
        layout.prop(settings, setting + IN_SPACINGS)
    elif option.kind is bool:
        switch(layout, settings, setting, option.row)
    elif option.row:
        layout.prop(settings, setting, text=option.row)
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
            if heading:
                layout.column(heading=heading).prop(settings, option.setting, text=option.row)
            else:
                row(layout, settings, option.setting)
            continue
        if option.switch != before:
            column, before = layout.column(align=True), option.switch
            column.active = not option.switch or getattr(settings, option.switch)
        row(column, settings, option.setting)
