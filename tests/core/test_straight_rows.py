# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of a full start along an axis of a flat sheet, but for their turns."""

from __future__ import annotations

import geometry
import numpy as np
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


def test_rows_on_a_flat_sheet_are_straight_and_equally_apart() -> None:
    vertices, faces = geometry.grid(30)
    vertices = 2.0 * (vertices - vertices.min(axis=0)) / np.ptp(vertices, axis=0).max()
    options = core.default_options("even")
    options.radius, options.start, options.alignment_weight = SPACING / 2, core.Start.FULL, 2.0
    with core.Surface(vertices, faces) as surface, core.Flow(surface, options) as flow:
        flow.set_directions(np.tile([1.0, 0.0, 0.0], (len(vertices), 1)))
        assert flow.run() == "converged"
        curve = flow.polylines()
    assert len(curve.closed) == 1
    rows = rows_of(np.asarray(curve.positions))
    assert len(rows) > 15
    off = [row[:, 1] - np.polyval(np.polyfit(*row.T, 1), row[:, 0]) for row in rows]
    assert np.quantile(np.abs(np.concatenate(off)), 0.95) < BAR * SPACING
    gaps = []
    for x in np.linspace(0.5, 1.5, 11):
        crossed = [row for row in rows if row[:, 0].min() < x < row[:, 0].max()]
        heights = np.sort([np.interp(x, *row[np.argsort(row[:, 0])].T) for row in crossed])
        steps = np.diff(heights) / SPACING
        gaps += steps[steps < 1.5].tolist()  # not over a row that turns here
    assert np.quantile(np.abs(np.array(gaps) - np.mean(gaps)), 0.95) < BAR
