# SPDX-License-Identifier: GPL-3.0-or-later
"""The buttons that grow a curve, alike in panel and menu; what a large run asks.

In a window a run is watched; execute() is the same run without a window, for scripts and for
Blender in the background.
"""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty, StringProperty

from .. import core
from ..model.estimate import described, hanging_in_words
from ..run import estimate as estimates
from ..run import session, suspended
from ..run.edit_mode import push_undo
from ..run.lasting import why_busy
from ..run.plan import Plan, plan_run
from ..run.queue import Queue
from ..scene.blender_versions import ask
from ..scene.errors import DataError
from ..scene.fillable import is_result, why_not
from ..scene.linked_settings import settings_of
from ..scene.results import last_result
from ..scene.seeds import mesh_of_seed
from ..scene.settings import surface_of
from .on_result import LINKED, is_linked
from .preferences import is_large
from .reasons import Reasoned, Reasons
from .registered import registration
from .watched import Watched

# Weight painting uses the same undo as Object Mode, and is where densities come from. Undo in the
# sculpt modes knows nothing of new objects; for that of Edit Mode there is run.edit_mode.
_MODES = ("OBJECT", "EDIT_MESH", "PAINT_WEIGHT", "PAINT_VERTEX")


class Fills(Reasoned):
    """An operator that begins a run."""

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        active = context.active_object
        yield why_busy()
        if context.mode not in _MODES:
            yield "Works in Object Mode, in Edit Mode of a mesh and in Weight Paint"
        if surface_of(active) is None and seeded_mesh(context) is None:
            yield why_not(active)
        if is_result(active) and is_linked(active):
            yield LINKED


def seeded_mesh(context: bpy.types.Context) -> bpy.types.Object | None:
    """The mesh of which the active curve is the seed: that is what its Fill fills."""
    return mesh_of_seed(context.active_object, context.scene)


def fits(plan: Plan) -> bool:
    """Whether a run is small enough to begin without a question."""
    try:
        return not is_large(estimates.of_plan(plan))
    except core.MeanderError:  # which the run will report
        return True


