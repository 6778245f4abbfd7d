# SPDX-License-Identifier: GPL-3.0-or-later
"""Edges put together to chains: of a mesh, or of a curve that was evaluated to one. No bpy."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Chain(NamedTuple):
    """Vertices in order; `closed`: the last goes on to the first, which is not repeated."""

    vertices: list[int]
    closed: bool


def branching(edges: ArrayLike) -> NDArray[np.int64]:
    """The vertices, rising, at which more than two of the edges (n, 2) meet."""
    vertices, counts = np.unique(np.asarray(edges, dtype=np.int64), return_counts=True)
    return vertices[counts > 2]


def chains_of(edges: ArrayLike) -> list[Chain]:
    """The chains that edges (n, 2) form, each edge in one of them, by their least vertices.

    Where more than two edges meet, chains end. A closed chain that has such a vertex begins and
    ends there, and is handed out as an open one whose first and last vertex are the same.
    """
    neighbours: dict[int, list[int]] = {}
    for a, b in np.asarray(edges, dtype=np.int64).reshape(-1, 2).tolist():
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    used: set[tuple[int, int]] = set()
    chains = [
        _walk(neighbours, used, start, following)
        # Ends first: what is then left over is closed.
        for passing in (False, True)
        for start, others in neighbours.items()
        if (len(others) == 2) == passing
        for following in others
        if (start, following) not in used
    ]
    return sorted(chains, key=lambda chain: min(chain.vertices))


def _walk(
    neighbours: dict[int, list[int]], used: set[tuple[int, int]], start: int, following: int
) -> Chain:
    """From a vertex along one of its edges, to an end or to where it began."""
    vertices, here = [start], following
    used |= {(start, here), (here, start)}
    while here != start and len(neighbours[here]) == 2:
        vertices.append(here)
        one, other = neighbours[here]
        there = other if one == vertices[-2] else one
        used |= {(here, there), (there, here)}
        here = there
    if here == start and len(neighbours[start]) == 2:
        return Chain(vertices, True)
    return Chain([*vertices, here], False)
