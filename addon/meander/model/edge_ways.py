# SPDX-License-Identifier: GPL-3.0-or-later
"""Shortest ways along the edges of a mesh, as far as walls let them pass."""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Graph:
    """Neighbours and lengths of vertex v: those from firsts[v] to firsts[v + 1]."""

    firsts: list[int]
    neighbours: list[int]
    lengths: list[float]

    @classmethod
    def of(cls, edges: NDArray[np.int64], lengths: NDArray[np.float64], count: int) -> Graph:
        both = np.vstack([edges, edges[:, ::-1]])
        order = np.lexsort((both[:, 1], both[:, 0]))
        firsts = np.searchsorted(both[order, 0], np.arange(count + 1))
        return cls(
            firsts.tolist(), both[order, 1].tolist(), np.tile(lengths, 2)[order].tolist()
        )


def ways(
    graph: Graph, sources: NDArray[np.int64] | list[int], closed: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], list[int]]:
    """Dijkstra's shortest ways: how long they are, and what comes before each vertex, -1 at their
    beginning.

    closed   where ways may end but not go on, unless they begin there
    """
    lengths = [np.inf] * len(closed)
    before = [-1] * len(closed)
    queue = [(0.0, int(source)) for source in sources]
    begins = {source for _, source in queue}
    for _, source in queue:
        lengths[source] = 0.0
    heapq.heapify(queue)
    while queue:
        length, vertex = heapq.heappop(queue)
        if length > lengths[vertex] or closed[vertex] and vertex not in begins:
            continue
        for place in range(graph.firsts[vertex], graph.firsts[vertex + 1]):
            other, further = graph.neighbours[place], length + graph.lengths[place]
            if further < lengths[other]:
                lengths[other], before[other] = further, vertex
                heapq.heappush(queue, (further, other))
    return np.array(lengths), before


def way_to(vertex: int, before: list[int]) -> NDArray[np.int64]:
    """The way from where ways() begin to a vertex."""
    found = [vertex]
    while before[found[-1]] >= 0:
        found.append(before[found[-1]])
    return np.array(found[::-1])


def common(one: NDArray[np.int64], other: NDArray[np.int64]) -> int:
    """How many vertices two ways have in common at their beginning."""
    count = min(len(one), len(other))
    differ = one[:count] != other[:count]
    return int(np.argmax(differ)) if differ.any() else count
