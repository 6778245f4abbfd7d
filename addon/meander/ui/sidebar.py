# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels of the tab "Meander" are built from, and the order in which they stand.

A feature's panel derives from SubPanel, takes its place from ORDER, and is registered by its own
module, in whatever order Blender loads them.
"""

from __future__ import annotations

import textwrap

import bpy

from ..run import session
from ..scene.settings import surface_of

# Top to bottom, in the order of use: what came of the last run, where it is seen without scrolling;
# how the curve looks, where and how it runs, what can be done with it, and what few need.
# Gaps between the numbers are for what comes in between.
ORDER = {
    "last_run": 5,
    "look": 10,
    "guidance": 20,
    "output": 60,
    "advanced": 80,
}
# The parents of what stands below some of them, and the places there.
LOOK = "MEANDER_PT_look"
LOOK_ORDER = {"color": 10}
GUIDANCE = "MEANDER_PT_guidance"
GUIDANCE_ORDER = {"density": 10, "strands": 20, "direction": 30, "region": 40}
OUTPUT = "MEANDER_PT_output"
OUTPUT_ORDER = {"motion": 10, "make": 20, "export": 30}
ADVANCED = "MEANDER_PT_advanced"
ADVANCED_ORDER = {"weights": 10, "repair": 20}


# Letters of a sentence that fit beside an icon.
_LINE = 24


class Sidebar:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Meander"


class SubPanel(Sidebar):
    """A panel below the main one, shown for every surface and every result, and closed at first."""

    bl_parent_id = "MEANDER_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return surface_of(context.active_object) is not None


def columns(layout: bpy.types.UILayout, live: bool = False) -> None:
    """Labels to the left, values to the right; all of it grey while a curve grows.

    live   unless that curve takes changes of these settings
    """
    layout.use_property_split = True
    layout.use_property_decorate = False
    running = session.current()
    layout.active = running is None or live and running.live


def notice(layout: bpy.types.UILayout, text: str, icon: str = "INFO") -> None:
    """Plain text with an icon, in as many rows as it takes in a sidebar as wide as Blender makes
    it; "ERROR" is Blender's name of the warning sign, "NONE" is no icon and no room for it.
    """
    column = layout.column(align=True)
    for number, line in enumerate(textwrap.wrap(text, _LINE)):
        column.label(text=line, icon="BLANK1" if number and icon != "NONE" else icon)
