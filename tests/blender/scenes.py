# SPDX-License-Identifier: GPL-3.0-or-later
"""Small surfaces and seeds, and yardsticks for what became of them."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import bpy
import geometry
import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

# Enough for a small run to settle, and an end to one that does not.
ITERATIONS = 400
# Whether this Blender has the Grease Pencil that 4.3 made anew.
NEW_STROKES = bpy.app.version >= (4, 3)


def activate(thing: bpy.types.Object) -> bpy.types.Object:
    for other in bpy.data.objects:
        other.select_set(other == thing)
    bpy.context.view_layer.objects.active = thing
    return thing


def mesh_object(name: str, vertices, faces) -> bpy.types.Object:
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, v)) for v in vertices], [], [list(f) for f in faces])
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return activate(thing)


def sphere(radius: float = 1.0, subdivisions: int = 3) -> bpy.types.Object:
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions, radius=radius)
    return activate(bpy.context.active_object)


def cube() -> bpy.types.Object:
    bpy.ops.mesh.primitive_cube_add(size=2.0)
    return activate(bpy.context.active_object)


def grid(cells: int = 20, size: float = 2.0) -> bpy.types.Object:
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=cells, y_subdivisions=cells, size=size)
    return activate(bpy.context.active_object)


def circle_points(radius: float, height: float, count: int = 24) -> list[tuple]:
    angles = [2.0 * math.pi * i / count for i in range(count)]
    return [(radius * math.cos(a), radius * math.sin(a), height) for a in angles]


def poly_curve(
    name: str, strands: list[list[tuple]], cyclic: bool, kind: str = "POLY"
) -> bpy.types.Object:
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "3D"
    for strand in strands:
        spline = data.splines.new(kind)
        if kind == "BEZIER":
            spline.bezier_points.add(len(strand) - 1)
            for point, co in zip(spline.bezier_points, strand, strict=True):
                point.co = co
                point.handle_left_type = point.handle_right_type = "AUTO"
        else:
            spline.points.add(len(strand) - 1)
            for point, co in zip(spline.points, strand, strict=True):
                point.co = (*co, 1.0)
        spline.use_cyclic_u = cyclic
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def grease_pencil(name: str, strokes, cyclic: bool = False) -> bpy.types.Object:
    """An object with one layer, whose strokes are on frame 1."""
    blocks = getattr(bpy.data, "grease_pencils_v3", bpy.data.grease_pencils)
    data = blocks.new(name)
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    add_strokes(data.layers.new("Lines"), strokes, cyclic, 1)
    return thing


def add_strokes(layer, strokes, cyclic: bool, frame: int) -> None:
    made = layer.frames.new(frame)
    if NEW_STROKES and len(strokes):
        made.drawing.add_strokes([len(points) for points in strokes])
    for number, points in enumerate(strokes):
        if NEW_STROKES:
            stroke = made.drawing.strokes[number]
            stroke.cyclic = cyclic
        else:
            stroke = made.strokes.new()
            stroke.points.add(len(points))
            stroke.use_cyclic = cyclic
        for point, place in zip(stroke.points, points, strict=True):
            setattr(point, "position" if NEW_STROKES else "co", place)


def fill(thing: bpy.types.Object, spacing: float = 0.0, **settings) -> bpy.types.Object:
    """Runs the operator on an object with these settings; the result, a bare line unless they say
    otherwise: bringing the look into an empty file takes half the time of a small run.
    """
    activate(thing)
    thing.meander.spacing = spacing
    thing.meander.iteration_limit, thing.meander.use_bevel = ITERATIONS, False
    for name, value in settings.items():
        setattr(thing.meander, name, value)
    assert bpy.ops.meander.run() == {"FINISHED"}
    active = bpy.context.view_layer.objects.active
    return active if active.type == "CURVE" else active.meander.last_result  # updated


def refused(thing: bpy.types.Object, spacing: float = 0.3, **settings) -> str:
    """Runs the operator on an object that cannot be filled; the sentence that it reports."""
    activate(thing)
    thing.meander.spacing = spacing
    for name, value in settings.items():
        setattr(thing.meander, name, value)
    before = counts()
    with_error = None
    try:
        bpy.ops.meander.run()
    except RuntimeError as error:  # how an operator's error report reaches a script
        with_error = str(error)
    assert counts() == before
    assert with_error is not None, "nothing was refused"
    sentence = with_error.removeprefix("Error: ").strip()
    assert sentence[0].isupper() or not sentence[0].isalpha(), sentence
    assert "\n" not in sentence, sentence
    return sentence


def saved(path: Path) -> Path:
    """The scene as a file."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def reopened(path: Path) -> None:
    """Saves the scene as a file, and opens that in a Blender that has forgotten it."""
    saved(path)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.open_mainfile(filepath=str(path))


