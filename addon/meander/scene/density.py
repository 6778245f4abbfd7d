# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the spacing varies: what the settings say, and the values that they name.

Weights, attributes, colours and images give a value per vertex of the evaluated mesh; a Ramp turns
it into the density. One that is shaped by hand is Blender's curve widget: as add-ons are given no
curve property, every object that wants one has a node group of its own that holds a Float Curve and
is used for nothing else.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import bpy
import numpy as np
from numpy.typing import NDArray

from ..model.density import (
    FREE,
    TONE,
    Choice,
    Stops,
    Values,
    curvature_density,
    luminance,
    mean_at_vertices,
    sample_repeated,
    srgb_luminance,
)
from ..model.field import FieldOn
from ..model.options.option import as_typed
from ..model.picture.tone import Tone
from .attributes import is_color, is_number, named_attribute, numbers_of, uv_of
from .columns import column, corner_counts, vertices_of_corners
from .errors import DataError
from .evaluated import surface_mesh
from .meshes import vertex_group_weights


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
        interpolation=_interpolation_of(settings),
        smoothing=float(f"{settings.density_smoothing:.6g}"),
        stops=_stops_of(settings),
        tone=tone_of(settings),
        line=as_typed(settings.tone_line) / 2.0,
    )


def _interpolation_of(settings: bpy.types.PropertyGroup) -> str:
    chosen = settings.density_interpolation.lower()
    # How much a surface bends is no brightness.
    return "linear" if chosen == TONE and settings.density_source == "CURVATURE" else chosen


def tone_of(settings: bpy.types.PropertyGroup) -> Tone:
    """What the settings say of tone."""
    return Tone(
        settings.tone_kind.lower(),
        as_typed(settings.tone_darkest),
        min(as_typed(settings.tone_lightest), 0.9 * as_typed(settings.tone_darkest)),
        negative=settings.tone_negative,
    )


def active_group(settings: bpy.types.PropertyGroup, surface: bpy.types.Object) -> str:
    """The active vertex group, if it is for no other purpose; else an empty name.

    Bones, modifiers and the part to fill have groups of their own.
    """
    group = surface.vertex_groups.active if surface.type == "MESH" else None
    if group is None or group.name in _groups_in_use(surface):
        return ""
    is_part = settings.mask_source == "GROUP" and settings.mask_group == group.name
    return "" if is_part else group.name


def painted_group(settings: bpy.types.PropertyGroup, surface: bpy.types.Object) -> str:
    """active_group() if there is any weight in it; else an empty name."""
    name = active_group(settings, surface)
    if not name:
        return ""
    index = surface.vertex_groups[name].index
    painted = any(
        element.group == index and element.weight > 0.0
        for vertex in surface.data.vertices
        for element in vertex.groups
    )
    return name if painted else ""


def _groups_in_use(surface: bpy.types.Object) -> set[str]:
    names: set[str] = set()
    for modifier in surface.modifiers:
        names.add(getattr(modifier, "vertex_group", ""))
        if modifier.type == "ARMATURE" and modifier.object is not None:
            names.update(bone.name for bone in modifier.object.data.bones)
    return names


def chosen_density(settings: bpy.types.PropertyGroup, surface: bpy.types.Object) -> Choice:
    """What the settings say; where they name no vertex group, the painted one that is active."""
    choice = choice_of(settings)
    if choice.source == "GROUP" and not choice.name:
        return replace(choice, name=painted_group(settings, surface))
    return choice


def unused_paint(
    choice: Choice, settings: bpy.types.PropertyGroup, surface: bpy.types.Object
) -> str:
    """A line about vertex groups that a run leaves out since none is chosen; empty if none."""
    if choice.source != "GROUP" or choice.name or surface.type != "MESH":
        return ""
    part = settings.mask_group if settings.mask_source == "GROUP" else ""
    if all(group.name == part for group in surface.vertex_groups):
        return ""
    return "no vertex group is chosen under Density, so the spacing is the same everywhere"


def _stops_of(settings: bpy.types.PropertyGroup) -> Stops:
    if settings.density_interpolation != FREE.upper():
        return ()
    return stops_of(settings.density_ramp)


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
    if choice.stops and choice.stops != stops_of(settings.density_ramp):
        settings.density_ramp = ramp_of(choice.stops)
    settings.density_interpolation = choice.interpolation.upper()
    settings.density_smoothing = choice.smoothing
    tone = choice.tone
    settings.tone_kind, settings.tone_negative = tone.kind.upper(), tone.negative
    settings.tone_darkest, settings.tone_lightest = tone.darkest, tone.lightest
    settings.tone_line = 2.0 * choice.line


def density_of(
    choice: Choice,
    surface: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
    radius: float = 0.0,
) -> Values | FieldOn | None:
    """The density per vertex of meshes.triangles_of(), or what computes it; None for 1
    everywhere.

    radius   r, half the spacing; for the smoothing of curvature

    Raises DataError with one sentence for what is missing or of another kind.
    """
    if not choice.varies:
        return None
    if choice.source == "CURVATURE":
        return curvature_density(choice, radius)
    values = painted_values(choice, surface, depsgraph, "density")
    return choice.density(values)


