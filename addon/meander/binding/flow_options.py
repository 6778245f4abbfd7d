# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a flow; their defaults live in the native library only."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_double, c_size_t, c_uint32
from dataclasses import dataclass, fields, make_dataclass
from typing import TYPE_CHECKING

from .abi import BoundaryRule, FlowOptionsRecord, MedialAxis, Start, StopRule
from .choices import PRESETS
from .native_library import MeanderError, call, chosen, native, prepared

# What C has as numbers and Python as something more; every other field is a float or an int.
_KINDS: dict[str, type] = {
    "preset": str,
    "polish": bool,
    "stop_rule": StopRule,
    "boundary_rule": BoundaryRule,
    "medial_axis": MedialAxis,
    "start": Start,
}


def _fields_of_the_header() -> list[tuple[str, type]]:
    """Names and kinds of the options, in the order of the header."""
    found = []
    for name, c_kind in FlowOptionsRecord._fields_:
        if name not in ("struct_size", "reserved32", "reserved"):
            found.append((name, _KINDS.get(name, float if c_kind is c_double else int)))
    return found


if TYPE_CHECKING:
    # What editors and type checkers see; a test holds it equal to the class below.
    @dataclass
    class FlowOptions:
        preset: str
        radius: float
        segment_length: float
        max_radius: float
        max_radius_factor: float
        length_weight: float
        bending_weight: float
        medial_weight: float
        alignment_weight: float
        length_power: float
        medial_power: float
        step: float
        growth_coarsening: float
        start_spacing_factor: float
        boundary_distance: float
        polish_bending_weight: float
        polish_length_offset: float
        polish_length_gain: float
        polish_medial_power: float
        boundary_rule: BoundaryRule
        medial_axis: MedialAxis
        stop_rule: StopRule
        grow_into_empty: int
        widen_loops: int
        hold_ends: int
        hairpin_removal_iterations: int
        polish: bool
        iteration_limit: int
        threads: int
        hairpin_removal_gentleness: float
        roughness: float
        start: Start

else:
    # Made from the header, in its order.
    FlowOptions = make_dataclass("FlowOptions", _fields_of_the_header())
    FlowOptions.__module__ = __name__
    FlowOptions.__doc__ = """Options of one flow, named as in meander_flow_options, where each is
described.

Made by `default_options` only; the defaults live in the library. Lengths are in the surface's
units. `radius` is half the spacing and must be chosen.
"""

_OPTION_NAMES = tuple(field.name for field in fields(FlowOptions))


def default_options(preset: str = "even") -> FlowOptions:
    """The library's defaults for a preset of PRESETS; radius is 0 and must be chosen.

    Raises MeanderError for an unknown preset.
    """
    record = prepared(FlowOptionsRecord, chosen("preset", preset, PRESETS))
    values = {name: getattr(record, name) for name in _OPTION_NAMES}
    for name, kind in _KINDS.items():
        values[name] = PRESETS[record.preset] if name == "preset" else kind(values[name])
    return FlowOptions(**values)


def options_record(options: FlowOptions) -> FlowOptionsRecord:
    """The C struct of options; what they do not name is as the preset has it."""
    record = prepared(FlowOptionsRecord, chosen("preset", options.preset, PRESETS))
    kinds = {field[0]: field[1] for field in FlowOptionsRecord._fields_}
    for name in _OPTION_NAMES:
        if name == "preset":
            continue
        value = getattr(options, name)
        try:
            if kinds[name] is c_uint32:
                number = int(value)
                # ctypes would turn -1 into 4294967295 without a word.
                if number != value or not 0 <= number <= 0xFFFFFFFF:
                    raise ValueError
                setattr(record, name, number)
            else:
                setattr(record, name, float(value))
        except (TypeError, ValueError, OverflowError) as problem:
            wanted = "a whole number, 0 or more" if kinds[name] is c_uint32 else "a number"
            raise MeanderError(f"the option {name} must be {wanted}, not {value!r}") from problem
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
