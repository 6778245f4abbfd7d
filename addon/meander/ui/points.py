# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel "Export"; for that of "Make", what is known of every point as an object."""

import bpy

from ..scene import look, points
from ..scene.errors import DataError
from ..scene.evaluated import matrix_of
from ..scene.linked_settings import settings_of
from ..scene.made import name_curve
from ..scene.points import strands_of_result
from ..scene.transforms import mean_scale
from .camera import MEANDER_OT_draw_camera
from .declared import rows
from .export import MEANDER_OT_export_toolpath
from .light import MEANDER_OT_make_light
from .maps import MEANDER_OT_maps
from .on_result import OnResult, result_of
from .reasons import Reasons
from .refusing import refusing, sentence_of
from .registered import registration
from .sidebar import OUTPUT, OUTPUT_ORDER, SubPanel, columns
from .unanimated import EnumProperty


class PointSettings:
    """What a run makes beside its curve, mixed into MeanderSettings."""

    points_as: EnumProperty(
        name="Points As",
        description=(
            "Make a second object of all points of the curve, with arc length, surface normal, "
            "tangent, r+, r-, triangle and weights as attributes, for Geometry Nodes and materials"
        ),
        items=(
            ("NONE", "None", "Only the curve"),
            ("MESH", "Mesh", "A mesh of points and edges"),
            ("CURVES", "Hair Curves", "A curve with attributes; Blender 4.2 or later"),
        ),
        default="NONE",
    )


class _PointsToObject(OnResult):
    bl_options = {"REGISTER", "UNDO"}
    kind = ""

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        result = result_of(context)
        surface = result.meander.surface
        depsgraph = context.evaluated_depsgraph_get()
        points.refuse(self.kind)
        strands = strands_of_result(result, depsgraph)
        matrix = matrix_of(surface, depsgraph)
        thickness = look.radius_of(result) * mean_scale(matrix)
        thing = points.make(
            self.kind, f"{result.name} Points", strands, surface, matrix, thickness
        )
        name_curve([thing], result)
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

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        try:
            points.refuse(cls.kind)
        except DataError as refusal:
            yield sentence_of(refusal)
        yield from super().reasons(context)


class MEANDER_PT_points(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_points"
    bl_label = "Export"
    bl_parent_id = OUTPUT
    bl_order = OUTPUT_ORDER["export"]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return result_of(context) is not None and super().poll(context)

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        layout.operator_context = "INVOKE_DEFAULT"
        column = layout.column(align=True)
        column.operator(MEANDER_OT_export_toolpath.bl_idname, icon="EXPORT")
        column.operator(MEANDER_OT_maps.bl_idname, icon="IMAGE_DATA")
        column.operator(MEANDER_OT_draw_camera.bl_idname, icon="CAMERA_DATA")


def draw_light_and_points(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Fewer points of the next result or of this one, and all of them as an object."""
    active, result = context.active_object, result_of(context)
    rows(layout, settings_of(active), "Make")
    if result is not None:
        layout.operator(MEANDER_OT_make_light.bl_idname, icon="MOD_DECIM")
        _draw_counts(layout, result)
    layout.prop(settings_of(active), "points_as")
    if result is not None:
        column = layout.column(align=True)
        column.operator(MEANDER_OT_points_to_mesh.bl_idname, icon="MESH_DATA")
        column.operator(MEANDER_OT_points_to_curves.bl_idname, icon="CURVES_DATA")


def _draw_counts(layout: bpy.types.UILayout, result: bpy.types.Object) -> None:
    """How light it is, where it is not the whole curve."""
    whole = result.meander.figures.whole_points
    if whole and result.meander.use_light:
        row = layout.row()
        row.active = False
        count = sum(len(spline.points) for spline in result.data.splines)
        row.label(text=f"{count:,} of {whole:,} points")


register, unregister = registration(
    MEANDER_OT_points_to_mesh,
    MEANDER_OT_points_to_curves,
    MEANDER_PT_points,
)
