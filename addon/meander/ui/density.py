# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the spacing varies, as settings on an object."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, PointerProperty, StringProperty

from ..model.density import FREE
from ..scene import density
from ..scene.attributes import attribute_names, color_names


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
            ("ATTRIBUTE", "Attribute", "Float attribute of points, such as Geometry Nodes create"),
            ("COLOR", "Vertex Color", "The brightness of painted vertex colors"),
            ("IMAGE", "Image", "The brightness of an image through a UV map"),
            ("CURVATURE", "Curvature", "How strongly the surface bends, in whatever direction"),
        ),
        default="GROUP",
        options=set(),
    )
    density_group: StringProperty(
        name="Vertex Group",
        description=(
            "Vertex group that varies the spacing over the surface. Empty: the active one, if it "
            "is painted and no bone or modifier uses it"
        ),
        options=set(),
    )
    density_attribute: StringProperty(
        name="Attribute",
        description="Float attribute of points that varies the spacing over the surface",
        search=attribute_names,
        search_options={"SUGGESTION"},
        options=set(),
    )
    density_color: StringProperty(
        name="Color Attribute",
        description=(
            "Color attribute whose brightness varies the spacing; black is 0 and white 1, in "
            "scene-linear light as shaders see it"
        ),
        search=color_names,
        search_options={"SUGGESTION"},
        options=set(),
    )
    density_image: PointerProperty(
        type=bpy.types.Image,
        name="Image",
        description=(
            "Image whose brightness varies the spacing; read once per vertex, so details finer "
            "than the faces are lost. Set its color space to Non-Color for plain data"
        ),
        options=set(),
    )
    density_uv_map: StringProperty(
        name="UV Map",
        description="UV map that lays the image on the surface. Empty: the active one",
        options=set(),
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
        options=set(),
    )
    use_density_range: BoolProperty(
        name="Custom Range",
        description=(
            "Choose which values get the two factors. Off: 0 and 1 for weights and brightness, the "
            "least and the greatest for attributes, 0 and what 95 % stay below for curvature"
        ),
        default=False,
        options=set(),
    )
    density_low: FloatProperty(
        name="Low",
        description="Value that gets the low factor, as do all beyond it",
        default=0.0,
        precision=3,
        options=set(),
    )
    density_high: FloatProperty(
        name="High",
        description=(
            "Value that gets the high factor, as do all values beyond it; may be below Low"
        ),
        default=1.0,
        precision=3,
        options=set(),
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
        options=set(),
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
        options=set(),
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
        ),
        default="LINEAR",
        options=set(),
        update=_shape_chosen,
    )
    density_ramp: PointerProperty(
        type=bpy.types.NodeTree,
        name="Ramp",
        description="Holds the curve of the ramp; made when Curve is chosen",
        options=set(),
    )
