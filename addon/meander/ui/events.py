# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender calls between the deeds of a user: all handlers and timers of the add-on.

Each function of a row is a handler of its own, so that a defect in one keeps no other from running.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
from bpy.app.handlers import persistent

from ..run import estimate, images, lasting, motion, one_step, remade, rounding
from ..scene import (
    after_undo,
    bake,
    changes,
    drawn_line,
    identity,
    linked_settings,
    look,
    made,
    solid_view,
)
from . import drawing, following
from . import live as live_operator
from . import look as look_panel

# What is called at which event, in this order: first what other functions of the row look at.
_BEFORE_UNDO = (changes.on_undo_begin, after_undo.begin, images.on_undo_begin)
_AFTER_UNDO = (identity.on_undo, changes.on_undo_end, after_undo.end, images.on_undo_end)
_CALLED: dict[str, tuple[Callable[..., None], ...]] = {
    "load_pre": (lasting.leave_file,),
    "load_post": (changes.on_load, solid_view.forget, motion.on_load),
    "save_pre": (
        linked_settings.before_save,
        made.before_save,
        look.on_output,
        rounding.on_output,
        bake.on_output,
    ),
    "undo_pre": (*_BEFORE_UNDO, one_step.on_undo_begin),
    "undo_post": (*_AFTER_UNDO, solid_view.give_back, lasting.end_undone, one_step.on_undo),
    "redo_pre": _BEFORE_UNDO,
    "redo_post": (*_AFTER_UNDO, solid_view.after_redo, lasting.end_undone, one_step.on_redo),
    "depsgraph_update_post": (
        changes.on_update,
        after_undo.on_update,
        look.on_update,
        drawn_line.on_update,
        solid_view.give_back,
        lasting.end_gone,
    ),
    "frame_change_post": (changes.on_frame, motion.on_frame),
    "render_init": (
        look.on_output,
        rounding.on_output,
        bake.on_output,
        remade.on_render,
        motion.on_render,
    ),
    "render_complete": (motion.on_render_end,),
    "render_cancel": (motion.on_render_end,),
}
# Events of which a function is told the scene and what was evaluated.
_EVALUATED = frozenset({"depsgraph_update_post", "frame_change_post"})

# Timers that are begun where something is to be waited for; none outlasts the add-on.
_TIMERS = (
    live_operator.tick,
    estimate.measure_ordered,
    drawing.watch,
    look_panel.pass_on,
    look_panel.draw_ordered,
    one_step.go_on,
    following.tick,
)

# What ends with the add-on, the running curve first.
_ENDED = (lasting.end_all, solid_view.forget, changes.on_load)

# The handlers that Blender has, each with the name of its event.
_handlers: list[tuple[str, Callable[..., None]]] = []


def _handler(function: Callable[..., None], event: str) -> Callable[..., None]:
    """A handler that stays when another file is opened."""
    evaluated = event in _EVALUATED

    @persistent
    def handler(*arguments: Any) -> None:
        function(*arguments if evaluated else ())

    return handler


def register() -> None:
    for event, functions in _CALLED.items():
        for function in functions:
            _handlers.append((event, _handler(function, event)))
            getattr(bpy.app.handlers, event).append(_handlers[-1][1])
    if not bpy.app.background:
        bpy.app.timers.register(
            live_operator.tick, first_interval=live_operator.WAITING, persistent=True
        )


def unregister() -> None:
    for timer in _TIMERS:
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
    for end in _ENDED:
        end()
    while _handlers:
        event, handler = _handlers.pop()
        getattr(bpy.app.handlers, event).remove(handler)
