# SPDX-License-Identifier: GPL-3.0-or-later
"""The light that a camera sees on surfaces, as the tone of what is drawn of them.

What counts is how dark it is on paper. There strands that lie across a slope close up, and those
that lie along it become shorter. So strands are set apart by what their direction comes to, which
is level on paper where nobody has chosen another.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy
import numpy as np
from numpy.typing import NDArray

from .. import core
from ..model.camera import CameraPage
from ..model.density import shares_of_ink
from ..model.geometry.clipped_mesh import Triangles
from ..model.lighting import light_on, vertex_normals
from ..model.options.option import OF_PRESET
from ..model.picture.line import ALIGNMENT, SEGMENT
from ..model.picture.tone import Tone, exposed, light_of, lightness, weighted_levels
from ..model.problem import Problem
from ..scene.camera import Rays, Sight, casting_shadows
from ..scene.errors import DataError
from ..scene.lighting import ambient_of, lamps_of

# Light is known at the ends of edges, which are no longer on paper: in widths of the line, and of
# the longer side of the frame.
_LONGEST, _OF_FRAME = 2.0, 0.002
# The steepest slope, as the cosine of its angle to the view, that strands are set apart for.
_STEEPEST = 0.2
# So far, in millimetres of paper, a point is lifted off its surface before light is looked for.
_LIFT = 0.05
# So many points of each surface say how light and how dark the drawing has to be.
_ASKED = 20_000
# Densities of one surface vary by no more (meander.h).
MOST_RATIO = 1e4


@dataclass(frozen=True)
class _Taken:
    """A surface whose light is known.

    more      how many times as much ink its strands have on paper as on the surface
    weights   how much of the picture each vertex stands for; 0 where it was not asked
    """

    problem: Problem
    light: NDArray[np.float64]
    more: NDArray[np.float64]
    weights: NDArray[np.float64]


@dataclass
class Shading:
    """How surfaces are drawn as bright as lamps make them.

    pen   width of the line, in millimetres
    """

    page: CameraPage
    tone: Tone
    pen: float
    depsgraph: bpy.types.Depsgraph
    sight: Sight
    _taken: list[_Taken] = field(default_factory=list)

    def __post_init__(self) -> None:
        scene, layer = self.depsgraph.scene, self.depsgraph.view_layer
        self._lamps = lamps_of(layer, self.depsgraph)
        self._ambient = ambient_of(scene.world)
        if not self._lamps and self._ambient <= 0.0:
            raise DataError("The scene has no light; add a lamp, or leave Tone off")
        self._rays = Rays(casting_shadows(layer, self.depsgraph))

    def divided(self, mesh: Triangles) -> Triangles:
        """The mesh, fine enough for what light does on it."""
        longest = max(_LONGEST * self.pen, _OF_FRAME * float(self.page.sides.max()))

        def too_long(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
            ends = self.page.on_paper(points)[edges]
            return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) > longest

        return mesh.halved(too_long)

    def begin(self, options: core.FlowOptions, settings: bpy.types.PropertyGroup | None) -> None:
        """Has a surface begin full, which has better tones and takes less time, where nobody asked
        for something else, and its segments as long as those of pictures."""
        if settings is None or settings.start == OF_PRESET.upper():
            options.start = core.Start.FULL
        options.segment_length = max(options.segment_length, SEGMENT * options.radius)

    def take(self, problem: Problem, mesh: Triangles, own: NDArray | None) -> None:
        """Takes the light on a surface.

        problem   its density is that of a place that has as much ink as the pen has width in a
                  spacing; finish() sets what it becomes
        own       how bright its vertices are by themselves; None: white
        """
        points = mesh.vertices
        flat = vertex_normals(points, mesh.faces)
        eye, _before = self.page.towards_eye(points)
        facing = np.einsum("ij,ij->i", flat, eye)
        # Sheets are seen from both sides.
        side = np.where(facing < 0.0, -1.0, 1.0)[:, None]
        normals = flat
        if mesh.normals is not None:
            length = np.linalg.norm(mesh.normals, axis=1)[:, None]
            smooth = mesh.normals / np.where(length > 0.0, length, 1.0)
            normals = np.where(length > 1e-9, smooth, flat)
        lift = (_LIFT / self.page.millimetres(points))[:, None]
        reach = self._rays.reach
        starts = points + lift * side * flat
        light = light_on(starts, side * normals, self._lamps, self._ambient, reach)
        if own is not None:
            light = light * own
        if problem.directions is None:
            # At right angles to the way up on paper.
            problem.directions = np.cross(self.page.view[1, :3], flat)
            problem.alignment, problem.options.alignment_weight = "along", ALIGNMENT
        more = _more_ink(problem, flat, eye, np.abs(facing).clip(_STEEPEST, 1.0))
        self._taken.append(_Taken(problem, light, more, self._seen(points, mesh)))

    def _seen(self, points: np.ndarray, mesh: Triangles) -> NDArray[np.float64]:
        """How much of the picture each vertex stands for; 0 where it was not asked."""
        corners = self.page.on_paper(points)[mesh.faces]
        one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        area = np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])
        weights = sum(
            np.bincount(mesh.faces[:, corner], weights=area, minlength=len(points))
            for corner in range(3)
        )
        asked = np.arange(0, len(points), max(1, len(points) // _ASKED))
        found = np.zeros(len(points))
        found[asked] = np.where(self.sight(points[asked]), weights[asked], 0.0)
        return found / max(len(asked), 1)

    def finish(self, spacing: float) -> None:
        """Sets the densities of all that was taken.

        spacing   on paper, where a density of 1 is
        """
        if not self._taken:
            return
        weights = np.concatenate([each.weights for each in self._taken])
        light = exposed(np.concatenate([each.light for each in self._taken]), weights, self.tone)
        levels = weighted_levels(lightness(light.clip(0.0, 1.0)), weights, self.tone)
        value_range = tuple(light_of(np.array(levels)).tolist())
        ends = np.cumsum([len(each.light) for each in self._taken])[:-1]
        for each, own in zip(self._taken, np.split(light, ends)):
            share = shares_of_ink(own, self.tone, value_range) / each.more
            density = each.problem.density * (share * spacing / self.pen) ** 2
            each.problem.density = np.maximum(density, density.max() / MOST_RATIO)
        self._taken.clear()


def _more_ink(
    problem: Problem, normals: NDArray, eye: NDArray, cosine: NDArray[np.float64]
) -> NDArray[np.float64]:
    """How many times as much ink strands have on paper where a surface is seen under an angle: what
    becomes of their length over what becomes of the area. Where it is not known how they lie, the
    length is the mean over all directions."""
    if isinstance(problem.directions, np.ndarray):
        lines = problem.directions
        if problem.alignment == "across":
            lines = np.cross(normals, lines)
        length = np.linalg.norm(lines, axis=1)
        away = np.einsum("ij,ij->i", lines, eye) / np.where(length > 0.0, length, 1.0)
        return np.sqrt(1.0 - np.square(away).clip(max=1.0)).clip(min=_STEEPEST) / cosine
    angles = (np.arange(32) + 0.5) * (np.pi / 64.0)
    across, along = np.cos(angles)[:, None], np.sin(angles)[:, None]
    return np.sqrt((cosine * across) ** 2 + along**2).mean(axis=0) / cosine
