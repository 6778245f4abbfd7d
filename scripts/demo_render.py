# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script, last part of the demo: light, camera, materials, and the picture.

    blender --background --python scripts/demo_render.py -- SCENE.blend PICTURE.png

Saves the scene as rendered, so that opening it shows the picture's view.
"""

import sys

import bpy
from mathutils import Vector
from mathutils.kdtree import KDTree

SURFACE = "Suzanne"
SEED = "Seed"
RESULT = "Suzanne Meander"
DENSITY_GROUP = "Fine"
# Radius of the tube in scene units where the weight is 0, and its factor at weight 1: a fifth of
# the spacing, and the same factor as the spacing.
TUBE_RADIUS = 0.0105
FACTOR_AT_WEIGHT_1 = 0.5
PICTURE_SIZE = (1000, 800)
SAMPLES = 48


def material(name: str, colour: tuple, roughness: float):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.diffuse_color = (*colour, 1.0)
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    return made


def aim(thing: bpy.types.Object, target: Vector) -> None:
    thing.rotation_euler = (target - thing.location).to_track_quat("-Z", "Y").to_euler()


def add_light(name: str, location: tuple, size: float, watts: float, colour: tuple) -> None:
    data = bpy.data.lights.new(name, "AREA")
    data.shape = "DISK"
    data.size = size
    data.energy = watts
    data.color = colour
    light = bpy.data.objects.new(name, data)
    light.location = location
    aim(light, Vector((0.0, 0.0, 0.0)))
    bpy.context.scene.collection.objects.link(light)


def add_camera() -> None:
    data = bpy.data.cameras.new("Camera")
    data.lens = 88.0
    camera = bpy.data.objects.new("Camera", data)
    camera.location = (2.5, -6.2, 3.6)
    aim(camera, Vector((0.03, -0.05, -0.08)))
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def add_floor(height: float) -> None:
    half = 40.0
    corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
    data = bpy.data.meshes.new("Floor")
    data.from_pydata([(x, y, height) for x, y in corners], [], [(0, 1, 2, 3)])
    data.materials.append(material("Floor", (0.17, 0.21, 0.26), 0.9))
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Floor", data))


def lowest_point(thing: bpy.types.Object) -> float:
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    lowest = min((thing.matrix_world @ vertex.co).z for vertex in mesh.vertices)
    evaluated.to_mesh_clear()
    return lowest


def thin_where_dense(surface: bpy.types.Object, curve: bpy.types.Object) -> None:
    """Makes the tube follow the spacing; curve and surface share one space."""
    group = surface.vertex_groups[DENSITY_GROUP].index
    evaluated = surface.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    tree = KDTree(len(mesh.vertices))
    weights = []
    for vertex in mesh.vertices:
        tree.insert(vertex.co, vertex.index)
        weights.append(sum(entry.weight for entry in vertex.groups if entry.group == group))
    tree.balance()
    evaluated.to_mesh_clear()
    for spline in curve.data.splines:
        for point in spline.points:
            weight = weights[tree.find(point.co.xyz)[1]]
            point.radius = 1.0 + weight * (FACTOR_AT_WEIGHT_1 - 1.0)


def dress(surface: bpy.types.Object, curve: bpy.types.Object) -> None:
    surface.data.materials.clear()
    surface.data.materials.append(material("Head", (0.012, 0.016, 0.028), 0.42))
    curve.data.materials.clear()
    curve.data.materials.append(material("Curve", (1.0, 0.20, 0.035), 0.38))
    curve.data.bevel_mode = "ROUND"
    curve.data.bevel_depth = TUBE_RADIUS
    curve.data.bevel_resolution = 2
    thin_where_dense(surface, curve)


def set_the_stage() -> None:
    scene = bpy.context.scene
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.045, 0.06, 0.09, 1.0)
    background.inputs["Strength"].default_value = 0.8
    scene.world = world
    add_light("Key", (-3.6, -3.4, 5.0), 2.0, 620.0, (1.0, 0.93, 0.84))
    add_light("Fill", (6.0, -4.0, 3.0), 5.0, 200.0, (0.62, 0.78, 1.0))
    add_light("Rim", (2.5, 4.5, 4.0), 2.0, 500.0, (0.75, 0.86, 1.0))
    add_floor(lowest_point(bpy.data.objects[SURFACE]) - TUBE_RADIUS)
    add_camera()

    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = SAMPLES
    # Debian's Blender is built without a denoiser; adaptive sampling spends the time on shadows.
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = True
    scene.cycles.adaptive_threshold = 0.03
    scene.cycles.max_bounces = 3
    scene.cycles.sample_clamp_indirect = 2.0
    scene.render.resolution_x, scene.render.resolution_y = PICTURE_SIZE
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.view_settings.look = "Medium High Contrast"


def main(scene: str, picture: str) -> None:
    bpy.ops.wm.open_mainfile(filepath=scene)
    objects = bpy.data.objects
    dress(objects[SURFACE], objects[RESULT])
    objects[SEED].hide_render = True
    objects[SEED].hide_viewport = True
    set_the_stage()
    bpy.context.scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)
    bpy.ops.wm.save_mainfile(compress=True)


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 :])
