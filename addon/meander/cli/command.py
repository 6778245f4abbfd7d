# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command from its options to its exit code; no bpy."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from .. import core
from ..model import bundle, last_run, report, start, strands
from ..model.copies import AllCopies
from ..model.empty import Empty, empty_of, narrow_remark, remark
from ..model.estimate import PHASE_TEXTS, cost_in_words
from ..model.files import meshes
from ..model.files.whole import FileError
from ..model.least_bend import sharpest_bend
from ..model.opening import Opened, open_flow
from ..model.preparation import described
from ..model.toolpaths import bridges
from . import (
    cut,
    flags,
    least_bend,
    limits,
    maps,
    mirror,
    picture,
    preparation,
    spacing,
    standard,
    target_length,
)
from .arguments import check_arguments, parsed
from .exit_code import GapsLeft, exit_code_of, while_heard
from .grown import Grown, grown_of, length_of, written
from .input import Input
from .place import Place
from .reading import read_input
from .watching import LARGE, summary, told
from .writing import echo, write_outputs


def _process(argv: Sequence[str], place: Place) -> None:
    arguments = parsed(argv, place)
    if arguments.quiet:
        place = replace(place, say=lambda _line: None)
    with standard.streams(arguments, place) as place_of_run:
        _run_through(arguments, place_of_run)


def _run_through(arguments: argparse.Namespace, place: Place) -> None:
    check_arguments(arguments, place)
    if arguments.output.suffix.lower() == ".blend":
        place.blender(arguments.output).refuse_points(arguments.points)
    if arguments.cut is not None and arguments.cut.suffix.lower() == ".blend":
        place.blender(arguments.cut)
    if arguments.maps is not None:
        place.blender("--maps")
    search = target_length.begin(arguments, place)
    filled = _nearest(arguments, search, place)
    arguments.spacing, arguments.bending = filled.spacing, filled.bending
    given, opened, grown, figures, record, empty = filled[:6]
    if empty.matters and figures["stop_reason"] == "converged":  # which says more than is true
        record["warnings"].append(_of_empty(empty, figures, given))
        if not arguments.fail_on_gaps:  # which says it at the end
            place.warn(record["warnings"][-1])
    write_outputs(arguments, given, grown, record, place)
    figures["length"] = record["length"]
    for line in _remarks(given, opened, figures, record, empty):
        place.say(f"meander: {line}")
    for path in (arguments.output, arguments.cut, *grown.images):
        if path is not None:
            place.say(f"meander: wrote {path}")
    if empty.matters and arguments.fail_on_gaps:
        raise GapsLeft(_of_empty(empty, figures, given))


class Filled(NamedTuple):
    """One run: what was read, opened and grown, the figures, the report as far as it goes, what is
    empty, and the arguments that it had in the end."""

    given: Input
    opened: Opened
    grown: Grown
    figures: dict[str, Any]
    record: dict[str, Any]
    empty: Empty
    spacing: float
    bending: float | None


def _nearest(
    arguments: argparse.Namespace, search: target_length.Search | None, place: Place
) -> Filled:
    """The run that is asked for; of those of a search the one that comes nearest to its length."""
    filled = _filled(arguments, search, place, warned=False)
    assert filled is not None  # the first is the nearest
    while search is not None and search.following is not None:
        arguments.spacing = search.following
        filled = _filled(arguments, search, place, warned=True) or filled
    return filled


