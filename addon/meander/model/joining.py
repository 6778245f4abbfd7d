# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a mesh that only look joined, and the distance that makes them one; no bpy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .. import core
from .geometry.inside_out import bodies
from .preparation import seam_width
from .problem import Problem

# How far apart borders may be that look joined, in spacings.
_NEAR = 0.01
# Of how many parts it is looked at which of them lie on others.
_MOST_PARTS = 200


@dataclass(frozen=True)
class Joining:
    """Vertices within `distance` of each other made one would leave so many parts."""

    distance: float
    parts: int


def joining_of(problem: Problem, figures: Mapping[str, Any]) -> Joining | None:
    """The least distance, to within a factor of two, that joins as many parts of a mesh as a
    hundredth of the spacing does; None where that joins fewer than half of them.

    problem   what was filled; its surface is prepared anew, a few times
    figures   of core.Surface.statistics(), of that surface
    """
    parts, options = int(figures["components"]), problem.surface_options
    if parts < 2 or not figures["boundary_loops"] or options is None:
        return None
    radius = problem.options.radius
    least = max(options.merge_distance, seam_width(problem.vertices, radius))
    found = None
    distance = _rounded(2.0 * _NEAR * radius)
    while distance > least:
        left = _parts(problem, replace(options, merge_distance=distance))
        if left > parts // 2 if found is None else left > found.parts:
            break
        found = Joining(distance, left)
        distance = _rounded(distance / 2.0)
    return found


def lying_on_others(problem: Problem, figures: Mapping[str, Any]) -> int:
    """How many parts of a mesh lie on larger ones, to within a hundredth of the spacing, such as a
    decal on a wall: what is filled there is filled twice. Parts are what hangs together by its
    corners; 0 where there are more than are worth looking at, or where doubles were left out.

    figures   of core.Surface.statistics(), of the surface that was filled
    """
    vertices, faces = problem.vertices, np.asarray(problem.faces, dtype=np.int64)
    options = problem.surface_options
    if options is not None and options.face_mask is not None:
        faces = faces[np.asarray(options.face_mask, dtype=bool)]
    if int(figures["components"]) < 2 or figures.get("doubled_faces", 0):
        return 0
    body = bodies(faces, len(vertices))[faces[:, 0]]
    labels, number = np.unique(body, return_inverse=True)
    if not 1 < len(labels) <= _MOST_PARTS:
        return 0
    corners = vertices[faces]
    sides = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = np.bincount(number, weights=np.linalg.norm(np.cross(*sides), axis=1))
    rank = np.argsort(np.argsort(-areas, kind="stable"))
    reach, count = 2.0 * _NEAR * problem.options.radius, 0
    low, high = corners.min(axis=1) - reach, corners.max(axis=1) + reach
    for part in range(len(labels)):
        own = corners[number == part]
        asked = np.vstack([own.reshape(-1, 3), own.mean(axis=1)])
        near = (low <= asked.max(axis=0)).all(axis=1) & (high >= asked.min(axis=0)).all(axis=1)
        others = faces[near & (rank[number] < rank[part])]
        if len(others):
            count += bool((core.find_closest(vertices, others, asked).distances <= reach).all())
    return count


def _rounded(distance: float) -> float:
    """As it is written: nobody types more digits."""
    return float(f"{distance:.2g}")


def _parts(problem: Problem, options: core.SurfaceOptions) -> int:
    try:
        with core.Surface(
            problem.vertices, problem.faces, options, problem.options.threads
        ) as surface:
            return int(surface.statistics()["components"])
    except core.MeanderError:  # nothing is left of it
        return int(1e9)
