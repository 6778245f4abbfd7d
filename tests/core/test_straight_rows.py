# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of a full start along an axis of a sheet or a disc, or round a pipe, but for their turns."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from meander import core

SPACING = 0.1
# Rows count from so far beyond their turns on, in spacings.
BEYOND = 2.0
# How straight they are at 95 places of 100, and how equal their distances, in spacings.
BAR = 0.02


def rows_of(points: np.ndarray) -> list[np.ndarray]:
    """The pieces of a closed line that lead along x, without their turns, sampled evenly."""
    points = np.vstack([points, points[:1]])
    arcs = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    places = np.arange(0.0, arcs[-1], 0.05 * SPACING)
    even = np.column_stack([np.interp(places, arcs, points[:, axis]) for axis in range(2)])
    ways = np.gradient(even, axis=0)
    turns = np.abs(ways[:, 0]) < np.cos(np.radians(25.0)) * np.linalg.norm(ways, axis=1)
    reach = int(BEYOND / 0.05)
    straight = np.convolve(turns, np.ones(2 * reach + 1), "same") < 0.5
    ends = np.flatnonzero(np.diff(np.concatenate([[0], straight, [0]])))
    return [even[begin:end] for begin, end in zip(ends[::2], ends[1::2]) if end - begin > reach]


def sheet() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    vertices, faces = geometry.grid(30)
    vertices = 2.0 * (vertices - vertices.mean(axis=0)) / np.ptp(vertices, axis=0).max()
    return vertices, faces, np.tile([1.0, 0.0, 0.0], (len(vertices), 1))


def disc() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of radius 1: the sheet's squares become rings."""
    vertices, faces, along = sheet()
    largest = np.abs(vertices).max(axis=1, keepdims=True)
    away = np.linalg.norm(vertices, axis=1, keepdims=True)
    return vertices * largest / np.maximum(away, 1e-9), faces, along


def pipe() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of radius .5 and length 2, with lines round it."""
    count, rings = 60, 20
    angle, height = np.meshgrid(2.0 * np.pi * np.arange(count) / count, np.linspace(0, 2, rings))
    angle = angle.ravel()
    vertices = np.column_stack([0.5 * np.cos(angle), 0.5 * np.sin(angle), height.ravel()])
    first = np.arange(count * (rings - 1)).reshape(-1, count)
    a, b = first, np.roll(first, -1, axis=1)
    faces = np.stack([a, b, b + count, a, b + count, a + count], axis=-1).reshape(-1, 3)
    return vertices, faces, np.column_stack([-np.sin(angle), np.cos(angle), 0.0 * angle])


def flat_rows(shape: str) -> list[np.ndarray]:
    vertices, faces, along = {"sheet": sheet, "disc": disc, "pipe": pipe}[shape]()
    options = core.default_options("even")
    options.radius, options.start, options.alignment_weight = SPACING / 2, core.Start.FULL, 2.0
    with core.Surface(vertices, faces) as surface, core.Flow(surface, options) as flow:
        flow.set_directions(along)
        assert flow.run() == "converged"
        curve = flow.polylines()
    assert len(curve.closed) == 1
    points = np.asarray(curve.positions)
    if shape == "pipe":
        angle = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
        points = np.column_stack([0.5 * angle, points[:, 2]])
    return rows_of(points)


def off_straight(rows: list[np.ndarray]) -> float:
    """At 95 places of 100, in spacings."""
    off = [row[:, 1] - np.polyval(np.polyfit(*row.T, 1), row[:, 0]) for row in rows]
    return float(np.quantile(np.abs(np.concatenate(off)), 0.95) / SPACING)


@pytest.mark.parametrize("shape", ["disc", "pipe"])
def test_rows_are_straight_beside_any_rim(shape: str) -> None:
    rows = flat_rows(shape)
    assert sum(map(len, rows)) * 0.05 * SPACING > 15.0
    assert off_straight(rows) < BAR


def test_rows_on_a_flat_sheet_are_straight_and_equally_apart() -> None:
    rows = flat_rows("sheet")
    assert len(rows) > 15
    assert off_straight(rows) < BAR
    gaps = []
    for x in np.linspace(-0.5, 0.5, 11):
        crossed = [row for row in rows if row[:, 0].min() < x < row[:, 0].max()]
        heights = np.sort([np.interp(x, *row[np.argsort(row[:, 0])].T) for row in crossed])
        steps = np.diff(heights) / SPACING
        gaps += steps[steps < 1.5].tolist()  # not over a row that turns here
    assert np.quantile(np.abs(np.array(gaps) - np.mean(gaps)), 0.95) < BAR
