# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves on surfaces that move: following them from frame to frame, and baking frames.

A follower takes the vertices of a frame and gives the curve there. The even one lets the flow go
on, so that the spacing stays what it was; the sticking one only takes the points along with their
faces. Followers keep no references to Blender's data.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Protocol

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from . import blender_data, core, point_attributes, profile, session
from .blender_data import DataError
from .stepper import evaluated
from .thinning import kept_points, merge_distance, thinned

# ------------------------------------------------------------------------------------------------
# Surfaces in motion


def surface_now(
    surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """World vertices, triangles and world matrix of a surface as `depsgraph` has evaluated it.

    Unlike blender_data.triangles_of it updates nothing, so that a frame handler may call it.
    """
    evaluated_surface = surface.evaluated_get(depsgraph)
    mesh = evaluated_surface.to_mesh()
    try:
        matrix = blender_data.world_matrix(evaluated_surface)
        mesh.calc_loop_triangles()
        coordinates = np.empty(3 * len(mesh.vertices), dtype=np.float32)
        mesh.vertices.foreach_get("co", coordinates)
        indices = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
        mesh.loop_triangles.foreach_get("vertices", indices)
    finally:
        evaluated_surface.to_mesh_clear()
    faces = indices.reshape(-1, 3).astype(np.uint32)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        faces = np.ascontiguousarray(faces[:, ::-1])
    return blender_data.to_world(coordinates.reshape(-1, 3), matrix), faces, matrix


def plan_of(
    result: bpy.types.Object,
    scene: bpy.types.Scene,
    depsgraph: bpy.types.Depsgraph,
    restart: bool = False,
) -> session.Plan:
    """The plan of a run on a result, wherever the context is."""
    context = SimpleNamespace(
        active_object=result, scene=scene, evaluated_depsgraph_get=lambda: depsgraph
    )
    return session.plan_run(context, restart)


class Follower(Protocol):
    """A curve that goes with its surface."""

    factors: np.ndarray | None  # radius of every point of the last curve; None: 1

    def moved(self, vertices: np.ndarray, faces: np.ndarray) -> core.Polylines:
        """The curve in world units when the surface is there. Raises DataError, MeanderError."""


# Of the sides of a mesh's triangles. Polygons keep their own sides however they are divided, which
# is all of them in a mesh of triangles, two thirds among quads, more than a third in any other.
_LEAST_KEPT = 0.3


def _same_faces(faces: np.ndarray, wanted: np.ndarray) -> None:
    """Quads are divided along the shorter diagonal, so not every triangle stays what it was."""
    if len(faces) != len(wanted):
        raise DataError(
            f"The surface has {len(faces)} triangles now and had {len(wanted)}; only its shape may "
            "change while a curve follows it, so leave out modifiers that change the mesh"
        )
    if np.array_equal(faces, wanted):
        return
    if np.isin(_sides(wanted), _sides(faces)).mean() < _LEAST_KEPT:
        raise DataError(
            "The faces of the surface join other vertices now; only its shape may change while a "
            "curve follows it, so leave out modifiers that change the mesh"
        )


def _sides(faces: np.ndarray) -> np.ndarray:
    """A number for every side of a triangle, the same from both of its faces."""
    pairs = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    return (pairs[:, 0].astype(np.uint64) << np.uint64(32)) | pairs[:, 1].astype(np.uint64)


class EvenFollower:
    """The flow goes on for some iterations in every frame."""

    def __init__(self, plan: session.Plan, steps: int) -> None:
        problem = plan.problem
        self.factors = None
        self._radius = problem.options.radius if plan.radius_follows else 0.0
        problem.options.growth_coarsening = 1.0  # the curve has grown already
        self._faces, self._steps = problem.faces, steps
        try:
            self._flow, self.distance = flow_of(plan)
        except core.MeanderError as error:
            if error.status != core.Status.INVALID_SEED:
                raise
            raise DataError(
                "The curve does not lie on its surface in this frame; go to the frame in which it "
                "was made, or fill the surface anew"
            ) from error
        self._flow.set_vertices(problem.vertices)

    def moved(self, vertices: np.ndarray, faces: np.ndarray) -> core.Polylines:
        _same_faces(faces, self._faces)
        self._flow.set_vertices(vertices)
        for _ in range(self._steps):
            self._flow.step()
        curve = self._flow.polylines()
        if self._radius:
            radii = self._flow.point_data().radii[kept_points(curve, self.distance)]
            self.factors = profile.room_factors(radii, self._radius)
        return thinned(curve, self.distance)


class StickingFollower:
    """Every point stays where it is on its face."""

    def __init__(
        self,
        points: np.ndarray,
        offsets: np.ndarray,
        closed: np.ndarray,
        factors: np.ndarray | None,
        vertices: np.ndarray,
        faces: np.ndarray,
    ) -> None:
        self.factors = factors
        self._offsets, self._closed, self._faces = offsets, closed, faces
        self._index, self._weights = bind(points, vertices, faces)

    def moved(self, vertices: np.ndarray, faces: np.ndarray) -> core.Polylines:
        _same_faces(faces, self._faces)
        # The triangles of the frame in which the points were bound, however quads are divided now.
        corners = vertices[self._faces[self._index]]
        positions = np.einsum("nk,nkj->nj", self._weights, corners)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        return core.Polylines(positions, normals, self._offsets, self._closed)


def flow_of(plan: session.Plan) -> tuple[core.Flow, float]:
    """The flow of a plan before its first iteration, and which points of its curve are one."""
    problem = plan.problem
    with problem.surface() as surface:
        density = evaluated(problem.density, surface)
        flow = core.Flow(surface, problem.options, problem.seed, density)
        if problem.directions is not None:
            flow.set_directions(evaluated(problem.directions, surface), problem.alignment)
    return flow, merge_distance(problem.options.radius, density)


def write(
    result: bpy.types.Object,
    curve: bpy.types.Curve,
    polylines: core.Polylines,
    matrix: np.ndarray,
    factors: np.ndarray | None,
) -> None:
    """Writes polylines into a curve that is the result's or a frame of it."""
    materials = [spline.material_index for spline in result.data.splines]
    blender_data.write_splines(curve, polylines, matrix)
    if curve == result.data and result.meander.figures.room:
        point_attributes.forget_room(result)
    profile.dress_points(curve, polylines, matrix, result.meander.flat_profile, factors)
    for spline, index in zip(curve.splines, materials):
        spline.material_index = index


def bind(
    points: np.ndarray, vertices: np.ndarray, faces: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """For each point the nearest triangle and the weights of its corners there."""
    tree = BVHTree.FromPolygons(vertices.tolist(), faces.tolist())
    index = np.array([tree.find_nearest(point)[2] for point in points.tolist()], dtype=np.int64)
    a, b, c = (vertices[faces[index, corner]] for corner in range(3))
    u, v, w = b - a, c - a, points - a
    uu, uv, vv = (u * u).sum(1), (u * v).sum(1), (v * v).sum(1)
    wu, wv = (w * u).sum(1), (w * v).sum(1)
    determinant = uu * vv - uv * uv
    second = (vv * wu - uv * wv) / determinant
    third = (uu * wv - uv * wu) / determinant
    weights = np.clip(np.column_stack([1.0 - second - third, second, third]), 0.0, 1.0)
    return index, weights / weights.sum(axis=1, keepdims=True)


def follower_of(
    result: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph
) -> Follower:
    """A follower that begins with the result as it is. Raises DataError, core.MeanderError."""
    settings = result.meander
    if settings.motion == "EVEN":
        return EvenFollower(plan_of(result, scene, depsgraph), settings.motion_steps)
    vertices, faces, _matrix = surface_now(settings.surface, depsgraph)
    own = blender_data.strands_of_curve(result, depsgraph)
    radii = [point.radius for spline in result.data.splines for point in spline.points]
    factors = np.array(radii) if len(radii) == len(own.points) else None
    return StickingFollower(own.points, own.offsets, own.closed, factors, vertices, faces)


# ------------------------------------------------------------------------------------------------
# Baked frames


class Frames:
    """Frames of a result as objects of their own, each shown in its frame only.

    They are plain curves with keys on their visibility, so the file renders wherever it is opened.
    """

    def __init__(self, result: bpy.types.Object, scene: bpy.types.Scene) -> None:
        clear(result)
        self._result, self._surface = result, result.meander.surface
        self.collection = bpy.data.collections.new(f"{result.name} Frames")
        scene.collection.children.link(self.collection)
        result.meander.bake = self.collection
        self._shown: bpy.types.Object | None = None

    def add(
        self,
        frame: int,
        polylines: core.Polylines,
        matrix: np.ndarray,
        factors: np.ndarray | None = None,
    ) -> bpy.types.Object:
        """Shows polylines from `frame` on, instead of those of the frame before."""
        curve = self._result.data.copy()
        write(self._result, curve, polylines, matrix, factors)
        shown = bpy.data.objects.new(f"{self._result.name} {frame:04d}", curve)
        self.collection.objects.link(shown)
        shown.parent = self._surface
        if self._shown is not None:
            _key_hidden(self._shown, frame, True)
            _key_hidden(shown, frame - 1, True)
        _key_hidden(shown, frame, False)
        self._shown = shown
        return shown

    def add_sticking(
        self, frames: list[int], points: list[np.ndarray], offsets: np.ndarray
    ) -> bpy.types.Object:
        """One curve whose points go from place to place, as shape keys; points in its own space."""
        curve = self._result.data.copy()
        curve.animation_data_clear()
        shown = bpy.data.objects.new(f"{self._result.name} Sticking", curve)
        self.collection.objects.link(shown)
        shown.parent = self._surface
        for frame, places in zip(frames, points, strict=True):
            key = shown.shape_key_add(name=f"{frame:04d}", from_mix=False)
            key.interpolation = "KEY_LINEAR"
            data = key.points if hasattr(key, "points") and len(key.points) else key.data
            data.foreach_set("co", places.astype(np.float32).ravel())
        keys = curve.shape_keys
        keys.use_relative = False
        for frame, key in zip(frames, keys.key_blocks, strict=True):
            keys.eval_time = key.frame
            keys.keyframe_insert("eval_time", frame=frame)
        for fcurve in _fcurves(keys):
            for keyframe in fcurve.keyframe_points:
                keyframe.interpolation = "LINEAR"
        return shown

    def finish(self) -> None:
        """Hides what the frames stand for."""
        self._result.hide_render = True
        self._result.hide_viewport = True


def clear(result: bpy.types.Object) -> None:
    """Takes the baked frames of a result away and shows it again."""
    collection = result.meander.bake
    if collection is None:
        return
    result.meander.bake = None
    data = [item.data for item in collection.objects]
    bpy.data.batch_remove([*collection.objects, *data, collection])
    result.hide_render = result.hide_viewport = False


def _key_hidden(thing: bpy.types.Object, frame: int, hidden: bool) -> None:
    thing.hide_render = thing.hide_viewport = hidden
    thing.keyframe_insert("hide_render", frame=frame)
    thing.keyframe_insert("hide_viewport", frame=frame)


def _fcurves(owner: bpy.types.ID) -> list[bpy.types.FCurve]:
    """The animation curves of a data block; 5.0 keeps them in layers."""
    animation = owner.animation_data
    if hasattr(animation.action, "fcurves"):
        return list(animation.action.fcurves)
    strip = animation.action.layers[0].strips[0]
    return list(strip.channelbag(animation.action_slot).fcurves)


def bake_motion(
    result: bpy.types.Object, context: bpy.types.Context, first: int, last: int
) -> bpy.types.Collection:
    """Writes the frames `first` to `last` of a result on its moving surface.

    The curve is taken as it lies in the present frame, which therefore has to be one in which it
    fits; from there the frames are met in their order. The present frame comes back at the end.

    Raises DataError or core.MeanderError, with nothing baked.
    """
    scene, settings = context.scene, result.meander
    present = scene.frame_current
    follow, settings.follow = settings.follow, False  # two followers would take turns
    frames = Frames(result, scene)
    context.view_layer.update()
    manager = context.window_manager
    manager.progress_begin(0.0, 1.0)
    try:
        depsgraph = context.evaluated_depsgraph_get()
        follower = follower_of(result, scene, depsgraph)
        sticks = settings.motion == "STICK"
        numbers, places, offsets = [], [], None
        for frame in range(first, last + 1):
            scene.frame_set(frame)
            depsgraph = context.evaluated_depsgraph_get()
            vertices, faces, matrix = surface_now(settings.surface, depsgraph)
            curve = follower.moved(vertices, faces)
            if sticks:
                numbers.append(frame)
                places.append(blender_data.to_local(curve.positions, matrix))
                offsets = curve.offsets
            else:
                frames.add(frame, curve, matrix, follower.factors)
            manager.progress_update((frame - first + 1) / (last - first + 1))
        if sticks:
            frames.add_sticking(numbers, places, offsets)
        frames.finish()
    except BaseException:
        clear(result)
        raise
    finally:
        manager.progress_end()
        settings.follow = follow
        scene.frame_set(present)
    return frames.collection


def bake_growth(
    result: bpy.types.Object, context: bpy.types.Context, first: int, every: int
) -> bpy.types.Collection:
    """Grows the curve anew from its seed and writes every so manieth iteration as a frame.

    Raises DataError or core.MeanderError, with nothing baked.
    """
    plan = plan_of(result, context.scene, context.evaluated_depsgraph_get(), restart=True)
    frames = Frames(result, context.scene)
    manager = context.window_manager
    manager.progress_begin(0.0, 1.0)
    try:
        flow, distance = flow_of(plan)
        with flow:
            reason, iteration, frame = "running", 0, first
            while True:
                frames.add(frame, thinned(flow.polylines(), distance), plan.matrix)
                if reason != "running":
                    break
                frame += 1
                for _ in range(every):
                    reason = flow.step()
                    iteration += 1
                    if reason != "running":
                        break
                manager.progress_update(iteration / plan.problem.options.iteration_limit)
        frames.finish()
    except BaseException:
        clear(result)
        raise
    finally:
        manager.progress_end()
    return frames.collection
