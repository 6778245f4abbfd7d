# SPDX-License-Identifier: GPL-3.0-or-later
"""The flow of a problem before its first iteration, and what was found while it was made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .. import core
from .copies import Copies, copying
from .field import evaluating
from .mirror import Half, halving
from .preparation import outlined
from .problem import Problem
from .steps import Steps, at_once


@dataclass(frozen=True)
class Opened:
    """A flow before its first iteration, and what was found while it was made.

    flow      the caller closes it; of a problem with a mirror it is that of the half
    density   per vertex; None: 1 everywhere
    cost      that the run was expected to have; None: nobody asked
    problem   the one that was opened, with density and directions as they were found
    figures   of core.Surface.statistics(), and "skipped_outlines" where outlines were wanted
    part      what a whole is made of, by whole.whole_of(), where a mirror or copies leave a part to
              be solved; else None. Density, cost and figures are of the whole surface, `problem` is
              that of the part
    """

    flow: core.Flow
    density: np.ndarray | None
    figures: dict[str, Any]
    problem: Problem
    cost: core.Cost | None = None
    part: Half | Copies | None = None


def open_flow(
    problem: Problem,
    context: core.Context | None = None,
    accept: Callable[[core.Cost], None] | None = None,
) -> Opened:
    """Makes surface, density, outlines, flow and directions of a problem, in this order.

    The one place where a run begins: the operator, the batch command and the followers of surfaces
    in motion all come through here. Raises core.MeanderError, of the status CANCELLED where
    `context` has been cancelled meanwhile.

    accept   is told what the run is expected to cost, before there is any curve, and raises what it
             likes where that is too much
    """
    return at_once(opening(problem, context, accept), context)


def opening(
    problem: Problem,
    context: core.Context | None = None,
    accept: Callable[[core.Cost], None] | None = None,
) -> Steps[Opened]:
    """open_flow() in steps."""
    if problem.mirror is not None:
        half = yield from halving(problem, context, accept)
        opened = yield from opening(half.problem, context)
        return replace(
            opened, density=half.density, figures=half.figures, cost=half.cost, part=half
        )
    copies = yield from copying(problem, accept)
    if copies is not None:
        if not copies.once:
            opened = yield from opening(copies.problem, context, accept)
            return replace(opened, part=copies)
        opened = yield from opening(copies.problem, context)
        return replace(opened, figures=copies.figures, cost=copies.cost, part=copies)
    options, cost = problem.options, None
    surface = yield core.Surface.work(
        problem.vertices, problem.faces, problem.surface_options, options.threads
    )
    with surface:
        figures = surface.statistics()
        density = yield from evaluating(problem.density, surface, context)
        if accept is not None:
            cost = core.estimate_cost((yield surface.extent_work(density)), options)
            accept(cost)
        seed = problem.seed
        if problem.outline:
            spacing = 2.0 * options.radius
            seed, skipped = outlined(seed, surface, problem.outline, spacing, context)
            figures["skipped_outlines"] = skipped
        flow = yield core.Flow.work(surface, options, seed, density)
        try:
            directions = yield from evaluating(problem.directions, surface, context)
            if directions is not None:
                flow.set_directions(directions, problem.alignment)
        except BaseException:
            flow.close()
            raise
    found = replace(problem, density=density, directions=directions)
    return Opened(flow, density, figures, found, cost)
