# SPDX-License-Identifier: GPL-3.0-or-later
"""Which direction the strands follow: settings on an object, and the panel "Direction"."""

import bpy

from ..scene.attributes import attribute_names, color_names, vector_names
from ..scene.curve_reader import has_strands
from ..scene.linked_settings import owner_of, settings_of
from ..scene.settings import surface_of
from .declared import row
from .registered import registration
from .sidebar import GUIDANCE, GUIDANCE_ORDER, SubPanel, columns
from .unanimated import EnumProperty, PointerProperty, StringProperty


def _is_curve(settings: bpy.types.PropertyGroup, object: bpy.types.Object) -> bool:
    return has_strands(object) and object != owner_of(settings)


class AlignmentSettings:
    """The part of MeanderSettings that says which direction the strands follow."""

    alignment_source: EnumProperty(
        name="Along",
        description="The directions that strands run along; their spacing stays the same",
        items=(
            ("NONE", "None", "No direction is preferred"),
            ("AXIS", "Axis", "An axis of the world or the object, projected onto the surface"),
            ("CURVATURE", "Curvature", "The direction in which the surface bends least, or most"),
            ("SMOOTH", "Smooth Field", "The smoothest field of directions on the surface"),
            ("STROKES", "Curves", "Curves drawn on the surface, continued smoothly between them"),
            ("UV", "UV Map", "The U or V lines of a UV map"),
            ("ATTRIBUTE", "Attribute", "Vector attribute of points, such as Geometry Nodes create"),
            ("BOUNDARY", "Boundary", "Parallel to boundaries and holes, and smooth between them"),
        ),
        default="NONE",
    )
    alignment_axis: EnumProperty(
        name="Axis",
        description="The axis that strands follow, projected onto the surface",
        items=(
            ("X", "X", "The X axis"),
            ("Y", "Y", "The Y axis"),
            ("Z", "Z", "The Z axis"),
            ("AUTO", "Auto", "The axis that lies best in the surface"),
        ),
        default="AUTO",
    )
    alignment_space: EnumProperty(
        name="Space",
        description="Whose axis it is",
        items=(
            ("WORLD", "World", "It stays when the object is rotated"),
            ("LOCAL", "Object", "It rotates with the object"),
        ),
        default="WORLD",
    )
    alignment_curvature: EnumProperty(
        name="Bending",
        description="Which of the two principal directions strands run along",
        items=(
            ("MIN", "Least", "Along a limb: strands bend as little as possible"),
            ("MAX", "Most", "Around a limb: strands show its shape"),
        ),
        default="MIN",
    )
    alignment_strokes: PointerProperty(
        type=bpy.types.Object,
        name="Curves",
        description=(
            "Curve, text, Grease Pencil or mesh without faces whose strands, on or near the "
            "surface, give the directions; parts of the mesh without a strand have none"
        ),
        poll=_is_curve,
    )
    alignment_uv: EnumProperty(
        name="Lines",
        description="Which lines of the UV map strands run along",
        items=(
            ("U", "U", "Where V stays the same"),
            ("V", "V", "Where U stays the same"),
        ),
        default="U",
    )
    alignment_uv_map: StringProperty(
        name="UV Map",
        description="UV map whose lines strands follow. Empty: the active one",
    )
    alignment_attribute: StringProperty(
        name="Attribute",
        description=(
            "Vector attribute of points, in the object's space; where it is zero no direction is "
            "preferred"
        ),
        search=vector_names,
        search_options={"SUGGESTION"},
    )
    alignment_angle: EnumProperty(
        name="Turned By",
        description=(
            "What is painted turns the direction in the surface, counterclockwise as seen from "
            "outside"
        ),
        items=(
            ("NONE", "Nothing", "The direction stays as it is"),
            ("GROUP", "Vertex Group", "From 0 to 180 degrees by the weight, from 0 to 1"),
            ("ATTRIBUTE", "Attribute", "Attribute of numbers, in degrees"),
            ("COLOR", "Color", "From 0 to 180 degrees by the brightness, from black to white"),
            ("IMAGE", "Image", "From 0 to 180 degrees by the brightness, from black to white"),
        ),
        default="NONE",
    )
    alignment_angle_group: StringProperty(
        name="Vertex Group", description="Vertex group of the angle"
    )
    alignment_angle_attribute: StringProperty(
        name="Attribute",
        description="Attribute of numbers that has the angle in degrees",
        search=attribute_names,
        search_options={"SUGGESTION"},
    )
    alignment_angle_color: StringProperty(
        name="Color Attribute",
        description="Color attribute whose brightness is the angle, in scene-linear light",
        search=color_names,
        search_options={"SUGGESTION"},
    )
    alignment_angle_image: PointerProperty(
        type=bpy.types.Image,
        name="Image",
        description=(
            "Image whose brightness is the angle, read once per vertex. Set its color space to "
            "Non-Color, so that half grey is 90 degrees"
        ),
    )
    alignment_angle_uv_map: StringProperty(
        name="UV Map",
        description="UV map that lays the image on the surface. Empty: the active one",
    )


class MEANDER_PT_alignment(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_alignment"
    bl_label = "Direction"
    bl_parent_id = GUIDANCE
    bl_order = GUIDANCE_ORDER["direction"]

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        active = context.active_object
        settings: bpy.types.PropertyGroup = settings_of(active)
        layout.prop(settings, "alignment_source")
        source = settings.alignment_source
        if source == "NONE":
            return
        if source == "AXIS":
            layout.prop(settings, "alignment_axis")
            layout.row().prop(settings, "alignment_space", expand=True)
        elif source == "CURVATURE":
            layout.row().prop(settings, "alignment_curvature", expand=True)
            row(layout, settings, "alignment_smoothing")
        elif source == "STROKES":
            line = layout.row(align=True)
            line.prop(settings, "alignment_strokes")
            if active.type == "MESH":
                draw = line.operator("meander.draw_seed", text="", icon="GREASEPENCIL")
                draw.setting = "alignment_strokes"
        elif source == "UV":
            layout.row().prop(settings, "alignment_uv", expand=True)
            surface = surface_of(active)
            if surface.type == "MESH":
                layout.prop_search(settings, "alignment_uv_map", surface.data, "uv_layers")
        elif source == "ATTRIBUTE":
            layout.prop(settings, "alignment_attribute", icon="SPREADSHEET")
        self._draw_angle(layout, settings, surface_of(active))
        row(layout, settings, "alignment_weight")
        row(layout, settings, "align_across")

    def _draw_angle(
        self,
        layout: bpy.types.UILayout,
        settings: bpy.types.PropertyGroup,
        surface: bpy.types.Object,
    ) -> None:
        layout.prop(settings, "alignment_angle")
        source = settings.alignment_angle
        if source == "GROUP":
            layout.prop_search(
                settings, "alignment_angle_group", surface, "vertex_groups", text="Group"
            )
        elif source == "ATTRIBUTE":
            layout.prop(settings, "alignment_angle_attribute", icon="SPREADSHEET")
        elif source == "COLOR":
            layout.prop(settings, "alignment_angle_color", text="Color", icon="GROUP_VCOL")
        elif source == "IMAGE":
            layout.template_ID(settings, "alignment_angle_image", open="image.open", text="Image")
            if surface.type == "MESH":
                layout.prop_search(
                    settings, "alignment_angle_uv_map", surface.data, "uv_layers"
                )

register, unregister = registration(MEANDER_PT_alignment)
