# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the spacing varies: the settings, and the values that they name, read from Blender data.

Weights, attributes, colours and images give a value per vertex of the evaluated mesh; a Ramp turns
it into the density.
"""

from collections.abc import Callable, Iterable

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, PointerProperty, StringProperty
from numpy.typing import NDArray

from . import blender_data, blender_ramp, core
from .blender_data import DataError
from .density import (
    FREE,
    Choice,
    Stops,
    Values,
    curvature_density,
    luminance,
    mean_at_vertices,
    sample_repeated,
    srgb_luminance,
)

_COLOR_TYPES = ("FLOAT_COLOR", "BYTE_COLOR")


# ------------------------------------------------------------------------------------------------
# Settings


def attributes_seen(
    settings: bpy.types.PropertyGroup, context: bpy.types.Context
) -> Iterable[bpy.types.Attribute]:
    """Of the surface as it is seen, so that those of Geometry Nodes are among them."""
    owner = settings.id_data
    surface = owner if owner.type == "MESH" else settings.surface
    if surface is None:
        return ()
    evaluated = surface.evaluated_get(context.evaluated_depsgraph_get())
    return evaluated.data.attributes


def attribute_names(
    settings: bpy.types.PropertyGroup, context: bpy.types.Context, _text: str
) -> list[str]:
    return [item.name for item in attributes_seen(settings, context) if _is_point_float(item)]


def color_names(
    settings: bpy.types.PropertyGroup, context: bpy.types.Context, _text: str
) -> list[str]:
    return [item.name for item in attributes_seen(settings, context) if _is_color(item)]


def _is_point_float(attribute: bpy.types.Attribute) -> bool:
    return (attribute.domain, attribute.data_type) == ("POINT", "FLOAT")


def _is_color(attribute: bpy.types.Attribute) -> bool:
    return attribute.data_type in _COLOR_TYPES and attribute.domain in {"POINT", "CORNER"}


def _shape_chosen(settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    """Gives an object the curve that the panel shows for a free ramp."""
    if settings.density_interpolation == FREE.upper():
        if blender_ramp.node_of(settings.density_ramp) is None:
            settings.density_ramp = blender_ramp.new_ramp()


class DensitySettings:
    """The part of MeanderSettings that says where the strands are closer."""

    density_source: EnumProperty(
        name="Source",
        description="What the spacing follows over the surface",
        items=(
            ("NONE", "None", "The same spacing everywhere"),
            ("GROUP", "Vertex Group", "Weights as painted in Weight Paint"),
            ("ATTRIBUTE", "Attribute", "A float attribute of points, as Geometry Nodes make"),
            ("COLOR", "Color Attribute", "The brightness of painted vertex colors"),
            ("IMAGE", "Image", "The brightness of an image through a UV map"),
            ("CURVATURE", "Curvature", "How much the surface bends, and not which way"),
        ),
        default="GROUP",
        options=set(),
    )
    density_group: StringProperty(
        name="Vertex Group",
        description=(
            "Vertex group that varies the spacing over the surface. Empty: the same everywhere"
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
    density_smoothing: FloatProperty(
        name="Smoothing",
        description=(
            "Average the curvature over this many halves of the spacing; more leaves out small "
            "features, 0 takes every dent"
        ),
        default=2.0,
        min=0.0,
        soft_max=10.0,
        precision=1,
        step=50,
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
        description="The value that gets the low factor, as do all beyond it",
        default=0.0,
        precision=3,
        options=set(),
    )
    density_high: FloatProperty(
        name="High",
        description=("The value that gets the high factor, as do all beyond it; may be below Low"),
        default=1.0,
        precision=3,
        options=set(),
    )
    factor_0: FloatProperty(
        name="Factor Low",
        description="The spacing is multiplied by this where the value is low: 0, if not chosen",
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
            "The spacing is multiplied by this where the value is high: 1, if not chosen. "
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
        description="How the factor goes from the low one to the high one",
        items=(
            ("LINEAR", "Linear", "In proportion to the value"),
            ("SMOOTH", "Smooth", "Slowly at both ends, so that the range shows no edge"),
            ("CONSTANT", "Constant", "At once, in the middle of the range; strands crowd there"),
            ("FREE", "Curve", "As drawn: to the right the value, up the way to the high factor"),
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


# ------------------------------------------------------------------------------------------------
# Settings and values


def choice_of(settings: bpy.types.PropertyGroup) -> Choice:
    """What the settings of an object say."""
    source = settings.density_source
    name = ""
    if source == "IMAGE":
        name = settings.density_image.name if settings.density_image else ""
    elif source == "CURVATURE":
        name = settings.density_curvature.lower()
    elif source != "NONE":
        name = getattr(settings, f"density_{source.lower()}")
    value_range = (settings.density_low, settings.density_high)
    return Choice(
        source=source,
        name=name,
        uv_map=settings.density_uv_map,
        value_range=value_range if settings.use_density_range else None,
        factors=(settings.factor_0, settings.factor_1),
        interpolation=settings.density_interpolation.lower(),
        smoothing=float(f"{settings.density_smoothing:.6g}"),
        stops=_stops_of(settings),
    )


def _stops_of(settings: bpy.types.PropertyGroup) -> Stops:
    if settings.density_interpolation != FREE.upper():
        return ()
    return blender_ramp.stops_of(settings.density_ramp)


def store_choice(choice: Choice, settings: bpy.types.PropertyGroup) -> None:
    """Writes a choice into the settings of an object; choice_of() then gives it back."""
    settings.density_source = choice.source
    if choice.source == "IMAGE":
        settings.density_image = bpy.data.images.get(choice.name)
    elif choice.source == "CURVATURE":
        settings.density_curvature = choice.name.upper()
    elif choice.source != "NONE":
        setattr(settings, f"density_{choice.source.lower()}", choice.name)
    settings.density_uv_map = choice.uv_map
    settings.use_density_range = choice.value_range is not None
    if choice.value_range is not None:
        settings.density_low, settings.density_high = choice.value_range
    settings.factor_0, settings.factor_1 = choice.factors
    if choice.stops and choice.stops != blender_ramp.stops_of(settings.density_ramp):
        settings.density_ramp = blender_ramp.ramp_of(choice.stops)
    settings.density_interpolation = choice.interpolation.upper()
    settings.density_smoothing = choice.smoothing


def density_of(
    choice: Choice,
    surface: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
    radius: float = 0.0,
) -> Values | Callable[[core.Surface], Values] | None:
    """The density per vertex of blender_data.triangles_of(), or what computes it; None for 1
    everywhere.

    radius   r, half the spacing; for the smoothing of curvature

    Raises DataError with one sentence for what is missing or of another kind.
    """
    if not choice.varies:
        return None
    if choice.source == "CURVATURE":
        return curvature_density(choice, radius)
    values = _READERS[choice.source](choice, surface, depsgraph)
    if not np.isfinite(values).all():
        vertex = int(np.flatnonzero(~np.isfinite(values))[0])
        raise DataError(
            f"'{choice.name}' is not a finite number at vertex {vertex} of '{surface.name}'; "
            "correct its values"
        )
    return choice.ramp(values).density(values)


# ------------------------------------------------------------------------------------------------
# Values per vertex of the evaluated mesh


def _group_values(
    choice: Choice, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Values:
    return blender_data.vertex_group_weights(surface, depsgraph, choice.name)


def _attribute_values(
    choice: Choice, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Values:
    if not choice.name:
        raise DataError("The density has no attribute; choose a float attribute of points")
    with blender_data.surface_mesh(surface, depsgraph) as (mesh, _matrix):
        attribute = named_attribute(
            mesh, choice.name, surface, _is_point_float, "float attribute of points"
        )
        values = np.empty(len(mesh.vertices), dtype=np.float32)
        attribute.data.foreach_get("value", values)
    return values.astype(np.float64)


def _color_values(
    choice: Choice, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Values:
    if not choice.name:
        raise DataError("The density has no color attribute; choose one, or paint one")
    with blender_data.surface_mesh(surface, depsgraph) as (mesh, _matrix):
        attribute = named_attribute(mesh, choice.name, surface, _is_color, "color attribute")
        colors = np.empty(4 * len(attribute.data), dtype=np.float32)
        attribute.data.foreach_get("color", colors)  # scene-linear, also of bytes
        values = luminance(colors.reshape(-1, 4))
        if attribute.domain == "CORNER":
            values = mean_at_vertices(values, _vertices_of_corners(mesh), len(mesh.vertices))
    return values


def _image_values(
    choice: Choice, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Values:
    if not choice.name:
        raise DataError("The density has no image; open one, or choose another source")
    pixels, brightness = pixels_of(choice.name)
    with blender_data.surface_mesh(surface, depsgraph) as (mesh, _matrix):
        layer = uv_layer_of(mesh, choice.uv_map, surface)
        uv = np.empty(2 * len(layer.data), dtype=np.float32)
        layer.data.foreach_get("uv", uv)
        values = sample_repeated(pixels, uv.reshape(-1, 2), brightness)
        return mean_at_vertices(values, _vertices_of_corners(mesh), len(mesh.vertices))


_READERS = {
    "GROUP": _group_values,
    "ATTRIBUTE": _attribute_values,
    "COLOR": _color_values,
    "IMAGE": _image_values,
}


def uv_layer_of(
    mesh: bpy.types.Mesh, name: str, surface: bpy.types.Object
) -> bpy.types.MeshUVLoopLayer:
    """The UV map of that name; the active one for an empty name."""
    layer = mesh.uv_layers.get(name) if name else mesh.uv_layers.active
    if layer is None:
        raise DataError(
            f"'{surface.name}' has no UV map '{name}'; choose one that it has"
            if name
            else f"'{surface.name}' has no UV map; unwrap it first"
        )
    return layer


def named_attribute(
    mesh: bpy.types.Mesh,
    name: str,
    surface: bpy.types.Object,
    fits: Callable[[bpy.types.Attribute], bool],
    kind: str,
) -> bpy.types.Attribute:
    """The attribute of that name, if it is of the kind that is wanted."""
    attribute = mesh.attributes.get(name)
    if attribute is not None and fits(attribute):
        return attribute
    if attribute is not None:
        type_name = attribute.data_type.lower().replace("_", " ")
        raise DataError(
            f"'{name}' of '{surface.name}' is a {type_name} per {attribute.domain.lower()}; "
            f"choose a {kind}"
        )
    known = ", ".join(f"'{other.name}'" for other in mesh.attributes if fits(other))
    raise DataError(
        f"'{surface.name}' has no {kind} '{name}'; "
        + (f"it has {known}" if known else "add one, or choose another source")
    )


def _vertices_of_corners(mesh: bpy.types.Mesh) -> NDArray[np.int32]:
    vertices = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", vertices)
    return vertices


def pixels_of(name: str) -> tuple[NDArray[np.float32], Callable[[NDArray], Values]]:
    """An image's pixels (height, width, channels), first row at the bottom, and their brightness.

    The brightness is what an Image Texture and RGB to BW give: 8-bit pixels of an sRGB image are
    made linear; data and linear images are taken as they are, and so are float images, which
    Blender makes linear when it opens them.
    """
    image = bpy.data.images.get(name)
    if image is None:
        raise DataError(f"There is no image '{name}' in this file; open it, or choose another")
    if image.source not in {"FILE", "GENERATED"}:
        kind = {"TILED": "tiled (UDIM)", "VIEWER": "a render result"}.get(image.source, "a movie")
        raise DataError(f"The image '{name}' is {kind}; the density needs a single still image")
    width, height = image.size
    if not width or not height or not len(image.pixels):
        raise DataError(
            f"The image '{name}' has no pixels, as its file cannot be found; find it by File > "
            "External Data, or open it again"
        )
    pixels = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    is_srgb = not image.is_float and "sRGB" in image.colorspace_settings.name
    return pixels.reshape(height, width, image.channels), srgb_luminance if is_srgb else luminance
