# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat drawings that are larger than the paper, cut into sheets that are laid together; no bpy.

Sheets meet at the edges of what their margins leave. Lines are cut there, so that a strand ends on
one sheet where it goes on upon the next, and crosses at the corners lie on those of the neighbours.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..files.whole import FileError
from .drawing import Drawing, Page, ring
from .toolpath import Strand, strand_of

# On all sides of a sheet, in millimetres, where nobody says.
MARGIN = 15.0
# From the middle of a cross to its ends, in millimetres.
_REACH = 5.0
# More are a mistake in the unit.
_MOST_SHEETS = 1000
# What is shorter than this share of a sheet is no piece of a line.
_NOTHING = 1e-9


@dataclass(frozen=True)
class Paper:
    """Sheets of paper, in millimetres: their sides, and the white on all of them.

    turns   they may also lie, where fewer are needed then
    """

    width: float
    height: float
    margin: float = MARGIN
    turns: bool = False

    @property
    def has_room(self) -> bool:
        """Whether the margins leave any of it."""
        return 2.0 * self.margin < min(self.width, self.height)

    def described(self) -> str:
        return f"{self.width:g} x {self.height:g} mm"


class Sheet(NamedTuple):
    """What is on one of the sheets.

    row, column   counted from 1, from the top and from the left
    drawing       from the lower left corner of the paper
    """

    row: int
    column: int
    drawing: Drawing

    @property
    def name(self) -> str:
        return name_of(self.row, self.column)


class Sheets(NamedTuple):
    """A drawing in sheets.

    paper   as it lies
    rows, columns   how many lie above and beside one another
    drawn   those with something on them, row by row
    """

    paper: Paper
    rows: int
    columns: int
    drawn: list[Sheet]

    @property
    def empty(self) -> list[str]:
        """The names of those with nothing on them."""
        there = {sheet.name for sheet in self.drawn}
        names = (name_of(r, c) for r in range(1, self.rows + 1) for c in range(1, self.columns + 1))
        return [name for name in names if name not in there]


class _Grid(NamedTuple):
    """How sheets lie on a drawing, in its unit, (2,) each.

    origin   the lower left corner of what they hold together
    room     what each holds
    counts   how many are beside and above one another
    """

    origin: NDArray[np.float64]
    room: NDArray[np.float64]
    counts: NDArray[np.int64]


def name_of(row: int, column: int) -> str:
    """Of a sheet, such as r1c2."""
    return f"r{row}c{column}"


def sheets_of(drawing: Drawing, paper: Paper, arc_tolerance: float = 0.0) -> Sheets:
    """A flat drawing in sheets, with the drawing in the middle of them.

    arc_tolerance   in millimetres, of lines and arcs in place of points; 0: points

    Raises FileError where the margins leave nothing, and for more sheets than anybody could want.
    """
    paper = _laid(drawing, paper)
    grid, unit = _grid_of(drawing, paper), drawing.millimetres
    pieces: dict[tuple[int, int], list[Strand]] = {}
    for strand in drawing.strands:
        for cell, piece in _pieces(strand, grid):
            pieces.setdefault(cell, []).append(piece)
    columns, rows = (int(count) for count in grid.counts)
    page = Page((paper.width / unit, paper.height / unit), _marks(paper, unit))
    drawn = []
    for (x, y), strands in pieces.items():
        corner = grid.origin + grid.room * (x, y) - paper.margin / unit
        moved = [replace(each, points=each.points - [*corner, 0.0]) for each in strands]
        of_sheet = replace(drawing, strands=moved, moves=None, page=page)
        if arc_tolerance > 0.0:
            of_sheet = of_sheet.with_arcs(arc_tolerance)
        drawn.append(Sheet(rows - y, x + 1, of_sheet))
    return Sheets(paper, rows, columns, sorted(drawn, key=lambda sheet: sheet[:2]))


def number_of(drawing: Drawing, paper: Paper) -> int:
    """How many sheets lie on a drawing, with those on which nothing is. Raises FileError as
    sheets_of() does."""
    return int(_grid_of(drawing, _laid(drawing, paper)).counts.prod())


def _laid(drawing: Drawing, paper: Paper) -> Paper:
    """The paper as it lies: turned where fewer sheets are needed then."""
    if not paper.has_room:
        raise FileError(
            f"A margin of {paper.margin:g} mm leaves nothing of a sheet of {paper.described()}; "
            "choose a smaller one"
        )
    other = replace(paper, width=paper.height, height=paper.width)

    def number(lying: Paper) -> int:
        return int(_grid_of(drawing, lying).counts.prod())

    if paper.turns and number(other) < number(paper):
        paper = other
    if number(paper) > _MOST_SHEETS:
        raise FileError(
            f"The drawing would take {number(paper):,} sheets of {paper.described()}, more than "
            f"{_MOST_SHEETS:,}; choose a smaller drawing or larger sheets"
        )
    return paper


