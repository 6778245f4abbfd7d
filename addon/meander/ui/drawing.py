# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawing a seed, or strokes of direction, on a mesh with Blender's own draw tool.

While one is drawn, the tool of Edit Mode and the settings of curve painting are borrowed. They are
given back by End Drawing, which leaving Edit Mode is too, and also when the curve goes. Blender
fits a smooth curve to every stroke, which cuts through a surface that bends; so what the strokes
come to is shown on the surface after each.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from typing import Any

import bpy
from bpy.props import EnumProperty

from .. import core
from ..run import seeds
from ..run.edit_mode import push_undo
from ..run.lasting import Activity, why_busy
from ..run.window import redraw
from ..scene import linked_settings
from ..scene.blender_versions import settings_of
from ..scene.changes import shape_count
from ..scene.errors import DataError
from ..scene.identity import Key
from ..scene.seeds import new_seed
from .reasons import Reasoned, Reasons
from .refusing import sentence_of
from .registered import registration
from .sidebar import Sidebar, notice

_DRAW_TOOL = "builtin.draw"
# What makes a stroke lie on what is seen under the mouse; Blender without one of them goes without.
_PAINT = {
    "curve_type": "BEZIER",
    "depth_mode": "SURFACE",
    "surface_offset": 0.0,
    "use_offset_absolute": False,
    "use_stroke_endpoints": False,
    "use_project_only_selected": False,
}
_STATUS = "Draw on the surface: drag with the left button    Tab or End Drawing: end"
# How often it is looked for new strokes, and whether the user has left Edit Mode, in seconds.
_INTERVAL = 0.1
# Strokes on a surface where showing one takes longer than this, in seconds, are not shown: the next
# one would have to wait. The curve itself is in front.
_QUICK = 0.7


@dataclass
class _Drawing:
    """A seed that is being drawn, and what was borrowed for it."""

    curve: Key
    surface: Key
    scene: Key
    setting: str  # of the surface, which names the curve
    earlier: Key | None  # what it named
    paint: dict[str, Any]
    tool: str | None
    workspaces: list[Key] = field(default_factory=list)
    shown: int | None = None  # the curve's shape_count() when it was shown last
    shows: bool = True  # whether that is quick enough
    problem: str = ""  # why a run would refuse what is drawn, a sentence


# What a curve is for its mesh that a setting names.
_IS_WHAT = {"seed": "seed", "alignment_strokes": "direction"}

def surface_drawn_on(active: bpy.types.Object | None) -> bpy.types.Object | None:
    """The surface for which the active curve is being drawn; None: it is no such curve."""
    drawing = drawn.current
    if drawing is None or active is None or active.mode != "EDIT":
        return None
    return drawing.surface.find() if drawing.curve.find() == active else None


# ------------------------------------------------------------------------------------------------
# Borrowing


def _borrow(
    context: bpy.types.Context, curve: bpy.types.Object, surface: bpy.types.Object, setting: str
) -> None:
    """Sets up the draw tool. Edit Mode of the curve is on."""
    paint = context.tool_settings.curve_paint_settings
    before = settings_of(paint, _PAINT)
    for name in before:
        setattr(paint, name, _PAINT[name])
    earlier = getattr(linked_settings.settings_of(surface), setting)
    drawing = _Drawing(
        Key(curve),
        Key(surface),
        Key(context.scene),
        setting,
        None if earlier is None else Key(earlier),
        before,
        None,
        shows=setting == "seed",  # directions are not what a run starts from
    )
    if context.area is not None and context.area.type == "VIEW_3D":
        tool = context.workspace.tools.from_space_view3d_mode("EDIT_CURVE", create=False)
        drawing.tool = "builtin.select_box" if tool is None else tool.idname
        bpy.ops.wm.tool_set_by_id(name=_DRAW_TOOL)
        drawing.workspaces.append(Key(context.workspace))
        context.workspace.status_text_set(_STATUS)
    drawn.begin(drawing)
    if not bpy.app.background and not bpy.app.timers.is_registered(watch):
        bpy.app.timers.register(watch, first_interval=_INTERVAL)