def in_edit_mode(surface: bpy.types.Object, chosen: Callable[[Vector], bool]) -> None:
    """With the faces selected whose middles are chosen."""
    activate(surface)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_mode(type="FACE")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    for polygon in surface.data.polygons:
        polygon.select = chosen(polygon.center)
    bpy.ops.object.mode_set(mode="EDIT")


def counts() -> dict[str, int]:
    return {
        kind: len(getattr(bpy.data, kind))
        for kind in ("objects", "curves", "meshes", "collections", "node_groups")
    }


def matrix_of(thing: bpy.types.Object) -> np.ndarray:
    bpy.context.view_layer.update()
    return np.array([row[:] for row in thing.matrix_world], dtype=np.float64)


def world_splines(thing: bpy.types.Object) -> list[tuple[np.ndarray, bool]]:
    """Points in world space, and whether it is cyclic, for every spline."""
    matrix = matrix_of(thing)
    splines = []
    for spline in thing.data.splines:
        assert spline.type == "POLY"
        local = np.array([point.co[:3] for point in spline.points], dtype=np.float64)
        splines.append((local @ matrix[:3, :3].T + matrix[:3, 3], spline.use_cyclic_u))
    return splines


def points_of(thing: bpy.types.Object) -> np.ndarray:
    """The points of all splines, in world space."""
    return np.vstack([points for points, _cyclic in world_splines(thing)])


def point_count(thing: bpy.types.Object) -> int:
    return sum(len(spline.points) for spline in thing.data.splines)


def length_of(thing: bpy.types.Object) -> float:
    total = 0.0
    for points, cyclic in world_splines(thing):
        closed = np.vstack([points, points[:1]]) if cyclic else points
        total += np.linalg.norm(np.diff(closed, axis=0), axis=1).sum()
    return total


def world_triangles(thing: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """Evaluated triangles, read the slow and obvious way."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    evaluated = thing.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    mesh.calc_loop_triangles()
    matrix = matrix_of(thing)
    vertices = np.array([v.co[:] for v in mesh.vertices]) @ matrix[:3, :3].T + matrix[:3, 3]
    faces = np.array([t.vertices[:] for t in mesh.loop_triangles])
    evaluated.to_mesh_clear()
    return vertices, faces


def area_of(thing: bpy.types.Object) -> float:
    return float(geometry.triangle_areas(*world_triangles(thing)).sum())


def farthest_from(thing: bpy.types.Object, curve: bpy.types.Object) -> float:
    """The greatest distance of a point of the curve from the surface, or of a midpoint.

    Between points that have been merged a piece may cut a corner, by a hundredth of the spacing.
    """
    merged = 0.01 * curve.meander.spacing
    vertices, faces = world_triangles(thing)
    tree = BVHTree.FromPolygons(vertices.tolist(), faces.tolist())
    farthest = 0.0
    for points, cyclic in world_splines(curve):
        following = np.roll(points, -1, axis=0) if cyclic else points[1:]
        middles = (points[: len(following)] + following) / 2.0
        for allowed, group in ((0.0, points), (merged, middles)):
            for point in group:
                farthest = max(farthest, tree.find_nearest(point.tolist())[3] - allowed)
    return farthest


def column(rows, name: str, width: int = 1, kind: type = np.float32) -> np.ndarray:
    """A property of every element of a collection: (n,), or (n, width) of vectors."""
    values = np.empty(width * len(rows), dtype=kind)
    rows.foreach_get(name, values)
    return values if width == 1 else values.reshape(-1, width)


def pieces_of(mesh: bpy.types.Mesh) -> int:
    """How many pieces a mesh is in, by its edges."""
    a, b = column(mesh.edges, "vertices", 2, np.int32).T
    labels = np.arange(len(mesh.vertices))
    while (labels[a] != labels[b]).any():
        least = np.minimum(labels[a], labels[b])
        for side in (a, b):
            np.minimum.at(labels, labels[side], least)
        labels = labels[labels]
    return len(np.unique(labels))


def packing(surface: bpy.types.Object, curve: bpy.types.Object) -> float:
    """Length times spacing over area: 1 for parallel strands at the spacing."""
    return length_of(curve) * curve.meander.spacing / area_of(surface)
