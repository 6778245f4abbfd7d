# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of a mesh's own in Solid view, which shows one colour for each material otherwise."""

from __future__ import annotations

import bpy
import numpy as np

# What Solid view shows of a material nobody has given a colour, and of an object without one.
_GRAY = 0.8


def colour_corners(mesh: bpy.types.Mesh, name: str, colours: np.ndarray) -> None:
    """Gives the face corners of a mesh colours, (n, 3) linear, as its active colour attribute."""
    layer = mesh.color_attributes.new(name, "BYTE_COLOR", "CORNER")
    opaque = np.ones((len(colours), 4), dtype=np.float32)
    opaque[:, :3] = colours
    layer.data.foreach_set("color", opaque.ravel())
    mesh.color_attributes.active_color = layer


def show_colours(context: bpy.types.Context, things: list[bpy.types.Object]) -> None:
    """Lets Solid views that colour by material colour by attribute, for objects that have one.

    All others are plain there then; so a view is left alone where another object that it may show
    has a colour.
    """
    others = (thing for thing in context.visible_objects if thing not in things)
    if any(_is_coloured(thing) for thing in others):
        return
    for window in context.window_manager.windows:
        if window.scene != context.scene:
            continue
        for area in window.screen.areas:
            space = area.spaces.active
            if area.type == "VIEW_3D" and space.shading.color_type == "MATERIAL":
                space.shading.color_type = "VERTEX"


def _is_coloured(thing: bpy.types.Object) -> bool:
    return any(
        slot.material is not None
        and any(abs(value - _GRAY) > 1e-3 for value in slot.material.diffuse_color[:3])
        for slot in thing.material_slots
    )
