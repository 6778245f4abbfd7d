# SPDX-License-Identifier: GPL-3.0-or-later
"""The outcome of a run of the batch command, as it is written; no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import core
from ..model import strands
from ..model.problem import Opened


@dataclass(frozen=True)
class Grown:
    """The curve, what is known of its points, and which of its strands are guides.

    density   per vertex of the surface; None: 1 everywhere
    """

    curve: core.Polylines
    data: core.PointData
    guides: NDArray[np.bool_]
    density: NDArray[np.float64] | None


def grown_of(flow: core.Flow, opened: Opened, without_guides: bool) -> Grown:
    """The curve of a run that has ended. Raises core.MeanderError."""
    curve, data, guides = flow.polylines(), flow.point_data(), flow.guides()
    if without_guides:
        kept = strands.points_without_guides(curve, guides)
        data = core.PointData(*(values[kept] for values in data))
        curve = strands.without_guides(curve, guides)
        guides = guides[~guides]
    return Grown(curve, data, guides, opened.density)
