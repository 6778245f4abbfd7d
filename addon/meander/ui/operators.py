# SPDX-License-Identifier: GPL-3.0-or-later
"""The buttons: fill, stop, propose a spacing, show the gaps.

In a window, filling is modal: the native library runs on a thread of its own, where no Python is,
and a timer shows how the curve grows. execute() is the same run without a
window, for scripts and for Blender in the background.
"""

from typing import Any

import bpy
import numpy as np
from bpy.props import BoolProperty

from .. import core
from ..model import strands
from ..run import session
from ..run.plan import plan_run
from ..scene.curve_writer import select_points_around
from ..scene.errors import DataError
from ..scene.meshes import proposed_spacing, triangles_of
from ..scene.settings import surface_of

# Weight painting uses the same undo as Object Mode, and is where densities come from. Undo in the
# edit and sculpt modes knows nothing of new objects.
_MODES = ("OBJECT", "PAINT_WEIGHT", "PAINT_VERTEX")

# Show Gaps selects points up to this many radii of the empty place from its middle: some on every
# side, and not yet the next strands but one.
_GAP_REACH = 1.2


def _sentence(error: Exception) -> str:
    """The error's text as a sentence of its own: Blender shows it without any context."""
    text = str(error)
    return text[:1].upper() + text[1:]


def _summary(figures: dict[str, Any]) -> str:
    return (
        f"{figures['nodes']:,} nodes after {figures['iterations']} iterations, "
        f"spacing {figures['spacing_median']:.4g} in the median, "
        f"{figures['seconds_total']:.1f} s"
    )


def _poll_run(cls: type[bpy.types.Operator], context: bpy.types.Context) -> bool:
    if session.current() is not None:
        cls.poll_message_set("A curve is growing already")
        return False
    if context.mode not in _MODES:
        cls.poll_message_set("Works in Object Mode and Weight Paint")
        return False
    if surface_of(context.active_object) is None:
        cls.poll_message_set("Choose a mesh to fill, or a curve that Meander has made")
        return False
    return True


class MEANDER_OT_run(bpy.types.Operator):
    """Grow a curve on the active mesh until it fills the surface at the spacing"""

    bl_idname = "meander.run"
    bl_label = "Fill with Curve"
    bl_options = {"REGISTER", "UNDO"}

    restart: BoolProperty(
        name="Start Over",
        description="Start from the seed again instead of going on from the curve",
        default=False,
        options={"HIDDEN", "SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return _poll_run(cls, context)

    @classmethod
    def description(cls, _context: bpy.types.Context, options: Any) -> str:
        if options.restart:
            return "Fill the surface again from the seed, and replace this curve"
        return (
            "Grow a curve on the active mesh until it fills the surface at the spacing. "
            "On a curve made so before, go on from there"
        )

    # -- without a window: blocking --------------------------------------------------------------

    def execute(self, context: bpy.types.Context) -> set[str]:
        if not self._begin(context):
            return {"CANCELLED"}
        self._session.stepper.run()
        return self._finish(context, keep=True)

    # -- in a window: a background run and a timer ----------------------------------------------

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if not self._begin(context):
            return {"CANCELLED"}
        self._session.start(context)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if self._session.ended:  # by unregister or a new file
            return {"CANCELLED"}
        if event.value == "PRESS":
            if event.type in {"ESC", "RIGHTMOUSE"}:
                return self._finish(context, keep=False)
            if event.type in {"RET", "NUMPAD_ENTER"}:
                self._session.stop_wanted = True
                return {"RUNNING_MODAL"}
            if event.type == "Z" and (event.ctrl or event.oskey):
                # Undo would take the curve away from under the run; it waits until the end.
                return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            going = self._session.tick(context)
        except DataError as error:
            self.report({"ERROR"}, _sentence(error))
            return self._finish(context, keep=False)
        except BaseException:
            # A defect of ours must not leave a timer and a run behind.
            self._finish(context, keep=False)
            raise
        if not going:
            return self._finish(context, keep=True)
        return {"PASS_THROUGH"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Called by Blender when it closes the window or the file under a run."""
        self._finish(context, keep=False)

    # -- both ----------------------------------------------------------------------------------

    def _begin(self, context: bpy.types.Context) -> bool:
        try:
            self._session = session.Session(plan_run(context, self.restart))
        except (DataError, core.MeanderError) as error:
            self.report({"ERROR"}, _sentence(error))
            return False
        return True

    def _finish(self, context: bpy.types.Context, keep: bool) -> set[str]:
        """Every exit of the operator comes through here."""
        try:
            if keep:
                result, figures = self._session.keep(context)
                done = self._session.preparation_text()
                self.report(
                    {"INFO"}, f"{result.name}: {_summary(figures)}" + (f"; {done}" if done else "")
                )
                if figures["empty_components"]:
                    self.report({"WARNING"}, strands.empty_parts(figures["empty_components"]))
                return {"FINISHED"}
        except (DataError, core.MeanderError) as error:
            self.report({"ERROR"}, _sentence(error))
            self._session.remember_problem(context, error)
        finally:
            self._session.end()
        return {"CANCELLED"}


class MEANDER_OT_stop(bpy.types.Operator):
    """Stop growing and keep the curve as it is now"""

    bl_idname = "meander.stop"
    bl_label = "Stop"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        if session.current() is None:
            cls.poll_message_set("No curve is growing")
            return False
        return True

    def execute(self, _context: bpy.types.Context) -> set[str]:
        session.current().stop_wanted = True
        return {"FINISHED"}


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
            self.report({"ERROR"}, _sentence(error))
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


def _menu(self: bpy.types.Menu, _context: bpy.types.Context) -> None:
    self.layout.separator()
    self.layout.operator_context = "INVOKE_DEFAULT"
    self.layout.operator(MEANDER_OT_run.bl_idname, icon="MOD_CURVE")


_CLASSES = (MEANDER_OT_run, MEANDER_OT_stop, MEANDER_OT_propose_spacing, MEANDER_OT_show_gaps)


def register() -> None:
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.VIEW3D_MT_object.append(_menu)


def unregister() -> None:
    bpy.types.VIEW3D_MT_object.remove(_menu)
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
