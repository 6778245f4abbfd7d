# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run leaves in the scene: the curve, its points, the settings and figures that it keeps."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy
import numpy as np

from .. import core
from ..model import start, strands
from ..model.geometry.thinning import least_spacing
from ..model.joining import joining_of, lying_on_others
from ..model.last_run import GAP_THAT_MATTERS, why_lines
from ..model.preparation import described, mended
from ..model.profile import radius_factors
from ..model.toolpaths import bridges, toolpath
from ..scene import look, preparation, results
from ..scene import points as point_attributes
from ..scene import strands as scene_strands
from ..scene.curve_writer import write_curve
from ..scene.linked_settings import settings_of, settings_to_change
from ..scene.look import modifier_of
from ..scene.made import name_curve
from ..scene.options import keep_shape, options_of
from ..scene.preparation import store_region
from ..scene.profile import set_tilt_and_radius
from ..scene.settings import copy_settings
from ..scene.shared_settings import share
from ..scene.transforms import mean_scale, to_local
from ..scene.view_aid import lay_on_what_is_shown
from . import rounding
from .outcome import Snapshot
from .plan import Plan
from .stepper import Stepper

# Gaps that are kept with a result, the largest: a run that was stopped early has thousands.
MOST_GAPS = 200


def preparation_text(plan: Plan, stepper: Stepper) -> str:
    """What was done to the mesh, in words; empty if nothing was."""
    if not stepper.surface_figures:
        return ""
    done = described(stepper.surface_figures, plan.loose_edges, plan.instances)
    return ", ".join(filter(None, (done, plan.remark)))


def _masked(plan: Plan) -> bool:
    options = plan.problem.surface_options
    return options is not None and (
        options.face_mask is not None or options.vertex_mask is not None
    )


def write_result(
    context: bpy.types.Context,
    plan: Plan,
    stepper: Stepper,
    outcome: tuple[Snapshot, dict[str, Any], str],
    undisturbed: bool = True,
) -> bpy.types.Object:
    """Makes the curve object of a run that has ended, or rewrites the one that it goes on from.

    A mesh that is filled again stays selected, to be painted and filled once more.

    outcome      of stepper.result()
    undisturbed  what is active and selected is what it was when the run began; else that is the
                 user's choice meanwhile, and stays
    """
    snapshot, statistics, stop_reason = outcome
    surface = plan.surface.find()
    preparation.remember_problem(surface, "")
    radius = plan.problem.options.radius
    spacing = least_spacing(radius, stepper.density)
    curve, radii, guides, line = rounding.shown(
        plan, stepper.guides, snapshot.polylines, stepper.point_data.radii, spacing
    )
    earlier = _rewritten(plan, surface)
    result = write_curve(
        curve,
        surface,
        plan.name,
        curve_object=earlier,
        matrix=plan.matrix,
    )
    lay_on_what_is_shown(result, surface, context.scene)
    _dress(plan, stepper, result, (curve, radii, line), new=earlier is None)
    lines = _line_figures(plan, stepper, statistics, np.asarray(curve.closed, dtype=bool)[~guides])
    _store(plan, stepper, result, statistics | lines | _bridge_figures(line), stop_reason)
    figures = result.meander.figures
    figures.least_spacing = spacing
    keep_guides = result.meander.keep_guides  # which has just been stored
    if line is not None or (guides.any() and not keep_guides):  # not the line that has grown
        every = zip(toolpath.strands_of(curve), guides)
        figures.length = sum(strand.length for strand, guide in every if keep_guides or not guide)
    figures.whole_points = len(snapshot.polylines.positions)
    scene_strands.note_guides(result, guides, keep_guides)
    rounding.draw_after_run(plan, stepper, result, spacing)
    figures.bridges = "" if line is None else bridges.to_text(line, keep_guides)
    grown = strands.points_without_guides(curve, guides) if not keep_guides else slice(None)
    point_attributes.store_medial_radii(result, radii[grown], plan.matrix)
    if plan.points_as != "NONE":
        _make_points(plan, stepper, result, snapshot.polylines)
    if undisturbed and (earlier is None or not plan.from_surface):
        _make_active(context, result)
    return result


