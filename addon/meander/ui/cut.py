# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result makes of its surface: the cut mesh, two colours, a relief, a ribbon."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty

from ..run import makers, remade, session
from ..run.lasting import Activity
from ..scene.cut import take_place
from ..scene.errors import DataError
from ..scene.identity import Key
from ..scene.solid_view import show_colours
from .on_result import NO_RESULT, OnResult, result_of
from .points import draw_light_and_points
from .refusing import refusing
from .registered import registration
from .sidebar import OUTPUT, OUTPUT_ORDER, SubPanel, columns

_DETAIL = "Length of the edges between the lines, in half spacings; 0 adds none"
# What was made last: the box Adjust Last Operation belongs to it as long as it is active.
_made: Activity[Key] = Activity()


class Cut(OnResult):
    """Cuts the surface of the active result along it, into a new object."""

    bl_options = {"REGISTER", "UNDO"}
    maker = ""  # in makers.MAKERS
    takes_place = True  # of the surface, which is hidden

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return _can_adjust(cls, context) or super().poll(context)

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        result = result_of(context)
        if result is None:  # started anew while what it made last is active
            raise DataError(NO_RESULT)
        values = {name: getattr(self, name) for name in makers.MAKERS[self.maker].values}
        depsgraph = context.evaluated_depsgraph_get()
        made, remark = makers.make(self.maker, values, result, context.scene, depsgraph)
        remade.note(made, result, self.maker, values)
        surface = result.meander.surface
        originals = (result, surface) if self.takes_place else (result,)
        _show(context, made, originals if self.hide else ())
        if self.hide and self.takes_place:
            for thing in made:
                take_place(thing, surface)
        colours = getattr(made[0].data, "color_attributes", None)
        if colours is not None and colours.active_color is not None:
            show_colours(context, made)
        faces = sum(len(thing.data.polygons) for thing in made if thing.type == "MESH")
        self.report({"INFO"}, f"{made[0].name}: {faces:,} faces{remark}")
        return {"FINISHED"}


def _can_adjust(cls: type[Cut], context: bpy.types.Context) -> bool:
    """Whether the operator has just been run, and what it has made is still active.

    Blender shows the box Adjust Last Operation, and takes the operator back to run it with other
    settings, only while its poll agrees: before the result is active again.
    """
    operators = context.window_manager.operators
    made = None if _made.current is None else _made.current.find()
    return (
        len(operators) > 0
        and operators[-1].bl_idname == cls.__name__
        and made is not None
        and context.active_object == made
        and context.mode == "OBJECT"
        and session.current() is None
    )


def _show(
    context: bpy.types.Context,
    made: list[bpy.types.Object],
    hidden: tuple[bpy.types.Object, ...],
) -> None:
    """Selects what was made, in the place of what it was made of."""
    for thing in list(context.selected_objects):
        thing.select_set(False)
    for thing in hidden:
        if thing.library is None:
            thing.hide_render = True
        if context.view_layer.objects.get(thing.name) == thing:
            thing.hide_set(True)
    for thing in made:
        thing.select_set(True)
    context.view_layer.objects.active = made[0]
    _made.begin(Key(made[0]))


def hide_originals() -> object:
    return BoolProperty(
        name="Hide Originals",
        description="Hide the curve and its surface, in whose place the new object stands",
        default=True,
    )


class MEANDER_OT_cut_along_curve(Cut, bpy.types.Operator):
    bl_idname = "meander.cut_along_curve"
    bl_label = "Cut Along Curve"
    bl_description = (
        "Make a mesh of the surface that has the curve as edges, marked as seams, with the side, "
        "the strand and the distance as attributes"
    )
    maker = "cut_along_curve"

    detail: FloatProperty(name="Detail", description=_DETAIL, default=0.0, min=0.0, soft_max=2.0)
    middle_lines: BoolProperty(
        name="Middle Lines",
        description="Make edges halfway between neighbouring turns of the curve too",
    )
    hide: hide_originals()


class MEANDER_OT_two_tone(Cut, bpy.types.Operator):
    bl_idname = "meander.two_tone"
    bl_label = "Two-Tone"
    bl_description = (
        "Color the two sides of the curve, or make an object of each. Where the curve is open, "
        "and has only one side, the colors also meet halfway between its turns"
    )
    maker = "two_tone"

    parts: EnumProperty(
        name="Objects",
        description="What becomes of the two sides",
        items=(
            ("ONE", "One", "One mesh with two materials"),
            ("TWO", "One for Each Side", "Two meshes that fit into one another"),
        ),
    )
    hide: hide_originals()



class MEANDER_OT_relief(Cut, bpy.types.Operator):
    bl_idname = "meander.relief"
    bl_label = "Relief"
    bl_description = (
        "Raise the surface between the turns of the curve, like brain coral. Height and shape are "
        "in the new object's modifier"
    )
    maker = "relief"

    detail: FloatProperty(name="Detail", description=_DETAIL, default=0.5, min=0.0, soft_max=2.0)
    hide: hide_originals()



class MEANDER_OT_ribbon(Cut, bpy.types.Operator):
    bl_idname = "meander.ribbon"
    bl_label = "Ribbon"
    bl_description = (
        "Lay a band along the curve over the whole surface: the UV map Ribbon goes along it, for "
        "text, zips and lights that run"
    )
    maker = "ribbon"

    detail: FloatProperty(name="Detail", description=_DETAIL, default=0.5, min=0.0, soft_max=2.0)
    running_lights: BoolProperty(
        name="Running Lights",
        description="Give it a material of lights that run along the curve",
        default=True,
    )
    hide: hide_originals()



class MEANDER_PT_make(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_make"
    bl_label = "Make"
    bl_parent_id = OUTPUT
    bl_order = OUTPUT_ORDER["make"]

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        if result_of(context) is not None:
            column = layout.column(align=True)
            column.operator(MEANDER_OT_two_tone.bl_idname, icon="MOD_MASK")
            column.operator(MEANDER_OT_relief.bl_idname, icon="RNDCURVE")
            column.operator(MEANDER_OT_ribbon.bl_idname, icon="UV")
            row = column.row(align=True)
            row.operator("meander.maze", icon="MOD_BUILD")
            row.operator_menu_enum(
                "meander.make_material", "kind", text="Material", icon="MATERIAL"
            )
            column.operator(MEANDER_OT_cut_along_curve.bl_idname, icon="EDGESEL")
        draw_light_and_points(layout, context)


register, unregister = registration(
    MEANDER_OT_cut_along_curve,
    MEANDER_OT_two_tone,
    MEANDER_OT_relief,
    MEANDER_OT_ribbon,
    MEANDER_PT_make,
)
