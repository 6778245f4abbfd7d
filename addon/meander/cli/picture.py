# SPDX-License-Identifier: GPL-3.0-or-later
"""The command that draws a picture in one line; no bpy.

It is the batch command with --picture in place of --input; see docs/make/picture.md.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace

from .. import core
from ..model.estimate import PHASE_TEXTS
from ..model.picture import line, strip
from ..model.picture.image import Image
from . import limits, standard, watching
from .drawn_files import record_of, write_drawings
from .place import Place
from .values import BadInput
from .wishes import check, parser, wishes_of

# What names the command among those of the batch command.
OPTIONS = ("--picture", "--test-strip")
# What makes a run smaller.
_REMEDY = "a wider pen, a smaller width or a part of the picture"


def is_asked(argv: Sequence[str]) -> bool:
    """Whether options of the batch command ask for a picture."""
    return any(word.split("=", 1)[0] in OPTIONS for word in argv)


def process(argv: Sequence[str], place: Place) -> None:
    """Draws what the options ask for. Raises BadInput, FileError and core.MeanderError."""
    arguments = parser(place).parse_args(argv)
    if arguments.quiet:
        place = replace(place, say=lambda _line: None)
    with standard.streams(arguments, place) as place_of_run:
        _draw(arguments, place_of_run)


def _draw(arguments: argparse.Namespace, place: Place) -> None:
    check(arguments, place)
    wishes, mask = wishes_of(arguments), None
    if arguments.test_strip:
        image, wishes = strip.test_strip(), replace(wishes, tone=strip.TONE)
    else:
        image = _cropped(place.picture(arguments.picture), arguments)
        if arguments.mask is not None:
            mask = place.picture(arguments.mask)

    def say(text: str) -> None:
        place.say(f"meander: {text}")

    last: core.Flow | None = None

    def run(flow: core.Flow) -> str:
        nonlocal last
        if flow is last:
            say(PHASE_TEXTS["correction"].lower())
        last = flow
        return watching.run(flow, place.say)

    def accept(cost: core.Cost) -> None:
        limits.refuse_large(cost, arguments, _REMEDY)

    layers = line.draw(image, wishes, mask, run, accept)
    record = record_of(arguments, image, wishes, layers)
    for path in write_drawings(arguments, layers, record, say):
        say(f"wrote {path}")


def _cropped(image: Image, arguments: argparse.Namespace) -> Image:
    if arguments.crop is None:
        return image
    left, top, width, height = arguments.crop
    columns, rows = image.sides
    if not (width and height and left + width <= columns and top + height <= rows):
        raise BadInput(
            f"--crop {left} {top} {width} {height} is not within the picture, which has {columns} "
            f"x {rows} pixels"
        )
    return image.cropped(left, top, width, height)
