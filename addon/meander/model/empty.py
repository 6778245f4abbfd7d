# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of its surface a run has left empty, where, and what to do; no bpy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import core

# A filled surface has a smaller share of places that are farther than 1.6 r from the curve.
MOST = 0.001


@dataclass(frozen=True)
class Empty:
    """What is farther than 1.6 r, which is 0.8 spacings, from the curve.

    share     of the surface's area, without what is narrow
    narrow    share of the area that is as far, and where the surface is narrower than a spacing
    largest   radius of the largest empty circle, where a curve has room if there is one; None: no
              place is farther than 1.2 r
    where     its middle
    """

    share: float
    narrow: float
    largest: float | None = None
    where: tuple[float, float, float] | None = None

    @property
    def matters(self) -> bool:
        """Whether a surface with it is not filled."""
        return self.share > MOST

    @property
    def narrow_matters(self) -> bool:
        return self.narrow > MOST

    def entry(self) -> dict[str, Any]:
        """The report's "empty"."""
        where = None if self.where is None else list(self.where)
        return {
            "share": self.share,
            "narrow": self.narrow,
            "largest": self.largest,
            "where": where,
        }


def empty_of(gaps: core.Gaps) -> Empty:
    """What Flow.gaps() has found."""
    largest, where = None, None
    if len(gaps):
        with_room = np.flatnonzero(~gaps.narrow)
        k = int(with_room[0]) if len(with_room) else 0
        largest = float(gaps.radii[k])
        x, y, z = gaps.positions[k].tolist()
        where = (x, y, z)
    return Empty(gaps.empty_share, gaps.narrow_share, largest, where)


def percent(share: float) -> str:
    """A share that matters, such as "0.2 %", "56 %"."""
    percents = 100.0 * share
    return f"{percents:.1f} %" if percents < 1.0 else f"{min(percents, 100.0):.0f} %"


# As a share of how far a place is from the line.
_NEXT_TO_NOTHING = 1e-6


def remark(
    empty: Empty,
    reason: str,
    helps: Sequence[str],
    length: Callable[[float], str] = "{:.4g}".format,
) -> str:
    """What to say of a surface that is not filled; else nothing.

    reason   of the stop
    helps    what may help, the first where the run was cut short: how to let it go on, how to
             begin otherwise (or empty, where it began so), how to choose a smaller spacing
    length   how the user reads a length
    """
    if not empty.matters:
        return ""
    longer, otherwise, closer = helps
    what = longer if reason == "iteration_limit" else otherwise or closer
    place = ""
    if empty.largest is not None and empty.where is not None:
        # Places are rounded: what is next to 0 is 0.
        least = _NEXT_TO_NOTHING * empty.largest
        x, y, z = (length(value if abs(value) > least else 0.0) for value in empty.where)
        place = f", most around ({x}, {y}, {z}), up to {length(empty.largest)} from it"
    return f"{percent(empty.share)} of the surface is empty, far from the line{place}; {what}"


def narrow_remark(empty: Empty) -> str:
    """What to say of parts that a line and its way back have no room on; else nothing."""
    if not empty.narrow_matters:
        return ""
    return (
        f"{percent(empty.narrow)} of the surface is narrower than a spacing and stays empty; a "
        "smaller spacing fills it"
    )
