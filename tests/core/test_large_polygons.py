# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons of tens of thousands of corners, as of traced logos and maps: one part, all its area."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from meander import core
from meander.model.preparation import Repair

CORNERS = 40_000

CASES: list[Callable[[], np.ndarray]] = []  # corners (n, 2), counter-clockwise


def case(make: Callable[[], np.ndarray]) -> Callable[[], np.ndarray]:
    CASES.append(make)
    return make


def polar(radius: Callable[[np.ndarray], np.ndarray], count: int = CORNERS) -> np.ndarray:
    turn = np.arange(count) * 2 * np.pi / count
    return np.stack([radius(turn) * np.cos(turn), radius(turn) * np.sin(turn)], axis=1)


def along(corners: list[tuple], count: int = CORNERS) -> np.ndarray:
    """Points at equal steps along a closed line of straight pieces."""
    line = np.array([*corners, corners[0]], dtype=float)
    lengths = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    steps = np.arange(count) * lengths[-1] / count
    return np.stack([np.interp(steps, lengths, line[:, k]) for k in range(2)], axis=1)


@case
def waves() -> np.ndarray:
    return polar(lambda t: 1 + 0.2 * np.sin(37 * t))


@case
def more_waves() -> np.ndarray:
    return polar(lambda t: 1 + 0.2 * np.sin(37 * t), 70_000)


@case
def teeth() -> np.ndarray:
    return polar(lambda t: 1 + 0.2 * np.sin(37 * t) + 0.05 * (np.arange(len(t)) % 2))


@case
def a_square_of_many_points() -> np.ndarray:
    return along([(0, 0), (1, 0), (1, 1), (0, 1)])


@case
def a_letter() -> np.ndarray:
    return along([(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (3, 2), (3, 3), (0, 3)])


@case
def a_rounded_square() -> np.ndarray:
    return polar(lambda t: (np.cos(t) ** 8 + np.sin(t) ** 8) ** -0.125)


@case
def a_coast() -> np.ndarray:
    generator = np.random.default_rng(5)
    waves, phases = 2 ** np.arange(1, 12), generator.uniform(0, 6, 11)
    return polar(lambda t: 1 + sum(0.2 / w * np.sin(w * t + p) for w, p in zip(waves, phases)))


@case
def a_band() -> np.ndarray:
    turn = np.linspace(0, 1.8 * np.pi, CORNERS // 2)
    way = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    return np.concatenate([1.2 * way, 0.9 * way[::-1]])


@case
def a_spiral_saw() -> np.ndarray:
    """A band between two spirals, with a saw's teeth outside."""
    turn = np.linspace(0, 5 * np.pi, CORNERS // 2)
    way = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    inner, outer = 1.0 + 0.1 * turn, 1.3 + 0.1 * turn + 0.02 * (np.arange(len(turn)) % 2)
    return np.concatenate([outer[:, None] * way, (inner[:, None] * way)[::-1]])


@case
def a_flower() -> np.ndarray:
    return polar(lambda t: 0.3 + np.abs(np.cos(2.5 * t)), 50_000)


def of_ends(across: float, power: float = 1.0) -> np.ndarray:
    """A convex outline whose ends, left and right or at corners, have the flattest ears."""
    turn = np.arange(CORNERS) * 2 * np.pi / CORNERS
    sides = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    return np.sign(sides) * np.abs(sides) ** power * [across, 1.0]


@case
def a_circle() -> np.ndarray:
    return of_ends(1.0)


@case
def an_egg() -> np.ndarray:
    egg = of_ends(1.0)
    return egg * np.stack([1.0 + 0.2 * egg[:, 1], np.full(len(egg), 1.3)], axis=1)


@case
def a_drop() -> np.ndarray:
    drop = of_ends(1.0)
    return drop * np.stack([1.0 - drop[:, 1], np.full(len(drop), 1.5)], axis=1)


def area(points: np.ndarray) -> float:
    x, y = points.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


@pytest.mark.parametrize("make", CASES, ids=lambda make: make.__name__)
def test_a_polygon_stays_in_one_piece(make: Callable[[], np.ndarray]) -> None:
    points = np.round(make(), 9)  # as files have them
    tilted = np.stack([points[:, 0], 0.8 * points[:, 1], 0.6 * points[:, 1]], axis=1)
    corners = np.arange(len(points), dtype=np.uint32)
    faces, polygons = core.triangulated(tilted, corners, [len(points)])
    assert len(faces) == len(points) - 2
    a, b, c = tilted[faces].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    assert (normals @ [0.0, -0.6, 0.8] >= -1e-15).all()
    assert 0.5 * np.linalg.norm(normals, axis=1).sum() == pytest.approx(area(points), rel=1e-9)
    with core.Surface(tilted, faces, Repair().options(tilted, 0.05, polygons)) as surface:
        figures = surface.statistics()
    assert (figures["components"], figures["boundary_loops"]) == (1, 1)
    assert figures["area"] == pytest.approx(area(points), rel=1e-6)


@pytest.mark.parametrize("power", [0.5, 0.7])
def test_places_in_single_precision_stay_in_one_piece(power: float) -> None:
    """Rounding makes bays that are as flat as the ears."""
    places = np.column_stack([of_ends(1.0, power), np.zeros(CORNERS)]).astype(np.float32)
    faces, polygons = core.triangulated(places, np.arange(CORNERS), [CORNERS])
    with core.Surface(places, faces, Repair().options(places, 0.05, polygons)) as surface:
        figures = surface.statistics()
    assert (figures["components"], figures["boundary_loops"]) == (1, 1)
    assert figures["area"] == pytest.approx(area(places[:, :2].astype(float)), rel=1e-6)


def test_a_hole_stays_a_hole() -> None:
    """A rim and a hole of 20,000 corners each, joined by a bridge."""
    rim, hole = polar(lambda t: 1.0 + 0.1 * np.sin(5 * t), 20_000), polar(lambda t: 0.5, 20_000)
    points = np.concatenate([rim, hole])
    polygon = [*range(20_000), 0, *range(20_000, 40_000)[:1], *range(39_999, 19_999, -1)]
    vertices = np.column_stack([points, np.zeros(len(points))])
    faces, polygons = core.triangulated(vertices, polygon, [len(polygon)])
    with core.Surface(vertices, faces, Repair().options(vertices, 0.05, polygons)) as surface:
        figures = surface.statistics()
    assert (figures["components"], figures["boundary_loops"]) == (1, 2)
    assert figures["area"] == pytest.approx(area(rim) - area(hole), rel=1e-6)


def test_what_has_no_slivers_is_divided_as_blender_does() -> None:
    """The tips of a star of 16 corners are its ears."""
    turn = np.arange(16) * np.pi / 8
    radius = np.where(np.arange(16) % 2, 1.0, 0.5)
    star = np.stack([radius * np.cos(turn), radius * np.sin(turn), 0 * turn], axis=1)
    faces, _ = core.triangulated(star, np.arange(16), [16])
    tips = [set(face) for face in faces.tolist()]
    assert sum({k - 1, k, (k + 1) % 16} in tips for k in range(1, 16, 2)) >= 7
