# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of a full start along an axis of a sheet or a disc, or round a pipe, but for their turns."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from flows import flow_on
from meander import core

SPACING = 0.1
# Rows count from so far beyond their turns on, in spacings.
BEYOND = 2.0
# How straight they are at 95 places of 100, and how equal their distances, in spacings.
# Rows where each ends beside its own beginning are a little less straight.
BAR = 0.02
BAR_BESIDE_TURNS = 0.04


def evenly(points: np.ndarray) -> np.ndarray:
    """Points along a closed line, a twentieth of the spacing apart."""
    points = np.vstack([points, points[:1]])
    arcs = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    places = np.arange(0.0, arcs[-1], 0.05 * SPACING)
    return np.column_stack([np.interp(places, arcs, values) for values in points.T])


def rows_of(points: np.ndarray) -> list[np.ndarray]:
    """The pieces of a closed line that lead along x, without their turns, sampled evenly."""
    even = evenly(points[:, :2])
    ways = np.gradient(even, axis=0)
    turns = np.abs(ways[:, 0]) < np.cos(np.radians(25.0)) * np.linalg.norm(ways, axis=1)
    reach = int(BEYOND / 0.05)
    straight = np.convolve(turns, np.ones(2 * reach + 1), "same") < 0.5
    ends = np.flatnonzero(np.diff(np.concatenate([[0], straight, [0]])))
    return [even[begin:end] for begin, end in zip(ends[::2], ends[1::2]) if end - begin > reach]


def sheet() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    vertices, faces = geometry.rectangle((-1.0, -1.0), (1.0, 1.0), 30, 30)
    return vertices, faces, np.tile([1.0, 0.0, 0.0], (len(vertices), 1))


def disc(diameter: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    vertices, faces = geometry.disc(30, diameter)
    return vertices, faces, np.tile([1.0, 0.0, 0.0], (len(vertices), 1))


def pipe(length: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of radius .5, with lines round it."""
    vertices, faces = geometry.tube(60, 20, length, 0.5)
    x, y, _z = vertices.T
    return vertices, faces, np.column_stack([-2.0 * y, 2.0 * x, 0.0 * x])


SHAPES = {
    "sheet": sheet,
    "disc of 23 rows": lambda: disc(2.3),
    "disc of 29 rows": lambda: disc(2.9),
    "disc of 40 rows": lambda: disc(4.0),
    "pipe": lambda: pipe(2.0),
    "pipe of 22.5 rows": lambda: pipe(2.25),
    "pipe of 23 rows": lambda: pipe(2.3),
    "pipe of 25 rows": lambda: pipe(2.5),
}


def sharpest(points: np.ndarray) -> float:
    """By how much a closed line turns at most within .3 spacings, in degrees."""
    even = evenly(points)
    before, after = even - np.roll(even, 3, axis=0), np.roll(even, -3, axis=0) - even
    lengths = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    return float(
        np.degrees(np.arccos(np.clip((before * after).sum(axis=1) / lengths, -1, 1))).max()
    )


def gaps_at(x: float, rows: list[np.ndarray]) -> np.ndarray:
    """The distances of rows there, in spacings, but for those over a row that turns there."""
    crossed = [row for row in rows if row[:, 0].min() < x < row[:, 0].max()]
    heights = np.sort([np.interp(x, *row[np.argsort(row[:, 0])].T) for row in crossed])
    steps = np.diff(heights) / SPACING
    return steps[steps < 1.5]


@pytest.mark.parametrize("shape", SHAPES)
def test_rows_are_straight_and_equally_apart(shape: str) -> None:
    vertices, faces, along = SHAPES[shape]()
    asked = {"radius": SPACING / 2, "start": core.Start.FULL, "alignment_weight": 2.0}
    with flow_on((vertices, faces), **asked) as flow:
        flow.set_directions(along)
        assert flow.run() == "converged"
        curve = flow.polylines()
    assert len(curve.closed) == 1
    points = np.asarray(curve.positions)
    assert sharpest(points) < 90.0
    if shape.startswith("pipe"):
        angle = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
        points = np.column_stack([0.5 * angle, points[:, 2]])
    rows = rows_of(points)
    assert sum(map(len, rows)) * 0.05 * SPACING > 15.0
    off = [row[:, 1] - np.polyval(np.polyfit(*row.T, 1), row[:, 0]) for row in rows]
    straight = BAR_BESIDE_TURNS if shape.startswith("pipe") else BAR
    assert np.quantile(np.abs(np.concatenate(off)), 0.95) < straight * SPACING
    gaps = np.concatenate([gaps_at(x, rows) for x in np.linspace(-0.5, 0.5, 11)])
    if shape.startswith("pipe"):
        around = [row + [k * np.pi, 0.0] for row in rows for k in range(-3, 4)]
        gaps = np.concatenate([gaps_at(x, around) for x in np.linspace(0.0, np.pi, 16)])
    assert np.quantile(np.abs(gaps - np.mean(gaps)), 0.95) < BAR
    # A closed line has an even number of rows; what is left over is in their distances.
    width = round(np.ptp(vertices[:, 2 if shape.startswith("pipe") else 1]) / SPACING, 6)
    distance = width / (2.0 * np.ceil((width - 1.0) / 2.0))
    assert abs(np.mean(gaps) - distance) < BAR
    assert abs(np.mean(gaps) - 1.0) < BAR_BESIDE_TURNS or abs(distance - 1.0) > BAR_BESIDE_TURNS
