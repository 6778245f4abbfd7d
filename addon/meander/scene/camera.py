# SPDX-License-Identifier: GPL-3.0-or-later
"""What a camera sees of its scene: its frame on a page, and every surface in it."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

from ..model.camera import CameraPage, Page
from ..model.geometry.clipped_mesh import Triangles
from .columns import column, corner_counts, vertices_of_corners
from .errors import DataError
from .evaluated import instances_of, surface_mesh
from .fillable import has_faces, is_result
from .identity import Key
from .rendered import rendering_of
from .transforms import to_world

# What Blender makes a mesh of.
_WITH_FACES = frozenset({"MESH", "CURVE", "SURFACE", "FONT", "META"})
# No ray goes farther: Blender takes single precision.
_FARTHEST = 1e30
_NOTHING = Triangles(np.empty((0, 3)), np.empty((0, 3), dtype=np.int64))


@dataclass(frozen=True)
class Seen:
    """A surface that the frame holds a part of.

    name      of its object; of an instance, with that of what shows it before it
    mesh      its faces in the world, facing outward, as far as they are in the frame
    owner     the object that is drawn; None: an instance, whose settings nobody has chosen
    is_drawn  else it only hides: a holdout
    """

    name: str
    mesh: Triangles
    owner: Key | None
    is_drawn: bool


def camera_page(
    scene: bpy.types.Scene,
    depsgraph: bpy.types.Depsgraph,
    camera: bpy.types.Object | None,
    page: Page,
) -> CameraPage:
    """The frame of a camera on a page, which is turned to lie or stand as the frame does.

    Raises DataError where there is no camera, or one whose picture is not flat.
    """
    if camera is None:
        raise DataError("The scene has no camera; add one and look through it")
    if camera.type != "CAMERA":
        raise DataError(f"'{camera.name}' is no camera; make a camera the one of the scene")
    if camera.data.type not in ("PERSP", "ORTHO"):
        raise DataError(
            f"'{camera.name}' takes panoramas, which no page holds; make its lens perspective or "
            "orthographic"
        )
    shown, render = camera.evaluated_get(depsgraph), scene.render
    projection = shown.calc_matrix_camera(
        depsgraph,
        x=render.resolution_x,
        y=render.resolution_y,
        scale_x=render.pixel_aspect_x,
        scale_y=render.pixel_aspect_y,
    )
    width = render.resolution_x * render.pixel_aspect_x
    aspect = width / (render.resolution_y * render.pixel_aspect_y)
    return CameraPage(
        _array(shown.matrix_world.normalized().inverted()),
        _array(projection),
        shown.data.clip_start,
        shown.data.clip_end,
        aspect,
        page.turned_to(aspect),
    )


def seen_by(
    page: CameraPage,
    beyond: float,
    view_layer: bpy.types.ViewLayer,
    depsgraph: bpy.types.Depsgraph,
) -> list[Seen]:
    """What the frame holds of every surface that the scene shows and renders, instances too, in the
    order of their names; not of curves that Meander has made.

    beyond   by how many millimetres the frame is larger on all sides
    """
    planes, found = page.planes(beyond), []
    rendered = dict(_rendered(view_layer.layer_collection, False))
    seen = {thing: hides for thing, hides in rendered.items() if thing.visible_camera}
    for name, mesh, key, owner in _surfaces(seen, depsgraph):
        mesh = mesh.clipped(planes)
        if len(mesh.faces):
            found.append(Seen(name, mesh, key, not (seen[owner] or owner.is_holdout)))
    return sorted(found, key=lambda each: each.name)


def casting_shadows(
    view_layer: bpy.types.ViewLayer, depsgraph: bpy.types.Depsgraph
) -> list[Triangles]:
    """Every surface that the scene shows and renders, in the frame or not, that keeps light from
    others."""
    rendered = dict(_rendered(view_layer.layer_collection, False))
    casting = {thing: hides for thing, hides in rendered.items() if thing.visible_shadow}
    return [mesh for _name, mesh, _key, _owner in _surfaces(casting, depsgraph)]


def _surfaces(
    owners: Collection[bpy.types.Object], depsgraph: bpy.types.Depsgraph
) -> Iterator[tuple[str, Triangles, Key | None, bpy.types.Object]]:
    """The surfaces of these objects and of the instances that they show, but for our own curves:
    name, faces in the world, the object whose settings count, and the one of `owners`."""
    others = []
    for instance in depsgraph.object_instances:
        shown = instance.object
        owner = instance.parent.original if instance.is_instance else shown.original
        if shown.type not in _WITH_FACES or is_result(shown.original) or owner not in owners:
            continue
        if not instance.is_instance and not instance.show_self:
            continue
        if instance.is_instance:
            name = f"{owner.name}: {shown.name}"
            yield name, _triangles(shown, _array(instance.matrix_world)), None, owner
        elif has_faces(owner) and rendering_of(owner, depsgraph.scene) is not None:
            others.append(owner)
        else:
            mesh = _triangles(shown, _array(instance.matrix_world))
            yield owner.name, mesh, Key(owner), owner
    # A copy as rendered is made only once nobody goes through the graph any more.
    for owner in others:
        if len(instances_of(owner, depsgraph).sizes):
            continue  # which are there already
        with surface_mesh(owner, depsgraph) as (mesh, matrix):
            triangles = _triangles_of_mesh(mesh, matrix)
        yield owner.name, triangles, Key(owner), owner


def _rendered(
    layer: bpy.types.LayerCollection, holdout: bool
) -> Iterator[tuple[bpy.types.Object, bool]]:
    """The objects that are rendered, and whether a collection makes them holdouts."""
    if layer.exclude or layer.collection.hide_render or layer.indirect_only:
        return
    holdout = holdout or layer.holdout
    for thing in layer.collection.objects:
        if not thing.hide_render:
            yield thing, holdout
    for child in layer.children:
        yield from _rendered(child, holdout)


def _triangles(shown: bpy.types.Object, matrix: np.ndarray) -> Triangles:
    """The triangles of an evaluated object, in the world; none where it has no faces."""
    try:
        mesh = shown.to_mesh()
    except RuntimeError:  # a curve without any, for instance
        return _NOTHING
    try:
        return _triangles_of_mesh(mesh, matrix)
    finally:
        shown.to_mesh_clear()


def _triangles_of_mesh(mesh: bpy.types.Mesh, matrix: np.ndarray) -> Triangles:
    mesh.calc_loop_triangles()
    faces = column(mesh.loop_triangles, "vertices", 3, np.int32).astype(np.int64)
    if not len(faces):
        return _NOTHING
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        faces = faces[:, ::-1]
    points = to_world(column(mesh.vertices, "co", 3), matrix)
    return Triangles(points, faces, normals=_smooth_normals(mesh, matrix))


def _smooth_normals(mesh: bpy.types.Mesh, matrix: np.ndarray) -> np.ndarray | None:
    """The normals of vertices all whose faces are shaded smooth, and 0 at others; None: of none."""
    smooth = column(mesh.polygons, "use_smooth", kind=bool)
    if not smooth.any() or getattr(mesh, "use_auto_smooth", False):  # by angles, of Blender 3.4
        return None
    normals = column(mesh.vertices, "normal", 3)
    found = normals.astype(np.float64) @ np.linalg.inv(matrix[:3, :3])
    sharp = column(mesh.edges, "use_edge_sharp", kind=bool)
    ends = column(mesh.edges, "vertices", 2, np.int32)
    found[ends[sharp].ravel()] = 0.0
    found[vertices_of_corners(mesh)[np.repeat(~smooth, corner_counts(mesh))]] = 0.0
    return found


class Rays:
    """Tells what is in the way between places of a scene."""

    def __init__(self, meshes: list[Triangles]) -> None:
        vertices = np.vstack([mesh.vertices for mesh in meshes])
        firsts = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes])
        faces = np.vstack([mesh.faces + first for mesh, first in zip(meshes, firsts)])
        self._middle = vertices.mean(axis=0)  # the tree rounds to single precision
        self._tree = BVHTree.FromPolygons((vertices - self._middle).tolist(), faces.tolist())

    def reach(self, starts: np.ndarray, directions: np.ndarray, far: np.ndarray) -> np.ndarray:
        """Which points (n, 3) have nothing before them in directions (n, 3) for so far (n,)."""
        cast = self._tree.ray_cast
        far = np.minimum(far, _FARTHEST)
        return np.array(
            [
                cast(start, Vector(direction), distance)[0] is None
                for start, direction, distance in zip(
                    (starts - self._middle).tolist(), directions.tolist(), far.tolist()
                )
            ],
            dtype=bool,
        )


class Sight:
    """Tells which points on surfaces a camera sees: those in its frame that nothing hides."""

    def __init__(self, page: CameraPage, meshes: list[Triangles], lift: float) -> None:
        """lift   in millimetres of paper: so far towards the eye a point is moved before it is
        asked what hides it, or rounding would let it hide itself
        """
        self._page, self._lift, self._rays = page, lift, Rays(meshes)

    def __call__(self, points: np.ndarray) -> np.ndarray:
        seen = self._page.inside(points)
        places = points[seen]
        directions, before = self._page.towards_eye(places)
        lift = self._lift / self._page.millimetres(places)
        starts = places + lift[:, None] * directions
        seen[seen] = self._rays.reach(starts, directions, (before - lift).clip(min=0.0))
        return seen


def _array(matrix: object) -> np.ndarray:
    return np.array([row[:] for row in matrix], dtype=np.float64)
