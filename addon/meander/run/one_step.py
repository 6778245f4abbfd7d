# SPDX-License-Identifier: GPL-3.0-or-later
"""A change with Live on, and the curve that has followed it, as one step of undo.

Blender keeps two states: one after the change, with the curve from before, and one after the run.
The first is passed by, in both directions: a result counts how often Live has changed it and notes
what its settings asked for then. Undo that takes back such a change goes on while the settings ask
for what the curve is not, and redo goes on until it is.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator

import bpy

from .. import core
from ..scene.density import chosen_density, density_of
from ..scene.errors import DataError
from ..scene.linked_settings import settings_of
from ..scene.settings import copied, surface_of
from . import images, live, remade
from .lasting import Activity, Memory

# Of results, by their names: how often Live had changed each before an undo or a redo, and how
# often before what can be redone was taken back.
_before: Memory[str, int] = Memory()
_taken_back: Memory[str, int] = Memory()
# Whether it is an undo or a redo that goes on, and for which results.
_passing: Activity[tuple[str, list[str]]] = Activity()


def note(result: bpy.types.Object, paint: bytes) -> None:
    """Notes on a result what its settings ask for, which is what its run has made.

    paint   of paint_of(), before the curve was written: after that a depsgraph would evaluate the
            curve for it, too
    """
    result.meander.figures.asked = _asked(result, paint)


def paint_of(thing: bpy.types.Object, context: bpy.types.Context) -> bytes:
    """What the density follows of what is painted on a surface, by the settings of an object."""
    surface = surface_of(thing)
    choice = chosen_density(settings_of(thing), surface)
    if choice.source not in live.PAINTED:
        return b""
    try:
        density = density_of(choice, surface, context.evaluated_depsgraph_get())
    except (DataError, core.MeanderError):
        density = None
    return b"" if density is None else density.tobytes()


def note_change(result: bpy.types.Object) -> None:
    """Counts a change that Live has made, and forgets what could be redone before it."""
    result.meander.figures.live_changes += 1
    _taken_back.pop(result.name, None)


def on_undo_begin() -> None:
    """Before an undo or a redo."""
    _before.clear()
    _before.update((thing.name, thing.meander.figures.live_changes) for thing in _changed_live())


def on_undo() -> None:
    """After an undo: goes on past the change that a curve has followed."""
    now = {thing.name: thing.meander.figures.live_changes for thing in bpy.data.objects}
    names = [name for name, count in _before.items() if now.get(name, count) < count]
    for name in names:
        most = _taken_back.get(name, 0)
        _taken_back[name] = max(most, _before[name])
    _order("undo", names)


def on_redo() -> None:
    """After a redo: goes on to the curve that has followed a change."""
    names = [
        name
        for name, most in _taken_back.items()
        if name in bpy.data.objects
        and bpy.data.objects[name].meander.figures.live_changes < most
    ]
    _order("redo", names)


def _order(direction: str, names: list[str]) -> None:
    """Handlers cannot undo; a timer can."""
    if names and _passing.current is None and not bpy.app.background:
        _passing.begin((direction, names))
        bpy.app.timers.register(go_on, first_interval=0.0)


def go_on() -> None:
    """Called by a timer: passes by the states in which a curve does not fit its settings yet."""
    if _passing.current is None:
        return
    direction, names = _passing.current
    step = bpy.ops.ed.undo if direction == "undo" else bpy.ops.ed.redo
    try:
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            while _is_between(names) and step.poll():
                if step() != {"FINISHED"}:
                    break
    finally:
        _passing.end()


def _is_between(names: list[str]) -> bool:
    found = [bpy.data.objects[name] for name in names if name in bpy.data.objects]
    return any(_is_unsettled(thing) for thing in found)


def _is_unsettled(result: bpy.types.Object) -> bool:
    """Whether something is still to follow: the curve, or what was made of it."""
    if remade.is_due(result) or images.is_due(result):
        return True
    figures = result.meander.figures
    asked = figures.asked if result.meander.live else ""
    if not asked or surface_of(result) is None:
        return bool(asked)
    return asked != _asked(result, paint_of(result, bpy.context))


def _changed_live() -> Iterator[bpy.types.Object]:
    return (thing for thing in bpy.data.objects if thing.meander.figures.live_changes)


def _asked(result: bpy.types.Object, paint: bytes) -> str:
    """Another text where the live settings or the paint of a result ask for another curve."""
    settings, surface = settings_of(result), surface_of(result)
    if surface is None:
        return ""
    names = [name for name in copied(settings) if live.is_live(name)]
    plain = [getattr(settings, name) for name in names]
    values = [value if isinstance(value, (str, int, float)) else "" for value in plain]
    choice = chosen_density(settings, surface)
    digest = hashlib.blake2b(repr((values, choice)).encode(), digest_size=8)
    digest.update(paint)
    return digest.hexdigest()
