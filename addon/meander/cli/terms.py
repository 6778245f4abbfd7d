# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command for the terms of the energy, directions above all; no bpy."""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

from .. import core
from ..model.alignment import Alignment, Directions, axis_on, computed
from .flags import add_flags
from .values import BadInput

# What --direction may be other than the name of an attribute: a source and a choice.
_WORDS = {
    "curvature": ("CURVATURE", "MIN"),
    "curvature-max": ("CURVATURE", "MAX"),
    "smooth": ("SMOOTH", ""),
    "boundary": ("BOUNDARY", ""),
    "axis": ("AXIS", "AUTO"),
    "x": ("AXIS", "X"),
    "y": ("AXIS", "Y"),
    "z": ("AXIS", "Z"),
    "u": ("UV", "U"),
    "v": ("UV", "V"),
}
_IN_A_SCENE = ("UV", "ATTRIBUTE", "STROKES")


def add_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("terms of the energy")
    add_flags(group, "terms of the energy")
    group.add_argument(
        "--direction",
        metavar="ATTRIBUTE",
        help="the field that the curve lies along: a vector attribute of the points of the "
        ".blend's object, or curvature (where the surface bends least), curvature-max, smooth, "
        "boundary (parallel to it), an axis of the object (x, y, z, or axis: the one that lies "
        "best in the surface), or lines of its UV map (u, v)",
    )
    group.add_argument(
        "--direction-object", metavar="NAME", help="curve object whose splines give the directions"
    )
    group.add_argument(
        "--direction-angle",
        metavar="NAME",
        help="what turns that field in the surface, counterclockwise as seen from outside: a "
        "vertex group, color attribute or image of the .blend, from 0 to 180 degrees, or a float "
        "attribute of its points, in degrees",
    )


def problem_of(arguments: argparse.Namespace, kind: str) -> str | None:
    """One sentence about options that do not fit each other, or the input of suffix `kind`."""
    source = alignment_of(arguments).source
    if arguments.direction is not None and arguments.direction_object is not None:
        return "--direction and --direction-object are both given; choose one"
    if source == "NONE":
        if arguments.alignment:
            return "--alignment needs a field; give one to --direction, such as curvature"
        if arguments.direction_angle is not None:
            return "--direction-angle turns a field; give one to --direction, such as x"
        if arguments.across:
            return "--across needs a field; give one to --direction, such as curvature"
    if kind != ".blend" and source in _IN_A_SCENE:
        option = "direction" if arguments.direction is not None else "direction-object"
        named = arguments.direction or arguments.direction_object
        return (
            f"--{option} {named!r} names something of a .blend, but --input is {kind}; "
            "choose curvature, curvature-max, smooth, boundary, axis, x, y or z"
        )
    if kind != ".blend" and arguments.direction_angle is not None:
        return (
            f"--direction-angle {arguments.direction_angle!r} names something of a .blend, but "
            f"--input is {kind}; give a .blend to --input"
        )
    if arguments.direction_smoothing is not None and source != "CURVATURE":
        return "--direction-smoothing is for --direction curvature and curvature-max"
    return None


def alignment_of(arguments: argparse.Namespace) -> Alignment:
    """The field and its weight."""
    source, name, choice = "NONE", "", ""
    if arguments.direction_object is not None:
        source, name = "STROKES", arguments.direction_object
    elif arguments.direction in _WORDS:
        source, choice = _WORDS[arguments.direction]
        name = arguments.uv_map or "" if source == "UV" else ""
    elif arguments.direction is not None:
        source, name = "ATTRIBUTE", arguments.direction
    given, smoothing = arguments.alignment, arguments.direction_smoothing
    return Alignment(
        source=source,
        weight=0.0 if source == "NONE" else Alignment.weight if given is None else given,
        across=arguments.across,
        name=name,
        choice=choice,
        local=True,
        smoothing=Alignment.smoothing if smoothing is None else smoothing,
    )


def directions_without_a_scene(
    alignment: Alignment, vertices: np.ndarray, faces: np.ndarray, radius: float
) -> Directions | None:
    """The directions on a mesh that came from a file of its own. Raises BadInput."""
    if alignment.source == "AXIS":
        axis = axis_on(alignment.choice, np.eye(3), vertices, faces)
        if axis.problem:
            raise BadInput(axis.problem)
        return axis.directions(len(vertices))
    if alignment.source == "CURVATURE":
        return computed(f"curvature_{alignment.choice.lower()}", alignment.smoothing * radius)
    if alignment.source in ("SMOOTH", "BOUNDARY"):
        return computed(alignment.source.lower())
    return None


def echo(arguments: argparse.Namespace, options: core.FlowOptions) -> dict[str, Any]:
    """The entries of the report about the directions."""
    alignment = alignment_of(arguments)
    return {
        "alignment": options.alignment_weight,
        "direction": arguments.direction,
        "direction_object": arguments.direction_object,
        "direction_angle": arguments.direction_angle,
        "direction_smoothing": alignment.smoothing if alignment.source == "CURVATURE" else None,
    }
