# SPDX-License-Identifier: GPL-3.0-or-later
"""Bakes of a mesh that an armature bends: rendered by a Blender that has no add-on."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path

import bpy
import geometry
import meander
import numpy as np
import pytest
import scenes
from mathutils.bvhtree import BVHTree

FRAMES, SHOWN = 8, 6
SPACING = 0.6
# Chords of the written points leave the surface by this much, see test_motion.
ON_SURFACE = 0.006

# Run by a Blender of its own: what it finds goes into one file, what it renders into another.
LOOK = """
import sys
import bpy
import numpy as np

scene_file, picture, found, frame = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.open_mainfile(filepath=scene_file)
assert not hasattr(bpy.types.Object, "meander")
assert not [name for name in sys.modules if name.split(".")[0] == "meander"]
scene = bpy.context.scene
names = []
for number in (4, 1, int(frame)):
    scene.frame_set(number)
    shown = [o for o in scene.objects if o.type == "CURVE" and not o.hide_render]
    names += [o.name for o in shown]
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
depsgraph = bpy.context.evaluated_depsgraph_get()


def world(thing):
    evaluated = thing.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    mesh.calc_loop_triangles()
    points = [thing.matrix_world @ vertex.co for vertex in mesh.vertices]
    faces = [triangle.vertices[:] for triangle in mesh.loop_triangles]
    evaluated.to_mesh_clear()
    return np.array(points), np.array(faces, dtype=np.int64)


