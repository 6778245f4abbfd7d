# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drawing from a camera is going to cost: its surfaces together, before it begins.

Every surface is measured once. Another spacing on paper, or a larger page, is the same drawing
under a magnifying glass, and so it is arithmetic.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from .. import core
from ..model.estimate import Estimate, estimated, together
from ..model.problem import Problem
from . import estimate


class DrawingEstimate:
    """Of what is to be filled for a page."""

    def __init__(self, problems: Iterable[Problem], spacing: float, width: float) -> None:
        """spacing, width   of strands and of the picture on paper, in millimetres"""
        self._spacings = width / spacing  # across the picture
        self._parts: list[tuple[core.Extent, core.FlowOptions]] = []
        for problem in problems:
            try:
                self._parts.append((estimate.extent_of_problem(problem), problem.options))
            except core.MeanderError:  # its run will report why, and leaves it out
                continue

    def at(self, spacing: float, width: float) -> Estimate | None:
        """What the same picture comes to at another spacing and size; None: nothing is known."""
        larger = width / spacing / self._spacings
        return together(
            [
                estimated(_magnified(extent, larger), options, False, estimate.speeds)
                for extent, options in self._parts
            ]
        )

    def cost(self) -> core.Cost:
        """What the library needs for it. The memory is that of the largest surface."""
        costs = [core.estimate_cost(extent, options) for extent, options in self._parts]
        return core.Cost(
            sum(cost.nodes for cost in costs),
            sum(cost.points for cost in costs),
            sum(cost.length for cost in costs),
            max((cost.memory for cost in costs), default=0.0),
            sum(cost.processor_seconds for cost in costs),
        )


def _magnified(extent: core.Extent, larger: float) -> core.Extent:
    """An extent whose lengths are all so many times as large."""
    return replace(
        extent,
        length_area=extent.length_area * larger**2,
        node_area=extent.node_area * larger**2,
        edge_density=extent.edge_density / larger,
        curvature=extent.curvature / larger**2,
    )
