# SPDX-License-Identifier: GPL-3.0-or-later
"""The sheet that a picture is drawn on: a grid of triangles with a hole where no line is to be.

Parts that a mask leaves apart are joined by corridors, so that one line crosses from each to the
next. No bpy.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry.nearest_places import Tree, closest_pair, spanning_tree


@dataclass(frozen=True)
class Grid:
    """Places at equal steps over a sheet, rows from the top.

    sides   width and height of the sheet, in millimetres; its lower left corner is the origin
    cells   how many cells there are across and down; places are one more
    """

    sides: tuple[float, float]
    cells: tuple[int, int]

    @property
    def cell(self) -> float:
        """The longer side of a cell, in millimetres."""
        return max(side / count for side, count in zip(self.sides, self.cells, strict=True))

    @property
    def shares(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The places down and across, from 0 to 1."""
        across, down = self.cells
        return np.linspace(0.0, 1.0, down + 1), np.linspace(0.0, 1.0, across + 1)

    def points(self) -> NDArray[np.float64]:
        """The places on the sheet, (rows * columns, 3), in millimetres."""
        down, across = self.shares
        x, y = np.meshgrid(across * self.sides[0], (1.0 - down) * self.sides[1])
        return np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])


def grid_of(sides: tuple[float, float], cell: float) -> Grid:
    """A grid of cells that are no longer than `cell`, in millimetres."""
    across, down = (max(2, int(np.ceil(side / cell - 1e-9))) for side in sides)
    return Grid(sides, (across, down))


def triangles(kept: NDArray[np.bool_]) -> tuple[NDArray[np.int64], NDArray[np.uint32]]:
    """The triangles of the cells that are kept.

    kept   (down, across), of the cells

    Returns the places that they use, in order, and the triangles in terms of those, facing up.
    """
    down, across = kept.shape
    places = np.arange((down + 1) * (across + 1)).reshape(down + 1, across + 1)
    corners = (places[:-1, :-1], places[:-1, 1:], places[1:, 1:], places[1:, :-1])
    a, b, c, d = (corner[kept] for corner in corners)
    # Diagonals in turn, so that no direction is preferred.
    row, column = np.nonzero(kept)
    even = (row + column) % 2 == 0
    first = np.where(even[:, None], np.column_stack([a, d, c]), np.column_stack([a, d, b]))
    second = np.where(even[:, None], np.column_stack([a, c, b]), np.column_stack([b, d, c]))
    faces = np.stack([first, second], axis=1).reshape(-1, 3)
    used = np.zeros(places.size, dtype=bool)
    used[faces] = True
    number = np.cumsum(used) - 1
    return np.flatnonzero(used), number[faces].astype(np.uint32)


def cells_kept(
    opaque: NDArray[np.bool_], least: float, width: float, bridges: bool
) -> NDArray[np.bool_]:
    """The cells of a sheet that is cut out.

    opaque    (down + 1, across + 1), of the places: where there is to be a line
    least     parts of fewer cells are left out
    width     of the corridors that join what is left, in cells
    bridges   whether there are any
    """
    kept = opaque[:-1, :-1] & opaque[:-1, 1:] & opaque[1:, 1:] & opaque[1:, :-1]
    labels, count = parts_of(kept)
    sizes = np.bincount(labels[kept], minlength=count)
    kept = np.append(sizes >= least, False)[labels]  # -1, of what is not kept, is the last
    if bridges:
        kept = _joined(kept, width)
    return _without_points(kept)


def parts_of(kept: NDArray[np.bool_]) -> tuple[NDArray[np.int64], int]:
    """The number of the part that each cell is in, -1 for those that are not kept, and how many
    parts there are; cells hang together by their sides."""
    runs: list[tuple[int, int, int]] = []
    labels = np.full(kept.shape, -1, dtype=np.int64)
    touching: list[tuple[int, int]] = []
    for row, cells in enumerate(kept):
        steps = np.flatnonzero(np.diff(np.concatenate([[0], cells.view(np.int8), [0]])))
        for begin, end in zip(steps[::2].tolist(), steps[1::2].tolist(), strict=True):
            if row:
                above = labels[row - 1, begin:end]
                touching += [(len(runs), k) for k in np.unique(above[above >= 0]).tolist()]
            labels[row, begin:end] = len(runs)
            runs.append((row, begin, end))
    tree = Tree(len(runs))
    for one, other in touching:
        tree.join(one, other)
    roots = np.array([tree.root(k) for k in range(len(runs))], dtype=np.int64)
    found, number = np.unique(roots, return_inverse=True)
    labels[labels >= 0] = number[labels[labels >= 0]]
    return labels, len(found)


def _joined(kept: NDArray[np.bool_], width: float) -> NDArray[np.bool_]:
    """All parts as one, by straight corridors along a tree of least length."""
    labels, count = parts_of(kept)
    if count < 2:
        return kept
    inner = np.zeros_like(kept)
    inner[1:-1, 1:-1] = kept[:-2, 1:-1] & kept[2:, 1:-1] & kept[1:-1, :-2] & kept[1:-1, 2:]
    row, column = np.nonzero(kept & ~inner)
    rim = np.column_stack([row, column, np.zeros(len(row))]).astype(np.float64)
    sets = [rim[labels[row, column] == k] for k in range(count)]
    kept = kept.copy()
    for one, other in spanning_tree(sets):
        here, there, _distance = closest_pair(sets[one], sets[other])
        _fill(kept, sets[one][here, :2], sets[other][there, :2], width / 2.0)
    return kept


def _fill(
    kept: NDArray[np.bool_], here: NDArray[np.float64], there: NDArray[np.float64], reach: float
) -> None:
    """Keeps all cells within `reach` of a straight way."""
    reach = max(reach, 1.0)
    low = np.floor(np.minimum(here, there) - reach).astype(int).clip(min=0)
    high = np.ceil(np.maximum(here, there) + reach).astype(int) + 1
    part = kept[low[0] : high[0], low[1] : high[1]]
    row, column = np.indices(part.shape)
    places = np.stack([row + low[0], column + low[1]], axis=-1) - here
    way = there - here
    along = (places @ way / max(float(way @ way), 1e-300)).clip(0.0, 1.0)
    part |= np.linalg.norm(places - along[..., None] * way, axis=-1) <= reach


def _without_points(kept: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The same where no two cells meet at a corner only, which is no surface: one beside them is
    kept too."""
    kept = kept.copy()
    while True:
        a, b, c, d = kept[:-1, :-1], kept[:-1, 1:], kept[1:, :-1], kept[1:, 1:]
        falling, rising = a & d & ~b & ~c, b & c & ~a & ~d
        if not (falling.any() or rising.any()):
            return kept
        b |= falling
        a |= rising
