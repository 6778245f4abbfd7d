# SPDX-License-Identifier: GPL-3.0-or-later
"""Strands as chains of lights: where each LED of a strip lies, for the programs that play them; no
bpy.

Lights are numbered along the line, strand after strand, as a strip is laid that begins at its first
point. WLED and xLights know cells of a grid, Pixelblaze knows coordinates.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from ..files.whole import FileError
from .drawing import Drawing, number, ring
from .svg import xml_text
from .toolpath import Strand, strand_of

# 60 lights a metre are the most common strip, in millimetres from one to the next.
PITCH = 1000.0 / 60.0
# No chain has more: it is a mistake in the unit.
_MOST_LIGHTS = 1_000_000
# WLED counts cells in sixteen bits; a grid of xLights is a text with a comma for each.
_MOST_OF_WLED = 65_535
_MOST_OF_XLIGHTS = 4_000_000
# By how much cells become smaller until no two lights share one.
_FINER = 0.9


def placed(drawing: Drawing, pitch: float) -> Drawing:
    """Lights at equal distances along every strand, the first at its beginning.

    pitch   from one light to the next along the strip, in millimetres

    The last of an open strand is nearer to its end than the pitch, that of a closed one half a
    pitch to one and a half before the first. Raises FileError for more lights than any chain has.
    """
    step = pitch / drawing.millimetres
    count = sum(strand.length / step for strand in drawing.strands)
    if count > _MOST_LIGHTS:
        raise FileError(
            f"The line is {count:,.0f} lights long; choose a larger pitch, or another scale or unit"
        )
    strands = [_lit(strand, step) for strand in drawing.strands]
    return replace(drawing, strands=strands, lights=True)


def _lit(strand: Strand, step: float) -> Strand:
    knots = np.append(strand.arc_lengths, strand.length) if strand.closed else strand.arc_lengths
    room = strand.length / step - (0.5 if strand.closed else 0.0)
    last = max(int(np.floor(room + 1e-9)), 0)
    arcs = step * np.arange(last + 1)
    points, normals = ring(strand), strand.normals
    if strand.closed:
        normals = np.vstack([normals, normals[:1]])

    def at(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.column_stack([np.interp(arcs, knots, values[:, axis]) for axis in range(3)])

    lit = strand_of(at(points), at(normals), False)
    return replace(lit, arc_lengths=arcs, length=strand.length, part=strand.part)


def _places(drawing: Drawing) -> NDArray[np.float64]:
    return np.vstack([strand.points for strand in drawing.strands])


def _cells(
    places: NDArray[np.float64], step: float, most: int
) -> tuple[NDArray[np.int64], tuple[int, ...]]:
    """A cell of a grid for each place, no two the same, and how many cells there are along each
    axis. Cells are as large as that allows, to a tenth.

    step   how far lights are from each other where nothing else is near
    most   cells that the grid may have

    Raises FileError where these are too few.
    """
    low, sides, size = places.min(axis=0), np.ptp(places, axis=0), step
    while True:
        counts = np.floor(sides / size + 0.5) + 1.0
        if np.prod(counts) > most:
            raise FileError(
                f"Lights lie too near each other in this layout for a grid of {most:,} cells; "
                "choose a layout that shows the surface once, a larger pitch, or a format that has "
                "coordinates"
            )
        cells = np.floor((places - low) / size + 0.5).astype(np.int64)
        if len(np.unique(cells, axis=0)) == len(cells):
            return cells, tuple(counts.astype(np.int64).tolist())
        size *= _FINER


def wled_text(drawing: Drawing, pitch: float, title: str) -> str:
    """A map of WLED, two-dimensional: for each cell, from the upper left one on, row by row, the
    number of its light, or -1. For its file ledmap1.json or another number. In 0.15 and later
    width and height make the panel.
    """
    cells, (width, height) = _cells(
        _places(drawing)[:, :2], pitch / drawing.millimetres, _MOST_OF_WLED
    )
    grid = np.full((height, width), -1, dtype=np.int64)
    grid[height - 1 - cells[:, 1], cells[:, 0]] = np.arange(len(cells))
    record = {"n": title[:32], "width": width, "height": height, "map": grid.ravel().tolist()}
    return json.dumps(record, separators=(",", ":")) + "\n"


def pixelblaze_text(drawing: Drawing) -> str:
    """A map of Pixelblaze: the coordinates of every light in millimetres, two of a flat drawing and
    three of one in space, to a hundredth. It scales them to its own range."""
    places = _places(drawing)[:, : 2 if drawing.flat else 3] * drawing.millimetres
    rows = (",".join(number(value, 2) for value in row) for row in places.tolist())
    return "[" + ",\n".join(f"[{row}]" for row in rows) + "]\n"


def xlights_text(drawing: Drawing, pitch: float, title: str) -> str:
    """A custom model of xLights. Lights count from 1, rows from the top; in space, columns go to
    the right and layers from the front to the back, as seen along Y.
    """
    places, step = _places(drawing), pitch / drawing.millimetres
    if drawing.flat:
        cells, (width, height) = _cells(places[:, :2], step, _MOST_OF_XLIGHTS)
        depth = 1
        columns, rows, layers = cells[:, 0], height - 1 - cells[:, 1], np.zeros_like(cells[:, 0])
    else:
        cells, (width, depth, height) = _cells(places, step, _MOST_OF_XLIGHTS)
        columns, rows, layers = cells[:, 0], height - 1 - cells[:, 2], cells[:, 1]
    attributes = {
        "name": xml_text(title),
        "parm1": str(width),
        "parm2": str(height),
        "parm3": "1",
        "Depth": str(depth),
        "DisplayAs": "Custom",
        "StringType": "RGB Nodes",
        "Transparency": "0",
        "PixelSize": "2",
        "ModelBrightness": "",
        "Antialias": "1",
        "StrandNames": "",
        "NodeNames": "",
        "CustomModel": _custom(columns, rows, layers, (width, height, depth)),
        "CustomModelCompressed": _compressed(columns, rows, layers, depth),
        "SourceVersion": "2024.01",
    }
    written = "\n  ".join(f"{name}={quoteattr(text)}" for name, text in attributes.items())
    return f'<?xml version="1.0" encoding="UTF-8"?>\n<custommodel\n  {written}>\n</custommodel>\n'


def _custom(
    columns: NDArray[np.int64],
    rows: NDArray[np.int64],
    layers: NDArray[np.int64],
    sides: Sequence[int],
) -> str:
    """All cells: columns between commas, rows between semicolons, layers between bars."""
    width, height, depth = sides
    grid = [""] * (width * height * depth)
    for light, cell in enumerate(((layers * height + rows) * width + columns).tolist(), start=1):
        grid[cell] = str(light)
    lines = [",".join(grid[k : k + width]) for k in range(0, len(grid), width)]
    return "|".join(";".join(lines[k : k + height]) for k in range(0, len(lines), height))


def _compressed(
    columns: NDArray[np.int64], rows: NDArray[np.int64], layers: NDArray[np.int64], depth: int
) -> str:
    """The cells that have a light: its number, row, column and, if there are several, layer."""
    table = np.column_stack([np.arange(1, len(rows) + 1), rows, columns, layers])
    return ";".join(",".join(map(str, row)) for row in table[:, : 4 if depth > 1 else 3].tolist())
