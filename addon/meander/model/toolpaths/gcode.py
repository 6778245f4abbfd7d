# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawings as G-code: plotters, lasers, mills and printers that follow every strand; no bpy.

In millimetres or inches as the head of the file says. What draws is switched on where a strand
begins and off where it ends: a pen or a spindle comes down from a height above all strands and goes
up again, a laser has its power, a servo its angle. The head, the foot and the words of a switch are
those of the controller.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..files.rows import rows
from ..files.whole import FileError
from ..geometry.arcs import Moves
from .brush import Brush
from .drawing import Drawing, number, ring
from .toolpath import Strand

# What a comment may hold. Some controllers look for commands in whatever comes along the wire: Grbl
# holds at ! and goes on at ~, in comments too, and takes bytes beyond ASCII for commands.
_UNFIT = re.compile(r"[^A-Za-z0-9 _.,:;+=/#'-]")
_COMMANDS = re.compile(r"[!?~]|[^\t -~]")
_COMMENT = re.compile(r"\(([^()]*)\)|;(.*)")

_UNIT_WORDS = {"mm": "G21 ; millimetres", "in": "G20 ; inches"}
_UNIT = re.compile(r"(?<![A-Z])G0*(2[01])(?![\d.])", re.IGNORECASE)
_DECIMALS = {"mm": 4, "in": 6}

