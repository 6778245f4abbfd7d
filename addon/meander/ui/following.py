# SPDX-License-Identifier: GPL-3.0-or-later
"""When what was made of a curve follows it: meshes after a run, or as soon as the curve rests with
Live; the images of a material later, as they take seconds."""

from __future__ import annotations

import time
from collections.abc import Callable

import bpy

from ..run import images, one_step, remade
from ..run.lasting import Activity, Memory, why_busy
from ..scene.identity import Key, number_of

# How long it has to rest before its meshes are made again, and before its images, which take
# seconds; in seconds.
_REST, _REST_FOR_IMAGES = 0.8, 3.0

# Results of which something is to be made again, by their numbers, and since when none has moved.
_outdated: Memory[int, Key] = Memory()
_rests: Activity[float] = Activity()


def after_run(result: bpy.types.Object, context: bpy.types.Context) -> str:
    """After a run that was asked for: meshes follow at once. Returns what to warn of."""
    warning = remade.follow(result, context)
    order(result)
    return warning


def order(result: bpy.types.Object) -> None:
    """Has what follows a result made again as soon as the curve rests; at once where no timer is.

    Live moves a curve again and again, and is not to wait for meshes.
    """
    if bpy.app.background:
        remade.follow(result, bpy.context)
        remade.follow_with_images(result, bpy.context)
        return
    _outdated.setdefault(number_of(result), Key(result))
    _rests.begin(time.perf_counter())
    if not bpy.app.timers.is_registered(tick):
        bpy.app.timers.register(tick, first_interval=_REST)


def tick() -> float | None:
    """Called by a timer while something is ordered."""
    if _rests.current is None:  # the file has gone
        return None
    rested = time.perf_counter() - _rests.current
    if why_busy() is not None or rested < _REST:
        return 0.2
    results = [result for key in _outdated.values() if (result := key.find()) is not None]
    _follow([each for each in results if remade.is_due(each)], remade.follow)
    left = [each for each in results if images.is_due(each)]
    if left and rested < _REST_FOR_IMAGES:
        return 0.2
    _follow(left, remade.follow_with_images)
    _outdated.end()
    _rests.end()
    return None


def _follow(
    results: list[bpy.types.Object], made: Callable[[bpy.types.Object, bpy.types.Context], str]
) -> None:
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        for result in results:
            made(result, bpy.context)
            one_step.note_change(result)
            bpy.ops.ed.undo_push(message="Make Again")
