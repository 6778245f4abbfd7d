# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of a mesh's own in Solid view, which shows one colour for each material otherwise.

Views that have been changed for them are given back when nothing that is seen has such colours any
more: undo leaves the settings of views alone.
"""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np

# What Solid view shows of a material nobody has given a colour, and of an object without one.
_GRAY = 0.8
LIGHTS = "Lights"
# Addresses of the views that have been changed.
_lent: set[int] = set()


def colour_corners(mesh: bpy.types.Mesh, colours: np.ndarray) -> None:
    """Gives the face corners of a mesh colours, (n, 3) linear, as its active colour attribute."""
    layer = mesh.color_attributes.new(LIGHTS, "BYTE_COLOR", "CORNER")
    opaque = np.ones((len(colours), 4), dtype=np.float32)
    opaque[:, :3] = colours
    layer.data.foreach_set("color", opaque.ravel())
    mesh.color_attributes.active_color = layer


def show_colours(context: bpy.types.Context, things: list[bpy.types.Object]) -> None:
    """Lets Solid views that colour by material colour by attribute, for objects that have one.

    All others are plain there then; so a view is left alone where another object that it may show
    has a colour.
    """
    others = (thing for thing in _seen(context) if thing not in things)
    if any(_is_coloured(thing) for thing in others):
        return
    for space in _views(context):
        if space.shading.color_type == "MATERIAL":
            space.shading.color_type = "VERTEX"
            _lent.add(space.as_pointer())


def _views(context: bpy.types.Context) -> Iterator[bpy.types.SpaceView3D]:
    """The 3D views of the windows that show the scene."""
    for window in context.window_manager.windows:
        if window.scene == context.scene:
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    yield area.spaces.active


def _seen(context: bpy.types.Context) -> list[bpy.types.Object]:
    return [thing for thing in context.view_layer.objects if thing.visible_get()]


def _has_lights(thing: bpy.types.Object) -> bool:
    return thing.type == "MESH" and LIGHTS in thing.data.color_attributes


def _is_coloured(thing: bpy.types.Object) -> bool:
    return any(
        slot.material is not None
        and any(abs(value - _GRAY) > 1e-3 for value in slot.material.diffuse_color[:3])
        for slot in thing.material_slots
    )


def give_back(*_evaluated: object) -> None:
    """Gives the views their color type back as soon as nothing is seen that needs another."""
    context = bpy.context
    if not _lent or any(_has_lights(thing) for thing in _seen(context)):
        return
    for space in _views(context):
        if space.as_pointer() in _lent and space.shading.color_type == "VERTEX":
            space.shading.color_type = "MATERIAL"
    _lent.clear()


def after_redo() -> None:
    things = [thing for thing in _seen(bpy.context) if _has_lights(thing)]
    if things:
        show_colours(bpy.context, things)
    give_back()


def forget() -> None:
    """Gives nothing back any more: the views are those of another file."""
    _lent.clear()
