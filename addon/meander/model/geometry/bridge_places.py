# SPDX-License-Identifier: GPL-3.0-or-later
"""Where strands are cut open to be joined by bridges: at their nearest places, clear of all else.

No bpy.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .nearest_places import Tree, closest_pair, spanning_tree

# How far the two bridges of a join are apart, in spacings, where strands are long enough for it:
# round tubes of the usual thickness do not touch then.
GAP = 0.5
# A cut takes at most this share of its strand, over the number of cuts in that.
_LARGEST_CUT = 0.25
# The least distance between the middles of two cuts on a strand, in their mean width.
_KEPT_APART = 1.5
# Places to a cut that are tried as well where a strand has few points.
_PLACES = 16
# How often another place is looked for where bridges would come too near to something else.
_TRIES = 12
# How near they may come, in widths of the cut.
_CLEARANCE = 0.2

# An end of a strand: which strand, and 0 for its first point or 1 for its last.
End = tuple[int, int]


class Strand:
    """A strand by arc length."""

    def __init__(self, points: NDArray[np.float64], closed: bool, first: int) -> None:
        self.points, self.closed, self.first = points, closed, first
        ring = np.vstack([points, points[:1]]) if closed else points
        lengths = np.linalg.norm(np.diff(ring, axis=0), axis=1)
        self.knots = np.concatenate([[0.0], np.cumsum(lengths)])
        self.length = float(self.knots[-1])
        self.cuts: list[tuple[float, float]] = []  # middle and width

    def at(self, arcs: ArrayLike) -> NDArray[np.float64]:
        """Of places (n,) the points before and after each, of this strand, and how far it is from
        the one to the other: (n, 3)."""
        arcs = np.asarray(arcs, dtype=np.float64)
        if self.closed:
            arcs = arcs % self.length
        pieces = np.searchsorted(self.knots, arcs, side="right") - 1
        pieces = np.clip(pieces, 0, len(self.knots) - 2)
        lengths = self.knots[pieces + 1] - self.knots[pieces]
        shares = np.zeros(len(arcs))
        np.divide(arcs - self.knots[pieces], lengths, out=shares, where=lengths > 0.0)
        following = (pieces + 1) % len(self.points)
        return np.column_stack([pieces, following, np.clip(shares, 0.0, 1.0)])

    def positions(self, arcs: ArrayLike) -> NDArray[np.float64]:
        """Of places (n,), in space: (n, 3)."""
        found = self.at(arcs)
        before, after = found[:, 0].astype(np.int64), found[:, 1].astype(np.int64)
        return between(self.points, before, after, found[:, 2])

    def places(self, count: int) -> NDArray[np.float64]:
        """Arc lengths at which a cut may be: of the points, and `count` more."""
        own = self.knots[: len(self.points)]
        more = np.linspace(0.0, self.length, count, endpoint=False)
        return np.unique(np.concatenate([own, more]))

    def outside(self, arc: float, reach: float) -> list[NDArray[np.float64]]:
        """What is farther than `reach` along the strand from a place: (n, 3) positions in order,
        of one stretch of a closed strand and of the two of an open one."""
        if self.closed:
            bounds = [(arc + reach, arc - reach + self.length)]
        else:
            bounds = [(0.0, arc - reach), (arc + reach, self.length)]
        own = self.knots[: len(self.points)]
        knots = np.concatenate([own, own + self.length]) if self.closed else own
        return [
            self.positions(np.concatenate([[begin], knots[(knots > begin) & (knots < end)], [end]]))
            for begin, end in bounds
            if begin < end
        ]

    def distances(self, arcs: NDArray[np.float64], arc: float) -> NDArray[np.float64]:
        """Along the strand."""
        apart = np.abs(arcs - arc)
        return np.minimum(apart, self.length - apart) if self.closed else apart

    def free(self, arcs: NDArray[np.float64], width: float) -> NDArray[np.bool_]:
        """At which places a cut of this width keeps away from other cuts, and from ends."""
        free = np.ones(len(arcs), dtype=bool)
        for middle, other in self.cuts:
            free &= self.distances(arcs, middle) >= _KEPT_APART * (width + other) / 2.0
        if not self.closed:
            least = _KEPT_APART * width / 2.0
            free &= (arcs >= least) & (arcs <= self.length - least)
        return free


@dataclass(frozen=True)
class Join:
    """Two strands, where each is cut, and how wide."""

    strands: tuple[int, int]
    arcs: tuple[float, float]
    width: float

    def ends(self, strands: list[Strand], side: int) -> NDArray[np.float64]:
        """The two ends of one of the cuts, (2, 3): before it and after it."""
        strand, arc = strands[self.strands[side]], self.arcs[side]
        return strand.positions([arc - self.width / 2.0, arc + self.width / 2.0])

    def bridges(self, strands: list[Strand]) -> tuple[NDArray[np.float64], bool]:
        """Both bridges, (2, 2, 3), from the ends of the first cut, and whether they go from the one
        before it to the one before the other: whatever is shorter, so that they do not cross."""
        here, there = self.ends(strands, 0), self.ends(strands, 1)
        straight = np.linalg.norm(here - there, axis=1).sum()
        crossed = np.linalg.norm(here - there[::-1], axis=1).sum()
        alike = bool(straight < crossed)
        return np.stack([here, there if alike else there[::-1]], axis=1), alike


def joined_ends(strands: list[Strand]) -> list[tuple[End, End]]:
    """The bridges that make one line of the open strands: nearest ends first. Each end is a strand
    and 0 for its first point, 1 for its last."""
    ends = [(k, side) for k, strand in enumerate(strands) if not strand.closed for side in (0, 1)]
    if len(ends) < 4:
        return []
    places = np.array([strands[k].points[-side] for k, side in ends])
    first, second = np.triu_indices(len(ends), 1)
    lengths = np.linalg.norm(places[first] - places[second], axis=1)
    tree, used, links = Tree(len(strands)), set(), []
    for pair in np.argsort(lengths, kind="stable").tolist():
        one, other = ends[first[pair]], ends[second[pair]]
        if one not in used and other not in used and tree.join(one[0], other[0]):
            used |= {one, other}
            links.append((one, other))
    return links


def joins_of(
    strands: list[Strand],
    links: list[tuple[End, End]],
    width: float,
) -> list[Join]:
    """Where the tree of nearest places cuts strands open, shortest joins first."""
    together = [(one[0], other[0]) for one, other in links]
    pairs = spanning_tree([strand.points for strand in strands], together)
    degrees = np.bincount(np.array(pairs, dtype=np.int64).ravel(), minlength=len(strands))
    joins: list[Join] = []
    around = _Surroundings(strands, [[_end(strands, a), _end(strands, b)] for a, b in links])
    for one, other in pairs:
        widest = min(
            _LARGEST_CUT * strands[k].length / (degrees[k] + (not strands[k].closed))
            for k in (one, other)
        )
        join = _place(strands, (one, other), degrees, min(width, widest), around)
        joins.append(join)
        for side, k in enumerate(join.strands):
            strands[k].cuts.append((join.arcs[side], join.width))
        around.add(join)
    return joins


def _end(strands: list[Strand], end: tuple[int, int]) -> NDArray[np.float64]:
    return strands[end[0]].points[-end[1]]


def _place(
    strands: list[Strand],
    pair: tuple[int, int],
    degrees: NDArray[np.int64],
    width: float,
    around: _Surroundings,
) -> Join:
    """The nearest places of two strands at which their bridges are clear of everything else; of
    those that were tried, the first where none is."""
    arcs, free = [], []
    for k in pair:
        places = strands[k].places(_PLACES * (int(degrees[k]) + 1))
        arcs.append(places)
        free.append(strands[k].free(places, width))
    best: Join | None = None
    for _ in range(_TRIES):
        if not (free[0].any() and free[1].any()):
            break
        chosen = [np.flatnonzero(flags) for flags in free]
        points = [strands[k].positions(arcs[side][chosen[side]]) for side, k in enumerate(pair)]
        one, other, _distance = closest_pair(*points)
        here, there = chosen[0][one], chosen[1][other]
        join = Join(pair, (float(arcs[0][here]), float(arcs[1][there])), width)
        best = best or join
        if around.leave_clear(join):
            return join
        for side, k in enumerate(pair):
            free[side] &= strands[k].distances(arcs[side], join.arcs[side]) >= width
    assert best is not None  # cuts are so narrow that there is always room for one more
    return best


class _Surroundings:
    """What bridges have to keep clear of: strands, and other bridges."""

    def __init__(self, strands: list[Strand], bridges: list[list[NDArray[np.float64]]]) -> None:
        self._strands = strands
        self._low = np.array([strand.points.min(axis=0) for strand in strands])
        self._high = np.array([strand.points.max(axis=0) for strand in strands])
        self._bridges = np.array(bridges, dtype=np.float64).reshape(-1, 2, 3)

    def add(self, join: Join) -> None:
        self._bridges = np.concatenate([self._bridges, join.bridges(self._strands)[0]])

    def leave_clear(self, join: Join) -> bool:
        """Whether the bridges of a join come near to no other bridge, and to no strand but at the
        cuts that they belong to."""
        own, _alike = join.bridges(self._strands)
        least = _CLEARANCE * join.width
        if _comes_near(own, self._bridges[:, 0], self._bridges[:, 1], least):
            return False
        low, high = own.min(axis=(0, 1)) - least, own.max(axis=(0, 1)) + least
        near = np.flatnonzero(np.all((self._low <= high) & (self._high >= low), axis=1))
        return not any(self._is_met(join, own, int(k)) for k in near)

    def _is_met(self, join: Join, own: NDArray[np.float64], k: int) -> bool:
        strand = self._strands[k]
        if k not in join.strands:
            begins, ends = strand.points, np.roll(strand.points, -1, axis=0)
            if not strand.closed:
                begins, ends = begins[:-1], ends[:-1]
            return _comes_near(own, begins, ends, _CLEARANCE * join.width)
        # A strand that is cut comes near to its bridges' ends, and leaves them at some angle.
        arc = join.arcs[join.strands.index(k)]
        return any(
            _comes_near(own, places[:-1], places[1:], clearance * join.width)
            for reach, clearance in ((1.0, _CLEARANCE), (0.6, 0.03))
            for places in strand.outside(arc, reach * join.width)
        )


def _comes_near(
    bridges: NDArray[np.float64],
    begins: NDArray[np.float64],
    ends: NDArray[np.float64],
    least: float,
) -> bool:
    """Whether straight pieces, from (n, 3) to (n, 3), come so near to bridges (2, 2, 3)."""
    return len(begins) > 0 and any(
        _nearest_pieces(bridge, begins, ends, least) < least for bridge in bridges
    )


def _nearest_pieces(
    bridge: NDArray[np.float64],
    begins: NDArray[np.float64],
    ends: NDArray[np.float64],
    least: float,
) -> float:
    """The distance of a straight piece (2, 3) from the nearest of many (n, 3) to (n, 3), where that
    is less than `least`."""
    middle, reach = bridge.mean(axis=0), np.linalg.norm(bridge[1] - bridge[0])
    lengths = np.linalg.norm(ends - begins, axis=1)
    near = np.linalg.norm(begins - middle, axis=1) <= reach + lengths + least
    if not near.any():
        return np.inf
    begins, ends = begins[near], ends[near]
    u, v, w = bridge[1] - bridge[0], ends - begins, bridge[0] - begins
    uu, uv, vv = float(u @ u), v @ u, (v * v).sum(axis=1)
    uw, vw = w @ u, (v * w).sum(axis=1)
    determinant = uu * vv - uv * uv
    tiny = np.finfo(float).tiny
    s = np.where(determinant > 1e-12 * uu * vv, (uv * vw - vv * uw) / (determinant + tiny), 0.0)
    # Ericson 2005, Real-Time Collision Detection, 5.1.9.
    t = np.clip((uv * np.clip(s, 0.0, 1.0) + vw) / (vv + tiny), 0.0, 1.0)
    s = np.clip((uv * t - uw) / (uu + tiny), 0.0, 1.0)
    apart = w + s[:, None] * u - t[:, None] * v
    return float(np.linalg.norm(apart, axis=1).min())


def between(
    values: NDArray[np.float64],
    before: NDArray[np.int64],
    after: NDArray[np.int64],
    share: NDArray[np.float64],
) -> NDArray[np.float64]:
    values = np.asarray(values, dtype=np.float64)
    found = (1.0 - share)[:, None] * values[before] + share[:, None] * values[after]
    # A point itself to the last bit.
    return np.where((share == 0.0)[:, None], values[before], found)