def _give_back(drawing: _Drawing) -> None:
    """Returns what was borrowed."""
    scene, curve = drawing.scene.find(), drawing.curve.find()
    if scene is not None:
        paint = scene.tool_settings.curve_paint_settings
        for name, value in drawing.paint.items():
            setattr(paint, name, value)
    _clear_status(drawing)
    if drawing.tool is not None:
        # Where the curve has gone by undo, any other has the same tools.
        curves = (thing for thing in bpy.data.objects if thing.type == "CURVE")
        _choose_tool(drawing.tool, curve or next(curves, None))


def _clear_status(drawing: _Drawing) -> None:
    for key in drawing.workspaces:
        workspace = key.find()
        if workspace is not None:
            with bpy.context.temp_override(workspace=workspace):
                workspace.status_text_set(None)


drawn: Activity[_Drawing] = Activity(_give_back, leave=_clear_status)


def _choose_tool(name: str, curve: bpy.types.Object | None) -> None:
    """Chooses the tool that Edit Mode of curves has, whatever mode it is now."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type != "VIEW_3D":
                continue
            region = next(region for region in area.regions if region.type == "WINDOW")
            with bpy.context.temp_override(
                window=window, area=area, region=region, edit_object=curve
            ):
                if bpy.context.mode == "EDIT_CURVE":
                    bpy.ops.wm.tool_set_by_id(name=name, space_type="VIEW_3D")
            return


def watch() -> float | None:
    """Whether the curve is still being drawn; a timer asks."""
    drawing = drawn.current
    if drawing is None:
        return None
    curve = drawing.curve.find()
    if curve is not None and curve.mode == "EDIT":
        if drawing.shows and drawing.shown != shape_count(curve):
            _show_strokes(drawing, curve)
        return _INTERVAL
    drawn.end()
    if curve is not None and curve.users_scene:
        _end(drawing, bpy.context)  # Tab is End Drawing
        push_undo("End Drawing")
        redraw("UI", "WINDOW")
    return None


def _end(drawing: _Drawing, context: bpy.types.Context) -> str:
    """Goes back to the surface, with what was drawn as its seed; the seed that it had, where
    nothing was. What the user has clicked meanwhile stays active. Returns what has become of it.
    """
    curve, surface = drawing.curve.find(), drawing.surface.find()
    layer = context.view_layer
    if surface is not None and layer.objects.active == curve:
        if layer.objects.get(surface.name) == surface:
            _activate(context, surface)
    strokes = len(curve.data.splines)
    if strokes:
        count = "one strand" if strokes == 1 else f"{strokes} strands"
        whose = surface.name if surface is not None else "nothing"
        return f"{curve.name}, {count}, is the {_IS_WHAT[drawing.setting]} of {whose}"
    setting = drawing.setting
    if surface is not None and getattr(linked_settings.settings_of(surface), setting) == curve:
        earlier = drawing.earlier.find() if drawing.earlier is not None else None
        setattr(linked_settings.settings_to_change(surface), setting, earlier)
    bpy.data.batch_remove([curve, curve.data])
    return f"Nothing was drawn; the {_IS_WHAT[setting]} is what it was"


def _show_strokes(drawing: _Drawing, curve: bpy.types.Object) -> None:
    """Shows what a run would start from, or where it would refuse to."""
    surface = drawing.surface.find()
    curve.update_from_editmode()
    drawing.problem = ""
    begin = time.perf_counter()
    if surface is None or not any(_points(spline) > 1 for spline in curve.data.splines):
        seeds.hide()
    else:
        try:
            seeds.show(surface, bpy.context)
        except (DataError, core.MeanderError) as error:
            drawing.problem = sentence_of(error)
    drawing.shows = time.perf_counter() - begin < _QUICK
    drawing.shown = shape_count(curve)
    redraw("UI")


def _points(spline: bpy.types.Spline) -> int:
    return len(spline.points) + len(spline.bezier_points)


# ------------------------------------------------------------------------------------------------
# Operators


class MEANDER_OT_draw_seed(Reasoned, bpy.types.Operator):
    """Draw the seed on the surface with the mouse"""

    bl_idname = "meander.draw_seed"
    bl_label = "Draw Seed"
    bl_description = (
        "Draw the seed on the surface with the mouse: makes a curve, the seed of this mesh, and "
        "sets up Blender's draw tool for it. Every stroke becomes a strand; End Drawing ends"
    )
    bl_options = {"REGISTER", "UNDO"}

    setting: EnumProperty(
        name="As",
        description="What the strokes are for the mesh",
        items=(
            ("seed", "Seed", "Strands to start from"),
            ("alignment_strokes", "Direction", "Strands run along them"),
        ),
        options={"HIDDEN", "SKIP_SAVE"},
    )

    @classmethod
    def description(cls, _context: bpy.types.Context, options: Any) -> str:
        if options.setting == "seed":
            return cls.bl_description
        return (
            "Draw strokes on the surface with the mouse, along which strands then run: makes a "
            "curve of directions, and sets up Blender's draw tool for it. End Drawing ends"
        )

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        active = context.active_object
        yield why_busy()
        if active is None or active.type != "MESH":
            yield "Choose the mesh to draw on"
        if not active.visible_get():
            yield "The mesh is hidden, so there is nothing to draw on"

    def execute(self, context: bpy.types.Context) -> set[str]:
        drawn.end()
        surface = context.active_object
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        curve = new_seed(surface, f"{surface.name} {_IS_WHAT[self.setting].capitalize()}", [])
        _activate(context, curve)
        bpy.ops.object.mode_set(mode="EDIT")
        _borrow(context, curve, surface, self.setting)
        settings = linked_settings.settings_to_change(surface)
        setattr(settings, self.setting, curve)
        if self.setting == "alignment_strokes":
            settings.alignment_source = "STROKES"
        return {"FINISHED"}


class MEANDER_OT_end_seed(Reasoned, bpy.types.Operator):
    """Leave Edit Mode and go back to the surface, with what was drawn as its seed or direction"""

    bl_idname = "meander.end_seed"
    bl_label = "End Drawing"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        if surface_drawn_on(context.active_object) is None:
            yield "No seed is being drawn"

    def execute(self, context: bpy.types.Context) -> set[str]:
        drawing = drawn.current
        drawn.end()
        bpy.ops.object.mode_set(mode="OBJECT")
        self.report({"INFO"}, _end(drawing, context))
        return {"FINISHED"}


def _activate(context: bpy.types.Context, object: bpy.types.Object) -> None:
    for other in list(context.selected_objects):
        other.select_set(False)
    object.select_set(True)
    context.view_layer.objects.active = object


class MEANDER_PT_drawing(Sidebar, bpy.types.Panel):
    bl_idname = "MEANDER_PT_drawing"
    bl_label = "Draw Seed"
    bl_parent_id = "MEANDER_PT_main"
    bl_options = {"HIDE_HEADER"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return surface_drawn_on(context.active_object) is not None

    def draw(self, context: bpy.types.Context) -> None:
        column = self.layout.column(align=True)
        surface = surface_drawn_on(context.active_object)
        column.label(text=f"Draw on {surface.name}", icon="GREASEPENCIL")
        if drawn.current.problem:
            notice(column, drawn.current.problem, "ERROR")
        else:
            is_seed = drawn.current.setting == "seed"
            text = "Each stroke is a strand" if is_seed else "Strands run along strokes"
            column.label(text=text, icon="BLANK1")
        row = column.row()
        row.scale_y = 1.4
        row.operator(MEANDER_OT_end_seed.bl_idname, icon="CHECKMARK")


register, unregister = registration(MEANDER_OT_draw_seed, MEANDER_OT_end_seed, MEANDER_PT_drawing)
