# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command for the terms of the energy; no bpy."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import core

AXES = ("x", "y", "z")
# What --direction may say besides the name of an attribute.
_COMPUTED = ("curvature", "smooth", *AXES)


def add_options(parser: argparse.ArgumentParser, not_negative: Callable[[str], float]) -> None:
    """Adds the options; `not_negative` reads a finite number of 0 or more."""
    group = parser.add_argument_group("terms of the energy")
    add = group.add_argument
    add("--length", type=not_negative, metavar="W", help="weight of the curve's length")
    add(
        "--bending",
        type=not_negative,
        metavar="W",
        help="weight of bending; the polish follows in proportion",
    )
    add(
        "--alignment",
        type=not_negative,
        metavar="W",
        help="weight of the field of --direction; 0.5 to 2 are useful; default: 1 with a field",
    )
    add(
        "--direction",
        metavar="ATTRIBUTE",
        help="the field that the curve lies along: a vector attribute of the points of the "
        ".blend's object, or curvature (where the surface bends least), smooth, or an axis of the "
        "object: x, y, z",
    )
    add("--across", action="store_true", help="lie across the field instead")
    add("--length-power", type=not_negative, metavar="P", help="p of the length term; default: 2")
    add("--medial-power", type=not_negative, metavar="Q", help="q of the medial term; default: 2")
    add(
        "--start-spacing",
        type=not_negative,
        metavar="FACTOR",
        help="fill at this many times the spacing first, then come down to it: fewer corners, "
        "more iterations; 1 to 16",
    )


def problem_of(arguments: argparse.Namespace, kind: str) -> str | None:
    """One sentence for options that do not fit each other or the input, whose suffix is `kind`."""
    direction = arguments.direction
    if direction is None:
        if arguments.alignment:
            return "--alignment needs a field; give one to --direction, such as curvature"
        if arguments.across:
            return "--across needs a field; give one to --direction, such as curvature"
    elif direction not in _COMPUTED and kind != ".blend":
        return (
            f"--direction {direction!r} names an attribute of a .blend, but --input is {kind}; "
            f"choose one of {', '.join(_COMPUTED)}"
        )
    return None


def apply(arguments: argparse.Namespace, options: core.FlowOptions) -> None:
    """Puts what the command line says in the place of the preset's values."""
    if arguments.length is not None:
        options.length_weight = arguments.length
    if arguments.bending is not None:
        # Both belong to one material: a curve that grows stiff should not be polished limp.
        if options.bending_weight > 0:
            options.polish_bending_weight *= arguments.bending / options.bending_weight
        options.bending_weight = arguments.bending
    if arguments.direction is not None:
        options.alignment_weight = 1.0 if arguments.alignment is None else arguments.alignment
    if arguments.length_power is not None:
        options.length_power = arguments.length_power
    if arguments.medial_power is not None:
        options.medial_power = arguments.medial_power
    if arguments.start_spacing is not None:
        options.start_spacing_factor = arguments.start_spacing


def attribute_name(arguments: argparse.Namespace) -> str | None:
    """The attribute that --direction names; None where it names none."""
    return None if arguments.direction in (None, *_COMPUTED) else arguments.direction


def set_directions(
    flow: core.Flow,
    surface: core.Surface,
    arguments: argparse.Namespace,
    vectors: NDArray[np.float64] | None,
) -> None:
    """Gives the flow its field, if it has one.

    vectors   (n, 3) of an attribute, (3,) of an axis of the object; None: an axis of the file, or
              a field that the library computes
    """
    direction = arguments.direction
    if direction is None:
        return
    if direction == "smooth":
        field = surface.directions("smooth")
    elif direction == "curvature":
        # What bends within a spacing is too small for strands to follow.
        smoothing = min(arguments.spacing, surface.statistics()["diagonal"])
        field = surface.directions("curvature_min", smoothing)
    else:
        field = np.eye(3)[AXES.index(direction)] if vectors is None else vectors
        if field.ndim == 1:
            field = np.tile(field, (surface.vertex_count, 1))
    flow.set_directions(field, "across" if arguments.across else "along")


def echo(arguments: argparse.Namespace, options: core.FlowOptions) -> dict[str, Any]:
    """What the report says of the terms, by the names of the command line."""
    return {
        "length": options.length_weight,
        "bending": options.bending_weight,
        "alignment": options.alignment_weight,
        "direction": arguments.direction,
        "across": arguments.across,
    }