class MEANDER_OT_run(Fills, Watched, bpy.types.Operator):
    """Grow a curve on the active mesh until it fills the surface at the spacing"""

    bl_idname = "meander.run"
    bl_label = "Fill with Curve"
    bl_options = {"REGISTER", "UNDO"}

    _queue: Queue

    restart: BoolProperty(
        name="Fill Again",
        description="Start from the seed again instead of going on from the curve",
        default=False,
        options={"HIDDEN", "SKIP_SAVE"},
    )
    beside: BoolProperty(
        name="New Curve",
        description="Make another curve on the mesh, instead of updating one",
        default=False,
        options={"HIDDEN", "SKIP_SAVE"},
    )
    go_on: BoolProperty(
        name="Continue",
        description="Go on from the curve of the active mesh, instead of filling that again",
        default=False,
        options={"HIDDEN", "SKIP_SAVE"},
    )
    asked: BoolProperty(
        name="Asked",
        description="Begin without asking, however large the run is",
        default=False,
        options={"HIDDEN", "SKIP_SAVE"},
    )

    @classmethod
    def description(cls, context: bpy.types.Context, options: Any) -> str:
        active = context.active_object
        if options.beside:
            return "Fill the mesh with another curve; leaves the curves that it has as they are"
        again = last_result(active, context.scene) is not None and not options.go_on
        if options.restart or again:
            return (
                "Fill the surface from its seed again; keeps the looks, materials and modifiers "
                "of the curve, and replaces its line"
            )
        if is_result(active) or options.go_on:
            return (
                "Go on from this line until it fits the settings; keeps its strands and, as far "
                "as may be, its turns, and all its looks"
            )
        return (
            "Grow a curve on the active mesh until it fills the surface at the spacing, then on "
            "the others that are selected. In Edit Mode it fills the selected faces"
        )

    def execute(self, context: bpy.types.Context) -> set[str]:
        repeated = self.options.is_repeat or self.options.is_repeat_last
        if repeated and not bpy.app.background and context.window is not None:
            # Repeat Last and the like execute. What Blender repeats stays in its list, so it cannot
            # be modal itself; it begins another one.
            bpy.ops.meander.run("INVOKE_DEFAULT", **self._what())
            return {"CANCELLED"}
        self._take_up(context)
        self._queue, filled = Queue(context, self.restart, self.beside), False
        while (plan := self._planned(context)) is not None:
            if filled:
                push_undo()
            self._session = self._new_session(plan)
            self._session.run()
            filled = self._finish(context, keep=True) == {"FINISHED"} or filled
        return {"FINISHED"} if filled else {"CANCELLED"}

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        self._invoked = True
        self._take_up(context)
        self._queue = Queue(context, self.restart, self.beside)
        plan = self._planned(context)
        if plan is None or not self.asked and self._asks(context, plan):
            return {"CANCELLED"}
        self._session = self._new_session(plan)
        self._session.place = self._queue.place
        return self._watch(context)

    def _what(self) -> dict[str, bool]:
        return {"restart": self.restart, "beside": self.beside}

    def _take_up(self, context: bpy.types.Context) -> None:
        """Makes active what is meant: the mesh of a seed, or the curve of a mesh to go on with."""
        objects, mesh = context.view_layer.objects, seeded_mesh(context)
        if mesh is not None and objects.get(mesh.name) == mesh:
            for other in list(context.selected_objects):
                other.select_set(False)
            objects.active = mesh
            if mesh.visible_get():
                mesh.select_set(True)
        result = last_result(context.active_object, context.scene)
        if self.go_on and result is not None and objects.get(result.name) == result:
            objects.active = result

    def _go_on(self, context: bpy.types.Context, outcome: set[str]) -> set[str]:
        """Begins with the next object. Each that is filled has an undo step of its own."""
        if self._queue.more and outcome == {"FINISHED"}:
            push_undo()
        plan = self._planned(context)
        if plan is None:
            return outcome
        self._session = self._new_session(plan)
        self._session.place = self._queue.place
        self._session.start(context)
        return {"RUNNING_MODAL"}

    def _planned(self, context: bpy.types.Context) -> Plan | None:
        """The plan of the next object that has one; what keeps others from it is reported."""
        while self._queue.more:
            try:
                plan = self._queue.next_plan(context)
            except (DataError, core.MeanderError) as error:
                self._refuse(self._queue.taken.find(), error)
                continue
            if plan is not None:
                return plan
        return None

    def _asks(self, context: bpy.types.Context, plan: Plan) -> bool:
        """Whether there is so much to fill that the user is asked; he begins it, or does not."""
        estimate = self._queue.estimate_of_rest(context, plan)
        if estimate is None or not is_large(estimate):  # else its run will report why
            return False
        bpy.ops.meander.ask_run(
            "INVOKE_DEFAULT",
            **self._what(),
            figures=described(estimate),
            notice=hanging_in_words(estimate.points, plan.look.radius > 0.0),
        )
        return True


def draw_question(layout: bpy.types.UILayout, figures: str, notice: str = "") -> None:
    """What a question before a large run says, above its buttons.

    notice   lines that speak against it; empty: nothing does
    """
    column = layout.column()
    column.label(text=f"About {figures}", icon="QUESTION")
    column.label(text="A wider spacing needs less", icon="BLANK1")
    for line in notice.splitlines():
        column.label(text=line, icon="BLANK1")


class MEANDER_OT_ask_run(bpy.types.Operator):
    """Begin a run that is larger than the preferences allow without asking"""

    bl_idname = "meander.ask_run"
    bl_label = "Fill with a Large Curve?"
    bl_options = {"INTERNAL"}

    restart: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    beside: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    figures: StringProperty(options={"HIDDEN", "SKIP_SAVE"})
    notice: StringProperty(options={"HIDDEN", "SKIP_SAVE"})

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        return ask(context.window_manager, self, 340, "Fill")

    def draw(self, _context: bpy.types.Context) -> None:
        draw_question(self.layout, self.figures, self.notice)

    def execute(self, _context: bpy.types.Context) -> set[str]:
        bpy.ops.meander.run("INVOKE_DEFAULT", restart=self.restart, beside=self.beside, asked=True)
        return {"FINISHED"}


