# SPDX-License-Identifier: GPL-3.0-or-later
"""What the views show of a run: the curve as it grows, and nothing of a result that is continued.

The growing curve is no data of Blender's at all, and a result that is continued lays its own aside
meanwhile, so that a run that is cancelled leaves everything as it was.
"""

from __future__ import annotations

import bpy

from .. import core
from .growing_curve import GrowingCurve
from .plan import Plan

# How far above the surface the preview is drawn, in spacings.
PREVIEW_LIFT = 0.05


class Preview:
    """The growing curve in the views of one scene, from the first show() to end()."""

    def __init__(self, plan: Plan, scene: str) -> None:
        self._plan = plan
        self._scene = scene  # name of the scene that shows it
        self._growing: GrowingCurve | None = None
        self._original_data = ""  # name of the data of a result that is continued
        self._emptied_data = ""  # and of what it has meanwhile

    @property
    def point_count(self) -> int:
        """How many points the curve has that the views show."""
        return self._growing.point_count if self._growing is not None else 0

    def show(self, polylines: core.Polylines) -> None:
        """Takes the curve to show from now on; the caller has the views redrawn."""
        plan = self._plan
        if self._growing is None:
            self._growing = GrowingCurve(plan.surface.find, self._scene, plan.matrix)
        self._hide_result()
        self._growing.show(polylines, PREVIEW_LIFT * plan.spacing)

    def _hide_result(self) -> None:
        """Empties a result that is continued while its curve is drawn."""
        result = self._plan.result.find() if self._plan.result else None
        if result is None or self._emptied_data:
            return
        self._original_data = result.data.name
        result.data = result.data.copy()
        result.data.bevel_depth = 0.0
        result.data.splines.clear()
        self._emptied_data = result.data.name

    def restore_result(self) -> None:
        """Gives a result that is continued its curve back, until the next picture."""
        if not self._emptied_data:
            return
        result = self._plan.result.find()
        original = bpy.data.curves.get(self._original_data)
        if result is not None and original is not None:
            result.data = original
        data = bpy.data.curves.get(self._emptied_data)
        if data is not None and data.users == 0:
            bpy.data.curves.remove(data)
        self._emptied_data = ""

    def end(self) -> None:
        """Draws no more, and restores the result. May be called more than once."""
        if self._growing is not None:
            self._growing.remove()
            self._growing = None
        self.restore_result()
