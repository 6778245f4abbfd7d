# SPDX-License-Identifier: GPL-3.0-or-later
"""Which strands a run starts from: seeds, strokes and guides put together. numpy only, no bpy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import core


@dataclass(frozen=True)
class Part:
    """Strands from one place."""

    name: str  # of that place, as the user knows it
    seed: core.Seed
    guide: bool = False
    first_spline: int = 0  # of these strands, among the splines of that place


def stroke(begin: ArrayLike, end: ArrayLike) -> core.Seed:
    """One open strand between two points, (3,) each, whose ends stay where they are."""
    return core.Seed(
        points=np.array([begin, end], dtype=np.float64),
        offsets=np.array([0, 2], dtype=np.uint32),
        closed=np.zeros(1, dtype=np.uint8),
        fixed=np.ones(2, dtype=np.uint8),
    )


def assembled(parts: Sequence[Part], loops: bool = False) -> core.Seed | None:
    """One seed of all parts, in their order; None when there are none.

    loops   give regions and components without a growing strand a small loop. Where there are
            guides only they always get one, since nothing else could grow.
    """
    if not parts:
        return None
    seeds = [part.seed for part in parts]
    firsts = np.cumsum([0] + [len(seed.points) for seed in seeds])
    return core.Seed(
        points=np.vstack([seed.points for seed in seeds]),
        offsets=np.concatenate(
            [[0]] + [seed.offsets[1:] + first for seed, first in zip(seeds, firsts)]
        ).astype(np.uint32),
        closed=np.concatenate([seed.closed for seed in seeds]).astype(np.uint8),
        fixed=np.concatenate(
            [
                np.zeros(len(seed.points), np.uint8) if seed.fixed is None else seed.fixed
                for seed in seeds
            ]
        ),
        guides=np.concatenate(
            [np.full(len(part.seed.closed), part.guide, dtype=np.uint8) for part in parts]
        ),
        loops=loops or all(part.guide for part in parts),
    )


def span(seed: core.Seed, begin: int, end: int) -> core.Seed:
    """The strands `begin` to `end` - 1 of a seed."""
    first, last = int(seed.offsets[begin]), int(seed.offsets[end])
    return replace(
        seed,
        points=seed.points[first:last],
        offsets=(seed.offsets[begin : end + 1] - seed.offsets[begin]).astype(np.uint32),
        closed=seed.closed[begin:end],
        fixed=None if seed.fixed is None else seed.fixed[first:last],
        guides=None if seed.guides is None else seed.guides[begin:end],
    )


def points_without_guides(
    polylines: core.Polylines, guides: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Which points belong to strands that have grown."""
    return np.repeat(~guides, np.diff(polylines.offsets.astype(np.int64)))


def without_guides(polylines: core.Polylines, guides: NDArray[np.bool_]) -> core.Polylines:
    """The polylines of the strands that have grown."""
    counts = np.diff(polylines.offsets.astype(np.int64))
    points = points_without_guides(polylines, guides)
    return core.Polylines(
        positions=polylines.positions[points],
        normals=polylines.normals[points],
        offsets=np.concatenate([[0], np.cumsum(counts[~guides])]).astype(np.uint32),
        closed=polylines.closed[~guides],
    )


def explained(error: core.MeanderError, parts: Sequence[Part]) -> core.MeanderError:
    """The same error, with the seed points that it names described as the user knows them:
    counted from 1 within their spline and object."""
    if error.element_kind != "seed_point":
        return error
    places = [place for place in (_place(point, parts) for point in error.elements) if place]
    if not places:
        return error
    text = f"{str(error).rstrip('.')}: this is at {' and '.join(dict.fromkeys(places))}"
    return core.MeanderError(text, error.status, error.element_kind, error.elements)


def _place(point: int, parts: Sequence[Part]) -> str:
    for part in parts:
        if point < len(part.seed.points):
            strand = int(np.searchsorted(part.seed.offsets, point, side="right")) - 1
            number = point - int(part.seed.offsets[strand]) + 1
            spline = part.first_spline + strand + 1
            return f"point {number} of spline {spline} of '{part.name}'"
        point -= len(part.seed.points)
    return ""


def empty_parts(count: int) -> str:
    """What to say when nothing grows on so many components of a surface."""
    parts = "one separate part" if count == 1 else f"{count} separate parts"
    return (
        f"Nothing grows on {parts} of the mesh; draw a strand there, or choose to fill every part"
    )
