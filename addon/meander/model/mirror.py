# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry: a curve grows on one half of a surface, and its mirror image fills the other.

The half is cut out along the plane, a little beside it, so that the curve keeps half a spacing from
the plane as it does from a boundary. What has grown and its image are then laid on the whole
surface, as a flow that makes no step (mirror_whole): all that is known of a curve is known of this
one too, and the library has checked that it crosses itself nowhere. numpy only, no bpy.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import core
from .estimate import cost_of
from .field import evaluating
from .geometry.facing_tips import kept_of
from .geometry.half_mesh import HalfMesh, above
from .geometry.reflection import Mirror
from .mirror_images import Images, images_of
from .problem import Problem
from .steps import Steps

# So far from the plane the half ends, in spacings: nothing on its boundary meets its own image.
_INSET = 0.01
# Vertices this near to the cut lie on it: in shortest edges around them, and in insets.
_SNAP_EDGES, _SNAP_INSETS = 1e-3, 0.25
# How far from the plane strands are led across it, in spacings, and by which weight.
_ACROSS, _ACROSS_WEIGHT = 4.0, 4.0


@dataclass(frozen=True)
class Half:
    """The half of a problem that a flow solves, and what is needed to make a whole of it.

    problem   of the half, without a mirror
    given     of the whole, with density and masks mirrored
    mirror    its normal points to the half
    mesh      of the half
    density   of the whole, per vertex; None: 1 everywhere
    figures   of the whole surface: core.Surface.statistics()
    fit       of the given seed, those of core.Flow.statistics(); empty: there is none
    cost      that a run on the whole surface is expected to have
    sources   the strand of the given seed that each one of the half's came from
    images    of the vertices of the whole
    led       the weight by which strands are led across the plane; 0: other directions lead them
    """

    problem: Problem
    given: Problem
    mirror: Mirror
    mesh: HalfMesh
    density: NDArray[np.float64] | None
    figures: dict[str, Any]
    fit: dict[str, Any]
    cost: core.Cost
    sources: NDArray[np.int64]
    images: Images
    led: float = 0.0

    def density_of(
        self, density: NDArray[np.float64] | None
    ) -> tuple[NDArray[np.float64] | None, NDArray[np.float64] | None]:
        """Another density of the whole as its half has it: mirrored, and on the half."""
        if density is None:
            return None, None
        whole = self.images.on_both(density)
        return whole, self.mesh.carried(whole)

    times = 2.0  # as long as what is solved the whole is

    def shown(self, curve: core.Polylines) -> core.Polylines:
        """A curve of the half with its mirror image."""
        return self.mirror.polylines(curve)

    def options_of(self, options: core.FlowOptions) -> core.FlowOptions:
        """Other options of the whole as the flow of the half takes them.

        Raises core.MeanderError for those that ask for another cut along the plane.
        """
        found, now = _at_boundaries(options, self.figures), self.problem.options
        if found.boundary_distance != now.boundary_distance or (
            found.radius != now.radius and now.boundary_distance != 0.5
        ):
            raise core.MeanderError(
                "With Symmetry the boundary distance, and the spacing with a boundary distance "
                "other than half of it, are those that a run begins with; fill the mesh again",
                core.Status.INVALID_ARGUMENT,
            )
        return replace(found, alignment_weight=self.led) if self.led else found


