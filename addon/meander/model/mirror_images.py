# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the mirror images of a surface's vertices lie on it: whether it is its own mirror image,
and what is known of one half, on both. numpy only, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import core
from .geometry.reflection import AXES, Mirror
from .problem import Problem

# How far the mirror image of a surface may lie beside the surface, in spacings.
_TOLERANCE = 0.1


@dataclass(frozen=True)
class Images:
    """The mirror images of the vertices of a problem's surface.

    mirror   its normal points to the half that counts
    places   of vertices that lie nowhere any
    """

    problem: Problem
    mirror: Mirror
    places: core.Closest

    def interpolated(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """What is known of vertices, (n,) or (n, d), at their mirror images."""
        corners = np.asarray(values, dtype=np.float64)[self.problem.faces[self.places.faces]]
        weights = self.places.weights
        return (corners * (weights if values.ndim == 1 else weights[:, :, None])).sum(axis=1)

    @property
    def other(self) -> NDArray[np.bool_]:
        """Which vertices take over what is known at their mirror images."""
        below = self.mirror.heights(self.problem.vertices) < 0.0
        return below & ~self.beside

    @property
    def beside(self) -> NDArray[np.bool_]:
        """Which vertices have an image that is farther from the surface than the tolerance."""
        return ~(self.places.distances <= _tolerance(self.problem))

    def on_both(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Values (n,) of the half that counts, on both."""
        return np.where(self.other, self.interpolated(values), values)

    def lines_on_both(self, directions: NDArray[np.float64]) -> NDArray[np.float64]:
        """The same of directions (n, 3)."""
        turned = self.mirror.turned(self.interpolated(directions))
        return np.where(self.other[:, None], turned, directions)

    def masks_on_both(self) -> core.SurfaceOptions | None:
        """How the surface is prepared, with the part to fill of one half on both."""
        problem, prepared = self.problem, self.problem.surface_options
        if prepared is None:
            return None
        changed: dict[str, Any] = {}
        if prepared.vertex_mask is not None:
            mask = np.asarray(prepared.vertex_mask, dtype=np.float64)
            changed["vertex_mask"] = self.on_both(mask)
        if prepared.face_mask is not None:
            mask = np.array(prepared.face_mask, dtype=bool)
            middles = problem.vertices[problem.faces].mean(axis=1)
            other = np.flatnonzero(self.mirror.heights(middles) < 0.0)
            images = self.mirror.images(middles[other])
            found = core.find_closest(problem.vertices, problem.faces, images)
            mask[other] = mask[found.faces] & (found.distances <= _tolerance(problem))
            changed["face_mask"] = mask
        return replace(prepared, **changed)

    def check_symmetry(self) -> None:
        """Raises core.MeanderError where the mirror image of what is filled lies beside the
        surface; where a part of the mesh is filled only the half that counts is looked at."""
        problem, mirror = self.problem, self.mirror
        filled, masked = _filled_vertices(problem)
        heights = mirror.heights(problem.vertices)
        if masked:
            filled &= heights >= 0.0
        if not (filled & (heights > 0.0)).any():
            upright = mirror.to_object[AXES.index(mirror.axis), :3] @ mirror.normal > 0.0
            raise core.MeanderError(
                f"Nothing lies on the {'positive' if upright else 'negative'} side of the plane "
                "of symmetry, whose half is filled; choose another axis, or move the object's "
                "origin",
                core.Status.INVALID_ARGUMENT,
            )
        beside = np.flatnonzero(filled & self.beside)
        if not len(beside):
            return
        farthest = beside[np.argmax(self.places.distances[beside])]
        place, distance = problem.vertices[farthest], self.places.distances[farthest]
        place = mirror.to_object[:3, :3] @ place + mirror.to_object[:3, 3]
        where = ", ".join(f"{value:.4g}" for value in place)
        raise core.MeanderError(
            f"The surface is not its own mirror image in {mirror.axis.upper()}: the image of the "
            f"vertex at ({where}), in the object's coordinates, lies {distance:.3g} beside it, "
            "more than a tenth of the spacing; make the halves alike, or choose another axis",
            core.Status.INVALID_ARGUMENT,
        )


def images_of(problem: Problem, mirror: Mirror) -> Images:
    """Where the mirror images of all vertices lie."""
    images = mirror.images(problem.vertices)
    somewhere = np.isfinite(images).all(axis=1)
    count = len(images)
    places = core.Closest(np.zeros(count, np.uint32), np.zeros((count, 3)), np.full(count, np.inf))
    found = core.find_closest(problem.vertices, problem.faces, images[somewhere])
    for mine, theirs in zip(places, found, strict=True):
        mine[somewhere] = theirs
    return Images(problem, mirror, places)


def _tolerance(problem: Problem) -> float:
    return _TOLERANCE * 2.0 * problem.options.radius


def _filled_vertices(problem: Problem) -> tuple[NDArray[np.bool_], bool]:
    """Which vertices are part of what is filled, and whether that is a part of the mesh only."""
    prepared, faces = problem.surface_options, np.asarray(problem.faces, dtype=np.int64)
    masked = False
    if prepared is not None and prepared.face_mask is not None:
        faces, masked = faces[np.asarray(prepared.face_mask, dtype=bool)], True
    filled = np.zeros(len(problem.vertices), dtype=bool)
    filled[faces.ravel()] = True
    if prepared is not None and prepared.vertex_mask is not None:
        filled &= np.asarray(prepared.vertex_mask) >= prepared.mask_threshold
        masked = True
    return filled, masked
