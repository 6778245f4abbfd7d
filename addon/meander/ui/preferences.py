# SPDX-License-Identifier: GPL-3.0-or-later
"""The preferences of the add-on: from which size on a run asks, and what limits every one."""

from __future__ import annotations

import bpy
from bpy.props import EnumProperty, IntProperty

from .. import core
from ..model.camera import PAPERS
from ..model.estimate import Estimate
from ..model.options.table import in_panel
from ..scene.preferences import PACKAGE, preferred
from .declared import declared
from .declared import row as row_of


class RunPreferences:
    """The options that are about the machine, and not about a curve."""

    __annotations__ = declared(in_panel("Preferences"))


class MeanderPreferences(RunPreferences, bpy.types.AddonPreferences):
    bl_idname = PACKAGE

    most_points: IntProperty(
        name="Points",
        description=(
            "Ask before a run whose curve has more points than this; "
            "views and undo grow slow with them. 0 never asks"
        ),
        default=500_000,
        min=0,
        soft_max=10_000_000,
    )
    most_memory: IntProperty(
        name="Memory (MB)",
        description="Ask before a run that needs more memory than this. 0 never asks",
        default=2000,
        min=0,
        soft_max=100_000,
    )
    page: EnumProperty(
        name="Page",
        description="What the size of an unrolled drawing begins with",
        items=tuple(
            (name.upper(), name.capitalize(), f"{width:g} x {height:g} mm")
            for name, (width, height) in PAPERS.items()
        ),
        default="A4",
    )

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.label(text="Ask before a run that needs more than")
        row = layout.row()
        row.prop(self, "most_points")
        row.prop(self, "most_memory")
        layout.label(text="In every run")
        line = layout.row()
        for option in in_panel("Preferences"):
            row_of(line, self, option.setting)
        layout.prop(self, "page")
        layout.operator("meander.open_help", icon="QUESTION")
        library = core.library_notice()
        if library:
            layout.label(text=library, icon="ERROR")


def is_large(estimate: Estimate) -> bool:
    """Whether a run of this size is to ask first."""
    points, megabytes = _limit("most_points"), _limit("most_memory")
    return 0 < points < estimate.points or 0 < megabytes < estimate.memory / 1e6


def page_size() -> tuple[float, float]:
    """Width and height of the page that drawings are made for, in millimetres."""
    return PAPERS[preferred("page", "A4").lower()]


def _limit(name: str) -> int:
    return preferred(name, MeanderPreferences.bl_rna.properties[name].default)


def register() -> None:
    if core.library_notice():
        print(f"meander: {core.library_notice()}", flush=True)
    bpy.utils.register_class(MeanderPreferences)


def unregister() -> None:
    bpy.utils.unregister_class(MeanderPreferences)
