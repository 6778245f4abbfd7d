# SPDX-License-Identifier: GPL-3.0-or-later
"""What the batch command fills: a problem, and what else its files and options say; no bpy."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..model import strands
from ..model.alignment import Alignment
from ..model.density import Choice
from ..model.files.polygons import MeshOfFile
from ..model.preparation import Mask, Repair
from ..model.problem import Problem


@dataclass
class Input:
    """A problem to solve, and what its parts were made from: for the report and for a .blend."""

    problem: Problem
    density_choice: Choice = field(default_factory=Choice)
    values: NDArray[np.float64] | None = None  # per vertex, of a mesh file: the density's source
    alignment: Alignment = field(default_factory=Alignment)
    repair: Repair = field(default_factory=Repair)
    mask: Mask = field(default_factory=Mask)
    loose_edges: int = 0
    instances: tuple[int, bool] = (0, False)
    fixed_ends: bool = False
    stroke: tuple[list[float], list[float]] | None = None  # its ends
    parts: list[strands.Part] = field(default_factory=list)  # what the seed is put together from
    polygons: NDArray[np.integer] | None = None  # of which each triangle is a part; None: none
    warnings: list[str] = field(default_factory=list)
    surface_object: Any = None  # of Blender; None: the mesh came from a file of its own
    mesh_file: MeshOfFile | None = None  # that file
