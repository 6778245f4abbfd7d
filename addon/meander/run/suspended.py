# SPDX-License-Identifier: GPL-3.0-or-later
"""The run that was ended last without a result, so that it can go on from where it was.

It is kept, with its flow and the memory of that, until another run begins, the surface or the
settings change so that it would be another curve, a file is opened, or the add-on goes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import bpy
import numpy as np

from ..scene.evaluated import matrix_of
from ..scene.linked_settings import settings_of
from ..scene.meshes import triangles_of
from ..scene.transforms import to_local
from .lasting import Activity
from .meaning import Meaning, meaning_of
from .outcome import Snapshot
from .plan import Plan, with_looks
from .stepper import Stepper


@dataclass(frozen=True)
class SuspendedRun:
    plan: Plan
    stepper: Stepper
    latest: Snapshot | None
    meaning: Meaning  # when the run began

    @property
    def progress(self) -> float:
        """How much of its expected length the curve has, in [0, 1]."""
        return self.latest.progress if self.latest is not None else 0.0


kept: Activity[SuspendedRun] = Activity()


def run_of(active: bpy.types.Object | None) -> SuspendedRun | None:
    """The run that can go on with this object active; drops it when it means another curve now.

    Cheap, for panels and polls.
    """
    run = kept.current
    if run is None or active is None or run.plan.settings.find() != active:
        return None
    if run.plan.surface.find() is None or not run.meaning.same_as(meaning_of(active)):
        kept.end()
        return None
    return run


def taken(now: Plan) -> SuspendedRun | None:
    """Hands out the run that is kept, if it is still what `now` plans; it is kept no longer.

    now   a new plan for the same object, whose choices of looks the run takes over
    """
    run = kept.taken()
    if run is None or not _same_problem(run.plan, now):
        return None
    plan = with_looks(run.plan, settings_of(now.settings.find()))
    return replace(run, plan=replace(plan, look=now.look, materials=now.materials))


def _same_problem(one: Plan, other: Plan) -> bool:
    """Whether two plans have the same faces, points in the surface's own space, and density.

    What Meaning cannot see, such as the pixels of an image.
    """
    mine, theirs = one.problem, other.problem
    if not np.array_equal(mine.faces, theirs.faces):
        return False
    points, others = to_local(mine.vertices, one.matrix), to_local(theirs.vertices, other.matrix)
    if not _same_points(points, others):
        return False
    if isinstance(mine.density, np.ndarray) and isinstance(theirs.density, np.ndarray):
        return np.array_equal(mine.density, theirs.density)
    return (mine.density is None) == (theirs.density is None)


def _same_points(points: np.ndarray, others: np.ndarray) -> bool:
    """Whether vertices are where they were, as far as single precision tells."""
    if points.shape != others.shape:
        return False
    extent = float(np.ptp(points, axis=0).max())
    return bool(np.abs(points - others).max() <= 1e-5 * extent)


def same_mesh(plan: Plan, surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> bool:
    """Whether a surface still has the triangles of a plan, of the same size in world units."""
    matrix = matrix_of(surface, depsgraph)
    metrics = [linear.T @ linear for linear in (plan.matrix[:3, :3], matrix[:3, :3])]
    if np.abs(metrics[0] - metrics[1]).max() > 1e-5 * np.trace(metrics[0]):
        return False
    vertices, faces = triangles_of(surface, depsgraph)
    problem = plan.problem
    return np.array_equal(problem.faces, faces) and _same_points(
        to_local(problem.vertices, plan.matrix), to_local(vertices, matrix)
    )
