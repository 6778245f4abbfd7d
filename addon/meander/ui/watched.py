# SPDX-License-Identifier: GPL-3.0-or-later
"""A run that is watched in a window, from its first timer event to what is said of its result.

In a window, filling is modal: the native library runs on a thread of its own, where no Python is,
and a timer shows how the curve grows.
"""

from __future__ import annotations

import bpy

from .. import core
from ..model import last_run, strands
from ..model.empty import Empty, narrow_remark, percent, remark
from ..run import notes, session
from ..run.plan import Plan
from ..run.result import preparation_text
from ..run.session_remarks import remarks
from ..run.suspended import SuspendedRun
from ..scene.errors import DataError
from . import following
from .preferences import is_large
from .refusing import sentence_of


def over_view(context: bpy.types.Context, event: bpy.types.Event) -> bool:
    """Whether the mouse is over a 3D view; the context of a modal operator is where it began."""
    return any(
        area.type == "VIEW_3D"
        and 0 <= event.mouse_x - area.x < area.width
        and 0 <= event.mouse_y - area.y < area.height
        for area in context.window.screen.areas
    )


class Watched:
    """A run in a window: a background run, and a timer that shows it.

    Enter and Esc are taken over a 3D view only. Everything else goes on to whoever it is meant for,
    undo too: the run follows its objects, and changes no data until its end.
    """

    # None before and after a run: Blender keeps operators that have run, and would keep the flow of
    # the last one with them.
    _session: session.Session | None = None
    _invoked = False  # by somebody at a window, and not by a script

    def _refuse(self, thing: bpy.types.Object | None, error: Exception | str) -> None:
        """Says what is wrong: at a window in the panel and in the status bar, as what pops up for
        an error lies under the cursor, over the button; to scripts as an error.
        """
        if self._invoked:
            notes.keep(thing, sentence_of(error))
        self.report({"WARNING" if self._invoked else "ERROR"}, sentence_of(error))

    def _new_session(self, plan: Plan, run: SuspendedRun | None = None) -> session.Session:
        """A session that asks nobody whether a wish may be large: it refuses those that are."""
        notes.clear(plan.settings.find())
        created = session.Session(plan, run)
        created.is_large = is_large
        return created

    def _watch(self, context: bpy.types.Context) -> set[str]:
        self._session.start(context)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if self._session.ended:  # by unregister or a new file
            return {"CANCELLED"}
        if event.value == "PRESS" and over_view(context, event):
            if event.type == "ESC":
                return self._finish(context, keep=False)
            if event.type in {"RET", "NUMPAD_ENTER"}:
                self._session.stop_wanted = True
                return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            going = self._session.tick(context)
        except DataError as error:
            self._refuse(self._session.plan.settings.find(), error)
            return self._go_on(context, self._finish(context, keep=False))
        except BaseException:
            # A defect of ours must not leave a timer and a run behind.
            self._finish(context, keep=False)
            raise
        if self._session.refusal:
            self._refuse(self._session.refused.find(), self._session.refusal)
            self._session.refusal = ""
        if not going:
            return self._go_on(context, self._finish(context, keep=True))
        return {"PASS_THROUGH"}

    def _go_on(self, _context: bpy.types.Context, outcome: set[str]) -> set[str]:
        """What follows when a run has come to its end, which was this."""
        return outcome

    def cancel(self, context: bpy.types.Context) -> None:
        """Called by Blender when it closes the window or the file under a run."""
        if self._session is not None:
            self._finish(context, keep=False)

    def _finish(self, context: bpy.types.Context, keep: bool) -> set[str]:
        """Every end of a run comes through here."""
        try:
            if keep:
                result, figures = self._session.keep(context)
                remark, warning = remarks(self._session, context, result, figures)
                mended = preparation_text(self._session.plan, self._session.stepper)
                done = (_summary(result), mended, remark)
                self.report({"INFO"}, f"{result.name}: {'; '.join(filter(None, done))}")
                if warning:
                    self.report({"WARNING"}, warning)
                stale = self._make_again(context, result)
                if stale:
                    self.report({"WARNING"}, stale)
                empty = unfilled(result.meander.figures)
                if empty:
                    self.report({"WARNING"}, f"{result.name}: {empty}")
                if figures["empty_components"]:
                    self.report({"WARNING"}, strands.empty_parts(figures["empty_components"]))
                return {"FINISHED"}
            self._session.suspend()
        except (DataError, core.MeanderError) as error:
            self._refuse(self._session.plan.settings.find(), error)
        finally:
            self._session.end()
            self._session = None
        return {"CANCELLED"}

    def _make_again(self, context: bpy.types.Context, result: bpy.types.Object) -> str:
        """Lets what was made of the curve follow it. Returns what to warn of; empty if nothing."""
        plan = self._session.plan
        with plan.home.entered(context, plan.surface.find()) as home:
            return following.after_run(result, home)


def _summary(result: bpy.types.Object) -> str:
    figures = result.meander.figures
    line = last_run.lines(figures.lines, figures.closed_lines)
    line = line[:1].lower() + line[1:]
    gaps = last_run.gaps(figures.wide_gaps, figures.largest_gap)
    if Empty(figures.empty_share, figures.narrow_share).matters:
        gaps = f"{percent(figures.empty_share)} of the surface empty"
    return ", ".join(
        [
            line,
            f"{last_run.evenness(figures.evenness)} even",
            *([gaps] if gaps else []),  # what is even says nothing of where no curve is
            f"{figures.seconds:.1f} s",
        ]
    )


def unfilled(figures: bpy.types.PropertyGroup) -> str:
    """What to say of a run that claims to have ended by itself, and has not filled the surface;
    else nothing."""
    empty = Empty(figures.empty_share, figures.narrow_share)
    full = "choose Start: Full, or a smaller spacing"
    if figures.stop_reason in last_run.ENDED or figures.empty_parts:
        return ""  # which is said already
    helps = ("", full, full)
    return remark(empty, figures.stop_reason, helps) or narrow_remark(empty)
