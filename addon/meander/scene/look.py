# SPDX-License-Identifier: GPL-3.0-or-later
"""The look of a result: a modifier that gives the line its body, and that is the user's to edit.

A run gives it to a new curve. From then on runs write splines only, and, where they have not been
changed by hand, the spacing of which the thickness is a share and whether it follows a density.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import bpy

from . import assets, look_material
from .errors import DataError
from .look_modifier import GROUP, copy_values, modifier_of, set_value, value_of

LINE, ENDS = "Meander Line", "Meander Ends"
# Inputs that a run tells the look, and what keeps them, to tell them from what the user has set.
_TOLD = {"Spacing": "look_spacing", "Radius Follows Spacing": "look_follows"}
# Of what Blender keeps in single precision.
_ROUNDING = 1e-6


@dataclass(frozen=True)
class Look:
    """What a new result is to look like.

    radius    share of the spacing; 0: a bare curve
    profile   number of the cross section, as the group counts them
    follows   thicker where neighbours are farther apart
    """

    radius: float
    profile: int = 0
    follows: bool = False


def dress(curve_object: bpy.types.Object, look: Look, spacing: float) -> None:
    """Gives a new curve its look and, where it has no material, the add-on's.

    spacing   in the object's own space

    A curve whose strands have materials of their own gets a bevel, since modifiers know one
    material for all of a curve; so does every curve where the add-on's file cannot be read.
    """
    curve = curve_object.data
    curve.twist_mode = "Z_UP"  # by which its points are tilted
    try:
        if not any(curve.materials):
            line = assets.material(LINE)
            if len(curve.materials):
                curve.materials[0] = line
            else:
                curve.materials.append(line)
        if look.radius <= 0.0:
            return
        if len(curve.materials) > 1:
            curve.bevel_depth = look.radius * spacing
            return
        add_modifier(curve_object, look, spacing)
    except DataError:  # a line that has grown must not be lost because of its looks
        curve.bevel_depth = look.radius * spacing


def add_modifier(curve_object: bpy.types.Object, look: Look, spacing: float) -> None:
    """Adds the modifier, with the first material of the curve; see dress(). Raises DataError."""
    group = assets.node_group(GROUP)
    modifier = curve_object.modifiers.new(GROUP, "NODES")
    modifier.node_group = group
    for name, value in (("Radius", look.radius), ("Profile", look.profile)):
        set_value(modifier, name, value)
    look_material.write(curve_object, modifier)
    for name, value in (("Spacing", spacing), ("Radius Follows Spacing", float(look.follows))):
        _tell(curve_object, modifier, name, value)


def follow_run(curve_object: bpy.types.Object, spacing: float, follows: bool) -> None:
    """Tells the look of a result what its last run was about, but for what the user has set.

    spacing   in the object's own space
    follows   thicker where neighbours are farther apart
    """
    modifier = modifier_of(curve_object)
    if modifier is None:
        return
    for name, value in (("Spacing", spacing), ("Radius Follows Spacing", float(follows))):
        told = getattr(curve_object.meander.figures, _TOLD[name])
        now = value_of(modifier, name)
        if now is not None and math.isclose(now, told, rel_tol=_ROUNDING):
            _tell(curve_object, modifier, name, value)


def _tell(
    curve_object: bpy.types.Object, modifier: bpy.types.NodesModifier, name: str, value: float
) -> None:
    set_value(modifier, name, value)
    setattr(curve_object.meander.figures, _TOLD[name], value)


def give_ends_material(curve_object: bpy.types.Object) -> None:
    """Gives what stands on the ends of a line the add-on's material, where it has none."""
    modifier = modifier_of(curve_object)
    wants = modifier is not None and (value_of(modifier, "Ends") or 0) > 1
    if wants and value_of(modifier, "Ends Material") is None:
        try:
            set_value(modifier, "Ends Material", assets.material(ENDS))
        except DataError:
            pass  # it is plain then


def radius_of(curve_object: bpy.types.Object) -> float:
    """Half the thickness of a result in its own space; 0 for a bare curve."""
    modifier = modifier_of(curve_object)
    if modifier is None:
        return curve_object.data.bevel_depth
    return (value_of(modifier, "Radius") or 0.0) * (value_of(modifier, "Spacing") or 0.0)


def copy_look(source: bpy.types.Object, target: bpy.types.Object) -> None:
    """Gives a curve the look of another, with values of its own from then on."""
    modifier = modifier_of(source)
    if modifier is None:
        return
    copy = target.modifiers.new(modifier.name, "NODES")
    copy.node_group = modifier.node_group
    copy.show_viewport, copy.show_render = modifier.show_viewport, modifier.show_render
    copy_values(modifier, copy)
