# SPDX-License-Identifier: GPL-3.0-or-later
"""The way from what was made from a curve back to it: what the panel says of both."""

from __future__ import annotations

import bpy

from ..run import remade
from ..run.lasting import why_busy
from ..scene.made import bring_into_view, made_from
from ..scene.results import shown_result
from .reasons import Reasoned, Reasons, not_in_object_mode
from .refusing import refusing
from .registered import registration
from .sidebar import notice


def _curve_behind(context: bpy.types.Context) -> bpy.types.Object | None:
    """The curve that the active object was made from, or that lies on it, or that it is."""
    active = context.active_object
    return made_from(active) or shown_result(active, context.scene)


class MEANDER_OT_select_curve(Reasoned, bpy.types.Operator):
    """Show the curve that this object was made from, or that lies on this mesh, and make it
    active"""

    bl_idname = "meander.select_curve"
    bl_label = "Select Curve"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        yield why_busy()
        if _curve_behind(context) is None:
            yield "Choose a mesh with a curve, or what was made from one"
        yield not_in_object_mode(context)

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        bring_into_view(_curve_behind(context), context)
        return {"FINISHED"}


class MEANDER_OT_use_as_surface(Reasoned, bpy.types.Operator):
    """Let this object be filled like any other mesh. It forgets the curve that it was made from"""

    bl_idname = "meander.use_as_surface"
    bl_label = "Use as Surface"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        active = context.active_object
        if made_from(active) is None:
            yield "Choose what was made from a curve"
        if active.library is not None:
            yield "The object is linked from another file"

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.active_object.meander.made_from = None
        return {"FINISHED"}


class MEANDER_OT_make_again(Reasoned, bpy.types.Operator):
    """Make this object again of its curve as that is now; keeps its place, materials and
    modifiers, and replaces its mesh"""

    bl_idname = "meander.make_again"
    bl_label = "Make Again"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        active = context.active_object
        yield why_busy()
        if made_from(active) is None or not active.meander.made_by:
            yield "Choose what a button under Make has made"
        if active.library is not None:
            yield "The object is linked from another file"
        yield not_in_object_mode(context)

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        thing = context.active_object
        remade.make_again(made_from(thing), context, [thing])
        self.report({"INFO"}, f"{thing.name} is of {made_from(thing).name} as it is now")
        return {"FINISHED"}


def draw_made(layout: bpy.types.UILayout, curve: bpy.types.Object, made: bpy.types.Object) -> None:
    """What stands in the panel for an object that was made from a curve."""
    notice(layout, f"Made from {curve.name}", "OUTLINER_OB_CURVE")
    row = layout.row(align=True)
    row.scale_y = 1.4
    row.operator(MEANDER_OT_select_curve.bl_idname, icon="RESTRICT_SELECT_OFF")
    if made.meander.made_by:
        row.prop(made.meander, "keep_up", text="", icon="LINKED")
        row.operator(MEANDER_OT_make_again.bl_idname, text="", icon="FILE_REFRESH")
    layout.operator(MEANDER_OT_use_as_surface.bl_idname, icon="MESH_DATA")


def draw_hidden(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """That the curve which the buttons would change is not seen; a bake says so by itself."""
    result = shown_result(context.active_object, context.scene)
    if result is None or result.meander.bake is not None or result.visible_get():
        return
    column = layout.column(align=True)
    column.label(text="Curve is hidden", icon="HIDE_ON")
    column.operator(MEANDER_OT_select_curve.bl_idname, icon="RESTRICT_SELECT_OFF")


register, unregister = registration(
    MEANDER_OT_select_curve,
    MEANDER_OT_use_as_surface,
    MEANDER_OT_make_again,
)
