# SPDX-License-Identifier: GPL-3.0-or-later
"""Which strands a run starts from: seeds, strokes and guides put together. numpy only, no bpy."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import core

# How far from its surface a drawn curve may be, as a share of the surface's size: near enough that
# it is clear which side of it is meant.
REACH = 0.25


@dataclass(frozen=True)
class Part:
    """Strands from one place."""

    name: str  # of that place, as the user knows it
    seed: core.Seed
    guide: bool = False
    first_spline: int = 0  # of these strands, among the splines of that place
    # (n,) of the points in their spline, as the user counts them; None: from 1, one by one
    numbers: NDArray[np.int64] | None = None
    term: str = "spline"  # what a strand is called there
    drawn: bool = True  # else grown: a result's own strands, which lie on the surface already


def stroke(begin: ArrayLike, end: ArrayLike) -> core.Seed:
    """One open strand between two points, (3,) each, whose ends stay where they are."""
    return core.Seed(
        points=np.array([begin, end], dtype=np.float64),
        offsets=np.array([0, 2], dtype=np.uint32),
        closed=np.zeros(1, dtype=np.uint8),
        fixed=np.ones(2, dtype=np.uint8),
    )


def max_distance_of(vertices: NDArray[np.float64]) -> float:
    """How far from a surface of these vertices (n, 3) a drawn curve may be, in their units."""
    finite = vertices[np.isfinite(vertices).all(axis=1)]
    return REACH * float(np.linalg.norm(np.ptp(finite, axis=0))) if len(finite) else 0.0


def assembled(
    parts: Sequence[Part], loops: bool = False, max_distance: float = 0.0
) -> core.Seed | None:
    """One seed of all parts, in their order; None when there are none.

    max_distance   how far from the surface points may be, see core.Seed

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
        max_distance=max_distance,
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


# How the library names points of a seed, which it counts from 0 over all strands, and lengths.
_POINTS = re.compile(r"([Ss])eed points? (\d+)(?: and (\d+))?")
_LENGTHS = re.compile(r"\d[\d.e+-]*(?= (?:away from|is allowed))")


def explained(
    error: core.MeanderError,
    parts: Sequence[Part],
    length: Callable[[float], str] | None = None,
) -> core.MeanderError:
    """The same error, with the seed points that it names told as the user knows them: counted from
    1, within their spline and object.

    length   how the user reads a length; None: as a plain number
    """
    if error.element_kind != "seed_point":
        return error

    def named(match: re.Match[str]) -> str:
        places = places_of([int(number) for number in match.groups()[1:] if number], parts)
        return places[:1].upper() + places[1:] if match[1] == "S" else places

    text = _POINTS.sub(named, str(error))
    if length is not None:
        text = _LENGTHS.sub(lambda match: length(float(match[0])), text)
    return core.MeanderError(text, error.status, error.element_kind, error.elements)


def places_of(points: Sequence[int], parts: Sequence[Part]) -> str:
    """Points of an assembled seed in words: "points 3 and 9 of spline 1 of 'Trail'"."""
    found = list(dict.fromkeys(place for place in (_place(point, parts) for point in points)))
    if len(found) == 2 and found[0][1:] == found[1][1:]:
        return f"points {found[0][0]} and {found[1][0]} of {_strand_name(*found[0][1:])}"
    return " and ".join(f"point {place[0]} of {_strand_name(*place[1:])}" for place in found)


def _strand_name(term: str, number: int, name: str) -> str:
    return f"{term} {number} of '{name}'"


def _place(point: int, parts: Sequence[Part]) -> tuple[int, str, int, str]:
    """Number of a point in its strand, what that is called, its number in its object, and that
    one's name."""
    for part in parts:
        if point < len(part.seed.points):
            strand = int(np.searchsorted(part.seed.offsets, point, side="right")) - 1
            number = point - int(part.seed.offsets[strand]) + 1
            if part.numbers is not None:
                number = int(part.numbers[point])
            return number, part.term, part.first_spline + strand + 1, part.name
        point -= len(part.seed.points)
    return point + 1, "spline", 1, "the outline"  # laid after what is drawn


def fit_warning(figures: Mapping[str, Any], parts: Sequence[Part]) -> str:
    """What to say of a seed that jumps from one sheet of its surface to another; else nothing.

    figures   core.Flow.statistics()
    """
    jumps = int(figures["seed_jumps"])
    if not jumps or not parts:
        return ""
    ends = places_of([figures["seed_jump_point"], figures["seed_jump_point2"]], parts)
    # Of a Bezier spline the user knows the control points only, and both may be near the same.
    where = f"between {ends}" if " and " in ends else f"near {ends}"
    if jumps == 1:
        return (
            f"The seed jumps to another part of the surface {where}; draw it nearer to the "
            "surface there"
        )
    return (
        f"The seed jumps to another part of the surface at {jumps} places, farthest "
        f"{where}; draw it nearer to the surface there"
    )


def fit_remark(
    figures: Mapping[str, Any],
    parts: Sequence[Part],
    radius: float,
    length: Callable[[float], str] = "{:.3g}".format,
) -> str:
    """What to say of a seed that was farther than `radius` from its surface; else nothing."""
    distance = float(figures["seed_distance"])
    if not parts or not distance > radius:
        return ""
    what = "guides" if all(part.guide for part in parts) else "seed"
    return f"moved the {what} to the surface, from up to {length(distance)} away"


def empty_parts(count: int) -> str:
    """What to say when nothing grows on so many components of a surface."""
    parts = "one separate part" if count == 1 else f"{count} separate parts"
    return (
        f"Nothing grows on {parts} of the mesh; draw a strand there, or choose to fill every part"
    )
