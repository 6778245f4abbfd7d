# SPDX-License-Identifier: GPL-3.0-or-later
"""From values on a surface to the density of the curve: numpy in, numpy out, no bpy.

A value per vertex, be it a weight, a brightness or a curvature, goes through a Ramp, which says how
many times the spacing neighbouring strands are to be apart there. Density is one over the square of
that factor, since the local spacing is the spacing divided by sqrt(density). As a tone a value is a
brightness: the spacing is the width of the line over the share of ink that looks so.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .. import core
from .field import Computed, FieldOn
from .picture.tone import Tone, levels_of, lightness, of_lightness
from .steps import Steps

Values = NDArray[np.float64]

CURVATURES = ("mean", "gaussian")
INTERPOLATIONS = ("linear", "smooth", "constant")
# One more, which needs stops.
FREE = "free"
# And one that is no ramp: values are brightness, see tone_density().
TONE = "tone"

# Where in the range, and how far from the low factor to the high one, both in [0, 1]; in order.
Stops = tuple[tuple[float, float], ...]

# What a display shows as bright, of linear red, green and blue (ITU-R BT.709).
_LUMINANCE = np.array((0.2126, 0.7152, 0.0722))


@dataclass(frozen=True)
class Ramp:
    """By what the spacing is multiplied, from one value to another.

    The factor goes from factor_low at the value `low` to factor_high at the value `high` and stays
    the same beyond. `low` may be the greater one: the ramp then falls. Where both are the same it
    is a step: factor_high above them.

    interpolation   "linear"; "smooth": flat at both ends, 3 t^2 - 2 t^3; "constant": a step in the
                    middle of the range; "free": straight from stop to stop
    stops           of "free"; before the first one and after the last the factor stays the same
    """

    low: float = 0.0
    high: float = 1.0
    factor_low: float = 1.0
    factor_high: float = 0.5
    interpolation: str = "linear"
    stops: Stops = ()

    def factors(self, values: Values) -> Values:
        if self.low == self.high:
            t = (values > self.low).astype(np.float64)
        else:
            t = np.clip((values - self.low) / (self.high - self.low), 0.0, 1.0)
        if self.interpolation == "smooth":
            t = t * t * (3.0 - 2.0 * t)
        elif self.interpolation == "constant":
            t = (t >= 0.5).astype(np.float64)
        elif self.interpolation == FREE:
            if self.stops:
                t = np.interp(t, *zip(*self.stops))
        elif self.interpolation != "linear":
            raise ValueError(
                f"unknown interpolation {self.interpolation!r}; choose one of "
                f"{', '.join(INTERPOLATIONS)}"
            )
        return self.factor_low + (self.factor_high - self.factor_low) * t

    def density(self, values: Values) -> Values:
        """The density per vertex, as core.Flow wants it."""
        factors = self.factors(np.asarray(values, dtype=np.float64))
        return 1.0 / (factors * factors)


@dataclass(frozen=True)
class Choice:
    """What the spacing follows, and how: as a panel or a command line says it."""

    source: str = "NONE"  # or "GROUP", "ATTRIBUTE", "COLOR", "IMAGE", "CURVATURE"
    name: str = ""  # of the group, attribute or image; one of CURVATURES
    uv_map: str = ""  # for an image; empty: the active one
    value_range: tuple[float, float] | None = None  # None: by the source
    factors: tuple[float, float] = (1.0, 0.5)
    interpolation: str = "linear"
    smoothing: float = 2.0  # of curvature, in units of r
    stops: Stops = ()  # of the interpolation "free"
    tone: Tone = field(default_factory=Tone)  # of the interpolation "tone", without its levels
    line: float = 0.5  # likewise: width of the line, in spacings

    @property
    def varies(self) -> bool:
        """Whether there is anything to read: an empty vertex group means even spacing."""
        return self.source not in {"NONE", "GROUP"} or bool(self.name)

    def ramp(self, values: Values) -> Ramp:
        """The ramp with its range: the chosen one, or what suits the source."""
        if self.value_range is not None:
            low, high = self.value_range
        elif self.source == "ATTRIBUTE":
            low, high = float(values.min()), float(values.max())
        elif self.source == "CURVATURE":
            # From flat to what all but the sharpest places have: a crease does not leave everything
            # else on the low factor. Where even the flattest places bend more than half as much,
            # the range begins later, and is never shorter than that half: on a sphere, which bends
            # the same everywhere, all of it is on the low factor.
            least, most = (float(value) for value in np.percentile(values, (5.0, 95.0)))
            low = max(0.0, 2.0 * least - most)
            high = max(most, low + 0.5 * most)
        else:
            low, high = 0.0, 1.0
        return Ramp(low, high, *self.factors, self.interpolation, self.stops)

    @property
    def is_tone(self) -> bool:
        """Whether values are brightness, and the width of the line counts."""
        return self.varies and self.interpolation == TONE

    def density(self, values: Values) -> Values:
        """The density per vertex for values per vertex."""
        if self.interpolation == TONE:
            return tone_density(values, self.tone, self.line, self.value_range)
        return self.ramp(values).density(values)


def shares_of_ink(
    light: Values, tone: Tone, value_range: tuple[float, float] | None = None
) -> Values:
    """The share of ink that looks as bright.

    light         from 0 to 1, scene-linear; what is beyond counts as 0 or 1
    value_range   the light that becomes darkest and lightest; None: by tone.levels_of()
    """
    seen = lightness(np.asarray(light, dtype=np.float64).clip(0.0, 1.0))
    if value_range is None:
        low, high = levels_of(seen, tone)
    else:
        low, high = lightness(np.array(value_range, dtype=np.float64).clip(0.0, 1.0))
    # Where both are the same it is a step, as a Ramp is.
    span = (high - low) or 1e-9
    return of_lightness((100.0 * (seen - low) / span).clip(0.0, 100.0), tone).share


def tone_density(
    light: Values, tone: Tone, line: float, value_range: tuple[float, float] | None = None
) -> Values:
    """The density with which a line has the tone of a brightness: its spacing is its width over
    the share of ink.

    line   width of the line, in spacings: of so much ink is a place where the density is 1

    The others are as in shares_of_ink().
    """
    return (shares_of_ink(light, tone, value_range) / line) ** 2


def curvature_density(choice: Choice, radius: float) -> FieldOn:
    """What computes the density from the absolute curvature of a surface.

    Curvature is averaged over choice.smoothing times the radius, and values of less than a
    millionth of what the size of the surface gives are those of a flat one.
    """

    def on(surface: core.Surface) -> Steps[Values]:
        diagonal = surface.statistics()["diagonal"]
        smoothing = min(choice.smoothing * radius, diagonal)
        values = yield surface.curvature_work(f"absolute_{choice.name}", smoothing)
        noise = 1e-6 / diagonal ** (2 if choice.name == "gaussian" else 1)
        values[values < noise] = 0.0
        return choice.density(values)

    return Computed(on)


def luminance(colors: NDArray[np.floating]) -> Values:
    """The brightness of scene-linear colours (..., 1, 2, 3 or 4): grey, with alpha or without.

    What the node RGB to BW of a shader gives. Alpha is left out.
    """
    if colors.shape[-1] < 3:
        return colors[..., 0].astype(np.float64)
    return colors[..., :3] @ _LUMINANCE


def linear_of_srgb(colors: NDArray[np.floating]) -> NDArray[np.floating]:
    """Scene-linear values of the sRGB values that an 8-bit image holds (IEC 61966-2-1)."""
    return np.where(
        colors <= 0.04045, colors / 12.92, ((np.maximum(colors, 0.04045) + 0.055) / 1.055) ** 2.4
    )


def srgb_luminance(colors: NDArray[np.floating]) -> Values:
    """luminance() of sRGB colours, as 8-bit images hold them."""
    return luminance(linear_of_srgb(colors))


def sample_repeated(
    pixels: NDArray[np.floating],
    uv: NDArray[np.floating],
    value_of: Callable[[NDArray[np.floating]], Values] = luminance,
) -> Values:
    """An image (height, width, channels), first row at the bottom, at UV coordinates (n, 2).

    Linear between the middles of pixels, and repeated beyond the unit square, as an Image Texture
    does by default. `value_of` turns colours into values, and is asked only for pixels that count.
    """
    height, width = pixels.shape[:2]
    x = np.asarray(uv[:, 0], dtype=np.float64) * width - 0.5
    y = np.asarray(uv[:, 1], dtype=np.float64) * height - 0.5
    left, below = np.floor(x), np.floor(y)
    s, t = x - left, y - below
    columns = left.astype(np.int64) % width
    rows = below.astype(np.int64) % height

    def row(j: NDArray[np.int64]) -> Values:
        return (1.0 - s) * value_of(pixels[j, columns]) + s * value_of(
            pixels[j, (columns + 1) % width]
        )

    return (1.0 - t) * row(rows) + t * row((rows + 1) % height)


def mean_at_vertices(values: Values, vertices: NDArray[np.integer], count: int) -> Values:
    """The mean over the corners of each vertex: values (n,) of corners, whose vertices are given.

    Returns (count,); 0 where a vertex has no corner.
    """
    corners = np.bincount(vertices, minlength=count)
    sums = np.bincount(vertices, weights=values, minlength=count)
    return sums / np.maximum(corners, 1)
