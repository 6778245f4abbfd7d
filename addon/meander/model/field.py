# SPDX-License-Identifier: GPL-3.0-or-later
"""What is computed per vertex once there is a surface; no bpy."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from .. import core

# Of a surface, and of a context or None, which may be left out: cancelled, it ends the work with a
# core.MeanderError.
FieldOn = Callable[..., NDArray[np.float64]]


def evaluated(
    field: NDArray[np.float64] | FieldOn | None,
    surface: core.Surface,
    context: core.Context | None = None,
) -> NDArray[np.float64] | None:
    """A field on the surface: itself, or what it computes."""
    return field(surface, context) if callable(field) else field
