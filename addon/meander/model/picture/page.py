# SPDX-License-Identifier: GPL-3.0-or-later
"""A drawing of a picture as what a file holds; no bpy."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ... import core
from .. import export
from ..options.option import Values
from ..toolpaths import embroidery, lights
from ..toolpaths.drawing import UNITS, Drawing
from ..toolpaths.drawing import moved as as_long_as
from ..toolpaths.sheets import Paper, Sheet, Sheets, sheets_of
from ..toolpaths.svg import page_pieces
from ..toolpaths.toolpath import Strand
from .line import Layer


def pieces_of_page(
    path: Path,
    layers: Sequence[Layer],
    sides: Sequence[float],
    margin: float,
    values: Values,
) -> Iterable[str | bytes]:
    """What a file of one of export.FORMATS holds, a block after the other.

    path      for its suffix and its title
    layers    of inks; of an .svg they are its layers
    sides     width and height of the page, in millimetres
    values    of options.export.ROWS, by setting; a line has the width of the pen where it has no
              thickness

    Raises FileError for what is no drawing.
    """
    kind, version = export.format_of(path), core.library_version()
    title, suffix = named(path)
    drawing = drawing_of(layers, margin)
    if values["thickness"] is None:
        values = values | {"thickness": values["line_width"] / drawing.spacing}
    if kind.unit == "m":
        drawing = _in_metres(drawing)
    if kind.name in ("DST", "PES"):
        stitches = (values[f"stitch_{name}"] for name in ("length", "tolerance", "least"))
        drawing = embroidery.stitched(drawing, *stitches)
    elif "pitch" in kind.options:
        drawing = lights.placed(drawing, values["pitch"])
    elif values["arc_tolerance"] > 0.0:
        drawing = drawing.with_arcs(values["arc_tolerance"])
    if kind.name != "SVG":
        return export.pieces_of(kind, drawing, values, title, version, suffix)
    shown = [
        (layer.plan.name, [moved(strand, margin) for strand in layer.strands]) for layer in layers
    ]
    colours = [layer.plan.colour for layer in layers]
    width = values["line_width"]
    return page_pieces(shown, sides, width, title, version, colours, drawing.moves)


def named(path: Path) -> tuple[str, str]:
    """What a file is called, and the end of its name that says its kind."""
    length = len(export.suffix_of(path))
    return path.name[:-length], path.name[-length:]


def of_ink(path: Path, name: str) -> Path:
    """The file of one of several inks."""
    title, suffix = named(path)
    return path.with_name(f"{title}_{name}{suffix}")


def drawing_of(layers: Sequence[Layer], margin: float) -> Drawing:
    """The strands of all layers on a page, in millimetres from its lower left corner."""
    spacing = min(layer.plan.least_spacing for layer in layers)
    strands = [moved(strand, margin) for layer in layers for strand in layer.strands]
    return Drawing(strands, "mm", True, spacing)


def sheets_of_page(layers: Sequence[Layer], paper: Paper) -> dict[str, Sheets]:
    """The sheets of each layer, by its name; they lie as those of all together do."""
    whole = drawing_of(layers, 0.0)
    numbers = np.repeat(np.arange(len(layers)), [len(layer.strands) for layer in layers])
    marked = [replace(strand, part=int(k) + 1) for strand, k in zip(whole.strands, numbers)]
    parted = sheets_of(replace(whole, strands=marked), paper)
    found = {}
    for number, layer in enumerate(layers, 1):
        drawn = []
        for sheet in parted.drawn:
            own = [strand for strand in sheet.drawing.strands if strand.part == number]
            plain = [replace(strand, part=0) for strand in own]
            if own:
                drawn.append(sheet._replace(drawing=replace(sheet.drawing, strands=plain)))
        found[layer.plan.name] = parted._replace(drawn=drawn)
    return found


def sheets_of_file(layers: Sequence[Layer], parted: dict[str, Sheets]) -> Sheets:
    """The sheets of a file of some layers: those that any of them draws on, with all of them."""
    by_name: dict[str, Sheet] = {}
    for layer in layers:
        for sheet in parted[layer.plan.name].drawn:
            there = by_name.get(sheet.name)
            before = [] if there is None else list(there.drawing.strands)
            both = replace(sheet.drawing, strands=[*before, *sheet.drawing.strands])
            by_name[sheet.name] = sheet._replace(drawing=both)
    drawn = sorted(by_name.values(), key=lambda sheet: sheet[:2])
    return next(iter(parted.values()))._replace(drawn=drawn)


def pieces_of_sheet(
    path: Path,
    layers: Sequence[Layer],
    parted: dict[str, Sheets],
    sheet: Sheet,
    values: Values,
) -> Iterable[str | bytes]:
    """What a file of a sheet holds, a block after the other.

    path     for its suffix and its title
    layers   of inks; of an .svg they are its layers, behind that of the marks
    sheet    of sheets_of_file()
    """
    kind, version = export.format_of(path), core.library_version()
    page, drawing = sheet.drawing.page, sheet.drawing
    tolerance = values["arc_tolerance"]
    if kind.name != "SVG":
        if tolerance > 0.0:
            drawing = drawing.with_arcs(tolerance)
        return export.pieces_of(kind, drawing, values, path.stem, version, path.suffix)
    shown, colours = [("marks", list(page.marks))], [""]
    for layer in layers:
        found = [each for each in parted[layer.plan.name].drawn if each.name == sheet.name]
        shown += [(layer.plan.name, list(each.drawing.strands)) for each in found]
        colours += [layer.plan.colour] * len(found)
    moves = None
    if tolerance > 0.0:
        strands = [strand for _name, those in shown for strand in those]
        moves = replace(drawing, strands=strands).with_arcs(tolerance).moves
    width = values["line_width"]
    return page_pieces(shown, page.sides, width, path.stem, version, colours, moves)


def _in_metres(drawing: Drawing) -> Drawing:
    factor = UNITS[drawing.unit]
    strands = [as_long_as(strand, np.zeros(3), factor) for strand in drawing.strands]
    return Drawing(strands, "m", True, drawing.spacing * factor, of_scene_unit=factor)


def moved(strand: Strand, margin: float) -> Strand:
    """A strand of the sheet on a page with a margin."""
    return replace(strand, points=strand.points + [margin, margin, 0.0])


def curve_of(drawing: Drawing) -> core.Polylines:
    """A drawing as polylines."""
    counts = [len(strand.points) for strand in drawing.strands]
    return core.Polylines(
        np.concatenate([strand.points for strand in drawing.strands]),
        np.concatenate([strand.normals for strand in drawing.strands]),
        np.concatenate([[0], np.cumsum(counts)]).astype(np.uint32),
        np.array([strand.closed for strand in drawing.strands], dtype=np.uint8),
    )