class MEANDER_OT_resume(Fills, Watched, bpy.types.Operator):
    """Let the run that was ended last go on from where it was"""

    bl_idname = "meander.resume"
    bl_label = "Continue"
    bl_description = (
        "Let the run that was ended last go on from where it was; keeps all that has grown in it, "
        "and the curve from before until it ends"
    )
    bl_options = {"UNDO"}

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        yield from super().reasons(context)
        if suspended.run_of(context.active_object) is None:
            yield "No run on this object was ended before its time"

    def execute(self, context: bpy.types.Context) -> set[str]:
        if not self._begin(context):
            return {"CANCELLED"}
        self._session.stepper.run()
        return self._finish(context, keep=True)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        self._invoked = True
        return self._watch(context) if self._begin(context) else {"CANCELLED"}

    def _begin(self, context: bpy.types.Context) -> bool:
        try:
            plan = plan_run(context)
            run = suspended.taken(plan)
            if run is None:
                raise DataError("The surface has changed since; fill it again")
        except (DataError, core.MeanderError) as error:
            self._refuse(context.active_object, error)
            return False
        self._session = self._new_session(run.plan, run)
        return True


class MEANDER_OT_stop(Reasoned, bpy.types.Operator):
    """Stop growing and keep the curve as it is now"""

    bl_idname = "meander.stop"
    bl_label = "Stop Filling"
    bl_options = {"INTERNAL"}

    @classmethod
    def reasons(cls, _context: bpy.types.Context) -> Reasons:
        if session.current() is None:
            yield "No curve is growing"

    def execute(self, _context: bpy.types.Context) -> set[str]:
        session.current().stop_wanted = True
        return {"FINISHED"}


def _add_menu(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    if context.mode == "OBJECT":  # in Edit Mode the menu adds to the curve
        self.layout.separator()
        self.layout.operator_context = "INVOKE_DEFAULT"
        self.layout.operator(
            MEANDER_OT_run.bl_idname, text="Fill with Curve (Meander)", icon="MOD_CURVE"
        )


register, unregister = registration(
    MEANDER_OT_run,
    MEANDER_OT_ask_run,
    MEANDER_OT_resume,
    MEANDER_OT_stop,
    menus={"VIEW3D_MT_curve_add": _add_menu},
)


def draw_fill_buttons(
    layout: bpy.types.UILayout, context: bpy.types.Context, in_menu: bool = False
) -> None:
    """Fill with Curve, or what goes on with the curve that is there."""
    active = seeded_mesh(context) or context.active_object
    run = MEANDER_OT_run.bl_idname
    if active is None or surface_of(active) is None:
        layout.operator(run, icon="PLAY")
        return
    kept = suspended.run_of(active)
    if kept is not None:
        # What has its whole length is still being made even.
        text = f"Continue at {min(100.0 * kept.progress, 99.0):.0f} %"
        layout.operator(MEANDER_OT_resume.bl_idname, text=text, icon="PLAY")
    if not is_result(active) and last_result(active, context.scene) is None:
        _draw_varied(layout, active, in_menu).operator(run, icon="PLAY")
        return
    row = layout if in_menu else layout.row(align=True)
    if kept is None and (is_result(active) or context.mode == "OBJECT"):
        button = row.operator(run, text="Continue", icon="PLAY")
        if not is_result(active):
            button.go_on = True
    again = row.operator(run, text="Fill Again", icon="FILE_REFRESH")
    if is_result(active):
        again.restart = True
    new = _draw_varied(layout, active, in_menu)
    new.operator(run, text="New Curve", icon="ADD").beside = True


def _draw_varied(
    layout: bpy.types.UILayout, active: bpy.types.Object, in_menu: bool
) -> bpy.types.UILayout:
    """Room for a button, with the number of the variation and the popup of others after it."""
    if in_menu:  # which has the popup among the rest
        return layout
    split = layout.split(factor=0.66, align=True)
    button, row = split.row(align=True), split.row(align=True)
    row.prop(settings_of(active), "variation", text="")
    row.operator("meander.show_variations", text="", icon="MESH_GRID")
    return button
