# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command that bake the curve of an animated mesh into the file."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any


def add_options(parser: argparse.ArgumentParser, count: Callable[[str], int]) -> None:
    """Adds the options; `count` reads a whole number from 1 on."""
    group = parser.add_argument_group(
        "motion", "Frames of a mesh in a .blend that armatures, lattices or shape keys move."
    )
    add = group.add_argument
    add(
        "--bake-frames",
        type=int,
        nargs=2,
        metavar=("START", "END"),
        help="write the curve of these frames into the .blend; it is grown in the file's own frame",
    )
    add(
        "--motion",
        choices=("even", "stick"),
        default="even",
        help="baked frames keep the spacing, or their points stay on their faces",
    )
    add("--motion-steps", type=count, default=3, metavar="N", help="iterations for each frame")


def problem_of(arguments: argparse.Namespace, kind: str) -> str | None:
    """What is wrong with the options, as a sentence, or None."""
    if arguments.bake_frames is None:
        for name, default in (("motion", "even"), ("motion_steps", 3)):
            if getattr(arguments, name) != default:
                return f"--{name.replace('_', '-')} needs --bake-frames START END"
        return None
    first, last = arguments.bake_frames
    if first > last:
        return f"--bake-frames {first} {last} ends before it begins; give the earlier frame first"
    if kind != ".blend" or arguments.output.suffix.lower() != ".blend":
        return "--bake-frames needs an --input and an --output of kind .blend"
    return None


def echo(arguments: argparse.Namespace) -> dict[str, Any]:
    """What is in effect, for the report."""
    return {
        "bake_frames": arguments.bake_frames,
        "motion": arguments.motion,
        "motion_steps": arguments.motion_steps,
    }
