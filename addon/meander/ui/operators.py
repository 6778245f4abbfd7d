# SPDX-License-Identifier: GPL-3.0-or-later
"""The button beside the spacing: propose one."""

import bpy

from ..scene.errors import DataError
from ..scene.fillable import why_not
from ..scene.meshes import proposed_spacing, triangles_of
from ..scene.settings import surface_of
from .run_operators import sentence_of


class MEANDER_OT_propose_spacing(bpy.types.Operator):
    """Set a spacing that suits the size of the surface and is filled in seconds"""

    bl_idname = "meander.propose_spacing"
    bl_label = "Propose Spacing"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if surface_of(context.active_object) is None:
            cls.poll_message_set(why_not(context.active_object))
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        active = context.active_object
        depsgraph = context.evaluated_depsgraph_get()
        try:
            triangles = triangles_of(surface_of(active), depsgraph)
        except DataError as error:
            self.report({"ERROR"}, sentence_of(error))
            return {"CANCELLED"}
        active.meander.spacing = proposed_spacing(*triangles)
        return {"FINISHED"}


_CLASSES = (MEANDER_OT_propose_spacing,)


def register() -> None:
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
