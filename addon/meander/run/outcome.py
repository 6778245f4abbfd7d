# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run has come to: while it goes, and in the end. No bpy here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import core
from ..model.copies import Copies
from ..model.mirror import Half


@dataclass(frozen=True)
class Snapshot:
    """The curve at one moment, and what a user wants to know of it."""

    polylines: core.Polylines
    iterations: int
    nodes: int
    length: float
    seconds: float
    progress: float  # how far the run is, in [0, 1]; core.Context.progress
    phase: str  # what it is about; core.Context.phase
    kept: int = 0  # how many copies of growth come after this one


@dataclass(frozen=True)
class Line:
    """What a run has ended with: its outcome, and what the stepper tells of it besides."""

    outcome: tuple[Snapshot, dict[str, Any], str]
    gaps: core.Gaps | None
    guides: np.ndarray
    point_data: core.PointData
    drawn: tuple[core.Polylines, core.PointData] | None


def of_whole(preview: core.Preview, part: Half | Copies) -> core.Preview:
    """A copy of the curve of a part as the whole has it."""
    return preview._replace(
        polylines=part.shown(preview.polylines),
        nodes=round(part.times * preview.nodes),
        length=part.times * preview.length,
    )
