# SPDX-License-Identifier: GPL-3.0-or-later
"""Flags of the batch command and entries of its report, made from the table of options; no bpy."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterable
from typing import Any

from .. import core
from ..model.options.machines import PANEL
from ..model.options.option import Flag, Option, apply
from ..model.options.table import OF_THE_FLOW, TABLE
from . import values

_RANGE = re.compile(
    r"The option (\w+)(?: \(in units of r\))? is .*; it must be between (\S+) and (\S+)\."
)

FLAGGED: tuple[tuple[Option, Flag], ...] = tuple(
    (option, option.flag) for option in TABLE if option.flag is not None
)


def add_flags(
    parser: argparse._ActionsContainer, group: str = "", options: Iterable[Option] = TABLE
) -> None:
    """Adds the flags that stand under a heading of --help; those without one by default."""
    for option in options:
        flag = option.flag
        if flag is None or flag.group != group:
            continue
        if option.kind is bool:
            parser.add_argument(flag.name, action="store_true", help=flag.help)
            continue
        given: dict[str, Any] = {"help": flag.help, "default": flag.default}
        if option.kind is str:
            given["choices"] = [*(name for name, _label, _tip in option.choices), *flag.besides]
            given["type"] = values.synonym_reader(flag.synonyms)
        else:
            given["type"] = values.reader(option.kind, *_limits(option, flag))
            if flag.share:
                given["type"] = values.share_or(given["type"])
            given["metavar"] = flag.metavar
        parser.add_argument(flag.name, **given)
        hidden = {"help": argparse.SUPPRESS, "default": argparse.SUPPRESS, "dest": flag.destination}
        for name in flag.former:
            parser.add_argument(name, **given | hidden)


def _limits(option: Option, flag: Flag) -> tuple[float | None, float | None, float | None]:
    """The least and the greatest value of a flag, and what it has to be above. What is written into
    a file and seen by no library has those of the setting, where it has none of its own."""
    if option.panel != PANEL:
        return flag.least, flag.greatest, flag.above
    greatest = option.greatest if flag.greatest is None else flag.greatest
    if flag.above is not None:
        return None, greatest, flag.above
    return option.least if flag.least is None else flag.least, greatest, None


def current_name(name: str) -> str:
    """The name of a flag without its dashes, where that is one of an earlier version."""
    return next((flag.name[2:] for _option, flag in FLAGGED if f"--{name}" in flag.former), name)


def chosen(arguments: argparse.Namespace) -> dict[str, Any]:
    """What the flags say, in the units of the settings; None: not given."""
    found: dict[str, Any] = {}
    for option, flag in FLAGGED:
        value = getattr(arguments, flag.destination)
        if value is not None and flag.in_scene_units:
            value = 2 * value / arguments.spacing
        found[option.setting] = value
    return found


def flow_options(arguments: argparse.Namespace) -> core.FlowOptions:
    """The preset's options with what the flags say in their place."""
    options = core.default_options(arguments.quality)
    options.radius = arguments.spacing / 2
    apply(OF_THE_FLOW, chosen(arguments), options)
    for option, flag in FLAGGED:
        value = getattr(arguments, flag.destination)
        if option.field and flag.in_scene_units and value is not None:
            setattr(options, option.field, value)  # to the last bit
    return options


def in_own_words(
    refusal: core.MeanderError, arguments: argparse.Namespace
) -> core.MeanderError:
    """What the library refuses of an option, in the name and the unit of its flag."""
    found = _RANGE.fullmatch(str(refusal))
    if found is None:
        return refusal
    for option, flag in FLAGGED:
        value = getattr(arguments, flag.destination)
        if option.field == found[1] and value is not None:
            unit = arguments.spacing / 2 if flag.in_scene_units else 1.0
            least, most = (unit * float(limit) for limit in found.groups()[1:])
            return core.MeanderError(
                f"{flag.name} {value:g} is out of range; choose from {least:g} to {most:g}",
                refusal.status,
            )
    return refusal


def entries(arguments: argparse.Namespace, options: core.FlowOptions) -> dict[str, Any]:
    """The entries of the report that are named as the flags are."""
    return {
        flag.entry: getattr(options, option.field)
        if option.field
        else getattr(arguments, flag.destination)
        for option, flag in FLAGGED
        if flag.entry
    }
