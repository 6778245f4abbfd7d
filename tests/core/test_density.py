# SPDX-License-Identifier: GPL-3.0-or-later
"""From values to density: ramps, brightness, images; against one value at a time."""

from __future__ import annotations

import colorsys

import geometry
import numpy as np
import pytest
from flows import options_of
from meander import core
from meander.model import density
from meander.model.density import Choice, Ramp


@pytest.mark.parametrize("interpolation", density.INTERPOLATIONS)
@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (-2.0, 3.0), (3.0, -2.0)])
def test_a_ramp_goes_from_one_factor_to_the_other(interpolation, low, high):
    ramp = Ramp(low, high, 1.5, 0.25, interpolation)
    span = high - low
    outside = np.array([low - span, low, high, high + span])
    assert ramp.factors(outside).tolist() == [1.5, 1.5, 0.25, 0.25]
    middle = {"linear": 0.25, "smooth": 0.15625, "constant": 0.0}[interpolation]
    quarter = ramp.factors(np.array([low + 0.25 * span]))[0]
    assert quarter == pytest.approx(1.5 - 1.25 * middle)
    inside = ramp.factors(np.linspace(low, high, 101))
    assert (np.diff(inside) <= 1e-15).all()
    assert ramp.density(outside) == pytest.approx([1 / 2.25, 1 / 2.25, 16.0, 16.0])


def test_an_empty_range_is_a_step():
    ramp = Ramp(2.0, 2.0, 1.0, 0.5)
    assert ramp.factors(np.array([1.0, 2.0, 2.5])).tolist() == [1.0, 1.0, 0.5]


@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (-2.0, 3.0), (3.0, -2.0)])
def test_a_free_ramp_is_straight_between_its_stops(low, high):
    stops = ((0.1, 0.0), (0.4, 1.0), (0.5, 0.2), (1.0, 0.6))
    ramp = Ramp(low, high, 0.5, 2.5, density.FREE, stops)

    def literal(value: float) -> float:
        t = (value - low) / (high - low)
        if t <= 0.1:
            return 0.5
        for (begin, before), (end, after) in zip(stops[:-1], stops[1:]):
            if t <= end:
                return 0.5 + 2.0 * (before + (after - before) * (t - begin) / (end - begin))
        return 0.5 + 2.0 * 0.6

    values = np.linspace(-5.0, 6.0, 333)
    assert ramp.factors(values) == pytest.approx([literal(value) for value in values])
    assert ramp.density(np.array([low]))[0] == pytest.approx(4.0)


def test_a_free_ramp_without_stops_is_linear():
    values = np.linspace(-1.0, 2.0, 50)
    free = Ramp(interpolation=density.FREE).factors(values)
    assert free.tolist() == Ramp().factors(values).tolist()


def test_an_unknown_interpolation_is_refused():
    with pytest.raises(ValueError, match="'round'; choose one of linear, smooth, constant"):
        Ramp(interpolation="round").factors(np.zeros(1))


def test_the_range_suits_the_source():
    values = np.array([-3.0, 5.0])
    assert Choice("GROUP", "g").ramp(values) == Ramp(0.0, 1.0)
    assert Choice("ATTRIBUTE", "a").ramp(values) == Ramp(-3.0, 5.0)
    assert Choice("ATTRIBUTE", "a", value_range=(1.0, 2.0)).ramp(values) == Ramp(1.0, 2.0)
    assert not Choice().varies and not Choice("GROUP").varies
    assert Choice("IMAGE").varies  # so that a missing image is refused and not overlooked


@pytest.mark.parametrize("bend", [1e-3, 1.0, 50.0])
def test_what_bends_the_same_everywhere_keeps_the_spacing(bend):
    """A sphere, up to what its faces make of its curvature."""
    values = bend * np.random.default_rng(2).uniform(0.99, 1.01, 1000)
    density = Choice("CURVATURE", "mean").ramp(values).density(values)
    assert density.max() < 1.1 and density.min() < 1.05


