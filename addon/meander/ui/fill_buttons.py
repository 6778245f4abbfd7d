# SPDX-License-Identifier: GPL-3.0-or-later
"""The buttons that fill: the same in the panel and in the menu, for what is active."""

from __future__ import annotations

import bpy

from ..run import suspended
from ..scene.fillable import is_result
from ..scene.results import last_result
from ..scene.settings import surface_of
from .fill import MEANDER_OT_resume, MEANDER_OT_run


def draw_fill_buttons(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Fill with Curve, or what goes on with the curve that is there."""
    active = context.active_object
    run = MEANDER_OT_run.bl_idname
    if active is None or surface_of(active) is None:
        layout.operator(run, icon="PLAY")
        return
    kept = suspended.run_of(active)
    if kept is not None:
        # What has its whole length is still being made even.
        text = f"Continue at {min(100.0 * kept.progress, 99.0):.0f} %"
        layout.operator(MEANDER_OT_resume.bl_idname, text=text, icon="PLAY")
    if is_result(active):
        if kept is None:
            layout.operator(run, text="Continue", icon="PLAY")
        layout.operator(run, text="Fill Again", icon="FILE_REFRESH").restart = True
    elif last_result(active, context.scene) is None:
        layout.operator(run, icon="PLAY")
        return
    else:
        layout.operator(run, text="Fill Again", icon="FILE_REFRESH")
    layout.operator(run, text="New Curve", icon="ADD").beside = True
