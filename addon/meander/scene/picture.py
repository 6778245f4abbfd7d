# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures in files, as Blender reads them, and the sheets that they are drawn on."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np

from ..model.density import Choice
from ..model.files.whole import FileError
from ..model.picture.correction import Tones
from ..model.picture.image import (
    LINEAR,
    Image,
    image_of,
    is_there,
    read_image,
    turn_of,
    turned,
)
from ..model.picture.line import Plan, Wishes
from ..model.picture.sheet import Grid
from ..model.picture.tone import Tone, to_value
from ..model.problem import Problem
from .blender_versions import add_triangles
from .transforms import to_local

# On the sheet: how many times the spacing a place has, and along what its rows lie.
SPACING, DIRECTION = "Picture Spacing", "Picture Direction"
# The settings' factors of the spacing go no further, and the least spacing has this one.
_LEAST, _GREATEST, _ONE = 0.05, 5.0, 0.3
# What was made as a grid is one in single precision: so far from its places points may be, in
# cells, and axes from a right angle.
_NEAR = 0.01


def read_picture(path: Path) -> Image:
    """The picture in a file, by Pillow where it is installed, else as Blender reads it; nothing of
    it stays in the scene.

    Raises FileError where it cannot be read.
    """
    linear = path.suffix.lower() in LINEAR
    if is_there() and not linear:
        return read_image(path)
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
        upright = turned(pixels.reshape(height, width, image.channels)[::-1], turn_of(path))
        if linear:
            upright[..., :3] = to_value(upright[..., :3].clip(0.0, 1.0))
        return image_of(upright)
    except (OSError, RuntimeError) as problem:
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


def tones_of(
    choice: Choice, problem: Problem, matrix: np.ndarray, line_share: float
) -> Tones | None:
    """What the line of a sheet is to have; None: it is no picture, or not flat any more.

    choice      of the density of the problem, which is in world units
    matrix      of the sheet
    line_share  half the width of the line, in spacings
    """
    if (choice.source, choice.name) != ("ATTRIBUTE", SPACING) or not _is_plain(problem):
        return None
    axes = matrix[:3, :2]
    scale = np.linalg.norm(axes, axis=0)
    corners = to_local(problem.vertices, matrix)
    found = _grid_of(corners * [*scale, float(scale.mean())], problem.faces)
    if found is None or abs(axes[:, 0] @ axes[:, 1]) > _NEAR * scale[0] * scale[1]:
        return None
    grid, places = found
    onto = np.eye(4)
    onto[:3, :3] = np.diag([*scale, 1.0]) @ np.linalg.inv(matrix[:3, :3])
    onto[:2, 3] = -(corners[:, :2].min(axis=0) * scale)
    onto[:3, 3] -= onto[:3, :3] @ matrix[:3, 3]
    one = 2.0 * line_share
    share = np.zeros((grid.cells[1] + 1) * (grid.cells[0] + 1))
    share[places] = one * np.sqrt(problem.density)
    reach = share[places]
    tone = Tone(
        darkest=max(Tone.darkest, float(reach.max())),
        lightest=min(Tone.lightest, float(reach.min())),
    )
    share = share.reshape(grid.cells[1] + 1, grid.cells[0] + 1)
    return Tones(grid, share, places, one, one * 2.0 * problem.options.radius, tone, onto)


def _is_plain(problem: Problem) -> bool:
    """Whether nothing is asked for that asks for another line than the tones do."""
    prepared = problem.surface_options
    masked = prepared is not None and (
        prepared.face_mask is not None or prepared.vertex_mask is not None
    )
    return not masked and problem.is_plain and not problem.least_bend_radius


def _grid_of(corners: np.ndarray, faces: np.ndarray) -> tuple[Grid, np.ndarray] | None:
    """The grid that points are places of, in the plane of x and y, and the place of each; None:
    they are none."""
    ends = corners[faces]
    cell = np.abs(ends - np.roll(ends, 1, axis=1)).max(axis=(0, 1))
    low = corners.min(axis=0)
    if not (cell[:2] > 0.0).all() or np.ptp(corners[:, 2]) > _NEAR * cell[:2].min():
        return None
    steps = (corners[:, :2] - low[:2]) / cell[:2]
    whole = np.rint(steps).astype(np.int64)
    across, down = (max(2, int(count)) for count in whole.max(axis=0))
    places = (down - whole[:, 1]) * (across + 1) + whole[:, 0]
    if np.abs(steps - whole).max() > _NEAR or len(np.unique(places)) < len(places):
        return None
    return Grid((across * float(cell[0]), down * float(cell[1])), (across, down)), places
