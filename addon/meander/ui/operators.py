# SPDX-License-Identifier: GPL-3.0-or-later
"""The buttons beside a run: propose a spacing, show the gaps."""

import bpy
import numpy as np

from ..run import session
from ..scene.curve_writer import select_points_around
from ..scene.errors import DataError
from ..scene.meshes import proposed_spacing, triangles_of
from ..scene.settings import surface_of
from .run_operators import sentence_of

# Show Gaps selects points up to this many radii of the empty place from its middle: some on every
# side, and not yet the next strands but one.
_GAP_REACH = 1.2


class MEANDER_OT_propose_spacing(bpy.types.Operator):
    """Set a spacing that suits the size of the surface and is filled in seconds"""

    bl_idname = "meander.propose_spacing"
    bl_label = "Propose Spacing"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if surface_of(context.active_object) is None:
            cls.poll_message_set("Choose a mesh to fill, or a curve that Meander has made")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        active = context.active_object
        depsgraph = context.evaluated_depsgraph_get()
        try:
            triangles = triangles_of(surface_of(active), depsgraph)
        except DataError as error:
            self.report({"ERROR"}, sentence_of(error))
            return {"CANCELLED"}
        active.meander.spacing = proposed_spacing(*triangles)
        return {"FINISHED"}


class MEANDER_OT_show_gaps(bpy.types.Operator):
    """Select the points of a result around the places that its run has left empty"""

    bl_idname = "meander.show_gaps"
    bl_label = "Show Gaps"
    bl_description = (
        "Select the points around the places that are too far from the curve, in Edit Mode. "
        "View Selected then shows where they are"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        active = context.active_object
        if session.current() is not None:
            cls.poll_message_set("A curve is growing")
        elif active is None or active.type != "CURVE" or surface_of(active) is None:
            cls.poll_message_set("Choose a curve that Meander has made")
        elif active.library is not None or active.data.library is not None:
            cls.poll_message_set("The curve is linked from another file and cannot be edited")
        elif not active.visible_get():
            cls.poll_message_set("The curve is hidden")
        elif context.mode not in {"OBJECT", "EDIT_CURVE"}:
            cls.poll_message_set("Works in Object Mode and Edit Mode")
        else:
            return True
        return False

    def execute(self, context: bpy.types.Context) -> set[str]:
        active = context.active_object
        figures = active.meander.figures
        if not len(figures.gaps):
            known = figures.gap_count >= 0
            self.report(
                {"INFO"},
                f"{active.name}: the last run left no gaps"
                if known
                else f"{active.name}: a run that was stopped has gaps everywhere; let it go on",
            )
            return {"CANCELLED"}
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        centres = np.array([gap.position[:] for gap in figures.gaps], dtype=np.float64)
        selected = select_points_around(active, centres, _GAP_REACH)
        bpy.ops.object.mode_set(mode="EDIT")
        if not selected:
            self.report({"WARNING"}, f"{active.name} has no points any more; fill it again")
            return {"FINISHED"}
        shown = len(centres)
        of_all = f" of {figures.gap_count:,}" if figures.gap_count > shown else ""
        self.report(
            {"INFO"},
            f"{active.name}: {selected:,} points around {shown:,}{of_all} gaps, the largest "
            f"{figures.largest_gap:.2f} times as far from the curve as wanted",
        )
        return {"FINISHED"}


_CLASSES = (MEANDER_OT_propose_spacing, MEANDER_OT_show_gaps)


def register() -> None:
    for cls in _CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
