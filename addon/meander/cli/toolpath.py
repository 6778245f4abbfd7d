# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command that write the curve as a path for tools."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import core
from ..model import before_writing, export
from ..model.files.whole import FileError
from ..model.geometry import surface_crossings, thinning
from ..model.options.input import light_of
from ..model.toolpaths import order, parts, poses, toolpath
from ..model.toolpaths.drawing import ring
from . import export as export_options
from . import flags
from .grown import Grown
from .input import Input
from .place import Place
from .values import number, positive, reader

# As far as the library makes turns round, in spacings.
_MOST_ROUND = 0.5


def add_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group(
        "tool paths", "How densely the points of an --output for machines lie."
    )
    _add_points(group)
    _add_way(group)
    _add_poses(group)
    flags.add_flags(
        parser.add_argument_group("light results", "How many points the curve keeps."),
        "light results",
    )
    _add_turns(group)


def _add_points(group: argparse._ArgumentGroup) -> None:
    add = group.add_argument
    add(
        "--resample-step",
        type=positive,
        metavar="D",
        help="points at equal arc lengths along each strand, at most this far apart",
    )
    add(
        "--chord-tolerance",
        type=positive,
        metavar="D",
        help="as few points as keep the chords between them this near the curve",
    )
    add(
        "--part-length",
        type=positive,
        metavar="L",
        help="cut strands into parts of at most this length, in scene units, each a layer of an "
        ".svg or .dxf, behind a pause (M0) in G-code",
    )
    add(
        "--part-overlap",
        type=number,
        metavar="D",
        help="how much neighbouring parts have in common; negative: the gap between them; default: "
        "0",
    )


def _add_way(group: argparse._ArgumentGroup) -> None:
    add = group.add_argument
    for option, what in (
        ("begin-at", "begin with the strand nearest to this place, there, or at its nearer end"),
        ("go-on-from", "leave out what comes before the place of the line nearest to this one"),
    ):
        add(
            f"--{option}",
            nargs="+",
            type=number,
            metavar="X Y",
            help=f"{what}; in the coordinates of the --output, with a Z where it is not flat",
        )
    add(
        "--backwards",
        action="store_true",
        help="follow the line from its end to its beginning, of --go-on-from what is left of it",
    )


def _add_poses(group: argparse._ArgumentGroup) -> None:
    add = group.add_argument
    add(
        "--poses",
        action="store_true",
        help="an --output of kind .csv, .json or .npz has poses of a tool: places, quaternions, "
        "normals and tangents; z points into the surface, x along the curve",
    )
    add(
        "--outward",
        action="store_true",
        help="turn closed bodies that are inside out, so that normals point away from them",
    )
    add(
        "--lines",
        choices=("strands", "pairs"),
        help="an --output of kind .obj has one l line for each strand, or for each pair of points, "
        "which is all that Blender 3.4 reads of a line; default: strands",
    )


def _add_turns(group: argparse._ArgumentGroup) -> None:
    add = group.add_argument
    add(
        "--round",
        type=reader(float, 0.0, _MOST_ROUND),
        metavar="TOL",
        help="write the line with round turns, at most this far beside the curve, in spacings, "
        f"from 0 to {_MOST_ROUND:g}; 0.12 is what the look of a new curve in Blender has; "
        "default: 0, the curve",
    )
    add(
        "--points",
        choices=("mesh", "curves"),
        help="an --output of kind .blend also gets an object of all points, with attributes",
    )


def problem_of(arguments: argparse.Namespace) -> str | None:
    """What is wrong with the options, as a sentence, or None."""
    given = [
        f"--{name.replace('_', '-')}"
        for name in ("resample_step", "chord_tolerance")
        if getattr(arguments, name) is not None
    ]
    if len(given) == 2:
        return "--resample-step and --chord-tolerance are both given; choose one"
    if given and not is_wanted(arguments.output):
        return f"{given[0]} needs an --output for machines, such as .csv, .json or .svg"
    if arguments.part_length is not None and not is_wanted(arguments.output):
        return "--part-length needs an --output for machines, such as .csv, .json or .svg"
    if arguments.part_overlap is not None:
        if arguments.part_length is None:
            return "--part-overlap is for --part-length; give both or none"
        if not abs(arguments.part_overlap) <= arguments.part_length / 2:
            return "--part-overlap is more than half of --part-length; choose a smaller one"
    if arguments.poses and export.suffix_of(arguments.output) not in toolpath.SUFFIXES:
        return "--poses needs an --output of kind .csv, .json or .npz; a .yaml always has them"
    if arguments.lines is not None and not _is_obj(arguments.output):
        return "--lines is for an --output of kind .obj; leave it out"
    if arguments.points is not None and arguments.output.suffix.lower() != ".blend":
        return (
            "--points needs an --output of kind .blend; .csv, .json and .npz have the same in "
            "columns"
        )
    return None


def _is_obj(path: Path) -> bool:
    return path.suffix.lower() == ".obj"


