# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command that write the curve for plotters, machines and hoops."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import core
from ..model import before_writing, export
from ..model.options.export import GROUP, ROWS
from ..model.options.machines import without_effect
from ..model.toolpaths import embroidery, ros, toolpath, usd
from ..model.toolpaths.drawing import UNITS, Drawing, axes_of, seen_along
from ..model.toolpaths.order import Order
from . import flags, sheets
from .input import Input
from .place import Place
from .values import BadInput, file_name

# The most places where a drawing crosses itself that a report names.
_MOST_PLACES = 20


def add_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group(
        GROUP, f"How the curve is drawn in an --output of kind {', '.join(export.SUFFIXES)}."
    )
    flags.add_flags(group, GROUP, ROWS)
    group.add_argument(
        "--input-unit",
        choices=tuple(UNITS),
        help="the unit of length of the mesh file, which does not say it; default: m",
    )
    group.add_argument(
        "--input-up",
        choices=("y", "z"),
        help="which axis of the mesh file points up in the layouts; default: z",
    )
    for name, place in (("header", "behind the unit"), ("footer", "at the end")):
        group.add_argument(
            f"--{name}",
            type=file_name,
            metavar="FILE",
            help=f"lines of G-code {place}, in place of those of the machine",
        )
    group.add_argument(
        "--frame-id",
        metavar="NAME",
        help="the frame of reference that a .yaml of ROS names; default: world",
    )
    group.add_argument(
        "--layout-map", metavar="NAME", help="the UV map of --layout uv; default: the active one"
    )
    sheets.add_options(group)


def problem_of(arguments: argparse.Namespace) -> str | None:
    """What is wrong with the options, as a sentence, or None."""
    kind = export.format_of(arguments.output)
    suffix = export.suffix_of(arguments.output)
    for row in ROWS:
        given = getattr(arguments, row.flag.destination) not in (None, False)
        if given and row.setting in export.POSES and not _has_poses(arguments):
            return f"{row.flag.name} is for --poses and for .yaml; give both or none"
        if given and row.setting not in _taken(arguments):
            return f"{row.flag.name} does nothing for an --output of kind {suffix}; leave it out"
    idle = _idle(arguments)
    if idle:
        return idle
    for name in ("input_unit", "input_up"):
        option = f"--{name.replace('_', '-')}"
        if getattr(arguments, name) is None:
            continue
        if kind is None:
            return f"{option} does nothing for an --output of kind {suffix}; leave it out"
        if arguments.input.suffix.lower() == ".blend":
            return f"{option} is for mesh files, and a .blend knows its own; leave it out"
    if arguments.frame_id is not None and (kind is None or kind.name != "ROS"):
        return f"--frame-id does nothing for an --output of kind {suffix}; leave it out"
    for name in ("header", "footer"):
        path = getattr(arguments, name)
        if path is not None and (kind is None or kind.name != "GCODE"):
            return f"--{name} does nothing for an --output of kind {suffix}; leave it out"
        if path is not None:
            export.lines_of(path)  # which says what is wrong with it before anything is filled
    if arguments.layout == "view":
        return "--layout view needs a window; choose space, top, front, side or uv"
    if arguments.layout == "uv" and arguments.input.suffix.lower() != ".blend":
        return "--layout uv needs a UV map; give a .blend as --input"
    if arguments.visible_only and not export.is_seen(kind, _values(arguments)["layout_as"]):
        return "--visible-only needs --layout top, front or side"
    if kind is not None and export.lacks_plane(kind, _values(arguments)):
        return "--arcs lie in a plane; give a --layout that is flat, such as top, or leave them out"
    if arguments.layout_map is not None and arguments.layout != "uv":
        return "--layout-map needs --layout uv"
    of_sheets = sheets.problem_of(arguments, kind, _values(arguments))
    if of_sheets is not None:
        return of_sheets
    if arguments.outward and not _has_normals(arguments, kind):
        return "--outward turns normals, and nothing in the --output goes by them; leave it out"
    for option, wanted in (("begin-at", arguments.begin_at), ("go-on-from", arguments.go_on_from)):
        if wanted is None:
            continue
        if kind is None and suffix not in toolpath.SUFFIXES:
            return f"--{option} does nothing for an --output of kind {suffix}; leave it out"
        flat = kind is not None and export.is_flat(kind, _values(arguments))
        if len(wanted) != (2 if flat else 3):
            numbers = "two numbers, as the drawing is flat" if flat else "three numbers"
            return f"--{option} is a place in the coordinates of the file; give {numbers}"
    if arguments.backwards and kind is None and suffix not in toolpath.SUFFIXES:
        return f"--backwards does nothing for an --output of kind {suffix}; leave it out"
    if kind is not None and embroidery.is_wanted(arguments.output) and not embroidery.is_there():
        return embroidery.missing_text(None)
    if suffix in (".usdc", ".usd") and not usd.is_there():
        return usd.missing_text()
    return None


