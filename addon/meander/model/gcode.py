# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawings as G-code: plotters, mills and printers that follow every strand; no bpy.

Absolute positions, in millimetres or inches as the head of the file says. Between strands the tool
rises straight up to a height above all of them, travels there, and comes straight down.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .drawing import Drawing, number, ring
from .whole_files import FileError

_UNIT_WORDS = {"mm": "G21 ; millimetres", "in": "G20 ; inches"}
_DECIMALS = {"mm": 4, "in": 6}


@dataclass(frozen=True)
class Motion:
    """How the tool moves; lengths in millimetres, speeds in millimetres a minute.

    feed           along strands, and down to them
    travel_feed    between strands
    lift           height above the highest point of all strands at which it travels
    layer_offset   of the first layer from the surface, along the normal
    layers         how often every strand is followed
    layer_height   from each layer to the next, along the normal
    extrusion      filament for each millimetre of the way; 0: none
    """

    feed: float = 1200.0
    travel_feed: float = 3000.0
    lift: float = 5.0
    layer_offset: float = 0.0
    layers: int = 1
    layer_height: float = 0.2
    extrusion: float = 0.0


def gcode_text(drawing: Drawing, motion: Motion, title: str, version: str) -> str:
    """The file's text. Raises FileError for a unit that G-code does not know."""
    if drawing.unit not in _UNIT_WORDS:
        raise FileError("G-code knows millimetres and inches; choose one of these as the unit")
    writer = _Writer(drawing, motion)
    layers = [_offset(drawing, motion, layer) for layer in range(motion.layers)]
    writer.safe = max(float(way[:, 2].max()) for ways in layers for way in ways)
    writer.safe += motion.lift / drawing.millimetres
    writer.line(f"; {_plain(title)}, Meander {version}")
    writer.line(f"; {len(drawing.strands)} strands, length {drawing.length:.6g} {drawing.unit}")
    writer.line(_UNIT_WORDS[drawing.unit])
    writer.line("G90 ; absolute positions")
    if motion.extrusion > 0.0:
        writer.line("M83 ; relative extrusion")
    writer.travel(z=writer.safe)
    for layer, ways in enumerate(layers, start=1):
        for number_of, (way, strand) in enumerate(zip(ways, drawing.strands), start=1):
            kind = "closed" if strand.closed else "open"
            writer.line(f"; layer {layer}, strand {number_of}, {kind}")
            writer.follow(way)
    writer.line("M2 ; end")
    return "\n".join([*writer.lines, ""])


def _offset(drawing: Drawing, motion: Motion, layer: int) -> list[np.ndarray]:
    """Every strand as the tool follows it in a layer."""
    distance = (motion.layer_offset + layer * motion.layer_height) / drawing.millimetres
    ways = []
    for strand in drawing.strands:
        normals = np.vstack([strand.normals, strand.normals[:1]])[: len(ring(strand))]
        ways.append(ring(strand) + distance * normals)
    return ways


def _plain(text: str) -> str:
    """What may stand in a comment."""
    return "".join(letter if " " <= letter <= "~" else "?" for letter in text)


class _Writer:
    """The lines of the file."""

    def __init__(self, drawing: Drawing, motion: Motion) -> None:
        self.lines: list[str] = []
        self.safe = 0.0
        self._decimals = _DECIMALS[drawing.unit]
        self._feed = number(motion.feed / drawing.millimetres, 3)
        self._travel_feed = number(motion.travel_feed / drawing.millimetres, 3)
        self._extrusion = motion.extrusion

    def line(self, text: str) -> None:
        self.lines.append(text)

    def travel(self, **places: float) -> None:
        self.line(f"G0 {self._words(places)} F{self._travel_feed}")

    def follow(self, way: np.ndarray) -> None:
        """Over the first point, down to it, along all others, and up again."""
        first = way[0].tolist()
        self.travel(x=first[0], y=first[1])
        self.line(f"G1 {self._words({'z': first[2]})} F{self._feed}")
        steps = np.linalg.norm(np.diff(way, axis=0), axis=1)
        for (x, y, z), step in zip(way[1:].tolist(), steps.tolist()):
            words = self._words({"x": x, "y": y, "z": z})
            if self._extrusion > 0.0:
                words += f" E{number(self._extrusion * step, 6)}"
            self.line(f"G1 {words}")
        self.travel(z=self.safe)

    def _words(self, places: dict[str, float]) -> str:
        return " ".join(
            f"{axis.upper()}{number(value, self._decimals)}" for axis, value in places.items()
        )
