# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of a result as objects of their own, which need no add-on to be shown."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import cycle

import bpy
import numpy as np

from .. import core
from ..model.toolpaths import toolpath
from . import assets
from . import points as point_attributes
from .blender_versions import fcurves, shape_key_points
from .curve_writer import write_splines
from .drawn_line import seen_instead
from .linked_settings import settings_of
from .look import copy_look, copy_values, modifier_of, place_of, same_values, set_value
from .profile import set_tilt_and_radius

GROWTH = "Meander Growth"


def write(
    result: bpy.types.Object,
    curve: bpy.types.Curve,
    polylines: core.Polylines,
    matrix: np.ndarray,
    factors: np.ndarray | None,
) -> None:
    """Writes polylines into a curve that is the result's or a frame of it."""
    materials = [spline.material_index for spline in result.data.splines]
    write_splines(curve, polylines, matrix)
    if curve == result.data and result.meander.figures.room:
        point_attributes.clear_medial_radii(result)
    set_tilt_and_radius(curve, polylines, matrix, factors)
    for spline, index in zip(curve.splines, cycle(materials)):
        spline.material_index = index


def _together(stages: list[core.Polylines]) -> core.Polylines:
    """The strands of all of them, one after another."""
    ends = np.cumsum([0] + [len(stage.positions) for stage in stages])
    return core.Polylines(
        np.vstack([stage.positions for stage in stages]),
        np.vstack([stage.normals for stage in stages]),
        np.concatenate(
            [[0], *(stage.offsets[1:].astype(np.int64) + end for stage, end in zip(stages, ends))]
        ),
        np.concatenate([stage.closed for stage in stages]),
    )


class Frames:
    """Frames of a result as objects of their own, each shown in its frame only.

    They are plain curves with keys on their visibility, so the file renders wherever it is opened.
    Until they are finished they are in no scene, and those that were baked earlier stay.
    """

    def __init__(self, result: bpy.types.Object, scene: bpy.types.Scene) -> None:
        self._result, self._surface, self._scene = result, result.meander.surface, scene
        # What is hidden is not evaluated, and a result with a bake is hidden.
        self._hidden = result.hide_render, result.hide_viewport
        result.hide_render = result.hide_viewport = False
        self.collection = bpy.data.collections.new("")
        self._names: list[tuple[bpy.types.ID, str]] = [(self.collection, f"{result.name} Frames")]
        self._shown: bpy.types.Object | None = None

    def _new(self, what: str, curve: bpy.types.Curve) -> bpy.types.Object:
        shown = bpy.data.objects.new("", curve)
        self._names.append((shown, f"{self._result.name} {what}"))
        self.collection.objects.link(shown)
        shown.parent = self._surface
        return shown

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
        shown = self._new(f"{frame:04d}", curve)
        copy_look(self._result, shown)
        if self._shown is not None:
            _key_hidden(self._shown, frame, True)
            _key_hidden(shown, frame - 1, True)
        _key_hidden(shown, frame, False)
        self._shown = shown
        return shown

    def add_sticking(
        self, frames: list[float], points: list[np.ndarray], offsets: np.ndarray
    ) -> bpy.types.Object:
        """One curve whose points go from place to place, as shape keys; points in its own space,
        as many as the result has, or the line that its look draws."""
        drawn = seen_instead(self._result)
        if drawn is not None and len(points[0]) == sum(len(s.points) for s in drawn.data.splines):
            curve = drawn.data.copy()
            for material in self._result.data.materials:
                curve.materials.append(material)
        else:
            curve = self._result.data.copy()
        curve.animation_data_clear()
        shown = self._new("Sticking", curve)
        copy_look(self._result, shown)
        for frame, places in zip(frames, points, strict=True):
            name = f"{frame:04.0f}" if frame == int(frame) else f"{frame:08.3f}"
            key = shown.shape_key_add(name=name, from_mix=False)
            key.interpolation = "KEY_LINEAR"
            shape_key_points(key).foreach_set("co", places.astype(np.float32).ravel())
        keys = curve.shape_keys
        keys.use_relative = False
        for frame, key in zip(frames, keys.key_blocks, strict=True):
            keys.eval_time = key.frame
            keys.keyframe_insert("eval_time", frame=frame)
        for fcurve in fcurves(keys):
            for keyframe in fcurve.keyframe_points:
                keyframe.interpolation = "LINEAR"
        return shown

    def add_growth(
        self, stages: list[core.Polylines], matrix: np.ndarray, first: int, last: int
    ) -> bpy.types.Object:
        """One curve that holds all stages, and a modifier that shows them one after another.

        All stages have the same strands. Keys lead the modifier's Factor from 0 to 1.
        """
        curve = self._result.data.copy()
        curve.animation_data_clear()
        write(self._result, curve, _together(stages), matrix, None)
        shown = self._new("Growth", curve)
        modifier = shown.modifiers.new("Growth", "NODES")
        modifier.node_group = assets.node_group(GROWTH)
        set_value(modifier, "Stages", len(stages))
        set_value(modifier, "Strands", len(stages[0].closed))
        for frame, factor in ((first, 0.0), (last, 1.0)):
            set_value(modifier, "Factor", factor)
            owner, path = place_of(modifier, "Factor")
            owner.keyframe_insert(path, frame=frame)
        for fcurve in fcurves(shown):
            for keyframe in fcurve.keyframe_points:
                keyframe.interpolation = "LINEAR"
        copy_look(self._result, shown)
        return shown

    def finish(self) -> None:
        """Shows the frames instead of the result, and instead of those baked earlier."""
        clear(self._result)
        for block, name in self._names:  # the earlier ones had them
            block.name = name
        self._scene.collection.children.link(self.collection)
        self._result.meander.bake = self.collection
        self._result.hide_render = True
        self._result.hide_viewport = True

    def discard(self) -> None:
        """Takes the frames away; the result is as it was."""
        _remove(self.collection)
        self._result.hide_render, self._result.hide_viewport = self._hidden


