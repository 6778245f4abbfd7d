# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture as a drawing in one line, ink by ink: what is to be drawn, its run, what it became.

The tone of a place is the share of ink there, which is the width of the pen over the spacing: so
the wanted spacing is the width over the share. The sheet is a grid fine enough for what the pen can
show, with a density at each of its places. No bpy.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ... import core
from ..empty import Empty, empty_of
from ..files.whole import FileError
from ..geometry.simplification import Light, light_points
from ..geometry.thinning import with_points
from ..opening import open_flow
from ..problem import Problem
from ..toolpaths import bridges
from ..toolpaths.drawing import Drawing
from ..toolpaths.toolpath import Strand, strands_of
from .correction import Correction, Tones
from .drawn import ToneError
from .forms import form_angles
from .image import Image, averaged
from .inks import INKS, separated
from .sheet import Grid, cells_kept, grid_of, triangles
from .tone import Tone, Wanted, darkness_on_paper, grey_light, lightness, wanted

# How a line may lie, and what it begins as.
STYLES = ("portrait", "engraving", "scribble")

# More places of a grid would need gigabytes, and no pen shows them; more nodes the library refuses.
_MOST_PLACES, _MOST_NODES = 30_000_000, 500_000_000
# Cells, in widths of the line. By one run, a page of line art is .0246 off with 1 where it grows,
# and .0203 in rows, with .7 .0184 and .0199, and with .5 .0199 in rows.
_CELL = 0.7
# Of the length of a segment, in half spacings: half as much again as the library's own is a third
# fewer nodes, for a thousandth of the range in tone.
SEGMENT = 0.3
# How much directions count, where there are any: with 2 the tone suffers.
ALIGNMENT = 1.0
# How much longer segments are while the line grows. With 3 times, as elsewhere, strokes of one or
# two pens have hardly any line until the last iterations.
_COARSENING = 1.5
# Parts that are cut out are left out where they are smaller, in squares of mean spacings, and
# corridors between parts are so wide, in mean spacings.
_LEAST_PART, _CORRIDOR = 4.0, 2.2
# Points are left out that move the line by less, in least spacings.
_LIGHT = 0.02
_OPAQUE = 0.5
# A darkness of what the pen has at its ends comes out this near to it.
_ROUNDING = 1e-9
# An ink is left out where it is less dark, in times of the lightest that the pen can be.
_WHITE = 1.25


@dataclass(frozen=True)
class Wishes:
    """How a picture is drawn; lengths in millimetres.

    width        of the drawing; its height follows from the picture
    pen          width of its line
    spread       by which ink makes the line wider on paper than the pen
    style        of STYLES: "portrait" begins with long rows, "engraving" has rows along the edges
                 and forms of the picture, "scribble" grows
    tone         how dark it is where
    inks         of inks.INKS; none: one line, black
    leave_white  places that are less dark are left out; None: none of one line, and of several
                 inks those that hardly need it
    bridges      parts that are left apart are joined by corridors, else each has a line
    variation    of core.FlowOptions
    threads      0: one for each processor
    """

    width: float = 200.0
    pen: float = 0.4
    spread: float = 0.0
    style: str = "portrait"
    tone: Tone = field(default_factory=Tone)
    inks: Sequence[str] = ()
    leave_white: float | None = None
    bridges: bool = True
    variation: int = 0
    threads: int = 0

    @property
    def line_width(self) -> float:
        """On paper."""
        return self.pen + self.spread

    @property
    def least_darkness(self) -> float:
        """Of places where there is to be a line."""
        if self.leave_white is not None:
            return self.leave_white
        return _WHITE * self.tone.lightest if self.inks else 0.0


@dataclass(frozen=True)
class Plan:
    """What is to be drawn in one ink.

    name          of the ink
    dark, light   how much of the sheet is darker and lighter than the pen can be
    """

    name: str
    colour: str
    problem: Problem
    dark: float
    light: float

    @property
    def tones(self) -> Tones:
        return self.problem.tones

    @property
    def grid(self) -> Grid:
        return self.tones.grid

    @property
    def share(self) -> NDArray[np.float64]:
        """Of ink at the places of the grid, 0 where there is no line."""
        return self.tones.share

    @property
    def spacing(self) -> float:
        """The mean one, in millimetres."""
        return self.tones.mean_spacing

    @property
    def least_spacing(self) -> float:
        """In millimetres."""
        return self.spacing * self.tones.one / float(self.share.max())


