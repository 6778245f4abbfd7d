# SPDX-License-Identifier: GPL-3.0-or-later
"""From the light of a picture to the share of ink that a drawing is to have at each place; no bpy.

A drawing in one line, seen from so far that nobody tells strands apart, reflects as much light as
there is paper between them: a share of ink of .4 is a grey that reflects .6 of the light (Murray
and Davies 1936). A pen reaches neither black, as strands would touch, nor white, as a line has to
cross it. What is between is a choice, of TONES.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .image import Image, averaged, blurred

# How darkness comes from the picture.
TONES = ("eye", "light", "value")
# Rec. 709 for light, Rec. 601 for coded values, as image programs make them grey.
_LIGHT = np.array([0.2126, 0.7152, 0.0722], dtype=np.float32)
_LUMA = np.array([0.299, 0.587, 0.114], dtype=np.float32)
# Rows of a large picture are taken so many pixels at a time.
_AT_ONCE = 1 << 21
# The least and the greatest of what may be wished; None: there is no greatest.
RANGES: dict[str, tuple[float, float | None]] = {
    "local_contrast": (0.0, 5.0),
    "sharpen": (0.0, 5.0),
    "leave_white": (0.0, 1.0),
    "spread": (0.0, None),
}
# So much of the darkest and of the lightest of a picture may be lost where nobody sets levels.
_LOST = 0.005
# The least contrast that levels by themselves stretch, of 100.
_LEAST_RANGE = 20.0
# How far local contrast looks, of the shorter side.
_LOCAL = 0.05


@dataclass(frozen=True)
class Tone:
    """How darkness is made.

    kind            of TONES: "eye" fits the picture's lightness (CIE 1976) between the darkest and
                    the lightest that the pen has, as an eye compares; "light" reflects the
                    picture's own light, and "value" has darkness in proportion to the numbers of
                    the file, both clipped to what the pen has
    darkest         the greatest share of ink: the pen's width over the least spacing
    lightest        the least share, over the greatest spacing
    levels          the lightness, of 100, that becomes darkest and lightest; None: of "eye" what
                    .5 % of the picture are beyond, of the others 0 and 100
    local_contrast  how much places differ more from what is around them; 0: as they are
    sharpen         the same for what is a spacing around them
    paper           shares of ink, and how dark they were measured on paper, both rising; none: as
                    dark as they are
    negative        the line is light and the ground dark: its share is what is bright
    """

    kind: str = "eye"
    darkest: float = 0.9
    lightest: float = 0.06
    levels: tuple[float, float] | None = None
    local_contrast: float = 0.0
    sharpen: float = 0.0
    paper: Sequence[tuple[float, float]] = ()
    negative: bool = False


@dataclass(frozen=True)
class Wanted:
    """The share of ink at the places of a grid, rows from the top.

    share       within what the pen has
    darkness    before it was clipped to that
    """

    share: NDArray[np.float64]
    darkness: NDArray[np.float64]


def to_light(coded: NDArray[np.floating]) -> NDArray[np.floating]:
    """sRGB to light, from 0 to 1 (IEC 61966-2-1)."""
    low = coded / 12.92
    return np.where(coded <= 0.04045, low, ((coded + 0.055) / 1.055) ** 2.4)


def to_value(light: NDArray[np.floating]) -> NDArray[np.floating]:
    """Light to sRGB, from 0 to 1."""
    high = 1.055 * np.maximum(light, 0.0031308) ** (1.0 / 2.4) - 0.055
    return np.where(light <= 0.0031308, 12.92 * light, high)


def lightness(light: NDArray[np.float64]) -> NDArray[np.float64]:
    """Light from 0 to 1 as CIE 1976 lightness from 0 to 100."""
    high = 116.0 * np.cbrt(np.maximum(light, 216.0 / 24389.0)) - 16.0
    return np.where(light > 216.0 / 24389.0, high, light * 24389.0 / 27.0)


def light_of(lightness: NDArray[np.float64]) -> NDArray[np.float64]:
    """CIE 1976 lightness from 0 to 100 as light from 0 to 1."""
    high = ((lightness + 16.0) / 116.0) ** 3
    return np.where(lightness > 8.0, high, lightness * 27.0 / 24389.0)


def grey_light(
    image: Image, kind: str, places_y: NDArray[np.float64], places_x: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The light of a picture around places, from 0 to 1; what is transparent is white.

    kind   of TONES; "value" averages coded values, as image programs do
    """
    grey = np.empty(image.colours.shape[:2], dtype=np.float32)
    rows = max(1, _AT_ONCE // image.colours.shape[1])
    for begin in range(0, len(grey), rows):
        colours = image.colours[begin : begin + rows]
        if kind == "value":
            grey[begin : begin + rows] = colours @ _LUMA
        else:
            grey[begin : begin + rows] = to_light(colours).astype(np.float32) @ _LIGHT
    found = averaged(_on_white(grey, image), places_y, places_x).clip(0.0, 1.0)
    return to_light(found) if kind == "value" else found


def channel_light(
    image: Image, channel: int, places_y: NDArray[np.float64], places_x: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The same of one colour: 0 red, 1 green, 2 blue."""
    values = to_light(image.colours[..., channel]).astype(np.float32)
    return averaged(_on_white(values, image), places_y, places_x).clip(0.0, 1.0)


def _on_white(values: NDArray[np.float32], image: Image) -> NDArray[np.float32]:
    if image.opacity is None:
        return values
    return 1.0 - image.opacity * (1.0 - values)


def wanted(light: NDArray[np.float64], tone: Tone, kept: NDArray[np.bool_], cell: float) -> Wanted:
    """The share of ink for light at the places of a grid.

    kept    where there is to be a line at all
    cell    what a place of the grid is, in mean spacings
    """
    seen = lightness(light)
    low, high = levels_of(seen[kept], tone)
    seen = (100.0 * (seen - low) / (high - low)).clip(0.0, 100.0)
    if tone.local_contrast > 0.0:
        around = blurred(seen, _LOCAL * min(seen.shape))
        seen = seen + tone.local_contrast * (seen - around)
    if tone.sharpen > 0.0:
        seen = seen + tone.sharpen * (seen - blurred(seen, 0.5 / cell))
    return of_lightness(seen.clip(0.0, 100.0), tone)


def levels_of(seen: NDArray[np.float64], tone: Tone) -> tuple[float, float]:
    """The lightness that becomes darkest and lightest."""
    return weighted_levels(seen, np.ones(len(seen)), tone)


def weighted_levels(
    seen: NDArray[np.float64], weights: NDArray[np.float64], tone: Tone
) -> tuple[float, float]:
    """The same of places that count for more or less of the picture."""
    if tone.levels is not None:
        return tone.levels
    if tone.kind != "eye" or not (weights > 0.0).any():
        return 0.0, 100.0
    low, high = weighted_quantiles(seen, weights, [_LOST, 1.0 - _LOST])
    lacking = max(0.0, _LEAST_RANGE - (high - low)) / 2.0
    return max(0.0, low - lacking), min(100.0, high + lacking)


def weighted_quantiles(
    values: NDArray[np.float64], weights: NDArray[np.float64], shares: Sequence[float]
) -> list[float]:
    """What shares of all weight lie below, each."""
    order = np.argsort(values, kind="stable")
    upto = np.cumsum(weights[order])
    places = (upto - 0.5 * weights[order]) / upto[-1]
    return np.interp(shares, places, values[order]).tolist()


def exposed(
    light: NDArray[np.float64], weights: NDArray[np.float64], tone: Tone
) -> NDArray[np.float64]:
    """Light as a photographer would expose it, where tones are fitted to what the pen has: what is
    to be lightest is white. Else it is as it is."""
    if tone.kind != "eye" or not (weights > 0.0).any():
        return light
    (white,) = weighted_quantiles(light, weights, [1.0 - _LOST])
    return light / white if white > 0.0 else light


def of_lightness(seen: NDArray[np.float64], tone: Tone) -> Wanted:
    """The share of ink for a lightness from 0 to 100."""
    black, white = darkness_on_paper(np.array([tone.darkest, tone.lightest]), tone.paper)
    if tone.kind == "eye":
        ends = np.array([white, black] if tone.negative else [1.0 - black, 1.0 - white])
        low, high = lightness(ends)
        reflected = light_of(low + seen / 100.0 * (high - low))
    else:
        reflected = light_of(seen)
        if tone.kind == "value":
            reflected = to_value(reflected)
    darkness = reflected if tone.negative else 1.0 - reflected
    share = share_for(darkness.clip(white, black), tone.paper)
    return Wanted(share.clip(tone.lightest, tone.darkest), darkness)


def darkness_on_paper(
    share: NDArray[np.float64], paper: Sequence[tuple[float, float]]
) -> NDArray[np.float64]:
    """How dark a share of ink is, by what was measured; straight in between."""
    if not paper:
        return share
    shares, measured = zip((0.0, 0.0), *paper, (1.0, max(1.0, paper[-1][1])), strict=False)
    return np.interp(share, shares, measured)


def share_for(
    darkness: NDArray[np.float64], paper: Sequence[tuple[float, float]]
) -> NDArray[np.float64]:
    """The share of ink that is so dark; the inverse of darkness_on_paper."""
    if not paper:
        return darkness
    shares, measured = zip((0.0, 0.0), *paper, (1.0, max(1.0, paper[-1][1])), strict=False)
    return np.interp(darkness, measured, shares)
