# SPDX-License-Identifier: GPL-3.0-or-later
"""One run of the flow, blocking or watched while it grows. No bpy here, and no threads.

A watched run goes on a thread of the native library's, which knows nothing of Python: a Python
thread that computes while operators run makes Blender 3.4 crash now and then. Nobody but the run
may touch the flow until it has ended; what it shows meanwhile are copies, made only when asked for.
Both ways give the same curve to the last bit.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from .. import core
from ..model import bundle
from ..model.copies import Copies
from ..model.least_bend import Stiffening, sharpest_bend
from ..model.mirror import Half
from ..model.opening import Opened, opening
from ..model.picture.correction import COSTS, Correction
from ..model.problem import Problem
from ..model.steps import Background, Steps, at_once
from ..model.toolpaths.toolpath import strands_of
from ..model.whole import whole_of
from . import search
from .outcome import Line, Snapshot, of_whole
from .search import Search

# Of a mesh of so many faces what lasts before a run takes some hundredths of a second.
MANY_FACES = 20_000
# A watched run keeps its curve whenever that has grown by this share of what it is going to be, as
# long as those copies have no more points than this, which take 100 MB.
GROWTH_STEP, GROWTH_POINTS = 1.0 / 16.0, 2_000_000


class Stepper:
    """Runs one Problem.

    Watched: start(), prepare() and poll() until `finished`, then result(). Or run(), then result().
    cancel() may be called at any time; the curve of the last whole iteration stays available.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self._context = core.Context()
        self._flow: core.Flow | None = None
        # From start() until its end has been waited for, the flow belongs to the run.
        self._started = False
        self._error: Exception | None = None
        self._stop_reason = "running"
        self._opened: Problem | None = None  # with density and directions, once it is prepared
        # What is to be said of a run that a defect of the library has ended; its result is the
        # curve of the last iteration that ended well, as if it had been cancelled then.
        self.defect = ""
        self._preparation: Background | None = None  # of a watched run
        self._length = 0.0  # about what the curve is going to have
        # That it is expected to have, once that is known, as it was asked for when it began.
        self.cost: core.Cost | None = None
        self.density: np.ndarray | None = None  # per vertex, once the run has been prepared
        # Of the result, once there is one: what it leaves empty, unless it was cancelled, and which
        # strands are guides.
        self.gaps: core.Gaps | None = None
        self.guides: np.ndarray | None = None
        self.point_data: core.PointData | None = None  # of every point
        # Says how far from the curve it is drawn to be round, in spacings, for whoever wants that;
        # and of the result the drawn line with the data of its points, where that is not 0.
        self.rounding: Callable[[], float] = lambda: 0.0
        self.drawn: tuple[core.Polylines, core.PointData] | None = None
        # Of a problem of which a part is solved: what a whole is made of. Of its result: the strand
        # of the seed that each strand came from, and why they are several lines; else None and
        # empty.
        self._part: Half | Copies | None = None
        self.sources: np.ndarray | None = None
        self.lines_why = ""
        self.stiffening = Stiffening(problem.least_bend_radius)
        # Of a picture: what its line is corrected by, and the line before the last correction.
        self._correction = None if problem.tones is None else Correction(problem.tones)
        self._before: Line | None = None
        self.surface_figures: dict[str, Any] = {}  # of core.Surface.statistics(), once prepared
        # What finds what result() tells, once it has begun; how many nodes the last picture had.
        self.search = Search()
        self._nodes = 0
        # Of the library, while the run was going.
        self._progress, self._phase = 0.0, "none"

    def start(self) -> None:
        """Begins the run, which goes on by itself; on a large mesh what it needs before that, which
        prepare() goes on with.

        One that has been cancelled goes on from where it was, to the same curve as if it had never
        been. What goes wrong is for result() to raise: the run has then ended at once.
        """
        try:
            if self._flow is None and len(self.problem.faces) >= MANY_FACES:
                self._preparation = Background(self._opening(), self._context)
                self.prepare()
            else:
                self._begin()
                self._launch()
        except Exception as error:
            self._error = error

    def prepare(self, wait: bool = False) -> None:
        """Goes on with what lasts before a run, and begins it as soon as that is done.

        wait   until it is; else it never does
        """
        if self._preparation is None:
            return
        over = True
        try:
            over = self._preparation.go_on(wait)
            if over:
                self._take(self._preparation.done)
                self._launch()
        except Exception as error:
            self._error = error
        finally:
            if over:
                self._preparation = None

    @property
    def preparing(self) -> str:
        """What is done before the run, one of estimate.PHASE_TEXTS; empty: nothing any more."""
        if self._preparation is None:
            return ""
        return "mesh" if self.cost is None else "surface"

    @property
    def share(self) -> float | None:
        """How much is over of what is done before the run or after it; None: that is the run."""
        return self._context.progress if self.preparing else self.search.progress

    def run(self) -> None:
        """The whole run; returns when it has ended."""
        try:
            self._begin()
            self._stop_reason = self._flow.run(self._context)
            while self.goes_on():
                self._stop_reason = self._flow.run(self._context)
        except Exception as error:
            self._note(error)

    def _note(self, error: Exception) -> None:
        """Keeps what went wrong. A defect in the midst of a run leaves the curve before it, and a
        file for the report."""
        self._error = error
        if self._flow is None or not bundle.is_defect(error):
            return
        left = bundle.left_by(self._flow, self._opened, error)
        if left is not None and left[0] > 0:
            self._error, self._stop_reason = None, "cancelled"
            self.defect = f"{str(error).removesuffix('.')}, and add {left[1]} to the report"

    def _begin(self) -> None:
        self.search.end()
        if self._flow is None:
            self._take(at_once(self._opening()))
        else:
            self._context.reset()
            self._stop_reason = "running"

    def _opening(self) -> Steps[Opened]:
        return opening(self.problem, accept=self._note_cost)

    def _take(self, opened: Opened) -> None:
        self._flow, self._opened, self._part = opened.flow, opened.problem, opened.part
        self.density, self.surface_figures = opened.density, opened.figures

    def _launch(self) -> None:
        length = self._length if self._part is None else self._length / self._part.times
        self._flow.keep_growth(GROWTH_STEP * length, GROWTH_POINTS)
        self._flow.start(self._context)
        self._started = True

    def _note_cost(self, cost: core.Cost) -> None:
        self.cost, self._length = cost, cost.length if math.isfinite(cost.length) else 0.0

    @property
    def finished(self) -> bool:
        """Whether the run has ended, for whatever reason. While it is prepared it has not."""
        if self._started:
            return not self._flow.running
        return self._error is not None or self._stop_reason != "running"

    @property
    def resumable(self) -> bool:
        """Whether the run has been cancelled, and can be started again to go on."""
        cancelled = self._stop_reason == "cancelled" and not self.defect
        return not self._started and self._error is None and cancelled

    @property
    def costs(self) -> float:
        """What may have to be run in all, in times of the first run."""
        return 1.0 if self._correction is None else COSTS

    @property
    def tone_error(self) -> float | None:
        """How far the line is from the tones of a picture, at two mean spacings; None: it is of no
        picture, or was stopped."""
        if self._correction is None or self._stop_reason != "converged":
            return None
        error = self._correction.error
        return None if error is None else error.two

    def poll(self) -> Snapshot | None:
        """The oldest copy of growth that is left, else the newest copy, once; None while there is
        none. Never waits.

        The run makes the next one only when this one has been taken.
        """
        if not self._started:
            return None
        preview, progress = self._flow.preview(), self._context.progress
        before = self._progress
        if self._flow.running:  # at the end the library says 1, also of a run that was cancelled
            self._progress, self._phase = progress, self._context.phase
            if self._correction is not None:
                # What goes on says 0 until its first iteration.
                self._progress = max(before, self._correction.progress(progress))
                self._phase = "correction" if self._correction.made else self._phase
        if preview is None:
            return None
        if self._part is not None:
            preview = of_whole(preview, self._part)
        self._nodes = preview.nodes
        return self._snapshot(*preview)

    def revise(self, options: core.FlowOptions, density: np.ndarray | None) -> None:
        """Asks the flow for other options and another density; the run that follows takes them,
        and begins anew what goes on by itself.

        Between two runs only. Raises core.MeanderError where the library refuses either; the flow
        then has neither.
        """
        self._revise(options, density)
        self.stiffening.best = self._before = None
        tones = self.problem.tones
        self._correction, self._progress = None if tones is None else Correction(tones), 0.0

    def _revise(self, options: core.FlowOptions, density: np.ndarray | None) -> None:
        self.search.end()
        self.cost, before, taken, of_flow = None, self._opened.options, options, density
        if self._part is not None:
            taken = self._part.options_of(options)
            density, of_flow = self._part.density_of(density)
        self._flow.set_options(taken)
        try:
            self._flow.set_density(of_flow)
        except core.MeanderError:
            self._flow.set_options(before)
            raise
        self.density = density
        self.problem = self.problem.revised(options, density)
        self._opened = replace(self._opened, options=taken, density=of_flow)
        if self._part is not None:
            self._part = replace(self._part, density=density)

    def goes_on(self) -> bool:
        """Asks for more where a curve bends more sharply than it may, or has not the tones of its
        picture; False where there is no more to ask for.

        Between two runs only; the run that follows lets it go on.
        """
        return self._stiffened() or self._corrected()

    def _stiffened(self) -> bool:
        if not self.stiffening.least or self._flow is None or self._stop_reason == "cancelled":
            return False
        options = self.problem.options
        try:
            bend = sharpest_bend(self._flow.polylines(), options.radius)
            following = self.stiffening.following(bend, options)
            if following is not None:
                self._revise(following, self.density)
        except Exception as error:
            self._note(error)
            return False
        return following is not None

    def _corrected(self) -> bool:
        if self._correction is None or self._stop_reason != "converged":
            return False
        try:
            self._correction.measure(strands_of(self._flow.polylines()))
            density = self._correction.following()
            if density is not None:
                self._before = self._line_of(self._flow, self._flow.statistics())
                self._flow.set_density(density)
        except Exception as error:
            self._note(error)
            return False
        return density is not None

    @property
    def failed(self) -> bool:
        """Whether something went wrong, which result() raises."""
        return self._error is not None

    def cancel(self) -> None:
        """Asks the run to end after the present iteration at the latest; does not wait."""
        self._context.cancel()

    def join(self) -> None:
        """Waits for the end of the run. Does nothing when none is going."""
        self.prepare(wait=True)
        if not self._started:
            return
        self._started = False
        try:
            self._stop_reason = self._flow.wait()
        except Exception as error:
            self._note(error)

    def finds(self) -> bool:
        """Whether the library is finding what result() tells of a curve where that costs seconds;
        begins with it. Of what is laid on other parts result() finds it.

        After join() only. What goes wrong is for result() to raise.
        """
        lasts = search.lasts(self._nodes, len(self.problem.faces)) and self._flow is not None
        if not self.search.begun:
            if self.failed or not lasts or self._part is not None or self._before is not None:
                return False
            self._begin_search()
        return self.search.running

    def _begin_search(self) -> None:
        # One that was stopped by hand has gaps everywhere, and finding them all takes seconds.
        self.search.begin(self._flow, self._stop_reason != "cancelled", self.rounding())

    def result(self) -> tuple[Snapshot, dict[str, Any], str]:
        """Waits for the end: the last curve, the full statistics, and the reason of the stop.

        Raises what went wrong in the run. Costs some iterations, if finds() has not begun them.
        """
        self.join()
        if self._error is not None:
            raise self._error
        line = self._line()
        self.gaps, self.guides = line.gaps, line.guides
        self.point_data, self.drawn = line.point_data, line.drawn
        return line.outcome

    def _line(self) -> Line:
        if self._before is not None and not self._correction.nearest:
            return self._before
        if self._part is None:
            return self._searched_line()
        whole = whole_of(self._part, self._flow, self.problem.options)
        self.sources, self.lines_why = whole.sources, whole.why
        with whole.flow as flow:
            return self._line_of(flow, whole.figures)

    def _searched_line(self) -> Line:
        if not self.search.begun:
            self._begin_search()
        found = self.search.findings()
        outcome = self._outcome(found.polylines, found.statistics)
        return Line(outcome, found.gaps, found.guides, found.point_data, found.drawn)

    def _line_of(self, flow: core.Flow, statistics: dict[str, Any]) -> Line:
        rounding = self.rounding()
        return Line(
            self._outcome(flow.polylines(), statistics),
            None if self._stop_reason == "cancelled" else flow.gaps(),
            flow.guides(),
            flow.point_data(),
            flow.rounded(rounding) if rounding else None,
        )

    def _outcome(
        self, polylines: core.Polylines, statistics: dict[str, Any]
    ) -> tuple[Snapshot, dict[str, Any], str]:
        snapshot = self._snapshot(
            polylines,
            statistics["iterations"],
            statistics["nodes"],
            statistics["length"],
            statistics["seconds_total"],
        )
        return snapshot, statistics, self._stop_reason

    def _snapshot(
        self,
        polylines: core.Polylines,
        iterations: int,
        nodes: int,
        length: float,
        seconds: float,
        kept: int = 0,
    ) -> Snapshot:
        return Snapshot(
            polylines, iterations, nodes, length, seconds, self._progress, self._phase, kept
        )
