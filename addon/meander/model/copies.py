# SPDX-License-Identifier: GPL-3.0-or-later
"""Copies that are filled each by itself: moved apart while the curve grows, so that none meets or
sees another, and of those that are alike only one grows, whose lines the others get.

What has grown is then laid on all of them as a flow that makes no step, as with symmetry
(mirror_whole): all that is known of a curve is known of this one too. numpy only, no bpy.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import core
from .estimate import cost_of
from .geometry.congruence import Congruent, congruent
from .geometry.thinning import kept_points, with_points
from .mirror import at_rest
from .problem import Problem
from .steps import Steps

# Copies are alike where turned and moved ones differ by less than this, in their sizes and in r.
_ALIKE, _ALIKE_IN_R = 1e-4, 1e-2
# What lies between two copies, in r: no strand sees another from so far.
_APART = 40.0
# Points nearer to the last one than this, in spacings, are left out, as with symmetry.
_TOGETHER = 0.01


@dataclass(frozen=True)
class Copies:
    """Copies of a problem, what a flow solves of them, and what is needed to make a whole of it.

    problem   that is solved: of one of each kind, apart
    given     of all of them, apart
    middles   (n, 3) where they are; places (n, 3), where their middles are while they are apart
    cell      from one place to the next, along each axis
    counts    (3,) how many places there are along each axis
    alike     which of them is solved for each, and how that is turned
    density   of all; None: 1 everywhere
    times     how many times the area that is solved all have
    figures   of the surface of all: core.Surface.statistics(); cost, that a run there would have
    """

    problem: Problem
    given: Problem
    middles: NDArray[np.float64]
    places: NDArray[np.float64]
    cell: float
    counts: NDArray[np.int64]
    alike: Congruent
    density: NDArray[np.float64] | None
    times: float
    figures: dict[str, Any]
    cost: core.Cost | None

    @property
    def once(self) -> bool:
        """Whether some of them are alike, so that fewer are solved than there are."""
        return self.alike.is_fewer

    def density_of(
        self, density: NDArray[np.float64] | None
    ) -> tuple[NDArray[np.float64] | None, NDArray[np.float64] | None]:
        """Another density of all as the flow has it. Raises core.MeanderError where copies that
        are alike are solved once."""
        if density is not None and self.once:
            raise core.MeanderError(
                "Instances that are alike are filled once, so that a density cannot change while "
                "they grow; fill the mesh again",
                core.Status.INVALID_ARGUMENT,
            )
        return density, density

    def options_of(self, options: core.FlowOptions) -> core.FlowOptions:
        """Other options of all as the flow takes them."""
        return options

    def shown(self, curve: core.Polylines) -> core.Polylines:
        """A curve of those that are solved as all of them have it, where they are."""
        return self._on_all(curve, np.zeros(len(curve.closed), dtype=bool), self.middles)[0]

    def on_all_apart(
        self, curve: core.Polylines, guides: NDArray[np.bool_]
    ) -> tuple[core.Polylines, NDArray[np.bool_]]:
        """The same while they are apart, and which of its strands are guides."""
        return self._on_all(curve, guides, self.places)

    def back(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (n, 3) on copies that are apart, where these are."""
        which = self._which(points)
        return points + (self.middles - self.places)[which]

    def _which(self, points: NDArray[np.float64]) -> NDArray[np.int64]:
        """On which copy each point lies while they are apart."""
        steps = np.rint(points / self.cell).astype(np.int64)
        which = (steps[:, 2] * self.counts[1] + steps[:, 1]) * self.counts[0] + steps[:, 0]
        return np.clip(which, 0, len(self.places) - 1)

    def _on_all(
        self, curve: core.Polylines, guides: NDArray[np.bool_], places: NDArray[np.float64]
    ) -> tuple[core.Polylines, NDArray[np.bool_]]:
        of_copy: dict[int, list[int]] = {}
        firsts = curve.positions[np.asarray(curve.offsets[:-1], dtype=np.int64)]
        for strand, copy in enumerate(self._which(firsts).tolist()):
            of_copy.setdefault(copy, []).append(strand)
        points, normals, strands = [], [], []
        with_normals = len(curve.normals) > 0
        for copy, source in enumerate(self.alike.sources.tolist()):
            turn = self.alike.turns[copy].T
            for strand in of_copy.get(source, ()):
                span = slice(int(curve.offsets[strand]), int(curve.offsets[strand + 1]))
                own = curve.positions[span] - self.places[source]
                points.append(own @ turn + places[copy])
                normals += [curve.normals[span] @ turn] if with_normals else []
                strands.append(strand)
        offsets = np.cumsum([0] + [len(each) for each in points]).astype(np.uint32)
        none = np.empty((0, 3))
        found = core.Polylines(
            np.concatenate([none, *points]),
            np.concatenate([none, *normals]),
            offsets,
            np.asarray(curve.closed)[strands],
        )
        return found, guides[strands]