@dataclass(frozen=True)
class Layer:
    """What has been drawn in one ink.

    strands   in millimetres, from the lower left corner of the sheet
    """

    plan: Plan
    strands: list[Strand]
    reason: str
    figures: dict[str, Any]
    error: ToneError
    empty: Empty

    @property
    def length(self) -> float:
        return Drawing(self.strands, "mm", True).length

    @property
    def travel(self) -> float:
        """With the pen up, from the end of each line to the beginning of the next."""
        ends = [each.points[0 if each.closed else -1] for each in self.strands[:-1]]
        begins = [each.points[0] for each in self.strands[1:]]
        return float(np.linalg.norm(np.subtract(begins, ends), axis=-1).sum()) if ends else 0.0

    def entry(self) -> dict[str, Any]:
        """Of a report; lengths in millimetres."""
        plan = self.plan
        return {
            "ink": plan.name,
            "lines": len(self.strands),
            "length": self.length,
            "travel": self.travel,
            "spacing": plan.spacing,
            "tone": self.error.entry(),
            "out_of_reach": {"too_dark": plan.dark, "too_light": plan.light},
            "nodes": int(self.figures["nodes"]),
            "iterations": int(self.figures["iterations"]),
            "stop_reason": self.reason,
            "crossings": int(self.figures["crossings"]),
            "empty": self.empty.entry(),
            "seconds": float(self.figures["seconds_total"]),
        }


def plans_of(image: Image, wishes: Wishes, mask: Image | None = None) -> list[Plan]:
    """What is to be drawn of a picture, ink by ink.

    mask   of any size, laid over the picture: no line where it is dark or transparent

    Raises FileError where nothing is left to draw, and for a sheet of too many places.
    """
    columns, rows = image.sides
    sides = (wishes.width, wishes.width * rows / columns)
    pen = wishes.line_width
    # A pen shows little that is finer than its line, and a picture has nothing finer than half a
    # pixel.
    cell = max(_CELL * pen, 0.5 * sides[0] / columns)
    if sides[0] * sides[1] / cell**2 > _MOST_PLACES:
        raise FileError(_too_fine(pen, sides))
    grid = grid_of(sides, min(cell, min(sides) / 2.0))
    down, across = grid.shares
    opaque = _opaque(image, mask, down, across)
    if not opaque.any():
        clear = not _opaque(image, None, down, across).any()
        lacking = "the picture is transparent" if clear else "the mask leaves nothing"
        raise FileError(f"{lacking}: there is no place for a line; choose another one")
    if wishes.inks:
        lights = separated(image, wishes.inks, down, across)
    else:
        lights = {"black": grey_light(image, wishes.tone.kind, down, across)}
    found = [_plan(name, lights[name], opaque, grid, wishes) for name in lights]
    drawn = [plan for plan in found if plan is not None]
    if not drawn:
        raise FileError("nothing of the picture is dark enough to draw; leave less of it white")
    return drawn


def _opaque(
    image: Image,
    mask: Image | None,
    down: NDArray[np.float64],
    across: NDArray[np.float64],
) -> NDArray[np.bool_]:
    """Where a line may be, of the places of a grid."""
    opaque = np.ones((len(down), len(across)), dtype=bool)
    if image.opacity is not None:
        opaque &= averaged(image.opacity, down, across) > _OPAQUE
    if mask is not None:
        opaque &= lightness(grey_light(mask, "light", down, across)) > 100.0 * _OPAQUE
        if mask.opacity is not None:
            opaque &= averaged(mask.opacity, down, across) > _OPAQUE
    return opaque


def _plan(
    name: str,
    light: NDArray[np.float64],
    opaque: NDArray[np.bool_],
    grid: Grid,
    wishes: Wishes,
) -> Plan | None:
    """None: nothing of it is drawn."""
    tone, pen = wishes.tone, wishes.line_width
    if wishes.inks and tone.levels is None:
        tone = replace(tone, levels=(0.0, 100.0))  # the same for all inks, or colours would turn
    rough = wanted(light, replace(tone, sharpen=0.0), opaque, 1.0)
    spacing = pen / float(rough.share[opaque].mean())
    made = wanted(light, tone, opaque, grid.cell / spacing) if tone.sharpen else rough
    left = opaque & (made.darkness >= wishes.least_darkness)
    whole = bool(left.all())
    cells = np.ones((grid.cells[1], grid.cells[0]), dtype=bool)
    if not whole:
        square = (spacing / grid.cell) ** 2
        wide = _CORRIDOR * spacing / grid.cell
        cells = cells_kept(left, _LEAST_PART * square, wide, wishes.bridges)
    if not cells.any():
        return None
    _check_room(spacing, cells, grid, pen)
    used, faces = triangles(cells)
    # A corridor has room for a line there and back.
    ink = np.where(left, made.share, pen / spacing).ravel()[used]
    share = np.zeros(left.size)
    share[used] = ink
    mean = float(ink.mean())
    tones = Tones(grid, share.reshape(left.shape), used, mean, pen, wishes.tone)
    problem = Problem(
        grid.points()[used],
        faces,
        _options(wishes, pen / mean),
        density=tones.density_of(tones.share),
        directions=_directions(made, grid, wishes, name, pen / mean, used),
        tones=tones,
    )
    if problem.directions is not None:
        problem.options.alignment_weight = ALIGNMENT
    return Plan(
        name, INKS[name].colour, problem, *_out_of_reach(made.darkness.ravel()[used], tone)
    )


