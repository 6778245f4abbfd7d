# SPDX-License-Identifier: GPL-3.0-or-later
"""What the batch command fills: a surface, and what its files and options say of it; no bpy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .. import core
from ..model import strands
from ..model.alignment import Alignment, Directions
from ..model.density import Choice
from ..model.preparation import Mask, Repair

if TYPE_CHECKING:
    import bpy


@dataclass
class Input:
    """A surface to fill, and what the input knows besides; arrays are as core.Flow wants them."""

    vertices: NDArray[np.float64]
    faces: NDArray[np.uint32]
    seed: core.Seed | None = None
    # Per vertex, or what computes it from the surface.
    density: NDArray[np.float64] | Callable[[core.Surface], NDArray[np.float64]] | None = None
    density_choice: Choice = field(default_factory=Choice)  # what the density was made from
    alignment: Alignment = field(default_factory=Alignment)
    directions: Directions | None = None
    repair: Repair = field(default_factory=Repair)
    mask: Mask = field(default_factory=Mask)
    surface_options: core.SurfaceOptions = field(default_factory=core.SurfaceOptions)
    loose_edges: int = 0
    fixed_ends: bool = False
    stroke: tuple[list[float], list[float]] | None = None  # its ends
    parts: list[strands.Part] = field(default_factory=list)  # what the seed is put together from
    surface_object: bpy.types.Object | None = None  # None: the mesh came from an OBJ file
