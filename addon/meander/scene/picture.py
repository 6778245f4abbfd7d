# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures in files, as Blender reads them, and the sheets that they are drawn on."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np

from ..model.files.whole import FileError
from ..model.picture.image import Image, image_of
from ..model.picture.line import Plan, Wishes
from .blender_versions import add_triangles

# On the sheet: how many times the spacing a place has, and along what its rows lie.
SPACING, DIRECTION = "Picture Spacing", "Picture Direction"
# The settings' factors of the spacing go no further, and the least spacing has this one.
_LEAST, _GREATEST, _ONE = 0.05, 5.0, 0.3


def read_picture(path: Path) -> Image:
    """The picture in a file; nothing of it stays in the scene. Blender does not turn photographs
    as their cameras say.

    Raises FileError where Blender cannot read it.
    """
    image = None
    try:
        image = bpy.data.images.load(str(path.absolute()), check_existing=False)
        # The numbers of the file, whatever Blender would take them for.
        image.colorspace_settings.name = "Non-Color"
        image.alpha_mode = "CHANNEL_PACKED"
        width, height = image.size
        if not width or not height:
            raise RuntimeError("the image has no pixels")
        pixels = np.empty(width * height * image.channels, dtype=np.float32)
        image.pixels.foreach_get(pixels)
        return image_of(pixels.reshape(height, width, image.channels)[::-1])
    except RuntimeError as problem:
        raise FileError(
            f"{path} cannot be read as a picture; save it as PNG, JPEG or TIFF"
        ) from problem
    finally:
        if image is not None:
            bpy.data.images.remove(image)


def new_sheet(
    name: str, plan: Plan, wishes: Wishes, scene: bpy.types.Scene, unit: float
) -> bpy.types.Object:
    """Makes the sheet of a picture as a mesh in the plane of x and y, at the 3D cursor, with the
    settings of its line.

    unit   the length of a millimetre in the scene

    The spacing is an attribute of its points, which can be edited, and the settings' own spacing
    scales all of it.
    """
    problem = plan.problem
    mesh = bpy.data.meshes.new(name)
    middle = np.array([*plan.grid.sides, 0.0]) / 2.0
    corners = ((problem.vertices - middle) * unit).astype(np.float32)
    mesh.vertices.add(len(corners))
    mesh.vertices.foreach_set("co", corners.ravel())
    faces = problem.faces
    add_triangles(mesh, faces)
    mesh.update(calc_edges=True)
    spacing = plan.spacing / np.sqrt(problem.density)
    one = float(spacing.min()) / _ONE
    if spacing.max() > _GREATEST * one:
        one = float(spacing.max()) / _GREATEST
    values = (spacing / one).clip(_LEAST, _GREATEST).astype(np.float32)
    mesh.attributes.new(SPACING, "FLOAT", "POINT").data.foreach_set("value", values)
    thing = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(thing)
    thing.location = scene.cursor.location
    settings = thing.meander
    settings.spacing = one * unit
    settings.density_source, settings.density_attribute = "ATTRIBUTE", SPACING
    settings.use_density_range = True
    settings.density_low, settings.density_high = settings.factor_0, settings.factor_1 = (
        _LEAST, _GREATEST,
    )  # fmt: skip
    settings.start = "GROW" if wishes.style == "scribble" else "FULL"
    settings.radius_follows = False
    settings.bevel_share = wishes.line_width / 2.0 / one
    settings.variation = wishes.variation
    if problem.directions is not None:
        lines = mesh.attributes.new(DIRECTION, "FLOAT_VECTOR", "POINT")
        lines.data.foreach_set("vector", problem.directions.astype(np.float32).ravel())
        settings.alignment_source, settings.alignment_attribute = "ATTRIBUTE", DIRECTION
        settings.alignment_weight = problem.options.alignment_weight
    return thing
