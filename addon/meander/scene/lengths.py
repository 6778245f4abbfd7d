# SPDX-License-Identifier: GPL-3.0-or-later
"""Lengths as the user reads them."""

from __future__ import annotations

import bpy


def length_text(scene: bpy.types.Scene, value: float, digits: int = 3) -> str:
    """A length of the world in the units that a scene shows; without units as a plain number."""
    unit = scene.unit_settings
    if unit.system == "NONE":
        return f"{value:.{digits}g}"
    return bpy.utils.units.to_string(
        unit.system, "LENGTH", value * unit.scale_length, precision=digits
    )
