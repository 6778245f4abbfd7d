# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: makes the pictures of docs/strands.md.

    bash docs/pictures/make.sh strands

FOLDER is docs/images by default. Workbench renders them, which needs an EGL driver but no display.
Those in the folder have since been reduced to 96 colours.
"""

import math
import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "addon"))

import meander  # noqa: E402  (the path comes first)

SIZE = (360, 290)
INK = (0.02, 0.02, 0.025)
COLOURS = {
    "Red": (0.62, 0.06, 0.05),
    "Blue": (0.04, 0.16, 0.55),
    "Green": (0.03, 0.33, 0.12),
    "Gold": (0.65, 0.36, 0.02),
    "Purple": (0.27, 0.05, 0.42),
}
SURFACE = (0.82, 0.81, 0.78)


def material(name: str, colour: tuple) -> bpy.types.Material:
    made = bpy.data.materials.new(name)
    made.diffuse_color = (*colour, 1.0)
    return made


def begin() -> None:
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


def link(name: str, data: bpy.types.ID | None) -> bpy.types.Object:
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def surface_of(thing: bpy.types.Object) -> bpy.types.Object:
    thing.data.materials.clear()
    thing.data.materials.append(material("Surface", SURFACE))
    for polygon in thing.data.polygons:
        polygon.use_smooth = True
    return thing


def curve(name: str, strands: list, cyclic: list, colours: list) -> bpy.types.Object:
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "3D"
    for index, (points, is_cyclic) in enumerate(zip(strands, cyclic, strict=True)):
        spline = data.splines.new("POLY")
        spline.points.add(len(points) - 1)
        for point, place in zip(spline.points, points, strict=True):
            point.co = (*place, 1.0)
        spline.use_cyclic_u = is_cyclic
        data.materials.append(colours[index])
        spline.material_index = index
    return link(name, data)


def fill(surface: bpy.types.Object, spacing: float, **settings) -> bpy.types.Object:
    bpy.context.view_layer.objects.active = surface
    surface.meander.spacing = spacing
    surface.meander.bevel_share = 0.17
    for name, value in settings.items():
        setattr(surface.meander, name, value)
    assert bpy.ops.meander.run() == {"FINISHED"}
    result = bpy.context.view_layer.objects.active
    if not surface.meander.seed and not surface.meander.guides:
        result.data.materials[0] = material("Ink", INK)
    return result


def knob(place: tuple, radius: float, name: str) -> None:
    bpy.ops.mesh.primitive_uv_sphere_add(radius=radius, location=place)
    bpy.context.active_object.data.materials.append(material(name, COLOURS[name]))


def render(path: Path, eye: tuple, lens: float = 85.0) -> None:
    scene = bpy.context.scene
    camera = link("Camera", bpy.data.cameras.new("Camera"))
    camera.data.lens = lens
    camera.location = eye
    camera.rotation_euler = (-camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.camera = camera
    for thing in scene.objects:  # seeds and guides have become the result's splines
        thing.hide_render = thing.type == "CURVE" and thing.meander.surface is None
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.display.shading.light = "STUDIO"
    scene.display.shading.color_type = "MATERIAL"
    scene.display.shading.show_cavity = False
    scene.display.render_aa = "16"
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = (1.0, 1.0, 1.0)
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.compression = 100
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def on_torus(u: float, v: float) -> tuple:
    d = 1.0 + 0.42 * math.cos(v)
    return (d * math.cos(u), d * math.sin(u), 0.42 * math.sin(v))


def mixed(folder: Path) -> None:
    begin()
    bpy.ops.mesh.primitive_torus_add(
        major_radius=1.0, minor_radius=0.42, major_segments=64, minor_segments=28
    )
    surface = surface_of(bpy.context.active_object)
    through = [on_torus(4.0, 2.0 * math.pi * k / 24) for k in range(24)]
    loop = [on_torus(5.6 + 0.1 * math.cos(a), 0.8 + 0.2 * math.sin(a)) for a in (0, 1.5, 3, 4.5)]
    lines = [[on_torus(u, 0.9), on_torus(u + 0.2, 0.9)] for u in (0.6, 2.2, 5.0)]
    colours = [material(name, colour) for name, colour in COLOURS.items()]
    seed = curve("Seed", [through, loop, *lines], [True, True, False, False, False], colours)
    fill(surface, 0.085, seed=seed)
    render(folder / "strands_mixed.png", (0.0, -5.6, 5.8))


def one_stroke(folder: Path) -> None:
    begin()
    bpy.ops.mesh.primitive_monkey_add()
    monkey = bpy.context.active_object
    # Only the head, of its three parts: an eye is a part that a stroke cannot reach.
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.separate(type="LOOSE")
    bpy.ops.object.mode_set(mode="OBJECT")
    parts = [thing for thing in bpy.context.scene.objects if thing.type == "MESH"]
    surface = max(parts, key=lambda thing: len(thing.data.vertices))
    for part in parts:
        if part != surface:
            bpy.data.objects.remove(part)
    del monkey
    surface_of(surface)
    bpy.ops.object.select_all(action="DESELECT")
    ends = []
    tips = (min, max)
    for name, choose in zip("AB", tips, strict=True):
        vertex = choose(surface.data.vertices, key=lambda item: item.co.x)
        end = link(name, None)
        end.location = surface.matrix_world @ vertex.co
        ends.append(end)
    bpy.context.view_layer.update()
    fill(surface, 0.07, stroke_from=ends[0], stroke_to=ends[1])
    for end, name in zip(ends, ("Red", "Blue"), strict=True):
        knob(end.location, 0.05, name)
    render(folder / "strands_stroke.png", (0.6, -6.6, 1.6))


def guides(folder: Path) -> None:
    begin()
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=60, y_subdivisions=48, size=2.0)
    surface = surface_of(bpy.context.active_object)
    surface.scale = (1.25, 1.0, 1.0)
    for vertex in surface.data.vertices:
        vertex.co.z = 0.12 * math.cos(2.2 * vertex.co.x) * math.cos(2.0 * vertex.co.y)
    bpy.context.view_layer.update()

    def heart(a: float) -> tuple:
        x = 16 * math.sin(a) ** 3
        y = 13 * math.cos(a) - 5 * math.cos(2 * a) - 2 * math.cos(3 * a) - math.cos(4 * a)
        return place(0.034 * x, 0.034 * y + 0.08)

    def place(x: float, y: float) -> tuple:
        return (x, y, 0.12 * math.cos(2.2 * x / 1.25) * math.cos(2.0 * y))

    outline = [heart(2 * math.pi * k / 60) for k in range(60)]
    stem = [place(0.0, -0.5 - 0.1 * k) for k in range(6)]
    drawn = curve(
        "Guides",
        [outline, stem],
        [True, False],
        [material("Red", COLOURS["Red"]), material("Green", COLOURS["Green"])],
    )
    result = fill(surface, 0.075, guides=drawn)
    result.data.materials.append(material("Ink", INK))
    for spline in list(result.data.splines)[2:]:
        spline.material_index = 2
    render(folder / "strands_guides.png", (0.0, -3.4, 6.8), 95.0)


def letters(folder: Path) -> None:
    begin()
    text = bpy.data.curves.new("One Line", "FONT")
    text.body, text.size, text.align_x, text.align_y = "Line", 1.9, "CENTER", "CENTER"
    text.offset, text.resolution_u = 0.045, 6
    bpy.context.view_layer.objects.active = link("One Line", text)
    bpy.context.active_object.select_set(True)
    bpy.ops.object.convert(target="MESH")
    surface = surface_of(bpy.context.active_object)
    fill(surface, 0.085, bridge_parts=True)
    render(folder / "strands_bridges.png", (0.0, -1.2, 9.4), 95.0)


def main() -> None:
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    folder = Path(arguments[0]) if arguments else ROOT / "docs" / "images"
    meander.register()
    try:
        for picture in (mixed, one_stroke, guides, letters):
            picture(folder)
    finally:
        meander.unregister()


if __name__ == "__main__":
    main()
