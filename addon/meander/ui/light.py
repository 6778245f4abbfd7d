# SPDX-License-Identifier: GPL-3.0-or-later
"""Fewer points for a result that is there already."""

from __future__ import annotations

import bpy

from ..model.geometry import surface_crossings
from ..model.options.input import light_of
from ..model.options.option import chosen
from ..model.options.table import in_panel
from ..scene.errors import DataError
from ..scene.light import least_spacing, make_light
from ..scene.points import polylines_of
from .on_result import OnOwnResult, result_of
from .refusing import refusing, sentence_of
from .registered import registration


class MEANDER_OT_make_light(OnOwnResult, bpy.types.Operator):
    """Leave out the points of this curve that are not seen, within the tolerance"""

    bl_idname = "meander.make_light"
    bl_label = "Make Light"
    bl_options = {"REGISTER", "UNDO"}

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        result = result_of(context)
        was_light, result.meander.use_light = result.meander.use_light, True
        try:
            light = light_of(chosen(in_panel("Make"), result.meander))
            before, after = make_light(result, light)
        except DataError:
            result.meander.use_light = was_light
            raise
        self.report({"INFO"}, f"{result.name}: {after:,} of {before:,} points")
        curve, _index, _weights = polylines_of(result, context.evaluated_depsgraph_get())
        places = surface_crossings.of_polylines(curve, least_spacing(result))
        warning = surface_crossings.crossing_warning(places)
        if warning:
            self.report({"WARNING"}, sentence_of(warning))
        return {"FINISHED"}


register, unregister = registration(MEANDER_OT_make_light)