def baked_result(thing: bpy.types.Object | None) -> bpy.types.Object | None:
    """The result whose baked frames an object stands for: itself, one on this surface, or the one
    that this is a frame of. None where there is none.

    A result with a bake is hidden, and cannot be chosen in a view.
    """
    if thing is None:
        return None
    if thing.meander.bake is not None:
        return thing
    surface = thing.parent if thing.type == "CURVE" else thing
    if surface is None:
        return None
    for result in (settings_of(surface).last_result, *surface.children):
        bake = result.meander.bake if result is not None else None
        if bake is not None and (thing == surface or bake in thing.users_collection[:]):
            return result
    return None


def looks_differ(result: bpy.types.Object) -> bool:
    """Whether the baked frames of a result look otherwise than it does; cheap, for panels."""
    bake = result.meander.bake
    shown = next(iter(bake.objects), None) if bake is not None else None
    if shown is None:
        return False
    mine, its = modifier_of(result), modifier_of(shown)
    materials = list(result.data.materials) != list(shown.data.materials)
    return materials or None not in (mine, its) and not same_values(mine, its)


def pass_on_look(result: bpy.types.Object) -> None:
    """Gives all baked frames of a result the look and the materials that it has."""
    mine, materials = modifier_of(result), list(result.data.materials)
    for shown in result.meander.bake.objects:
        its = modifier_of(shown)
        if None not in (mine, its):
            copy_values(mine, its)
        for index, material in enumerate(materials):
            if index < len(shown.data.materials):
                shown.data.materials[index] = material
            else:
                shown.data.materials.append(material)
        shown.update_tag()


def on_output() -> None:
    """What a script has changed of the look of a result since its frames were baked."""
    for thing in bpy.data.objects:
        if thing.type == "CURVE" and thing.library is None and looks_differ(thing):
            pass_on_look(thing)


def places_of(first: int, last: int, subframes: int) -> Iterator[float]:
    """The frames from `first` to `last`, with `subframes` places between two of them."""
    for place in range((last - first) * (subframes + 1) + 1):
        frame, part = divmod(place, subframes + 1)
        yield first + frame + part / (subframes + 1)


def go_to(scene: bpy.types.Scene, frame: float) -> None:
    """Shows a frame, or a place between two."""
    scene.frame_set(int(frame // 1), subframe=frame % 1)


def frames_of(
    result: bpy.types.Object, context: bpy.types.Context, first: int, last: int
) -> list[tuple[float, list[toolpath.Strand]]]:
    """The baked frames of a result from one to another, each with its strands, and what sticks in
    the places between them that were baked; none where nothing is baked. Raises DataError."""
    scene, settings = context.scene, result.meander
    bake, present = settings.bake, scene.frame_current_final
    subframes = settings.motion_subframes if settings.motion == "STICK" else 0
    if bake is None:
        return []
    frames = []
    try:
        for frame in places_of(first, last, subframes):
            go_to(scene, frame)
            depsgraph = context.evaluated_depsgraph_get()
            # The keys of an object's visibility reach the object with the frame.
            for shown in (each for each in bake.objects if not each.hide_render):
                frames.append((frame, point_attributes.strands_of_frame(result, shown, depsgraph)))
    finally:
        go_to(scene, present)
    return frames


def clear(result: bpy.types.Object) -> None:
    """Takes the baked frames of a result away and shows it again."""
    collection = result.meander.bake
    if collection is None:
        return
    result.meander.bake = None
    _remove(collection)
    result.hide_render = result.hide_viewport = False


def _remove(collection: bpy.types.Collection) -> None:
    data = [item.data for item in collection.objects]
    bpy.data.batch_remove([*collection.objects, *data, collection])


def _key_hidden(thing: bpy.types.Object, frame: int, hidden: bool) -> None:
    thing.hide_render = thing.hide_viewport = hidden
    thing.keyframe_insert("hide_render", frame=frame)
    thing.keyframe_insert("hide_viewport", frame=frame)
