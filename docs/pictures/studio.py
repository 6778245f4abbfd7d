# SPDX-License-Identifier: GPL-3.0-or-later
"""The photographer's studio that the pictures of the README and the gallery are taken in.

Three lights, a floor, a camera, and Cycles: it needs no graphics card and looks the same
everywhere. For scripts inside Blender.
"""

from __future__ import annotations

from collections.abc import Iterable

import bmesh
import bpy
from mathutils import Vector

Colour = tuple[float, float, float]

SAMPLES = 48
FLOOR: Colour = (0.17, 0.21, 0.26)


def material(name: str, colour: Colour, roughness: float) -> bpy.types.Material:
    """A plain material, of the same colour in a viewport."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.diffuse_color = (*colour, 1.0)
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    return made


def aim(thing: bpy.types.Object, target: Vector) -> None:
    """Turns a light or a camera towards a place."""
    thing.rotation_euler = (target - thing.location).to_track_quat("-Z", "Y").to_euler()


def add_light(
    name: str, location: tuple[float, float, float], size: float, watts: float, colour: Colour
) -> None:
    """A disc of light of a diameter, aimed at the origin."""
    data = bpy.data.lights.new(name, "AREA")
    data.shape = "DISK"
    data.size = size
    data.energy = watts
    data.color = colour
    light = bpy.data.objects.new(name, data)
    light.location = location
    aim(light, Vector((0.0, 0.0, 0.0)))
    bpy.context.scene.collection.objects.link(light)


def add_camera(
    location: tuple[float, float, float], target: tuple[float, float, float], lens: float
) -> None:
    """The scene's camera, at a place, towards another; lens in millimetres."""
    data = bpy.data.cameras.new("Camera")
    data.lens = lens
    camera = bpy.data.objects.new("Camera", data)
    camera.location = location
    aim(camera, Vector(target))
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def add_floor(height: float, colour: Colour = FLOOR) -> None:
    """A floor without an end at a height."""
    half = 40.0
    corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
    data = bpy.data.meshes.new("Floor")
    data.from_pydata([(x, y, height) for x, y in corners], [], [(0, 1, 2, 3)])
    data.materials.append(material("Floor", colour, 0.9))
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Floor", data))


def lowest_point(things: Iterable[bpy.types.Object]) -> float:
    """The height on which objects stand, as they are displayed."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    lowest = []
    for thing in things:
        evaluated = thing.evaluated_get(depsgraph)
        mesh = evaluated.to_mesh()
        lowest += [(thing.matrix_world @ vertex.co).z for vertex in mesh.vertices]
        evaluated.to_mesh_clear()
    return min(lowest)


def add_lights(strength: float = 1.0) -> None:
    """Key, fill, rim, and a bluish sky; strength is their brightness, 1 for a day."""
    scene = bpy.context.scene
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.045, 0.06, 0.09, 1.0)
    background.inputs["Strength"].default_value = 0.8 * strength
    scene.world = world
    add_light("Key", (-3.6, -3.4, 5.0), 2.0, 620.0 * strength, (1.0, 0.93, 0.84))
    add_light("Fill", (6.0, -4.0, 3.0), 5.0, 200.0 * strength, (0.62, 0.78, 1.0))
    add_light("Rim", (2.5, 4.5, 4.0), 2.0, 500.0 * strength, (0.75, 0.86, 1.0))


def take_picture(path: str, size: tuple[int, int], samples: int = SAMPLES) -> None:
    """Renders what the camera sees into a PNG."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    # Debian's Blender is built without a denoiser; adaptive sampling spends the time on shadows.
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = True
    scene.cycles.adaptive_threshold = 0.03
    scene.cycles.max_bounces = 3
    scene.cycles.sample_clamp_indirect = 2.0
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.view_settings.view_transform = "Filmic"  # the default has changed since Blender 3.4
    scene.view_settings.look = "Medium High Contrast"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def divide(mesh: bpy.types.Mesh, edge: float) -> None:
    """Triangles whose edges are no longer than this: a direction has a value at each vertex."""
    shape = bmesh.new()
    shape.from_mesh(mesh)
    bmesh.ops.triangulate(shape, faces=shape.faces)
    while longer := [e for e in shape.edges if e.calc_length() > edge]:
        longest = [e for e in longer if all(
            e is max(face.edges, key=lambda other: other.calc_length()) for face in e.link_faces
        )]  # fmt: skip
        bmesh.ops.subdivide_edges(shape, edges=longest or longer[:1], cuts=1)
        bmesh.ops.triangulate(shape, faces=[face for face in shape.faces if len(face.verts) > 3])
    shape.to_mesh(mesh)
    shape.free()
