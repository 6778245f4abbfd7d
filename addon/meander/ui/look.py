# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel "Look": what a result looks like, and before there is one, what it will look like.

What it shows of a result is the modifier's own, or the curve's: there is no other copy, so that all
of it acts at once and can be animated, and whoever changes it there sees it here.
"""

import bpy

from ..run import rounding
from ..run.lasting import Activity
from ..scene import drawn_line, look
from ..scene.bake import looks_differ, pass_on_look
from ..scene.identity import Key
from ..scene.linked_settings import settings_of
from ..scene.look_upgrade import add_look
from ..scene.results import shown_result
from .declared import switch
from .on_result import OnOwnResult, result_of
from .reasons import Reasons
from .refusing import refusing
from .registered import registration
from .sidebar import LOOK, LOOK_ORDER, ORDER, SubPanel, columns
from .unanimated import BoolProperty, EnumProperty

# The cross sections that the look of a curve has, by the numbers that its modifier keeps.
PROFILES = (
    ("ROUND", "Round", "A tube"),
    ("SQUARE", "Square", "A bar with four edges, one side on the surface"),
    ("RIBBON", "Ribbon", "Flat on the surface"),
    ("WALL", "Wall", "Thin, and upright on the surface"),
    ("ROPE", "Rope", "Plies that wind round one another, as in rope and yarn"),
)
# The same of the ends of open lines.
ENDS = (
    ("FLAT", "Flat", "Cut off"),
    ("ROUND", "Round", "Half a ball"),
    ("NEON", "Neon", "The sleeves and wires of a neon tube"),
    ("PLUG", "Plug", "The plugs of a cable, which rise from the surface"),
)


def _modifier_of(settings: bpy.types.PropertyGroup) -> bpy.types.Modifier | None:
    """That of the look; settings of a linked surface are the scene's, which has none."""
    thing = settings.id_data
    return look.modifier_of(thing) if isinstance(thing, bpy.types.Object) else None


def _shown(settings: bpy.types.PropertyGroup, name: str, count: int) -> int:
    modifier = _modifier_of(settings)
    number = None if modifier is None else look.value_of(modifier, name)
    return min(max(int(number or 0), 0), count - 1)


def _choose(settings: bpy.types.PropertyGroup, name: str, number: int) -> None:
    modifier = _modifier_of(settings)
    if modifier is not None:
        look.set_value(modifier, name, number)


def _choose_ends(settings: bpy.types.PropertyGroup, number: int) -> None:
    _choose(settings, "Ends", number)
    if isinstance(settings.id_data, bpy.types.Object):
        look.give_ends_material(settings.id_data)


class ProfileSettings:
    """Settings of the thickness of a result, mixed into MeanderSettings."""

    profile: EnumProperty(
        name="Profile",
        description="Cross section of a new curve",
        items=PROFILES,
        default="ROUND",
    )
    shown_profile: EnumProperty(
        name="Profile",
        description="Cross section of the curve",
        items=PROFILES,
        get=lambda settings: _shown(settings, "Profile", len(PROFILES)),
        set=lambda settings, number: _choose(settings, "Profile", number),
    )
    shown_ends: EnumProperty(
        name="Ends",
        description="What is at the ends of open lines",
        items=ENDS,
        get=lambda settings: _shown(settings, "Ends", len(ENDS)),
        set=_choose_ends,
    )
    radius_follows: BoolProperty(
        name="Radius Follows Spacing",
        description="With a density, make the curve thinner where its strands are closer",
        default=True,
    )


class MEANDER_OT_add_look(OnOwnResult, bpy.types.Operator):
    """Give this curve a modifier for its thickness, profile, lift and color along the line"""

    bl_idname = "meander.add_look"
    bl_label = "Add Live Look"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        yield from super().reasons(context)
        if look.modifier_of(result_of(context)) is not None:
            yield "The curve has a live look"

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        add_look(result_of(context), context.evaluated_depsgraph_get())
        return {"FINISHED"}


class MEANDER_PT_look(SubPanel, bpy.types.Panel):
    bl_idname = LOOK
    bl_label = "Look"
    bl_order = ORDER["look"]

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        active = context.active_object
        result = shown_result(context.active_object, context.scene)
        if result is None:
            _draw_seed(layout, settings_of(active))
            return
        if result is not active:
            whole = layout.row()  # its name has all the room
            whole.use_property_split = False
            settings = settings_of(active)
            if settings.last_result == result:
                whole.prop(settings, "last_result", text="", icon="CURVE_DATA")
            else:  # the one that it names has been deleted
                whole.label(text=result.name, icon="CURVE_DATA")
        _order(result)
        modifier = look.modifier_of(result)
        if modifier is None:
            _draw_bevel(layout, result)
        else:
            _draw_look(layout, result, modifier)
        _draw_colour(layout, result, modifier)