def _rewritten(plan: Plan, surface: bpy.types.Object) -> bpy.types.Object | None:
    """The curve object that the run goes on from, in Object Mode; None: a new one is made."""
    earlier = plan.result.find() if plan.result else None
    if not results.is_present(earlier):
        results.forget_deleted(surface)
        return None
    if earlier.mode == "EDIT":
        # Leaving Edit Mode later would write the points that it holds over the new ones.
        bpy.ops.object.mode_set(mode="OBJECT")
    return earlier


def _dress(
    plan: Plan,
    stepper: Stepper,
    result: bpy.types.Object,
    drawn: tuple[core.Polylines, np.ndarray, bridges.Joined | None],
    new: bool,
) -> None:
    """Materials, look, tilt and radius of a curve object whose points have been written.

    drawn   the curve, its medial radii, and the line that joins its strands, where one does
    """
    curve, radii, line = drawn
    sources = stepper.sources
    if line is not None:
        sources = line.sources if sources is None else sources[line.sources]
    scene_strands.assign_materials(result.data, plan.materials, sources)
    own_spacing = plan.spacing / mean_scale(plan.matrix)
    follows = plan.radius_follows and stepper.density is not None
    if new:
        look.dress(result, replace(plan.look, follows=follows), own_spacing)
    else:
        look.follow_run(result, own_spacing, follows)
    has_room = follows or modifier_of(result) is not None
    factors = radius_factors(radii, plan.problem.options.radius) if has_room else None
    set_tilt_and_radius(result.data, curve, plan.matrix, factors)


def _line_figures(
    plan: Plan, stepper: Stepper, statistics: dict[str, Any], closed: np.ndarray
) -> dict[str, Any]:
    """How many lines there are, guides aside, and why there are several.

    closed   of each whether it is
    """
    count, figures = len(closed), stepper.surface_figures
    why = why_lines(
        count,
        int(figures.get("components", 0)),
        int(statistics["small_components"]),
        int(statistics["guides"]),
        any(not part.guide for part in plan.parts),
        joining_of(plan.problem, figures) if count > 1 and figures else None,
        "Merge Close Vertices at",
        lying_on_others(plan.problem, figures) if count > 1 and figures else 0,
    )
    if why:
        why = stepper.lines_why or why
    return {"lines": count, "closed_lines": int(np.count_nonzero(closed)), "lines_why": why}


def _bridge_figures(line: bridges.Joined | None) -> dict[str, Any]:
    lengths = np.zeros(0) if line is None else line.bridge_lengths
    return {"bridge_count": len(lengths), "bridge_length": float(lengths.sum())}


def _make_points(
    plan: Plan, stepper: Stepper, result: bpy.types.Object, polylines: core.Polylines
) -> None:
    """Makes the object of all points beside the result, instead of the last run's."""
    data, guides, line = stepper.point_data, stepper.guides, None
    if plan.bridges:
        spacing = least_spacing(plan.problem.options.radius, stepper.density)
        line = bridges.joined(polylines, spacing, guides)
    if line is not None:
        mesh = toolpath.Mesh(plan.problem.vertices, plan.problem.faces)
        polylines, guides, data = line.polylines, line.guides, bridges.data_of(line, data, mesh)
    every = toolpath.strands_of(polylines, data)
    if not result.meander.keep_guides:
        every = [strand for strand, is_guide in zip(every, guides) if not is_guide]
    earlier = result.meander.figures.points
    if earlier is not None and earlier.library is None and not _named_by_other(earlier, result):
        bpy.data.batch_remove([earlier, earlier.data])
    result.meander.figures.points = point_attributes.make(
        plan.points_as,
        f"{result.name} Points",
        every,
        plan.surface.find(),
        plan.matrix,
        look.radius_of(result) * mean_scale(plan.matrix),
    )
    name_curve([result.meander.figures.points], result)


def _named_by_other(points: bpy.types.Object, result: bpy.types.Object) -> bool:
    """Whether points belong to another result too, of which this one is a duplicate."""
    return any(
        other != result and other.meander.figures.points == points for other in bpy.data.objects
    )


