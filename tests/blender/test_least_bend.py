# SPDX-License-Identifier: GPL-3.0-or-later
"""A radius of bending in the panel: the curve gets stiffer until it holds, or is refused."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from scenes import counts, fill, grid, world_splines
from watched_runs import begin, tick_until

SPACING = 0.15


def sheet() -> bpy.types.Object:
    return grid(12, 1.2)


def least_radius(result: bpy.types.Object) -> float:
    """Of circles through three points of the result, an eighth of the spacing apart."""
    least = np.inf
    for points, cyclic in world_splines(result):
        way = np.vstack([points, points[:40]]) if cyclic else points
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(way, axis=0), axis=1))])

        def at(places, way=way, along=along):
            return np.column_stack([np.interp(places, along, way[:, axis]) for axis in range(3)])

        middles = np.arange(SPACING / 8, along[-1] - SPACING / 8, SPACING / 40)
        a, b, c = at(middles - SPACING / 8), at(middles), at(middles + SPACING / 8)
        u, v = b - a, c - b
        sine = np.linalg.norm(np.cross(u, v), axis=1)
        sine /= np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1)
        least = min(least, float((np.linalg.norm(c - a, axis=1) / (2.0 * sine + 1e-9)).min()))
    return least


def test_a_run_goes_on_stiffer_until_the_radius_holds(windowed):
    surface = sheet()
    before = least_radius(fill(surface, SPACING))
    asked = max(1.2 * before, 0.36 * SPACING / 2)
    result = fill(surface, SPACING, least_bend_radius=asked)
    assert before < 0.9 * asked
    assert least_radius(result) > 0.95 * asked
    watched = begin(surface, SPACING)
    tick_until(watched, lambda: False)
    assert watched.stepper.stiffening.held
    assert watched.stepper.problem.options.bending_weight > 1.0
    again, _figures = watched.keep(bpy.context)
    watched.end()
    assert least_radius(again) == pytest.approx(least_radius(result), rel=1e-6)


def test_the_stiffness_that_holds_is_kept(windowed):
    """Going on, filling again and resuming begin with it, and do not look for it once more."""
    surface = sheet()
    surface.meander.preset = "PAPER"
    asked = 1.2 * least_radius(fill(surface, SPACING))
    result = fill(surface, SPACING, least_bend_radius=asked)
    stiffness = result.meander.bending_weight
    assert stiffness >= 1.0, "As Published has none"
    assert result.meander.use_weights and result.meander.length_weight == 1.0, "of As Published"
    assert surface.meander.use_weights and surface.meander.bending_weight == stiffness
    for thing in (result, surface):
        watched = begin(thing, SPACING)
        tick_until(watched, lambda: False)
        assert watched.stepper.stiffening.best is None, "what it began with holds"
        assert watched.stepper.problem.options.bending_weight == stiffness
        made, _figures = watched.keep(bpy.context)
        watched.end()
        assert made.meander.bending_weight == stiffness
        assert least_radius(made) > 0.95 * asked


def test_a_stiffness_chosen_while_the_curve_grows_is_that_of_the_next_run(windowed):
    surface = sheet()
    surface.meander.preset = "PAPER"
    asked = 1.2 * least_radius(fill(surface, SPACING))
    surface.meander.least_bend_radius = asked
    watched = begin(surface, SPACING)
    surface.meander.use_weights, surface.meander.bending_weight = True, 0.25
    tick_until(watched, lambda: False)
    made, _figures = watched.keep(bpy.context)
    watched.end()
    assert surface.meander.bending_weight == made.meander.bending_weight == 0.25


def test_what_no_stiffness_holds_is_refused_with_the_place():
    surface = sheet()
    before = counts()
    with pytest.raises(RuntimeError, match=r"No stiffness holds a bend radius.*most sharply at \("):
        fill(surface, SPACING, least_bend_radius=2.0 * SPACING)
    assert counts() == before and surface.meander.last_result is None
