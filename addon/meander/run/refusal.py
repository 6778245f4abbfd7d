# SPDX-License-Identifier: GPL-3.0-or-later
"""Why a run was refused, in words that name what is wrong with the mesh."""

from __future__ import annotations

import numpy as np

from .. import core
from ..model.preparation import refusal
from ..scene.errors import DataError
from ..scene.preparation import remember_problem
from ..scene.results import is_present
from .plan import Plan


def explain_refusal(plan: Plan, error: core.MeanderError) -> None:
    """Raises DataError with the faults of the mesh that a run was refused for, in words.

    The sentence stays with the surface, for the panel. Returns where the error has another reason.
    """
    surface, options = plan.surface.find(), plan.problem.surface_options
    if error.status != core.Status.INVALID_MESH or surface is None or options is None:
        return
    faces = plan.problem.faces
    if options.face_mask is not None:
        faces = faces[np.asarray(options.face_mask, dtype=bool)]
    if not len(faces):
        return
    faults = core.find_faults(plan.problem.vertices, faces)
    if not len(faults.kinds):
        return
    sentence = refusal(surface.name, faults, strict=not options.make_manifold)
    remember_problem(surface, sentence)
    raise DataError(sentence) from error


def refuse_deleted(plan: Plan) -> None:
    """Raises DataError where what a run grows on, or goes on with, has been deleted."""
    if plan.home.find(plan.surface.find()) is None:
        raise DataError("The surface was deleted while the curve was growing; start again")
    # A surface that is filled again gets a new curve where the last one is gone.
    if not plan.from_surface and not is_present(plan.result.find()):
        raise DataError("The curve was deleted while it was growing; start again")
