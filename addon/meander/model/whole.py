# SPDX-License-Identifier: GPL-3.0-or-later
"""What has grown on a part of a surface, on all of it: with its mirror image, or on copies."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import core
from . import mirror_whole
from .copies import AllCopies, Copies, laid_on_all
from .mirror import Half


class Whole(NamedTuple):
    """A curve on all of a surface.

    flow      makes no step; whoever asks for it closes it
    figures   of the whole curve; how long it took is that of the part's flow
    sources   of a mirror: the strand of the given seed that each strand came from; None: there is
              no seed
    why       why there are more lines than parts of the surface, without a full stop; empty: there
              are not, or nothing is known of it
    mirror    gives the report's "mirror"; None where there is none
    """

    flow: core.Flow | AllCopies
    figures: dict[str, Any]
    sources: NDArray[np.int64] | None
    why: str
    mirror: Callable[[], dict[str, Any] | None]


def whole_of(part: Half | Copies, grown: core.Flow, options: core.FlowOptions) -> Whole:
    """The curve of a part that has grown, on all of the surface. Raises core.MeanderError.

    options   those that the whole has by now
    """
    if isinstance(part, Copies):
        flow = laid_on_all(part, grown, options)
        return Whole(flow, mirror_whole.with_run(flow.statistics(), grown), None, "", lambda: None)
    found = mirror_whole.whole_of(part, grown, options)
    figures = found.statistics(part, grown)
    return Whole(found.flow, figures, found.sources, found.why, lambda: found.figures(part))
