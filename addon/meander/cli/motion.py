# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command that bake the curve of an animated mesh into the file."""

from __future__ import annotations

import argparse
from typing import Any

from .flags import FLAGGED, add_flags


def add_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group(
        "motion", "Frames of a mesh in a .blend that armatures, lattices or shape keys move."
    )
    add = group.add_argument
    add(
        "--bake-frames",
        type=int,
        nargs=2,
        metavar=("START", "END"),
        help="write the curve of these frames into the .blend; it is grown in the file's own frame "
        "or in that of --frame",
    )
    add_flags(group, "motion")


def problem_of(arguments: argparse.Namespace, kind: str) -> str | None:
    """What is wrong with the options, as a sentence, or None."""
    if arguments.bake_frames is None:
        for _option, flag in FLAGGED:
            if flag.group == "motion" and getattr(arguments, flag.destination) != flag.default:
                return f"{flag.name} needs --bake-frames START END"
        return None
    first, last = arguments.bake_frames
    if first > last:
        return f"--bake-frames {first} {last} ends before it begins; give the earlier frame first"
    if kind != ".blend" or arguments.output.suffix.lower() != ".blend":
        return "--bake-frames needs an --input and an --output of kind .blend"
    return None


def echo(arguments: argparse.Namespace) -> dict[str, Any]:
    """What is in effect, for the report."""
    return {"bake_frames": arguments.bake_frames}
