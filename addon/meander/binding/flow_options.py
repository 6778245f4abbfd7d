# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a flow; their defaults live in the native library only."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_size_t, c_uint32
from dataclasses import dataclass, fields

from .abi import BoundaryRule, FlowOptionsRecord, MedialAxis, StopRule
from .choices import C_OPTIONS, PRESETS
from .native_library import MeanderError, call, chosen, native, prepared


@dataclass
class FlowOptions:
    """Options of one flow, named as in meander_flow_options, where each is described, but for those
    of C_OPTIONS.

    Made by `default_options` only; the defaults live in the library. Lengths are in the surface's
    units. `radius` is half the spacing and must be chosen.
    """

    preset: str
    radius: float
    segment_length: float
    max_radius: float
    length_weight: float
    bending_weight: float
    medial_weight: float
    alignment_weight: float
    length_power: float
    medial_power: float
    step: float
    growth_coarsening: float
    start_spacing_factor: float
    polish: bool
    stop_rule: StopRule
    polish_bending_weight: float
    polish_length_offset: float
    polish_length_gain: float
    polish_medial_power: float
    border_distance: float
    boundary_rule: BoundaryRule
    iteration_limit: int
    threads: int
    ripening_iterations: int
    medial_axis: MedialAxis


_OPTION_NAMES = tuple(field.name for field in fields(FlowOptions))


def default_options(preset: str = "even") -> FlowOptions:
    """The library's defaults for a preset of PRESETS; radius is 0 and must be chosen.

    Raises MeanderError for an unknown preset.
    """
    record = prepared(FlowOptionsRecord, chosen("preset", preset, PRESETS))
    values = {name: getattr(record, C_OPTIONS.get(name, name)) for name in _OPTION_NAMES}
    values["preset"] = PRESETS[record.preset]
    values["polish"] = bool(record.polish)
    values["stop_rule"] = StopRule(record.stop_rule)
    values["boundary_rule"] = BoundaryRule(record.boundary_rule)
    values["medial_axis"] = MedialAxis(record.medial_axis)
    return FlowOptions(**values)


def options_record(options: FlowOptions) -> FlowOptionsRecord:
    """The C struct of options; what they do not name is as the preset has it."""
    record = prepared(FlowOptionsRecord, chosen("preset", options.preset, PRESETS))
    kinds = {field[0]: field[1] for field in FlowOptionsRecord._fields_}
    for name in _OPTION_NAMES:
        if name == "preset":
            continue
        value, c_name = getattr(options, name), C_OPTIONS.get(name, name)
        try:
            if kinds[c_name] is c_uint32:
                number = int(value)
                # ctypes would turn -1 into 4294967295 without a word.
                if number != value or not 0 <= number <= 0xFFFFFFFF:
                    raise ValueError
                setattr(record, c_name, number)
            else:
                setattr(record, c_name, float(value))
        except (TypeError, ValueError, OverflowError) as problem:
            wanted = "a whole number, 0 or more" if kinds[c_name] is c_uint32 else "a number"
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
