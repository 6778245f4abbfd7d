# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures in one line, from files or arrays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .core import Flow, MeanderError, unknown_name
from .files import drawing_values
from .model import density, export
from .model.files.rows import write_pieces
from .model.files.whole import FileError, path_of, whole_file
from .model.picture import line
from .model.picture.drawn import preview
from .model.picture.image import Image, image_of, read_image
from .model.picture.inks import INKS
from .model.picture.page import of_ink, pieces_of_page
from .model.picture.strip import fault_of
from .model.picture.tone import RANGES, TONES, Tone, light_of

_TONE = {field.name for field in fields(Tone)} - {"kind"}
# Of what has no check of its own.
_RANGES = RANGES | {"threads": (0.0, 256.0)}
# No page is looked at so closely.
_MOST_PIXELS = 30_000
_LINE = {field.name for field in fields(line.Wishes)} - {"tone"}


class Drawing:
    """A picture in one line, or in one for each ink; made by `draw_picture`. In millimetres, from
    the lower left corner of the sheet.

    sides    width and height of the sheet
    pen      width of the line
    inks     the names of what is drawn
    figures  of each ink, a dictionary: length, tone (error_1, error_2, bias), out_of_reach and so
             on, as in the command's report
    """

    def __init__(self, layers: list[line.Layer], wishes: line.Wishes) -> None:
        self._layers, self._wishes = layers, wishes
        self.sides: tuple[float, float] = layers[0].plan.grid.sides
        self.pen: float = wishes.pen
        self.inks: list[str] = [layer.plan.name for layer in layers]
        self.figures: list[dict[str, Any]] = [layer.entry() for layer in layers]

    @property
    def length(self) -> float:
        """Of all lines."""
        return sum(layer.length for layer in self._layers)

    def lines(self, ink: str | None = None) -> list[NDArray[np.float64]]:
        """The points of each line, (n, 2); a closed one has its first point again at the end.

        ink   of `inks`; None: of all
        """
        if ink is not None and ink not in self.inks:
            raise MeanderError(unknown_name("ink", ink, self.inks))
        return [
            np.vstack([strand.points, strand.points[:1]])[:, :2]
            if strand.closed
            else strand.points[:, :2]
            for layer in self._layers
            if ink in (None, layer.plan.name)
            for strand in layer.strands
        ]

    def preview(self, size: int = 2000) -> Any:
        """The drawing as an image of Pillow's.

        size   of its longer side, in pixels

        Raises FileError where Pillow is not installed.
        """
        size = round(_number("size", size, 1.0, _MOST_PIXELS))
        shown = [(layer.plan.colour, layer.strands) for layer in self._layers]
        return preview(shown, self.sides, self._wishes.line_width, size)

    def write(self, path: str | Path, *, margin: float = 0.0, **drawing: Any) -> None:
        """Writes the drawing in the format of the file's suffix.

        path      one of those of `write_curve` that are no .obj and no table. An .svg has a layer
                  for each ink; of the others each is a file of its own, NAME_INK. A scene and
                  poses are in metres, and a scene's line is as wide as the pen
        margin    of white on all sides, in millimetres
        drawing   as in `write_curve`, but for what a picture decides: layout, unit, scale, size,
                  line_width, force

        Raises FileError: the file cannot be written, or an option means nothing for its format;
        MeanderError for a margin that is none.
        """
        path, margin = path_of(path), _number("margin", margin, 0.0)
        kind = export.format_of(path)
        if kind is None:
            raise FileError(
                f"{path} is no {', '.join(export.SUFFIXES)} file; choose another suffix"
            )
        for name in ("layout", "unit", "scale", "size", "line_width", "force"):
            if name in drawing:
                raise FileError(f"{name} does nothing for a picture; leave it out")
        values = drawing_values(export.suffix_of(path), kind, drawing)
        values |= {"layout_as": "top", "line_width": self.pen}
        if "thickness" not in drawing:
            values["thickness"] = None
        sides = [side + 2.0 * margin for side in self.sides]
        files = {path: self._layers}
        if kind.name != "SVG" and len(self._layers) > 1:
            files = {of_ink(path, layer.plan.name): [layer] for layer in self._layers}
        for each, layers in files.items():
            with whole_file(each) as temporary:
                write_pieces(temporary, pieces_of_page(each, layers, sides, margin, values))


