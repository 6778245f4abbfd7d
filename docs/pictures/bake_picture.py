# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: the picture of baked frames in docs/motion.md.

    bash docs/pictures/make.sh bake

Fills a tube, bakes its curve while an armature bends it, saves the scene, and lets a Blender
without the add-on render three frames, which the picture shows side by side.
"""

import math
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
FRAMES, SHOWN = 24, (1, 12, 24)
SPACING = 0.2
SIZE = (200, 330)


def armature() -> bpy.types.Object:
    """Two bones along Z; the upper one turns by 90 degrees."""
    data = bpy.data.armatures.new("Bones")
    bones = bpy.data.objects.new("Bones", data)
    bpy.context.scene.collection.objects.link(bones)
    bpy.context.view_layer.objects.active = bones
    bpy.ops.object.mode_set(mode="EDIT")
    for name, begin, end in (("Lower", 0.0, 2.0), ("Upper", 2.0, 4.0)):
        bone = data.edit_bones.new(name)
        bone.head, bone.tail = (0.0, 0.0, begin), (0.0, 0.0, end)
    data.edit_bones["Upper"].parent = data.edit_bones["Lower"]
    bpy.ops.object.mode_set(mode="OBJECT")
    upper = bones.pose.bones["Upper"]
    upper.rotation_mode = "XYZ"
    for frame, angle in ((1, 0.0), (FRAMES, math.pi / 2)):
        upper.rotation_euler = (angle, 0.0, 0.0)
        upper.keyframe_insert("rotation_euler", frame=frame)
    return bones


def tube(bones: bpy.types.Object) -> bpy.types.Object:
    around, along, radius = 48, 60, 0.6
    angles = 2.0 * np.pi * np.arange(around) / around
    levels = np.linspace(0.0, 4.0, along + 1)
    vertices = [(radius * np.cos(a), radius * np.sin(a), z) for z in levels for a in angles]
    faces = []
    for j in range(along):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            faces.append((a, b, b + around, a + around))
    mesh = bpy.data.meshes.new("Tube")
    mesh.from_pydata(vertices, [], faces)
    thing = bpy.data.objects.new("Tube", mesh)
    bpy.context.scene.collection.objects.link(thing)
    groups = [thing.vertex_groups.new(name=name) for name in ("Lower", "Upper")]
    for index, (_x, _y, z) in enumerate(vertices):
        share = min(max((z - 0.8) / 2.4, 0.0), 1.0)
        share = share * share * (3.0 - 2.0 * share)
        groups[0].add([index], 1.0 - share, "REPLACE")
        groups[1].add([index], share, "REPLACE")
    thing.modifiers.new("Armature", "ARMATURE").object = bones
    return thing


def material(name: str, colour: tuple[float, float, float]) -> bpy.types.Material:
    made = bpy.data.materials.new(name)
    made.diffuse_color = (*colour, 1.0)
    return made


def bake(path: Path) -> None:
    sys.path.insert(0, str(ROOT / "addon"))
    import meander

    bpy.ops.wm.read_factory_settings(use_empty=True)
    meander.register()
    scene = bpy.context.scene
    scene.frame_end = FRAMES
    surface = tube(armature())
    surface.data.materials.append(material("Tube", (0.80, 0.84, 0.90)))
    for polygon in surface.data.polygons:
        polygon.use_smooth = True
    scene.frame_set(1)
    bpy.context.view_layer.objects.active = surface
    surface.meander.spacing = SPACING
    assert bpy.ops.meander.run() == {"FINISHED"}
    result = bpy.context.view_layer.objects.active
    result.data.materials[0] = material("Curve", (0.80, 0.22, 0.04))
    bpy.context.view_layer.update()
    assert bpy.ops.meander.bake_motion(frame_start=1, frame_end=FRAMES) == {"FINISHED"}
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 5.0
    camera.location, camera.rotation_euler = (20.0, -0.8, 2.0), (math.pi / 2, 0.0, math.pi / 2)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.display.shading.light = "STUDIO"
    scene.display.shading.color_type = "MATERIAL"
    scene.display.render_aa = "8"
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = (1.0, 1.0, 1.0)
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.dither_intensity = 0.0  # its noise would triple the file
    scene.view_settings.view_transform = "Standard"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    meander.unregister()


def render(path: Path, folder: Path) -> None:
    """Three frames, rendered by a separate Blender."""
    command = [bpy.app.binary_path, "-b", "--factory-startup", str(path)]
    command += ["-o", str(folder / "frame_####"), "-F", "PNG"]
    command += ["-f", ",".join(map(str, SHOWN))]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def join(folder: Path, picture: Path) -> None:
    parts = []
    for frame in SHOWN:
        image = bpy.data.images.load(str(folder / f"frame_{frame:04d}.png"))
        buffer = np.empty(4 * SIZE[0] * SIZE[1], dtype=np.float32)
        image.pixels.foreach_get(buffer)
        parts.append(buffer.reshape(SIZE[1], SIZE[0], 4))
    whole = np.concatenate(parts, axis=1)[::-1, :, :3]
    write_png(picture, np.clip(np.rint(whole * 255.0), 0, 255).astype(np.uint8))


def write_png(path: Path, pixels: np.ndarray) -> None:
    """With a palette of at most 256 colours, which makes the file less than half as large."""
    for step in range(1, 64):
        reduced = np.minimum(pixels // step * step + step // 2, 255)
        reduced[pixels > 250] = 255
        colours, index = np.unique(reduced.reshape(-1, 3), axis=0, return_inverse=True)
        if len(colours) <= 256:
            break
    height, width = pixels.shape[:2]
    rows = np.zeros((height, width + 1), dtype=np.uint8)  # each row begins with its filter: none
    rows[:, 1:] = index.reshape(height, width)

    def chunk(kind: bytes, data: bytes) -> bytes:
        check = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0))
        + chunk(b"PLTE", colours.astype(np.uint8).tobytes())
        + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9))
        + chunk(b"IEND", b"")
    )


if __name__ == "__main__":
    target = Path(sys.argv[sys.argv.index("--") + 1]).absolute()
    with tempfile.TemporaryDirectory() as name:
        bake(Path(name) / "baked.blend")
        render(Path(name) / "baked.blend", Path(name))
        join(Path(name), target)
