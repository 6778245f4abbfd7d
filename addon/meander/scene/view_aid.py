# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a curve on a surface as rendered lies in the views: on the surface that these show.

A modifier of Blender's own, which renders leave out, takes the line there: so it is seen in both.
"""

from __future__ import annotations

import bpy

from .rendered import rendering_of

NAME = "Meander View"


def is_view_aid(modifier: bpy.types.Modifier) -> bool:
    """Whether a modifier only takes a line to where the views show its surface."""
    return (
        modifier.type == "SHRINKWRAP"
        and not modifier.show_render
        and modifier.name.startswith(NAME)
    )


def lay_on_what_is_shown(
    curve: bpy.types.Object, surface: bpy.types.Object, scene: bpy.types.Scene
) -> None:
    """Gives a curve the modifier, before all others, where its surface renders otherwise than it is
    shown and was filled so; else takes it away."""
    rendering = rendering_of(surface, scene)
    wanted = surface.type == "MESH" and rendering is not None and rendering.may_be_filled
    found = next((each for each in curve.modifiers if is_view_aid(each)), None)
    if found is not None and not wanted:
        curve.modifiers.remove(found)
    if found is not None or not wanted:
        return
    modifier = curve.modifiers.new(NAME, "SHRINKWRAP")
    modifier.target = surface
    modifier.use_apply_on_spline = True  # the line, before it has a body
    modifier.show_render = False
    modifier.show_expanded = False
    if curve.modifiers[0] != modifier:
        with bpy.context.temp_override(object=curve, active_object=curve):
            bpy.ops.object.modifier_move_to_index(modifier=modifier.name, index=0)
