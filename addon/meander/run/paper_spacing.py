# SPDX-License-Identifier: GPL-3.0-or-later
"""What fills a surface so that its strands have one spacing on the paper that a camera draws on.

On the surface the spacing is as much more as things are smaller on paper where they are, so it
grows with the distance from the camera, within one surface too. Where a surface turns away from
the camera its strands close up on paper: that is what shows its shape.
"""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from .. import core
from ..model.camera import CameraPage
from ..model.field import FieldOn, evaluated
from ..model.geometry.clipped_mesh import Triangles
from ..model.problem import Problem, begin_along_directions
from ..scene.alignment import alignment_of, directions_of
from ..scene.camera import Seen
from ..scene.density import chosen_density, density_of
from ..scene.errors import DataError
from ..scene.flow_options import options_of
from ..scene.linked_settings import settings_of
from ..scene.meshes import triangles_of
from ..scene.settings import is_untouched

# Surfaces are filled so far beyond the frame, where strands turn round; in spacings.
BEYOND = 3.0
# The scale on paper changes by less from one end of an edge to the other: the density is linear in
# between.
_SCALES = 1.2


@dataclass(frozen=True)
class PaperSpacing:
    """A spacing on paper, in millimetres, for the surfaces of a scene.

    fallback   the settings of what nobody has set up; None: those that it has
    """

    page: CameraPage
    spacing: float
    depsgraph: bpy.types.Depsgraph
    fallback: bpy.types.PropertyGroup | None

    def problem_of(self, seen: Seen) -> Problem | str:
        """What fills a surface, or why it cannot be filled.

        Of the settings, those count that say how strands run and where they are closer: the spacing
        is the page's, seeds and masks are about a whole surface, and this one is cut off.
        """
        thing = None if seen.owner is None else seen.owner.find()
        own = None if thing is None else settings_of(thing)
        settings = own
        if own is None or self.fallback is not None and is_untouched(own):
            settings = self.fallback
        spacing = float(np.median(self._spacing_at(seen.mesh.vertices)))
        options = core.default_options() if settings is None else options_of(settings, spacing)
        options.radius = spacing / 2.0
        density = directions = alignment = None
        if own is not None:
            try:
                alignment = alignment_of(own)
                directions = directions_of(alignment, thing, self.depsgraph, options.radius)
                choice = chosen_density(own, thing)
                density = density_of(choice, thing, self.depsgraph, options.radius)
            except DataError as error:
                return str(error)
        options.alignment_weight = 0.0 if directions is None else alignment.weight
        mesh = self._divided(seen, thing, density, directions)
        problem = Problem(
            mesh.vertices,
            mesh.faces.astype(np.uint32),
            options,
            density=self._density(mesh, density, spacing),
            directions=directions if mesh.lines is None else mesh.lines,
            alignment="along" if alignment is None else alignment.kind,
        )
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
            mesh = whole.clipped(self.page.planes(BEYOND * self.spacing))
        return mesh.divided(self._spacing_at, _SCALES)

    def _density(
        self, mesh: Triangles, own: np.ndarray | FieldOn | None, spacing: float
    ) -> np.ndarray | FieldOn:
        """By the distance from the camera, and what the surface has of its own."""
        by_distance = (spacing / self._spacing_at(mesh.vertices)) ** 2
        if callable(own):
            return lambda surface, context=None: by_distance * evaluated(own, surface, context)
        return by_distance if mesh.values is None else by_distance * mesh.values
