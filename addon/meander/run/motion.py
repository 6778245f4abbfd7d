# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves on surfaces that move: followers from frame to frame, and the results that have one.

A follower takes the vertices of a frame and gives the curve there. The even one continues the
flow, so that the spacing stays what it was; the sticking one only takes the points along with their
faces. Followers keep no references to Blender's data. A result follows whenever the frame changes.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Protocol

import bpy
import numpy as np

from .. import core
from ..model import strands
from ..model.geometry.simplification import result_points
from ..model.geometry.thinning import least_spacing, with_points
from ..model.opening import open_flow
from ..model.problem import Problem
from ..model.profile import radius_factors
from ..scene import bake
from ..scene.curve_reader import strands_of_curve
from ..scene.drawn_line import seen_instead
from ..scene.errors import DataError
from ..scene.evaluated import instances_of, is_evaluated
from ..scene.identity import number_of
from ..scene.look import modifier_of
from ..scene.meshes import surface_now, triangles_of
from ..scene.points import bind
from . import session
from .lasting import Activity, Memory, end_gone
from .plan import Plan, plan_of


class Follower(Protocol):
    """A curve that goes with its surface."""

    factors: np.ndarray | None  # radius of every point of the last curve; None: 1

    def moved(self, vertices: np.ndarray, faces: np.ndarray) -> core.Polylines:
        """The curve in world units when the surface is there. Raises DataError, MeanderError."""


# The share of the sides of triangles that has to stay. Polygons keep their own sides however they
# are divided, which is all of them in a mesh of triangles, two thirds among quads, more than a
# third in any other.
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


class GrownCurve:
    """The flow of a plan's problem, step by step, and the curve that its result shows of it: with a
    mirror that of the half, and its image."""

    def __init__(self, plan: Plan, problem: Problem, rounding: float = 0.0) -> None:
        """rounding   how far turns may be rounded, in spacings; 0: the curve as it is"""
        opened = open_flow(replace(problem, copies=None))
        self._rounding = rounding
        self.flow = opened.flow
        self._mirror = None if opened.part is None else opened.part.mirror
        self._spacing = least_spacing(plan.problem.options.radius, opened.density)
        self._light = plan.light
        self._keeps_guides = plan.keeps_guides

    def shown(self) -> tuple[core.Polylines, np.ndarray]:
        """The curve as it is written, and r+ and r- of its points, of one half."""
        if self._rounding:
            curve, data = self.flow.rounded(self._rounding)
        else:
            curve, data = self.flow.polylines(), self.flow.point_data()
        kept = result_points(curve, self._spacing, self._light)
        shown = with_points(curve, kept)
        if not self._keeps_guides:
            guides = self.flow.guides()
            kept = kept[strands.points_without_guides(shown, guides)]
            shown = strands.without_guides(shown, guides)
        whole = shown if self._mirror is None else self._mirror.polylines(shown)
        return whole, data.radii[kept]


class EvenFollower:
    """Continues the flow for some iterations in every frame."""

    def __init__(self, plan: Plan, steps: int, rounding: float = 0.0) -> None:
        problem = plan.problem
        self.factors = None
        follows = plan.radius_follows and problem.density is not None
        has_room = follows or modifier_of(plan.result.find()) is not None
        self._radius = problem.options.radius if has_room else 0.0
        # The curve has grown already.
        problem.options.tunings = problem.options.tunings | {"growth_coarsening": 1.0}
        self._faces, self._steps = problem.faces, steps
        try:
            # Both halves are there, and move by themselves.
            self._grown = GrownCurve(plan, replace(problem, mirror=None), rounding)
        except core.MeanderError as error:
            if error.status != core.Status.INVALID_SEED:
                raise
            raise DataError(
                "The curve does not lie on its surface in this frame; go to the frame in which it "
                "was made, or fill the surface again"
            ) from error
        self._grown.flow.set_vertices(problem.vertices)

    def moved(self, vertices: np.ndarray, faces: np.ndarray) -> core.Polylines:
        _same_faces(faces, self._faces)
        flow = self._grown.flow
        flow.set_vertices(vertices)
        for _ in range(self._steps):
            flow.step()
        curve, radii = self._grown.shown()
        if self._radius:
            self.factors = radius_factors(radii, self._radius)
        return curve


class StickingFollower:
    """Keeps every point at its place on its face."""

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


