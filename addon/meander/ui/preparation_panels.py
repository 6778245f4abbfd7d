# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels for the part to fill, its border and faults of the mesh; the button Select Problem."""

from __future__ import annotations

import bpy

from ..run import session
from ..scene import refused_element
from ..scene.errors import DataError
from ..scene.settings import surface_of
from .declared import row
from .settings import MeanderSettings
from .sidebar import ADVANCED, ADVANCED_ORDER, ORDER, SubPanel, columns


class MEANDER_OT_select_problem(bpy.types.Operator):
    """Select, in Edit Mode, the element because of which the mesh was refused"""

    bl_idname = "meander.select_problem"
    bl_label = "Select Problem"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        surface = surface_of(context.active_object)
        if session.current() is not None:
            cls.poll_message_set("A curve is growing")
        elif surface is None or not surface.meander.problem.kind:
            cls.poll_message_set("No element of this mesh has been refused")
        elif surface.library is not None or surface.data.library is not None:
            cls.poll_message_set("The mesh is linked from another file and cannot be edited")
        elif not surface.visible_get():
            cls.poll_message_set("The mesh is hidden")
        else:
            return True
        return False

    def execute(self, context: bpy.types.Context) -> set[str]:
        surface = surface_of(context.active_object)
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        depsgraph = context.evaluated_depsgraph_get()
        try:
            refused_element.locate_problem(surface, depsgraph)
        except DataError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for other in list(context.selected_objects):
            other.select_set(False)
        surface.select_set(True)
        context.view_layer.objects.active = surface
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.reveal(select=False)
        bpy.ops.mesh.select_mode(type="VERT")
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.object.mode_set(mode="OBJECT")
        # Only now: switching modes recreates the elements of the mesh.
        mode, elements = refused_element.locate_problem(surface, depsgraph)
        for element in elements:
            element.select = True
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_mode(type=mode)
        self.report({"INFO"}, f"{surface.name}: {surface.meander.problem.sentence}")
        return {"FINISHED"}


class MEANDER_PT_mask(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_mask"
    bl_label = "Region"
    bl_order = ORDER["region"]
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        active = context.active_object
        settings: MeanderSettings = active.meander
        layout.prop(settings, "mask_source")
        source = settings.mask_source
        if source != "NONE":
            surface = surface_of(active)
            if source == "MATERIAL":
                layout.prop_search(settings, "mask_material", surface, "material_slots")
            elif source == "ATTRIBUTE":
                layout.prop(settings, "mask_attribute", icon="SPREADSHEET")
            else:
                layout.prop_search(settings, "mask_group", surface, "vertex_groups")
                layout.prop(settings, "mask_threshold")
            layout.prop(settings, "mask_inverted")
        row(layout, settings, "border_distance")
        row(layout, settings, "use_outline")


class MEANDER_PT_repair(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_repair"
    bl_label = "Mesh Repair"
    bl_parent_id = ADVANCED
    bl_order = ADVANCED_ORDER["repair"]
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        settings: MeanderSettings = context.active_object.meander
        column = layout.column(heading="Merge Close Vertices")
        row = column.row(align=True)
        row.prop(settings, "use_merge", text="")
        sub = row.row(align=True)
        sub.active = settings.use_merge
        sub.prop(settings, "merge_distance", text="")
        column = layout.column(align=True)
        column.prop(settings, "drop_degenerate")
        column.prop(settings, "split_bow_ties")
        column.prop(settings, "cut_non_manifold")
        if surface_of(context.active_object).meander.problem.kind:
            layout.operator(MEANDER_OT_select_problem.bl_idname, icon="RESTRICT_SELECT_OFF")


_CLASSES = (MEANDER_OT_select_problem, MEANDER_PT_mask, MEANDER_PT_repair)


def register() -> None:
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
