# SPDX-License-Identifier: GPL-3.0-or-later
"""One line of several strands: short straight bridges where they come nearest to each other.

Closed strands are joined along a minimum spanning tree of their least distances (Kruskal 1956): at
each join both are cut open over a short stretch, and two bridges side by side connect the ends. So
closed strands become one closed line. Open strands are joined end to end first, and the line is
open then. Guides stay strands of their own. No bpy.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...core import PointData, Polylines, Seed
from ..geometry.bridge_places import GAP, End, Join, Strand, between, joined_ends, joins_of
from ..geometry.unit_vectors import unit
from .toolpath import Mesh, holding


@dataclass(frozen=True)
class Joined:
    """Polylines whose grown strands are one line.

    before, after   (n,) int64: each point lies between these two of the given points,
    share           (n,) float64: so far from the one to the other
    guides          (s,) bool: which strands are guides
    line            the strand that is the line
    runs            the line in pieces: of the how-manyth of the joined strands, and the number of
                    its points. Between two runs is a bridge, and after the last of a closed line
    closed          of the joined strands
    sources         (s,) int64: a given strand that each strand came from
    bridge_lengths  (b,) float64
    """

    polylines: Polylines
    before: NDArray[np.int64]
    after: NDArray[np.int64]
    share: NDArray[np.float64]
    guides: NDArray[np.bool_]
    line: int
    runs: tuple[tuple[int, int], ...]
    closed: tuple[bool, ...]
    sources: NDArray[np.int64]
    bridge_lengths: NDArray[np.float64]

    def values(self, given: NDArray[np.float64]) -> NDArray[np.float64]:
        """What is known of the given points, (m,) or (m, k), at the points of this."""
        share = self.share if given.ndim == 1 else self.share[:, None]
        return (1.0 - share) * given[self.before] + share * given[self.after]


def joined(
    polylines: Polylines, spacing: float, guides: NDArray[np.bool_] | None = None
) -> Joined | None:
    """The strands that are no guides as one line; None where there is one already, or none.

    spacing   the least one on the surface; bridges of a join are GAP of it apart
    """
    if guides is None:
        guides = np.zeros(len(polylines.closed), dtype=bool)
    offsets = np.asarray(polylines.offsets, dtype=np.int64)
    counts = np.diff(offsets)
    grown = np.flatnonzero(~guides & (counts > 1))
    if len(grown) < 2:
        return None
    strands = [
        Strand(
            np.asarray(polylines.positions[offsets[k] : offsets[k + 1]], dtype=np.float64),
            bool(polylines.closed[k]),
            int(offsets[k]),
        )
        for k in grown
    ]
    links = joined_ends(strands)
    joins = joins_of(strands, links, GAP * spacing)
    pieces = _walk(strands, links, joins)
    return _put_together(polylines, guides, grown, strands, pieces)


def described(count: int, length: str) -> str:
    """What to say of bridges: how many, and their length together."""
    return f"joined all strands by {count} bridges, {length} in all"


# ------------------------------------------------------------------------------------------------
# The line


@dataclass(frozen=True)
class _Piece:
    """A stretch of a strand between two cuts, by arc length, and which way the line goes."""

    strand: int
    begin: float
    end: float
    backwards: bool


# A piece of the line before it is walked: the strand and the number of the stretch; an end of it is
# that, and 0 for where it begins or 1 for where it ends.
_End = tuple[int, int, int]


def _walk(
    strands: list[Strand],
    links: list[tuple[End, End]],
    joins: list[Join],
) -> tuple[list[_Piece], bool]:
    """The stretches in the order of the line, and whether that is closed."""
    stretches, cut_ends = _stretches(strands, joins)
    bridges: dict[_End, _End] = {}

    def bridge(one: _End, other: _End) -> None:
        bridges[one], bridges[other] = other, one

    for number, join in enumerate(joins):
        _bridges, alike = join.bridges(strands)
        here, there = cut_ends[number, 0], cut_ends[number, 1]
        for side in (0, 1):
            bridge(here[side], there[side if alike else 1 - side])
    for one, other in links:
        bridge(*((k, (0, len(stretches[k]) - 1)[side], side) for k, side in (one, other)))
    loose = [
        (k, (0, len(stretches[k]) - 1)[side], side)
        for k, strand in enumerate(strands)
        if not strand.closed
        for side in (0, 1)
    ]
    loose = [end for end in loose if end not in bridges]
    start = loose[0] if loose else (0, 0, 0)
    pieces, here = [], start
    while True:
        k, number, side = here
        pieces.append(_Piece(k, *stretches[k][number], backwards=side == 1))
        following = bridges.get((k, number, 1 - side))
        if following is None or following == start:
            return pieces, following is not None
        here = following


def _stretches(
    strands: list[Strand], joins: list[Join]
) -> tuple[list[list[tuple[float, float]]], dict[tuple[int, int], tuple[_End, _End]]]:
    """Of every strand the stretches between its cuts, and for every join and side of it the ends of
    the stretches before and after the cut."""
    stretches: list[list[tuple[float, float]]] = []
    cut_ends: dict[tuple[int, int], tuple[_End, _End]] = {}
    for k, strand in enumerate(strands):
        cuts = sorted(
            (join.arcs[side], join.width, number, side)
            for number, join in enumerate(joins)
            for side in (0, 1)
            if join.strands[side] == k
        )
        if not cuts:
            stretches.append([(0.0, strand.length)])
            continue
        begins = [arc + width / 2.0 for arc, width, _number, _side in cuts]
        ends = [arc - width / 2.0 for arc, width, _number, _side in cuts]
        if strand.closed:
            # The stretch number i begins at cut i.
            stretches.append(list(zip(begins, [*ends[1:], ends[0] + strand.length])))
            for i, (_arc, _width, number, side) in enumerate(cuts):
                cut_ends[number, side] = ((k, (i - 1) % len(cuts), 1), (k, i, 0))
        else:
            stretches.append(list(zip([0.0, *begins], [*ends, strand.length])))
            for i, (_arc, _width, number, side) in enumerate(cuts):
                cut_ends[number, side] = ((k, i, 1), (k, i + 1, 0))
    return stretches, cut_ends


def _points_of(strand: Strand, piece: _Piece) -> NDArray[np.float64]:
    """The points of a stretch, its ends and the strand's own between them, as Strand.at() has
    them."""
    count = len(strand.points)
    # A point that all but coincides with an end would be there twice.
    least = 1e-3 * min(piece.end - piece.begin, strand.length / count)
    turns = (0.0, strand.length) if strand.closed else (0.0,)
    inside = [
        np.flatnonzero((knots > piece.begin + least) & (knots < piece.end - least))
        for turn in turns
        for knots in [strand.knots[:count] + turn]
    ]
    own = np.concatenate(inside)
    points = np.vstack(
        [
            strand.at([piece.begin]),
            np.column_stack([own, own, np.zeros(len(own))]),
            strand.at([piece.end]),
        ]
    )
    return points[::-1] if piece.backwards else points


def _put_together(
    polylines: Polylines,
    guides: NDArray[np.bool_],
    grown: NDArray[np.int64],
    strands: list[Strand],
    walked: tuple[list[_Piece], bool],
) -> Joined:
    pieces, closed = walked
    line, runs = [], []
    for piece in pieces:
        strand = strands[piece.strand]
        points = _points_of(strand, piece)
        runs.append((piece.strand, len(points)))
        line.append(points + [strand.first, strand.first, 0.0])
    offsets = np.asarray(polylines.offsets, dtype=np.int64)
    parts, sources, ends = [], [], []
    number = 0
    for k in range(len(guides)):
        if k == grown[0]:
            number = len(parts)
            parts.append(np.vstack(line))
            ends.append(closed)
        elif k in grown:
            continue
        else:
            own = np.arange(offsets[k], offsets[k + 1])
            parts.append(np.column_stack([own, own, np.zeros(len(own))]))
            ends.append(bool(polylines.closed[k]))
        sources.append(k)
    every = np.vstack(parts)
    before, after, share = every[:, 0].astype(np.int64), every[:, 1].astype(np.int64), every[:, 2]
    begins = np.concatenate([[0], np.cumsum([len(part) for part in parts])])
    curve = Polylines(
        between(polylines.positions, before, after, share),
        unit(between(polylines.normals, before, after, share)),
        begins.astype(np.uint32),
        np.array(ends, dtype=np.uint8),
    )
    own = curve.positions[begins[number] : begins[number + 1]]
    lasts = np.cumsum([count for _strand, count in runs]) - 1
    lasts = lasts if closed else lasts[:-1]
    return Joined(
        curve,
        before,
        after,
        share,
        guides[sources],
        number,
        tuple(runs),
        tuple(strand.closed for strand in strands),
        np.array(sources, dtype=np.int64),
        np.linalg.norm(own[(lasts + 1) % len(own)] - own[lasts], axis=1),
    )


def data_of(line: Joined, data: PointData, mesh: Mesh) -> PointData:
    """What is known of the points of a line, from what is known of the given ones."""
    curve = line.polylines
    arcs, tangents = [], []
    offsets = np.asarray(curve.offsets, dtype=np.int64)
    for begin, end, closed in zip(offsets[:-1], offsets[1:], curve.closed, strict=True):
        points = curve.positions[begin:end]
        steps = np.diff(points, axis=0)
        arcs.append(np.concatenate([[0.0], np.cumsum(np.linalg.norm(steps, axis=1))]))
        around = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
        if not closed:
            around[0], around[-1] = steps[0], steps[-1]
        tangents.append(unit(around))
    faces, weights = data.faces[line.before].copy(), data.barycentrics[line.before].copy()
    new = np.flatnonzero(line.share > 0.0)
    faces[new], weights[new] = holding(
        curve.positions[new],
        data.faces[line.before[new]],
        data.faces[line.after[new]],
        mesh,
    )
    return PointData(
        np.concatenate(arcs),
        curve.normals,
        np.vstack(tangents),
        line.values(data.radii),
        faces,
        weights,
    )


# ------------------------------------------------------------------------------------------------
# Back again


def to_text(line: Joined, with_guides: bool = True) -> str:
    """How to take a line apart again, for parted(): which strand it is, which of the joined ones
    were closed, and runs.

    with_guides   the curve has the guides as strands of their own
    """
    number = line.line if with_guides else 0
    flags = "".join("c" if closed else "o" for closed in line.closed)
    runs = " ".join(f"{strand}:{count}" for strand, count in line.runs)
    return f"{number} {flags} {runs}"


def thinned(text: str, begins: NDArray[np.int64], kept: NDArray[np.int64]) -> str:
    """What to_text() would be of a curve with some of its points only.

    begins   (s,) of the strands of the curve, among its points
    kept     (m,) indices of the points that stay, in order
    """
    number, flags, runs = _read(text)
    ends = begins[number] + np.cumsum([count for _strand, count in runs])
    firsts = np.concatenate([[begins[number]], ends[:-1]])
    counts = np.searchsorted(kept, ends) - np.searchsorted(kept, firsts)
    words = " ".join(f"{strand}:{count}" for (strand, _), count in zip(runs, counts) if count)
    return f"{number} {flags} {words}"


def _read(text: str) -> tuple[int, str, list[tuple[int, int]]]:
    number, flags, *words = text.split()
    pairs = (word.split(":") for word in words)
    return int(number), flags, [(int(strand), int(count)) for strand, count in pairs]


def parted(seed: Seed, text: str) -> tuple[Seed, int, int] | None:
    """The strands of a curve with a line taken apart, without bridges, in the place of the line;
    which of the given strands that was, and how many they are.

    seed   the strands of the curve
    text   of to_text()

    Every strand has its points in their order or backwards, and may begin at another one. None
    where the curve has other points than it had then.
    """
    line, flags, runs = _read(text)
    offsets = np.asarray(seed.offsets, dtype=np.int64)
    if line >= len(seed.closed):
        return None
    points = seed.points[offsets[line] : offsets[line + 1]]
    if sum(count for _strand, count in runs) != len(points):
        return None
    begins = np.concatenate([[0], np.cumsum([count for _strand, count in runs])])
    found: dict[int, list[NDArray[np.float64]]] = {}
    for (strand, _count), begin, end in zip(runs, begins[:-1], begins[1:], strict=True):
        found.setdefault(strand, []).append(points[begin:end])
    strands = [np.vstack(found[strand]) for strand in sorted(found)]
    every = [seed.points[a:b] for a, b in zip(offsets[:-1], offsets[1:])]
    ends = [bool(closed) for closed in seed.closed]
    every[line : line + 1] = strands
    ends[line : line + 1] = [flags[strand] == "c" for strand in sorted(found)]
    return (
        Seed(
            np.vstack(every),
            np.cumsum([0] + [len(part) for part in every]).astype(np.uint32),
            np.array(ends, dtype=np.uint8),
        ),
        line,
        len(strands),
    )
