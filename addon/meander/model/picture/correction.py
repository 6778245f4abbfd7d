# SPDX-License-Identifier: GPL-3.0-or-later
"""What to ask for where a drawing is darker or lighter than it was to be; no bpy.

Strokes and hatching that are finer than the spacing of their strands leave the line no room for the
ink that they want, and one strand more or less across a white place is a choice of the flow's. What
a drawing lacks, seen from where strands run together, is asked for in addition: a feedback by what
is measured, as halftones by error diffusion have it (Floyd and Steinberg 1976). It is added and not
multiplied, so that strokes stay as dark as the pen can be and the places between them change.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .image import blurred
from .tone import Tone

# The least share that is asked for, in times of the lightest: as a place that lies between two
# strands has it, whatever it asks for.
_LEAST = 0.5


def corrected(
    asked: NDArray[np.float64],
    share: NDArray[np.float64],
    ink: NDArray[np.float64],
    blur: float,
    tone: Tone,
) -> NDArray[np.float64]:
    """The share of ink to ask for next, at the places of a grid.

    asked   the share with which the drawing was made
    share   that it was to have
    ink     that it has
    blur    from where it is seen, in cells
    """
    lacking = blurred(share - ink, blur)
    return (asked + lacking).clip(_LEAST * tone.lightest, tone.darkest)
