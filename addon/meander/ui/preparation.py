# SPDX-License-Identifier: GPL-3.0-or-later
"""The part to fill, its boundary and faults of the mesh: settings, panels, Show Faults."""

import bpy

from .. import core
from ..model.preparation import faults_in_words
from ..run import notes
from ..run.lasting import why_busy
from ..scene import preparation
from ..scene.attributes import mask_names
from ..scene.linked_settings import settings_of
from ..scene.meshes import triangles_of
from ..scene.results import shown_result
from ..scene.settings import surface_of
from .declared import row, switch
from .reasons import Reasoned, Reasons
from .refusing import refusing
from .registered import registration
from .sidebar import (
    ADVANCED,
    ADVANCED_ORDER,
    GUIDANCE,
    GUIDANCE_ORDER,
    SubPanel,
    columns,
    notice,
)
from .unanimated import EnumProperty, StringProperty


class PreparationSettings:
    """The part of MeanderSettings that says what is done to the mesh, and which part is filled."""

    mask_source: EnumProperty(
        name="Fill",
        description="Which part of the mesh the curve fills; its edge acts as a boundary",
        items=(
            ("NONE", "Whole Mesh", "All faces"),
            ("MATERIAL", "Material", "The faces that have a material"),
            ("ATTRIBUTE", "Face Attribute", "The faces for which an attribute is true or not 0"),
            ("GROUP", "Vertex Group", "Where the weight is high enough, also across faces"),
        ),
        default="NONE",
    )
    mask_material: StringProperty(
        name="Material", description="Only faces with this material are filled"
    )
    mask_attribute: StringProperty(
        name="Attribute",
        description=(
            "Boolean or integer attribute of faces, or a face map in Blender before 4.0; faces "
            "where it is false or 0 are left out"
        ),
        search=mask_names,
        search_options={"SUGGESTION"},
    )
    mask_group: StringProperty(
        name="Group",
        description="Vertex group; what has less than the threshold is left out",
    )


class MeanderProblem(bpy.types.PropertyGroup):
    """Why the mesh was refused last."""

    sentence: StringProperty(name="Sentence")  # empty: it was not


class MEANDER_OT_select_problem(Reasoned, bpy.types.Operator):
    """Select all faults of the mesh in Edit Mode and bring them into view"""

    bl_idname = "meander.select_problem"
    bl_label = "Show Faults"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        surface = surface_of(context.active_object)
        yield why_busy()
        if surface is None or surface.type != "MESH":
            yield "Choose a mesh, or a curve that Meander has made on one"
        if surface.library is not None or surface.data.library is not None:
            yield "The mesh is linked from another file and cannot be edited"
        if not surface.visible_get():
            yield "The mesh is hidden"

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        surface = surface_of(context.active_object)
        spacing = settings_of(context.active_object).spacing
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        if not spacing:
            depsgraph = context.evaluated_depsgraph_get()
            spacing = core.automatic_spacing(*triangles_of(surface, depsgraph))
        preparation.locate_faults(surface, spacing / 2.0)
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
        located = preparation.locate_faults(surface, spacing / 2.0)
        preparation.select_located(surface.data, located)
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_mode(type=located.mode)
        if core.FAULTS.index("not_finite") not in located.faults.kinds:
            _view_selected(context)
        self.report({"INFO"}, f"{surface.name}: {faults_in_words(located.faults)}")
        return {"FINISHED"}


def _view_selected(context: bpy.types.Context) -> None:
    """Frames what is selected in the 3D view of the button, or else in all of the window."""
    if context.window is None or bpy.app.background:
        return
    here = context.area
    own = here is not None and here.type == "VIEW_3D"
    for area in [here] if own else context.window.screen.areas:
        if area.type != "VIEW_3D":
            continue
        region = next(region for region in area.regions if region.type == "WINDOW")
        with context.temp_override(area=area, region=region):
            bpy.ops.view3d.view_selected()


def draw_faults(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """What was refused last, and why the mesh was, or how much of it was repaired, with the button
    that shows where."""
    active = context.active_object
    surface, result = surface_of(active), shown_result(active, context.scene)
    count = result.meander.figures.mended if result is not None else 0
    sentence, note = settings_of(surface).problem.sentence, notes.of(active)
    if note and note != sentence:
        notice(layout, note, "ERROR")
    if not sentence and not count:
        return
    column = layout.column(align=True)
    if sentence:
        notice(column, sentence.partition(";")[0], "ERROR")
    else:
        column.label(text=f"{count:,} repaired", icon="CHECKMARK")
    if surface.type == "MESH":  # there is nothing to select in others
        column.operator(MEANDER_OT_select_problem.bl_idname, icon="RESTRICT_SELECT_OFF")


class MEANDER_PT_mask(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_mask"
    bl_label = "Region"
    bl_parent_id = GUIDANCE
    bl_order = GUIDANCE_ORDER["region"]

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        active = context.active_object
        settings: bpy.types.PropertyGroup = settings_of(active)
        in_edit_mode = active.type == "MESH" and active.mode == "EDIT"
        selected = active.data.total_face_sel if in_edit_mode else 0
        if selected:
            notice(layout, f"{selected:,} selected faces", "RESTRICT_SELECT_OFF")
        part = layout.column()
        part.active = not selected  # which come before what is chosen here
        part.prop(settings, "mask_source")
        source = settings.mask_source
        if source != "NONE":
            surface = surface_of(active)
            if source == "MATERIAL":
                part.prop_search(settings, "mask_material", surface, "material_slots")
            elif source == "ATTRIBUTE":
                part.prop(settings, "mask_attribute", icon="SPREADSHEET")
            else:
                part.prop_search(settings, "mask_group", surface, "vertex_groups")
                row(part, settings, "mask_threshold")
            row(part, settings, "mask_inverted")
        row(layout, settings, "smallest_part")
        row(layout, settings, "border_distance")
        row(layout, settings, "use_outline")


class MEANDER_PT_repair(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_repair"
    bl_label = "Mesh Repair"
    bl_parent_id = ADVANCED
    bl_order = ADVANCED_ORDER["repair"]

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        settings: bpy.types.PropertyGroup = settings_of(context.active_object)
        switch(layout, settings, "strict")
        switch(layout, settings, "use_merge")
        column = layout.column()
        column.active = settings.use_merge
        row(column, settings, "merge_distance")
        column = layout.column(align=True)
        switch(column, settings, "cut_non_manifold")
        sub = column.column(align=True)
        sub.active = settings.strict  # else done in any case
        switch(sub, settings, "drop_degenerate")
        switch(sub, settings, "split_bow_ties")
        result = shown_result(context.active_object, context.scene)
        if result is not None:
            notice(column, result.meander.figures.preparation)


register, unregister = registration(MEANDER_OT_select_problem, MEANDER_PT_mask, MEANDER_PT_repair)
