# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run would start from, drawn over the views: strands, guides and loops on the surface.

It is no data of Blender's, and goes as soon as it would be another: when the seed, the surface or
a setting has changed, with undo, another file, and the run itself.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import bpy
import numpy as np

from .. import core
from ..model import strands
from ..model.opening import open_flow
from ..scene.identity import Key
from ..scene.lengths import length_text
from ..scene.meshes import in_polygons
from .lasting import Activity
from .meaning import Meaning, meaning_of
from .plan import Plan, plan_of
from .preview import GrowingCurve
from .window import redraw

# How far in front of the surface it is drawn, in spacings, and how wide, in pixels.
_LIFT, WIDTH = 0.15, 3.0
_STRANDS, _GUIDES, _PROBLEM = (1.0, 0.5, 0.05), (0.1, 0.75, 0.95), (1.0, 0.1, 0.1)
# The size of a mark where a seed is refused, in spacings.
_MARK = 0.5


@dataclass
class Shown:
    active: Key  # whose settings they are
    meaning: Meaning
    curves: list[GrowingCurve]


def _remove(shown: Shown) -> None:
    for curve in shown.curves:
        curve.remove()
    redraw("WINDOW", "UI")


preview: Activity[Shown] = Activity(_remove, undone=True)


@dataclass(frozen=True)
class Found:
    """What a run would start from, in figures.

    strands, guides   how many, loops included
    remark, warning   about a seed that was moved to the surface; empty: nothing to say
    """

    strands: int
    guides: int
    remark: str
    warning: str


def is_shown(active: bpy.types.Object | None) -> bool:
    """Whether there is a preview, of what a run on this object would start from now.

    One that would be another by now is taken away. Cheap, for panels.
    """
    shown = preview.current
    if shown is None or active is None or shown.active.find() != active:
        return False
    return _is_current(shown)


def show(active: bpy.types.Object, context: bpy.types.Context) -> Found:
    """Shows what a run on a surface, or one that starts a result over, would start from.

    Takes as long as a run takes to begin. Where a seed is refused it is shown as drawn, with marks
    at the places; core.MeanderError or DataError says what is wrong.
    """
    hide()
    depsgraph = context.evaluated_depsgraph_get()
    plan = plan_of(active, context.scene, depsgraph, restart=True)
    try:
        opened = open_flow(replace(plan.problem, copies=None))
        with opened.flow as flow:
            curve, guides, figures = flow.polylines(), flow.guides(), flow.statistics()
        if opened.part is not None:
            curve, guides = opened.part.shown(curve), np.tile(guides, 2)
            figures |= opened.part.fit
    except core.MeanderError as error:
        named = in_polygons(error, plan.surface.find(), depsgraph)
        told = strands.explained(named, plan.parts, lambda value: length_text(context.scene, value))
        if error.element_kind == "seed_point" and plan.problem.seed is not None:
            seed = plan.problem.seed
            marks = _marks(seed.points[list(error.elements)], _MARK * plan.spacing)
            _draw(active, context, plan, [(_as_drawn(seed), _STRANDS), (marks, _PROBLEM)])
        raise told from error
    grown = strands.without_guides(curve, guides)
    _draw(active, context, plan, [(grown, _STRANDS), (_only_guides(curve, guides), _GUIDES)])
    remark = strands.fit_remark(
        figures, plan.parts, 0.0, lambda value: length_text(context.scene, value)
    )
    warning = strands.fit_warning(figures, plan.parts)
    return Found(int((~guides).sum()), int(guides.sum()), remark, warning)


def hide() -> None:
    """Takes the preview away. Does nothing when there is none."""
    preview.end()


def _draw(
    active: bpy.types.Object,
    context: bpy.types.Context,
    plan: Plan,
    lines: list[tuple[core.Polylines, tuple[float, float, float]]],
) -> None:
    scene, shown = Key(context.scene), Shown(Key(active), meaning_of(active), [])

    def find() -> bpy.types.Object | None:
        return plan.surface.find() if _is_current(shown) else None

    for polylines, color in lines:
        if len(polylines.closed):
            curve = GrowingCurve(find, scene.find, plan.matrix, color, WIDTH)
            curve.show(polylines, _LIFT * plan.spacing)
            shown.curves.append(curve)
    preview.begin(shown)
    redraw("WINDOW", "UI")


def _is_current(shown: Shown) -> bool:
    active = shown.active.find()
    return active is not None and shown.meaning.same_as(meaning_of(active))


def _only_guides(curve: core.Polylines, guides: np.ndarray) -> core.Polylines:
    return strands.without_guides(curve, ~guides)


def _as_drawn(seed: core.Seed) -> core.Polylines:
    return core.Polylines(seed.points, np.zeros_like(seed.points), seed.offsets, seed.closed)


def _marks(places: np.ndarray, size: float) -> core.Polylines:
    """Three short lines through every place (n, 3), along the axes."""
    arms = size * np.vstack([axis * side for axis in np.eye(3) for side in (-1.0, 1.0)])
    points = (places[:, None, :] + arms.reshape(6, 3)[None, :, :]).reshape(-1, 3)
    count = 3 * len(places)
    offsets = 2 * np.arange(count + 1, dtype=np.uint32)
    return core.Polylines(points, np.zeros_like(points), offsets, np.zeros(count, np.uint8))
