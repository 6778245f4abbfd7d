# SPDX-License-Identifier: GPL-3.0-or-later
"""A maze whose walls are a closed line: its corridors, two doors in the wall, the way between them.

The line has two sides, in each of which any two places are joined by one way only, as long as the
surface has no handle: a maze without loops. One side is the maze; a door is a gap that leads into
it from the other. On a sheet the inlets of the other side are branches of it too. Numpy only.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .. import core
from .cut import is_parted
from .edge_ways import Graph, common, way_to, ways
from .fair_way import fair_way
from .inlets import Inlet, find_inlets

# In spacings: a door to the outside is no farther from the boundary of the surface than this. Of a
# way, how much dearer it is close to a wall than in the middle of a corridor.
_FROM_BORDER, _AT_WALL = 1.0, 0.1
# In spacings: a door is no nearer to the mouth of an inlet, along the wall.
_FROM_CORNER = 1.5
# Doors at a boundary are chosen among _PLACES, at least _APART from each other as a share of the
# widest two. What is farther from the boundary than this, in spacings, is the middle.
_PLACES, _APART, _MIDDLE = 96, 0.8, 2.5
# A way leads through if a share _INNER of it is in the middle, it comes as near to the inmost place
# as _DEEP says, and it is _LEAST times as long as doors can be apart: no straight passage.
_INNER, _DEEP, _LEAST = 0.5, 0.7, 1.3
# In spacings: ways that differ by no more in the middle differ only in how they come to it.
_AS_INNER = 0.1
# In spacings: what is shorter is no corridor. The angle of a turn, and over which length it is.
_CORRIDOR, _TURN, _STEP = 1.0, np.radians(60.0), 1.0


class NoMaze(ValueError):
    """The line makes no maze; str() is the end of a sentence about it."""


@dataclass(frozen=True)
class Doors:
    """Two doors, and what else is changed of the walls, by numbers of points on a strand of a cut,
    as in `cut.line_vertices`.

    ends     the vertices of the cut at the doors
    gaps     in the wall; those of inlets lead from one corridor to another
    bars     walls across the mouths of inlets, from point to point, and whether there is a door in
             it
    through  unless they were looked for at the boundary, and no way between two that are far apart
             leads through the middle
    """

    strand: int
    ends: tuple[int, int]
    gaps: tuple[int, ...]
    bars: tuple[tuple[int, int, bool], ...] = ()
    through: bool = True


@dataclass(frozen=True)
class Hardness:
    """How hard a maze is: the length of its way in spacings, how often that turns, and how many
    corridors lead nowhere."""

    length: float
    turns: int
    dead_ends: int

    def __str__(self) -> str:
        turns = "1 turn" if self.turns == 1 else f"{self.turns:,} turns"
        ends = "1 dead end" if self.dead_ends == 1 else f"{self.dead_ends:,} dead ends"
        return f"{self.length:.0f} spacings from door to door, {turns}, {ends}"


class Maze:
    """The corridors of one side of the longest strand of a cut."""

    def __init__(self, cut: core.CutSurface, spacing: float) -> None:
        """cut   with its middle lines

        Raises NoMaze where the line does not part the surface.
        """
        if not len(cut.lengths) or not cut.closed.any() or not is_parted(cut):
            raise NoMaze("has only one side, and walls that end part nothing")
        self._cut, self._spacing = cut, spacing
        self.strand = int(np.argmax(np.where(cut.closed, cut.lengths, -1.0)))
        self._span = slice(int(cut.offsets[self.strand]), int(cut.offsets[self.strand + 1]))
        self._line = cut.line_vertices[self._span].astype(np.int64)
        self._on_line = np.zeros(len(cut.positions), dtype=bool)
        self._on_line[cut.line_vertices] = True
        self._border = _border_vertices(cut.faces)
        first, second = self._sides()
        outside = np.isin(cut.faces, self._border)
        # What touches the boundary is outside.
        touching = [bool(outside[cut.regions == region].any()) for region in (first, second)]
        swapped = touching[0] and not touching[1]
        self.region, self._other = (second, first) if swapped else (first, second)

    def farthest_doors(self) -> Doors:
        """Two doors with the longest way between them. At the boundary where there is one: there
        they are far apart, and the way is the one that is longest in the middle, of those that lead
        through it where any does."""
        candidates = self._candidates()
        if len(self._border) and len(candidates) > 2:
            return self._doors_at_border(candidates)
        graph = self._graph(self.region)
        start = before = int(candidates[0])
        for _ in range(2):  # corridors are a tree: what is farthest from anywhere is an end of it
            far, _ = ways(graph, [self._line[start]], self._on_line)
            reached = far[self._line[candidates]]
            reached = np.where(np.isfinite(reached), reached, -1.0)
            start, before = int(candidates[np.argmax(reached)]), start
        return self._doors(before, start)

    def _doors_at_border(self, candidates: NDArray[np.int64]) -> Doors:
        chosen = candidates[np.linspace(0, len(candidates) - 1, _PLACES).astype(int)]
        chosen = np.unique(chosen)
        mouths = np.array([inlet.mouth for inlet in self._inlets], dtype=np.int64)
        ends = np.concatenate([self._line[chosen], mouths])
        far, before = ways(self._whole, [int(ends[0])], self._closed)
        numbers = np.flatnonzero(np.isfinite(far[ends]))  # up to len(chosen), of points of the line
        ends = ends[numbers]
        first, second, through = self._most_inner(ends, before)
        gaps = [inlet.gap for inlet in self._inlets]
        opened = [int(numbers[end]) - len(chosen) for end in (first, second)]
        gaps += [int(chosen[end]) for end in numbers[[first, second]] if end < len(chosen)]
        bars = [(each.first, each.last, k in opened) for k, each in enumerate(self._inlets)]
        doors = (int(ends[first]), int(ends[second]))
        return Doors(self.strand, doors, tuple(gaps), tuple(bars), through)

    def _most_inner(
        self, ends: NDArray[np.int64], before: list[int]
    ) -> tuple[int, int, bool]:
        """Which two of these vertices have doors, and whether the way between them leads through
        the middle.

        before   as of the ways from one of them
        """
        places = self._cut.positions[ends]
        found = [way_to(int(vertex), before) for vertex in ends]
        apart = np.linalg.norm(places[:, None] - places[None], axis=2)
        away = np.zeros(len(self._cut.positions))
        passed = np.unique(np.concatenate(found))
        away[passed] = self._from_border(passed)
        courses = [self._course(way, away) for way in found]
        deep, least = _DEEP * float(away.max()), _LEAST * float(apart.max())
        best, pair = (False, -1.0, 0.0), (0, len(ends) - 1)
        # Corridors are a tree: the way between two doors is what their ways from anywhere do not
        # have in common.
        for i, j in zip(*np.nonzero(np.triu(apart >= _APART * apart.max(), 1)), strict=True):
            same = common(found[i], found[j]) - 1
            whole, inner = (
                one[-1] + other[-1] - 2.0 * one[same]
                for one, other in zip(courses[i][:2], courses[j][:2], strict=True)
            )
            deepest = max(courses[i][2][same], courses[j][2][same])
            through = inner >= _INNER * whole and deepest >= deep and whole >= least
            # Many doors share a way in the middle: where none leads through, the longest
            # way to it is no straight passage along the rim.
            alike = round(inner / (_AS_INNER * self._spacing))
            rated = (True, float(inner), 0.0) if through else (False, alike, float(whole))
            if rated > best:
                best, pair = rated, (int(i), int(j))
        return *pair, best[0]

    def _from_border(self, vertices: NDArray[np.int64]) -> NDArray[np.float64]:
        """How far each of these vertices is from the boundary, straight."""
        positions = self._cut.positions
        border = positions[self._border]
        found = []
        for some in np.array_split(vertices, len(vertices) // 512 + 1):
            steps = positions[some][:, None] - border[None]
            found.append(np.sqrt((steps**2).sum(axis=2).min(axis=1)))
        return np.concatenate(found)

    def _course(
        self, way: NDArray[np.int64], away: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Up to each vertex of a way its length, and how much of that is in the middle of the
        surface; and how far from the boundary it comes from there on."""
        steps = np.linalg.norm(np.diff(self._cut.positions[way], axis=0), axis=1)
        inner = np.where(away[way[1:]] < _MIDDLE * self._spacing, 0.0, steps)
        lengths = [np.concatenate([[0.0], np.cumsum(each)]) for each in (steps, inner)]
        return *lengths, np.maximum.accumulate(away[way][::-1])[::-1]

    def hardness(self, way: NDArray[np.int64], points: NDArray[np.float64]) -> Hardness:
        """Of the maze with this way(), which leads through these places()."""
        step = _STEP * self._spacing
        lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
        at = np.concatenate([[0.0], np.cumsum(lengths)])
        places = np.linspace(0.0, at[-1], max(int(at[-1] / step), 1) + 1)
        course = np.column_stack([np.interp(places, at, points[:, axis]) for axis in range(3)])
        heading = np.diff(course, axis=0)
        heading /= np.maximum(np.linalg.norm(heading, axis=1, keepdims=True), 1e-300)
        # Over two steps, so that a turn between two places is one; a long one counts once.
        dots = (heading[:-2] * heading[2:]).sum(axis=1)
        turning = np.arccos(np.clip(dots, -1.0, 1.0)) > _TURN
        turns = int(np.count_nonzero(turning & ~np.concatenate([[False], turning[:-1]])))
        return Hardness(at[-1] / self._spacing, turns, self._dead_ends(way))

    def _dead_ends(self, way: NDArray[np.int64]) -> int:
        """How many corridors end at neither door: places of the side that are farther from the
        first door than all round them, by more than a corridor is wide."""
        graph = self._graph(*self._corridors, plain=True)
        far, _ = ways(graph, [int(way[0])], self._closed)
        order = np.argsort(-far, kind="stable")
        order = order[np.isfinite(far[order]) & ~self._closed[order]]
        root = {}  # of every vertex that is known, one that leads to the farthest of its part

        def farthest(vertex: int) -> int:
            while root[vertex] != vertex:
                root[vertex] = vertex = root[root[vertex]]
            return vertex

        ends, least = 0, _CORRIDOR * self._spacing
        for vertex in order.tolist():
            root[vertex] = vertex
            for place in range(graph.firsts[vertex], graph.firsts[vertex + 1]):
                other = graph.neighbours[place]
                if other not in root:
                    continue
                one, two = farthest(vertex), farthest(other)
                if one == two:
                    continue
                low, high = (one, two) if far[one] <= far[two] else (two, one)
                ends += bool(far[low] - far[vertex] > least)
                root[low] = high
        return ends  # the farthest of all has not ended: the second door stands for it

    def doors_at(self, first: float, second: float) -> Doors:
        """Doors at shares of the strand's length, in [0, 1]."""
        lengths = self._cut.arc_lengths[self._span]
        places = (
            int(np.argmin(np.abs(lengths - share * self._cut.lengths[self.strand])))
            for share in (first, second)
        )
        return self._doors(*places)

    def _doors(self, first: int, second: int) -> Doors:
        """In the wall, at points of the strand."""
        gaps = (min(first, second), max(first, second))
        return Doors(self.strand, (int(self._line[gaps[0]]), int(self._line[gaps[1]])), gaps)

    def way(self, doors: Doors) -> NDArray[np.int64]:
        """The vertices of the cut on the way from door to door, through the middle of corridors."""
        begin, end = doors.ends
        if doors.bars:
            _, before = ways(self._whole, [begin], self._closed)
        else:
            _, before = ways(self._graph(self.region), [begin], self._on_line)
        return way_to(end, before)

    def places(self, way: NDArray[np.int64], doors: Doors) -> NDArray[np.float64]:
        """Of a way() between these doors, (n, 3), without its corners. It begins and ends in the
        middle of those that are in a bar."""
        places = list(self._cut.positions[way])
        for first, last, opened in doors.bars:
            if opened:
                middle = self._cut.positions[self._line[[first, last]]].mean(axis=0)
                ends = np.linalg.norm(np.array([places[0], places[-1]]) - middle, axis=1)
                places.insert(0 if ends[0] < ends[1] else len(places), middle)
        return fair_way(np.array(places), self._cut, self._spacing)

    @cached_property
    def _inlets(self) -> list[Inlet]:
        """Of the other side, where the surface has a boundary."""
        if not len(self._border):
            return []
        outside, away = self._graph(self._other, plain=True), self._from_border(self._line)
        cut = self._cut
        return find_inlets(
            cut.positions, self._line, outside, self._border, away, cut.distances, self._spacing
        )

    @property
    def _corridors(self) -> tuple[int, ...]:
        """The regions that have corridors of the maze."""
        return (self.region, self._other) if self._inlets else (self.region,)

    @cached_property
    def _closed(self) -> NDArray[np.bool_]:
        """Vertices where ways may end but not go on: walls, and what is outside of the maze."""
        closed = np.zeros(len(self._cut.positions), dtype=bool)
        closed[self._cut.faces[self._cut.regions == self._other]] = True
        for inlet in self._inlets:
            closed[inlet.inside] = False
        closed |= self._on_line
        closed[self._line[[inlet.gap for inlet in self._inlets]]] = False
        return closed

    @cached_property
    def _whole(self) -> Graph:
        """Of all corridors of the maze."""
        return self._graph(*self._corridors)

    def _sides(self) -> tuple[int, int]:
        """The regions on both sides of the strand: the first is on the positive side."""
        on_strand = np.zeros(len(self._cut.positions), dtype=bool)
        on_strand[self._line] = True
        beside = on_strand[self._cut.faces].sum(axis=1) >= 2
        regions, sides = self._cut.regions[beside], self._cut.sides[beside]
        both = [int(regions[sides == side][0]) for side in (1, -1)]
        return both[0], both[1]

    def _candidates(self) -> NDArray[np.int64]:
        """Where doors may be, as numbers of the strand's points."""
        every = np.arange(len(self._line))
        if not len(self._border):
            return every
        far, _ = ways(self._graph(self._other, plain=True), self._border, self._on_line)
        near = far[self._line] <= _FROM_BORDER * self._spacing
        lengths, whole = self._cut.arc_lengths[self._span], float(self._cut.lengths[self.strand])
        for inlet in self._inlets:
            for corner in (inlet.first, inlet.last):
                along = np.abs(lengths - lengths[corner])
                near &= np.minimum(along, whole - along) > _FROM_CORNER * self._spacing
        near = every[near]
        return near if len(near) > 1 else every

    def _graph(self, *regions: int, plain: bool = False) -> Graph:
        """The edges of the faces of regions, longer where they run close to a wall.

        plain   as long as they are
        """
        cut = self._cut
        faces = cut.faces[np.isin(cut.regions, regions)].astype(np.int64)
        edges = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
        lengths = np.linalg.norm(np.diff(cut.positions[edges], axis=1)[:, 0], axis=1)
        if not plain:
            away = cut.distances[edges].mean(axis=1) / (self._spacing / 2.0)
            lengths = lengths / (np.minimum(away, 1.0) ** 2 + _AT_WALL)
        return Graph.of(edges, lengths, len(cut.positions))


def _border_vertices(faces: NDArray[np.uint32]) -> NDArray[np.int64]:
    """The vertices of edges with one face."""
    pairs = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1).astype(np.int64)
    edges, count = np.unique(pairs, axis=0, return_counts=True)
    return np.unique(edges[count == 1])
