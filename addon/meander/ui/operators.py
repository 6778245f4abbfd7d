# SPDX-License-Identifier: GPL-3.0-or-later
"""The buttons at the settings of a mesh: propose a spacing; choose settings for a linked one."""

import bpy

from .. import core
from ..run.window import redraw
from ..scene.linked_settings import can_be_changed, settings_to_change
from ..scene.meshes import triangles_of
from ..scene.settings import surface_of
from .on_result import OnSettings
from .reasons import Reasoned, Reasons
from .refusing import refusing
from .registered import registration


class MEANDER_OT_propose_spacing(OnSettings, bpy.types.Operator):
    """Set a spacing that suits the size of the surface and is filled in seconds"""

    bl_idname = "meander.propose_spacing"
    bl_label = "Propose Spacing"
    bl_options = {"REGISTER", "UNDO"}

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        active = context.active_object
        depsgraph = context.evaluated_depsgraph_get()
        triangles = triangles_of(surface_of(active), depsgraph)
        settings_to_change(active).spacing = core.automatic_spacing(*triangles)
        return {"FINISHED"}


class MEANDER_OT_choose_settings(Reasoned, bpy.types.Operator):
    """Keep settings for this linked mesh in this file. They begin as its own file has them"""

    bl_idname = "meander.choose_settings"
    bl_label = "Choose Settings"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        active = context.active_object
        if surface_of(active) is not active or active is None:
            yield "Choose a mesh that is linked from another file"
        if can_be_changed(active):
            yield "The settings can be changed"

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings_to_change(context.active_object)
        redraw("UI")
        return {"FINISHED"}


register, unregister = registration(MEANDER_OT_propose_spacing, MEANDER_OT_choose_settings)