def halving(
    problem: Problem,
    context: core.Context | None = None,
    accept: Callable[[core.Cost], None] | None = None,
) -> Steps[Half]:
    """The half of a problem with a mirror; see opening.open_flow().

    Raises core.MeanderError with one sentence for a surface that is not its own mirror image, and
    for what does not go with symmetry.
    """
    _refuse(problem)
    options = problem.options

    def surface_of(of: Problem) -> core.Work[core.Surface]:
        return core.Surface.work(of.vertices, of.faces, of.surface_options, options.threads)

    with (yield surface_of(problem)) as surface:  # it names the faults of a mesh that is none
        density = yield from evaluating(problem.density, surface, context)
        directions = yield from evaluating(problem.directions, surface, context)
        before = surface.statistics()
        kept = _once(problem, surface, context) if before["doubled_faces"] else None
    mirror = _side(problem)
    images = images_of(problem, mirror)
    images.check_symmetry()
    if density is not None:
        density = images.on_both(np.asarray(density, dtype=np.float64))
    prepared = images.masks_on_both()
    if prepared is not None and kept is not None:
        masked = True if prepared.face_mask is None else np.asarray(prepared.face_mask, dtype=bool)
        prepared = replace(prepared, face_mask=kept & masked)
    given = replace(problem, density=density, surface_options=prepared, mirror=None)
    with (yield surface_of(given)) as surface:
        figures = surface.statistics()
        if kept is not None:
            # What was left out here as a part is a double still.
            figures |= {name: before[name] for name in ("doubled_faces", "dropped_faces")}
            figures["masked_faces"] = before["masked_faces"]
        cost = cost_of((yield surface.extent_work(density)), options, symmetric=True)
        if accept is not None:
            accept(cost)
        fit = yield from _fitting(surface, given)
    of_half = _at_boundaries(options, figures)
    mesh = _cut(given, mirror, density, of_half.boundary_distance)
    half_seed, sources = half_of_seed(problem.seed, mirror.heights, options.radius)
    if directions is not None:
        directions = images.lines_on_both(np.asarray(directions, dtype=np.float64))
    half = replace(
        given,
        vertices=mesh.vertices,
        faces=mesh.faces,
        options=of_half,
        seed=half_seed,
        density=None if density is None else mesh.carried(density),
        directions=None if directions is None else mesh.carried_lines(directions),
        surface_options=_of_half(prepared, mesh),
    )
    led = 0.0
    if mirror.across:
        half, led = _led_across(half, mirror)
    return Half(half, given, mirror, mesh, density, figures, fit, cost, sources, images, led)


def _led_across(half: Problem, mirror: Mirror) -> tuple[Problem, float]:
    """A half whose rows meet the plane with their hairpins, unless directions are given, and the
    weight of that."""
    if half.directions is not None and half.options.alignment_weight > 0.0:
        return half, 0.0
    spacings = np.full(len(half.vertices), 2.0 * half.options.radius)
    if half.density is not None:
        spacings /= np.sqrt(half.density)
    near = mirror.heights(half.vertices) < _ACROSS * spacings
    directions = np.where(near[:, None], mirror.normal, 0.0)
    options = replace(half.options, alignment_weight=_ACROSS_WEIGHT)
    led = replace(half, directions=directions, alignment="along", options=options)
    return led, _ACROSS_WEIGHT


def _once(
    problem: Problem, surface: core.Surface, context: core.Context | None
) -> NDArray[np.bool_]:
    """Which faces a surface has, (m,), of a mesh with doubles. A half of such a mesh is cut where
    the plane cuts each twin, and their pieces are no doubles any more.

    In the middle of a face that is there nothing is nearer than that face, and in the middle of one
    that is not, what is in its place.
    """
    middles = problem.vertices[problem.faces].mean(axis=1)
    kept = np.zeros(len(problem.faces), dtype=bool)
    kept[surface.find_closest(middles, problem.options.threads, context).faces] = True
    return kept


def _refuse(problem: Problem) -> None:
    """Raises for what does not go with symmetry."""
    prepared = problem.surface_options
    told = ""
    if problem.outline:
        told = "An outline would run along the plane of symmetry too; turn off one of the two"
    elif problem.least_bend_radius:
        told = (
            "The two crossings of the plane of symmetry turn by half a spacing, which no least "
            "bend radius holds; turn off one of the two"
        )
    elif prepared is not None and prepared.smallest_part:
        told = (
            "Symmetry halves parts, so that their size does not say which to leave out; set the "
            "smallest part to 0, and mask or delete what is not to be filled"
        )
    if told:
        raise core.MeanderError(told, core.Status.INVALID_ARGUMENT)