def _idle(arguments: argparse.Namespace) -> str:
    """What is said of a flag that changes nothing beside the others; empty: there is none."""
    names = {row.setting: row.flag.name for row in ROWS}
    given = {
        row.setting for row in ROWS if getattr(arguments, row.flag.destination) is not None
    }
    found = without_effect(given, _values(arguments))
    if found is None:
        return ""
    setting, other, choices = found
    return f"{names[setting]} is for {' '.join([names[other], choices]).strip()}; give both or none"


def _has_normals(arguments: argparse.Namespace, kind: export.Format | None) -> bool:
    """Whether what is written depends on which side of the surface is outside."""
    if arguments.cut is not None or arguments.direction_angle is not None:
        return True
    if kind is None:
        return export.suffix_of(arguments.output) != ".obj"
    if kind.name == "GCODE":
        values = _values(arguments)
        return values["layer_offset"] != 0.0 or values["layers"] > 1
    return kind.name in ("USD", "GLB", "ROS") or arguments.visible_only


def _has_poses(arguments: argparse.Namespace) -> bool:
    kind = export.format_of(arguments.output)
    return arguments.poses if kind is None else kind.name == "ROS"


def _taken(arguments: argparse.Namespace) -> tuple[str, ...]:
    """The settings that mean something for the output."""
    kind = export.format_of(arguments.output)
    if kind is None:
        return export.POSES if arguments.poses else ()
    return kind.options


def echo(arguments: argparse.Namespace) -> dict[str, Any]:
    """What is in effect, for the report; null: nothing, as the format does not take it."""
    kind = export.format_of(arguments.output)
    taken, values = _taken(arguments), _values(arguments)
    found = {
        row.flag.entry: values[row.setting] if row.setting in taken else None for row in ROWS
    }
    of_file = kind is not None and arguments.input.suffix.lower() != ".blend"
    return found | {
        **sheets.echo(arguments),
        "layout_map": arguments.layout_map,
        "frame_id": arguments.frame_id or ros.FRAME if kind and kind.name == "ROS" else None,
        "header": None if arguments.header is None else str(arguments.header),
        "footer": None if arguments.footer is None else str(arguments.footer),
        "input_unit": (arguments.input_unit or "m") if of_file else None,
        "input_up": (arguments.input_up or "z") if of_file else None,
    }


def laid(
    strands: Sequence[toolpath.Strand], arguments: argparse.Namespace, given: Input, place: Place
) -> list[toolpath.Strand]:
    """The strands as the file is to have them, in scene units. Raises BadInput."""
    kind = export.format_of(arguments.output)
    layout = _values(arguments)["layout_as"]
    if layout == "uv":
        host = place.blender("--layout uv")
        return host.unrolled(strands, given, arguments.layout_map or "")
    if arguments.visible_only:
        strands = place.blender("--visible-only").visible(strands, layout, given)
    if arguments.input_up == "y":
        strands = [_turned_up(strand) for strand in strands]
    if not export.is_seen(kind, layout):
        return list(strands)
    return seen_along(strands, *axes_of(layout))


def _turned_up(strand: toolpath.Strand) -> toolpath.Strand:
    """A strand of a mesh whose y axis points up, as one whose z axis does: y becomes z."""
    turn = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    return replace(
        strand,
        points=strand.points @ turn.T,
        normals=strand.normals @ turn.T,
        tangents=strand.tangents @ turn.T,
    )