def draw_picture(
    picture: str | Path | ArrayLike,
    width: float = 200.0,
    pen: float = 0.4,
    *,
    mask: str | Path | ArrayLike | None = None,
    run: Callable[[Flow], str] = Flow.run,
    **wishes: Any,
) -> Drawing:
    """Draws a picture in one line that never crosses itself and has its tones.

    picture   a file, which needs Pillow, or an array: (h, w), (h, w, 2), (h, w, 3) or (h, w, 4)
              from the top, sRGB, integers of 8 or 16 bits or numbers from 0 to 1.
              Where it is transparent there is no line
    width     of the drawing, in millimetres
    pen       width of its line, in millimetres
    mask      likewise, of any size: no line where it is dark or transparent
    run       called with each flow, runs it to its end and returns why that came; up to three times
              with the same flow, while its line is more than a hundredth off the tone
    wishes    as the flags of the command: style ("portrait", "engraving", "scribble"), tone ("eye",
              "light", "value"), darkest, lightest, levels, local_contrast, sharpen, spread, paper,
              leave_white, bridges, inks, variation, threads

    Raises FileError for what is no picture, and MeanderError for wishes that cannot be.
    """
    kind = wishes.pop("tone", Tone.kind)
    known = [*_LINE - {"width", "pen"}, *_TONE, "tone"]
    for name in wishes:
        if name not in known:
            raise MeanderError(unknown_name("wish", name, sorted(known)))
    _check_numbers(wishes)
    if isinstance(wishes.get("inks", ()), str):
        raise MeanderError(f"inks {wishes['inks']!r} is no list of names; give such as ('cyan',)")
    for name, value, choices in (
        ("style", wishes.get("style", line.Wishes.style), line.STYLES),
        *(("ink", ink, tuple(INKS)) for ink in wishes.get("inks", ())),
    ):
        if value not in choices:
            raise MeanderError(unknown_name(name, value, choices))
    _check_lengths(width=width, pen=pen)
    tone = _tone(kind, {name: value for name, value in wishes.items() if name in _TONE})
    of_line = {name: value for name, value in wishes.items() if name in _LINE}
    asked = line.Wishes(float(width), float(pen), tone=tone, **of_line)
    layers = line.draw(_image(picture), asked, None if mask is None else _image(mask), run)
    return Drawing(layers, asked)


def tone_density(
    light: ArrayLike, spacing: float, pen: float, tone: str = Tone.kind, **wishes: Any
) -> NDArray[np.float64]:
    """The density with which a line on a surface has the tone of a brightness, for Flow: the
    spacing of strands is the width of the line over the darkness, wherever that is.

    light     (n,) of the vertices, from 0 to 1, scene-linear; sRGB has to be decoded
    spacing   twice options.radius; a place whose darkness is pen / spacing has it
    pen       width of the line, in the units of the vertices
    tone      "eye", "light" or "value"
    wishes    darkest, lightest, levels, paper, as in draw_picture; negative: the line is light and
              the ground dark

    Raises MeanderError for wishes that cannot be.
    """
    known = ["darkest", "levels", "lightest", "negative", "paper"]
    for name in wishes:
        if name not in known:
            raise MeanderError(unknown_name("wish", name, known))
    _check_lengths(spacing=spacing, pen=pen)
    try:
        values = np.asarray(light, dtype=np.float64)
    except (TypeError, ValueError):
        values = np.empty((0, 0))
    if values.ndim != 1 or not np.isfinite(values).all():
        raise MeanderError("light is no list of finite numbers; give one for each vertex")
    made = _tone(tone, wishes)
    levels = None if made.levels is None else tuple(light_of(np.array(made.levels)).tolist())
    return density.tone_density(values, made, float(pen) / float(spacing), levels)


def _check_lengths(**lengths: Any) -> None:
    for name, value in lengths.items():
        number = _as_number(name, value)
        if not (np.isfinite(number) and number > 0.0):
            raise MeanderError(f"{name} {value!r} is not greater than 0; choose a length")


def _check_numbers(wishes: dict[str, Any]) -> None:
    """Raises MeanderError for a wish that is no number, or none that it may be."""
    for name, (least, greatest) in _RANGES.items():
        if name in wishes:
            _number(name, wishes[name], least, greatest)


def _as_number(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise MeanderError(f"{name} {value!r} is not a number") from None


def _number(name: str, value: Any, least: float, greatest: float | None = None) -> float:
    """A number within limits."""
    number = _as_number(name, value)
    if not (np.isfinite(number) and least <= number and (greatest is None or number <= greatest)):
        choice = f"{least:g} or more" if greatest is None else f"from {least:g} to {greatest:g}"
        raise MeanderError(f"{name} {value!r} is out of range; choose {choice}")
    return number


def _pairs(paper: Any) -> list[tuple[float, float]]:
    """What was measured on paper."""
    try:
        return [(float(share), float(darkness)) for share, darkness in paper]
    except (TypeError, ValueError):
        raise MeanderError(
            f"paper {paper!r} is no list of pairs; give such as [(0.5, 0.61)]"
        ) from None


def _tone(kind: str, wishes: dict[str, Any]) -> Tone:
    if kind not in TONES:
        raise MeanderError(unknown_name("tone", kind, TONES))
    for name in ("darkest", "lightest"):
        if name in wishes:
            _number(name, wishes[name], 0.0, 1.0)
    if wishes.get("levels") is not None:
        levels = wishes["levels"]
        try:
            black, white = (float(level) for level in levels)
        except (TypeError, ValueError):
            black = white = 0.0
        if not 0.0 <= black < white <= 100.0:
            raise MeanderError(
                f"levels {levels!r} are not two numbers from 0 to 100, the darker one first"
            )
    if "paper" in wishes:
        wishes = wishes | {"paper": _pairs(wishes["paper"])}
        if fault := fault_of(wishes["paper"]):
            raise MeanderError(f"paper: {fault}")
    tone = Tone(kind, **wishes)
    if not 0.0 < tone.lightest < tone.darkest <= 1.0:
        raise MeanderError("lightest and darkest are not in order; choose 0 < lightest < darkest")
    return tone


def _image(picture: str | Path | ArrayLike) -> Image:
    return read_image(picture) if isinstance(picture, str | Path) else image_of(picture)
