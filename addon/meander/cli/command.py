# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command from its options to its exit code."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Sequence
from dataclasses import replace

from .. import core
from ..model import bridges, report, strands
from ..model.preparation import described
from ..model.problem import Opened, open_flow
from ..model.whole_files import FileError
from . import cut, preparation
from .arguments import arguments_of_process, check_arguments, parser
from .flags import flow_options
from .grown import grown_of
from .input import Input
from .reading import need_bpy, read_input
from .values import BadInput
from .watching import interruptible, run, summary
from .writing import echo, write_outputs


def _process(argv: Sequence[str]) -> None:
    arguments = parser().parse_args(argv)
    check_arguments(arguments)
    if arguments.output.suffix.lower() == ".blend":
        need_bpy(arguments.output)
        from . import scene_output  # which needs bpy

        scene_output.refuse_points(arguments.points)
    if arguments.cut is not None and arguments.cut.suffix.lower() == ".blend":
        need_bpy(arguments.cut)
    options = flow_options(arguments)
    given = read_input(arguments, options)
    warnings = core.option_warnings(options)
    for warning in warnings:
        print(f"meander: warning: {warning}", file=sys.stderr, flush=True)
    opened = _open(given)
    with opened.flow as flow:
        reason = run(flow, arguments.quiet)
        figures = flow.statistics() | {"stop_reason": reason}
        record = report.build_report(
            core.library_version(),
            opened.figures,
            figures,
            flow.history(),
            flow.gaps(),
            echo(arguments, options, given),
        )
        grown = grown_of(flow, opened, without_guides=arguments.leave_out_guides)
        grown = replace(grown, cut=cut.cut_of(flow, arguments))
    record["warnings"] = warnings
    record["preparation"] = preparation.counts(opened.figures, given.loose_edges)
    write_outputs(arguments, given, grown, record)
    if not arguments.quiet:
        if figures["empty_components"]:
            print(f"meander: {strands.empty_parts(figures['empty_components'])}")
        remark = strands.fit_remark(figures, given.parts, options.radius)
        for text in (strands.fit_warning(figures, given.parts), remark):
            if text:
                print(f"meander: {text}")
        done = described(opened.figures, given.loose_edges, given.has_instances)
        if done:
            print(f"meander: {done}")
        if record["bridges"]["count"]:
            length = f"{record['bridges']['length']:.3g}"
            print(f"meander: {bridges.described(record['bridges']['count'], length)}")
        print(summary(reason, figures))
        print(f"meander: wrote {arguments.output}", flush=True)
        if arguments.cut is not None:
            print(f"meander: wrote {arguments.cut}", flush=True)


def _open(given: Input) -> Opened:
    """Opens the flow; an error names elements as the user counts them."""
    try:
        return interruptible(lambda context: open_flow(given.problem, context))
    except core.MeanderError as refusal:
        named = refusal
        if given.surface_object is not None:
            from . import scene_input  # which needs bpy, as the object does

            named = scene_input.in_polygons(refusal, given.surface_object)
        raise strands.explained(named, given.parts) from refusal


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command and returns its exit code; see the top of this file.

    argv   the options; None takes those of this process
    """
    try:
        _process(arguments_of_process() if argv is None else argv)
    except (BadInput, core.MeanderError, FileError) as problem:
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
