# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script of test_installed.py: fills a sphere with the installed add-on's operator.

    blender --background --python fill_with_operator.py -- FOUND.json

Writes what it found; the test judges it.
"""

import json
import math
import os
import sys
from pathlib import Path

import bpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree

# Where bpy is a module of Python, importing it is what puts Blender's own modules on the path.
import addon_utils  # isort: skip

SPACING = 0.25


def enabled_module() -> str:
    """The add-on's module, enabled as the saved preferences have it.

    Under bpy, which always starts with factory settings, the preferences are read first; bpy 4.2
    crashes at that, as it asks for a graphics card, and enables the add-on again.
    """
    name = "bl_ext.user_default.meander" if bpy.app.version >= (4, 2, 0) else "meander"
    if not bpy.app.binary_path:
        if bpy.app.version < (4, 5):
            addon_utils.enable(name, default_set=True)
        else:
            bpy.ops.wm.read_userpref()
    saved, loaded = addon_utils.check(name)
    if not (saved and loaded):
        raise SystemExit(f"{name}: in the preferences {saved}, loaded {loaded}; should be both")
    return name


def length_of(spline: bpy.types.Spline) -> float:
    points = [point.co.xyz for point in spline.points]
    if spline.use_cyclic_u:
        points.append(points[0])
    return sum((b - a).length for a, b in zip(points, points[1:]))


def add_seed() -> bpy.types.Object:
    data = bpy.data.curves.new("Seed", "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("POLY")
    spline.points.add(23)
    spline.use_cyclic_u = True
    for i, point in enumerate(spline.points):
        angle = 2.0 * math.pi * i / 24
        on_sphere = Vector((0.4 * math.cos(angle), 0.4 * math.sin(angle), 1.0)).normalized()
        point.co = (*on_sphere, 1.0)
    seed = bpy.data.objects.new("Seed", data)
    bpy.context.collection.objects.link(seed)
    return seed


def loaded_libraries() -> list[str]:
    """Files of ours that this process has mapped."""
    paths = {
        line.split(maxsplit=5)[5].strip()
        for line in Path("/proc/self/maps").read_text().splitlines()
        if len(line.split(maxsplit=5)) == 6
    }
    return sorted(path for path in paths if "libmeander" in path)


def main(report: str) -> None:
    module = enabled_module()
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4, radius=1.0)
    surface = bpy.context.object
    seed = add_seed()
    seed_length = length_of(seed.data.splines[0])

    bpy.context.view_layer.objects.active = surface
    surface.meander.seed = seed
    surface.meander.spacing = SPACING
    before = set(bpy.context.scene.objects)
    result = bpy.ops.meander.run()
    if result != {"FINISHED"}:
        raise SystemExit(f"the operator returned {result}")
    (curve,) = set(bpy.context.scene.objects) - before

    stitches = Path(report).with_suffix(".dst")
    if bpy.ops.meander.export_toolpath(filepath=str(stitches), size=60.0) != {"FINISHED"}:
        raise SystemExit("no embroidery was written")

    # Of the whole package, whatever Blender calls it here.
    preferences = bpy.context.preferences.addons[module].preferences
    preferences.most_points += 1
    limit = sys.modules[f"{module}.ui.preferences"]._limit("most_points")

    tree = BVHTree.FromObject(surface, bpy.context.evaluated_depsgraph_get())
    splines = curve.data.splines
    found = {
        "addon": str(Path(sys.modules[module].__file__).parent),
        "libraries": loaded_libraries(),
        "embroidery": sys.modules["pyembroidery"].__file__,
        "stitches": stitches.stat().st_size,
        "limits": [preferences.most_points, limit],
        "cyclic": [spline.use_cyclic_u for spline in splines],
        "length": sum(length_of(spline) for spline in splines),
        "seed_length": seed_length,
        "spacing": SPACING,
        "area": sum(polygon.area for polygon in surface.data.polygons),
        "farthest_from_surface": max(
            tree.find_nearest(point.co.xyz)[3] for spline in splines for point in spline.points
        ),
    }
    Path(report).write_text(json.dumps(found, indent=1))
    addon_utils.disable(module)
    if not bpy.app.binary_path:
        os._exit(0)  # bpy 4.2 crashes in its clean-up at exit once classes have been registered


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1])
