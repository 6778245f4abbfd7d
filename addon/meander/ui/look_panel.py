# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel "Look": what a result looks like."""

from __future__ import annotations

import bpy

from .declared import switch
from .settings import MeanderSettings
from .sidebar import ORDER, SubPanel, columns


class MEANDER_PT_look(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_look"
    bl_label = "Look"
    bl_order = ORDER["look"]
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout)
        settings: MeanderSettings = context.active_object.meander
        switch(layout, settings, "use_bevel")
        row = layout.row()
        row.active = settings.use_bevel
        row.prop(settings, "bevel_share")
        switch(layout, settings, "flat_profile")
        switch(layout, settings, "radius_follows")


def register() -> None:
    bpy.utils.register_class(MEANDER_PT_look)


def unregister() -> None:
    bpy.utils.unregister_class(MEANDER_PT_look)
