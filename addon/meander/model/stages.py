# SPDX-License-Identifier: GPL-3.0-or-later
"""Which iterations of a run tell how its curve grew; no bpy."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

# The curve has grown when it has this share of its greatest length; from there on it gets even.
_GROWN = 0.97
# The share of the stages that show that.
_EVENING = 0.2


def stages_of(lengths: ArrayLike, count: int) -> list[int]:
    """The iterations after which a stage is to be shown, from 0, before the first, to the last.

    lengths   of the curve after every iteration
    count     how many stages there are to be, 2 or more; fewer where there are fewer iterations

    They are evenly spread over the length while the curve grows, then over the iterations.
    """
    reached = np.maximum.accumulate(np.concatenate([[0.0], np.asarray(lengths, dtype=float)]))
    last = len(reached) - 1
    grown = int(np.searchsorted(reached, _GROWN * reached[-1]))
    even = min(round(_EVENING * count), last - grown)
    steps = np.linspace(0.0, reached[grown], max(count - even, 2))
    growing = np.searchsorted(reached, steps)
    after = np.linspace(grown, last, even + 1)[1:].round().astype(int)
    return sorted({0, last, *growing.tolist(), *after.tolist()})
