# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarse runs of variations of a curve, to choose from; no bpy."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace

from .. import core
from .opening import open_flow
from .problem import Problem

# A run ends where its curve fills the surface and is about to be made even: iterations of a curve
# that grows, and of a full start.
_GROWN, _FULL = 80, 8
# A curve of more nodes is run wider instead. At the spacing that is proposed there are 6,000.
_NODES = 7_000.0


def coarse(problem: Problem, variation: int, nodes: float) -> Problem:
    """A run of some hundred milliseconds of a variation of the same problem.

    nodes   that the whole run is expected to have
    """
    options = replace(problem.options, tunings=dict(problem.options.tunings))
    wider = max(1.0, math.sqrt(nodes / _NODES)) if math.isfinite(nodes) else 1.0
    for length in ("radius", "segment_length", "max_radius"):
        setattr(options, length, wider * getattr(options, length))
    options.variation, options.start_spacing_factor = variation, 1.0
    options.iteration_limit = _FULL if options.start == core.Start.FULL else _GROWN
    return replace(problem, options=options, outline=wider * problem.outline)


def is_coarser(problem: Problem, nodes: float) -> bool:
    """Whether coarse runs are wider than the curve, so that its course is another one."""
    return coarse(problem, 0, nodes).options.radius > 1.001 * problem.options.radius


def lines(problem: Problem, variations: Iterable[int], nodes: float) -> Iterator[core.Polylines]:
    """The curve of each of these variations, one after another; see coarse().

    Raises core.MeanderError as open_flow() does.
    """
    for variation in variations:
        opened = open_flow(coarse(problem, variation, nodes))
        with opened.flow as flow:
            flow.run()
            found = flow.polylines()
        part, known = opened.part, opened.problem
        if part is not None:
            found = part.shown(found)
        else:
            problem = replace(problem, density=known.density, directions=known.directions)
        yield found
