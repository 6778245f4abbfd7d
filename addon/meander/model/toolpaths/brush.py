# SPDX-License-Identifier: GPL-3.0-or-later
"""Ways in stretches that a brush can draw before it has to be dipped again; no bpy."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..files.whole import FileError
from ..geometry.arcs import Moves

# More are a mistake in the unit.
_MOST_DIPS = 100_000
# What is left of a way where a brush is empty is nothing, if it is a smaller share of a dip.
_NOTHING = 1e-6


class Brush:
    """How much line a brush still has in it; at first none."""

    def __init__(self, every: float) -> None:
        self._every = every
        self._left = 0.0
        self._dips = 0

    def stretches(
        self, way: NDArray[np.float64], moves: Moves | None
    ) -> Iterator[tuple[NDArray[np.float64], Moves | None, bool]]:
        """Stretches of a way, each from where the one before ends, and whether the brush is dipped
        before it.

        way    (n, 3)
        moves  the same as lines and arcs at one height, or None; of stretches that have them the
               way is its first point alone

        Raises FileError for more dips than anybody could want.
        """
        lengths = np.linalg.norm(np.diff(way, axis=0), axis=1) if moves is None else _lengths(moves)
        total, dipped = float(lengths.sum()), self._left <= _NOTHING * self._every
        left = self._every if dipped else self._left
        count = max(0, int(np.ceil((total - left) / self._every - _NOTHING)))
        self._dips += count + dipped
        if self._dips > _MOST_DIPS:
            raise FileError(
                f"The brush would be dipped more than {_MOST_DIPS:,} times; choose a longer way "
                "between dips"
            )
        places = left + self._every * np.arange(count)
        self._left = left + self._every * count - total
        if moves is None:
            parts = ((part, None) for part in _cut_way(way, lengths, places))
        else:
            height = way[0, 2:]
            cut = _cut_moves(moves, lengths, places)
            parts = ((np.concatenate([part.start, height])[None], part) for part in cut)
        for number, (part, part_moves) in enumerate(parts):
            yield part, part_moves, dipped or number > 0


def _lengths(moves: Moves) -> NDArray[np.float64]:
    begins = np.concatenate([moves.start[None], moves.ends[:-1]])
    straight = np.linalg.norm(moves.ends - begins, axis=1)
    return np.where(moves.turns == 0.0, straight, np.abs(moves.turns) * moves.radii)


def _cut_way(
    way: NDArray[np.float64], lengths: NDArray[np.float64], places: NDArray[np.float64]
) -> list[NDArray[np.float64]]:
    """A polyline cut at lengths along it."""
    arcs = np.concatenate([[0.0], np.cumsum(lengths)])
    points = np.column_stack([np.interp(places, arcs, way[:, axis]) for axis in range(3)])
    ends = [0.0, *places.tolist(), np.inf]
    parts = []
    for number, (begin, end) in enumerate(zip(ends, ends[1:], strict=False)):
        inner = way[(arcs > begin) & (arcs < end)]
        first = way[:1] if number == 0 else points[number - 1 : number]
        parts.append(np.concatenate([first, inner, points[number : number + 1]]))
    return parts


def _cut_moves(
    moves: Moves, lengths: NDArray[np.float64], places: NDArray[np.float64]
) -> list[Moves]:
    """Lines and arcs cut at lengths along them."""
    arcs = np.concatenate([[0.0], np.cumsum(lengths)])
    ends = [0.0, *places.tolist(), float(arcs[-1])]
    parts, start = [], moves.start
    for begin, end in zip(ends, ends[1:], strict=False):
        first = int(np.searchsorted(arcs, begin, side="right")) - 1
        last = max(first, int(np.searchsorted(arcs, end, side="left")) - 1)
        first, last = min(first, len(lengths) - 1), min(last, len(lengths) - 1)
        chosen = slice(first, last + 1)
        turns, stops = moves.turns[chosen].copy(), moves.ends[chosen].copy()
        whole = lengths[chosen]
        if end < arcs[last + 1]:
            stops[-1] = _at(moves, arcs, last, end)
        begins = np.maximum(arcs[first : last + 1], begin)
        gone = np.minimum(arcs[first + 1 : last + 2], end) - begins
        turns *= np.divide(gone, whole, out=np.ones(len(whole)), where=whole > 0.0)
        parts.append(Moves(start, stops, moves.centres[chosen], turns))
        start = stops[-1]
    return parts


def _at(moves: Moves, arcs: NDArray[np.float64], move: int, place: float) -> NDArray[np.float64]:
    """The point at a length along all, which lies in a move."""
    share = (place - arcs[move]) / (arcs[move + 1] - arcs[move])
    start = moves.start if move == 0 else moves.ends[move - 1]
    turn = float(moves.turns[move])
    if turn == 0.0:
        return start + share * (moves.ends[move] - start)
    centre, (cosine, sine) = moves.centres[move], (np.cos(share * turn), np.sin(share * turn))
    return centre + np.array([[cosine, -sine], [sine, cosine]]) @ (start - centre)
