# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command that draws a picture writes: the drawings, a preview, and the report; no bpy."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, NamedTuple

from .. import core
from ..model.files.obj import write_obj_curve
from ..model.files.rows import write_pieces
from ..model.files.whole import naming, whole_files
from ..model.picture import line
from ..model.picture.drawn import preview
from ..model.picture.image import Image
from ..model.picture.page import (
    curve_of,
    drawing_of,
    moved,
    of_ink,
    pieces_of_page,
    pieces_of_sheet,
    sheets_of_file,
    sheets_of_page,
)
from ..model.report import write_report
from ..model.sheets import described, entry, file_of
from . import sheets as sheet_options
from . import standard
from .wishes import PREVIEWS, file_values, in_one_file

_PREVIEW_SIZE = 2000


def _sides(arguments: argparse.Namespace, layers: Sequence[line.Layer]) -> tuple[float, float]:
    """Of the page, in millimetres."""
    width, height = layers[0].plan.grid.sides
    return width + 2.0 * arguments.margin, height + 2.0 * arguments.margin


def _files(arguments: argparse.Namespace, layers: list[line.Layer]) -> dict[Path, list[line.Layer]]:
    """The drawings that are written, and what is in them."""
    path = arguments.output
    if len(layers) == 1 or in_one_file(arguments):
        return {path: layers}
    return {of_ink(path, layer.plan.name): [layer] for layer in layers}


class _Sheets(NamedTuple):
    """The sheets of one of the drawings.

    pieces   what the file of each holds
    said     how they lie
    entry    of the report
    """

    pieces: dict[Path, Iterable[str | bytes]]
    said: str
    entry: dict[str, Any]


def _sheets(arguments: argparse.Namespace, layers: list[line.Layer]) -> list[_Sheets]:
    """The sheets of all drawings, where they are asked for."""
    paper = sheet_options.paper_of(arguments)
    if paper is None:
        return []
    parted, found = sheets_of_page(layers, paper), []
    for path, of_file in _files(arguments, layers).items():
        of_path = sheets_of_file(of_file, parted)
        pieces = {}
        for sheet in of_path.drawn:
            name = file_of(path, sheet)
            pieces[name] = pieces_of_sheet(name, of_file, parted, sheet, file_values(arguments))
        found.append(_Sheets(pieces, described(path, of_path), entry(path, of_path)))
    return found


def write_drawings(
    arguments: argparse.Namespace,
    layers: list[line.Layer],
    record: dict[str, Any],
    say: Callable[[str], None],
) -> list[Path]:
    """Writes all files, or none; returns their paths."""
    files, sheets = _files(arguments, layers), _sheets(arguments, layers)
    others = [path for path in (arguments.preview, arguments.report) if path is not None]
    told = _told(record)
    record["sheets"] = [each.entry for each in sheets] or None
    named = [path for each in sheets for path in each.pieces]
    with whole_files([*files, *named, *others]) as temporary:
        paths = dict(zip([*files, *named, *others], temporary, strict=True))
        for path, of_file in files.items():
            with naming(path):
                _write_drawing(paths[path], path, of_file, arguments)
        for each in sheets:
            for path, pieces in each.pieces.items():
                with naming(path):
                    write_pieces(paths[path], pieces)
        if arguments.preview is not None:
            with naming(arguments.preview):
                _write_preview(paths[arguments.preview], layers, arguments)
        for text in (*told, *(each.said for each in sheets)):
            say(text)
        if arguments.report is not None:
            with naming(arguments.report):
                write_report(paths[arguments.report], record)
    return list(paths)


def _write_drawing(
    temporary: Path, path: Path, layers: list[line.Layer], arguments: argparse.Namespace
) -> None:
    suffix = path.suffix.lower()
    if suffix in PREVIEWS:
        _write_preview(temporary, layers, arguments)
    elif suffix == ".obj":
        write_obj_curve(temporary, curve_of(drawing_of(layers, arguments.margin)))
    else:
        sides, values = _sides(arguments, layers), file_values(arguments)
        write_pieces(temporary, pieces_of_page(path, layers, sides, arguments.margin, values))


def _write_preview(
    temporary: Path, layers: list[line.Layer], arguments: argparse.Namespace
) -> None:
    shown = [
        (layer.plan.colour, [moved(strand, arguments.margin) for strand in layer.strands])
        for layer in layers
    ]
    width = arguments.pen + arguments.spread
    preview(shown, _sides(arguments, layers), width, _PREVIEW_SIZE).save(temporary, format="PNG")


def record_of(
    arguments: argparse.Namespace, image: Image, wishes: line.Wishes, layers: list[line.Layer]
) -> dict[str, Any]:
    """The report: a JSON object."""
    values = file_values(arguments)
    length = sum(layer.length for layer in layers)
    travel = sum(layer.travel for layer in layers)
    return {
        "version": core.library_version(),
        "picture": None if arguments.picture is None else _name(arguments),
        "pixels": list(image.sides),
        "sides": list(layers[0].plan.grid.sides),
        "page": list(_sides(arguments, layers)),
        "places": [count + 1 for count in layers[0].plan.grid.cells],
        "options": asdict(wishes)
        | {"margin": arguments.margin}
        | {name: values[name] for name in ("feed", "travel_feed")},
        "length": length,
        "travel": travel,
        "minutes": length / values["feed"] + travel / values["travel_feed"],
        "inks": [layer.entry() for layer in layers],
    }


def _name(arguments: argparse.Namespace) -> str:
    """Of the picture."""
    return str(standard.echo(arguments).get("picture", arguments.picture))


def _told(record: dict[str, Any]) -> list[str]:
    """What there is to say of a drawing, a sentence each."""
    width, height = record["sides"]
    told = [
        f"{width:g} x {height:.4g} mm, {record['length'] / 1000.0:.3g} m of line, "
        f"{record['minutes']:.3g} minutes at {record['options']['feed']:g} mm a minute"
    ]
    for ink in record["inks"]:
        lines = "one line" if ink["lines"] == 1 else f"{ink['lines']} lines"
        tone = ink["tone"]
        told.append(
            f"{ink['ink']}: {lines}, spacing {ink['spacing']:.3g} mm in the mean, tone right to "
            f"{tone['error_1']:.3f} of the range at one spacing and {tone['error_2']:.3f} at two"
        )
        for name, what in (("too_dark", "darker"), ("too_light", "lighter")):
            lost = ink["out_of_reach"][name]
            if lost >= 0.005:
                told.append(f"{100.0 * lost:.3g} % of the picture is {what} than the pen can be")
        if ink["stop_reason"] != "converged":
            told.append(f"the run has ended early: {ink['stop_reason'].replace('_', ' ')}")
    return told
