# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run borrows from the window: a timer, the status bar, the progress at the cursor."""

from __future__ import annotations

import os
import time

import bpy

from .. import core
from ..scene.identity import Key, number_of
from .pace import Pace

TICKS_PER_SECOND = 15

# Over a 3D view; elsewhere keys do what they always do.
KEYS = "Enter: Stop and Keep    Esc: Cancel"
# Of the share that drawing may have where the processors draw, for the sidebar between pictures.
PANEL_SHARE = 0.15
# Nobody reads the status bar and the sidebar faster than they change, in seconds.
TEXT_INTERVAL = 0.25


class Window:
    """What a run borrows from the window: a timer, the status bar, the progress at the cursor.

    On a machine where drawing takes too much from the solver also the smoothing of edges, for which
    Blender would draw every picture eight times.
    """

    def __init__(self, context: bpy.types.Context, keys: str = KEYS) -> None:
        """keys   what the status bar says of keys"""
        self._keys = keys
        manager = context.window_manager
        self._timer = manager.event_timer_add(1.0 / TICKS_PER_SECOND, window=context.window)
        self._workspaces: dict[int, Key] = {}
        self._shown = ("", "")
        self._text_shown = 0.0  # when
        self._software = _draws_by_software()
        self._paces = {
            region: Pace(1.0 / TICKS_PER_SECOND, os.cpu_count() or 1, self._software)
            for region in ("WINDOW", "UI")
        }
        if self._software:
            # The sidebar itself is quick, but the whole window is composed again for it.
            self._paces["UI"].share *= PANEL_SHARE
        self._smoothing: str | None = None
        self._handlers = {
            region: bpy.types.SpaceView3D.draw_handler_add(
                self._drawn, (region,), region, "POST_PIXEL"
            )
            for region in self._paces
        }
        manager.progress_begin(0.0, 100.0)

    def picture_due(self, growth: bool) -> bool:
        """Whether the curve may be shown again without taking too much from the solver.

        growth   whether pictures of how the curve grew are waiting
        """
        pace = self._paces["WINDOW"]
        due = pace.tick(time.perf_counter(), time.thread_time(), growth)
        if pace.slow and self._smoothing is None:
            self._smoothing = self._smooth("OFF")
        return due

    def picture_given(self) -> None:
        redraw("WINDOW")
        self._paces["WINDOW"].asked(time.perf_counter())

    def text_due(self, with_picture: bool) -> bool:
        """Whether the text may be shown again; together with a picture it costs next to nothing."""
        now = time.perf_counter()
        due = self._paces["UI"].tick(now, time.thread_time())
        return (due or with_picture) and now >= self._text_shown + TEXT_INTERVAL

    def show(self, context: bpy.types.Context, text: str, progress: float) -> None:
        """Shows how far the run is, in the status bar and in panels."""
        # The text belongs to the workspace in front, and the user may change to another.
        workspace = context.workspace
        self._workspaces.setdefault(number_of(workspace), Key(workspace))
        shown = (workspace.name, text)
        if shown == self._shown:
            return
        self._shown = shown
        self._text_shown = time.perf_counter()
        context.window_manager.progress_update(100.0 * progress)
        workspace.status_text_set(f"{text}    |    {self._keys}")
        redraw("UI")
        if not self._paces["WINDOW"].waiting:
            self._paces["UI"].asked(self._text_shown)

    def give_back(self) -> None:
        context = bpy.context
        for region, handler in self._handlers.items():
            bpy.types.SpaceView3D.draw_handler_remove(handler, region)
        if self._smoothing is not None:
            self._smooth(self._smoothing)
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        for key in self._workspaces.values():
            workspace = key.find()
            if workspace is not None:
                with context.temp_override(workspace=workspace):
                    workspace.status_text_set(None)
        redraw("WINDOW", "UI")

    def _drawn(self, region: str) -> None:
        self._paces[region].drawn(time.perf_counter())

    @staticmethod
    def _smooth(choice: str) -> str:
        """Chooses how edges are smoothed and returns what was chosen before."""
        preferences = bpy.context.preferences
        before, dirty = preferences.system.viewport_aa, preferences.is_dirty
        preferences.system.viewport_aa = choice
        preferences.is_dirty = dirty  # or Blender would save it
        return before


def redraw(*kinds: str) -> None:
    """Has the 3D views drawn again: what they show, "WINDOW", or the sidebars beside them, "UI"."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                for region in area.regions:
                    if region.type in kinds:
                        region.tag_redraw()


def _draws_by_software() -> bool:
    """Whether the processors draw, because there is no graphics card."""
    if bpy.app.background:
        return False
    import gpu  # asking it crashes without a window

    renderer = gpu.platform.renderer_get().lower()
    return any(name in renderer for name in ("llvmpipe", "softpipe", "swr", "swiftshader"))


def leave_a_processor(options: core.FlowOptions) -> None:
    """Leaves one processor to the window, which draws, where that is not half of them."""
    processors = os.cpu_count() or 1
    if options.threads == 0 and processors > 2:
        options.threads = processors - 1
