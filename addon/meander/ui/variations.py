# SPDX-License-Identifier: GPL-3.0-or-later
"""Variations of a curve: their number beside the buttons, and a popup of six to choose from."""

from __future__ import annotations

import bpy
import bpy.utils.previews
import numpy as np
from bpy.props import BoolProperty, IntProperty

from .. import core
from ..model.thumbnail import Thumbnails
from ..model.variations import is_coarser, lines
from ..run import estimate as estimates
from ..run.plan import plan_run
from ..scene.fillable import is_result
from ..scene.linked_settings import settings_of, settings_to_change
from .fill import Fills
from .refusing import refusing
from .registered import registration

_COUNT, _COLUMNS = 6, 3
_PIXELS = 160
# How many rows of buttons high and wide a picture is.
_SCALE = 7.0
# From the front, a little from the right and from above, where no view says otherwise.
_TURN = np.array([[0.91, 0.42, 0.0], [-0.15, 0.33, 0.93], [0.39, -0.85, 0.36]])


class _Shown:
    """The pictures of the last popup, which Blender keeps by their numbers."""

    def __init__(self) -> None:
        self.pictures: bpy.utils.previews.ImagePreviewCollection | None = None
        self.first, self.coarser = 0, False

    def begin(self, first: int, coarser: bool) -> None:
        self.end()
        self.pictures = bpy.utils.previews.new()
        self.first, self.coarser = first, coarser

    def end(self) -> None:
        if self.pictures is not None:
            bpy.utils.previews.remove(self.pictures)
            self.pictures = None

    def add(self, variation: int, picture: np.ndarray) -> None:
        preview = self.pictures.new(str(variation))
        preview.image_size = picture.shape[:2]
        preview.image_pixels_float.foreach_set(picture.ravel())


shown = _Shown()


def _turn_of(context: bpy.types.Context) -> np.ndarray:
    """How the view looks at the scene."""
    view = getattr(context.space_data, "region_3d", None)
    return _TURN if view is None else np.array(view.view_matrix.to_3x3(), dtype=np.float64)


class MEANDER_OT_show_variations(Fills, bpy.types.Operator):
    """Show six variations of the curve to choose from: the same settings, begun elsewhere"""

    bl_idname = "meander.show_variations"
    bl_label = "Choose Variation"
    bl_options = {"REGISTER"}

    following: BoolProperty(
        name="Six Others",
        description="Those that follow the six that were shown last",
        default=False,
        options={"HIDDEN", "SKIP_SAVE"},
    )

    @refusing
    def execute(self, context: bpy.types.Context) -> set[str]:
        self._draw_pictures(context)
        if not bpy.app.background:
            bpy.ops.wm.call_panel(name=MEANDER_PT_variations.bl_idname, keep_open=False)
        return {"FINISHED"}

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        context.window.cursor_modal_set("WAIT")
        try:
            return self.execute(context)
        finally:
            context.window.cursor_modal_restore()

    def _draw_pictures(self, context: bpy.types.Context) -> None:
        active = context.active_object
        plan = plan_run(context, restart=is_result(active))
        problem = plan.problem
        nodes = core.estimate_cost(estimates.extent_of_problem(problem), problem.options).nodes
        first = shown.first + _COUNT if self.following else 0
        if not self.following:
            first = settings_of(active).variation // _COUNT * _COUNT
        numbers = range(first, first + _COUNT)
        curves = list(lines(problem, numbers, nodes))  # first, as it refuses what cannot be drawn
        pictures = Thumbnails(problem.vertices, problem.faces, _turn_of(context), _PIXELS)
        shown.begin(first, is_coarser(problem, nodes))
        for number, curve in zip(numbers, curves, strict=True):
            shown.add(number, pictures.of(curve))


class MEANDER_OT_use_variation(Fills, bpy.types.Operator):
    """Fill the surface with this variation; keeps the looks and modifiers of its curve"""

    bl_idname = "meander.use_variation"
    bl_label = "Use Variation"
    bl_options = {"UNDO", "INTERNAL"}

    number: IntProperty(name="Variation", min=0, options={"HIDDEN", "SKIP_SAVE"})

    def execute(self, context: bpy.types.Context) -> set[str]:
        active = context.active_object
        settings_to_change(active).variation = self.number
        how = "EXEC_DEFAULT" if bpy.app.background else "INVOKE_DEFAULT"
        bpy.ops.meander.run(how, restart=is_result(active))
        return {"FINISHED"}


class MEANDER_PT_variations(bpy.types.Panel):
    """What the popup shows; nothing of the sidebar."""

    bl_idname = "MEANDER_PT_variations"
    bl_label = "Variations"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_ui_units_x = 22

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        active = context.active_object
        if shown.pictures is None or active is None:
            return
        layout.operator_context = "INVOKE_DEFAULT"
        grid = layout.grid_flow(row_major=True, columns=_COLUMNS, even_columns=True)
        chosen = settings_of(active).variation
        for number in range(shown.first, shown.first + _COUNT):
            column = grid.column(align=True)
            column.template_icon(shown.pictures[str(number)].icon_id, scale=_SCALE)
            column.operator(
                MEANDER_OT_use_variation.bl_idname, text=str(number), depress=number == chosen
            ).number = number
        row = layout.row()
        if shown.coarser:
            row.label(text="Drawn wider: a fill takes another course")
        else:
            row.label(text="Before they are made even")
        row.operator(MEANDER_OT_show_variations.bl_idname, text="Six Others").following = True


register, _unregister = registration(
    MEANDER_OT_show_variations, MEANDER_OT_use_variation, MEANDER_PT_variations
)


def unregister() -> None:
    _unregister()
    shown.end()
