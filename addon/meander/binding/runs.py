# SPDX-License-Identifier: GPL-3.0-or-later
"""A curve that grows on a surface: how it begins, and its runs."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from ctypes import byref, c_void_p
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .abi import (
    ErrorRecord,
    PreviewRecord,
    Status,
)
from .calls import Found, call, new_error, raise_error, status_of
from .choices import ALIGNMENTS, STOP_REASONS
from .context import Context, pointer_of
from .curve import Preview, polylines_of
from .errors import MeanderError
from .flow_options import FlowOptions, options_record
from .handle import Handle, address_of, checked_array, chosen
from .interruption import heard
from .named import number_of, refuse_other, whole_of
from .native_library import native
from .seed import Seed, seed_record
from .spacing import automatic_spacing
from .surface import Surface
from .work import Work


class FlowRun(Handle):
    """The life of a Flow: how it begins, and its steps and runs, on this thread or another."""

    _what = "flow"

    def __init__(
        self,
        surface: Surface,
        options: FlowOptions,
        seed: Seed | None = None,
        density: ArrayLike | None = None,
        context: Context | None = None,
    ) -> None:
        self._making(surface, options, seed, density).now(context)

    @classmethod
    def work(
        cls,
        surface: Surface,
        options: FlowOptions,
        seed: Seed | None = None,
        density: ArrayLike | None = None,
    ) -> Work[Any]:
        """A flow that is still to be made, on a thread of the library's if need be."""
        return cls.__new__(cls)._making(surface, options, seed, density)

    def _making(
        self,
        surface: Surface,
        options: FlowOptions,
        seed: Seed | None,
        density: ArrayLike | None,
    ) -> Work[Any]:
        refuse_other("surface", surface, Surface, "make one of the vertices and faces")
        density_array = None
        if density is not None:
            density_array = checked_array("density", density, np.float64, None)
            if len(density_array) != surface.vertex_count:
                raise MeanderError(
                    f"density must have one value for each of the {surface.vertex_count} vertices "
                    f"of the surface, not {len(density_array)}"
                )
        # The arrays behind the record must outlive the call.
        start, seed_arrays = (None, ()) if seed is None else seed_record(seed)
        record = options_record(_with_spacing(options, surface))
        pointer, destroy = c_void_p(), native().meander_flow_destroy

        def made() -> FlowRun:
            Handle.__init__(self, pointer.value, destroy)
            self._begin_life()
            return self

        return Work(
            "flow_create",
            "flow",
            (
                surface._alive(),
                None if start is None else byref(start),
                address_of(density_array),
                0 if density_array is None else len(density_array),
                byref(record),
                byref(pointer),
            ),
            made,
            undo=lambda: destroy(pointer),
            holds=(surface, density_array, seed_arrays),
        )

    def _begin_life(self) -> None:
        self._busy = threading.Lock()
        self._left_alone = False  # by an interruption, while a call went on
        self._cancel: Callable[[], None] | None = None  # of the run that was started last
        self._run = ExitStack()  # what that uses
        self._looked_at = threading.Lock()  # held while any thread asks whether it is running

    @contextmanager
    def _use(self) -> Iterator[int]:
        """The native flow, for this thread alone.

        The library does not check the thread rule; two threads in one flow would corrupt memory.
        """
        # What an interruption has left alone ends by itself, and is waited for.
        if not self._busy.acquire(blocking=self._left_alone):
            raise MeanderError(
                "this flow is in use on another thread; wait until its call has ended"
            )
        self._left_alone = False
        try:
            yield self._alive()
        finally:
            self._busy.release()

    def _alone(self, name: str, *arguments: Any) -> None:
        """Calls a function of the flow that nothing can cancel: interrupted, it goes on alone.

        arguments   arrays, numbers and references
        """

        def work() -> None:
            addresses = (
                address_of(argument) if isinstance(argument, np.ndarray) else argument
                for argument in arguments
            )
            with self._use() as pointer:
                call(getattr(native(), name), pointer, *addresses)

        try:
            heard(work, None)
        except BaseException:
            self._left_alone = self._busy.locked()
            raise

    def close(self) -> None:
        """Frees the flow; raises MeanderError while another thread is using it.

        A started run is cancelled and waited for: an iteration at most.
        """
        if self._pointer is not None:
            with self._use():
                # Nobody asks about the native flow from here on, and its end may take a while.
                with self._looked_at:
                    self._pointer = None
                super().close()
                self._run.close()

    def set_directions(self, directions: ArrayLike | None, kind: str = "along") -> None:
        """Gives the field of lines that the option alignment_weight refers to, before any step.

        directions  (vertex count of the surface, 3) float64, of any length and either sign; what
                    stands up from the surface counts less, by the sine of its angle with the
                    normal. Zero or not finite: no wish there. None: takes a field back
        kind        one of ALIGNMENTS: the curve lies along the field, or across it

        Raises MeanderError for an array that does not fit, a field without any direction in the
        surface, and a flow that has made an iteration.
        """
        array = None
        if directions is not None:
            array = checked_array("directions", directions, np.float64, 3)
        number = chosen("kind of alignment", kind, ALIGNMENTS)
        count = 0 if array is None else len(array)
        self._alone("meander_flow_set_directions", array, count, number)

    def step(self, context: Context | None = None) -> str:
        """Runs one iteration and returns the stop reason, one of STOP_REASONS.

        A step is taken whatever the reason says, so the caller decides when to stop. 'cancelled'
        leaves the state of the last whole iteration; the flow can go on.
        """
        return self._advance("meander_flow_step", context)

    def run(self, context: Context | None = None) -> str:
        """Steps until the flow converges, stalls, is cancelled or reaches its iteration limit.

        Returns which of these it was, one of STOP_REASONS. 'cancelled' leaves the last whole
        iteration in place; the flow can go on. So it can after an interruption from the keyboard.
        """
        return self._advance("meander_flow_run", context)

    def _advance(self, name: str, context: Context | None) -> str:
        error = new_error()
        with self._use() as pointer:
            with pointer_of(context) as cancelling:
                status = status_of(getattr(native(), name), pointer, cancelling, error=error)
            return self._reason(pointer, status, error)

    def _reason(self, pointer: int, status: int, error: ErrorRecord) -> str:
        if status == Status.CANCELLED:
            return "cancelled"
        if status != Status.OK:
            raise_error(status, error)
        return STOP_REASONS[native().meander_flow_stop_reason(pointer)]

    def start(self, context: Context | None = None) -> None:
        """Begins `run` on a thread of the library's and returns at once; the curve is the same.

        Until `wait`, everything but `running`, `preview`, `wait` and `close` raises MeanderError.
        The context may be closed meanwhile, but then the run can only be ended by `close`.
        """
        self._begin(native().meander_flow_start, context=context)

    def _begin(
        self,
        function: Callable[..., int],
        *arguments: Any,
        context: Context | None,
        at_end: Callable[[], None] = lambda: None,
    ) -> None:
        """Begins what the flow then belongs to.

        at_end   is called after its end has been waited for; holds what is used until then
        """
        with self._use() as pointer, ExitStack() as run:
            run.callback(at_end)
            # One of its own too: an interrupted wait cancels it.
            given = run.enter_context(Context()) if context is None else context
            refuse_other("context", given, Context, "make one, or leave it out")
            cancel = run.enter_context(given._use_in_call())
            call(function, pointer, *arguments, cancel._as_parameter_)
            self._cancel = cancel.now
            self._run = run.pop_all()  # in use until the end has been waited for
            # The interpreter must not go while the library computes; no other thread of Python's
            # can be inside the flow but in `wait`, which takes this back.
            self._finalizer.atexit = True

    @property
    def running(self) -> bool:
        """Whether a started run is still going. Any thread, also while another closes the flow;
        costs nothing. Raises MeanderError once it has been closed.
        """
        with self._looked_at:
            return bool(native().meander_flow_is_running(self._alive()))

    def wait(self) -> str:
        """Waits for the end of a started run; returns or raises what `run` would have.

        An interruption from the keyboard cancels the run. Raises MeanderError also when no run has
        been started since the last wait.
        """
        with self._use() as pointer:
            return self._reason(pointer, *self._waited(pointer))

    def _waited(self, pointer: int) -> tuple[int, ErrorRecord]:
        error = new_error()
        with self._run:
            self._finalizer.atexit = False

            status = heard(
                lambda: native().meander_flow_wait(pointer, byref(error)), self._cancel
            )
        return status, error

    def keep_growth(self, length_step: float, point_limit: int) -> None:
        """Has started runs keep copies of the growing curve, for `preview`; see the C header.

        length_step   a copy is kept whenever the curve is longer by this than at the last; 0: none
        point_limit   how many points those have at most that have not been taken yet
        """
        step, limit = number_of("length step", length_step), whole_of("point limit", point_limit)
        with self._use() as pointer:
            call(native().meander_flow_keep_growth, pointer, step, limit)

    def preview(self) -> Preview | None:
        """The oldest copy of growth that is left, else the newest copy of the curve of a started
        run, once; None while there is no newer one.

        The first is of the curve at the start; the run makes the next one, after its present
        iteration, when this one has been taken. Raises MeanderError before `start` and after
        `wait`.
        """
        found = Found(PreviewRecord)
        with self._use() as pointer:
            copy = found.fill(native().meander_flow_take_preview, pointer)
        if copy.serial == 0:
            return None
        return Preview(
            polylines_of(found, np.empty((0, 3))),
            copy.iterations,
            copy.nodes,
            copy.length,
            copy.seconds,
            copy.kept,
        )


def _with_spacing(options: FlowOptions, surface: Surface) -> FlowOptions:
    """The same options where they have a radius; else with that of the automatic spacing."""
    refuse_other("options", options, FlowOptions)
    if options.radius != 0:
        return options
    spacing = automatic_spacing(*surface._made_of[:2])
    logging.getLogger("meander").info(
        "The spacing is %g, which is automatic: no radius was chosen.", spacing
    )
    return replace(options, radius=spacing / 2.0)