def _side(problem: Problem) -> Mirror:
    """The mirror whose normal points to the half that counts: the other one where that has two
    thirds of the seed, else the positive one."""
    mirror, seed = problem.mirror, problem.seed
    if seed is None or 3 * np.count_nonzero(mirror.heights(seed.points) > 0.0) >= len(seed.points):
        return mirror
    return replace(mirror, normal=-mirror.normal)


def _fitting(surface: core.Surface, given: Problem) -> Steps[dict[str, Any]]:
    """How a seed lies on the whole surface; raises what is wrong with it."""
    if given.seed is None:
        return {}
    work = core.Flow.work(surface, at_rest(given.options), given.seed, given.density)
    with (yield work) as flow:
        return {key: value for key, value in flow.statistics().items() if key.startswith("seed_")}


def at_rest(options: core.FlowOptions) -> core.FlowOptions:
    """Options of a flow that only holds a curve, with the segments it has at rest: with the long
    ones of growth, nodes of tips would go."""
    tunings = {**options.tunings, "growth_coarsening": 1.0}
    return replace(options, start=core.Start.GROW, start_spacing_factor=1.0, tunings=tunings)


def _at_boundaries(options: core.FlowOptions, figures: dict[str, Any]) -> core.FlowOptions:
    """Options with which a curve never leaves its half: at the boundary of that it comes to rest
    half a spacing from the plane, or nearer where the surface has boundaries of its own.

    figures   of the whole surface
    """
    distance = options.boundary_distance
    if not figures["boundary_loops"] or options.boundary_rule == core.BoundaryRule.OBSTACLE:
        distance = 0.5
    elif distance > 0.5:
        raise core.MeanderError(
            "With Symmetry strands keep at most half a spacing from boundaries; set the boundary "
            "distance to 0.5 or less",
            core.Status.INVALID_ARGUMENT,
        )
    return replace(
        options, boundary_distance=distance, boundary_rule=core.BoundaryRule.CENTRE
    )


def _cut(
    given: Problem, mirror: Mirror, density: NDArray[np.float64] | None, at_boundary: float
) -> HalfMesh:
    """The half at whose boundary the curve comes to rest half a spacing from the plane.

    at_boundary   how far from a boundary that is, in spacings, at most 0.5
    """
    spacings = np.full(len(given.vertices), 2.0 * given.options.radius)
    if density is not None:
        spacings /= np.sqrt(density)
    beyond = 0.5 - at_boundary + _INSET
    heights = mirror.heights(given.vertices) - beyond * spacings
    faces = np.asarray(given.faces, dtype=np.int64)
    shortest = np.full(len(given.vertices), np.inf)
    for corner in range(3):
        one, other = faces[:, corner], faces[:, (corner + 1) % 3]
        lengths = np.linalg.norm(given.vertices[one] - given.vertices[other], axis=1)
        for end in (one, other):
            np.minimum.at(shortest, end, lengths)
    tolerance = np.minimum(_SNAP_EDGES * shortest, _SNAP_INSETS * _INSET * spacings)
    return above(given.vertices, faces, heights, tolerance)


def _of_half(
    prepared: core.SurfaceOptions | None, mesh: HalfMesh
) -> core.SurfaceOptions | None:
    if prepared is None:
        return None
    changed: dict[str, Any] = {}
    if prepared.vertex_mask is not None:
        changed["vertex_mask"] = mesh.carried(prepared.vertex_mask)
    if prepared.face_mask is not None:
        changed["face_mask"] = np.asarray(prepared.face_mask, dtype=bool)[mesh.sources]
    if prepared.polygons is not None:
        changed["polygons"] = np.asarray(prepared.polygons)[mesh.sources]
    return replace(prepared, **changed)


_Piece = tuple[NDArray[np.float64], NDArray[np.uint8], bool]  # points, fixed, closed


