# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run solves, as arrays and options; no bpy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import core


@dataclass(frozen=True)
class Problem:
    """What to solve: arrays and options, nothing of a host.

    density     per vertex, or what computes it from the surface once that is there
    directions  likewise, for options.alignment_weight; `alignment` is one of core.ALIGNMENTS
    """

    vertices: np.ndarray
    faces: np.ndarray
    options: core.FlowOptions
    seed: core.Seed | None = None
    density: np.ndarray | Callable[[core.Surface], np.ndarray] | None = None
    surface_options: core.SurfaceOptions | None = None
    directions: np.ndarray | Callable[[core.Surface], np.ndarray] | None = None
    alignment: str = "along"
    outline: float = 0.0  # distance of outlines from the border; 0: none

    def surface(self) -> core.Surface:
        """The surface, which the caller closes. Raises core.MeanderError."""
        threads = self.options.threads
        return core.Surface(self.vertices, self.faces, self.surface_options, threads)

    def expected_length(self, density: np.ndarray | None) -> float:
        """The length of a curve that fills the surface: area over spacing, face by face."""
        areas = self._areas()
        if density is not None:
            areas = areas * np.sqrt(density[self.faces]).mean(axis=1)
        return float(areas.sum() / (2.0 * self.options.radius))

    def area(self) -> float:
        """Of all faces, in square units; a mask is not looked at."""
        return float(self._areas().sum())

    def _areas(self) -> np.ndarray:
        a, b, c = (self.vertices[self.faces[:, corner]] for corner in range(3))
        return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0


def evaluated(field: Any, surface: core.Surface) -> Any:
    """A field on the surface: itself, or what it computes."""
    return field(surface) if callable(field) else field
