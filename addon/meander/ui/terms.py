# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel "Strand Shape": the weights of the terms of the energy."""

from __future__ import annotations

import bpy

from ..scene.linked_settings import settings_of
from ..scene.options import warnings_of
from .declared import rows
from .registered import registration
from .settings import MeanderSettings
from .sidebar import (
    ADVANCED,
    ADVANCED_ORDER,
    SubPanel,
    columns,
    notice,
)


class MEANDER_PT_weights(SubPanel, bpy.types.Panel):
    bl_idname = "MEANDER_PT_weights"
    bl_label = "Strand Shape"
    bl_parent_id = ADVANCED
    bl_order = ADVANCED_ORDER["weights"]

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        columns(layout, live=True)
        settings: MeanderSettings = settings_of(context.active_object)
        rows(layout, settings, "Strand Shape", heading="Shape")
        for warning in warnings_of(settings):
            notice(layout, warning, "ERROR")


register, unregister = registration(MEANDER_PT_weights)