# The result whose baked frames are to look as it does. A panel changes nothing, so a timer does.
_to_pass_on: Activity[Key] = Activity()


# The result that is to be drawn with another rounding, likewise.
_to_draw: Activity[Key] = Activity()
# Not while its slider is dragged.
_DRAG_SECONDS = 0.2


def _order(result: bpy.types.Object) -> None:
    if drawn_line.is_due(result):
        _to_draw.begin(Key(result))
        if not bpy.app.background and not bpy.app.timers.is_registered(draw_ordered):
            bpy.app.timers.register(draw_ordered, first_interval=_DRAG_SECONDS)
    if not looks_differ(result):
        return
    _to_pass_on.begin(Key(result))
    if not bpy.app.background and not bpy.app.timers.is_registered(pass_on):
        bpy.app.timers.register(pass_on, first_interval=0.0)


def pass_on() -> None:
    """Gives the baked frames of what the panel shows its look, which the panel edits."""
    key = _to_pass_on.taken()
    result = None if key is None else key.find()
    if result is not None and looks_differ(result):
        pass_on_look(result)


def draw_ordered() -> None:
    """Draws what the panel shows as its *Round* asks for."""
    key = _to_draw.taken()
    result = None if key is None else key.find()
    if result is not None and drawn_line.is_due(result):
        rounding.renew(result, bpy.context.scene, bpy.context.evaluated_depsgraph_get())


def _draw_seed(layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup) -> None:
    """What the first result of a surface will look like."""
    switch(layout, settings, "use_bevel")
    column = layout.column()
    column.active = settings.use_bevel
    column.prop(settings, "profile")
    column.prop(settings, "bevel_share", text="Radius")
    column.prop(settings, "round_share", text="Round")
    switch(column, settings, "radius_follows")


def _draw_bevel(layout: bpy.types.UILayout, result: bpy.types.Object) -> None:
    """A result of an earlier version, a bare one, or one whose strands have their materials."""
    column = layout.column(align=True)
    column.prop(result.data, "bevel_depth", text="Radius")
    column.prop(result.data, "bevel_resolution", text="Resolution")
    layout.operator(MEANDER_OT_add_look.bl_idname, icon="GEOMETRY_NODES")


def _draw_look(
    layout: bpy.types.UILayout, result: bpy.types.Object, modifier: bpy.types.NodesModifier
) -> None:
    def row(name: str, text: str = "") -> None:
        place = look.place_of(modifier, name)
        if place is not None:
            layout.prop(*place, text=text or name)

    layout.prop(result.meander, "shown_profile")
    row("Radius")
    row("Round")
    if result.meander.shown_profile in ("ROUND", "ROPE"):
        row("Resolution")
    if result.meander.shown_profile == "ROPE":
        row("Plies")
        row("Twist")
        row("Fuzz")
    if not all(spline.use_cyclic_u for spline in result.data.splines):
        layout.prop(result.meander, "shown_ends")
    row("Lift")
    row("Radius Follows Spacing", "By Spacing")


def _draw_colour(
    layout: bpy.types.UILayout,
    result: bpy.types.Object,
    modifier: bpy.types.NodesModifier | None,
) -> None:
    """The colours of the material, where it has the ramp of the add-on's."""
    if look.is_chosen_in_modifier(result):
        place = look.place_of(modifier, "Material")
        layout.prop_search(*place, bpy.data, "materials", text="Material")
    else:
        column = layout.column()
        column.use_property_split = False
        if result.active_material is None:
            column.template_ID(result, "active_material", new="material.new")
        else:  # its name has all the room
            column.prop(result, "active_material", text="", icon="MATERIAL")
    material = look.material_of(result)
    if material is None:
        return
    layout.prop(material, "diffuse_color", text="Solid View")


class MEANDER_PT_look_color(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_look_color"
    bl_label = "Along the Line"
    bl_parent_id = LOOK
    bl_order = LOOK_ORDER["color"]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and _ramp_shown(context) is not None

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.template_color_ramp(_ramp_shown(context), "color_ramp", expand=False)


def _ramp_shown(context: bpy.types.Context) -> bpy.types.Node | None:
    """The colours along the line of the result that is active, or is of the mesh that is."""
    result = shown_result(context.active_object, context.scene)
    if result is None or look.modifier_of(result) is None:
        return None
    material = look.material_of(result)
    return None if material is None else look.ramp_node_of(material)


register, unregister = registration(MEANDER_OT_add_look, MEANDER_PT_look, MEANDER_PT_look_color)
