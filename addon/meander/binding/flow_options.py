# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a flow; their defaults live in the native library only."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_uint32, sizeof
from dataclasses import dataclass, fields

from .abi import PRESETS, BoundaryRule, FlowOptionsRecord, MedialAxis, Status, StopRule
from .native_library import MeanderError, chosen, figures_of, native


@dataclass
class FlowOptions:
    """Options of one flow, named as in meander_flow_options, where each is described.

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


def default_options(preset: str = "even") -> FlowOptions:
    """The library's defaults for a preset of PRESETS; radius is 0 and must be chosen.

    Raises MeanderError for an unknown preset.
    """
    record = FlowOptionsRecord()
    status = native().meander_flow_options_init(byref(record), chosen("preset", preset, PRESETS))
    if status != Status.OK:
        raise MeanderError(f"the native library does not know the preset {preset!r}", status)
    values = figures_of(record)
    values["preset"] = PRESETS[record.preset]
    values["polish"] = bool(record.polish)
    values["stop_rule"] = StopRule(record.stop_rule)
    values["boundary_rule"] = BoundaryRule(record.boundary_rule)
    values["medial_axis"] = MedialAxis(record.medial_axis)
    return FlowOptions(**values)


def options_record(options: FlowOptions) -> FlowOptionsRecord:
    record = FlowOptionsRecord(struct_size=sizeof(FlowOptionsRecord))
    kinds = {field[0]: field[1] for field in FlowOptionsRecord._fields_}
    for field in fields(FlowOptions):
        value = getattr(options, field.name)
        if field.name == "preset":
            value = chosen("preset", value, PRESETS)
        try:
            if kinds[field.name] is c_uint32:
                number = int(value)
                # ctypes would wrap -1 round to 4294967295 without a word.
                if number != value or not 0 <= number <= 0xFFFFFFFF:
                    raise ValueError
                setattr(record, field.name, number)
            else:
                setattr(record, field.name, float(value))
        except (TypeError, ValueError, OverflowError) as problem:
            wanted = "a whole number, 0 or more" if kinds[field.name] is c_uint32 else "a number"
            raise MeanderError(
                f"the option {field.name} must be {wanted}, not {value!r}"
            ) from problem
    return record


def option_warnings(options: FlowOptions) -> list[str]:
    """What is allowed but seldom meant in the options, one sentence each.

    See meander_flow_options_get_warning. Raises MeanderError for values of the wrong type.
    """
    record = options_record(options)
    function = native().meander_flow_options_get_warning
    warnings: list[str] = []
    while size := function(byref(record), len(warnings), None, 0):
        text = ctypes.create_string_buffer(size)
        function(byref(record), len(warnings), text, size)
        warnings.append(text.value.decode("utf-8"))
    return warnings
