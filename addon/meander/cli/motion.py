# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command that bake the curve of an animated mesh into the file."""

from __future__ import annotations

import argparse
from typing import Any

from ..model import export
from .flags import FLAGGED, add_flags

# What lays a file out otherwise than the curve lies, which frames do not follow.
_OF_ONE_FRAME = ("layout", "begin_at", "go_on_from", "backwards", "part_length")


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
        help="write the curve of these frames into the .blend, or into USD as samples in time; it "
        "is grown in the file's own frame or in that of --frame",
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
    moves = export.takes_frames(export.format_of(arguments.output))
    if kind != ".blend" or not (moves or arguments.output.suffix.lower() == ".blend"):
        return (
            "--bake-frames needs an --input of kind .blend, and an --output of kind .blend or USD"
        )
    for name in _OF_ONE_FRAME if moves else ():
        if getattr(arguments, name) not in (None, False, "space"):
            option = f"--{name.replace('_', '-')}"
            return f"{option} is of one frame, and --bake-frames has several; leave out one of both"
    return None


def echo(arguments: argparse.Namespace) -> dict[str, Any]:
    """What is in effect, for the report."""
    return {"bake_frames": arguments.bake_frames}
