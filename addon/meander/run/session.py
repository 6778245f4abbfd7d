# SPDX-License-Identifier: GPL-3.0-or-later
"""One run as Blender sees it: begun, shown while it grows, kept or taken back.

A session keeps keys and arrays, never references to Blender's data: those die with undo, with
deletion and with a new file. Until keep() it changes nothing that an undo step or a file could
hold.
"""

from __future__ import annotations

import time
from typing import Any

import bpy
from bpy.app.handlers import persistent

from .. import core
from ..model import bridges, strands
from ..model.remaining import Remaining, in_words, told
from ..scene.errors import DataError
from ..scene.lengths import length_text
from ..scene.meshes import in_polygons
from ..scene.results import is_present
from . import edit_mode, estimates, refused_mesh, seed_preview, suspended
from .meaning import meaning_of
from .plan import Plan
from .preview import Preview
from .result import preparation_text, write_result
from .stepper import Snapshot, Stepper
from .suspended import SuspendedRun
from .window import Window

# A copy of the curve that may have waited for longer than this, in seconds, since it was made, is
# not worth showing: the next one is an iteration away.
STALE = 0.25


class Session:
    """A run from its plan to its end.

    In a window: start(), then tick() at every timer event while it returns True, then keep() or
    not. Without: stepper.run(), then keep(). In any case, and last: end().
    """

    def __init__(self, plan: Plan, suspended_run: SuspendedRun | None = None) -> None:
        """plan            what to do
        suspended_run   the run of this plan that goes on; None: it begins
        """
        if suspended_run is None:
            self.plan, self.stepper = plan, Stepper(plan.problem)
            self.latest: Snapshot | None = None
            self._meaning = meaning_of(plan.settings.find())
        else:
            self.plan, self.stepper = suspended_run.plan, suspended_run.stepper
            self.latest = suspended_run.latest
            self._meaning = suspended_run.meaning
        seed_preview.hide()
        suspended.drop()  # a run that begins takes the place of the one before it
        self._remaining = Remaining()
        self._shown = True  # whether the view has what is in `latest`
        self._polled = 0.0  # when a copy of the curve was last asked for
        self._skipped = False  # whether a tick has passed since
        self._stale = False  # whether `latest` was old when it was taken
        self.stop_wanted = False
        self.place = ""  # among several, such as "2 of 5"
        self.ended = False
        self._window: Window | None = None
        self._preview: Preview | None = None

    def start(self, context: bpy.types.Context) -> None:
        """Begins the run, which goes on by itself, with a timer for tick()."""
        global _current
        _current = self
        self._preview = Preview(self.plan, context.scene)
        self._window = Window(context)
        self.stepper.start()
        self._polled = time.perf_counter()

    def tick(self, context: bpy.types.Context) -> bool:
        """Shows how far the run is. False when it has come to its end.

        Raises DataError when the surface or the result has been deleted meanwhile.
        """
        self._check_alive()
        if self.stop_wanted:
            self.stepper.cancel()
        self._preview.keep_result_out()
        picture_due = self._window.picture_due()
        text_due = self._window.text_due(picture_due)
        # The run stands still while it makes a copy, so none is asked for in vain.
        if picture_due or text_due:
            self._take_copy()
        else:
            self._skipped = True
        if picture_due and not (self._shown or self._stale or self.stepper.finished):
            self._preview.show(self.latest.polylines)
            self._shown = True
            self._window.picture_given()
        if text_due:
            self._window.show(context, self.progress_text(), self.progress())
        return not self.stepper.finished

    def _take_copy(self) -> None:
        """Takes the newest copy of the curve if there is one, and has the run make another."""
        snapshot = self.stepper.poll()
        before, self._polled = self._polled, time.perf_counter()
        if snapshot is not None:
            self.latest = snapshot
            self._remaining.note(self._polled, snapshot.progress)
            self._shown = False
            # It was made after the last copy was taken, perhaps right after.
            self._stale = self._skipped and self._polled - before > STALE
        self._skipped = False

    def progress(self) -> float:
        """How much of the run is done, in [0, 1]: about the share of its time."""
        return self.latest.progress if self.latest is not None else 0.0

    def progress_text(self) -> str:
        """What the run is about and how long it will still take, in words."""
        return self._placed(told(self._phase(), self._remaining.seconds()))

    def phase_text(self) -> str:
        """What the run is about, such as "Growing"."""
        return self._placed(told(self._phase(), None))

    def _placed(self, text: str) -> str:
        return f"{self.place}: {text}" if self.place else text

    def left_text(self) -> str:
        """How long it will still take, such as "12 s"; empty while that is not known."""
        seconds = self._remaining.seconds()
        return in_words(seconds) if seconds is not None else ""

    def _phase(self) -> str:
        return self.latest.phase if self.latest is not None else "none"

    @property
    def shown_points(self) -> int:
        """How many points the curve has that the views show."""
        return self._preview.point_count if self._preview is not None else 0

    def preparation_text(self) -> str:
        """What was done to the mesh, in words; empty if nothing was."""
        return preparation_text(self.plan, self.stepper)

    def keep(self, context: bpy.types.Context) -> tuple[bpy.types.Object, dict[str, Any]]:
        """Waits for the end of the run and makes what has grown the result.

        Returns the curve object and the figures of the run. Raises what went wrong in the run.
        """
        try:
            outcome = self.stepper.result()
        except core.MeanderError as error:
            self._check_alive()
            refused_mesh.explain(self.plan, error)
            named = in_polygons(error, self.plan.surface.find(), context.evaluated_depsgraph_get())
            raise strands.explained(
                named, self.plan.parts, lambda value: length_text(context.scene, value)
            ) from error
        self._check_alive()
        if self._preview is not None:
            self._preview.end()
        with edit_mode.left(context):
            result = write_result(context, self.plan, self.stepper, outcome)
        _snapshot, figures, stop_reason = outcome
        if stop_reason == "converged" and self.plan.from_surface:
            options = self.plan.problem.options
            estimates.speeds.learn(options, figures["nodes"], figures["seconds_total"])
        return result, figures

    def remarks(
        self, context: bpy.types.Context, result: bpy.types.Object, figures: dict[str, Any]
    ) -> tuple[str, str]:
        """What to add to the summary about the seed and bridges, and what to warn of; empty if
        nothing.

        result, figures   of keep()
        """
        plan = self.plan
        radius = plan.problem.options.radius
        remark = strands.fit_remark(
            figures, plan.parts, radius, lambda value: length_text(context.scene, value)
        )
        joined = result.meander.figures
        if joined.bridge_count:
            length = length_text(context.scene, joined.bridge_length)
            remark = "; ".join(
                filter(None, (remark, bridges.described(joined.bridge_count, length)))
            )
        return remark, strands.fit_warning(figures, plan.parts)

    def suspend(self) -> None:
        """Ends the run without a result, and keeps it so that it can go on later."""
        self.end()
        if self.stepper.resumable and self._meaning is not None:
            suspended.keep(SuspendedRun(self.plan, self.stepper, self.latest, self._meaning))

    def end(self) -> None:
        """Ends the run and gives back what it borrowed. May be called at any time, and again."""
        global _current
        if self.ended:
            return
        self.ended = True
        if _current is self:
            _current = None
        self.stepper.cancel()
        self.stepper.join()
        if self._window is not None:
            self._window.give_back()
        if self._preview is not None:
            self._preview.end()

    def _check_alive(self) -> None:
        if self.plan.surface.find() is None:
            raise DataError("The surface was deleted while the curve was growing; start again")
        # A surface that is filled again gets a new curve where the last one is gone.
        if not self.plan.from_surface and not is_present(self.plan.result.find()):
            raise DataError("The curve was deleted while it was growing; start again")


# The running session. There is one at most: it owns the status bar and the Esc key.
_current: Session | None = None


def current() -> Session | None:
    """The running session, or None."""
    return _current


def end_current() -> None:
    """Ends the running session, if there is one."""
    if _current is not None:
        _current.end()


@persistent
def _before_load(*_arguments: object) -> None:
    end_current()


def register() -> None:
    bpy.app.handlers.load_pre.append(_before_load)


def unregister() -> None:
    end_current()
    bpy.app.handlers.load_pre.remove(_before_load)
