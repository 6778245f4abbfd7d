# SPDX-License-Identifier: GPL-3.0-or-later
"""Results that follow their surfaces whenever the frame changes."""

from __future__ import annotations

from typing import Any

import bpy

from .. import core
from ..scene import bake
from ..scene.errors import DataError
from ..scene.meshes import surface_now
from . import session
from .followers import Follower, follower_of

# Followers of the results that follow, by full name, which says the library too: what they know is
# not in the file, and whatever may have changed it (undo, another file) makes new ones necessary.
_followers: dict[str, Follower] = {}
# Why a result does not follow, for the panel.
_problems: dict[str, str] = {}
_rendering = False


def problem_of(result: bpy.types.Object) -> str | None:
    """Why a result does not follow, as a sentence; None while it does."""
    return _problems.get(result.name_full)


def forget() -> None:
    """Makes every follower start again from its curve as it is."""
    _followers.clear()
    _problems.clear()


def begin(result: bpy.types.Object, context: bpy.types.Context) -> None:
    """Starts or stops following, as the settings say; the curve fits the present frame."""
    key = result.name_full
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
    return not _rendering or bpy.app.background or scene.render.use_lock_interface


def on_frame(scene: bpy.types.Scene, depsgraph: Any = None) -> None:
    results = [thing for thing in scene.objects if thing.type == "CURVE" and thing.meander.follow]
    if not results or session.current() is not None or not _may_change(scene):
        return
    depsgraph = depsgraph or bpy.context.evaluated_depsgraph_get()
    for result in results:
        surface = result.meander.surface
        if surface is None or result.library or result.data.library or result.mode != "OBJECT":
            continue
        key = result.name_full
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
    global _rendering
    _rendering = True


def on_render_end() -> None:
    global _rendering
    _rendering = False
