# SPDX-License-Identifier: GPL-3.0-or-later
"""What the line of a finished run says of its seed, its stiffness, its tones and its bridges."""

from __future__ import annotations

from typing import Any

import bpy

from ..model import strands
from ..model.toolpaths import bridges
from ..scene.lengths import length_text
from .session import Session


def remarks(
    session: Session, context: bpy.types.Context, result: bpy.types.Object, figures: dict[str, Any]
) -> tuple[str, str]:
    """What to add to the summary about the seed, tones and bridges, and what to warn of; empty if
    nothing.

    result, figures   of keep()
    """
    plan = session.plan
    radius = plan.problem.options.radius
    scene, _view_layer = plan.home.find(plan.surface.find()) or (context.scene, None)
    remark = strands.fit_remark(
        figures, plan.parts, radius, lambda value: length_text(scene, value)
    )
    if session.stepper.stiffening.best is not None:
        stiffness = session.stepper.problem.options.bending_weight
        remark = "; ".join(filter(None, (remark, f"a stiffness of {stiffness:g}")))
    off = session.stepper.tone_error
    if off is not None:
        told = f"tones right to {off:.3f} of the range"
        remark = "; ".join(filter(None, (remark, told)))
    joined = result.meander.figures
    if joined.bridge_count:
        length = length_text(scene, joined.bridge_length)
        remark = "; ".join(
            filter(None, (remark, bridges.described(joined.bridge_count, length)))
        )
    warnings = (session.stepper.defect, strands.fit_warning(figures, plan.parts))
    return remark, "; ".join(filter(None, warnings))
