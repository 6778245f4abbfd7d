# SPDX-License-Identifier: GPL-3.0-or-later
"""Edges put together to chains, judged by counting the edges again."""

from __future__ import annotations

import numpy as np
from meander.model.geometry.chains import Chain, branching, chains_of


def sides_of(chain: Chain) -> list[tuple[int, int]]:
    ends = [*chain.vertices[1:], *([chain.vertices[0]] if chain.closed else [])]
    return [(min(a, b), max(a, b)) for a, b in zip(chain.vertices, ends)]


def test_every_edge_is_in_one_chain_and_chains_end_where_edges_branch() -> None:
    random = np.random.default_rng(3)
    for _ in range(200):
        count = int(random.integers(4, 14))
        pairs = [(a, b) for a in range(count) for b in range(a)]
        edges = random.permutation(pairs)[: int(random.integers(1, 16))]
        edges = np.where(random.random(len(edges))[:, None] < 0.5, edges, edges[:, ::-1])
        chains = chains_of(edges)
        walked = sorted(side for chain in chains for side in sides_of(chain))
        assert walked == sorted((min(a, b), max(a, b)) for a, b in edges.tolist())
        degrees = np.bincount(edges.ravel(), minlength=count)
        assert branching(edges).tolist() == np.flatnonzero(degrees > 2).tolist()
        for vertices, closed in chains:
            inner = vertices if closed else vertices[1:-1]
            assert all(degrees[vertex] == 2 for vertex in inner)
            if not closed:
                assert degrees[vertices[0]] != 2 and degrees[vertices[-1]] != 2
        firsts = [min(chain.vertices) for chain in chains]
        assert firsts == sorted(firsts)


def test_a_loop_is_closed_and_a_path_keeps_its_order() -> None:
    assert chains_of([[3, 4], [4, 5], [5, 3], [0, 1], [2, 1]]) == [
        Chain([0, 1, 2], False),
        Chain([3, 4, 5], True),
    ]
