# SPDX-License-Identifier: GPL-3.0-or-later
"""What the batch command leaves: the curve, and the report of every option and figure."""

from __future__ import annotations

import argparse
from dataclasses import asdict
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import core
from ..model import export as export_files
from ..model import last_run, report
from ..model.files import obj
from ..model.files.whole import naming, whole_files
from ..model.geometry import surface_crossings, thinning
from ..model.joining import joining_of, lying_on_others
from ..model.options.input import light_of
from ..model.toolpaths import bridges
from . import (
    cut,
    density,
    export,
    flags,
    maps,
    motion,
    preparation,
    quality,
    standard,
    strands,
    terms,
)
from . import toolpath as toolpath_options
from .grown import Grown, bridge_figures, written
from .input import Input
from .place import Place
from .spacing import is_automatic
from .watching import LARGE


class Written(NamedTuple):
    """What an output has come to.

    count       of points in the file
    line        what was joined; None: nothing
    crossings   (k, 3), where a curve of fewer points than all crosses itself; None: it has them all
    drawing     the report's "drawing", if it is one
    length      of the line in a table, which may have fewer points than all; None: it has them, or
                the drawing says it
    """

    count: int
    line: bridges.Joined | None
    crossings: NDArray[np.float64] | None
    drawing: dict[str, Any] | None = None
    length: float | None = None


def echo(arguments: argparse.Namespace, options: core.FlowOptions, given: Input) -> dict[str, Any]:
    """Every option in effect, for the report; null: the preset's own value."""
    found: dict[str, Any] = {
        "input": str(arguments.input),
        "object": None if given.surface_object is None else given.surface_object.name,
        "frame": arguments.frame,
        "run_scripts": arguments.run_scripts,
        "output": str(arguments.output),
        **toolpath_options.echo(arguments),
        **export.echo(arguments),
        "seed": None if arguments.seed is None else str(arguments.seed),
        "seed_object": arguments.seed_object,
        "fixed_ends": given.fixed_ends,
        **strands.echo(arguments, given.stroke),
        **density.echo(arguments, given.density_choice),
        **preparation.echo(given.repair, given.mask),
        **terms.echo(arguments, options),
        **motion.echo(arguments),
        **cut.echo(arguments),
        **maps.echo(arguments),
        "target_length": arguments.target_length,
        "fail_on_gaps": arguments.fail_on_gaps,
        "spacing_is_automatic": is_automatic(arguments),
        "quality": quality.asked(arguments),
        "limit_nodes": arguments.limit_nodes,
        "limit_memory": arguments.limit_memory,
        **flags.entries(arguments, options),
        **asdict(options),
        **standard.echo(arguments),
    }
    if options.segment_length == 0:
        found["segment_length"] = 0.2 * options.radius  # what 0 stands for in the C API
    if options.max_radius == 0:
        found["max_radius"] = None
    return found


def write_outputs(
    arguments: argparse.Namespace,
    given: Input,
    grown: Grown,
    record: dict[str, Any],
    place: Place,
) -> None:
    """Writes all files beside their places first, then moves them in, the report at the end."""
    of_cut = None if grown.cut is None else arguments.cut
    wanted = (arguments.output, of_cut, *grown.images, arguments.report)
    if len(grown.curve.positions) > LARGE:
        place.say(f"meander: writing {arguments.output}")
    with whole_files([path for path in wanted if path is not None]) as temporary:
        paths, arguments.written_beside = iter(temporary), temporary
        with naming(arguments.output):
            done = _write_curve(next(paths), arguments, given, grown, place)
        line, record["drawing"] = done.line, done.drawing
        if done.length is not None:
            record["length"] = done.length
        counts = {"all": len(grown.curve.positions), "written": done.count}
        record["points"] = counts | surface_crossings.figures(done.crossings)
        warning = surface_crossings.crossing_warning(done.crossings)
        if warning:
            place.warn(warning)
        beyond = _limit_problem_of(arguments, done.count)
        if beyond:
            record["warnings"].append(beyond)
            place.warn(beyond)
        if grown.cut is not None:
            with naming(arguments.cut):
                record["cut"] = cut.write(next(paths), arguments, given, grown.cut, place)
        for path, image in grown.images.items():
            with naming(path):
                next(paths).write_bytes(image)
        record["bridges"] = bridge_figures(line)
        record["lines"] |= _lines(grown if line is None else line, given, record)
        if arguments.report is not None:
            with naming(arguments.report):
                report.write_report(next(paths), record)


def _lines(
    outcome: Grown | bridges.Joined, given: Input, record: dict[str, Any]
) -> dict[str, Any]:
    """How many lines are written without guides, how many are closed, and why they are not one."""
    curve = outcome.polylines if isinstance(outcome, bridges.Joined) else outcome.curve
    closed = curve.closed[~outcome.guides]
    known = record["lines"]
    seeded = any(not part.guide for part in given.parts)
    why = last_run.why_lines(
        len(closed),
        known["parts"],
        known["small_parts"],
        record["guides"],
        seeded,
        joining_of(given.problem, record["surface"]) if len(closed) > 1 else None,
        "--merge-distance",
        lying_on_others(given.problem, record["surface"]) if len(closed) > 1 else 0,
    )
    if why and record["mirror"] is not None:
        why = record["mirror"]["why"] or why
    return {"count": len(closed), "closed": int(closed.sum()), "why": why or None}


def _limit_problem_of(arguments: argparse.Namespace, count: int) -> str:
    """What is said where more points are written than --point-limit asks for; empty: not more."""
    limit, kind = arguments.point_limit, export_files.format_of(arguments.output)
    chosen = kind is None or export_files.has_own_points(kind)
    if limit is None or count <= limit or not chosen or arguments.resample_step is not None:
        return ""
    return (
        f"{count:,} points are left, more than --point-limit {limit:,}: fewer would lie more than "
        "a quarter of the spacing beside the curve; choose a larger spacing"
    )


def _write_curve(
    path: Path, arguments: argparse.Namespace, given: Input, grown: Grown, place: Place
) -> Written:
    """Writes the output in the format of its name."""
    if arguments.output.suffix.lower() == ".blend":
        return Written(*place.blender(arguments.output).write_scene(path, arguments, given, grown))
    grown = written(grown, arguments, given.problem)
    if toolpath_options.is_wanted(arguments.output):
        count, drawing, *rest = toolpath_options.write(path, arguments, given, grown, place)
        return Written(count, grown.line, rest[0], drawing, rest[1])
    obj.write_obj_curve(path, grown.curve, pairs=arguments.lines == "pairs")
    places = None
    if light_of(flags.chosen(arguments)) is not None:
        spacing = thinning.least_spacing(arguments.spacing / 2, grown.density)
        places = surface_crossings.of_polylines(grown.curve, spacing)
    return Written(len(grown.curve.positions), grown.line, places)
