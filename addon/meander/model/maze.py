# SPDX-License-Identifier: GPL-3.0-or-later
"""A maze whose walls are a closed line: its corridors, two doors in the wall, the way between them.

The line has two sides, in each of which any two places are joined by one way only, as long as the
surface has no handle: a maze without loops. One side is the maze; a door is a gap that leads into
it from the other. Numpy only.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import core
from .cut import is_parted

# In spacings: a door to the outside is no farther from the boundary of the surface than this. Of a
# way, how much dearer it is close to a wall than in the middle of a corridor.
_FROM_BORDER, _AT_WALL = 1.0, 0.1
# Doors at a boundary are chosen among so many places, and so far apart at least, as a share of the
# widest two. What is farther from the boundary than this, in spacings, is the middle.
_PLACES, _APART, _MIDDLE = 96, 0.8, 2.5
# A way leads through if so much of it is in the middle, and it comes so near to the place inmost,
# as shares, and is so many times as long as the doors can be apart: no straight passage.
_INNER, _DEEP, _LEAST = 0.5, 0.7, 1.3
# In spacings: what is shorter is no corridor. The angle of a turn, and over which length it is.
_CORRIDOR, _TURN, _STEP = 1.0, np.radians(60.0), 1.0


class NoMaze(ValueError):
    """The line makes no maze; str() is the end of a sentence about it."""


@dataclass(frozen=True)
class Doors:
    """Two places on a strand of a cut, by their numbers in `cut.line_vertices`, and which strand.

    region   of the cut's faces: the side that is the maze
    through  unless they were looked for at the boundary, and no way between two that are far apart
             leads through the middle
    """

    strand: int
    region: int
    first: int
    second: int
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
            far, _ = _ways(graph, [self._line[start]], self._on_line)
            reached = far[self._line[candidates]]
            reached = np.where(np.isfinite(reached), reached, -1.0)
            start, before = int(candidates[np.argmax(reached)]), start
        return Doors(self.strand, self.region, *sorted((before, start)))

    def _doors_at_border(self, candidates: NDArray[np.int64]) -> Doors:
        chosen = candidates[np.linspace(0, len(candidates) - 1, _PLACES).astype(int)]
        chosen = np.unique(chosen)
        graph = self._graph(self.region)
        far, before = _ways(graph, [self._line[chosen[0]]], self._on_line)
        chosen = chosen[np.isfinite(far[self._line[chosen]])]
        places = self._cut.positions[self._line[chosen]]
        ways = [_way_to(int(vertex), before) for vertex in self._line[chosen]]
        apart = np.linalg.norm(places[:, None] - places[None], axis=2)
        away = self._from_border(np.unique(np.concatenate(ways)))
        courses = [self._course(way, away) for way in ways]
        deep, least = _DEEP * float(away.max()), _LEAST * float(apart.max())
        best, pair = (False, -1.0), (0, len(chosen) - 1)
        # Corridors are a tree: the way between two doors is what their ways from anywhere do not
        # have in common.
        for i, j in zip(*np.nonzero(np.triu(apart >= _APART * apart.max(), 1)), strict=True):
            same = _common(ways[i], ways[j]) - 1
            whole, inner = (
                one[-1] + other[-1] - 2.0 * one[same]
                for one, other in zip(courses[i][:2], courses[j][:2], strict=True)
            )
            deepest = max(courses[i][2][same], courses[j][2][same])
            through = inner >= _INNER * whole and deepest >= deep and whole >= least
            found = (bool(through), float(inner))
            if found > best:
                best, pair = found, (int(i), int(j))
        doors = sorted(int(chosen[place]) for place in pair)
        return Doors(self.strand, self.region, *doors, through=best[0])

    def _from_border(self, vertices: NDArray[np.int64]) -> NDArray[np.float64]:
        """How far these vertices are from the boundary; 0 of all others."""
        positions = self._cut.positions
        border = positions[self._border]
        away = np.zeros(len(positions))
        for some in np.array_split(vertices, len(vertices) // 512 + 1):
            steps = positions[some][:, None] - border[None]
            away[some] = np.sqrt((steps**2).sum(axis=2).min(axis=1))
        return away

    def _course(
        self, way: NDArray[np.int64], away: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Up to each vertex of a way its length, and how much of that is in the middle of the
        surface; and how far from the boundary it comes from there on."""
        steps = np.linalg.norm(np.diff(self._cut.positions[way], axis=0), axis=1)
        inner = np.where(away[way[1:]] < _MIDDLE * self._spacing, 0.0, steps)
        lengths = [np.concatenate([[0.0], np.cumsum(each)]) for each in (steps, inner)]
        return *lengths, np.maximum.accumulate(away[way][::-1])[::-1]

    def hardness(self, way: NDArray[np.int64]) -> Hardness:
        """Of the maze with this way()."""
        points, step = self._cut.positions[way], _STEP * self._spacing
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
        far, _ = _ways(self._graph(self.region, plain=True), [int(way[0])], self._on_line)
        graph = self._graph(self.region, plain=True)
        order = np.argsort(-far, kind="stable")
        order = order[np.isfinite(far[order]) & ~self._on_line[order]]
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
        return Doors(self.strand, self.region, *sorted(places))

    def way(self, doors: Doors) -> NDArray[np.int64]:
        """The vertices of the cut on the way from door to door, through the middle of corridors."""
        begin, end = self._line[doors.first], self._line[doors.second]
        _, before = _ways(self._graph(self.region), [begin], self._on_line)
        return _way_to(int(end), before)

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
        far, _ = _ways(self._graph(self._other, plain=True), self._border, self._on_line)
        near = every[far[self._line] <= _FROM_BORDER * self._spacing]
        return near if len(near) > 1 else every

    def _graph(self, region: int, plain: bool = False) -> _Graph:
        """The edges of a region's faces, longer where they run close to a wall.

        plain   as long as they are
        """
        cut = self._cut
        faces = cut.faces[cut.regions == region].astype(np.int64)
        edges = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
        lengths = np.linalg.norm(np.diff(cut.positions[edges], axis=1)[:, 0], axis=1)
        if not plain:
            away = cut.distances[edges].mean(axis=1) / (self._spacing / 2.0)
            lengths = lengths / (np.minimum(away, 1.0) ** 2 + _AT_WALL)
        return _Graph.of(edges, lengths, len(cut.positions))