def _grid_of(drawing: Drawing, paper: Paper) -> _Grid:
    low, high = (corner[:2] for corner in drawing.box())
    room = np.array([paper.width, paper.height]) - 2.0 * paper.margin
    room = room / drawing.millimetres
    # What fits to a billionth fits: a size may have been rounded.
    counts = np.ceil((high - low) / room * (1.0 - _NOTHING)).clip(1, 2.0**31).astype(np.int64)
    return _Grid((low + high - counts * room) / 2.0, room, counts)


def _pieces(strand: Strand, grid: _Grid) -> Iterator[tuple[tuple[int, int], Strand]]:
    """What lies on each sheet, by its column and row from below, in the order of the line; what
    goes on through the beginning of a closed one is one piece, the first."""
    points, normals = _cut(strand, grid)
    cells = _cells(points, grid)
    begins = np.flatnonzero(np.append(True, (cells[1:] != cells[:-1]).any(axis=1)))
    ends = np.append(begins[1:], len(cells))
    names = [(int(x), int(y)) for x, y in cells[begins]]
    if len(begins) == 1:
        yield names[0], strand
        return
    ways = [np.arange(begin, end + 1) for begin, end in zip(begins, ends)]
    if strand.closed and names[0] == names[-1]:
        ways[0] = np.concatenate([ways.pop(), ways[0][1:]])
        names.pop()
    for name, way in zip(names, ways):
        piece = strand_of(points[way], normals[way], False)
        yield name, replace(piece, part=strand.part)


def _cut(strand: Strand, grid: _Grid) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The points of a strand and their normals, with more where it passes from sheet to sheet; a
    closed one ends where it begins."""
    points = ring(strand)
    normals = np.vstack([strand.normals, strand.normals[:1]])[: len(points)]
    if len(points) == 1:
        points, normals = np.repeat(points, 2, 0), np.repeat(normals, 2, 0)
    segments, shares, placed = [], [], []
    for axis in (0, 1):
        at = (points[:, axis] - grid.origin[axis]) / grid.room[axis]
        here, there = at[:-1], at[1:]
        first = np.floor(np.minimum(here, there)).astype(np.int64) + 1
        last = np.ceil(np.maximum(here, there)).astype(np.int64) - 1
        first, last = np.maximum(first, 1), np.minimum(last, grid.counts[axis] - 1)
        many = np.maximum(last - first + 1, 0)
        segment = np.repeat(np.arange(len(here)), many)
        edge = first[segment] + np.arange(len(segment)) - np.repeat(np.cumsum(many) - many, many)
        share = (edge - here[segment]) / (there - here)[segment]
        place = _between(points, segment, share)
        place[:, axis] = grid.origin[axis] + edge * grid.room[axis]
        segments.append(segment)
        shares.append(share)
        placed.append(place)
    segment, share, place = (np.concatenate(each) for each in (segments, shares, placed))
    order = np.lexsort((share, segment))
    segment, share, place = segment[order], share[order], place[order]
    leaning = _between(normals, segment, share)
    return np.insert(points, segment + 1, place, 0), np.insert(normals, segment + 1, leaning, 0)


def _between(values: NDArray, segment: NDArray, share: NDArray) -> NDArray[np.float64]:
    """Values (n, 3) at shares of segments."""
    ahead = share[:, None]
    return (1.0 - ahead) * values[segment] + ahead * values[segment + 1]


def _cells(points: NDArray[np.float64], grid: _Grid) -> NDArray[np.int64]:
    """The column and the row from below, (n - 1, 2), of the sheet that each piece between two
    points lies on; one without a length lies where that before it does."""
    middles = (points[:-1, :2] + points[1:, :2]) / 2.0
    cells = np.floor((middles - grid.origin) / grid.room).astype(np.int64)
    cells = np.clip(cells, 0, grid.counts - 1)
    long = np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1) > _NOTHING * grid.room.min()
    before = np.maximum.accumulate(np.where(long, np.arange(len(cells)), -1))
    return cells[np.where(before < 0, np.argmax(long), before)]


def _marks(paper: Paper, unit: float) -> Sequence[Strand]:
    """A cross of two strokes at each corner of what a sheet holds, where its margin has room."""
    reach = min(_REACH, paper.margin, (min(paper.width, paper.height) - 2.0 * paper.margin) / 4.0)
    if not reach > 0.0:
        return ()
    found = []
    for y in (paper.height - paper.margin, paper.margin):
        for x in (paper.margin, paper.width - paper.margin):
            for arm in ((reach, 0.0, 0.0), (0.0, reach, 0.0)):
                ends = np.array([[x, y, 0.0]] * 2) + np.array([[-1.0], [1.0]]) * arm
                found.append(strand_of(ends / unit, np.tile([0.0, 0.0, 1.0], (2, 1)), False))
    return found