def copying(
    problem: Problem, accept: Callable[[core.Cost], None] | None = None
) -> Steps[Copies | None]:
    """The copies of a problem that has some; None where it is solved as it is: where faces join
    several, or a strand of the seed lies on none of them.

    accept   see opening.open_flow(); only where some are alike, for else that asks
    """
    sizes = problem.copies
    if sizes is None or len(sizes) < 2 or problem.mirror is not None:
        return None
    ends = np.cumsum(sizes)
    faces = np.asarray(problem.faces, dtype=np.int64)
    owners = np.searchsorted(ends, faces, side="right")
    if ends[-1] != len(problem.vertices) or (owners != owners[:, :1]).any():
        return None
    if (np.diff(owners[:, 0]) < 0).any():
        return None
    begins = ends - sizes
    middles = np.add.reduceat(problem.vertices, begins, axis=0) / sizes[:, None]
    of_vertex = np.repeat(np.arange(len(sizes)), sizes)
    own = problem.vertices - middles[of_vertex]
    cell = 2.0 * float(np.linalg.norm(own, axis=1).max()) + _APART * problem.options.radius
    counts, places = _places(len(sizes), cell)
    seed, radius = problem.seed, problem.options.radius
    if seed is not None:
        which = _copies_of_strands(seed, problem.vertices, begins, 0.1 * radius)
        if (which < 0).any():
            return None
        of_point = np.repeat(which, np.diff(np.asarray(seed.offsets, dtype=np.int64)))
        seed = replace(seed, points=seed.points + (places - middles)[of_point])
    given = replace(problem, vertices=own + places[of_vertex], seed=seed, copies=None)
    spans = np.searchsorted(owners[:, 0], np.arange(len(sizes) + 1))
    alike = congruent(own, begins, faces, spans, _ALIKE, _ALIKE_IN_R * radius)
    plain = problem.density is None and problem.directions is None and not _is_masked(problem)
    plain = plain and seed is None
    if not (plain and alike.is_fewer):
        alike = Congruent.of_all(len(sizes))
        return Copies(
            given, given, middles, places, cell, counts, alike, None, 1.0, {}, None
        )
    options = problem.options
    surface = yield core.Surface.work(
        given.vertices, given.faces, given.surface_options, options.threads
    )
    with surface:
        figures = surface.statistics()
        cost = cost_of((yield surface.extent_work()), options)
    if accept is not None:
        accept(cost)
    kept = np.unique(alike.sources)
    solved = _some(given, np.isin(of_vertex, kept), np.isin(owners[:, 0], kept))
    times = _area(given) / _area(solved)
    return Copies(
        solved, given, middles, places, cell, counts, alike, None, times, figures, cost
    )


def _copies_of_strands(
    seed: core.Seed, vertices: NDArray[np.float64], begins: NDArray[np.int64], beside: float
) -> NDArray[np.int64]:
    """The copy on which each strand lies: the smallest whose box holds it, or is at most `beside`
    it; -1: none does."""
    lows = np.minimum.reduceat(vertices, begins, axis=0) - beside
    highs = np.maximum.reduceat(vertices, begins, axis=0) + beside
    sizes = np.linalg.norm(highs - lows, axis=1)
    found = []
    for begin, end in zip(seed.offsets[:-1], seed.offsets[1:]):
        points = seed.points[int(begin) : int(end)]
        inside = (points.min(axis=0) >= lows) & (points.max(axis=0) <= highs)
        held = np.flatnonzero(inside.all(axis=1))
        found.append(int(held[np.argmin(sizes[held])]) if len(held) else -1)
    return np.array(found, dtype=np.int64)