@dataclass(frozen=True)
class _Graph:
    """Neighbours and lengths of vertex v: those from firsts[v] to firsts[v + 1]."""

    firsts: list[int]
    neighbours: list[int]
    lengths: list[float]

    @classmethod
    def of(cls, edges: NDArray[np.int64], lengths: NDArray[np.float64], count: int) -> _Graph:
        both = np.vstack([edges, edges[:, ::-1]])
        order = np.lexsort((both[:, 1], both[:, 0]))
        firsts = np.searchsorted(both[order, 0], np.arange(count + 1))
        return cls(
            firsts.tolist(), both[order, 1].tolist(), np.tile(lengths, 2)[order].tolist()
        )


def _ways(
    graph: _Graph, sources: NDArray[np.int64] | list[int], closed: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], list[int]]:
    """Dijkstra's shortest ways: how long they are, and what comes before each vertex, -1 at their
    beginning.

    closed   where ways may end but not go on, unless they begin there
    """
    lengths = [np.inf] * len(closed)
    before = [-1] * len(closed)
    queue = [(0.0, int(source)) for source in sources]
    begins = {source for _, source in queue}
    for _, source in queue:
        lengths[source] = 0.0
    heapq.heapify(queue)
    while queue:
        length, vertex = heapq.heappop(queue)
        if length > lengths[vertex] or closed[vertex] and vertex not in begins:
            continue
        for place in range(graph.firsts[vertex], graph.firsts[vertex + 1]):
            other, further = graph.neighbours[place], length + graph.lengths[place]
            if further < lengths[other]:
                lengths[other], before[other] = further, vertex
                heapq.heappush(queue, (further, other))
    return np.array(lengths), before


