# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel "Motion": Follow, Bake Motion, Bake Growth, Animate Growth, and its settings."""

from typing import Any

import bpy
from bpy.props import IntProperty

from ..run import bake as baking
from ..run import motion
from ..run.lasting import why_busy
from ..scene import bake as baked_frames
from ..scene.fillable import is_result
from .declared import switch
from .on_result import OnOwnResult, result_of
from .reasons import Reasoned, Reasons, not_in_object_mode
from .refusing import refusing
from .registered import registration
from .sidebar import OUTPUT, OUTPUT_ORDER, SubPanel, columns, notice
from .unanimated import BoolProperty, PointerProperty


def _begin_again(settings: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """What follows was made for the settings as they were."""
    motion.begin(settings.id_data, context)


class FollowSettings:
    """Settings on a result, mixed into MeanderSettings."""

    follow: BoolProperty(
        name="Follow",
        description=(
            "Update the curve whenever the frame changes. It needs this add-on: bake the frames "
            "for files that render elsewhere"
        ),
        default=False,
        update=_begin_again,
    )
    bake: PointerProperty(
        type=bpy.types.Collection,
        name="Baked Frames",
        description="The collection of the frames that were baked from this curve",
    )


class _OnResult(OnOwnResult):
    bl_options = {"REGISTER", "UNDO"}

    def _bake(self, context: bpy.types.Context, bake: Any, *arguments: Any) -> set[str]:
        result = result_of(context)
        collection = bake(result, context, *arguments)
        _activate_surface(context, result)
        motion.forget()
        count = len(collection.objects)
        frames = "1 object" if count == 1 else f"{count} objects"
        self.report({"INFO"}, f"{collection.name}: {frames}; {result.name} is hidden")
        return {"FINISHED"}


def _activate_surface(context: bpy.types.Context, result: bpy.types.Object) -> None:
    """Makes the surface active in place of its result, which is hidden: the panel goes on there."""
    surface, layer = result.meander.surface, context.view_layer
    if layer.objects.get(surface.name) == surface and surface.visible_get(view_layer=layer):
        layer.objects.active = surface


class MEANDER_OT_bake_motion(_OnResult, bpy.types.Operator):
    """Write the curve of every frame into the file, so that it renders without this add-on"""

    bl_idname = "meander.bake_motion"
    bl_label = "Bake Motion"

    frame_start: IntProperty(
        name="Start", description="First frame; the scene's if it is after the end", default=1
    )
    frame_end: IntProperty(name="End", description="Last frame", default=0)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self.frame_start, self.frame_end = context.scene.frame_start, context.scene.frame_end
        return context.window_manager.invoke_props_dialog(self)

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        first, last = self.frame_start, self.frame_end
        if first > last:
            first, last = context.scene.frame_start, context.scene.frame_end
        return self._bake(context, baking.bake_motion, first, last)


class MEANDER_OT_bake_growth(_OnResult, bpy.types.Operator):
    """Grow the curve again from its seed, and write the stages of its growth into the file"""

    bl_idname = "meander.bake_growth"
    bl_label = "Bake Growth"

    every: IntProperty(
        name="Iterations per Frame",
        description="Fewer make the growth slower, and the file larger",
        default=4,
        min=1,
        soft_max=50,
    )

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return context.window_manager.invoke_props_dialog(self)

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        return self._bake(context, baking.bake_growth, context.scene.frame_start, self.every)


class MEANDER_OT_animate_growth(_OnResult, bpy.types.Operator):
    """Grow the curve again from its seed, and make one object of it that shows how it grew"""

    bl_idname = "meander.animate_growth"
    bl_label = "Animate Growth"
    bl_description = (
        "Grow the curve again from its seed, and make one object that shows how it grew, by a "
        "factor that has keys. It renders without this add-on"
    )

    frames: IntProperty(
        name="Frames",
        description="How long the growth takes, from the first frame of the scene on",
        default=96,
        min=2,
        soft_max=500,
    )

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return context.window_manager.invoke_props_dialog(self)

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        result, first = result_of(context), context.scene.frame_start
        last = first + self.frames - 1
        collection, stages = baking.animate_growth(result, context, first, last)
        _activate_surface(context, result)
        motion.forget()
        made = collection.objects[0].name
        self.report({"INFO"}, f"{made}: {stages} stages in one object; {result.name} is hidden")
        return {"FINISHED"}


class MEANDER_OT_clear_bake(Reasoned, bpy.types.Operator):
    """Delete the baked frames of this curve, and show the curve itself again"""

    bl_idname = "meander.clear_bake"
    bl_label = "Delete Bake"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        result = baked_frames.baked_result(context.active_object)
        yield why_busy()
        if result is None:
            yield "Choose a curve with baked frames, one of them, or its mesh"
        yield not_in_object_mode(context)
        if result.library is not None:
            yield "The curve is linked from another file"

    def execute(self, context: bpy.types.Context) -> set[str]:
        active = context.active_object
        result = baked_frames.baked_result(active)
        of_frame = active not in (result, result.meander.surface)
        baked_frames.clear(result)
        if of_frame and context.view_layer.objects.get(result.name) == result:
            context.view_layer.objects.active = result
        return {"FINISHED"}


class MEANDER_PT_motion(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_motion"
    bl_label = "Motion"
    bl_parent_id = OUTPUT
    bl_order = OUTPUT_ORDER["motion"]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        active = context.active_object
        if baked_frames.baked_result(active) is not None:
            return True
        return is_result(active) and super().poll(context)

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        result = context.active_object
        if not is_result(result):
            notice(layout, f"{baked_frames.baked_result(result).name} is hidden")
            layout.operator(MEANDER_OT_clear_bake.bl_idname, icon="TRASH")
            return
        settings: bpy.types.PropertyGroup = result.meander
        layout.prop(settings, "motion")
        row = layout.row()
        row.active = settings.motion == "EVEN"
        row.prop(settings, "motion_steps")
        layout.prop(settings, "motion_subframes")
        switch(layout, settings, "follow")
        problem = motion.problem_of(result) if settings.follow else None
        if problem:
            notice(layout, problem, "ERROR")
        elif settings.follow and not context.scene.render.use_lock_interface:
            notice(layout, "Bake before rendering")
        layout.operator_context = "INVOKE_DEFAULT"
        column = layout.column(align=True)
        column.operator(MEANDER_OT_bake_motion.bl_idname, icon="RENDER_ANIMATION")
        column.operator(MEANDER_OT_bake_growth.bl_idname, icon="FORCE_CURVE")
        column.operator(MEANDER_OT_animate_growth.bl_idname, icon="ANIM")
        if settings.bake is not None:
            column.operator(MEANDER_OT_clear_bake.bl_idname, icon="TRASH")


register, unregister = registration(
    MEANDER_OT_bake_motion,
    MEANDER_OT_bake_growth,
    MEANDER_OT_animate_growth,
    MEANDER_OT_clear_bake,
    MEANDER_PT_motion,
)
