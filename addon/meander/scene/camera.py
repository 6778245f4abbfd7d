# SPDX-License-Identifier: GPL-3.0-or-later
"""What a camera sees of its scene: its frame on a page, and every surface in it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

from ..model.camera import CameraPage, Page
from ..model.geometry.clipped_mesh import Triangles
from .errors import DataError
from .evaluated import surface_mesh
from .fillable import has_faces, is_result
from .identity import Key
from .rendered import rendering_of
from .transforms import to_world

# What Blender makes a mesh of.
_WITH_FACES = frozenset({"MESH", "CURVE", "SURFACE", "FONT", "META"})
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
    rendered = dict(_rendered(view_layer.layer_collection, False))
    planes, found, others = page.planes(beyond), [], []

    def take(name: str, mesh: Triangles, key: Key | None, owner: bpy.types.Object) -> None:
        mesh = mesh.clipped(planes)
        if len(mesh.faces):
            found.append(Seen(name, mesh, key, not (rendered[owner] or owner.is_holdout)))

    for instance in depsgraph.object_instances:
        shown = instance.object
        owner = instance.parent.original if instance.is_instance else shown.original
        if shown.type not in _WITH_FACES or is_result(shown.original) or owner not in rendered:
            continue
        if not instance.is_instance and not instance.show_self:
            continue
        if instance.is_instance:
            name = f"{owner.name}: {shown.name}"
            take(name, _triangles(shown, _array(instance.matrix_world)), None, owner)
        elif has_faces(owner) and rendering_of(owner, depsgraph.scene) is not None:
            others.append(owner)
        else:
            take(owner.name, _triangles(shown, _array(instance.matrix_world)), Key(owner), owner)
    # A copy as rendered is made only once nobody goes through the graph any more.
    for owner in others:
        with surface_mesh(owner, depsgraph) as (mesh, matrix):
            take(owner.name, _triangles_of_mesh(mesh, matrix), Key(owner), owner)
    return sorted(found, key=lambda each: each.name)


def _rendered(
    layer: bpy.types.LayerCollection, holdout: bool
) -> Iterator[tuple[bpy.types.Object, bool]]:
    """The objects that the camera would see, and whether a collection makes them holdouts."""
    if layer.exclude or layer.collection.hide_render or layer.indirect_only:
        return
    holdout = holdout or layer.holdout
    for thing in layer.collection.objects:
        if not thing.hide_render and thing.visible_camera:
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
    coordinates = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", coordinates)
    corners = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("vertices", corners)
    if not len(corners):
        return _NOTHING
    faces = corners.reshape(-1, 3).astype(np.int64)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        faces = faces[:, ::-1]
    return Triangles(to_world(coordinates.reshape(-1, 3), matrix), faces)


class Sight:
    """Tells which points on surfaces a camera sees: those in its frame that nothing hides."""

    def __init__(self, page: CameraPage, meshes: list[Triangles], lift: float) -> None:
        """lift   in millimetres of paper: so far towards the eye a point is moved before it is
        asked what hides it, or rounding would let it hide itself
        """
        self._page, self._lift = page, lift
        vertices = np.vstack([mesh.vertices for mesh in meshes])
        firsts = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes])
        faces = np.vstack([mesh.faces + first for mesh, first in zip(meshes, firsts)])
        self._middle = vertices.mean(axis=0)  # the tree rounds to single precision
        self._tree = BVHTree.FromPolygons((vertices - self._middle).tolist(), faces.tolist())

    def __call__(self, points: np.ndarray) -> np.ndarray:
        seen = self._page.inside(points)
        places = points[seen]
        directions, before = self._page.towards_eye(places)
        lift = self._lift / self._page.millimetres(places)
        starts = places - self._middle + lift[:, None] * directions
        cast = self._tree.ray_cast
        seen[seen] = [
            cast(start, Vector(direction), distance)[0] is None
            for start, direction, distance in zip(
                starts.tolist(), directions.tolist(), (before - lift).clip(min=0.0).tolist()
            )
        ]
        return seen


def _array(matrix: object) -> np.ndarray:
    return np.array([row[:] for row in matrix], dtype=np.float64)
