# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture in several inks: how much of each a place needs, and how its rows lie; no bpy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .image import Image
from .tone import channel_light, light_of, lightness


@dataclass(frozen=True)
class Ink:
    """An ink.

    channel   the light that it takes: 0 red, 1 green, 2 blue; None: all of it
    angle     of its rows, in degrees. Screens 30 degrees apart show no moiré; yellow, which is
              seen least, lies between two of them, as printers have it
    colour    of the layer, #rrggbb
    """

    channel: int | None
    angle: float
    colour: str


INKS = {
    "cyan": Ink(0, 15.0, "#00a0d8"),
    "magenta": Ink(1, 75.0, "#e0157f"),
    "yellow": Ink(2, 0.0, "#f7d800"),
    "black": Ink(None, 45.0, "#000000"),
}

# From this lightness on, of 100, there is no black: it would hide the colours.
_NO_BLACK = 50.0


def separated(
    image: Image,
    names: Sequence[str],
    places_y: NDArray[np.float64],
    places_x: NDArray[np.float64],
) -> dict[str, NDArray[np.float64]]:
    """The light that the drawing in each ink is to reflect around places.

    Black, where there is black, takes what is common to all three colours where they are dark: all
    of it where they are black, and ever less up to _NO_BLACK.
    """
    seen = np.stack(
        [lightness(channel_light(image, channel, places_y, places_x)) for channel in range(3)]
    )
    lightest = seen.max(axis=0)
    # What is left to the colours of a grey, of 1; black takes the rest of it.
    left = np.where(lightest < _NO_BLACK, 1.0 - lightest / 100.0, lightest / 100.0)
    of_grey = np.divide(seen, lightest, out=np.ones_like(seen), where=lightest > 0.0)
    found = {}
    for name in names:
        channel = INKS[name].channel
        if channel is None:
            found[name] = light_of((lightest / left).clip(0.0, 100.0))
        else:
            found[name] = light_of(
                100.0 * left * of_grey[channel] if "black" in names else seen[channel]
            )
    return found
