# SPDX-License-Identifier: GPL-3.0-or-later
"""What an option is, and how what a user has chosen reaches the flow; no bpy.

`table` has the rows. The setting on an object, the flag of the batch command, the entry in its
report, the row in a panel and the line in the documents are all made from it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from ... import core

# By the name of the setting: None is the preset's own value, and so is what is not there.
Values = Mapping[str, Any]

# The choice that means the preset's own value, where a row offers it.
OF_PRESET = "preset"

# The fields whose choices the library knows by number.
_NUMBERED = {"medial_axis": core.MedialAxis, "start": core.Start}


@dataclass(frozen=True)
class Flag:
    """The flag of an option of the batch command.

    name      such as "--length"
    help      one line for --help
    group     its heading in --help; empty: it is among the general options
    metavar   the placeholder of the value in --help
    least, greatest, above   limits of a number; None: the library checks it
    in_scene_units           the flag is a length in scene units, while the setting is in r
    entry     its name in the report, where that is neither a field of core.FlowOptions nor made
              elsewhere; empty: none
    default   the value when it is not given; None: the preset's own
    synonyms  other words for choices, each with the choice that it stands for
    share     per cent of the whole are understood as well, as a model.preparation.Share
    besides   words beside the choices, each of which stands for several flags; see presets.py
    former    names of earlier versions, which are read and not shown
    """

    name: str
    help: str = ""
    group: str = ""
    metavar: str = ""
    least: float | None = None
    greatest: float | None = None
    above: float | None = None
    in_scene_units: bool = False
    entry: str = ""
    default: Any = None
    synonyms: tuple[tuple[str, str], ...] = ()
    share: bool = False
    besides: tuple[str, ...] = ()
    former: tuple[str, ...] = ()

    @property
    def destination(self) -> str:
        """The attribute of the parsed arguments."""
        return self.name.lstrip("-").replace("-", "_")


@dataclass(frozen=True)
class Option:
    """One thing that a user may choose.

    setting    the attribute of object.meander, which .blend files hold: never to be renamed
    label      its name, in Title Case; `row` is a shorter one for the panel
    tip        its tool-tip: the effect and its consequence, without a full stop
    panel      the label of its panel
    low, high  what becomes of the curve with a low value and with a high one, where it is a number
    kind       float, int, bool, or str for one of `choices`
    unit       "length": of the scene; "r": half the spacing; "spacing"; "share": of one; empty:
               none. What counts in r means the same at every spacing
    default    of the setting; a test compares it with the library's where `field` names one
    least, greatest, soft_least, soft_greatest   limits of the setting
    digits, step   decimals that the panel shows, and by how many hundredths an arrow changes it
    choices    name, label and tool-tip of each choice, where kind is str; OF_PRESET leaves it to
               the preset
    numbers    by which .blend files know the choices, one each: never to be changed; empty: their
               places
    field      the field of core.FlowOptions that it sets; empty: none
    switch     the setting that has to be on; while it is off the preset's own value is used
    zero_is_preset   0 means the preset's own value
    least_used       values between 0 and this are raised to this
    follows    another field of core.FlowOptions, which changes in the same proportion
    flag       None: the option is in the panel only
    """

    setting: str
    label: str
    tip: str
    panel: str
    row: str = ""
    low: str = ""
    high: str = ""
    kind: type = float
    unit: str = ""
    default: Any = 0.0
    least: float | None = None
    greatest: float | None = None
    soft_least: float | None = None
    soft_greatest: float | None = None
    digits: int = 2
    step: int = 10
    choices: tuple[tuple[str, str, str], ...] = ()
    numbers: tuple[int, ...] = ()
    field: str = ""
    switch: str = ""
    zero_is_preset: bool = False
    least_used: float = 0.0
    follows: str = ""
    flag: Flag | None = None


def apply(options: Iterable[Option], values: Values, flow_options: core.FlowOptions) -> None:
    """Puts what is chosen into the options of a flow, whose radius must be set.

    options   rows of the table; those without a field, or whose value is None or OF_PRESET, change
              nothing
    """
    for option in options:
        value = values.get(option.setting)
        if value is None or value == OF_PRESET or not option.field:
            continue
        if option.field in _NUMBERED:
            value = _NUMBERED[option.field][value.upper()]
        elif option.unit == "r":
            value *= flow_options.radius
        before = getattr(flow_options, option.field)
        if option.follows and before > 0:
            followed = getattr(flow_options, option.follows)
            setattr(flow_options, option.follows, followed * (value / before))
        setattr(flow_options, option.field, value)


def as_typed(value: float) -> float:
    """What the user has typed, and not the float32 that Blender keeps of it."""
    return float(f"{value:.6g}")


def chosen(options: Iterable[Option], settings: Any) -> dict[str, Any]:
    """What the settings of an object say, for apply().

    settings   anything with the attributes that the rows name
    """
    values: dict[str, Any] = {}
    for option in options:
        value = getattr(settings, option.setting)
        if option.switch and not getattr(settings, option.switch):
            value = None
        elif option.kind is float:
            value = as_typed(value)
            if value > 0.0:
                # Dragging up from 0 leads through what the library refuses as too small.
                value = max(value, option.least_used)
        elif option.kind is str:
            value = value.lower()
        if option.zero_is_preset and value == 0:
            value = None
        values[option.setting] = value
    return values


def store(options: Iterable[Option], values: Values, settings: Any) -> None:
    """Writes what is chosen into the settings of an object; chosen() then gives it back."""
    switches: dict[str, bool] = {}
    for option in options:
        value = values.get(option.setting)
        if option.switch:
            switches[option.switch] = switches.get(option.switch, False) or value is not None
        if value is None:
            if option.zero_is_preset:
                setattr(settings, option.setting, option.kind(0))
            continue
        setattr(settings, option.setting, value.upper() if option.kind is str else value)
    for switch, on in switches.items():
        setattr(settings, switch, on)
