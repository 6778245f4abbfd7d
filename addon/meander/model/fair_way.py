# SPDX-License-Identifier: GPL-3.0-or-later
"""A way along the edges of a cut without their corners, on the surface and clear of walls."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import core

# In spacings: how far apart points are, and over which length each is averaged, how often.
_STEP, _LENGTH, _ROUNDS = 0.05, 0.1, 10
# In spacings: a place may come nearer to a wall by _NEARER, and anywhere that is as far as _CLEAR.
# Where the way is nearer to the line than that it passes a gap, and goes no farther aside than
# _ASIDE.
_NEARER, _CLEAR, _ASIDE = 0.02, 0.25, 0.08


def fair_way(
    points: NDArray[np.float64], cut: core.CutSurface, spacing: float
) -> NDArray[np.float64]:
    """A way through a maze, (n, 3), averaged again and again over a share of a corridor, each place
    as long as it keeps clear of walls. Its ends stay."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    count = int(np.ceil(at[-1] / (_STEP * spacing)))
    if count < 2:
        return points
    places = np.linspace(0.0, at[-1], count + 1)
    way = np.column_stack([np.interp(places, at, points[:, axis]) for axis in range(3)])
    away = _on_surface(way, cut)[1]
    least = np.minimum(away - _NEARER * spacing, _CLEAR * spacing)
    most_aside = np.where(away < _CLEAR * spacing, _ASIDE, np.inf) * spacing
    fair = way
    for _ in range(_ROUNDS):
        further, found = _on_surface(_mean(fair, _LENGTH / _STEP), cut)
        kept = (found >= least) & (np.linalg.norm(further - way, axis=1) <= most_aside)
        fair = np.where(kept[:, None], further, fair)
    return fair


def _mean(points: NDArray[np.float64], width: float) -> NDArray[np.float64]:
    """Each point as a mean of its neighbours, as a bell of this width, in points. Beyond an end
    they go on as they come, turned about it, so that it stays."""
    reach = min(int(np.ceil(3.0 * width)), len(points) - 1)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / width) ** 2)
    before = 2.0 * points[0] - points[reach:0:-1]
    after = 2.0 * points[-1] - points[-2 : -reach - 2 : -1]
    longer = np.vstack([before, points, after])
    columns = [np.convolve(longer[:, axis], weights, "valid") for axis in range(3)]
    return np.column_stack(columns) / weights.sum()


def _on_surface(
    points: NDArray[np.float64], cut: core.CutSurface
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The nearest places of the surface, and how far these are from the line."""
    found = core.find_closest(cut.positions, cut.faces, points)
    corners = cut.faces[found.faces]
    places = (cut.positions[corners] * found.weights[:, :, None]).sum(axis=1)
    return places, (cut.distances[corners] * found.weights).sum(axis=1)
