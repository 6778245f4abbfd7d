# SPDX-License-Identifier: GPL-3.0-or-later
"""One run as Blender sees it: begun, shown while it grows, kept or taken back.

A session keeps keys and arrays, never references to Blender's data: those die with undo, with
deletion and with a new file. Until keep() it changes nothing that an undo step or a file could
hold.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import bpy

from .. import core
from ..model import strands
from ..model.estimate import Estimate, Remaining
from ..scene.errors import DataError
from ..scene.home_scene import Choice
from ..scene.identity import Key, number_of
from ..scene.lengths import length_text
from ..scene.linked_settings import settings_of
from ..scene.meshes import in_polygons
from . import edit_mode, estimate, live, one_step, seeds, suspended
from .lasting import Activity
from .meaning import meaning_of
from .outcome import Snapshot
from .plan import Plan, with_looks
from .preview import Preview
from .refusal import explain_refusal, refuse_deleted
from .result import write_result
from .rounding import tolerance_for
from .stepper import Stepper
from .suspended import SuspendedRun
from .told import Told
from .window import Window, leave_a_processor

# How often the settings are looked at for other wishes, in seconds, and what share of the time that
# may take: reading a density takes as long as the mesh is large.
LOOK_INTERVAL, LOOK_SHARE = 0.2, 0.2
# A copy of the curve that may have waited for longer than this, in seconds, since it was made, is
# not worth showing: the next one is an iteration away.
STALE = 0.25
# So long a full start is drawn, in seconds, as long as the run goes.
DRAWN_IN = 2.0
# Of a run that is to end with what there is, before it has begun.
NOTHING_YET = "Nothing has grown yet that could be kept; fill the mesh again, and let it grow first"
# Of what a run with Live on would not have begun by itself.
VERY_LARGE = "The curve would be very large; fill the mesh again for that"


class Session(Told):
    """A run from its plan to its end.

    In a window: start(), then tick() at every timer event while it returns True, then keep() or
    not. Without: run(), then keep(). In any case, and last: end().
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
        self.stepper.rounding = lambda: tolerance_for(self.plan)
        self._remaining = Remaining()
        self._shown = True  # whether the view has what is in `latest`
        # A curve that fills the surface from its start is drawn strand by strand, as with a pen:
        # whether it still is, and since when.
        self._drawing = suspended_run is None and plan.problem.options.start == core.Start.FULL
        self._drawn_since: float | None = None
        self._polled = 0.0  # when a copy of the curve was last asked for
        self._pictured: float | None = None  # when the last picture was given
        self._skipped = False  # whether a tick has passed since
        self._stale = False  # whether `latest` was old when it was taken
        self.stop_wanted = self._is_over = False
        self.place = ""  # among several, such as "2 of 5"
        self.ended = False
        # What was asked for while the run was going, until the flow has taken it; what the settings
        # of each object meant when they were looked at last; when they are looked at next.
        self._wish: live.Wish | None = None
        self._wished: Estimate | None = None  # what the run comes to with it
        self._seen = {number_of(plan.settings.find()): self._meaning}
        self._next_look = 0.0
        self.whole = suspended_run is None  # all of it was one run, to tell how long runs take
        self.is_large: Callable[[Estimate], bool] = lambda _run: False  # one to be asked about
        # Why the last wish was refused, a sentence, and whose it was, for whoever reports it.
        self.refusal, self.refused = "", plan.settings
        self._choice: Choice | None = None  # what was active and selected when it began
        self.ticked = 0.0  # when, by time.perf_counter()
        self._window: Window | None = None
        self._preview: Preview | None = None

    def start(self, context: bpy.types.Context) -> None:
        """Begins the run, which goes on by itself, with a timer for tick()."""
        self._take_the_place()
        running.begin(self)
        found = self.plan.home.find(self.plan.surface.find())
        self._choice = None if found is None else Choice(found[1])
        self._preview = Preview(self.plan, context.scene)
        self._window = Window(context)
        leave_a_processor(self.plan.problem.options)
        self.stepper.start()
        self._remaining = Remaining(self._expected())
        self._polled = time.perf_counter()

    def _expected(self) -> float | None:
        """The seconds that the run is thought to take; what goes on has the rest before it."""
        seconds, cost = estimate.expected(self.plan.settings.find()), self.stepper.cost
        if seconds is None and cost is not None:
            seconds = estimate.speeds.seconds(self.plan.problem.options, cost)
        elif seconds is None and not self.stepper.preparing:  # it goes on, with other wishes
            found = estimate.of_plan_or_none(self.plan)
            seconds = None if found is None else found.seconds
        left = self.stepper.costs * (1.0 - self.progress())
        return None if seconds is None else seconds * left

    def _prepare(self, context: bpy.types.Context) -> None:
        """Goes on with what is done before the run, and shows how far that is."""
        if self.stop_wanted:
            raise DataError(NOTHING_YET)
        self.stepper.prepare()
        if not self.stepper.preparing:
            self._remaining = Remaining(self._expected())
        elif self._window.text_due(self._window.picture_due(False)):
            self._window.show(context, self.progress_text(), self.bar())

    def _take_the_place(self) -> None:
        """A run that begins takes the place of the one before it, and of what is drawn."""
        seeds.hide()
        live.finished.end()
        suspended.kept.end()

    def tick(self, context: bpy.types.Context) -> bool:
        """Shows how far the run is. False when it has come to its end.

        Raises DataError when the surface or the result has been deleted meanwhile.
        """
        refuse_deleted(self.plan)
        self.ticked = time.perf_counter()
        if self.stepper.preparing:
            self._prepare(context)
            return True
        ended = self.stepper.finished  # where it ends meanwhile, the next tick looks for wishes
        if self.stop_wanted:
            self._wish = None
            self.stepper.cancel()
        else:
            self._take_wishes(context)
        self._preview.keep_result_out()
        behind = self.latest is not None and self.latest.kept > 0
        picture_due = self._window.picture_due(behind)
        text_due = self._window.text_due(picture_due)
        # The run stands still while it makes a copy, so none is asked for in vain. What shows how
        # the curve grew is for pictures.
        if picture_due or (text_due and not behind):
            self._take_copy()
        else:
            self._skipped = True
        seen = self._shown and not (self._drawing and self.latest is not None)
        if picture_due and not (seen or self._stale or self.stepper.finished):
            self._preview.show(self.latest.polylines, self._drawn_share())
            self._shown = True
            self._window.picture_given()
            self._pictured = self.ticked
        if text_due:
            self._window.show(context, self.progress_text(), self.bar())
        return self._wish is not None or not (ended and self.stepper.finished) or self._goes_on()

    def _goes_on(self) -> bool:
        """Whether a run that has ended is to go on, or what is told of it is being found."""
        if not self._is_over:
            self.stepper.join()
            self._is_over = self.stop_wanted or self.stepper.failed or not self.stepper.goes_on()
        # What is left of a picture has its corrections in it.
        if self._is_over or not self.plan.problem.tones:
            self._remaining = Remaining()
        if self._is_over:
            return self.stepper.finds()
        self.stepper.start()
        return True

    @property
    def live(self) -> bool:
        """Whether the run takes changes of live settings."""
        settings = self.plan.settings.find()
        return settings is not None and settings_of(settings).live

    def find_wish(self, context: bpy.types.Context, active: bpy.types.Object) -> bool:
        """Looks for what the settings of its surface or its result ask of the run besides.

        Returns whether there is something, which the run takes with its next tick.
        """
        begin = time.perf_counter()
        now = meaning_of(active)
        self._seen = {number_of(active): now}
        try:
            with self.plan.home.entered(context, self.plan.surface.find()) as home:
                depsgraph = home.evaluated_depsgraph_get()
                wish = live.wish_of(active, self.plan, self.stepper.density, depsgraph)
            self._wished = estimate.of_plan_or_none(wish.applied(self.plan)) if wish else None
            if self._grows_large():
                raise DataError(VERY_LARGE)
        except (DataError, core.MeanderError) as error:
            wish, self.refusal, self.refused = None, str(error), Key(active)
        self._meaning = now
        self._wish = wish
        end = time.perf_counter()
        self._next_look = end + max(LOOK_INTERVAL, (end - begin) / LOOK_SHARE)
        return wish is not None

    def _grows_large(self) -> bool:
        """Whether a wish makes a run large that was not: whoever began a large one, meant it."""
        if self._wished is None or not self.is_large(self._wished):
            return False
        now = estimate.of_plan_or_none(self.plan)
        return now is None or not self.is_large(now)

    def _take_wishes(self, context: bpy.types.Context) -> None:
        """Has the run take what was asked for meanwhile: it ends, changes, and goes on."""
        if self._wish is None and (
            self.stepper.finished or time.perf_counter() >= self._next_look
        ):
            active = self._asker(context)
            if active is not None and settings_of(active).live and not self.stepper.failed:
                now = meaning_of(active)
                before = self._seen.setdefault(number_of(active), now)
                if live.differs(before, now) and self.find_wish(context, active):
                    self.stepper.cancel()
        if self._wish is None or not self.stepper.finished:
            return
        wish, self._wish, self._is_over = self._wish, None, False
        self.stepper.join()
        if self.stepper.failed:
            return
        self._apply(wish)
        self._remaining = Remaining(self._wished.seconds if self._wished else None)
        self.stepper.start()

    def _apply(self, wish: live.Wish) -> None:
        """Between two runs of the stepper."""
        if self._window is not None:
            leave_a_processor(wish.options)
        try:
            self.stepper.revise(wish.options, wish.density)
        except core.MeanderError as error:
            self.refusal, self.refused = str(error), wish.asker
            return
        self.plan, self.whole = wish.applied(self.plan), False
        if (asker := wish.asker.find()) is not None:
            self.plan = with_looks(self.plan, settings_of(asker))

    def run(self) -> None:
        """The whole run, without a window; takes what find_wish() has found."""
        self._take_the_place()
        wish, self._wish = self._wish, None
        if wish is not None:
            self._apply(wish)
        self.stepper.run()

    def is_about(self, thing: bpy.types.Object | None) -> bool:
        """Whether the run is on this surface, or for this result."""
        result = self.plan.result.find() if self.plan.result is not None else None
        return thing is not None and thing in (self.plan.surface.find(), result)

    def _asker(self, context: bpy.types.Context) -> bpy.types.Object | None:
        """The object whose settings count: the active one, if it is part of this run."""
        active = context.view_layer.objects.active
        return active if self.is_about(active) else self.plan.settings.find()

    def _take_copy(self) -> None:
        """Takes the newest copy of the curve if there is one, and has the run make another."""
        snapshot = self.stepper.poll()
        before, self._polled = self._polled, time.perf_counter()
        for _ in range(self._too_many(snapshot)):
            snapshot = self.stepper.poll()
        if snapshot is not None:
            self.latest = snapshot
            self._remaining.note(self._polled, snapshot.progress)
            self._shown = False
            # It was made after the last copy was taken, perhaps right after.
            late = self._skipped and self._polled - before > STALE
            self._stale = late and snapshot.kept == 0
        self._skipped = False

    def _too_many(self, snapshot: Snapshot | None) -> int:
        """How many copies that show how the curve grew are to be left out, so that the others
        can be shown while the run goes on."""
        left = self._remaining.seconds()
        if snapshot is None or self._pictured is None or left is None:
            return 0
        interval = self._polled - self._pictured
        many = (snapshot.kept + 1) * interval / left - 1.0 if left > 0.0 else math.inf
        return int(min(max(many, 0.0), snapshot.kept))

    def _drawn_share(self) -> float:
        """The share of every strand that is to be seen by now."""
        if not self._drawing:
            return 1.0
        if self._drawn_since is None:
            self._drawn_since = self.ticked
        share = (self.ticked - self._drawn_since) / DRAWN_IN
        self._drawing = share < 1.0
        return min(share, 1.0)

    @property
    def shown_points(self) -> int:
        """How many points the curve has that the views show."""
        return self._preview.point_count if self._preview is not None else 0

    def keep(self, context: bpy.types.Context) -> tuple[bpy.types.Object, dict[str, Any]]:
        """Waits for the end of the run and makes what has grown the result, where its surface is.

        Returns the curve object and the figures of the run. Raises what went wrong in the run.
        """
        self.stepper.join()
        refuse_deleted(self.plan)
        with self.plan.home.entered(context, self.plan.surface.find()) as home:
            return self._keep(home)

    def _keep(self, context: bpy.types.Context) -> tuple[bpy.types.Object, dict[str, Any]]:
        try:
            outcome = self.stepper.result()
        except core.MeanderError as error:
            explain_refusal(self.plan, error)
            named = in_polygons(error, self.plan.surface.find(), context.evaluated_depsgraph_get())
            raise strands.explained(
                named, self.plan.parts, lambda value: length_text(context.scene, value)
            ) from error
        stiffening = self.stepper.stiffening
        if not stiffening.held and outcome[2] != "cancelled":  # who stops it takes what is there
            raise DataError(stiffening.refusal(lambda value: length_text(context.scene, value)))
        if self._preview is not None:
            self._preview.end()
        choice = self._choice
        undisturbed = choice is None or choice.is_still_made(context.view_layer)
        with edit_mode.left(context):
            source = self.plan.settings.find() or self.plan.surface.find()
            paint = one_step.paint_of(source, context)
            result = write_result(context, self.plan, self.stepper, outcome, undisturbed)
            one_step.note(result, paint)
        _snapshot, figures, stop_reason = outcome
        if result.meander.live:
            # The next one updates it, and leaves alone what is active then.
            problem = replace(self.plan.problem, options=self.stepper.problem.options)
            self.plan = replace(self.plan, problem=problem, result=Key(result), from_surface=True)
            live.keep(SuspendedRun(self.plan, self.stepper, self.latest, self._meaning))
        simple = self.plan.problem.is_plain and self.plan.problem.tones is None
        usual = self.plan.from_surface and self.whole and simple
        if stop_reason == "converged" and usual:
            options = self.plan.problem.options
            faces = len(self.plan.problem.faces)
            estimate.speeds.learn(options, figures["nodes"], figures["seconds_total"], faces)
        return result, figures

    def suspend(self) -> None:
        """Ends the run without a result, and keeps it so that it can go on later."""
        self.end()
        if self.stepper.resumable and self._meaning is not None:
            run = SuspendedRun(self.plan, self.stepper, self.latest, self._meaning)
            suspended.kept.begin(run)

    def end(self) -> None:
        """Ends the run and gives back what it borrowed. May be called at any time, and again."""
        if self.ended:
            return
        self.ended = True
        if running.current is self:
            running.taken()
        self.stepper.cancel()
        self.stepper.join()
        self.stepper.search.end()
        if self._window is not None:
            self._window.give_back()
        if self._preview is not None:
            self._preview.end()


running: Activity[Session] = Activity(Session.end, busy="A curve is growing already")


def current() -> Session | None:
    """The running session, or None."""
    return running.current