# Name, label and what it is, of tools and of controllers.
TOOLS = (
    ("pen", "Pen", "Moves down to the curve and up again"),
    ("spindle", "Spindle", "The same while it turns: M3 before the first strand, M5 at the end"),
    ("laser", "Laser", "Stays at its height and is switched on along the curve, off between"),
    ("servo", "Servo", "Stays at its height and turns a servo, which lowers and lifts a pen"),
)
MACHINES = (
    ("generic", "Generic", "What most controllers have in common"),
    ("grbl", "Grbl", "Laser by M4, whose power follows the speed; a servo where the spindle is"),
    ("marlin", "Marlin", "Power from 0 to 255, servo by M280"),
    ("klipper", "Klipper", "Pins and servos by name: LASER and PEN in its configuration"),
)


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
    tool           one of TOOLS
    machine        one of MACHINES
    power          of a laser or a spindle, in per cent of its greatest
    servo_down, servo_up   angles of a servo, in degrees
    relative       moves are given by how far they go
    dip_every      way after which a brush is dipped again, and at first; 0: it is no brush
    dip_x, dip_y   where the palette is
    dip_height     how low the brush goes there
    """

    feed: float = 1200.0
    travel_feed: float = 3000.0
    lift: float = 5.0
    layer_offset: float = 0.0
    layers: int = 1
    layer_height: float = 0.2
    extrusion: float = 0.0
    tool: str = "pen"
    machine: str = "generic"
    power: float = 100.0
    servo_down: float = 0.0
    servo_up: float = 60.0
    relative: bool = False
    dip_every: float = 0.0
    dip_x: float = 0.0
    dip_y: float = 0.0
    dip_height: float = 0.0


@dataclass(frozen=True)
class _Controller:
    """The words of a controller. `{s}`: the value of the tool.

    head, foot    lines behind the unit, and at the end
    full          the value of the greatest power
    laser, off    laser on and off
    spindle       on
    servo         to an angle
    wait          for the servo, half a second
    """

    head: tuple[str, ...] = ()
    foot: tuple[str, ...] = ("M2 ; end",)
    full: float = 1000.0
    laser: str = "M3 S{s}"
    off: str = "M5"
    spindle: str = "M3 S{s} ; spindle on"
    spindle_off: str = "M5"
    servo: str = "M280 P0 S{s}"
    wait: str = "G4 P0.5"


_CONTROLLERS = {
    "generic": _Controller(),
    "grbl": _Controller(head=("G17", "G94"), laser="M4 S{s}", servo="M3 S{s}"),
    "marlin": _Controller(foot=("M400 ; end",), full=255.0, wait="G4 P500"),
    "klipper": _Controller(
        foot=("M400 ; end",),
        full=1.0,
        laser="SET_PIN PIN=LASER VALUE={s}",
        off="SET_PIN PIN=LASER VALUE=0",
        spindle="SET_PIN PIN=SPINDLE VALUE={s}",
        spindle_off="SET_PIN PIN=SPINDLE VALUE=0",
        servo="SET_SERVO SERVO=PEN ANGLE={s}",
        wait="G4 P500",
    ),
}


def gcode_pieces(
    drawing: Drawing,
    motion: Motion,
    title: str,
    version: str,
    head: Sequence[str] | None = None,
    foot: Sequence[str] | None = None,
) -> Iterator[str]:
    """The file's text, in pieces. Raises FileError for a unit that G-code does not know.

    head, foot   lines in place of those of the controller, behind the unit and at the end
    """
    if drawing.unit not in _UNIT_WORDS:
        raise FileError("G-code knows millimetres and inches; choose one of these as the unit")
    if motion.dip_every > 0.0 and motion.tool == "laser":
        raise FileError("A laser cannot be dipped; choose a pen or a servo, or set the dips to 0")
    writer = _Writer(drawing, motion)
    words = writer.words
    brush = Brush(motion.dip_every / drawing.millimetres) if motion.dip_every > 0.0 else None
    layers = [_offset(drawing.strands, drawing, motion, layer) for layer in range(motion.layers)]
    writer.safe = max(float(way[:, 2].max()) for ways in layers for way in ways)
    if brush is not None:
        writer.safe = max(writer.safe, motion.dip_height / drawing.millimetres)
    writer.safe += motion.lift / drawing.millimetres
    writer.line(f"; {_plain(title)}, Meander {version}")
    strands = "1 strand" if len(drawing.strands) == 1 else f"{len(drawing.strands)} strands"
    over = f", {motion.layers} times over" if motion.layers > 1 else ""
    writer.line(f"; {strands}, length {drawing.length:.6g} {drawing.unit}{over}")
    writer.line(_UNIT_WORDS[drawing.unit])
    for line in words.head if head is None else head:
        _refuse_unit(line, drawing.unit)
        writer.line(line)
    writer.line("G90 ; absolute positions")
    if motion.extrusion > 0.0:
        writer.line("M83 ; relative extrusion")
    writer.begin()
    marks = () if drawing.page is None else _offset(drawing.page.marks, drawing, motion, 0)
    for place, way in enumerate(marks, start=1):
        writer.line(f"; mark {place}")
        yield from writer.follow(way, None)
    for layer, ways in enumerate(layers, start=1):
        for place, (way, strand) in enumerate(zip(ways, drawing.strands)):
            if strand.part and (place or layer > 1):
                writer.line(f"M0 ; part {strand.part}")
            kind = "closed" if strand.closed else "open"
            writer.line(f"; layer {layer}, strand {place + 1}, {kind}")
            moves = None if drawing.moves is None else drawing.moves[place]
            if brush is None:
                yield from writer.follow(way, moves)
                continue
            for stretch, its_moves, dipped in brush.stretches(way, moves):
                if dipped:
                    writer.dip()
                yield from writer.follow(stretch, its_moves)
    writer.end()
    for line in words.foot if foot is None else foot:
        writer.line(line)
    yield writer.taken()


def _offset(
    strands: Sequence[Strand], drawing: Drawing, motion: Motion, layer: int
) -> list[np.ndarray]:
    """Strands of a drawing as the tool follows them in a layer."""
    distance = (motion.layer_offset + layer * motion.layer_height) / drawing.millimetres
    ways = []
    for strand in strands:
        normals = np.vstack([strand.normals, strand.normals[:1]])[: len(ring(strand))]
        ways.append(ring(strand) + distance * normals)
    return ways


def _plain(text: str) -> str:
    """What may stand in a comment."""
    return _UNFIT.sub("_", text)


def own_line(line: str, place: str) -> str:
    """A line of somebody's own head or foot: its comments go behind it, as those here are.

    place   for the error

    Raises FileError for what a controller takes for a command wherever it stands.
    """
    comments = [_plain(a or b).strip() for a, b in _COMMENT.findall(line)]
    words = _COMMENT.sub("", line).rstrip()
    found = _COMMANDS.search(words)
    if found is not None:
        raise FileError(
            f"{place}: {found[0]!r} is a command of its own to some machines; leave it out, or put "
            "it into a comment"
        )
    said = " ".join(comment for comment in comments if comment)
    return f"{words} ; {said}".strip() if said else words


def _refuse_unit(line: str, unit: str) -> None:
    """Raises FileError for a line of a head that has all behind it read in another unit."""
    for code in _UNIT.findall(_COMMENT.sub("", line)):
        if f"G{code}" != _UNIT_WORDS[unit][:3]:
            raise FileError(
                f"the header says G{code}, but the drawing is in {_UNIT_WORDS[unit][6:]}; leave "
                "it out, or choose the other unit"
            )


class _Writer:
    """The lines of the file, as text that waits until it is taken."""

    def __init__(self, drawing: Drawing, motion: Motion) -> None:
        self._waiting: list[str] = []
        self.safe = 0.0
        self.words = _CONTROLLERS[motion.machine]
        self._motion, self._flat = motion, drawing.flat
        self._decimals, self._millimetres = _DECIMALS[drawing.unit], drawing.millimetres
        self._feed = number(motion.feed / drawing.millimetres, 3)
        self._travel_feed = number(motion.travel_feed / drawing.millimetres, 3)
        self._lifts = motion.tool in ("pen", "spindle")
        # In hundred-thousandths or so of the unit, so that no error adds up in relative moves.
        self._steps = 10**self._decimals
        self._at: dict[str, int] = {}
        self._relative_now = False

    def line(self, text: str) -> None:
        self._waiting.append(text + "\n")

    def taken(self) -> str:
        """What waits, which is then forgotten here."""
        text = "".join(self._waiting)
        self._waiting.clear()
        return text

    def begin(self) -> None:
        """Everything off and up, and a first place that relative moves go on from."""
        motion = self._motion
        if motion.tool == "spindle":
            self.line(self.words.spindle.format(s=self._power()))
        if self._lifts:
            self._travel(z=self.safe)
        else:
            self._switch(False)

    def end(self) -> None:
        """Everything off, and the machine as it was before."""
        if self._relative_now:
            self.line("G90 ; absolute positions")
        if self._motion.extrusion > 0.0:
            self.line("M82 ; absolute extrusion")
        if self._motion.tool == "laser":
            self.line(self.words.off)
        elif self._motion.tool == "spindle":
            self.line(self.words.spindle_off)

    def dip(self) -> None:
        """To the palette, down into the paint and up again."""
        motion, size = self._motion, self._millimetres
        x, y, z = motion.dip_x / size, motion.dip_y / size, motion.dip_height / size
        self.line("; paint")
        if self._lifts:
            self._travel(x=x, y=y)
            self._move("G1", {"z": z}, f" F{self._feed}")
            self._travel(z=self.safe)
        else:
            self._travel(**({"x": x, "y": y} if self._flat else {"x": x, "y": y, "z": z}))
            self._switch(True)
            self._switch(False)

    def follow(self, way: np.ndarray, moves: Moves | None) -> Iterator[str]:
        """Over the first point, down to it, along all others, and up again; with arcs where there
        are moves."""
        x, y, z = way[0].tolist()
        if self._lifts:
            self._travel(x=x, y=y)
            self._go_relative()
            self._move("G1", {"z": z}, f" F{self._feed}")
        else:
            self._travel(**({"x": x, "y": y} if self._flat else {"x": x, "y": y, "z": z}))
            self._go_relative()
            self._switch(True)
        if moves is None:
            yield self.taken()
            yield from self._along(way)
        else:
            self._along_arcs(moves)
        if self._lifts:
            self._travel(z=self.safe)
        else:
            self._switch(False)

    def _along(self, way: np.ndarray) -> Iterator[str]:
        axes = "xy" if self._flat and not self._lifts else "xyz"
        here = np.rint(way[:, : len(axes)] * self._steps)
        gone = np.diff(here, axis=0) if self._relative_now else here[1:]
        columns = [gone / self._steps]
        words = " ".join(f"{axis.upper()}%.{self._decimals}r" for axis in axes)
        if self._motion.extrusion > 0.0:
            steps = np.linalg.norm(np.diff(way, axis=0), axis=1)
            columns.append(self._motion.extrusion * steps)
        more = " E%.6r" if self._motion.extrusion > 0.0 else ""
        first = "" if self._lifts else f" F{self._feed}"
        yield from rows(f"G1 {words}{first}{more}\n", *(values[:1] for values in columns))
        yield from rows(f"G1 {words}{more}\n", *(values[1:] for values in columns))
        self._at.update(zip(axes, here[-1].astype(np.int64).tolist()))

    def _along_arcs(self, moves: Moves) -> None:
        """At one height: lines, and arcs by their centres as seen from where they begin."""
        more, here = "" if self._lifts else f" F{self._feed}", moves.start
        for end, centre, turn in zip(moves.ends, moves.centres, moves.turns.tolist()):
            length = float(np.linalg.norm(end - here))
            code = "G1"
            if turn != 0.0:
                length = abs(turn) * float(np.linalg.norm(end - centre))
                code = "G3" if turn > 0.0 else "G2"
                i, j = (number(value, self._decimals) for value in (centre - here).tolist())
                more = f" I{i} J{j}{more}"
            if self._motion.extrusion > 0.0:
                more += f" E{number(self._motion.extrusion * length, 6)}"
            self._move(code, {"x": float(end[0]), "y": float(end[1])}, more)
            more, here = "", end

    def _go_relative(self) -> None:
        """Where moves are to be relative, from the first known place on."""
        if self._motion.relative and not self._relative_now:
            self.line("G91 ; relative moves")
            self._relative_now = True

    def _power(self) -> str:
        return number(self.words.full * self._motion.power / 100.0, 3)

    def _switch(self, on: bool) -> None:
        """A laser or a servo."""
        motion, words = self._motion, self.words
        if motion.tool == "laser":
            self.line(words.laser.format(s=self._power()) if on else words.off)
            return
        angle = motion.servo_down if on else motion.servo_up
        self.line(words.servo.format(s=number(angle, 3)))
        self.line(words.wait)

    def _travel(self, **places: float) -> None:
        self._move("G0", places, f" F{self._travel_feed}")

    def _move(self, code: str, places: dict[str, float], more: str) -> None:
        words = []
        for axis, value in places.items():
            here = round(value * self._steps)
            gone = here - self._at.get(axis, 0) if self._relative_now else here
            self._at[axis] = here
            words.append(f"{axis.upper()}{number(gone / self._steps, self._decimals)}")
        self.line(f"{code} {' '.join(words)}{more}")
