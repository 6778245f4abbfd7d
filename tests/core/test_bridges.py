# SPDX-License-Identifier: GPL-3.0-or-later
"""One line of several strands, judged by brute force: nearest places, trees, crossings."""

from __future__ import annotations

import itertools

import geometry
import numpy as np
import pytest
from conftest import polylines
from meander import core
from meander.model.geometry.nearest_places import closest_pair, spanning_tree
from meander.model.toolpaths import bridges

SPACING = 0.2


def ring(x: float, y: float, radius: float, count: int = 40, turn: float = 0.0) -> np.ndarray:
    angles = turn + 2 * np.pi * np.arange(count) / count
    return np.column_stack(
        [x + radius * np.cos(angles), y + radius * np.sin(angles), np.zeros(count)]
    )


def checked(curve: core.Polylines, guides: np.ndarray | None = None) -> bridges.Joined:
    """Joins the strands, and checks what has to hold for every line."""
    line = bridges.joined(curve, SPACING, guides)
    count = int((~guides).sum()) if guides is not None else len(curve.closed)
    grown = np.ones(len(curve.closed), bool) if guides is None else ~guides
    opened = int((curve.closed[grown] == 0).sum())
    assert len(line.polylines.closed) == len(curve.closed) - count + 1
    assert line.polylines.closed[line.line] == (opened == 0)
    # Two bridges a join, one between ends.
    assert len(line.bridge_lengths) == 2 * (count - max(opened, 1)) + max(opened - 1, 0)
    # No point is there twice.
    positions = line.polylines.positions
    gaps = np.linalg.norm(positions[:, None] - positions[None], axis=2)
    np.fill_diagonal(gaps, np.inf)
    assert gaps.min() > 1e-6
    # Points are given ones to the last bit, or on a piece between two that follow each other.
    given = curve.positions
    whole = line.share == 0.0
    assert np.array_equal(positions[whole], given[line.before[whole]])
    between = (1 - line.share)[:, None] * given[line.before] + line.share[:, None] * given[
        line.after
    ]
    assert np.allclose(positions, between, atol=1e-12)
    # What is missing is short: cut out at the joins.
    lost = np.setdiff1d(np.arange(len(given)), line.before[whole])
    for point in lost:
        new = np.linalg.norm(positions[~whole] - given[point], axis=1)
        assert new.min() <= bridges.GAP * SPACING
    again = bridges.joined(curve, SPACING, guides)
    assert again.polylines.positions.tobytes() == positions.tobytes()
    return line


def test_nearest_places_are_those_of_all_pairs() -> None:
    random = np.random.default_rng(1)
    for _ in range(30):
        one = random.random((int(random.integers(1, 300)), 3))
        other = random.random((int(random.integers(1, 300)), 3)) + random.random(3)
        distances = np.linalg.norm(one[:, None] - other[None], axis=2)
        i, j, distance = closest_pair(one, other)
        assert distance == distances.min()
        assert (i, j) == divmod(int(np.argmin(distances)), len(other))


def test_the_tree_is_the_shortest_of_all() -> None:
    random = np.random.default_rng(2)
    for _ in range(10):
        sets = [random.random((20, 3)) * 0.3 + 2 * random.random(3) for _ in range(5)]
        length = {
            (a, b): closest_pair(sets[a], sets[b])[2]
            for a, b in itertools.combinations(range(5), 2)
        }
        pairs = spanning_tree(sets)
        assert [length[pair] for pair in pairs] == sorted(length[pair] for pair in pairs)
        best = min(
            sum(length[pair] for pair in chosen)
            for chosen in itertools.combinations(length, 4)
            if joins_all(chosen, 5)
        )
        assert sum(length[pair] for pair in pairs) == pytest.approx(best, rel=1e-12)


def joins_all(pairs, count: int) -> bool:
    reached = {0}
    for _ in range(count):
        reached |= {b for a, b in pairs if a in reached} | {a for a, b in pairs if b in reached}
    return len(reached) == count


def test_rings_become_one_line_without_crossings() -> None:
    random = np.random.default_rng(4)
    for _ in range(20):
        rings: list[tuple[float, float, float]] = []
        while len(rings) < 6:
            x, y, radius = 6 * random.random(), 6 * random.random(), 0.2 + 0.8 * random.random()
            if all(np.hypot(x - a, y - b) > radius + r + 0.05 for a, b, r in rings):
                rings.append((x, y, radius))
        curve = polylines(
            *(
                (ring(*place, turn=random.random())[:: int(random.choice([-1, 1]))], True)
                for place in rings
            )
        )
        line = checked(curve)
        assert geometry.plane_crossings(*geometry.ends_of(line.polylines)) == 0
        # Bridges lie beside the nearest places, of a tree that is the shortest.
        sets = [curve.positions[a:b] for a, b in zip(curve.offsets[:-1], curve.offsets[1:])]
        tree = sum(closest_pair(sets[a], sets[b])[2] for a, b in spanning_tree(sets))
        assert line.bridge_lengths.sum() < 2 * tree + 5 * SPACING


