# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the spacing varies: the settings on an object, and the panel "Density"."""

import bpy

from ..model.density import FREE, TONE
from ..model.options.tone import ROWS as TONE_ROWS
from ..scene import density
from ..scene.attributes import attribute_names, color_names
from ..scene.density import active_group, choice_of
from ..scene.linked_settings import owner_of, settings_of
from ..scene.settings import surface_of
from .declared import row
from .registered import registration
from .sidebar import GUIDANCE, GUIDANCE_ORDER, SubPanel, columns, notice
from .unanimated import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    PointerProperty,
    StringProperty,
)


def _shape_chosen(settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    """Gives an object the curve that the panel shows for a free ramp."""
    if settings.density_interpolation == FREE.upper():
        if density.node_of(settings.density_ramp) is None:
            settings.density_ramp = density.new_ramp()


class DensitySettings:
    """The part of MeanderSettings that says where the strands are closer."""

    density_source: EnumProperty(
        name="Source",
        description="What the spacing follows over the surface",
        items=(
            ("NONE", "None", "The same spacing everywhere"),
            ("GROUP", "Vertex Group", "Weights, as painted in Weight Paint"),
            ("ATTRIBUTE", "Attribute", "Attribute of numbers: floats, integers or booleans"),
            ("COLOR", "Vertex Color", "The brightness of painted vertex colors"),
            ("IMAGE", "Image", "The brightness of an image through a UV map"),
            ("CURVATURE", "Curvature", "How strongly the surface bends, in whatever direction"),
        ),
        default="GROUP",
    )
    density_group: StringProperty(
        name="Vertex Group",
        description=(
            "Vertex group that varies the spacing over the surface. Empty: the active one, if it "
            "is painted and no bone or modifier uses it"
        ),
    )
    density_attribute: StringProperty(
        name="Attribute",
        description="Attribute of points, faces or corners that varies the spacing",
        search=attribute_names,
        search_options={"SUGGESTION"},
    )
    density_color: StringProperty(
        name="Color Attribute",
        description=(
            "Color attribute whose brightness varies the spacing; black is 0 and white 1, in "
            "scene-linear light as shaders see it"
        ),
        search=color_names,
        search_options={"SUGGESTION"},
    )
    density_image: PointerProperty(
        type=bpy.types.Image,
        name="Image",
        description=(
            "Image whose brightness varies the spacing; read once per vertex, so details finer "
            "than the faces are lost. Set its color space to Non-Color for plain data"
        ),
    )
    density_uv_map: StringProperty(
        name="UV Map",
        description="UV map that lays the image on the surface. Empty: the active one",
    )
    density_curvature: EnumProperty(
        name="Curvature",
        description="Which curvature varies the spacing; its sign does not count",
        items=(
            ("MEAN", "Mean", "Bending in any direction: edges, tubes and tips; 1 / length"),
            (
                "GAUSSIAN",
                "Gaussian",
                "Bending in both directions: tips, dents and saddles, "
                "nothing along tubes; 1 / length squared",
            ),
        ),
        default="MEAN",
    )
    use_density_range: BoolProperty(
        name="Custom Range",
        description=(
            "Choose which values get the two factors. Off: 0 and 1 for weights and brightness, the "
            "least and the greatest for attributes, 0 and what 95 % stay below for curvature"
        ),
        default=False,
    )
    density_low: FloatProperty(
        name="Low",
        description="Value that gets the low factor, as do all beyond it",
        default=0.0,
        precision=3,
    )
    density_high: FloatProperty(
        name="High",
        description=(
            "Value that gets the high factor, as do all values beyond it; may be below Low"
        ),
        default=1.0,
        precision=3,
    )
    factor_0: FloatProperty(
        name="Factor Low",
        description="Factor of the spacing where the value is low: at 0 without a custom range",
        default=1.0,
        min=0.05,
        max=5.0,
        soft_min=0.25,
        soft_max=2.0,
        precision=2,
        step=5,
    )
    factor_1: FloatProperty(
        name="Factor High",
        description=(
            "Factor of the spacing where the value is high: at 1 without a custom range. "
            "0.5 is twice as dense"
        ),
        default=0.5,
        min=0.05,
        max=5.0,
        soft_min=0.25,
        soft_max=2.0,
        precision=2,
        step=5,
    )
    density_interpolation: EnumProperty(
        name="Interpolation",
        description="How the factor changes between Low and High",
        items=(
            ("LINEAR", "Linear", "In proportion to the value"),
            ("SMOOTH", "Smooth", "Flat at both ends, so that no edge shows"),
            ("CONSTANT", "Constant", "A step in the middle of the range; strands crowd there"),
            (
                "FREE",
                "Curve",
                "Drawn by hand: to the right the value, upwards the share of At High",
            ),
            (
                "TONE",
                "Tone",
                "Values are brightness, and the line looks so from afar: its width over the "
                "spacing is how dark it is",
            ),
        ),
        default="LINEAR",
        update=_shape_chosen,
    )
    density_ramp: PointerProperty(
        type=bpy.types.NodeTree,
        name="Ramp",
        description="Holds the curve of the ramp; made when Curve is chosen",
    )


class MEANDER_PT_density(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_density"
    bl_label = "Density"
    bl_parent_id = GUIDANCE
    bl_order = GUIDANCE_ORDER["density"]

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout, live=True)
        active = context.active_object
        settings: bpy.types.PropertyGroup = settings_of(active)
        layout.prop(settings, "density_source")
        source = settings.density_source
        if source == "NONE":
            return
        surface = surface_of(active)
        if source == "GROUP":
            layout.prop_search(settings, "density_group", surface, "vertex_groups", text="Group")
            if not settings.density_group:
                self._draw_taken(layout, surface, active_group(settings, surface))
        elif source == "ATTRIBUTE":
            layout.prop(settings, "density_attribute", icon="SPREADSHEET")
        elif source == "COLOR":
            layout.prop(settings, "density_color", text="Color", icon="GROUP_VCOL")
        elif source == "IMAGE":
            layout.template_ID(settings, "density_image", open="image.open", text="Image")
            if surface.type == "MESH":
                layout.prop_search(settings, "density_uv_map", surface.data, "uv_layers")
        else:
            layout.prop(settings, "density_curvature")
            row(layout, settings, "density_smoothing")
        self._draw_ramp(layout.column(), settings)

    def _draw_taken(
        self, layout: bpy.types.UILayout, surface: bpy.types.Object, group: str
    ) -> None:
        """Which group a run takes where none is named: paint is never left out in silence."""
        if len(surface.vertex_groups):
            notice(layout, f"Active: {group}" if group else "None: even spacing")
        else:
            notice(layout, "No vertex groups")

    def _draw_ramp(self, layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup) -> None:
        taken = active_group(settings, surface_of(owner_of(settings)))
        layout.active = choice_of(settings).varies or bool(taken)
        if choice_of(settings).interpolation == TONE:
            layout.prop(settings, "density_interpolation", text="Ramp")
            for option in TONE_ROWS:
                row(layout, settings, option.setting)
            self._draw_range(layout, settings)
            return
        column = layout.column(align=True)
        unit = column.split(factor=0.4)
        unit.label(text="")  # the fields' own labels are below
        unit.label(text="Of the spacing")
        column.prop(settings, "factor_0", text="At Low")
        column.prop(settings, "factor_1", text="At High")
        layout.prop(settings, "density_interpolation", text="Ramp")
        if settings.density_interpolation == "FREE":
            node = density.node_of(settings.density_ramp)
            if node is not None:
                layout.template_curve_mapping(node, "mapping")
        self._draw_range(layout, settings)

    def _draw_range(self, layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup) -> None:
        layout.column(heading="Range").prop(settings, "use_density_range", text="Custom")
        column = layout.column(align=True)
        column.active = settings.use_density_range
        column.prop(settings, "density_low", text="From")
        column.prop(settings, "density_high", text="To")

register, unregister = registration(MEANDER_PT_density)