def _refuse_unusable(
    drawing: Drawing,
    kind: export.Format,
    arguments: argparse.Namespace,
    strands: Sequence[toolpath.Strand],
    given: Input,
) -> None:
    """Raises BadInput for what no machine could take.

    strands   in space, as they were before they were laid
    """
    problem = before_writing.unusable(drawing, kind, _values(arguments))
    if problem is None:
        return
    of_file = given.surface_object is None
    if problem.edge:
        better = before_writing.better_layout(strands)
        ways = f"choose --layout {better}"
        if of_file:
            up = "z" if arguments.input_up == "y" else "y"
            ways += f", or --input-up {up} where that axis of the file points up"
    else:
        ways = "choose a --size or --scale"
        if of_file:
            ways = f"say by --input-unit what the file is in, or {ways}"
    raise BadInput(f"the drawing {problem.what}; {ways}, or --force to write it")


def write(
    path: Path,
    arguments: argparse.Namespace,
    strands: Sequence[toolpath.Strand],
    given: Input,
    place: Place,
    spacing: float,
    line: before_writing.Line,
    frames: Sequence[tuple[float, Sequence[toolpath.Strand]]] = (),
    rate: float = 24.0,
) -> tuple[int, dict[str, Any]]:
    """Writes strands that are laid out already. Returns the number of points in the file, and the
    report's "drawing".

    spacing    the least one, in scene units
    line       what the strands have been made of
    frames     times and strands of a curve that moves, and how many of them are a second

    Raises FileError for what is no drawing, and BadInput for one that no machine could take.
    """
    kind, values = export.format_of(arguments.output), _values(arguments)
    metres = _metres(arguments, given, place)
    order = order_of(arguments)
    drawing = export.prepared(strands, kind, values, metres, spacing, order, frames, rate)
    _refuse_unusable(drawing, kind, arguments, line.in_space, given)
    title = arguments.output.name[: -len(export.suffix_of(arguments.output))]
    head, foot = (
        None if file is None else export.lines_of(file)
        for file in (arguments.header, arguments.footer)
    )
    named = (head, foot, arguments.frame_id or ros.FRAME)
    export.write(path, kind, drawing, values, title, core.library_version(), *named)
    place.say(f"meander: {drawing.described()}")
    of_sheets = sheets.write(arguments, kind, drawing, values, head, foot, place)
    short = len(strands) - len(drawing.strands)
    if short and order.go_on is None:
        place.warn(f"{short} strands are shorter than a stitch and are left out")
    warning = before_writing.crossing_warning(drawing, kind, values, line)
    if warning:
        place.warn(warning)
    places = drawing.crossings()
    low, high = drawing.box()
    return drawing.point_count, {
        "unit": drawing.unit,
        "sides": (high - low).tolist(),
        "length": drawing.length,
        "crossings": len(places) if drawing.flat else None,
        "crossing_places": places[:_MOST_PLACES].tolist(),
        "sheets": of_sheets,
    }


def _metres(arguments: argparse.Namespace, given: Input, place: Place) -> float:
    """The length of a scene unit."""
    if given.surface_object is None:
        return UNITS[arguments.input_unit or "m"]
    return place.blender(arguments.input).metres()


def order_of(arguments: argparse.Namespace) -> Order:
    """How the tool follows the strands."""
    places = (arguments.begin_at, arguments.go_on_from)
    return Order(
        *(None if place is None else tuple(place) for place in places), arguments.backwards
    )


def beginning(
    strands: Sequence[toolpath.Strand], arguments: argparse.Namespace, given: Input, place: Place
) -> NDArray[np.float64]:
    """The place of --begin-at among strands that are laid, which is one of the drawing."""
    kind, values = export.format_of(arguments.output), _values(arguments)
    metres = _metres(arguments, given, place)
    return export.in_scene_units(arguments.begin_at, strands, kind, values, metres)


def _values(arguments: argparse.Namespace) -> dict[str, Any]:
    """What the flags say, and the defaults for those that are not given."""
    given = {row.setting: getattr(arguments, row.flag.destination) for row in ROWS}
    return {
        name: export.DEFAULTS[name] if value is None else value for name, value in given.items()
    }
