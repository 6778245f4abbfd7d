# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a mesh that only look joined, and the distance that makes them one; no bpy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from .. import core
from .preparation import seam_width
from .problem import Problem

# How far apart borders may be that look joined, in spacings.
_NEAR = 0.01


@dataclass(frozen=True)
class Joining:
    """Vertices within `distance` of each other made one would leave so many parts."""

    distance: float
    parts: int


def joining_of(problem: Problem, figures: Mapping[str, Any]) -> Joining | None:
    """The least distance, to within a factor of two, that joins as many parts of a mesh as a
    hundredth of the spacing does; None where that joins fewer than half of them.

    problem   what was filled; its surface is prepared anew, a few times
    figures   of core.Surface.statistics(), of that surface
    """
    parts, options = int(figures["components"]), problem.surface_options
    if parts < 2 or not figures["boundary_loops"] or options is None:
        return None
    radius = problem.options.radius
    least = max(options.merge_distance, seam_width(problem.vertices, radius))
    found = None
    distance = _rounded(2.0 * _NEAR * radius)
    while distance > least:
        left = _parts(problem, replace(options, merge_distance=distance))
        if left > parts // 2 if found is None else left > found.parts:
            break
        found = Joining(distance, left)
        distance = _rounded(distance / 2.0)
    return found


def _rounded(distance: float) -> float:
    """As it is written: nobody types more digits."""
    return float(f"{distance:.2g}")


def _parts(problem: Problem, options: core.SurfaceOptions) -> int:
    try:
        with core.Surface(
            problem.vertices, problem.faces, options, problem.options.threads
        ) as surface:
            return int(surface.statistics()["components"])
    except core.MeanderError:  # nothing is left of it
        return int(1e9)