def _way_to(vertex: int, before: list[int]) -> NDArray[np.int64]:
    """The way from where _ways() begin to a vertex."""
    found = [vertex]
    while before[found[-1]] >= 0:
        found.append(before[found[-1]])
    return np.array(found[::-1])


def _common(one: NDArray[np.int64], other: NDArray[np.int64]) -> int:
    """How many vertices two ways have in common at their beginning."""
    count = min(len(one), len(other))
    differ = one[:count] != other[:count]
    return int(np.argmax(differ)) if differ.any() else count


def _border_vertices(faces: NDArray[np.uint32]) -> NDArray[np.int64]:
    """The vertices of edges with one face."""
    pairs = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1).astype(np.int64)
    edges, count = np.unique(pairs, axis=0, return_counts=True)
    return np.unique(edges[count == 1])


def wall_pieces(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    gaps: list[tuple[float, float]],
) -> list[tuple[NDArray[np.float64], NDArray[np.float64], bool]]:
    """What is left of a closed line without gaps: points, normals, and whether it is closed.

    points, normals   (n, 3), the first point not repeated at the end
    gaps              the middle of each, as an arc length, and its width
    """
    ring, across = np.vstack([points, points[:1]]), np.vstack([normals, normals[:1]])
    steps = np.linalg.norm(np.diff(ring, axis=0), axis=1)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    whole = at[-1]
    if not gaps:
        return [(points, normals, True)]
    bounds = sorted(((middle - width / 2) % whole, width) for middle, width in gaps)
    pieces = []
    for (begin, width), (following, _) in zip(bounds, bounds[1:] + bounds[:1], strict=True):
        start = begin + width
        length = (following - start) % whole
        if length <= 0.0 or length > whole - width / 2.0:  # gaps that meet leave nothing between
            continue
        inner = (at[:-1] - start) % whole
        kept = np.flatnonzero((inner > 0.0) & (inner < length))
        kept = kept[np.argsort(inner[kept])]
        ends = [(start % whole), ((start + length) % whole)]
        piece = [
            np.vstack([_at(values, at, ends[0]), values[kept], _at(values, at, ends[1])])
            for values in (ring, across)
        ]
        pieces.append((piece[0], piece[1], False))
    return pieces


def _at(values: NDArray[np.float64], at: NDArray[np.float64], place: float) -> NDArray[np.float64]:
    """Values between those of points, at an arc length."""
    return np.array([np.interp(place, at, values[:, axis]) for axis in range(3)])


def wall(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    closed: bool,
    width: float,
    height: float,
    depth: float,
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """A wall along a line: vertices (4 n, 3) and faces (f, 4), watertight, facing outward.

    points, normals   (n, 3), of the line and of the surface below it
    depth             how far the wall goes on below the surface
    """
    count = len(points)
    if closed:
        tangents = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    else:
        tangents = np.gradient(points, axis=0)
    up = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    left = np.cross(up, tangents)
    left /= np.linalg.norm(left, axis=1, keepdims=True)
    half, low, high = width / 2.0 * left, -depth * up, height * up
    rows = [points + half + low, points + half + high, points - half + high, points - half + low]
    vertices = np.stack(rows, axis=1).reshape(-1, 3)
    here = 4 * np.arange(count if closed else count - 1)
    there = (here + 4) % (4 * count)
    sides = [
        np.column_stack([here + a, here + b, there + b, there + a])
        for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))
    ]
    if not closed:
        last = 4 * (count - 1)
        sides += [np.array([[3, 2, 1, 0]]), np.array([[last, last + 1, last + 2, last + 3]])]
    return vertices, np.vstack(sides)
