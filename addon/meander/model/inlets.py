# SPDX-License-Identifier: GPL-3.0-or-later
"""The corridors outside of a closed line on a sheet, each with a mouth at the boundary.

With a bar across its mouth and a gap in its wall an inlet is one more branch of the maze: corridors
of both sides are one tree then, any of whose ends at the boundary may have a door. Numpy only.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .edge_ways import Graph, ways

# In spacings: the outer wall is no farther from the boundary than its nearest places and this much.
_OUTER = 0.4
# How far an inlet leads beyond the outer wall at least, and how wide its mouth is at most.
_DEPTH, _MOUTH = 1.25, 2.2


@dataclass(frozen=True)
class Inlet:
    """One corridor, by numbers of the strand's points, of which first .. last are its wall.

    gap     in its wall, where it comes farthest from the boundary
    mouth   the vertex that is near to both ends of its wall, and far from the wall itself
    inside  the vertices of the corridor
    """

    first: int
    last: int
    gap: int
    mouth: int
    inside: NDArray[np.int64]


def find_inlets(
    positions: NDArray[np.float64],
    line: NDArray[np.int64],
    outside: Graph,
    border: NDArray[np.int64],
    away: NDArray[np.float64],
    from_line: NDArray[np.float64],
    spacing: float,
) -> list[Inlet]:
    """Of a closed line on a sheet, in the order of the line.

    line       (n,) its vertices
    outside    the edges of the side that touches the boundary
    border     the vertices of the boundary
    away       (n,) how far the line's points are from the boundary, straight
    from_line  how far all vertices are from the line
    """
    walls = np.zeros(len(positions), dtype=bool)
    walls[line] = True
    far, _ = ways(outside, border, walls)
    if not np.isfinite(far[line]).any():
        return []
    outer = float(np.quantile(far[line], 0.02)) + _OUTER * spacing
    beyond = far[line] > outer
    if beyond.all() or not beyond.any():
        return []
    inner = np.isfinite(far) & (far > outer) & ~walls
    found: list[Inlet] = []
    taken = np.zeros(len(positions), dtype=bool)
    for numbers in _runs(beyond):
        first, last = int(numbers[0]), int(numbers[-1])
        depth = float(far[line[numbers]].max()) - outer
        width = float(np.linalg.norm(positions[line[first]] - positions[line[last]]))
        if depth < _DEPTH * spacing or width > _MOUTH * spacing:
            continue
        gap = int(numbers[np.argmax(away[numbers])])
        reached, _ = ways(outside, [int(line[gap])], ~inner)
        inside = np.flatnonzero(np.isfinite(reached) & inner)
        if not len(inside) or taken[inside].any():  # it has another mouth
            continue
        taken[inside] = True
        corners = positions[line[[first, last]]]
        from_corners = np.linalg.norm(positions[inside][:, None] - corners, axis=2)
        mouth = int(inside[np.argmin(from_corners.max(axis=1) - from_line[inside])])
        found.append(Inlet(first, last, gap, mouth, inside))
    return found


def _runs(which: NDArray[np.bool_]) -> list[NDArray[np.int64]]:
    """The numbers of each run of true values round a closed line, neither all nor none of which
    are true."""
    begin = int(np.flatnonzero(~which)[0])
    order = (np.arange(len(which)) + begin) % len(which)
    changes = np.flatnonzero(np.diff(which[order].astype(np.int8))) + 1
    return [part for part in np.split(order, changes) if which[part[0]]]
