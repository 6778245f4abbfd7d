# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result makes of its surface: the cut mesh, two colours, a relief, a ribbon."""

from __future__ import annotations

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty

from ..model.cut import light_colours, one_side
from ..run import session
from ..run.cut import CutResult, cut_result, paint, paint_sides
from ..run.lasting import Activity
from ..scene import assets
from ..scene.cut import UV_MAP, sharpen_line, take_place
from ..scene.errors import DataError
from ..scene.identity import Key
from ..scene.look import set_value
from ..scene.made import name_curve
from ..scene.solid_view import colour_corners, show_colours
from ..scene.transforms import mean_scale
from .on_result import NO_RESULT, OnResult, result_of
from .points import draw_light_and_points
from .refusing import refusing
from .sidebar import OUTPUT, OUTPUT_ORDER, SubPanel, columns

_DETAIL = "Length of the edges between the lines, in half spacings; 0 adds none"
# What has a finer mesh than this takes Blender long to draw.
_FINEST = 0.1
# What was made last: the box Adjust Last Operation belongs to it as long as it is active.
# What an operator has made last.
_made: Activity[Key] = Activity()


class Cut(OnResult):
    """Cuts the surface of the active result along it, into a new object."""

    bl_options = {"REGISTER", "UNDO"}
    suffix = ""
    middle_lines = False
    sides = False
    takes_place = True  # of the surface, which is hidden

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return _can_adjust(cls, context) or super().poll(context)

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        result = result_of(context)
        if result is None:  # started anew while what it made last is active
            raise DataError(NO_RESULT)
        detail = max(self.detail, _FINEST) if self.detail > 0.0 else 0.0
        cut = cut_result(
            result,
            context.scene,
            context.evaluated_depsgraph_get(),
            detail,
            self.middle_lines,
            self.sides,
        )
        made = self.make(cut, f"{result.name} {self.suffix}")
        name_curve(made, result)
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
        self.report({"INFO"}, f"{made[0].name}: {faces:,} faces{self.remark(cut)}")
        return {"FINISHED"}

    def make(self, cut: CutResult, name: str) -> list[bpy.types.Object]:
        """Makes the objects of a cut."""
        return [cut.make(name)]

    def remark(self, _cut: CutResult) -> str:
        """What more there is to say, from a comma on."""
        return ""


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
    suffix = "Cut"

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
    suffix = "Two-Tone"
    sides = True
    detail = 0.0

    parts: EnumProperty(
        name="Objects",
        description="What becomes of the two sides",
        items=(
            ("ONE", "One", "One mesh with two materials"),
            ("TWO", "One for Each Side", "Two meshes that fit into one another"),
        ),
    )
    hide: hide_originals()

    def make(self, cut: CutResult, name: str) -> list[bpy.types.Object]:
        materials = [assets.material(f"Meander Side {number}") for number in (1, 2)]
        if self.parts == "ONE":
            made = cut.make(name)
            paint_sides(made, materials)
            return [made]
        made = []
        for side, material in zip((1, -1), materials, strict=True):
            thing = cut.make(name, one_side(cut.cut, side))
            paint(thing, material)
            made.append(thing)
        return made

    def remark(self, cut: CutResult) -> str:
        if cut.parted:
            return ""
        return ", whose colors also meet halfway between turns, since the curve has one side only"


class MEANDER_OT_relief(Cut, bpy.types.Operator):
    bl_idname = "meander.relief"
    bl_label = "Relief"
    bl_description = (
        "Raise the surface between the turns of the curve, like brain coral. Height and shape are "
        "in the new object's modifier"
    )
    suffix = "Relief"
    middle_lines = True

    detail: FloatProperty(name="Detail", description=_DETAIL, default=0.5, min=0.0, soft_max=2.0)
    hide: hide_originals()

    def make(self, cut: CutResult, name: str) -> list[bpy.types.Object]:
        group, material = assets.node_group("Meander Relief"), assets.material("Meander Coral")
        made = cut.make(name, keep_normals=False)
        sharpen_line(made)
        paint(made, material)
        modifier = made.modifiers.new("Relief", "NODES")
        modifier.node_group = group
        set_value(modifier, "Spacing", cut.plan.spacing / mean_scale(cut.plan.matrix))
        return [made]


class MEANDER_OT_ribbon(Cut, bpy.types.Operator):
    bl_idname = "meander.ribbon"
    bl_label = "Ribbon"
    bl_description = (
        "Lay a band along the curve over the whole surface: the UV map Ribbon goes along it, for "
        "text, zips and lights that run"
    )
    suffix = "Ribbon"
    middle_lines = True

    detail: FloatProperty(name="Detail", description=_DETAIL, default=0.5, min=0.0, soft_max=2.0)
    running_lights: BoolProperty(
        name="Running Lights",
        description="Give it a material of lights that run along the curve",
        default=True,
    )
    hide: hide_originals()

    def make(self, cut: CutResult, name: str) -> list[bpy.types.Object]:
        material = assets.material("Meander Running Lights") if self.running_lights else None
        made = cut.make(name)
        if material is not None:
            paint(made, material)
        layer = made.data.uv_layers[UV_MAP].data
        uv = np.empty(2 * len(layer), dtype=np.float32)
        layer.foreach_get("uv", uv)
        colour_corners(made.data, light_colours(uv.reshape(-1, 2)))
        return [made]


class MEANDER_PT_make(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_make"
    bl_label = "Make"
    bl_parent_id = OUTPUT
    bl_order = OUTPUT_ORDER["make"]
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        if result_of(context) is not None:
            column = layout.column(align=True)
            column.operator(MEANDER_OT_two_tone.bl_idname, icon="MOD_MASK")
            column.operator(MEANDER_OT_relief.bl_idname, icon="RNDCURVE")
            column.operator(MEANDER_OT_ribbon.bl_idname, icon="UV")
            column.operator("meander.maze", icon="MOD_BUILD")
            column.operator(MEANDER_OT_cut_along_curve.bl_idname, icon="EDGESEL")
        draw_light_and_points(layout, context)


_CLASSES = (
    MEANDER_OT_cut_along_curve,
    MEANDER_OT_two_tone,
    MEANDER_OT_relief,
    MEANDER_OT_ribbon,
    MEANDER_PT_make,
)


def register() -> None:
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