def half_of_seed(
    seed: core.Seed | None,
    heights: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    radius: float,
) -> tuple[core.Seed | None, NDArray[np.int64]]:
    """The seed where `heights` is above 0, and the given strand that each of its strands is of.

    A strand that grows is closed again where one piece of a closed one is left, half a radius from
    the plane; other pieces are open. Guides end at the plane. None where nothing is left.
    """
    sources: list[int] = []
    found: list[_Piece] = []
    guides: list[bool] = []
    if seed is None:
        return None, np.zeros(0, dtype=np.int64)
    fixed = np.zeros(len(seed.points), dtype=np.uint8) if seed.fixed is None else seed.fixed
    for k, (begin, end) in enumerate(zip(seed.offsets[:-1], seed.offsets[1:], strict=True)):
        points = np.asarray(seed.points[begin:end], dtype=np.float64)
        guide = seed.guides is not None and bool(seed.guides[k])
        flags = np.asarray(fixed[begin:end])
        if seed.closed[k] and not guide and not flags.any():
            kept = kept_of(points, heights(points) > 0.0, 2.0 * radius)
            points, flags = points[kept], flags[kept]
        pieces = _pieces(points, flags, bool(seed.closed[k]), heights)
        if not guide and len(pieces) == 1 and seed.closed[k] and not pieces[0][2]:
            pieces = [_closed(pieces[0], heights, radius)]
        for piece in pieces:
            sources.append(k)
            found.append(piece)
            guides.append(guide)
    if not found:
        return None, np.zeros(0, dtype=np.int64)
    half = replace(
        seed,
        points=np.vstack([points for points, _fixed, _closed in found]),
        offsets=np.cumsum([0] + [len(points) for points, _f, _c in found]).astype(np.uint32),
        closed=np.array([closed for _points, _fixed, closed in found], dtype=np.uint8),
        fixed=np.concatenate([flags for _points, flags, _closed in found]).astype(np.uint8),
        guides=np.array(guides, dtype=np.uint8),
        loops=seed.loops or all(guides),
    )
    return half, np.array(sources, dtype=np.int64)


def _pieces(
    points: NDArray[np.float64],
    fixed: NDArray[np.uint8],
    closed: bool,
    heights: Callable[[NDArray[np.float64]], NDArray[np.float64]],
) -> list[_Piece]:
    """The pieces of a strand above the plane, with a point in it where they end there."""
    above = heights(points) > 0.0
    if above.all():
        return [(points, fixed, closed)]
    if not above.any():
        return []
    if closed:  # begin where it is below
        first = int(np.argmin(above))
        points, fixed, above = (np.roll(each, -first, axis=0) for each in (points, fixed, above))
        points, fixed = np.vstack([points, points[:1]]), np.concatenate([fixed, fixed[:1]])
        above = np.concatenate([above, above[:1]])
    pieces: list[_Piece] = []
    edges = np.flatnonzero(np.diff(np.concatenate([[0], above.astype(np.int8), [0]])))
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        own, flags = points[begin:end], fixed[begin:end]
        if begin > 0:
            own = np.vstack([_in_plane(points[begin - 1], own[0], heights), own])
            flags = np.concatenate([[0], flags])
        if end < len(points):
            own = np.vstack([own, _in_plane(own[-1], points[end], heights)])
            flags = np.concatenate([flags, [0]])
        pieces.append((own, flags.astype(np.uint8), False))
    return pieces


def _in_plane(
    one: NDArray[np.float64],
    other: NDArray[np.float64],
    heights: Callable[[NDArray[np.float64]], NDArray[np.float64]],
) -> NDArray[np.float64]:
    here, there = heights(np.stack([one, other]))
    return one + here / (here - there) * (other - one)


def _closed(
    piece: _Piece,
    heights: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    radius: float,
) -> _Piece:
    """A piece that begins and ends in the plane as a closed strand beside it; as it is where too
    little of it is left."""
    points, fixed, _is_closed = piece
    away = np.flatnonzero(heights(points) > radius / 2.0)
    if len(away) < 3:
        return piece
    kept = slice(int(away[0]), int(away[-1]) + 1)
    return points[kept], fixed[kept], True
