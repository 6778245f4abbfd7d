# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of a result on its moving surface, and of its growth, written into the file."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import bpy

from ..model.stages import stages_of
from ..scene import drawn_line
from ..scene.bake import Frames, go_to, places_of
from ..scene.evaluated import matrix_of
from ..scene.meshes import triangles_of
from ..scene.transforms import to_local
from .motion import GrownCurve, follower_of
from .plan import plan_of


@contextmanager
def _all_or_nothing(
    frames: Frames, context: bpy.types.Context
) -> Iterator[Callable[[float], None]]:
    """Gives what shows how far it is, from 0 to 1; the frames stay where all of it succeeds."""
    manager = context.window_manager
    manager.progress_begin(0.0, 1.0)
    try:
        yield manager.progress_update
        frames.finish()
    except BaseException:
        frames.discard()
        raise
    finally:
        manager.progress_end()


def bake_motion(
    result: bpy.types.Object,
    context: bpy.types.Context,
    first: int,
    last: int,
    rounding: float | None = None,
) -> bpy.types.Collection:
    """Writes the frames `first` to `last` of a result on its moving surface, by way of so many
    places between two frames as its settings say: what sticks has a shape there as well.

    rounding   how far turns may be rounded, in spacings; None: as far as in the look of the result

    The curve is taken as it lies in the present frame, which therefore has to be one in which it
    fits; from there the frames are visited in order. The present frame comes back at the end.

    Raises DataError or core.MeanderError; what was baked earlier stays then.
    """
    scene, settings = context.scene, result.meander
    rounding = drawn_line.tolerance_of(result) if rounding is None else rounding
    present = scene.frame_current_final
    follow, settings.follow = settings.follow, False  # two followers would take turns
    frames = Frames(result, scene)
    context.view_layer.update()
    try:
        with _all_or_nothing(frames, context) as show:
            depsgraph = context.evaluated_depsgraph_get()
            follower = follower_of(result, scene, depsgraph, rounding)
            sticks = settings.motion == "STICK"
            numbers, places, offsets = [], [], None
            for frame in places_of(first, last, settings.motion_subframes):
                go_to(scene, frame)
                depsgraph = context.evaluated_depsgraph_get()
                vertices, faces = triangles_of(settings.surface, depsgraph)
                matrix = matrix_of(settings.surface, depsgraph)
                curve = follower.moved(vertices, faces)
                if sticks:
                    numbers.append(frame)
                    places.append(to_local(curve.positions, matrix))
                    offsets = curve.offsets
                elif frame == int(frame):
                    frames.add(int(frame), curve, matrix, follower.factors)
                show((frame - first + 1) / (last - first + 1))
            if sticks:
                frames.add_sticking(numbers, places, offsets)
    finally:
        settings.follow = follow
        go_to(scene, present)
    return frames.collection


def bake_growth(
    result: bpy.types.Object, context: bpy.types.Context, first: int, every: int
) -> bpy.types.Collection:
    """Grows the curve again from its seed and writes a frame after every so many iterations.

    Raises DataError or core.MeanderError; what was baked earlier stays then.
    """
    plan = plan_of(result, context.scene, context.evaluated_depsgraph_get(), restart=True)
    frames = Frames(result, context.scene)
    with _all_or_nothing(frames, context) as show:
        grown = GrownCurve(plan, plan.problem, drawn_line.tolerance_of(result))
        with grown.flow as flow:
            reason, iteration, frame = "running", 0, first
            while True:
                frames.add(frame, grown.shown()[0], plan.matrix)
                if reason != "running":
                    break
                frame += 1
                for _ in range(every):
                    reason = flow.step()
                    iteration += 1
                    if reason != "running":
                        break
                show(iteration / plan.problem.options.iteration_limit)
    return frames.collection


def animate_growth(
    result: bpy.types.Object, context: bpy.types.Context, first: int, last: int
) -> tuple[bpy.types.Collection, int]:
    """Grows the curve again from its seed and makes one object of its stages, as many as frames.

    The run is made twice: what stages there are is known when it has ended. Returns the object's
    collection, and how many stages there are. Raises DataError or core.MeanderError; what
    was baked earlier stays then.
    """
    plan = plan_of(result, context.scene, context.evaluated_depsgraph_get(), restart=True)
    frames = Frames(result, context.scene)
    with _all_or_nothing(frames, context) as show:
        with GrownCurve(plan, plan.problem).flow as flow:
            flow.run()
            lengths = [entry["length"] for entry in flow.history()]
        show(0.5)
        wanted = set(stages_of(lengths, last - first + 1))
        grown, stages = GrownCurve(plan, plan.problem, drawn_line.tolerance_of(result)), []
        with grown.flow as flow:
            for iteration in range(len(lengths) + 1):
                if iteration:
                    flow.step()
                if iteration in wanted:
                    stages.append(grown.shown()[0])
                    show(0.5 + 0.5 * iteration / len(lengths))
        frames.add_growth(stages, plan.matrix, first, last)
    return frames.collection, len(stages)
