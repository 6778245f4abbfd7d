# SPDX-License-Identifier: GPL-3.0-or-later
"""Polylines without points that nearly coincide, for what is drawn along them; no bpy.

Where a segment crosses an edge of the mesh close to a node, two points of the exact polyline nearly
coincide. The curve is right there, but a bevel turns so sharply between them that it shows notches.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ... import core
from .blocks import blocks

# Points nearer to each other than this share of the spacing become one: 0.02 r.
MERGED_SHARE = 0.01


def least_spacing(radius: float, density: NDArray[np.float64] | None) -> float:
    """The least spacing on a surface, at a radius r and a density per vertex; None: 1 everywhere"""
    greatest = 1.0 if density is None else float(np.max(density))
    return 2.0 * radius / math.sqrt(greatest)


def kept_points(polylines: core.Polylines, distance: float) -> NDArray[np.int64]:
    """The indices of the points to keep, so that the curve moves by less than `distance`.

    The first point of each strand stays, and of open ones the last; so do two points of every
    strand, and three of a closed one.
    """
    positions = np.asarray(polylines.positions, dtype=np.float64)
    keep = np.ones(len(positions), dtype=bool)
    short = np.empty(max(0, len(positions) - 1), dtype=bool)
    for begin, end in blocks(len(short)):
        steps = np.diff(positions[begin : end + 1], axis=0)
        short[begin:end] = np.linalg.norm(steps, axis=1) < distance
    offsets = np.asarray(polylines.offsets, dtype=np.int64)
    for begin, end, closed in zip(offsets[:-1].tolist(), offsets[1:].tolist(), polylines.closed):
        if begin == end:
            continue
        # Before the end of an open strand, or before the first point of a closed one's next round.
        last = begin if closed else end - 1
        stop = end if closed else end - 1
        while stop > begin + 1 and math.dist(positions[stop - 1], positions[last]) < distance:
            stop -= 1
            keep[stop] = False
        # After every point that stays.
        for anchor in (np.flatnonzero(short[begin : stop - 1]) + begin).tolist():
            point = anchor + 1
            while (
                keep[anchor]
                and point < stop
                and math.dist(positions[anchor], positions[point]) < distance
            ):
                keep[point] = False
                point += 1
        if keep[begin:end].sum() < (3 if closed else 2):
            keep[begin:end] = True
    return np.flatnonzero(keep)


def with_points(polylines: core.Polylines, kept: NDArray[np.int64]) -> core.Polylines:
    """The polylines with some of their points only, whose indices are in order."""
    return core.Polylines(
        polylines.positions.take(kept, axis=0),
        polylines.normals.take(kept, axis=0),
        np.searchsorted(kept, polylines.offsets).astype(polylines.offsets.dtype),
        polylines.closed,
    )
