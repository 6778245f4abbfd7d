# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command from its options to its exit code."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Sequence

from .. import core
from ..model import mesh_files, report, strands
from ..model.preparation import described, outlined
from ..model.problem import evaluated
from . import preparation
from .arguments import arguments_of_process, check_arguments, flow_options, parser
from .input import Input
from .reading import need_bpy, read_input
from .values import BadInput
from .watching import run, summary
from .writing import echo, write_outputs


def _surface(given: Input, threads: int) -> core.Surface:
    try:
        return core.Surface(given.vertices, given.faces, given.surface_options, threads)
    except core.MeanderError as error:
        if given.surface_object is None:
            raise
        from . import scene_input  # which needs bpy, as the object does

        raise scene_input.in_polygons(error, given.surface_object) from error


def _process(argv: Sequence[str]) -> None:
    arguments = parser().parse_args(argv)
    check_arguments(arguments)
    if arguments.output.suffix.lower() == ".blend":
        need_bpy(arguments.output)
        from . import scene_output  # which needs bpy

        scene_output.refuse_points(arguments.points)
    options = flow_options(arguments)
    given = read_input(arguments)
    options.alignment_weight = given.alignment.weight
    warnings = core.option_warnings(options)
    for warning in warnings:
        print(f"meander: warning: {warning}", file=sys.stderr, flush=True)
    with _surface(given, arguments.threads) as surface:
        given.density = evaluated(given.density, surface)
        surface_figures = surface.statistics()
        if arguments.outline:
            given.seed, surface_figures["skipped_outlines"] = outlined(
                given.seed,
                surface,
                options.border_distance * arguments.spacing,
                arguments.spacing,
            )
        try:
            flow = core.Flow(surface, options, given.seed, given.density)
            directions = evaluated(given.directions, surface)
            if directions is not None:
                flow.set_directions(directions, given.alignment.kind)
        except core.MeanderError as refusal:
            raise strands.explained(refusal, given.parts) from refusal
    with flow:
        reason = run(flow, options.iteration_limit, arguments.quiet)
        figures = flow.statistics()
        figures["stop_reason"] = reason
        history = flow.history()
        gaps = flow.gaps()
        curve = flow.polylines()
        data = flow.point_data()
        guides = flow.guides()
        if arguments.leave_out_guides:
            kept = strands.points_without_guides(curve, guides)
            data = core.PointData(*(values[kept] for values in data))
            curve = strands.without_guides(curve, guides)
            guides = guides[~guides]
    record = report.build_report(
        core.library_version(),
        surface_figures,
        figures,
        history,
        gaps,
        echo(arguments, options, given),
    )
    record["warnings"] = warnings
    record["preparation"] = preparation.counts(surface_figures, given.loose_edges)
    write_outputs(arguments, given, curve, data, guides, record)
    if not arguments.quiet:
        if figures["empty_components"]:
            print(f"meander: {strands.empty_parts(figures['empty_components'])}")
        done = described(surface_figures, given.loose_edges)
        if done:
            print(f"meander: {done}")
        print(summary(reason, figures))
        print(f"meander: wrote {arguments.output}", flush=True)


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command and returns its exit code; see the top of this file.

    argv   the options; None takes those of this process
    """
    try:
        _process(arguments_of_process() if argv is None else argv)
    except (BadInput, core.MeanderError, mesh_files.FileError) as problem:
        if getattr(problem, "status", None) == core.Status.INTERNAL:
            traceback.print_exc()
            return 1
        print(f"meander: {' '.join(str(problem).split())}", file=sys.stderr, flush=True)
        return 2
    except KeyboardInterrupt:
        print("meander: interrupted", file=sys.stderr, flush=True)
        return 130
    except Exception:
        traceback.print_exc()
        return 1
    return 0
