# SPDX-License-Identifier: GPL-3.0-or-later
"""What the views show of a run: the curve as it grows, and a box of a result that is continued.

The growing curve is no data of Blender's at all, and a result that is continued keeps its own; the
views only draw less of it. So whatever is saved, undone or ended meanwhile holds the whole result.
"""

from __future__ import annotations

import bpy

from .. import core
from ..scene.as_box import draw_as_box
from ..scene.identity import Key
from .growing_curve import GrowingCurve
from .plan import Plan

# How far in front of the surface the preview is drawn, in spacings: on slopes too, where a pixel of
# the line lies beside the line.
PREVIEW_LIFT = 0.15


class Preview:
    """The growing curve in the views of one scene, from the first show() to end()."""

    def __init__(self, plan: Plan, scene: bpy.types.Scene) -> None:
        self._plan = plan
        self._scene = Key(scene)
        self._growing: GrowingCurve | None = None

    @property
    def point_count(self) -> int:
        """How many points the curve has that the views show."""
        return self._growing.point_count if self._growing is not None else 0

    def show(self, polylines: core.Polylines, share: float = 1.0) -> None:
        """Takes the curve to show from now on, or the first share of every strand.

        The caller has the views redrawn.
        """
        plan = self._plan
        if self._growing is None:
            self._growing = GrowingCurve(plan.surface.find, self._scene.find, plan.matrix)
        self._growing.show(polylines, PREVIEW_LIFT * plan.spacing, share)
        self.keep_result_out()

    def keep_result_out(self) -> None:
        """Draws a result that is continued as a box, as soon as there is a curve to see instead.

        To be called at every tick: what is evaluated again meanwhile would be drawn in full.
        """
        if self._growing is not None:
            self._draw_result(as_box=True)

    def _draw_result(self, as_box: bool) -> None:
        result = self._plan.result.find() if self._plan.result else None
        scene = self._scene.find()
        if result is not None and scene is not None:
            # In Edit Mode the user sees what he edits.
            draw_as_box(result, as_box and result.mode == "OBJECT", scene)

    def end(self) -> None:
        """Draws no more, but the result in full. May be called more than once."""
        if self._growing is None:
            return
        self._growing.remove()
        self._growing = None
        self._draw_result(as_box=False)
