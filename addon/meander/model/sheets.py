# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of the sheets that a drawing is parted into, beside that of the whole; no bpy."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Any

from . import export
from .files.rows import write_pieces
from .files.whole import Whole, naming, whole_files
from .options.option import Values
from .toolpaths.drawing import Drawing
from .toolpaths.sheets import Paper, Sheet, Sheets, sheets_of

_NAME = re.compile(r"_r[1-9]\d*c[1-9]\d*")


def file_of(path: Path, sheet: Sheet) -> Path:
    """Where a sheet of a drawing goes, such as NAME_r1c2.svg."""
    suffix = export.suffix_of(path)
    return path.with_name(f"{path.name[: -len(suffix)]}_{sheet.name}{path.name[-len(suffix):]}")


def is_of(path: Path, other: Path) -> bool:
    """Whether writing the sheets of `path` could write `other`."""
    stem = other.stem
    behind = stem[len(path.stem) :]
    same = stem[: len(path.stem)].casefold() == path.stem.casefold()
    of_kind = path.suffix.lower() == other.suffix.lower()
    if not (same and of_kind and _NAME.fullmatch(behind.lower())):
        return False
    return os.path.realpath(path.parent) == os.path.realpath(other.parent)


def write(
    path: Path,
    kind: export.Format,
    drawing: Drawing,
    values: Values,
    paper: Paper,
    version: str,
    head: Sequence[str] | None = None,
    foot: Sequence[str] | None = None,
    beside: Whole | None = None,
) -> Sheets:
    """Writes the sheets of a drawing, all of them or none, into files beside that of the whole.

    path     of the whole; see export.write() for the rest
    beside   other files, with which they become files; None: they do by themselves

    Raises FileError.
    """
    sheets = sheets_of(drawing, paper, values["arc_tolerance"])
    with whole_files([]) if beside is None else nullcontext(beside) as files:
        for sheet in sheets.drawn:
            name = file_of(path, sheet)
            pieces = export.pieces_of(
                kind, sheet.drawing, values, name.stem, version, path.suffix, head, foot
            )
            place = files.begin(name)
            with naming(name):
                write_pieces(place, pieces)
    return sheets


def described(path: Path, sheets: Sheets) -> str:
    """How many there are, how they lie and what they are called."""
    drawn, empty = sheets.drawn, sheets.empty
    first, last = (file_of(path, sheet).name for sheet in (drawn[0], drawn[-1]))
    if len(drawn) == 1:
        text = f"1 sheet of {sheets.paper.described()}, {first}"
    else:
        text = f"{len(drawn)} sheets of {sheets.paper.described()}, {first} to {last}"
    if empty:
        names = ", ".join(empty[:5]) + (f" and {len(empty) - 5} more" if len(empty) > 5 else "")
        text += f"; nothing lies on {names}, which {'is' if len(empty) == 1 else 'are'} not written"
    return text


def entry(path: Path, sheets: Sheets) -> dict[str, Any]:
    """What the report says of them; lengths of lines are in the unit of the drawing."""
    return {
        "paper": [sheets.paper.width, sheets.paper.height],
        "margin": sheets.paper.margin,
        "rows": sheets.rows,
        "columns": sheets.columns,
        "written": [
            {
                "file": file_of(path, sheet).name,
                "row": sheet.row,
                "column": sheet.column,
                "paths": len(sheet.drawing.strands),
                "length": sheet.drawing.length,
            }
            for sheet in sheets.drawn
        ],
        "empty": sheets.empty,
    }