def _store(
    plan: Plan,
    stepper: Stepper,
    result: bpy.types.Object,
    statistics: dict[str, Any],
    stop_reason: str,
) -> None:
    """Writes the settings and the figures of the run to the result."""
    source = plan.settings.find()
    settings, surface = result.meander, plan.surface.find()
    own_part = (settings.mask_source, settings.mask_attribute)
    if source not in (None, result):
        copy_settings(settings_of(source), settings)
    settings.surface = surface
    if plan.region is not None:
        settings.mask_attribute, settings.mask_source = reversed(own_part)
        store_region(plan.region, surface, settings)
    results.remember(result, surface)
    share(result, settings_to_change(surface))
    # The settings are the user's choice for the next run, which may be another one by now; only
    # what the run has chosen is yet to be seen.
    if not settings.spacing:
        settings.spacing = plan.spacing
    if plan.density_group and not settings.density_group:
        settings.density_group = plan.density_group
    asked, grown_with = plan.problem.options.bending_weight, stepper.problem.options
    if grown_with.bending_weight != asked and _asks_for(settings, asked):
        keep_shape(grown_with, settings)  # what held the least bend radius
    figures = settings.figures
    figures.stop_reason = stop_reason
    if plan.begins:  # what goes on keeps its own
        figures.variation = plan.problem.options.variation
    if plan.beside:
        settings.variation = figures.variation
    figures.nodes = int(statistics["nodes"])
    figures.iterations = int(statistics["iterations"])
    figures.length = float(statistics["length"])
    figures.spacing = plan.spacing
    figures.spacing_median = float(statistics["spacing_median"])
    figures.seconds = float(statistics["seconds_total"])
    figures.evenness = float(statistics["evenness"])
    figures.smoothing = float(statistics["smoothing"])
    figures.stretch = float(statistics["stretch"])
    figures.lines = statistics["lines"]
    figures.closed_lines = statistics["closed_lines"]
    figures.lines_why = statistics["lines_why"]
    figures.bridge_count = statistics["bridge_count"]
    figures.bridge_length = statistics["bridge_length"]
    figures.empty_parts = int(statistics["empty_components"])
    figures.began = start.notice(statistics)
    figures.preparation = preparation_text(plan, stepper)
    figures.mended = mended(stepper.surface_figures, _masked(plan))
    _store_gaps(figures, stepper.gaps, plan)


def _asks_for(settings: bpy.types.PropertyGroup, stiffness: float) -> bool:
    """Whether settings still ask for the stiffness that a run began with."""
    return options_of(settings, 1.0).bending_weight == stiffness


def _store_gaps(figures: bpy.types.PropertyGroup, gaps: core.Gaps | None, plan: Plan) -> None:
    """None: they were not searched for, which counts of -1 say."""
    figures.gap_count = -1 if gaps is None else len(gaps)
    figures.wide_gaps = -1 if gaps is None else int(np.sum(gaps.sizes > GAP_THAT_MATTERS))
    figures.largest_gap = float(gaps.sizes[0]) if gaps else 0.0
    figures.empty_share = 0.0 if gaps is None else gaps.empty_share
    figures.narrow_share = 0.0 if gaps is None else gaps.narrow_share
    figures.gaps.clear()
    if gaps is None:
        return
    positions = to_local(gaps.positions[:MOST_GAPS], plan.matrix)
    for position, size in zip(positions.tolist(), gaps.sizes.tolist()):
        gap = figures.gaps.add()
        gap.position = position
        gap.size = size


def _make_active(context: bpy.types.Context, object: bpy.types.Object) -> None:
    """Makes the object active, and selects nothing: not while painting, which goes on.

    Blender selects what it adds, but the outline of a selected curve as dense as this covers it and
    the surface with one bright colour. The panel and Edit Mode follow the active object, a result
    is not to be moved away from its surface, and Undo takes it away; one click selects it.
    """
    view_layer = context.view_layer
    if context.mode != "OBJECT" or view_layer.objects.get(object.name) != object:
        return
    for other in list(context.selected_objects):
        other.select_set(False)
    view_layer.objects.active = object
