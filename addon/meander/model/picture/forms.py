# SPDX-License-Identifier: GPL-3.0-or-later
"""The direction along the edges and forms of a picture, for an engraving; no bpy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .image import blurred

# The mean spacings over which the direction is found: of the edges, and of what they lie in.
_EDGES, _FORM = 0.7, 2.5
# The direction where there are no edges is across the page, and so strong, in mean edges.
_CALM = 0.02


def form_angles(share: NDArray[np.float64], spacing: float) -> NDArray[np.float64]:
    """The direction along the edges and forms of a picture at each place, in radians from the right
    counterclockwise: the structure tensor's lesser one (Foerstner and Guelch 1987).

    spacing   in cells
    """
    down, right = np.gradient(blurred(share, _EDGES * spacing))
    up = -down
    xx, xy, yy = (
        blurred(product, _FORM * spacing) for product in (right * right, right * up, up * up)
    )
    yy = yy + _CALM * float((xx + yy).mean())
    return 0.5 * np.arctan2(2.0 * xy, xx - yy) + np.pi / 2.0
