# SPDX-License-Identifier: GPL-3.0-or-later
"""Lengths as the user reads them."""

from __future__ import annotations

import bpy

# The units of length that a scene may show everything in, and what they are in metres.
_UNITS = {
    "KILOMETERS": ("km", 1e3),
    "METERS": ("m", 1.0),
    "CENTIMETERS": ("cm", 1e-2),
    "MILLIMETERS": ("mm", 1e-3),
    "MICROMETERS": ("µm", 1e-6),
    "MILES": ("mi", 1609.344),
    "FEET": ("'", 0.3048),
    "INCHES": ('"', 0.0254),
    "THOU": ("thou", 2.54e-5),
}


def length_text(scene: bpy.types.Scene, value: float, digits: int = 3) -> str:
    """A length of the world in the unit that fields of the scene have; without one as a number."""
    unit = scene.unit_settings
    if unit.system == "NONE":
        return f"{value:.{digits}g}"
    metres = value * unit.scale_length
    if unit.length_unit not in _UNITS:  # the one that suits, whichever that is
        return bpy.utils.units.to_string(unit.system, "LENGTH", metres, precision=digits)
    name, size = _UNITS[unit.length_unit]
    number = float(f"{metres / size:.{digits}g}")
    return f"{number:.12g}{'' if len(name) == 1 and not name.isalpha() else ' '}{name}"
