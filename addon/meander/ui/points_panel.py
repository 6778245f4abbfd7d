# SPDX-License-Identifier: GPL-3.0-or-later
"""What is known of every point of a result: as a file for machines, as attributes of an object."""

from __future__ import annotations

from pathlib import Path

import bpy
from bpy.props import EnumProperty, FloatProperty, StringProperty

from .. import core
from ..model import toolpath
from ..model.whole_files import FileError
from ..scene import point_attributes
from ..scene.errors import DataError
from ..scene.surface_points import strands_of_result
from ..scene.transforms import mean_scale, world_matrix
from .declared import rows
from .light_operator import MEANDER_OT_make_light
from .on_result import OnResult
from .sidebar import ORDER, SubPanel, columns

_SUFFIXES = {"CSV": ".csv", "JSON": ".json"}


class MEANDER_OT_export_toolpath(OnResult, bpy.types.Operator):
    """Write the points of the curve in order, with surface normals, for machines"""

    bl_idname = "meander.export_toolpath"
    bl_label = "Export Toolpath"

    filepath: StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})
    file_format: EnumProperty(
        name="Format",
        description="Format of the file",
        items=(
            ("CSV", "CSV", "A row for every point"),
            ("JSON", "JSON", "A list of strands"),
        ),
    )
    resample: EnumProperty(
        name="Points",
        description="Which points are written",
        items=(
            ("ALL", "All", "Every point of the curve"),
            ("STEP", "By Step", "At equal arc lengths along each strand"),
            ("TOLERANCE", "By Tolerance", "As few as keep the chords between them near the curve"),
        ),
    )
    step: FloatProperty(
        name="Step",
        description="Largest arc length between two points",
        unit="LENGTH",
        default=0.01,
        min=1e-6,
    )
    tolerance: FloatProperty(
        name="Tolerance",
        description="Largest distance of the chord between two points from the curve",
        unit="LENGTH",
        default=0.001,
        min=1e-9,
        precision=4,
    )

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "file_format")
        layout.prop(self, "resample")
        if self.resample == "STEP":
            layout.prop(self, "step")
        elif self.resample == "TOLERANCE":
            layout.prop(self, "tolerance")

    def check(self, _context: bpy.types.Context) -> bool:
        changed = self._with_suffix()
        if str(changed) == self.filepath:
            return False
        self.filepath = str(changed)
        return True

    def _with_suffix(self) -> Path:
        path = Path(self.filepath)
        known = path.suffix.lower() in toolpath.SUFFIXES
        suffix = _SUFFIXES[self.file_format]
        return path.with_suffix(suffix) if known else path.with_name(path.name + suffix)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if not self.filepath:
            self.filepath = bpy.path.clean_name(context.active_object.name)
        self.filepath = str(self._with_suffix())
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        result = context.active_object
        try:
            strands = strands_of_result(
                result,
                context.evaluated_depsgraph_get(),
                self.step if self.resample == "STEP" else None,
                self.tolerance if self.resample == "TOLERANCE" else None,
            )
            path = self._with_suffix()
            toolpath.write(path, strands, core.VERSION)
        except (DataError, core.MeanderError, FileError) as error:
            text = str(error)
            self.report({"ERROR"}, text[:1].upper() + text[1:])
            return {"CANCELLED"}
        count = sum(len(strand.points) for strand in strands)
        self.report({"INFO"}, f"{path.name}: {count:,} points in {len(strands):,} strands")
        return {"FINISHED"}


class _PointsToObject(OnResult):
    bl_options = {"REGISTER", "UNDO"}
    kind = ""

    def execute(self, context: bpy.types.Context) -> set[str]:
        result = context.active_object
        surface = result.meander.surface
        depsgraph = context.evaluated_depsgraph_get()
        try:
            point_attributes.refuse(self.kind)
            strands = strands_of_result(result, depsgraph)
        except DataError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        matrix = world_matrix(surface.evaluated_get(depsgraph))
        thickness = result.data.bevel_depth * mean_scale(matrix)
        thing = point_attributes.make(
            self.kind, f"{result.name} Points", strands, surface, matrix, thickness
        )
        count = sum(len(strand.points) for strand in strands)
        self.report({"INFO"}, f"{thing.name}: {count:,} points with attributes")
        if any(strand.radii is None for strand in strands):
            self.report(
                {"WARNING"},
                f"{result.name} has been changed since its run, so r+ and r- are not known; "
                "Continue finds them",
            )
        return {"FINISHED"}


class MEANDER_OT_points_to_mesh(_PointsToObject, bpy.types.Operator):
    bl_idname = "meander.points_to_mesh"
    bl_label = "Points to Mesh"
    bl_description = (
        "Make a mesh of the points and edges of the curve, with arc length, normal, tangent, r+, "
        "r-, strand, triangle and weights as attributes for Geometry Nodes and materials"
    )
    kind = "MESH"


class MEANDER_OT_points_to_curves(_PointsToObject, bpy.types.Operator):
    bl_idname = "meander.points_to_curves"
    bl_label = "Points to Hair Curves"
    bl_description = (
        "Make hair curves of the points of the curve, with arc length, normal, tangent, r+, r-, "
        "strand, triangle and weights as attributes; Blender 4.2 or later"
    )
    kind = "CURVES"


class MEANDER_PT_points(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_points"
    bl_label = "Export"
    bl_order = ORDER["export"]
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        active = context.active_object
        rows(layout, active.meander, "Export")
        if active.type == "CURVE":
            layout.operator(MEANDER_OT_make_light.bl_idname, icon="MOD_DECIM")
        layout.prop(active.meander, "points_as")
        if active.type != "CURVE":
            return
        layout.operator_context = "INVOKE_DEFAULT"
        column = layout.column(align=True)
        column.operator(MEANDER_OT_export_toolpath.bl_idname, icon="EXPORT")
        column.operator(MEANDER_OT_points_to_mesh.bl_idname, icon="MESH_DATA")
        column.operator(MEANDER_OT_points_to_curves.bl_idname, icon="CURVES_DATA")


_CLASSES = (
    MEANDER_OT_export_toolpath,
    MEANDER_OT_points_to_mesh,
    MEANDER_OT_points_to_curves,
    MEANDER_PT_points,
)


def register() -> None:
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
