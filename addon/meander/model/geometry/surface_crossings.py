# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a curve of few points crosses itself, as seen along the normals of its surface; no bpy.

The curve of a run never crosses itself. Chords between points far from one another may, where they
cut corners. They lie beside the surface, so two of them cross where they are near each other, on
one sheet, and cross in the plane on which the mean of their normals stands.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...core import Polylines
from .flat_crossings import crossing_shares
from .near_chords import pairs_within

# Chords this near to each other are looked at, in spacings: neighbours on one sheet are one apart.
_NEAR = 0.5
# The most places that a report names.
_MOST_PLACES = 20


def crossings(
    ways: Sequence[NDArray[np.float64]],
    normals: Sequence[NDArray[np.float64]],
    closed: Sequence[bool],
    spacing: float,
) -> NDArray[np.float64]:
    """The places (k, 3) where polylines cross one another or themselves.

    ways, normals   (n, 3) each for every polyline
    spacing         the least one
    """
    begins, ends, upright = [], [], []
    for way, normal, is_closed in zip(ways, normals, closed, strict=True):
        way, normal = np.asarray(way, dtype=np.float64), np.asarray(normal, dtype=np.float64)
        after = np.roll(way, -1, axis=0) if is_closed else way[1:]
        begins.append(way[: len(after)])
        ends.append(after)
        upright.append((normal + np.roll(normal, -1, axis=0))[: len(after)])
    if sum(map(len, begins)) < 2:
        return np.empty((0, 3))
    begin, end, up = (np.concatenate(parts) for parts in (begins, ends, upright))
    reach = np.full(len(begin), _NEAR * spacing / 2.0)
    first, second = pairs_within(begin, end, reach, np.ones(len(begin), dtype=bool))
    pairs = np.unique(np.column_stack([first, second]), axis=0)
    one_sheet = (up[pairs[:, 0]] * up[pairs[:, 1]]).sum(axis=1) > 0.0
    first, second = pairs[one_sheet, 0], pairs[one_sheet, 1]
    if not len(first):
        return np.empty((0, 3))
    across, along = _planes(up[first] + up[second])
    origin = begin[first]
    a, b, c, d = (
        np.column_stack([((p - origin) * axis).sum(axis=1) for axis in (across, along)])
        for p in (begin[first], end[first], begin[second], end[second])
    )
    cross, share = crossing_shares(a, b, c, d)
    return (origin + share[:, None] * (end[first] - origin))[cross]


def of_polylines(curve: Polylines, spacing: float) -> NDArray[np.float64]:
    """crossings() of polylines as the core gives them."""
    cuts = np.asarray(curve.offsets, dtype=np.int64)[1:-1]
    ways, normals = np.split(curve.positions, cuts), np.split(curve.normals, cuts)
    return crossings(ways, normals, [bool(flag) for flag in curve.closed], spacing)


def figures(places: NDArray[np.float64] | None) -> dict[str, Any]:
    """What the report says of them; None: all points are written, and so there are none."""
    if places is None:
        return {"crossings": None, "crossing_places": []}
    return {"crossings": len(places), "crossing_places": places[:_MOST_PLACES].tolist()}


def crossing_warning(places: NDArray[np.float64] | None) -> str:
    """What to say of them, and what to do; empty if there are none."""
    if places is None or not len(places):
        return ""
    where = " ".join(f"{value:.4g}" for value in places[0])
    many = "at 1 place" if len(places) == 1 else f"at {len(places):,} places, the first of them"
    return (
        f"the curve crosses itself {many} at {where}: its points are too far apart; choose a "
        "smaller tolerance or step"
    )


def _planes(normals: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Two unit vectors each, at right angles to the normals and to each other."""
    other = np.eye(3)[np.abs(normals).argmin(axis=1)]
    across = np.cross(normals, other)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    along = np.cross(normals, across)
    return across, along / np.linalg.norm(along, axis=1, keepdims=True)