def _filled(
    arguments: argparse.Namespace, search: target_length.Search | None, place: Place, warned: bool
) -> Filled | None:
    """One run; None where an earlier one of `search` was nearer.

    warned   what there is to warn of has been said
    """
    with told(None, f"reading {arguments.input}", place.say, large=False):
        given = read_input(arguments, place)
    maps.refuse_inputs(arguments, given, place)
    options = given.problem.options
    warnings = _warnings_of(given)
    for warning in () if warned else warnings:
        place.warn(warning)
    opened = _open(given, arguments, place)
    # Of what is no surface there is no spacing to speak of.
    if spacing.is_automatic(arguments) and not warned:
        place.say(f"meander: {spacing.sentence(arguments.spacing)}")
    with opened.flow as grown_flow:
        reason, options = _run(opened, options, arguments, place)
        stiffness = options.bending_weight
        if stiffness != opened.problem.options.bending_weight:  # what a .blend is to keep
            arguments.bending = stiffness
        with mirror.whole(opened, options) as (flow, of_whole, of_mirror):
            found = _findings_of(flow, opened, arguments.round or 0.0, place)
            figures = (of_whole or found.statistics) | {"stop_reason": reason}
            grown = grown_of(
                found,
                opened,
                arguments.leave_out_guides,
                with_data=arguments.output.suffix.lower() != ".obj",
            )
            line = written(grown, arguments, given.problem)
            # Not all that has grown, or another line.
            if line is not grown or arguments.leave_out_guides or arguments.round:
                figures["length"] = length_of(line)
            if search is not None:
                length, at = figures["length"], arguments.spacing
                place.say(f"meander: at a spacing of {at:.6g} the curve is {length:.6g} long")
                if not search.is_nearest(at, length):
                    return None
            gaps = found.gaps
            assert gaps is not None  # they were asked for
            record = report.build_report(
                core.library_version(),
                opened.figures,
                figures,
                grown_flow.history(),
                gaps,
                echo(arguments, options, given),
            )
            images = maps.images_of(flow, arguments, given, place)
            grown = replace(grown, cut=cut.cut_of(flow, arguments), images=images)
    record["mirror"] = of_mirror
    record["warnings"] = warnings
    _complete(record, arguments, given, opened, grown, figures)
    return Filled(
        given, opened, grown, figures, record, empty_of(gaps), arguments.spacing, arguments.bending
    )


def _findings_of(
    flow: core.Flow | AllCopies, opened: Opened, rounding: float, place: Place
) -> core.Findings:
    """All that is told of a curve, with its gaps; and the line with round turns, at most so many
    spacings beside it, unless that is 0."""
    large = opened.cost.nodes > LARGE
    with core.Context() as context, told(context, "measuring the curve", place.say, large):
        return flow.findings(tolerance=rounding, context=context)


def _warnings_of(given: Input) -> list[str]:
    """What there is to warn of before a run."""
    warnings = [*given.warnings, *core.option_warnings(given.problem.options)]
    library = core.library_notice()
    return [library, *warnings] if library else warnings


def _complete(
    record: dict[str, Any],
    arguments: argparse.Namespace,
    given: Input,
    opened: Opened,
    grown: Grown,
    figures: dict[str, Any],
) -> None:
    """What a report says beside the figures of the flow."""
    asked_full = given.problem.options.start == core.Start.FULL
    record["start"] = start.entry(figures, asked_full)
    record["estimate"] = asdict(opened.cost)
    record["lines"] = {
        "parts": int(opened.figures["components"]),
        "small_parts": figures["small_components"],
    }
    record["preparation"] = preparation.counts(opened.figures, given.loose_edges)
    bend = sharpest_bend(grown.curve, arguments.spacing / 2)
    if bend is not None:
        record["bend"] = {
            "least_radius": bend.radius if math.isfinite(bend.radius) else None,
            "place": bend.place.tolist(),
            "strand": bend.strand,
        }


def _of_empty(empty: Empty, figures: dict[str, Any], given: Input) -> str:
    """What is said of a surface that is not filled."""
    full = given.problem.options.start == core.Start.FULL
    otherwise = "" if full else "begin with --start full, or choose a smaller --spacing"
    if figures["empty_components"]:
        otherwise = "draw a strand on every part, or give --fill-every-part"
    helps = ("raise --iterations", otherwise, "choose a smaller --spacing")
    return remark(empty, figures["stop_reason"], helps)