def test_many_bridges_on_one_ring_keep_apart_and_small_rings_are_cut_little() -> None:
    # Petals that all come nearest to the middle at places close together, and specks.
    petals = [ring(0.9 * np.cos(a), 0.9 * np.sin(a), 0.25, 30) for a in np.arange(8) * np.pi / 4]
    specks = [ring(0.62 * np.cos(a), 0.62 * np.sin(a), 0.01, 3) for a in (0.4, 2.0, 3.6)]
    curve = polylines((ring(0, 0, 0.5, 12), True), *((line, True) for line in petals + specks))
    line = checked(curve)
    assert geometry.plane_crossings(*geometry.ends_of(line.polylines)) == 0
    taken = core.Polylines(*line.polylines[:3], line.polylines.closed)
    for length in np.diff(taken.offsets):
        assert length > 3


def test_open_strands_make_an_open_line_and_guides_stay_out() -> None:
    lines = [
        (np.column_stack([np.linspace(0, 2, 30), np.full(30, y), np.zeros(30)]), False)
        for y in (0.0, 0.5, 1.0)
    ]
    wall = (np.array([[-1.0, 2.0, 0.0], [3.0, 2.0, 0.0]]), False)
    curve = polylines(wall, lines[0], (ring(1, 1.6, 0.4), True), lines[1], lines[2])
    guides = np.array([True, False, False, False, False])
    line = checked(curve, guides)
    assert line.guides.tolist() == [True, False] and line.line == 1
    assert line.sources.tolist() == [0, 1]
    assert np.array_equal(line.polylines.positions[:2], wall[0])
    assert geometry.plane_crossings(*geometry.ends_of(line.polylines)) == 0
    # End to end, then the ring by two more.
    assert sorted(np.round(line.bridge_lengths, 2))[-2:] == [0.5, 0.5]


def test_one_strand_needs_no_bridge() -> None:
    assert bridges.joined(polylines((ring(0, 0, 1), True)), SPACING) is None


def test_a_line_taken_apart_has_the_strands_again() -> None:
    lines = [(ring(0, 0, 1), True), (ring(2.2, 0, 1)[::-1], True), (ring(4.4, 0.3, 1), True)]
    lines.append((np.array([[0.0, 1.3, 0.0], [1.0, 1.3, 0.0], [2.0, 1.3, 0.0]]), False))
    for curve in (polylines(*lines[:3]), polylines(*lines)):
        line = bridges.joined(curve, SPACING)
        text = bridges.to_text(line)
        seed = core.Seed(line.polylines.positions, line.polylines.offsets, line.polylines.closed)
        apart, number, count = bridges.parted(seed, text)
        assert (number, count) == (0, len(curve.closed))
        assert apart.closed.tolist() == curve.closed.tolist()
        for k, closed in enumerate(curve.closed):
            own = apart.points[apart.offsets[k] : apart.offsets[k + 1]]
            given = curve.positions[curve.offsets[k] : curve.offsets[k + 1]]
            kept = [i for i, point in enumerate(given) if (own == point).all(axis=1).any()]
            assert len(kept) >= len(given) - 6
            places = [int(np.flatnonzero((own == given[i]).all(axis=1))[0]) for i in kept]
            steps = np.diff(places)
            # In their order or backwards, once round.
            if closed:
                steps = np.append(steps, places[0] - places[-1])
            assert min((steps < 0).sum(), (steps > 0).sum()) <= 1
        # Of a line with every third point only, as of a light result, likewise.
        kept = np.arange(1, len(seed.points), 3)
        few = core.Seed(seed.points[kept], np.array([0, len(kept)], np.uint32), seed.closed)
        fewer, _number, _count = bridges.parted(few, bridges.thinned(text, np.zeros(1, int), kept))
        for k in range(len(curve.closed)):
            own, all_own = (
                part.points[part.offsets[k] : part.offsets[k + 1]] for part in (fewer, apart)
            )
            assert 0.2 * len(all_own) < len(own) < 0.5 * len(all_own)
            assert all((all_own == point).all(axis=1).any() for point in own)
        seed.points = seed.points[:-1]
        seed.offsets = np.array([0, len(seed.points)], dtype=np.uint32)
        assert bridges.parted(seed, text) is None
