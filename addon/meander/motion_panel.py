# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel "Motion": Follow, Bake Motion, Bake Growth; what happens when frames change."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.handlers import persistent
from bpy.props import IntProperty

from . import core, motion, session
from .blender_data import DataError
from .properties import MeanderSettings
from .sidebar import ORDER, SubPanel, columns, notice

# Followers of the results that follow, by name and library: what they know is not in the file, and
# whatever may have changed it (undo, another file) makes new ones necessary.
_followers: dict[session.Key, motion.Follower] = {}
# Why a result does not follow, for the panel.
_problems: dict[session.Key, str] = {}
_rendering = False


def forget() -> None:
    """Lets every follower begin again with its curve as it is."""
    _followers.clear()
    _problems.clear()


def begin(result: bpy.types.Object, context: bpy.types.Context) -> None:
    """Lets a result follow from the present frame on, in which its curve fits, or no more."""
    key = session.Key.of(result)
    _followers.pop(key, None)
    _problems.pop(key, None)
    settings: MeanderSettings = result.meander
    if not settings.follow or settings.surface is None or session.current() is not None:
        return
    try:
        depsgraph = context.evaluated_depsgraph_get()
        _followers[key] = motion.follower_of(result, context.scene, depsgraph)
    except (DataError, core.MeanderError) as error:
        _problems[key] = str(error)


def _may_change(scene: bpy.types.Scene) -> bool:
    """A render in a window runs on a thread of its own while the window draws the same data."""
    return not _rendering or bpy.app.background or scene.render.use_lock_interface


@persistent
def _on_frame(scene: bpy.types.Scene, depsgraph: Any = None) -> None:
    results = [thing for thing in scene.objects if thing.type == "CURVE" and thing.meander.follow]
    if not results or session.current() is not None or not _may_change(scene):
        return
    depsgraph = depsgraph or bpy.context.evaluated_depsgraph_get()
    for result in results:
        surface = result.meander.surface
        if surface is None or result.library or result.data.library or result.mode != "OBJECT":
            continue
        key = session.Key.of(result)
        try:
            if key not in _followers:
                _followers[key] = motion.follower_of(result, scene, depsgraph)
            vertices, faces, matrix = motion.surface_now(surface, depsgraph)
            curve = _followers[key].moved(vertices, faces)
            motion.write(result, result.data, curve, matrix, _followers[key].factors)
            _problems.pop(key, None)
        except (DataError, core.MeanderError) as error:
            # A handler has nobody to report to; the panel shows it.
            _followers.pop(key, None)
            _problems[key] = str(error)


@persistent
def _on_change(*_arguments: object) -> None:
    forget()


@persistent
def _on_load(*_arguments: object) -> None:
    """A file is opened in the frame in which its curves fit; the next one may be far away."""
    context = bpy.context
    for result in context.scene.objects:
        if result.type == "CURVE" and result.meander.follow:
            begin(result, context)


@persistent
def _on_render(*_arguments: object) -> None:
    global _rendering
    _rendering = True


@persistent
def _on_render_end(*_arguments: object) -> None:
    global _rendering
    _rendering = False


_HANDLERS = (
    ("frame_change_post", _on_frame),
    ("undo_post", _on_change),
    ("redo_post", _on_change),
    ("load_pre", _on_change),
    ("load_post", _on_load),
    ("render_init", _on_render),
    ("render_complete", _on_render_end),
    ("render_cancel", _on_render_end),
)


class _OnResult:
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        active = context.active_object
        if session.current() is not None:
            cls.poll_message_set("A curve is growing")
        elif active is None or active.type != "CURVE" or active.meander.surface is None:
            cls.poll_message_set("Choose a curve that Meander has made")
        elif active.library is not None or active.data.library is not None:
            cls.poll_message_set("The curve is linked from another file")
        elif context.mode != "OBJECT":
            cls.poll_message_set("Works in Object Mode")
        else:
            return True
        return False

    def _bake(self, context: bpy.types.Context, bake: Any, *arguments: Any) -> set[str]:
        result = context.active_object
        try:
            collection = bake(result, context, *arguments)
        except (DataError, core.MeanderError) as error:
            text = str(error)
            self.report({"ERROR"}, text[:1].upper() + text[1:])
            return {"CANCELLED"}
        forget()
        count = len(collection.objects)
        self.report({"INFO"}, f"{collection.name}: {count} objects; {result.name} is hidden")
        return {"FINISHED"}


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

    def execute(self, context: bpy.types.Context) -> set[str]:
        first, last = self.frame_start, self.frame_end
        if first > last:
            first, last = context.scene.frame_start, context.scene.frame_end
        return self._bake(context, motion.bake_motion, first, last)


class MEANDER_OT_bake_growth(_OnResult, bpy.types.Operator):
    """Grow the curve anew from its seed, and write what it looks like on the way into the file"""

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

    def execute(self, context: bpy.types.Context) -> set[str]:
        return self._bake(context, motion.bake_growth, context.scene.frame_start, self.every)


class MEANDER_OT_clear_bake(_OnResult, bpy.types.Operator):
    """Take the baked frames of this curve away and show the curve itself again"""

    bl_idname = "meander.clear_bake"
    bl_label = "Delete Bake"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not super().poll(context):
            return False
        if context.active_object.meander.bake is None:
            cls.poll_message_set("This curve has no baked frames")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        motion.clear(context.active_object)
        return {"FINISHED"}


class MEANDER_PT_motion(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_motion"
    bl_label = "Motion"
    bl_order = ORDER["motion"]
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        active = context.active_object
        return active is not None and active.type == "CURVE" and super().poll(context)

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        result = context.active_object
        settings: MeanderSettings = result.meander
        layout.prop(settings, "motion")
        row = layout.row()
        row.active = settings.motion == "EVEN"
        row.prop(settings, "motion_steps")
        layout.prop(settings, "follow")
        problem = _problems.get(session.Key.of(result)) if settings.follow else None
        if problem:
            notice(layout, problem, "ERROR")
        elif settings.follow and not context.scene.render.use_lock_interface:
            notice(layout, "Bake before rendering")
        layout.operator_context = "INVOKE_DEFAULT"
        column = layout.column(align=True)
        column.operator(MEANDER_OT_bake_motion.bl_idname, icon="RENDER_ANIMATION")
        column.operator(MEANDER_OT_bake_growth.bl_idname, icon="FORCE_CURVE")
        if settings.bake is not None:
            column.operator(MEANDER_OT_clear_bake.bl_idname, icon="TRASH")


_CLASSES = (
    MEANDER_OT_bake_motion,
    MEANDER_OT_bake_growth,
    MEANDER_OT_clear_bake,
    MEANDER_PT_motion,
)


def register() -> None:
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).remove(handler)
    forget()
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
