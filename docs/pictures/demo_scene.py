# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script, first part of the demo: Suzanne, a seed drawn on her, and a painted vertex group.

    blender --background --factory-startup --python docs/pictures/demo_scene.py -- SCENE.blend

Leaves a scene as a user would make it by hand: nothing in it refers to Meander.
"""

import math
import sys

import bpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree

SURFACE = "Suzanne"
SEED = "Seed"
DENSITY_GROUP = "Fine"

# Eyes and muzzle, where the curve is to be finer: centre, radius of full weight, radius of none.
FINE_REGIONS = [
    (Vector((0.35, -0.75, 0.24)), 0.30, 0.60),
    (Vector((-0.35, -0.75, 0.24)), 0.30, 0.60),
    (Vector((0.0, -0.80, -0.45)), 0.30, 0.75),
]

# Loops of the seed, seen from the front: centre in x and z, radius. One for each of her three
# parts, head and eyes, since a curve cannot leave the part it starts on.
SEED_LOOPS = [
    (Vector((0.0, 0.0, 0.62)), 0.16),
    (Vector((0.35, 0.0, 0.24)), 0.09),
    (Vector((-0.35, 0.0, 0.24)), 0.09),
]
POINTS_PER_LOOP = 32


def smooth_falloff(distance: float, inner: float, outer: float) -> float:
    """1 up to `inner`, 0 from `outer`, a smooth step between them."""
    t = min(max((outer - distance) / (outer - inner), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def add_suzanne() -> bpy.types.Object:
    bpy.ops.mesh.primitive_monkey_add(size=2.0)
    suzanne = bpy.context.object
    suzanne.name = SURFACE
    # Leaning back, she rests on her chin and the back of her head.
    suzanne.rotation_euler = (math.radians(-30.0), 0.0, 0.0)
    subdivision = suzanne.modifiers.new("Subdivision", "SUBSURF")
    subdivision.levels = subdivision.render_levels = 3
    for polygon in suzanne.data.polygons:
        polygon.use_smooth = True
    return suzanne


def paint_fine_regions(suzanne: bpy.types.Object) -> None:
    group = suzanne.vertex_groups.new(name=DENSITY_GROUP)
    for vertex in suzanne.data.vertices:
        weight = max(
            smooth_falloff((vertex.co - centre).length, inner, outer)
            for centre, inner, outer in FINE_REGIONS
        )
        if weight > 0.0:
            group.add([vertex.index], weight, "REPLACE")


def draw_seed(suzanne: bpy.types.Object) -> bpy.types.Object:
    """Draws the loops on the smooth surface, as Blender's Draw tool does with Depth: Surface."""
    tree = BVHTree.FromObject(suzanne, bpy.context.evaluated_depsgraph_get())
    data = bpy.data.curves.new(SEED, "CURVE")
    data.dimensions = "3D"
    for centre, radius in SEED_LOOPS:
        spline = data.splines.new("POLY")
        spline.points.add(POINTS_PER_LOOP - 1)
        spline.use_cyclic_u = True
        for i, point in enumerate(spline.points):
            angle = 2.0 * math.pi * i / POINTS_PER_LOOP
            before = centre + radius * Vector((math.cos(angle), 0.0, math.sin(angle)))
            before.y = -3.0
            hit, _normal, _face, _distance = tree.ray_cast(before, Vector((0.0, 1.0, 0.0)))
            if hit is None:
                raise RuntimeError(f"the seed's loop around {tuple(centre)} misses Suzanne")
            point.co = (*hit, 1.0)
    seed = bpy.data.objects.new(SEED, data)
    seed.rotation_euler = suzanne.rotation_euler
    bpy.context.collection.objects.link(seed)
    return seed


def main(path: str) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    suzanne = add_suzanne()
    paint_fine_regions(suzanne)
    draw_seed(suzanne)
    bpy.ops.wm.save_as_mainfile(filepath=path, compress=True)


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1])
