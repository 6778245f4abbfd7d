# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: makes the pictures of docs/density.md.

    bash docs/pictures/make.sh density

FOLDER is docs/images by default. Workbench renders them, which needs an EGL driver but no display.
Those in the folder have since been reduced to 32 greys.

"""

import math
import sys
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "addon"))

import meander  # noqa: E402  (the path comes first)
from meander.scene import density  # noqa: E402

SIZE = (360, 270)


def begin() -> None:
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


def painted(thing: bpy.types.Object, colour: tuple) -> None:
    made = bpy.data.materials.new("Paint")
    made.diffuse_color = (*colour, 1.0)
    thing.data.materials.clear()
    thing.data.materials.append(made)


def ramp_sheet() -> bpy.types.Object:
    """A sheet with an attribute that rises from left to right."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=80, y_subdivisions=60, size=2.0)
    sheet = bpy.context.active_object
    sheet.scale = (1.33, 1.0, 1.0)
    values = sheet.data.attributes.new("rise", "FLOAT", "POINT")
    values.data.foreach_set("value", [vertex.co.x for vertex in sheet.data.vertices])
    sheet.meander.density_source = "ATTRIBUTE"
    sheet.meander.density_attribute = "rise"
    return sheet


def shaped_sheet() -> bpy.types.Object:
    """The same with a ramp that is least a third of the way along, and low again at the end."""
    sheet = ramp_sheet()
    sheet.meander.density_interpolation = "FREE"
    sheet.meander.density_ramp = density.ramp_of(
        ((0.0, 0.0), (0.35, 1.0), (0.7, 0.0), (1.0, 0.6))
    )
    return sheet


def image_sheet() -> bpy.types.Object:
    """A sheet under an image of bright rings."""
    sheet = ramp_sheet()
    width, height = 256, 192
    x, y = np.meshgrid(np.linspace(-1.33, 1.33, width), np.linspace(-1.0, 1.0, height))
    rings = 0.5 + 0.5 * np.cos(7.0 * np.hypot(x, y))
    image = bpy.data.images.new("Rings", width, height)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(np.repeat(rings.ravel(), 4).astype(np.float32))
    sheet.meander.density_source = "IMAGE"
    sheet.meander.density_image = image
    return sheet


def curved_body() -> bpy.types.Object:
    bpy.ops.mesh.primitive_monkey_add(size=2.0)
    body = bpy.context.active_object
    body.modifiers.new("Subdivision", "SUBSURF").levels = 3
    body.meander.density_source = "CURVATURE"
    return body


def draw(surface: bpy.types.Object, path: Path, spacing: float, eye: tuple, **settings) -> None:
    bpy.context.view_layer.objects.active = surface
    surface.meander.spacing = spacing
    surface.meander.bevel_share = 0.12
    for name, value in settings.items():
        setattr(surface.meander, name, value)
    assert bpy.ops.meander.run() == {"FINISHED"}
    painted(bpy.context.active_object, (0.02, 0.02, 0.025))
    painted(surface, (0.82, 0.81, 0.78))
    render(path, eye)


def render(path: Path, eye: tuple) -> None:
    scene = bpy.context.scene
    camera = bpy.data.cameras.new("Camera")
    camera.type = "ORTHO"
    camera.ortho_scale = 2.7
    holder = bpy.data.objects.new("Camera", camera)
    holder.location, holder.rotation_euler = eye
    scene.collection.objects.link(holder)
    scene.camera = holder
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.display.shading.light = "STUDIO"
    scene.display.shading.color_type = "MATERIAL"
    scene.display.render_aa = "16"
    scene.render.film_transparent = False
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = (1.0, 1.0, 1.0)
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "BW"
    scene.render.image_settings.compression = 100
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def main() -> None:
    rest = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    folder = Path(rest[0]) if rest else ROOT / "docs" / "images"
    meander.register()
    above = ((0.0, 0.0, 5.0), (0.0, 0.0, 0.0))
    front = ((0.0, -6.0, 0.0), (math.pi / 2, 0.0, 0.0))
    try:
        for name, build, spacing, eye, settings in (
            ("density_ramp", ramp_sheet, 0.12, above, {"factor_1": 0.25}),
            ("density_falling", ramp_sheet, 0.12, above, {"factor_0": 0.25, "factor_1": 1.0}),
            ("density_free", shaped_sheet, 0.12, above, {"factor_1": 0.3}),
            ("density_image", image_sheet, 0.1, above, {"factor_1": 0.3}),
            ("density_even", curved_body, 0.1, front, {"density_source": "NONE"}),
            ("density_curvature", curved_body, 0.1, front, {"factor_1": 0.35}),
        ):
            begin()
            draw(build(), folder / f"{name}.png", spacing, eye, **settings)
    finally:
        meander.unregister()


main()
