# SPDX-License-Identifier: GPL-3.0-or-later
"""Names for the numbers of ``meander.h``. A name's place in its tuple is its number."""

from __future__ import annotations

from enum import IntEnum

from .abi import Alignment, Curvature, Directions, Element, Fault, Phase, Preset, StopReason


def _names(numbers: type[IntEnum]) -> tuple[str, ...]:
    if [int(number) for number in numbers] != list(range(len(numbers))):
        raise ValueError(f"the numbers of {numbers.__name__} are not 0, 1, 2 and so on")
    return tuple(number.name.lower() for number in numbers)


# What the indices of an error count; the first is no element at all.
ELEMENT_KINDS: tuple[str | None, ...] = (None, *_names(Element)[1:])
PRESETS = _names(Preset)
PHASES = _names(Phase)
STOP_REASONS = _names(StopReason)
CURVATURES = _names(Curvature)
DIRECTIONS = _names(Directions)
ALIGNMENTS = _names(Alignment)
FAULTS = _names(Fault)
