# SPDX-License-Identifier: GPL-3.0-or-later
"""The strands that a flow starts from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .abi import SeedRecord, Status
from .calls import prepared
from .errors import MeanderError
from .handle import address_of, as_array, checked_array
from .named import number_of, only_its_names, refuse_other, switch_of


@only_its_names
@dataclass
class Seed:
    """Strands to start from, in space; every point is moved to the nearest point of the surface.

    points        (n, 3) float64, strand after strand, in the surface's units
    offsets       (s + 1,) uint32: strand k has the points offsets[k] .. offsets[k + 1] - 1
    closed        (s,) uint8: 1 closed (first point not repeated), 0 open
    fixed         (n,) uint8: 1 never moves; None: every point may move
    guides        (s,) uint8: 1 for a strand that stays as it is and that the others keep away
                  from; None: none
    loops         regions between guides, and components, without a growing strand get a small loop
    max_distance  how far from the surface a point may be, in the surface's units; a local r always
                  is
    """

    points: NDArray[np.float64]
    offsets: NDArray[np.uint32]
    closed: NDArray[np.uint8]
    fixed: NDArray[np.uint8] | None = None
    guides: NDArray[np.uint8] | None = None
    loops: bool = False
    max_distance: float = 0.0

    def __init__(
        self,
        points: ArrayLike,
        offsets: ArrayLike,
        closed: ArrayLike,
        fixed: ArrayLike | None = None,
        guides: ArrayLike | None = None,
        loops: bool = False,
        max_distance: float = 0.0,
    ) -> None:
        self.points, self.offsets, self.closed = map(as_array, (points, offsets, closed))
        self.fixed, self.guides = as_array(fixed), as_array(guides)
        self.loops, self.max_distance = loops, max_distance


def seed_record(seed: Seed) -> tuple[SeedRecord, tuple[NDArray[Any], ...]]:
    """The C struct of a seed, and the arrays that it points to.

    The library cannot see how long the arrays are, so their lengths are checked here.
    """
    refuse_other("seed", seed, Seed)
    points = checked_array("the seed's points", seed.points, np.float64, 3)
    offsets = checked_array("the seed's offsets", seed.offsets, np.uint32, None)
    closed = checked_array("the seed's closed flags", seed.closed, np.uint8, None)
    fixed = None
    if seed.fixed is not None:
        fixed = checked_array("the seed's fixed flags", seed.fixed, np.uint8, None)
    if len(offsets) != len(closed) + 1 or len(closed) == 0:
        raise MeanderError(
            "a seed needs at least one strand and one more offset than strands, not "
            f"{len(offsets)} offsets for {len(closed)} strands",
            Status.INVALID_SEED,
        )
    if offsets[0] != 0 or offsets[-1] != len(points) or np.any(offsets[1:] < offsets[:-1]):
        raise MeanderError(
            f"the seed's offsets must rise from 0 to the number of its points, {len(points)}",
            Status.INVALID_SEED,
        )
    if fixed is not None and len(fixed) != len(points):
        raise MeanderError(
            f"the seed needs one fixed flag for each of its {len(points)} points, not {len(fixed)}",
            Status.INVALID_SEED,
        )
    guides = None
    if seed.guides is not None:
        guides = checked_array("the seed's guide flags", seed.guides, np.uint8, None)
        if len(guides) != len(closed):
            raise MeanderError(
                f"the seed needs one guide flag for each of its {len(closed)} strands, "
                f"not {len(guides)}",
                Status.INVALID_SEED,
            )
    ends = offsets.astype(np.uint64)
    record = prepared(SeedRecord)
    record.point_count = len(points)
    record.strand_count = len(closed)
    record.points = address_of(points)
    record.offsets = address_of(ends)
    record.closed = address_of(closed)
    record.fixed = address_of(fixed)
    record.guides = address_of(guides)
    record.fill_regions = switch_of("seed's loops", seed.loops)
    record.max_distance = number_of("seed's max_distance", seed.max_distance)
    optional = tuple(array for array in (fixed, guides) if array is not None)
    return record, (points, ends, closed, *optional)
