# SPDX-License-Identifier: GPL-3.0-or-later
"""The places of a triangle mesh that are nearest to points near it. numpy only, no bpy.

Faces are put into grids by their size, so that each covers eight cells at most, and a point looks
into one cell of every grid: exact within a reach, whatever the sizes are.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

# So many pairs of a point and a face are measured at once, which takes about 100 MB.
_PAIRS = 1 << 18


@dataclass(frozen=True)
class Places:
    """Of every point asked for.

    distances      (n,) float64; infinite where nothing is within reach
    faces          (n,) int64, the face that holds the nearest place; of several the first
    barycentrics   (n, 3) float64, weights of its vertices
    """

    distances: NDArray[np.float64]
    faces: NDArray[np.int64]
    barycentrics: NDArray[np.float64]


def closest_places(
    points: NDArray[np.float64],
    vertices: NDArray[np.float64],
    faces: NDArray[np.integer],
    reach: float,
) -> Places:
    """The place of a mesh (n, 3), (m, 3) nearest to each of points (k, 3), within `reach` > 0.

    Faces of vertices that lie nowhere are left out; points all have a place.
    """
    corners = vertices[faces]
    low, high = corners.min(axis=1) - reach, corners.max(axis=1) + reach
    extents = (high - low).max(axis=1)
    somewhere = np.flatnonzero(np.isfinite(extents))
    levels = np.full(len(faces), -1, dtype=np.int64)  # those of faces are 1 and more
    levels[somewhere] = np.ceil(np.log2(extents[somewhere] / reach))
    found = Places(
        np.full(len(points), np.inf),
        np.zeros(len(points), dtype=np.int64),
        np.zeros((len(points), 3)),
    )
    if not len(points) or not len(somewhere):
        return found
    origin = low[somewhere].min(axis=0)
    for level in np.unique(levels[somewhere]).tolist():
        own = np.flatnonzero(levels == level)
        cell = reach * 2.0**level
        cells, members = _cells(low[own], high[own], origin, cell)
        keys, asked = _shared_keys(cells, np.floor((points - origin) / cell).astype(np.int64))
        order = np.argsort(keys, kind="stable")
        keys, members = keys[order], members[order]
        begins = np.searchsorted(keys, asked, side="left")
        counts = np.searchsorted(keys, asked, side="right") - begins
        _measure(points, corners, own[members], begins, counts, found)
    far = found.distances > reach
    found.distances[far] = np.inf
    return found


def _cells(
    low: NDArray[np.float64], high: NDArray[np.float64], origin: NDArray[np.float64], cell: float
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The cells (c, 3) of boxes no larger than one, and the number of the box in each."""
    first = np.floor((low - origin) / cell).astype(np.int64)
    last = np.floor((high - origin) / cell).astype(np.int64)
    cells, members = [], []
    for corner in range(8):
        ahead = np.array([corner & 1, corner >> 1 & 1, corner >> 2 & 1])
        at = first + ahead
        inside = np.all(at <= last, axis=1)
        cells.append(at[inside])
        members.append(np.flatnonzero(inside))
    return np.concatenate(cells), np.concatenate(members)


def _shared_keys(
    cells: NDArray[np.int64], asked: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Cells and those asked for as numbers, equal where they are the same one; -1: none has it."""
    low, high = cells.min(axis=0), cells.max(axis=0)
    sizes = high - low + 1
    inside = np.all((asked >= low) & (asked <= high), axis=1)

    def number(at: NDArray[np.int64]) -> NDArray[np.int64]:
        x, y, z = (at - low).T
        return (x * sizes[1] + y) * sizes[2] + z

    return number(cells), np.where(inside, number(np.clip(asked, low, high)), -1)


def _measure(
    points: NDArray[np.float64],
    corners: NDArray[np.float64],
    members: NDArray[np.int64],
    begins: NDArray[np.int64],
    counts: NDArray[np.int64],
    found: Places,
) -> None:
    """Takes every point's members[begin : begin + count] into what is found."""
    asking = np.flatnonzero(counts)
    while len(asking):
        many = max(1, int(np.searchsorted(np.cumsum(counts[asking]), _PAIRS, side="right")))
        block, asking = asking[:many], asking[many:]
        of_block = counts[block]
        point = np.repeat(block, of_block)
        within = np.arange(len(point)) - np.repeat(np.cumsum(of_block) - of_block, of_block)
        face = members[begins[point] + within]
        weights = _nearest_weights(points[point], corners[face])
        places = (weights[:, :, None] * corners[face]).sum(axis=1)
        distances = np.linalg.norm(places - points[point], axis=1)
        order = np.lexsort((face, distances, point))
        point, face, weights = point[order], face[order], weights[order]
        distances = distances[order]
        firsts = np.flatnonzero(np.concatenate([[True], point[1:] != point[:-1]]))
        better = firsts[distances[firsts] < found.distances[point[firsts]]]
        found.distances[point[better]] = distances[better]
        found.faces[point[better]] = face[better]
        found.barycentrics[point[better]] = weights[better]


def _nearest_weights(
    points: NDArray[np.float64], corners: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Barycentric weights of the points of triangles (n, 3, 3) nearest to points (n, 3): the foot
    on the plane where that is inside, else the nearest of the places on the three sides."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    u, v, w = b - a, c - a, points - a
    uu, uv, vv = (u * u).sum(axis=1), (u * v).sum(axis=1), (v * v).sum(axis=1)
    wu, wv = (w * u).sum(axis=1), (w * v).sum(axis=1)
    area = uu * vv - uv * uv
    with np.errstate(divide="ignore", invalid="ignore"):
        second, third = (vv * wu - uv * wv) / area, (uu * wv - uv * wu) / area
    weights = np.column_stack([1.0 - second - third, second, third])
    outside = np.flatnonzero(~np.all(weights >= 0.0, axis=1))  # also where there is no area
    least = np.full(len(outside), np.inf)
    for begin, end in ((0, 1), (1, 2), (2, 0)):
        p, q = corners[outside, begin], corners[outside, end]
        side = q - p
        lengths = (side * side).sum(axis=1)
        along = ((points[outside] - p) * side).sum(axis=1)
        share = np.divide(along, lengths, out=np.zeros_like(along), where=lengths > 0.0)
        share = np.clip(share, 0.0, 1.0)
        apart = ((p + share[:, None] * side - points[outside]) ** 2).sum(axis=1)
        nearer = apart < least
        least[nearer] = apart[nearer]
        chosen = outside[nearer]
        weights[chosen] = 0.0
        weights[chosen, begin] = 1.0 - share[nearer]
        weights[chosen, end] = share[nearer]
    return weights
