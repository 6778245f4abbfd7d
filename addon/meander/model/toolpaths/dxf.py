# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawings as DXF files, release 12 in ASCII, which every program reads; no bpy.

A POLYLINE for every strand: a flat one of a flat drawing, else one in space. The values are those
of AutoCAD's DXF reference for release 12, and $INSUNITS, which later releases added and earlier
readers pass over.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..files.rows import rows
from ..geometry.arcs import Moves
from .drawing import Drawing, number
from .toolpath import Strand

LAYER = "MEANDER"
_MARKS = f"{LAYER}_MARKS"
_UNIT_CODES = {"mm": 4, "cm": 5, "in": 1}
_DECIMALS = {"mm": 6, "cm": 7, "in": 8}
_AXES = (10, 20, 30)
_CLOSED, _IN_SPACE, _VERTEX_IN_SPACE = 1, 8, 32


def dxf_pieces(drawing: Drawing) -> Iterator[str]:
    """The file's text, in pieces: pairs of lines, a group code and its value."""
    low, high = drawing.box()
    marks: Sequence[Strand] = ()
    if drawing.page is not None:
        low, high, marks = np.zeros(3), np.array([*drawing.page.sides, 0.0]), drawing.page.marks
    decimals = _DECIMALS[drawing.unit]
    layers = [_MARKS] * bool(marks) + list(dict.fromkeys(map(_layer_of, drawing.strands)))
    yield _lines(
        (0, "SECTION"),
        (2, "HEADER"),
        (9, "$ACADVER"),
        (1, "AC1009"),
        (9, "$INSUNITS"),
        (70, _UNIT_CODES[drawing.unit]),
        (9, "$EXTMIN"),
        *_place(low, decimals),
        (9, "$EXTMAX"),
        *_place(high, decimals),
        (0, "ENDSEC"),
        (0, "SECTION"),
        (2, "TABLES"),
        (0, "TABLE"),
        (2, "LAYER"),
        (70, len(layers)),
        *(
            pair
            for name in layers
            for pair in ((0, "LAYER"), (2, name), (70, 0), (62, 7), (6, "CONTINUOUS"))
        ),
        (0, "ENDTAB"),
        (0, "ENDSEC"),
        (0, "SECTION"),
        (2, "ENTITIES"),
    )
    for mark in marks:
        yield from _polyline(mark, None, _MARKS, drawing)
    for place, strand in enumerate(drawing.strands):
        moves = None if drawing.moves is None else drawing.moves[place]
        yield from _polyline(strand, moves, _layer_of(strand), drawing)
    yield _lines((0, "ENDSEC"), (0, "EOF"))


def _polyline(
    strand: Strand, moves: Moves | None, layer: str, drawing: Drawing
) -> Iterator[str]:
    """The entity of a strand, through its points or along moves."""
    decimals = _DECIMALS[drawing.unit]
    kind = 0 if drawing.flat else _IN_SPACE
    begin = [(0, "POLYLINE"), (8, layer), (66, 1), *_place((0.0, 0.0, 0.0), decimals)]
    yield _lines(*begin, (70, kind | (_CLOSED if strand.closed else 0)))
    if moves is None:
        pairs = [(0, "VERTEX"), (8, layer)]
        pairs += [(code, f"%.{decimals}r") for code in _AXES]
        if not drawing.flat:
            pairs.append((70, _VERTEX_IN_SPACE))
        yield from rows(_lines(*pairs), strand.points)
    else:
        for point, bulge in _bulged(moves, strand.closed):
            pairs = [(0, "VERTEX"), (8, layer), *_place(point, decimals)]
            yield _lines(*pairs, *([(42, number(bulge, 9))] if bulge else []))
    yield _lines((0, "SEQEND"), (8, layer))


def _lines(*pairs: tuple[int, str | int]) -> str:
    return "".join(f"{code:3d}\n{value}\n" for code, value in pairs)


def _layer_of(strand: Strand) -> str:
    """Of each part of a curve that was cut its own."""
    return f"{LAYER}_{strand.part}" if strand.part else LAYER


def _bulged(moves: Moves, closed: bool) -> list[tuple[list[float], float]]:
    """The vertices of a way in a plane, and the bulge of the arc that leaves each."""
    points = np.vstack([moves.start, moves.ends])
    bulges = np.append(moves.bulges, 0.0)
    if closed:  # the last one ends at the first vertex
        points, bulges = points[:-1], bulges[:-1]
    return [([x, y, 0.0], bulge) for (x, y), bulge in zip(points.tolist(), bulges.tolist())]


def _place(point, decimals: int) -> list[tuple[int, str | int]]:
    return [(code, number(value, decimals)) for code, value in zip(_AXES, point)]
