# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command that write the surface cut along the curve."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from .. import core
from ..model import cut as cut_files
from .input import Input
from .place import Place
from .values import file_name, positive

_SUFFIXES = (*cut_files.SUFFIXES, ".blend")


def add_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group(
        "cut", "The surface as a mesh that has the curve among its edges."
    )
    add = group.add_argument
    add("--cut", type=file_name, metavar="OUT", help="also write it: .obj, .ply or .blend")
    add(
        "--cut-detail",
        type=positive,
        metavar="D",
        help="with further vertices about this far apart, for fields that follow the distance",
    )
    add(
        "--cut-middle-lines",
        action="store_true",
        help="with edges halfway between neighbouring turns of the curve too",
    )


def problem_of(arguments: argparse.Namespace) -> str | None:
    """What is wrong with the options, as a sentence, or None."""
    if arguments.cut is None:
        if arguments.cut_detail is not None:
            return "--cut-detail needs --cut FILE"
        if arguments.cut_middle_lines:
            return "--cut-middle-lines needs --cut FILE"
        return None
    if arguments.cut.suffix.lower() not in _SUFFIXES:
        return f"--cut {arguments.cut} is no .obj, .ply or .blend file"
    return None


def echo(arguments: argparse.Namespace) -> dict[str, Any]:
    """What is in effect, for the report."""
    return {
        "cut": None if arguments.cut is None else str(arguments.cut),
        "cut_detail": arguments.cut_detail,
        "cut_middle_lines": arguments.cut_middle_lines,
    }


def cut_of(flow: core.Flow, arguments: argparse.Namespace) -> core.CutSurface | None:
    """The cut of a run that has ended; None where none is wanted. Raises core.MeanderError."""
    if arguments.cut is None:
        return None
    detail, middle_lines = arguments.cut_detail or 0.0, arguments.cut_middle_lines
    return core.cut_surface(flow, detail, middle_lines)


def write(
    path: Path, arguments: argparse.Namespace, given: Input, cut: core.CutSurface, place: Place
) -> dict[str, int]:
    """Writes a cut to a file, and returns its figures for the report."""
    if arguments.cut.suffix.lower() == ".blend":
        place.blender(arguments.cut).write_cut_scene(path, arguments, given, cut)
    else:
        cut_files.write(path, cut, arguments.spacing)
    return {
        "vertices": len(cut.positions),
        "faces": len(cut.faces),
        "regions": int(cut.regions.max()) + 1,
    }
