# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel "Seed and Strands": the seed, a stroke, guides, and parts that they leave out."""

from __future__ import annotations

import bmesh
import bpy

from ..run import session
from ..scene.curve_writer import new_curve_object
from .settings import MeanderSettings
from .sidebar import ORDER, SubPanel, columns, notice


class MEANDER_OT_stroke_from_vertices(bpy.types.Operator):
    """Make a two-point curve of the two selected vertices, and the seed of this mesh of it"""

    bl_idname = "meander.stroke_from_vertices"
    bl_label = "Stroke from Selected Vertices"
    bl_description = (
        "Make a curve of two points at the two selected vertices, and the seed of it: one stroke "
        "from one to the other then fills the surface, with its ends where they are"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        active = context.active_object
        if session.current() is not None:
            cls.poll_message_set("A curve is growing")
        elif active is None or active.type != "MESH" or active.mode != "EDIT":
            cls.poll_message_set("Select two vertices of a mesh in Edit Mode")
        elif active.library is not None or active.data.library is not None:
            cls.poll_message_set("The mesh is linked from another file and cannot be changed")
        else:
            return True
        return False

    def execute(self, context: bpy.types.Context) -> set[str]:
        mesh_object = context.active_object
        mesh = bmesh.from_edit_mesh(mesh_object.data)
        # As they were selected, where Blender knows.
        picked = [item for item in mesh.select_history if isinstance(item, bmesh.types.BMVert)]
        others = [vertex for vertex in mesh.verts if vertex.select and vertex not in picked]
        ends = [vertex.co[:] for vertex in picked + others]
        if len(ends) != 2:
            self.report({"ERROR"}, f"{len(ends)} vertices are selected; select two, the ends")
            return {"CANCELLED"}
        stroke = new_curve_object(f"{mesh_object.name} Stroke", mesh_object)
        stroke.data.dimensions = "3D"
        spline = stroke.data.splines.new("POLY")
        spline.points.add(1)
        for point, place in zip(spline.points, ends, strict=True):
            point.co = (*place, 1.0)
        mesh_object.meander.seed = stroke
        mesh_object.meander.fixed_ends = True
        self.report({"INFO"}, f"{stroke.name} is the seed of {mesh_object.name}")
        return {"FINISHED"}


class MEANDER_PT_strands(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_strands"
    bl_label = "Seed and Strands"
    bl_order = ORDER["strands"]
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        active = context.active_object
        settings: MeanderSettings = active.meander
        layout.prop(settings, "seed", icon="CURVE_DATA")
        stroke = layout.column(align=True)
        stroke.active = settings.seed is None
        stroke.prop(settings, "stroke_from", text="Stroke From")
        stroke.prop(settings, "stroke_to", text="To")
        if active.mode == "EDIT" and active.type == "MESH":
            layout.operator(MEANDER_OT_stroke_from_vertices.bl_idname, icon="VERTEXSEL")
        layout.prop(settings, "fixed_ends")
        layout.prop(settings, "seed_every_part")
        guides = layout.column(align=True)
        guides.prop(settings, "guides", icon="CURVE_DATA")
        guides.prop(settings, "guide_collection")
        row = layout.row()
        row.active = bool(settings.guides or settings.guide_collection)
        row.prop(settings, "keep_guides")
        if active.meander.figures.empty_parts:
            notice(layout, "Parts of the mesh are empty", "ERROR")


_CLASSES = (MEANDER_OT_stroke_from_vertices, MEANDER_PT_strands)


def register() -> None:
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
