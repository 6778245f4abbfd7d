# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: the picture of docs/motion.md, a tube that is bent and stretched.

    bash docs/pictures/make.sh motion

Above, the curve keeps its spacing; below, its points stick to their faces.
"""

import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "addon"))

from meander import core  # noqa: E402
from meander.run import motion  # noqa: E402
from meander.scene import curve_writer  # noqa: E402

SPACING, HEIGHT, FRAMES, STEPS = 0.3, 4.0, 24, 3
SHOWN = (0, 12, 24)


def tube() -> tuple[np.ndarray, np.ndarray]:
    around, along = 48, 40
    angles = 2 * np.pi * np.arange(around) / around
    levels = np.linspace(0.0, HEIGHT, along + 1)
    vertices = np.array([[np.cos(a), np.sin(a), z] for z in levels for a in angles])
    faces = []
    for j in range(along):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            faces += [[a, b, b + around], [a, b + around, a + around]]
    return vertices, np.array(faces, dtype=np.uint32)


def bent(vertices: np.ndarray, share: float) -> np.ndarray:
    """Stretched to twice its length and bent by 90 degrees, at share 1."""
    z = vertices[:, 2] * (1.0 + share)
    if share == 0.0:
        return vertices
    centre = HEIGHT * (1.0 + share) / (0.5 * np.pi * share)
    angle = z / centre
    far = centre - vertices[:, 0]
    return np.column_stack([centre - far * np.cos(angle), vertices[:, 1], far * np.sin(angle)])


def material(name: str, colour: tuple[float, float, float]) -> bpy.types.Material:
    made = bpy.data.materials.new(name)
    made.diffuse_color = (*colour, 1.0)
    return made


def show(vertices: np.ndarray, faces: np.ndarray, curve: core.Polylines, place: tuple) -> None:
    mesh = bpy.data.meshes.new("Tube")
    mesh.from_pydata(vertices.tolist(), [], faces.tolist())
    mesh.materials.append(bpy.data.materials["Tube"])
    for polygon in mesh.polygons:
        polygon.use_smooth = True
    thing = bpy.data.objects.new("Tube", mesh)
    thing.location = place
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.update()
    moved = curve._replace(positions=curve.positions + np.array(place))
    strand = curve_writer.write_curve(moved, thing, "Curve", bevel_depth=0.06)
    strand.data.materials.append(bpy.data.materials["Curve"])


def main(picture: str) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    material("Tube", (0.80, 0.84, 0.90))
    material("Curve", (0.80, 0.22, 0.04))
    vertices, faces = tube()
    options = core.default_options()
    options.radius = SPACING / 2
    with core.Surface(vertices, faces) as surface:
        flow = core.Flow(surface, options)
    flow.run()
    start = flow.polylines()
    sticking = motion.StickingFollower(
        start.positions, start.offsets, start.closed, None, vertices, faces
    )
    for frame in range(FRAMES + 1):
        moved = bent(vertices, frame / FRAMES)
        if frame:
            flow.set_vertices(moved)
            for _ in range(STEPS):
                flow.step()
        if frame in SHOWN:
            column = SHOWN.index(frame)
            for row, curve in enumerate((flow.polylines(), sticking.moved(moved, faces))):
                show(moved, faces, curve, (5.0 * column, 0.0, -7.5 * row))
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 19.5
    centre = Vector((7.7, 0.0, -0.7))
    camera.location = centre + Vector((0.0, -40.0, 8.0))
    camera.rotation_euler = (centre - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.display.shading.light = "FLAT"
    scene.display.shading.color_type = "MATERIAL"
    scene.display.shading.show_cavity = False
    scene.display.shading.show_object_outline = True
    scene.display.render_aa = "8"
    world = bpy.data.worlds.new("World")
    world.color = (1.0, 1.0, 1.0)
    scene.world = world
    scene.render.resolution_x, scene.render.resolution_y = 560, 410
    scene.render.dither_intensity = 0.0  # its noise would triple the file
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.compression = 100
    scene.view_settings.view_transform = "Standard"
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1])
