# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run solves, as arrays and options; no bpy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .. import core
from .field import FieldOn
from .geometry.reflection import Mirror
from .picture.correction import Tones


@dataclass
class Problem:
    """What to solve, as arrays and options.

    density     per vertex, or what computes it from the surface once that exists
    directions  likewise, for options.alignment_weight; `alignment` is one of core.ALIGNMENTS
    """

    vertices: np.ndarray
    faces: np.ndarray
    options: core.FlowOptions
    seed: core.Seed | None = None
    density: np.ndarray | FieldOn | None = None
    surface_options: core.SurfaceOptions | None = None
    directions: np.ndarray | FieldOn | None = None
    alignment: str = "along"
    outline: float = 0.0  # distance of outlines from the boundary; 0: none
    least_bend_radius: float = 0.0  # that no turn is to fall short of; 0: none is asked for
    mirror: Mirror | None = None  # one half is filled, and the other is its mirror image
    copies: np.ndarray | None = None  # vertices of each copy, to be filled by itself; None: one
    tones: Tones | None = None  # of a picture: the line is corrected until it has them

    @property
    def is_plain(self) -> bool:
        """Whether a flow solves all of it, and not a part of which a whole is made."""
        return self.mirror is None and self.copies is None

    def revised(self, options: core.FlowOptions, density: np.ndarray | None) -> Problem:
        """The same with other options and another density."""
        tones = None
        if self.tones is not None and density is not None:
            tones = self.tones.revised(2.0 * options.radius, density)
        return replace(self, options=options, density=density, tones=tones)


def begin_along_directions(problem: Problem) -> None:
    """What a start that was left to the rest is: full along directions where nothing drawn grows; a
    plane of symmetry that strands are to cross gives some.

    A curve that grows has turned before directions can hold it, and makes no rows. Not in the
    preset paper, nor from a wide start, which are about growth.
    """
    options, seed = problem.options, problem.seed
    drawn = seed is not None and not (seed.guides is not None and np.all(seed.guides))
    directed = problem.directions is not None and options.alignment_weight > 0
    directed = directed or (problem.mirror is not None and problem.mirror.across)
    if directed and not drawn and options.polish and options.start_spacing_factor == 1:
        options.start = core.Start.FULL
