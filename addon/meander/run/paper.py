# SPDX-License-Identifier: GPL-3.0-or-later
"""What fills surfaces at one spacing on paper, and what that comes to.

On a surface the spacing is as much more as things are smaller on paper where they are, so it grows
with the distance from the camera, within one surface too.

For the estimate every surface is measured once. Another spacing on paper, or a larger page, is the
same drawing under a magnifying glass, and so it is arithmetic.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import bpy
import numpy as np

from .. import core
from ..model.camera import CameraPage
from ..model.estimate import Estimate, estimated, together
from ..model.field import FieldOn, evaluated
from ..model.geometry.clipped_mesh import Triangles
from ..model.problem import Problem, begin_along_directions
from ..scene.alignment import alignment_of, directions_of
from ..scene.camera import Seen
from ..scene.density import chosen_density, density_of, painted_values
from ..scene.errors import DataError
from ..scene.linked_settings import settings_of
from ..scene.meshes import triangles_of
from ..scene.options import options_of
from ..scene.settings import is_untouched
from . import estimate
from .shading import MOST_RATIO, Shading

# Surfaces are filled so far beyond the frame, where strands turn round; in spacings. With a tone
# some strands are several times as far apart.
_BEYOND, _BEYOND_OF_TONE = 3.0, 8.0
# What is narrower on paper, in spacings, is seen edge on.
_EDGE = 0.1
# The scale on paper changes by less from one end of an edge to the other: the density is linear in
# between.
_SCALES = 1.2


def beyond(spacing: float, toned: bool) -> float:
    """By how many millimetres what is filled is larger than the frame, on all sides."""
    return (_BEYOND_OF_TONE if toned else _BEYOND) * spacing


@dataclass(frozen=True)
class PaperSpacing:
    """A spacing on paper, in millimetres, for the surfaces of a scene.

    fallback   the settings of what nobody has set up; None: those that it has
    closer     sentences about surfaces whose far end is drawn closer than that
    shading    makes the drawing as dark as the scene; its spacing varies then. It is to be
               finished once all problems are there
    """

    page: CameraPage
    spacing: float
    depsgraph: bpy.types.Depsgraph
    fallback: bpy.types.PropertyGroup | None
    closer: list[str] = field(default_factory=list)
    shading: Shading | None = None  # the tone; None: one spacing

    def _width(self, mesh: Triangles) -> float:
        """The area of a surface on paper over its longest side there, in millimetres."""
        corners = self.page.on_paper(mesh.vertices)[mesh.faces]
        one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        area = 0.5 * np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum()
        longest = np.ptp(corners.reshape(-1, 2), axis=0).max()
        return float(area / longest) if longest > 0.0 else 0.0

    def problem_of(self, seen: Seen) -> Problem | str:
        """What fills a surface, or why it cannot be filled.

        Of the settings, those count that say how strands run and where they are closer: the spacing
        is the page's, seeds and masks are about a whole surface, and this one is cut off.
        """
        if self._width(seen.mesh) < _EDGE * self.spacing:
            return f"'{seen.name}' is seen edge on; turn it, or the camera"
        thing = None if seen.owner is None else seen.owner.find()
        own = None if thing is None else settings_of(thing)
        settings = own
        if own is None or self.fallback is not None and is_untouched(own):
            settings = self.fallback
        spacing = float(np.median(self._spacing_at(seen.mesh.vertices)))
        options = core.default_options() if settings is None else options_of(settings, spacing)
        options.radius = spacing / 2.0
        density = directions = alignment = bright = None
        if own is not None:
            try:
                alignment = alignment_of(own)
                directions = directions_of(alignment, thing, self.depsgraph, options.radius)
                choice = chosen_density(own, thing)
                if self.shading is None:
                    density = density_of(choice, thing, self.depsgraph, options.radius)
                elif choice.is_tone:
                    bright = painted_values(choice, thing, self.depsgraph, "tone")
            except DataError as error:
                return str(error)
        options.alignment_weight = 0.0 if directions is None else alignment.weight
        mesh = self._divided(seen, thing, density if bright is None else bright, directions)
        if bright is not None:
            bright, mesh = mesh.values, replace(mesh, values=None)
        problem = Problem(
            mesh.vertices,
            mesh.faces.astype(np.uint32),
            options,
            density=self._density(seen.name, mesh, density, spacing),
            directions=directions if mesh.lines is None else mesh.lines,
            alignment="along" if alignment is None else alignment.kind,
        )
        if self.shading is not None:
            self.shading.begin(options, settings)
            self.shading.take(problem, mesh, bright)
        begin_along_directions(problem)
        return problem

    def _spacing_at(self, points: np.ndarray) -> np.ndarray:
        """What the spacing on paper is at points of the world, in its units."""
        return self.spacing / self.page.millimetres(points)

    def _divided(
        self,
        seen: Seen,
        thing: bpy.types.Object | None,
        density: np.ndarray | FieldOn | None,
        directions: np.ndarray | FieldOn | None,
    ) -> Triangles:
        """The mesh with what is known at its vertices, fine enough for a density by distance."""
        mesh = seen.mesh
        values, lines = (
            each if isinstance(each, np.ndarray) else None for each in (density, directions)
        )
        if values is not None or lines is not None:
            vertices, faces = triangles_of(thing, self.depsgraph)
            whole = Triangles(vertices, faces.astype(np.int64), values, lines)
            margin = beyond(self.spacing, self.shading is not None)
            mesh = whole.clipped(self.page.planes(margin))
        mesh = mesh.divided(self._spacing_at, _SCALES)
        return mesh if self.shading is None else self.shading.divided(mesh)

    def _density(
        self, name: str, mesh: Triangles, own: np.ndarray | FieldOn | None, spacing: float
    ) -> np.ndarray | FieldOn:
        """By the distance from the camera, and what the surface has of its own, within what the
        library takes."""
        by_distance = (spacing / self._spacing_at(mesh.vertices)) ** 2
        most = by_distance.max()
        of_its_own = 1.0 if mesh.values is None else mesh.values.max() / mesh.values.min()
        least = most * min(1.0, of_its_own / MOST_RATIO)
        if by_distance.min() < least:
            self.closer.append(
                f"'{name}' reaches from very near to very far away; its far end is drawn closer "
                "than the spacing"
            )
            by_distance = np.maximum(by_distance, least)
        if callable(own):
            return lambda surface, context=None: by_distance * evaluated(own, surface, context)
        return by_distance if mesh.values is None else by_distance * mesh.values


class DrawingEstimate:
    """Of what is to be filled for a page."""

    def __init__(self, problems: Iterable[Problem], spacing: float, width: float) -> None:
        """spacing, width   of strands and of the picture on paper, in millimetres"""
        self._spacings = width / spacing  # across the picture
        self._parts: list[tuple[core.Extent, core.FlowOptions]] = []
        for problem in problems:
            try:
                self._parts.append((estimate.extent_of_problem(problem), problem.options))
            except core.MeanderError:  # its run will report why, and leaves it out
                continue

    def at(self, spacing: float, width: float) -> Estimate | None:
        """What the same picture comes to at another spacing and size; None: nothing is known."""
        larger = width / spacing / self._spacings
        return together(
            [
                estimated(_magnified(extent, larger), options, False, estimate.speeds)
                for extent, options in self._parts
            ]
        )

    def cost(self) -> core.Cost:
        """What the library needs for it. The memory is that of the largest surface."""
        costs = [core.estimate_cost(extent, options) for extent, options in self._parts]
        return core.Cost(
            sum(cost.nodes for cost in costs),
            sum(cost.points for cost in costs),
            sum(cost.length for cost in costs),
            max((cost.memory for cost in costs), default=0.0),
            sum(cost.processor_seconds for cost in costs),
        )


def _magnified(extent: core.Extent, larger: float) -> core.Extent:
    """An extent whose lengths are all `larger` times what they were."""
    return replace(
        extent,
        length_area=extent.length_area * larger**2,
        node_area=extent.node_area * larger**2,
        edge_density=extent.edge_density / larger,
        curvature=extent.curvature / larger**2,
    )