def _too_fine(pen: float, sides: tuple[float, float]) -> str:
    return (
        f"a pen of {pen:g} mm has too many lines on {sides[0]:g} x {sides[1]:.4g} mm; choose a "
        "wider pen or a smaller width"
    )


def _check_room(spacing: float, cells: NDArray[np.bool_], grid: Grid, pen: float) -> None:
    """Refuses a sheet that a strand does not fit into, or too many. Raises FileError."""
    width, height = grid.sides
    area = width * height * float(cells.mean())
    if area / (0.5 * SEGMENT * spacing**2) > _MOST_NODES:
        raise FileError(_too_fine(pen, grid.sides))
    if spacing**2 > area or pen > min(width, height):
        raise FileError(
            f"{width:g} x {height:.3g} mm has no room for a strand of a pen of {pen:g} mm; choose "
            "a finer pen, a larger width or another part of the picture"
        )


def _out_of_reach(darkness: NDArray[np.float64], tone: Tone) -> tuple[float, float]:
    """How much of it is darker and lighter than the pen can be."""
    black, white = darkness_on_paper(np.array([tone.darkest, tone.lightest]), tone.paper)
    too_dark = (darkness > black * (1.0 + _ROUNDING)).mean()
    return float(too_dark), float((darkness < white * (1.0 - _ROUNDING)).mean())


def as_drawn(options: core.FlowOptions) -> None:
    """Has a line be made of such segments as pictures are, where nobody asked for others."""
    options.segment_length = options.segment_length or SEGMENT * options.radius
    longer = min(options.tunings["growth_coarsening"], _COARSENING)
    options.tunings = options.tunings | {"growth_coarsening": longer}


def _options(wishes: Wishes, spacing: float) -> core.FlowOptions:
    options = core.default_options("even")
    options.radius = spacing / 2.0
    as_drawn(options)
    options.threads = wishes.threads
    options.variation = wishes.variation
    if wishes.style != "scribble":
        options.start = core.Start.FULL
    return options


def _directions(
    made: Wanted,
    grid: Grid,
    wishes: Wishes,
    name: str,
    spacing: float,
    used: NDArray[np.int64],
) -> NDArray[np.float64] | None:
    """A vector for each place that is used; None: the line has no direction."""
    if wishes.style == "engraving":
        angle = form_angles(made.share, spacing / grid.cell).ravel()[used]
    elif wishes.style == "portrait" and len(wishes.inks) > 1:
        angle = np.full(len(used), np.radians(INKS[name].angle))
    else:
        return None
    return np.column_stack([np.cos(angle), np.sin(angle), np.zeros(len(angle))])


def _layer_of(
    plan: Plan, flow: core.Flow, reason: str, wishes: Wishes, correction: Correction
) -> Layer:
    """What a run that has ended has drawn. Raises core.MeanderError."""
    curve = flow.polylines()
    least = wishes.line_width / wishes.tone.darkest
    if wishes.bridges:
        line = bridges.joined(curve, least)
        curve = curve if line is None else line.polylines
    curve = with_points(curve, light_points(curve, Light(_LIGHT), least))
    strands = strands_of(curve)
    error = correction.measure(strands)
    return Layer(plan, strands, reason, flow.statistics(), error, empty_of(flow.gaps()))


def draw(
    image: Image,
    wishes: Wishes,
    mask: Image | None = None,
    run: Callable[[core.Flow], str] = core.Flow.run,
    accept: Callable[[core.Cost], None] | None = None,
) -> list[Layer]:
    """Draws a picture.

    mask     of any size, laid over the picture: no line where it is dark or transparent
    run      runs a flow to its end and returns why it ended; again with another density, while the
             line is far from its tone
    accept   is told what a run is expected to cost, and raises what it likes

    Raises FileError as plans_of() does, and core.MeanderError.
    """
    layers = []
    for plan in plans_of(image, wishes, mask):
        with open_flow(plan.problem, accept=accept).flow as flow:
            layers.append(_drawn(plan, flow, run, wishes))
    return layers


def _drawn(plan: Plan, flow: core.Flow, run: Callable[[core.Flow], str], wishes: Wishes) -> Layer:
    """Runs a flow, and again for what its line lacks of the tone; the line that is nearest."""
    correction = Correction(plan.tones)
    layer = _layer_of(plan, flow, run(flow), wishes, correction)
    while layer.reason == "converged" and (density := correction.following()) is not None:
        flow.set_density(density)
        other = _layer_of(plan, flow, run(flow), wishes, correction)
        layer = other if correction.nearest else layer
    return layer
