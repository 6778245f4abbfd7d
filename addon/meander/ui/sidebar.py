# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels of the tab "Meander" are built from, and the order in which they stand.

A feature's panel derives from SubPanel, takes its place from ORDER, and is registered by its own
module, in whatever order Blender loads them.
"""

from __future__ import annotations

import bpy

from ..run import session
from ..scene.settings import surface_of

# Top to bottom: what came of the last run, where it is seen without scrolling; then what the curve
# is to be like, how it is computed, and what can be done with it.
# Gaps between the numbers are for what comes in between.
ORDER = {
    "figures": 5,
    "density": 10,
    "alignment": 20,
    "guides": 30,
    "surface": 40,
    "mask": 42,
    "repair": 44,
    "weights": 50,
    "options": 60,
    "result": 70,
    "motion": 80,
}


class Sidebar:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Meander"


class SubPanel(Sidebar):
    """A panel below the main one, shown for every surface and every result."""

    bl_parent_id = "MEANDER_PT_main"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return surface_of(context.active_object) is not None


def columns(layout: bpy.types.UILayout) -> None:
    """Labels to the left, values to the right; all of it grey while a curve grows."""
    layout.use_property_split = True
    layout.use_property_decorate = False
    layout.active = session.current() is None


def notice(layout: bpy.types.UILayout, text: str, icon: str = "INFO") -> None:
    """A row of plain text with an icon; "ERROR" is Blender's name of the warning sign."""
    layout.row().label(text=text, icon=icon)
