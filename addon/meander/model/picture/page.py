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
from ..toolpaths import embroidery
from ..toolpaths.drawing import Drawing
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
    values    of options.export.ROWS, by setting

    Raises FileError for what is no drawing.
    """
    kind, title, version = export.format_of(path), path.stem, core.library_version()
    drawing = drawing_of(layers, margin)
    if kind.name in ("DST", "PES"):
        stitches = (values[f"stitch_{name}"] for name in ("length", "tolerance", "least"))
        drawing = embroidery.stitched(drawing, *stitches)
    elif values["arc_tolerance"] > 0.0:
        drawing = drawing.with_arcs(values["arc_tolerance"])
    if kind.name != "SVG":
        return export.pieces_of(kind, drawing, values, title, version, path.suffix)
    shown = [
        (layer.plan.name, [moved(strand, margin) for strand in layer.strands]) for layer in layers
    ]
    colours = [layer.plan.colour for layer in layers]
    width = values["line_width"]
    return page_pieces(shown, sides, width, title, version, colours, drawing.moves)


def drawing_of(layers: Sequence[Layer], margin: float) -> Drawing:
    """The strands of all layers on a page, in millimetres from its lower left corner."""
    spacing = min(layer.plan.least_spacing for layer in layers)
    strands = [moved(strand, margin) for layer in layers for strand in layer.strands]
    return Drawing(strands, "mm", True, spacing)


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