def painted_values(
    choice: Choice, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph, what: str
) -> Values:
    """What a vertex group, an attribute, a color or an image has at the vertices of
    meshes.triangles_of().

    what   it is for, in a word

    Raises DataError with one sentence for what is missing or of another kind.
    """
    if not choice.name and choice.source != "GROUP":
        raise DataError(_MISSING[choice.source].format(what))
    values = _READERS[choice.source](choice, surface, depsgraph)
    if not np.isfinite(values).all():
        vertex = int(np.flatnonzero(~np.isfinite(values))[0])
        raise DataError(
            f"'{choice.name}' is not a finite number at vertex {vertex} of '{surface.name}'; "
            "correct its values"
        )
    return values


# ------------------------------------------------------------------------------------------------
# Values per vertex of the evaluated mesh


def _group_values(
    choice: Choice, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Values:
    return vertex_group_weights(surface, depsgraph, choice.name)


def _attribute_values(
    choice: Choice, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Values:
    with surface_mesh(surface, depsgraph) as (mesh, _matrix):
        attribute = named_attribute(mesh, choice.name, surface, is_number, "attribute of numbers")
        values = numbers_of(attribute)
        if attribute.domain == "POINT":
            return values
        if attribute.domain == "FACE":
            values = np.repeat(values, corner_counts(mesh))
        return mean_at_vertices(values, vertices_of_corners(mesh), len(mesh.vertices))


def _color_values(
    choice: Choice, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Values:
    with surface_mesh(surface, depsgraph) as (mesh, _matrix):
        attribute = named_attribute(mesh, choice.name, surface, is_color, "color attribute")
        colors = column(attribute.data, "color", 4)  # scene-linear, also of bytes
        values = luminance(colors)
        if attribute.domain == "CORNER":
            values = mean_at_vertices(values, vertices_of_corners(mesh), len(mesh.vertices))
    return values


def _image_values(
    choice: Choice, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Values:
    pixels, brightness = pixels_of(choice.name)
    with surface_mesh(surface, depsgraph) as (mesh, _matrix):
        uv = uv_of(mesh, choice.uv_map, surface)
        values = sample_repeated(pixels, uv, brightness)
        return mean_at_vertices(values, vertices_of_corners(mesh), len(mesh.vertices))


_MISSING = {
    "ATTRIBUTE": "The {} has no attribute; choose an attribute of numbers",
    "COLOR": "The {} has no color attribute; choose one, or paint one",
    "IMAGE": "The {} has no image; open one, or choose another source",
}
_READERS = {
    "GROUP": _group_values,
    "ATTRIBUTE": _attribute_values,
    "COLOR": _color_values,
    "IMAGE": _image_values,
}


# The dot keeps it out of Blender's lists.
_NAME = ".Meander Ramp"
# The least number of stops: the widget's curves are smooth.
_SAMPLES = 65


def new_ramp() -> bpy.types.NodeTree:
    """A node group with the curve from (0, 0) to (1, 1)."""
    tree = bpy.data.node_groups.new(_NAME, "ShaderNodeTree")
    tree.nodes.new("ShaderNodeFloatCurve")
    return tree


def node_of(tree: bpy.types.NodeTree | None) -> bpy.types.Node | None:
    """The node whose curve is the ramp; None where somebody has taken it away."""
    if tree is None:
        return None
    found = (node for node in tree.nodes if node.bl_idname == "ShaderNodeFloatCurve")
    return next(found, None)


def stops_of(tree: bpy.types.NodeTree | None) -> Stops:
    """What the widget shows, as stops between which the ramp is straight; () without a curve."""
    node = node_of(tree)
    if node is None:
        return ()
    mapping = node.mapping
    mapping.initialize()
    curve = mapping.curves[0]
    shares = np.linspace(0.0, 1.0, _SAMPLES).tolist()
    shares += [point.location.x for point in curve.points if 0.0 < point.location.x < 1.0]
    shares = sorted({round(share, 6) for share in shares})
    heights = [mapping.evaluate(curve, share) for share in shares]
    return tuple(
        (share, min(max(float(height), 0.0), 1.0)) for share, height in zip(shares, heights)
    )


def ramp_of(stops: Stops) -> bpy.types.NodeTree:
    """A node group whose curve goes straight from stop to stop."""
    tree = new_ramp()
    mapping = node_of(tree).mapping
    points = mapping.curves[0].points
    while len(points) < len(stops):
        points.new(0.5, 0.5)
    while len(points) > len(stops):
        points.remove(points[-2])
    for point, (share, height) in zip(points, stops):
        point.location = (share, height)
        point.handle_type = "VECTOR"
    mapping.update()
    return tree


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
        raise DataError(f"The image '{name}' is {kind}; only a single still image serves")
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