def is_wanted(path: Path) -> bool:
    """Whether an output file is a path for tools."""
    return path.suffix.lower() in (*toolpath.SUFFIXES, *export.SUFFIXES)


def echo(arguments: argparse.Namespace) -> dict[str, Any]:
    """What is in effect, for the report."""
    return {
        "resample_step": arguments.resample_step,
        "chord_tolerance": arguments.chord_tolerance,
        "points": arguments.points,
        "round": arguments.round or 0.0,
        "part_length": arguments.part_length,
        "part_overlap": arguments.part_overlap,
        "begin_at": arguments.begin_at,
        "go_on_from": arguments.go_on_from,
        "backwards": arguments.backwards,
        "poses": arguments.poses,
        "outward": arguments.outward,
        "lines": (arguments.lines or "strands") if _is_obj(arguments.output) else None,
    }


def write(
    path: Path, arguments: argparse.Namespace, given: Input, grown: Grown, place: Place
) -> tuple[int, dict[str, Any] | None, NDArray[np.float64] | None, float | None]:
    """Writes the curve, resampled as the options say. Returns the number of points in the file, the
    report's "drawing", if it is one, and else where a curve of fewer points crosses itself, and how
    long it is."""
    strands = in_space = toolpath.strands_of(grown.curve, grown.data)
    kind = export.format_of(arguments.output)
    drawn = kind is not None
    if drawn:
        strands = export_options.laid(strands, arguments, given, place)
    laid = strands
    mesh = None if drawn else toolpath.Mesh(given.problem.vertices, given.problem.faces)
    ordered = export_options.order_of(arguments)
    if ordered.begin is not None:
        begin = ordered.begin
        if drawn:
            begin = export_options.beginning(strands, arguments, given, place)
        strands = order.begun_at(strands, begin, mesh)
    strands = toolpath.resampled(
        strands, arguments.resample_step, arguments.chord_tolerance, mesh
    )
    spacing = thinning.least_spacing(arguments.spacing / 2, grown.density)
    along_normals = kind is None or kind.name == "ROS"
    places = None
    if along_normals:
        whole = kind is None and _is_as_it_grew(grown, arguments)
        places = np.empty((0, 3)) if whole else _crossings(strands, spacing, arguments)
    if arguments.part_length is not None:
        overlap = arguments.part_overlap or 0.0
        strands = parts.parted(strands, arguments.part_length, overlap, mesh)
    if drawn:
        frames, rate = _frames(arguments, given, grown, place)
        line = before_writing.Line(in_space, laid, spacing)
        done = export_options.write(
            path, arguments, strands, given, place, spacing, line, frames, rate
        )
        return *done, places, None
    if ordered.go_on is not None:
        strands = order.gone_on(strands, ordered.go_on, mesh)
        if not strands:
            raise FileError(order.NOTHING_LEFT)
    if ordered.backwards:
        strands = order.backwards(strands)
    ways = [ring(strand) for strand in strands]
    length = float(sum(np.linalg.norm(np.diff(way, axis=0), axis=1).sum() for way in ways))
    if arguments.poses:
        given_poses = [
            poses.poses_of(strand, arguments.standoff or 0.0, arguments.approach or 0.0)
            for strand in strands
        ]
        poses.write(path, given_poses, core.library_version())
        return sum(len(each.places) for each in given_poses), None, places, length
    toolpath.write(path, strands, core.library_version())
    return sum(len(strand.points) for strand in strands), None, places, length


def _frames(
    arguments: argparse.Namespace, given: Input, grown: Grown, place: Place
) -> tuple[list[tuple[float, list[toolpath.Strand]]], float]:
    """What --bake-frames asks for, resampled as the options say, and how many frames a second."""
    if arguments.bake_frames is None:
        return [], 24.0
    frames, rate = place.blender("--bake-frames").baked_frames(arguments, given, grown)
    chosen = (arguments.resample_step, arguments.chord_tolerance)
    return [(time, toolpath.resampled(strands, *chosen)) for time, strands in frames], rate


def _is_as_it_grew(grown: Grown, arguments: argparse.Namespace) -> bool:
    """Whether the way of the tool has all points of a curve that cannot cross itself: on its
    surface, with guides, which may, left out."""
    chosen = (
        arguments.resample_step, arguments.chord_tolerance, arguments.round, arguments.standoff
    )  # fmt: skip
    light = light_of(flags.chosen(arguments))
    return not any(chosen) and light is None and grown.line is None and not grown.guides.any()


def _crossings(
    strands: Sequence[toolpath.Strand], spacing: float, arguments: argparse.Namespace
) -> NDArray[np.float64]:
    """Where the way of the tool crosses itself."""
    away = arguments.standoff or 0.0
    return surface_crossings.crossings(
        [strand.points + away * strand.normals for strand in strands],
        [strand.normals for strand in strands],
        [strand.closed for strand in strands],
        spacing,
    )