def follower_of(
    result: bpy.types.Object,
    scene: bpy.types.Scene,
    depsgraph: bpy.types.Depsgraph,
    rounding: float = 0.0,
) -> Follower:
    """A follower that begins with the result as it is. Raises DataError, core.MeanderError.

    rounding   how far turns may be rounded in every frame, in spacings; what sticks takes the line
               along that the look draws, where there is one
    """
    settings = result.meander
    if settings.motion == "EVEN":
        if settings.figures.bridges:
            raise DataError(
                f"'{result.name}' has bridges, which cannot keep the spacing in motion; choose "
                "Stick, or fill the surface without Bridge Parts"
            )
        return EvenFollower(plan_of(result, scene, depsgraph), settings.motion_steps, rounding)
    surface = settings.surface
    if is_evaluated(surface, depsgraph) and not len(instances_of(surface, depsgraph).sizes):
        vertices, faces, _matrix = surface_now(surface, depsgraph)
    else:
        vertices, faces = triangles_of(surface, depsgraph)
    drawn = seen_instead(result) if rounding else None
    data = result.data if drawn is None else drawn.data
    own = strands_of_curve(result, depsgraph, of_data=None if drawn is None else data)
    radii = [point.radius for spline in data.splines for point in spline.points]
    factors = np.array(radii) if len(radii) == len(own.points) else None
    return StickingFollower(own.points, own.offsets, own.closed, factors, vertices, faces)


# Who a follower is of: what a result is known by, and its name, since before Blender 4.1 another
# one may get its address.
Owner = tuple[int, str]


def _owner(result: bpy.types.Object) -> Owner:
    return number_of(result), result.name_full


def _has_gone(owner: Owner) -> bool:
    """What was deleted takes its flow with it; what was renamed begins again from its curve."""
    result = bpy.data.objects.get((owner[1], None))
    return result is None or _owner(result) != owner


# Followers of the results that follow: what they know is not in the file, and whatever may have
# changed it (undo, another file) makes new ones necessary.
_followers: Memory[Owner, Follower] = Memory(undone=True, gone=_has_gone)
# Why a result does not follow, for the panel.
_problems: Memory[Owner, str] = Memory(undone=True, gone=_has_gone)
# Whether something is being rendered.
_rendering: Activity[bool] = Activity()


def problem_of(result: bpy.types.Object) -> str | None:
    """Why a result does not follow, as a sentence; None while it does."""
    return _problems.get(_owner(result))


def forget() -> None:
    """Makes every follower start again from its curve as it is."""
    _followers.clear()
    _problems.clear()


def begin(result: bpy.types.Object, context: bpy.types.Context) -> None:
    """Starts or stops following, as the settings say; the curve fits the present frame."""
    key = _owner(result)
    _followers.pop(key, None)
    _problems.pop(key, None)
    settings = result.meander
    if not settings.follow or settings.surface is None or session.current() is not None:
        return
    try:
        depsgraph = context.evaluated_depsgraph_get()
        _followers[key] = follower_of(result, context.scene, depsgraph)
    except (DataError, core.MeanderError) as error:
        _problems[key] = str(error)


def _may_change(scene: bpy.types.Scene) -> bool:
    """A render in a window runs on a thread of its own while the window draws the same data."""
    return _rendering.current is None or bpy.app.background or scene.render.use_lock_interface


def on_frame(scene: bpy.types.Scene, depsgraph: Any = None) -> None:
    end_gone()
    results = [thing for thing in scene.objects if thing.type == "CURVE" and thing.meander.follow]
    if not results or session.current() is not None or not _may_change(scene):
        return
    depsgraph = depsgraph or bpy.context.evaluated_depsgraph_get()
    for result in results:
        surface = result.meander.surface
        if surface is None or result.library or result.data.library or result.mode != "OBJECT":
            continue
        key = _owner(result)
        try:
            vertices, faces, matrix = surface_now(surface, depsgraph)  # refuses what is hidden
            if key not in _followers:
                _followers[key] = follower_of(result, scene, depsgraph)
            curve = _followers[key].moved(vertices, faces)
            bake.write(result, result.data, curve, matrix, _followers[key].factors)
            _problems.pop(key, None)
        except (DataError, core.MeanderError) as error:
            # A handler has nobody to report to; the panel shows it.
            _followers.pop(key, None)
            _problems[key] = str(error)


def on_load() -> None:
    """A file is opened in the frame in which its curves fit; the next one may be far away."""
    context = bpy.context
    for result in context.scene.objects:
        if result.type == "CURVE" and result.meander.follow:
            begin(result, context)


def on_render() -> None:
    _rendering.begin(True)


def on_render_end() -> None:
    _rendering.end()