assert len(shown[0].modifiers) == 1, "a baked frame has the look of its result"
shown[0].modifiers.clear()
depsgraph.update()
vertices, faces = world(bpy.data.objects["Tube"])
np.savez(found, vertices=vertices, faces=faces, curve=world(shown[0])[0], names=names)
"""


def _armature() -> bpy.types.Object:
    """Two bones along Z, the upper of which turns by 90 degrees about Y over the frames."""
    data = bpy.data.armatures.new("Bones")
    bones = bpy.data.objects.new("Bones", data)
    bpy.context.scene.collection.objects.link(bones)
    scenes.activate(bones)
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


def _tube(bones: bpy.types.Object) -> bpy.types.Object:
    around, along, radius = 24, 24, 0.5
    angles = 2.0 * np.pi * np.arange(around) / around
    levels = np.linspace(0.0, 4.0, along + 1)
    vertices = [(radius * np.cos(a), radius * np.sin(a), z) for z in levels for a in angles]
    faces = [
        [j * around + i, j * around + (i + 1) % around,
         (j + 1) * around + (i + 1) % around, (j + 1) * around + i]
        for j in range(along) for i in range(around)
    ]  # fmt: skip
    tube = scenes.mesh_object("Tube", vertices, faces)
    lower = tube.vertex_groups.new(name="Lower")
    upper = tube.vertex_groups.new(name="Upper")
    for index, (_x, _y, z) in enumerate(vertices):
        share = min(max((z - 1.0) / 2.0, 0.0), 1.0)
        share = share * share * (3.0 - 2.0 * share)
        lower.add([index], 1.0 - share, "REPLACE")
        upper.add([index], share, "REPLACE")
    tube.modifiers.new("Armature", "ARMATURE").object = bones
    tube.parent = bones
    return tube


def _emission(name: str, colour: tuple[float, float, float]) -> bpy.types.Material:
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    shader, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    shader.inputs["Color"].default_value = (*colour, 1.0)
    made.node_tree.links.new(shader.outputs[0], output.inputs[0])
    return made


def _studio() -> None:
    """A camera from the side, and Cycles, which needs no graphics driver."""
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 6.0
    camera.location = (12.0, -0.5, 2.0)
    camera.rotation_euler = (math.pi / 2, 0.0, math.pi / 2)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 4
    scene.cycles.use_denoising = False
    scene.render.resolution_x = scene.render.resolution_y = 120
    scene.render.image_settings.file_format = "PNG"
    scene.view_settings.view_transform = "Standard"


@pytest.fixture
def result() -> bpy.types.Object:
    tube = _tube(_armature())
    tube.data.materials.append(_emission("Tube", (0.0, 0.0, 1.0)))
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, FRAMES
    scene.frame_set(1)
    scenes.activate(tube)
    filled = scenes.fill(tube, SPACING, use_bevel=True)
    filled.data.materials[0] = _emission("Curve", (1.0, 0.0, 0.0))
    _studio()
    return filled


@pytest.mark.parametrize("motion", ["EVEN", "STICK"])
def test_a_bake_renders_without_the_add_on(
    result: bpy.types.Object, tmp_path: Path, motion: str
) -> None:
    result.meander.motion = motion
    result.meander.motion_steps = 6
    assert bpy.ops.meander.bake_motion(frame_start=1, frame_end=FRAMES) == {"FINISHED"}
    scene_file, picture = tmp_path / "baked.blend", tmp_path / "frame.png"
    bpy.ops.wm.save_as_mainfile(filepath=str(scene_file), copy=True)
    script = tmp_path / "look.py"
    script.write_text(LOOK, encoding="utf-8")
    if bpy.app.binary_path:
        command = [bpy.app.binary_path, "-b", "--factory-startup", "--python-exit-code", "1"]
        command += ["--python", str(script)]
    else:
        command = [sys.executable, str(script)]
    found = tmp_path / "found.npz"
    command += ["--", str(scene_file), str(picture), str(found), str(SHOWN)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=240)
    assert done.returncode == 0, done.stdout + done.stderr

    pixels = _pixels(picture)
    red, blue = pixels[..., 0] > 0.5, pixels[..., 2] > 0.5
    # Both are to be seen, the curve on the tube and nowhere else in numbers.
    assert red.mean() > 0.02
    assert blue.mean() > 0.02
    assert 0.05 < (red | blue).mean() < 0.5
    bent = np.load(found)
    bpy.context.scene.frame_set(SHOWN)
    vertices, faces = scenes.world_triangles(bpy.data.objects["Tube"])
    assert np.allclose(bent["vertices"], vertices, atol=1e-5)  # as this Blender bends it
    assert np.ptp(vertices[:, 1]) > 2.0  # and it is bent indeed
    tree = BVHTree.FromPolygons(bent["vertices"].tolist(), bent["faces"].tolist())
    distances = [tree.find_nearest(point)[3] for point in bent["curve"].tolist()]
    assert max(distances) < ON_SURFACE
    pieces = np.linalg.norm(np.diff(bent["curve"], axis=0), axis=1)
    frames = [f"{result.name} {frame:04d}" for frame in (4, 1, SHOWN)]
    assert len(bent["names"]) == len(frames), "one curve in every frame"
    if motion == "EVEN":
        assert bent["names"].tolist() == frames
        assert 0.85 < pieces.sum() * SPACING / geometry.triangle_areas(vertices, faces).sum() < 1.15


def test_the_batch_command_bakes(result: bpy.types.Object, tmp_path: Path, run_batch) -> None:
    bpy.data.objects.remove(result)
    scenes.activate(bpy.data.objects["Tube"])
    before = scenes.saved(tmp_path / "tube.blend")
    output = tmp_path / "baked.blend"
    arguments = ("--input", before, "--output", output, "--spacing", SPACING, "--quiet")
    done = run_batch(*arguments, "--bake-frames", 1, 4, "--motion-steps", 5)
    assert done.returncode == 0, done.stderr
    bpy.ops.wm.open_mainfile(filepath=str(output))
    frames = bpy.data.collections["Tube Meander Frames"].objects
    assert len(frames) == 4
    for frame in (4, 2):
        bpy.context.scene.frame_set(frame)
        shown = next(thing for thing in frames if not thing.hide_render)
        assert scenes.farthest_from(bpy.data.objects["Tube"], shown) < ON_SURFACE
    moving = output.with_suffix(".usda")
    meander.unregister()  # as where batch.py is run, and the add-on is not on
    try:
        done = run_batch(*arguments, "--output", moving, "--bake-frames", 3, 4)
    finally:
        meander.register()
    assert done.returncode == 0 and moving.read_text().count("timeSamples") > 3, done.stderr
    output.unlink()
    for extra, words in (
        (("--bake-frames", 4, 1), "earlier frame first"),
        (("--motion", "stick"), "--bake-frames"),
    ):
        done = run_batch(*arguments, *extra)
        assert done.returncode == 2
        assert words in done.stderr
        assert not output.exists()


def _pixels(picture: Path) -> np.ndarray:
    image = bpy.data.images.load(str(picture))
    width, height = image.size
    buffer = np.empty(4 * width * height, dtype=np.float32)
    image.pixels.foreach_get(buffer)
    bpy.data.images.remove(image)
    return buffer.reshape(height, width, 4)
