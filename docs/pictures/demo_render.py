# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script, last part of the demo: light, camera, materials, and the picture.

    blender --background --python docs/pictures/demo_render.py -- SCENE.blend PICTURE.png [SAMPLES]

Saves the scene as rendered, so that opening it shows the picture's view.
"""

import sys
from pathlib import Path

import bpy
from mathutils.kdtree import KDTree

sys.path.insert(0, str(Path(__file__).resolve().parent))

import studio  # noqa: E402

SURFACE = "Suzanne"
SEED = "Seed"
RESULT = "Suzanne Meander"
DENSITY_GROUP = "Fine"
# Radius of the tube in scene units where the weight is 0, and its factor at weight 1: a fifth of
# the spacing, and the same factor as the spacing.
TUBE_RADIUS = 0.0105
FACTOR_AT_WEIGHT_1 = 0.5
PICTURE_SIZE = (1000, 800)


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
    surface.data.materials.append(studio.material("Head", (0.012, 0.016, 0.028), 0.42))
    curve.data.materials.clear()
    curve.data.materials.append(studio.material("Curve", (1.0, 0.20, 0.035), 0.38))
    curve.data.bevel_mode = "ROUND"
    curve.data.bevel_depth = TUBE_RADIUS
    curve.data.bevel_resolution = 2
    thin_where_dense(surface, curve)


def main(scene: str, picture: str, samples: str = str(studio.SAMPLES)) -> None:
    bpy.ops.wm.open_mainfile(filepath=scene)
    objects = bpy.data.objects
    dress(objects[SURFACE], objects[RESULT])
    objects[SEED].hide_render = True
    objects[SEED].hide_viewport = True
    studio.add_lights()
    studio.add_floor(studio.lowest_point([objects[SURFACE]]) - TUBE_RADIUS)
    studio.add_camera((2.5, -6.2, 3.6), (0.03, -0.05, -0.08), 88.0)
    studio.take_picture(picture, PICTURE_SIZE, int(samples))
    bpy.ops.wm.save_mainfile(compress=True)


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 :])