def _places(count: int, cell: float) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """How many places there are along each axis, and the first so many of them, (n, 3)."""
    side = int(np.ceil(round(count ** (1.0 / 3.0), 9)))
    numbers = np.arange(count)
    steps = [numbers % side, numbers // side % side, numbers // (side * side)]
    return np.array([side, side, side]), cell * np.column_stack(steps).astype(np.float64)


def _is_masked(problem: Problem) -> bool:
    options = problem.surface_options
    return options is not None and (
        options.face_mask is not None or options.vertex_mask is not None
    )


def _some(problem: Problem, vertices: NDArray[np.bool_], faces: NDArray[np.bool_]) -> Problem:
    """Some vertices and the faces between them."""
    numbers = np.cumsum(vertices) - 1
    options = problem.surface_options
    if options is not None and options.polygons is not None:
        options = replace(options, polygons=np.asarray(options.polygons)[faces])
    return replace(
        problem,
        vertices=problem.vertices[vertices],
        faces=numbers[np.asarray(problem.faces, dtype=np.int64)[faces]].astype(np.uint32),
        surface_options=options,
    )


def _area(problem: Problem) -> float:
    a, b, c = (problem.vertices[problem.faces[:, corner]] for corner in range(3))
    area = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())
    return area if area > 0.0 else 1.0


class AllCopies:
    """The curve on all copies, where they are: as much of a flow as a result is made of.

    flow   of all of them, apart; closed with this where it was made for it
    """

    def __init__(self, flow: core.Flow, copies: Copies, own: bool) -> None:
        self._flow, self._copies, self._own = flow, copies, own

    def __enter__(self) -> AllCopies:
        return self

    def __exit__(self, *_why: object) -> None:
        if self._own:
            self._flow.close()

    def polylines(self) -> core.Polylines:
        return self._moved(self._flow.polylines())

    def rounded(self, tolerance: float) -> tuple[core.Polylines, core.PointData]:
        curve, data = self._flow.rounded(tolerance)
        return self._moved(curve), data

    def point_data(self) -> core.PointData:
        return self._flow.point_data()

    def guides(self) -> NDArray[np.bool_]:
        return self._flow.guides()

    def statistics(self) -> dict[str, Any]:
        return self._flow.statistics()

    def gaps(self, context: core.Context | None = None) -> core.Gaps:
        return self._placed(self._flow.gaps(context=context))

    def findings(
        self, gaps: bool = True, tolerance: float = 0.0, context: core.Context | None = None
    ) -> core.Findings:
        found = self._flow.findings(gaps, tolerance, context)
        return found._replace(
            polylines=self._moved(found.polylines),
            gaps=None if found.gaps is None else self._placed(found.gaps),
            drawn=found.drawn and (self._moved(found.drawn[0]), found.drawn[1]),
        )

    def _placed(self, gaps: core.Gaps) -> core.Gaps:
        return replace(gaps, positions=self._copies.back(gaps.positions))

    def _moved(self, curve: core.Polylines) -> core.Polylines:
        return curve._replace(positions=self._copies.back(curve.positions))


def laid_on_all(copies: Copies, grown: core.Flow, options: core.FlowOptions) -> AllCopies:
    """What has grown as all copies have it. Raises core.MeanderError.

    options   those that the flow has by now
    """
    if not copies.once:
        return AllCopies(grown, copies, own=False)
    curve = grown.polylines()
    curve = with_points(curve, kept_points(curve, _TOGETHER * 2.0 * options.radius))
    lines, guides = copies.on_all_apart(curve, grown.guides())
    seed = core.Seed(
        lines.positions,
        lines.offsets,
        np.asarray(lines.closed, dtype=np.uint8),
        guides=guides.astype(np.uint8),
        max_distance=options.radius,
    )
    given = copies.given
    with core.Surface(
        given.vertices, given.faces, given.surface_options, options.threads
    ) as surface:
        return AllCopies(core.Flow(surface, at_rest(options), seed), copies, own=True)