def _run(
    opened: Opened, options: core.FlowOptions, arguments: argparse.Namespace, place: Place
) -> tuple[str, core.FlowOptions]:
    """Runs the flow to its end, and returns the stop reason and the options that it has then; a
    defect of the library leaves a bundle beside the output."""
    try:
        return least_bend.run_until_held(opened, options, arguments, place)
    except core.MeanderError as failure:
        if bundle.is_defect(failure):
            output = standard.beside_output(arguments)
            path = output.with_name(f"{output.stem}.defect{bundle.SUFFIX}")
            _leave_bundle(path, opened, failure)
        raise


def _leave_bundle(path: Path, opened: Opened, failure: core.MeanderError) -> None:
    said = f"what led to this, and the last good curve, are in {path}; please add it to the report"
    try:
        bundle.write_bundle(path, bundle.bundle_of(opened.flow, opened.problem, failure))
    except (core.MeanderError, FileError) as problem:  # the failure itself is still to be told
        said = str(problem)
    while_heard(print, f"meander: {said}", file=sys.stderr, flush=True)


def _remarks(
    given: Input,
    opened: Opened,
    figures: dict[str, Any],
    record: dict[str, Any],
    empty: Empty,
) -> list[str]:
    """What there is to say of a run that has ended."""
    told = []
    if figures["empty_components"]:
        told.append(strands.empty_parts(figures["empty_components"]))
    told.append(start.remark(figures))
    told.append(strands.fit_warning(figures, given.parts))
    told.append(strands.fit_remark(figures, given.parts, given.problem.options.radius))
    told.append(described(opened.figures, given.loose_edges, given.instances))
    if record["bridges"]["count"]:
        length = f"{record['bridges']['length']:.3g}"
        told.append(bridges.described(record["bridges"]["count"], length))
    rough = last_run.roughness(figures["smoothing"], figures["stretch"])
    told.append(rough[:1].lower() + rough[1:])
    told.append(_lines(record["lines"]))
    if figures["stop_reason"] != "converged":
        told.append(_of_empty(empty, figures, given))
    told.append(narrow_remark(empty))
    told.append(summary(figures, empty))
    return [line for line in told if line]


def _lines(lines: dict[str, Any]) -> str:
    """How many lines there are, and why; of the report's "lines"."""
    said = last_run.lines(lines["count"], lines["closed"])
    if not lines["why"]:
        return said[:1].lower() + said[1:]
    out = "; --smallest-part leaves out the small ones" if lines["small_parts"] else ""
    return f"{said}: {lines['why']}{out}"


def _open(given: Input, arguments: argparse.Namespace, place: Place) -> Opened:
    """Opens the flow, unless it would be too large; an error names elements as the user counts
    them."""

    about = [PHASE_TEXTS["mesh"].lower()]

    def accept(of_library: core.Cost) -> None:
        cost = limits.of_process(of_library, given.problem)
        limits.refuse_large(cost, arguments)
        if LARGE < cost.nodes <= limits.MOST_OF_LIBRARY:
            place.say(f"meander: about {cost_in_words(cost)}")
        about.append(PHASE_TEXTS["surface"].lower())

    try:
        with core.Context() as context, told(context, lambda: about[-1], place.say, large=False):
            opened = open_flow(given.problem, context, accept)
        return replace(opened, cost=limits.of_process(opened.cost, given.problem))
    except core.MeanderError as refusal:
        named = flags.in_own_words(refusal, arguments)
        if given.surface_object is not None and place.host is not None:
            named = place.host.in_polygons(named, given.surface_object)
        if given.mesh_file is not None:
            named = meshes.in_file(named, given.mesh_file)
        raise strands.explained(named, given.parts) from refusal


def main(argv: Sequence[str], place: Place) -> int:
    """Runs the command and returns its exit code; see exit_code.

    argv    the options
    place   where it runs

    A run that has reached the iteration limit is done; the report says so.
    """
    place = replace(place, say=partial(while_heard, place.say))
    if picture.is_asked(argv):
        return exit_code_of(lambda: picture.process(argv, place))
    return exit_code_of(lambda: _process(argv, place))
