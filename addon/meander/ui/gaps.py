# SPDX-License-Identifier: GPL-3.0-or-later
"""The button Show Gaps: rings around the places that a run has left empty."""

from __future__ import annotations

import bpy

from ..model.last_run import GAP_THAT_MATTERS
from ..run import gaps as gap_marks
from ..run.lasting import why_busy
from ..scene.results import shown_result
from ..scene.settings import surface_of
from .reasons import Reasoned, Reasons
from .registered import registration
from .settings import MeanderFigures


def wide_gaps(figures: MeanderFigures) -> int:
    """How many gaps matter; -1 where none were searched for."""
    if figures.wide_gaps < 0 <= figures.gap_count:  # made before these were counted
        return sum(gap.size > GAP_THAT_MATTERS for gap in figures.gaps)
    return figures.wide_gaps


class MEANDER_OT_show_gaps(Reasoned, bpy.types.Operator):
    """Mark the places that are too far from the curve, or take the marks away again"""

    bl_idname = "meander.show_gaps"
    bl_label = "Show Gaps"
    bl_description = (
        "Mark the places in the views that are farther than 0.75 spacings from the curve, or "
        "take the marks away again; nothing else changes"
    )
    bl_options = {"REGISTER"}

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        result = shown_result(context.active_object, context.scene)
        yield why_busy()
        if result is None or surface_of(result) is None:
            yield "Choose a curve that Meander has made, or its mesh"
        if not result.visible_get():
            yield "The curve is hidden"

    def execute(self, context: bpy.types.Context) -> set[str]:
        result = shown_result(context.active_object, context.scene)
        if gap_marks.shown_of(result):
            gap_marks.hide()
            return {"FINISHED"}
        figures = result.meander.figures
        count = wide_gaps(figures)
        if count <= 0:
            self.report(
                {"INFO"},
                f"{result.name}: the last run left no gaps"
                if count == 0
                else f"{result.name}: a run that was stopped has gaps everywhere; let it go on",
            )
            return {"CANCELLED"}
        gap_marks.show(result)
        shown = len(gap_marks.places(result)[0])
        of_all = f" of {count:,}" if count > shown else ""
        gaps = "gap" if count == 1 else "gaps"
        self.report(
            {"INFO"},
            f"{result.name}: {shown:,}{of_all} {gaps}, the largest "
            f"{figures.largest_gap:.2f} times as far from the curve as wanted",
        )
        return {"FINISHED"}


register, unregister = registration(MEANDER_OT_show_gaps)
