# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a run belongs, and its result goes: where the surface is, whatever a window shows."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy

from .errors import DataError
from .identity import Key


class Choice:
    """What is active and selected in a view layer, to be compared with what is later."""

    def __init__(self, view_layer: bpy.types.ViewLayer) -> None:
        active = view_layer.objects.active
        self._active = None if active is None else Key(active)
        self._selected = [Key(thing) for thing in view_layer.objects.selected]

    def is_still_made(self, view_layer: bpy.types.ViewLayer) -> bool:
        """Whether the user has chosen nothing else meanwhile."""
        active = None if self._active is None else self._active.find()
        selected = {key.find() for key in self._selected} - {None}
        now = view_layer.objects
        return now.active == active and set(now.selected) == selected


class HomeScene:
    """The scene and the view layer in which a surface was found."""

    def __init__(self, scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer) -> None:
        self._scene = Key(scene)
        self._view_layer = view_layer.name

    def find(
        self, surface: bpy.types.Object | None
    ) -> tuple[bpy.types.Scene, bpy.types.ViewLayer] | None:
        """Scene and view layer as they are now; None where the surface is in no scene any more.

        Where the scene has been deleted or has lost the surface, another one that has it; where the
        view layer has been deleted, renamed or has lost it, another one of the scene that has it.
        """
        scenes = surface.users_scene if surface is not None else ()
        first = self._scene.find()
        scene = first if first in scenes else next(iter(scenes), None)
        if scene is None:
            return None
        layers = [scene.view_layers.get(self._view_layer), *scene.view_layers]
        with_surface = (
            layer
            for layer in layers
            if layer is not None and layer.objects.get(surface.name) == surface
        )
        return scene, next(with_surface, scene.view_layers[0])

    @contextmanager
    def entered(
        self, context: bpy.types.Context, surface: bpy.types.Object | None
    ) -> Iterator[bpy.types.Context]:
        """The context of that scene for the block, `bpy.context` too.

        Raises DataError where the surface is in no scene any more.
        """
        found = self.find(surface)
        if found is None:
            raise DataError("The surface was deleted while the curve was growing; start again")
        scene, view_layer = found
        if context.scene == scene and context.view_layer == view_layer:
            yield context
            return
        with context.temp_override(scene=scene, view_layer=view_layer):
            yield bpy.context
