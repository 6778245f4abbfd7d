# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a flow; their defaults live in the native library only."""

from __future__ import annotations

import ctypes
import typing
from ctypes import byref, c_double, c_size_t, c_uint32
from dataclasses import dataclass, fields

from .abi import FlowOptionFields, FlowOptionsRecord
from .calls import call, prepared
from .choices import PRESETS
from .handle import chosen
from .named import number_of, only_its_names, refuse_other, whole_of
from .native_library import native


@only_its_names
@dataclass
class FlowOptions(FlowOptionFields):
    """Options of one flow, named as in meander_flow_options, where each is described.

    Made by `default_options` only; the defaults live in the library. Lengths are in the surface's
    units. `radius` is half the spacing; at 0 a Flow takes the automatic one of its surface,
    see `automatic_spacing`, and says which by the logger "meander".

    tunings   numbers that shape curves, by name; experimental, see meander_flow_options_set_tuning
    """

    preset: str  # one of PRESETS
    polish: bool
    tunings: dict[str, float]


_KINDS = typing.get_type_hints(FlowOptions)
# Those that are fields of the struct.
_OPTION_NAMES = tuple(field.name for field in fields(FlowOptionFields))


def tuning_names() -> tuple[str, ...]:
    """The names of the tunings that the library has."""
    names: list[str] = []
    while (name := native().meander_tuning_name(len(names))) is not None:
        names.append(name.decode("utf-8"))
    return tuple(names)


def default_options(preset: str = "even") -> FlowOptions:
    """The library's defaults for a preset of PRESETS; radius is 0, the automatic one.

    Raises MeanderError for an unknown preset.
    """
    record = prepared(FlowOptionsRecord, chosen("preset", preset, PRESETS))
    values = {name: _KINDS[name](getattr(record, name)) for name in _OPTION_NAMES}
    tunings: dict[str, float] = {}
    for name in tuning_names():
        value = c_double()
        get = native().meander_flow_options_get_tuning
        call(get, byref(record), name.encode(), ctypes.addressof(value))
        tunings[name] = value.value
    return FlowOptions(**(values | {"preset": preset}), tunings=tunings)


def options_record(options: FlowOptions) -> FlowOptionsRecord:
    """The C struct of options; what they do not name is as the preset has it."""
    refuse_other("options", options, FlowOptions)
    record = prepared(FlowOptionsRecord, chosen("preset", options.preset, PRESETS))
    kinds = {field[0]: field[1] for field in FlowOptionsRecord._fields_}
    for name in _OPTION_NAMES:
        if name != "preset":
            read = whole_of if kinds[name] is c_uint32 else number_of
            setattr(record, name, read(f"option {name}", getattr(options, name)))
    refuse_other("tunings", options.tunings, dict, "give numbers by name")
    set_tuning = native().meander_flow_options_set_tuning
    for name, value in options.tunings.items():
        call(set_tuning, byref(record), name.encode(), number_of(f"tuning {name}", value))
    return record


def option_warnings(options: FlowOptions) -> list[str]:
    """What is allowed but seldom meant in the options, one sentence each.

    See meander_flow_options_get_warning. Raises MeanderError for values of the wrong type.
    """
    record = options_record(options)
    function = native().meander_flow_options_get_warning
    size = c_size_t()
    warnings: list[str] = []
    while True:
        call(function, byref(record), len(warnings), None, 0, byref(size))
        if size.value == 0:
            return warnings
        text = ctypes.create_string_buffer(size.value)
        call(function, byref(record), len(warnings), text, size.value, byref(size))
        warnings.append(text.value.decode("utf-8"))
