# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat drawings as SVG 1.1 files, in real units: a path for every strand; no bpy."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from ..files.rows import rows
from ..geometry.arcs import Moves
from .drawing import Drawing, number
from .toolpath import Strand

# A thousandth of a millimetre is finer than any plotter.
_DECIMALS = {"mm": 3, "cm": 4, "in": 5}
# What XML 1.0 cannot hold, even as a number: control characters, and bytes that are no letters.
_NO_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_UNKNOWN = "\ufffd"
_INKSCAPE = ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'


def xml_text(text: str) -> str:
    """A text as XML can hold it, before its signs are escaped."""
    return _NO_XML.sub(_UNKNOWN, text)


def _path_of(moves: Moves, shift: np.ndarray, decimals: int) -> str:
    """Lines and arcs as the commands of a path; the y axis points down, which turns arcs around."""
    words = []
    for (x, y), radius, turn in zip(moves.ends.tolist(), moves.radii, moves.turns.tolist()):
        place = f"{number(x + shift[0], decimals)} {number(shift[1] - y, decimals)}"
        if turn == 0.0:
            words.append(f"L{place}")
        else:
            r = number(radius, decimals)
            words.append(f"A{r} {r} 0 0 {int(turn < 0.0)} {place}")
    return "".join(words)


def _path(
    place: int,
    strand: Strand,
    moves: Moves | None,
    shift: np.ndarray,
    decimals: int,
    what: str = "strand",
) -> Iterator[str]:
    """The element of a strand, through its points or along moves."""
    x = strand.points[:, 0] + shift[0]
    y = shift[1] - strand.points[:, 1]
    point = f"%.{decimals}r %.{decimals}r"
    yield f'<path id="{what}{place}" d="'
    yield from rows(f"M{point}", x[:1], y[:1])
    if moves is not None:
        yield _path_of(moves, shift, decimals)
    else:
        yield from rows(f"L{point}", x[1:2], y[1:2])
        yield from rows(f" {point}", x[2:], y[2:])
    yield f'{"Z" if strand.closed else ""}"/>\n'


def _layer(name: str, colour: str = "") -> str:
    """The beginning of a layer, as Inkscape and what reads its files have them."""
    label = quoteattr(xml_text(name))
    stroke = f' stroke="{colour}"' if colour else ""
    return f'<g inkscape:groupmode="layer" inkscape:label={label}{stroke}>\n'


def _head(
    sides: Sequence[str], unit: str, inkscape: str, width: float, title: str, version: str
) -> str:
    """What comes before the paths; sides and width are in the unit."""
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg"{inkscape} version="1.1" '
        f'width="{sides[0]}{unit}" '
        f'height="{sides[1]}{unit}" viewBox="0 0 {sides[0]} {sides[1]}">',
        f"<title>{escape(xml_text(title))}</title>",
        f"<desc>Meander {escape(version)}; unit {unit}</desc>",
        f'<g fill="none" stroke="#000000" stroke-width="{number(width, _DECIMALS[unit])}" '
        'stroke-linecap="round" stroke-linejoin="round">',
        "",
    ]
    return "\n".join(lines)


def page_pieces(
    layers: Sequence[tuple[str, Sequence[Strand]]],
    sides: Sequence[float],
    line_width: float,
    title: str,
    version: str,
    colours: Sequence[str] = (),
    moves: Sequence[Moves] | None = None,
) -> Iterator[str]:
    """The text of a file that is a whole page, with a layer for each name, in pieces.

    layers       names, and strands in millimetres from the lower left corner, y upwards
    sides        width and height of the page, in millimetres
    line_width   in millimetres
    colours      of the layers, #rrggbb; none: black
    moves        lines and arcs in place of the points of each strand of all layers; None: none

    Numbers of paths go on from layer to layer.
    """
    decimals, shift, place = _DECIMALS["mm"], np.array([0.0, sides[1]]), 0
    written = [number(side, decimals) for side in sides]
    yield _head(written, "mm", _INKSCAPE, line_width, title, version)
    for (name, strands), colour in zip(layers, colours or [""] * len(layers), strict=True):
        yield _layer(name, colour)
        for strand in strands:
            way = None if moves is None else moves[place]
            place += 1
            yield from _path(place, strand, way, shift, decimals)
        yield "</g>\n"
    yield "</g>\n</svg>\n"


def svg_pieces(
    drawing: Drawing, line_width: float, title: str, version: str
) -> Iterator[str]:
    """The file's text, in pieces.

    drawing      flat; the marks of its page are a layer of their own
    line_width   in millimetres, and the margin on all sides of what has no page
    title        what the picture is of

    One unit of the file's coordinates is one unit of the drawing, and its size on paper says so
    (width="120mm"). The y axis points down, as SVG has it.
    """
    decimals = _DECIMALS[drawing.unit]
    width = line_width / drawing.millimetres
    if drawing.page is None:
        low, high = drawing.box()
        shift = np.array([width - low[0], high[1] + width])
        page = (high - low)[:2] + 2.0 * width
        marks: Sequence[Strand] = ()
    else:
        page, marks = drawing.page
        shift = np.array([0.0, page[1]])
    sides = [number(side, decimals) for side in page]
    inkscape = ""
    if marks or any(strand.part for strand in drawing.strands):
        inkscape = _INKSCAPE
    yield _head(sides, drawing.unit, inkscape, width, title, version)
    if marks:
        yield _layer("marks")
        for place, mark in enumerate(marks, start=1):
            yield from _path(place, mark, None, shift, decimals, "mark")
        yield "</g>\n"
    for place, strand in enumerate(drawing.strands, start=1):
        if strand.part:  # a layer, as Inkscape and what reads its files have them
            yield _layer(f"part {strand.part}")
        moves = None if drawing.moves is None else drawing.moves[place - 1]
        yield from _path(place, strand, moves, shift, decimals)
        if strand.part:
            yield "</g>\n"
    yield "</g>\n</svg>\n"