def test_the_range_of_curvature_goes_on_from_little_contrast_to_much():
    """Each a little more contrast than the one before: no step from one spacing to another."""
    ramps = []
    for flattest in np.linspace(1.0, 0.0, 201):
        values = np.linspace(flattest, 1.0, 1001)
        ramps.append(Choice("CURVATURE", "mean").ramp(values))
    for before, after in zip(ramps, ramps[1:]):
        assert abs(after.low - before.low) < 0.02 and abs(after.high - before.high) < 0.02
    assert all(ramp.high - ramp.low > 0.45 for ramp in ramps)
    assert (ramps[-1].low, ramps[-1].high) == (0.0, pytest.approx(0.95))


def test_luminance():
    colors = np.array([[1.0, 0.0, 0.0, 0.3], [0.0, 1.0, 0.0, 0.3], [0.0, 0.0, 1.0, 0.3]])
    assert density.luminance(colors).tolist() == [0.2126, 0.7152, 0.0722]
    assert density.luminance(np.full((2, 4), 0.5)) == pytest.approx([0.5, 0.5])
    # The Y of YIQ is another standard's, but grey is the same for all.
    assert density.luminance(np.full((1, 3), 0.5))[0] == pytest.approx(
        colorsys.rgb_to_yiq(0.5, 0.5, 0.5)[0]
    )
    assert density.luminance(np.array([[0.25], [0.75]])).tolist() == [0.25, 0.75]
    assert density.luminance(np.array([[0.25, 1.0]])).tolist() == [0.25]


def test_srgb_is_made_linear():
    stored = np.array([0.0, 0.04045, 0.5, 1.0])
    # From the standard's own table: 128 of 255 is 21.6 % of the light.
    assert density.linear_of_srgb(stored) == pytest.approx(
        [0.0, 0.0031308, 0.2140411, 1.0], rel=1e-5
    )
    grey = density.srgb_luminance(np.full((1, 4), 128 / 255))
    assert grey[0] == pytest.approx(0.2158605)


def test_an_image_is_sampled_between_the_middles_of_its_pixels():
    rng = np.random.default_rng(7)
    pixels = rng.random((3, 5, 3))
    uv = rng.uniform(-1.5, 2.5, (200, 2))

    def literal(u: float, v: float) -> float:
        """Every pixel of a 5 x 3 tiling, weighted by its tent."""
        total = 0.0
        for row in range(-12, 15):
            for column in range(-20, 25):
                tent = max(0.0, 1.0 - abs(5.0 * u - column - 0.5))
                tent *= max(0.0, 1.0 - abs(3.0 * v - row - 0.5))
                if tent:
                    red, green, blue = pixels[row % 3, column % 5]
                    total += tent * (0.2126 * red + 0.7152 * green + 0.0722 * blue)
        return total

    sampled = density.sample_repeated(pixels, uv)
    assert sampled == pytest.approx([literal(*point) for point in uv])


def test_the_middle_of_a_pixel_is_the_pixel():
    pixels = np.array([[[0.1], [0.2]], [[0.3], [0.4]]])  # the first row is at the bottom
    uv = np.array([[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]])
    assert density.sample_repeated(pixels, uv) == pytest.approx([0.1, 0.2, 0.3, 0.4])


def test_corners_are_averaged_at_their_vertex():
    values = np.array([1.0, 2.0, 3.0, 10.0])
    assert density.mean_at_vertices(values, np.array([0, 2, 0, 2]), 4).tolist() == [2, 0, 6, 0]


def test_a_steep_ramp_in_the_corner_where_the_curve_begins_does_not_stop_it():
    # The first face of a grid is in its corner; the outline of that face was squeezed flat there.
    mesh = geometry.rectangle((-1.33, -1.0), (1.33, 1.0), 80, 60)
    place = (mesh.vertices[:, 0] + 1.33) / 2.66
    factors = np.interp(place, (0.0, 0.35, 0.7, 1.0), (1.0, 0.3, 1.0, 0.58))
    options = options_of(radius=0.06)
    surface = core.Surface(*mesh)
    flow = core.Flow(surface, options, density=1.0 / factors**2)
    assert flow.run() == "converged"
    expected = np.sum(surface.statistics()["area"]) / (2.0 * options.radius)
    assert flow.statistics()["length"] > expected
