# SPDX-License-Identifier: GPL-3.0-or-later
"""The line with round turns that a look draws: after a run, and when *Round* changes."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np

from .. import core
from ..model.geometry.simplification import result_points
from ..model.geometry.thinning import least_spacing, with_points
from ..model.opening import open_flow
from ..model.profile import radius_factors
from ..model.toolpaths import bridges
from ..scene import drawn_line, results
from ..scene.errors import DataError
from .plan import Plan, plan_of
from .stepper import Stepper


def tolerance_for(plan: Plan) -> float:
    """With how much rounding the result of a run will be drawn, in spacings."""
    earlier = plan.result.find() if plan.result else None
    if results.is_present(earlier):
        return drawn_line.tolerance_of(earlier)
    return plan.look.round if plan.look.radius > 0.0 else 0.0


def shown(
    plan: Plan,
    guides: np.ndarray,
    polylines: core.Polylines,
    radii: np.ndarray,
    spacing: float,
) -> tuple[core.Polylines, np.ndarray, np.ndarray, bridges.Joined | None]:
    """The curve as the result has it, r+ and r- of its points, which strands are guides, and the
    line that it was joined to, if it was.

    guides   which strands of the polylines are guides
    radii    (n, 2) r+ and r- of their points
    """
    kept = result_points(polylines, spacing, plan.light)
    curve, radii = with_points(polylines, kept), radii.take(kept, axis=0)
    line = bridges.joined(curve, spacing, guides) if plan.bridges else None
    if line is None:
        return curve, radii, guides, None
    return line.polylines, line.values(radii), line.guides, line


def draw_after_run(
    plan: Plan, stepper: Stepper, result: bpy.types.Object, spacing: float
) -> None:
    """Gives the look of a result the line that its run has left."""
    _draw(plan, stepper.drawn, stepper.guides, result, spacing)


def renew(
    result: bpy.types.Object, scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph
) -> None:
    """Draws a result anew as its look asks for. A curve that does not lie on its surface any more
    is drawn as it is."""
    tolerance, drawn, guides, plan, spacing = drawn_line.tolerance_of(result), None, None, None, 0.0
    if tolerance:
        try:
            plan = plan_of(result, scene, depsgraph)
            opened = open_flow(replace(plan.problem, mirror=None, copies=None))
            with opened.flow as flow:
                drawn, guides = flow.rounded(tolerance), flow.guides()
            spacing = least_spacing(plan.problem.options.radius, opened.density)
        except (DataError, core.MeanderError):
            drawn = None
    if drawn is None:
        drawn_line.draw(result, None, np.eye(4))
    else:
        _draw(plan, drawn, guides, result, spacing)


def on_output() -> None:
    """Draws what a script has asked for since; before a file is saved and a picture rendered."""
    curves = [each for each in bpy.data.objects if each.type == "CURVE" and each.library is None]
    for result in [each for each in curves if drawn_line.is_due(each)]:  # which adds and removes
        renew(result, bpy.context.scene, bpy.context.evaluated_depsgraph_get())


def _draw(
    plan: Plan,
    drawn: tuple[core.Polylines, core.PointData] | None,
    guides: np.ndarray,
    result: bpy.types.Object,
    spacing: float,
) -> None:
    if drawn is None:
        drawn_line.draw(result, None, plan.matrix)
        return
    polylines, data = drawn
    line, radii, are_guides, _joined = shown(plan, guides, polylines, data.radii, spacing)
    factors = radius_factors(radii, plan.problem.options.radius)
    hidden = None if result.meander.keep_guides else are_guides
    drawn_line.draw(result, line, plan.matrix, factors, hidden)
