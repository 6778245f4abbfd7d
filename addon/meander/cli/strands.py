# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command for strokes, guides and parts left out by the seed; no bpy."""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .flags import add_flags
from .values import file_name, index, number

Stroke = tuple[list[float], list[float]]  # its ends


def add_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group(
        "strands",
        "One stroke is an open strand whose ends stay where they are; guides are strands that stay "
        "as drawn, and that the others keep the spacing from.",
    )
    add = group.add_argument
    for end, other in (("from", "beginning"), ("to", "end")):
        add(
            f"--{end}",
            dest=f"stroke_{end}",
            nargs=3,
            type=number,
            metavar=("X", "Y", "Z"),
            help=f"{other} of one stroke, in the mesh's space",
        )
        add(f"--{end}-vertex", type=index, metavar="N", help="the same: a vertex, counted from 0")
    add_flags(group, "strands")
    add("--guides", type=file_name, metavar="CURVE", help=".obj of strands that stay as drawn")
    add("--guides-object", metavar="NAME", help="the same in the .blend, as for --seed-object")
    add("--leave-out-guides", action="store_true", help="write only what has grown")


def problem_of(arguments: argparse.Namespace) -> str | None:
    """One sentence about options that do not fit each other; None: they do."""
    for option, path in (("--seed", arguments.seed), ("--guides", arguments.guides)):
        if path is not None and path.suffix.lower() != ".obj":
            return f"{option} {path} is no .obj file"
    has_guides = arguments.guides is not None or arguments.guides_object is not None
    if arguments.guides is not None and arguments.guides_object is not None:
        return "--guides and --guides-object are both given; choose one"
    ends = []
    for end in ("from", "to"):
        place = getattr(arguments, f"stroke_{end}")
        vertex = getattr(arguments, f"{end}_vertex")
        if place is not None and vertex is not None:
            return f"--{end} and --{end}-vertex are both given; choose one"
        ends.append(place is not None or vertex is not None)
    if any(ends) and not all(ends):
        return f"a stroke needs two ends; give {'--to' if ends[0] else '--from'} as well"
    if any(ends) and (arguments.seed is not None or arguments.seed_object is not None):
        return "a seed and the ends of a stroke are both given; choose one"
    if arguments.leave_out_guides and not has_guides:
        return "--leave-out-guides is given without guides; give --guides as well"
    return None


def stroke_of(arguments: argparse.Namespace, vertices: NDArray[np.float64]) -> Stroke | str | None:
    """The ends of the stroke, None without one, or one sentence for a vertex that is not there."""
    ends = []
    for end in ("from", "to"):
        place = getattr(arguments, f"stroke_{end}")
        vertex = getattr(arguments, f"{end}_vertex")
        if vertex is not None:
            if vertex >= len(vertices):
                return (
                    f"--{end}-vertex {vertex} is not a vertex of {arguments.input}, which has "
                    f"{len(vertices)}, counted from 0"
                )
            place = vertices[vertex].tolist()
        ends.append(place)
    if ends[0] is None:
        return None
    if list(ends[0]) == list(ends[1]):
        return "the two ends of the stroke are the same place; give --from and --to two places"
    return ends[0], ends[1]


def echo(arguments: argparse.Namespace, stroke: Stroke | None) -> dict[str, Any]:
    """The entries of the report about the strands."""
    return {
        "from": None if stroke is None else stroke[0],
        "to": None if stroke is None else stroke[1],
        "guides": None if arguments.guides is None else str(arguments.guides),
        "guides_object": arguments.guides_object,
        "leave_out_guides": arguments.leave_out_guides,
    }
