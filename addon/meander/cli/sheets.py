# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command that part a drawing into sheets of paper."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .. import core
from ..model import export, sheets
from ..model.camera import PAPERS
from ..model.files.whole import are_one
from ..model.toolpaths.drawing import Drawing
from ..model.toolpaths.sheets import MARGIN, Paper
from .place import Place
from .values import paper, reader

# What is stitched in one piece.
_HOOPS = (".dst", ".pes")


def add_options(group: argparse._ArgumentGroup) -> None:
    group.add_argument(
        "--sheet",
        type=_sheet,
        metavar="SIZE",
        help="write a flat .svg, .dxf or G-code also in sheets of this size, NAME_r1c1 and so on, "
        f"with marks that meet: {', '.join(PAPERS)}, lying or standing, or sides in millimetres, "
        "such as 297x210",
    )
    group.add_argument(
        "--sheet-margin",
        type=reader(float, least=0.0),
        metavar="MM",
        help=f"white on all sides of a --sheet, in millimetres; default: {MARGIN:g}",
    )


def _sheet(text: str) -> Paper:
    """What has a name may lie or stand; sides are meant as they are given."""
    return Paper(*paper(text), turns=text.lower() in PAPERS)


def paper_of(arguments: argparse.Namespace) -> Paper | None:
    """The sheets that are asked for."""
    size, margin = arguments.sheet, arguments.sheet_margin
    if size is None or margin is None:
        return size
    return Paper(size.width, size.height, margin, size.turns)


def problem_of(
    arguments: argparse.Namespace, kind: export.Format | None, values: dict[str, Any]
) -> str | None:
    """What is wrong with the options, as a sentence, or None."""
    asked = paper_of(arguments)
    if asked is None:
        if arguments.sheet_margin is not None:
            return "--sheet-margin is for --sheet; give both or none"
        return None
    suffix = export.suffix_of(arguments.output)
    if kind is None or "arc_tolerance" not in kind.options:
        fits = ", and give a --size that fits into the hoop" if suffix in _HOOPS else ""
        return f"--sheet does nothing for an --output of kind {suffix}; leave it out{fits}"
    if not export.takes_sheets(kind, values):
        return "--sheet is for drawings that are flat; give a --layout such as top"
    if "output" in getattr(arguments, "streams", ()):
        return "--sheet writes several files, which the standard output cannot take; name a file"
    if not asked.has_room:
        return (
            f"--sheet-margin {asked.margin:g} leaves nothing of a sheet of {asked.described()}; "
            "choose a smaller one"
        )
    return None


def may_write(arguments: argparse.Namespace, output: Path, path: Path) -> bool:
    """Whether a sheet of an output could have the name of a file, or be written through a link to
    it."""
    if arguments.sheet is None:
        return False
    if sheets.is_of(output, path):
        return True
    beside = output.parent.iterdir() if output.parent.is_dir() else ()
    return any(sheets.is_of(output, each) and are_one(each, path) for each in beside)


def echo(arguments: argparse.Namespace) -> dict[str, Any]:
    """What is in effect, for the report."""
    asked = paper_of(arguments)
    return {
        "sheet": None if asked is None else [asked.width, asked.height],
        "sheet_margin": None if asked is None else asked.margin,
    }


def write(
    arguments: argparse.Namespace,
    kind: export.Format,
    drawing: Drawing,
    values: dict[str, Any],
    head: Sequence[str] | None,
    foot: Sequence[str] | None,
    place: Place,
) -> dict[str, Any] | None:
    """Writes the sheets of a drawing, if they are asked for. Returns what the report says of them.

    head, foot   lines of G-code in place of those of the machine

    Raises FileError.
    """
    asked, path = paper_of(arguments), arguments.output
    if asked is None:
        return None
    version = core.library_version()
    done = sheets.write(
        path, kind, drawing, values, asked, version, head, foot, arguments.written_beside
    )
    place.say(f"meander: {sheets.described(path, done)}")
    return sheets.entry(path, done)
