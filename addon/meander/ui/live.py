# SPDX-License-Identifier: GPL-3.0-or-later
"""Live after a run: a timer looks whether settings or paint have changed, and lets the curve go on.

The same timer advances a live run while a brush is held, when Blender hands a modal operator no
events; such a run ends when the brush has been let go.
"""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import replace

import bpy

from .. import core
from ..run import estimate, live, one_step, session
from ..run.lasting import Memory
from ..run.meaning import Meaning, meaning_of
from ..run.plan import Plan, plan_of
from ..scene.errors import DataError
from ..scene.identity import number_of
from ..scene.linked_settings import settings_of
from ..scene.results import last_result
from ..scene.settings import surface_of
from . import following
from .fill import Fills, MEANDER_OT_run, fits
from .registered import registration
from .watched import Watched

# Of the timer, in seconds, while a curve grows and while none does.
_GROWING, WAITING = 0.07, 0.15
# A run whose operator has not been heard of for so long, in seconds, is advanced by the timer.
_SILENCE = 0.15

# For every window, by its address: the object that was active when Live looked last, and what a run
# on it would have meant. What was undone is not to be done again.
_looked_at: Memory[int, tuple[int, Meaning]] = Memory(undone=True)


class MEANDER_OT_live(Fills, Watched, bpy.types.Operator):
    """Let the curve of a surface take what its settings ask for now"""

    bl_idname = "meander.live"
    bl_label = "Live"
    bl_options = {"INTERNAL", "UNDO"}
    _invoked = True  # by a timer: an error would be raised there, and end it

    def _finish(self, context: bpy.types.Context, keep: bool) -> set[str]:
        plan = self._session.plan
        outcome = super()._finish(context, keep)
        result = plan.result.find() if plan.result is not None else None
        if outcome == {"FINISHED"} and result is not None:
            one_step.note_change(result)
        return outcome

    def _make_again(self, _context: bpy.types.Context, result: bpy.types.Object) -> str:
        following.order(result)
        return ""

    def execute(self, context: bpy.types.Context) -> set[str]:
        if not self._begin(context):
            return {"CANCELLED"}
        self._session.run()
        return self._finish(context, keep=True)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        return self._watch(context) if self._begin(context) else {"CANCELLED"}

    def _continued(self, context: bpy.types.Context, active: bpy.types.Object) -> Plan:
        """A run from the points of the result of the active object, with that one's settings.

        Raises DataError for what makes a curve very large that is not.
        """
        depsgraph = context.evaluated_depsgraph_get()
        result = last_result(active, context.scene) or active
        plan = plan_of(result, context.scene, depsgraph)
        wish = live.wish_of(active, plan, plan.problem.density, depsgraph)
        plan = replace(plan, from_surface=True)  # which leaves alone what is active
        plan = wish.applied(plan) if wish is not None else plan
        points = result.meander.figures.whole_points
        if not fits(plan) and estimate.of_plan(plan).points > 2 * points:
            raise DataError(session.VERY_LARGE)
        return plan

    def _begin(self, context: bpy.types.Context) -> bool:
        """Whether something else is asked for than the curve is; the session then takes it."""
        active = context.view_layer.objects.active
        try:
            run = live.taken(active, context.evaluated_depsgraph_get())
            if run is None:
                # As after a file has been opened: the curve goes on from its points.
                self._session = self._new_session(self._continued(context, active))
                self._session.whole = False
                return True
        except (DataError, core.MeanderError) as error:
            self._refuse(active, error)
            return False
        self._session = self._new_session(run.plan, run)
        if self._session.find_wish(context, active):
            return True
        if self._session.refusal:
            self._refuse(active, self._session.refusal)
        live.keep(run)
        return False


def tick() -> float:
    """Called by a timer, as often as it asks for."""
    running = session.current()
    windows = bpy.context.window_manager.windows
    if running is None:
        _look_at(windows)
        return WAITING
    _looked_at.clear()
    if running.live and time.perf_counter() - running.ticked > _SILENCE and len(windows):
        with bpy.context.temp_override(window=_window_of(running, windows)):
            try:
                running.tick(bpy.context)
            except DataError:  # which the operator will find and report
                pass
    return _GROWING


def _window_of(
    running: session.Session, windows: Iterable[bpy.types.Window]
) -> bpy.types.Window:
    """A window that shows the scene of a run; where none does, the first one."""
    every = list(windows)
    home = running.plan.home.find(running.plan.surface.find())
    return next((one for one in every if home and one.scene == home[0]), every[0])


def _look_at(windows: Iterable[bpy.types.Window]) -> None:
    """Lets the curve of the active object of a window go on when something has changed since the
    last look. Lets go of a finished run where what is active can be filled, but is live in no
    window.
    """
    found = set()
    for window in windows:
        with bpy.context.temp_override(window=window):
            active = bpy.context.view_layer.objects.active
            if surface_of(active) is None or bpy.context.mode == "EDIT_MESH":
                _looked_at.pop(window.as_pointer(), None)
                continue
            found.add(settings_of(active).live)
            if not settings_of(active).live:
                _looked_at.pop(window.as_pointer(), None)
            elif _has_changed(window, active) and MEANDER_OT_run.poll(bpy.context):
                _press()
                return
    if found == {False}:
        live.finished.end()


def _has_changed(window: bpy.types.Window, active: bpy.types.Object) -> bool:
    """Whether what a run on the object would mean is another than at the last look."""
    now = meaning_of(active)
    before = _looked_at.get(window.as_pointer())
    _looked_at[window.as_pointer()] = (number_of(active), now)
    if before is None or before[0] != number_of(active) or not live.differs(before[1], now):
        return False
    # Where nothing has been filled yet, there is no curve to go on.
    return active.type != "MESH" or last_result(active, bpy.context.scene) is not None


def _press() -> None:
    window = bpy.context.window
    area = next((area for area in window.screen.areas if area.type == "VIEW_3D"), None)
    if area is None:
        return
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        bpy.ops.meander.live("INVOKE_DEFAULT")


register, unregister = registration(MEANDER_OT_live)
