# SPDX-License-Identifier: GPL-3.0-or-later
"""What is computed per vertex once there is a surface; no bpy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import core
from .steps import Steps, at_once

# Of a surface, and of a context or None, which may be left out: cancelled, it ends the work with a
# core.MeanderError.
FieldOn = Callable[..., NDArray[np.float64]]


@dataclass(frozen=True)
class Computed:
    """A FieldOn that lasts: steps(surface) computes it."""

    steps: Callable[[core.Surface], Steps[NDArray[np.float64]]]

    def __call__(
        self, surface: core.Surface, context: core.Context | None = None
    ) -> NDArray[np.float64]:
        return at_once(self.steps(surface), context)


def evaluated(
    field: NDArray[np.float64] | FieldOn | None,
    surface: core.Surface,
    context: core.Context | None = None,
) -> NDArray[np.float64] | None:
    """A field on the surface: itself, or what it computes."""
    return field(surface, context) if callable(field) else field


def evaluating(
    field: NDArray[np.float64] | FieldOn | None,
    surface: core.Surface,
    context: core.Context | None = None,
) -> Steps[NDArray[np.float64] | None]:
    """The same in steps, where it has some."""
    if isinstance(field, Computed):
        return (yield from field.steps(surface))
    return evaluated(field, surface, context)
