# SPDX-License-Identifier: GPL-3.0-or-later
"""Narrow surfaces are filled, strips with the work of a square by the nodes of all iterations."""

from __future__ import annotations

import numpy as np
import pytest
from geometry import Mesh
from long_shapes import SHAPES, area_of, square
from long_surfaces import fill, is_wrong, stroke_at_the_end
from meander import core


def faces_of(mesh: Mesh) -> np.ndarray:
    return mesh.vertices[mesh.faces]


@pytest.mark.parametrize(
    "shape, length, pieces",
    [("holed", 20, 200), ("spiral", 10, 200), ("ring", 50, 200)],
)
def test_a_strip_below_a_spacing_takes_the_work_of_a_square(
    shape: str, length: float, pieces: int
) -> None:
    """A line and its way back lie four tenths of a spacing apart there, and had segments as much
    shorter than those asked for: 2.1 to 4 times the work."""
    mesh = SHAPES[shape](length, 0.8, pieces)
    row = fill(mesh, None, "nothing", 0)
    assert not is_wrong(row)
    like = fill(square(area_of(mesh), pieces), None, "nothing", 0)
    assert row["node_iterations"] < 1.5 * like["node_iterations"]


@pytest.mark.parametrize("name", ["strip", "ring", "spiral", "zigzag", "needle", "comb", "star"])
def test_what_is_flat_lies_nowhere_on_itself(name: str) -> None:
    """A zigzag of 10 x 4 had eight legs of 1.25, and .15 of its area turned over."""
    for length in (10, 50):
        for width in (0.8, 1.2, 2, 3, 4, 8):
            a, b, c = np.moveaxis(faces_of(SHAPES[name](length, width, 24)), 1, 0)
            upward = np.cross(b - a, c - a)[:, 2]
            assert (upward > 0).all() or (upward < 0).all()


@pytest.mark.parametrize("pieces", [20, 200])
def test_a_cone_that_holds_long_segments_is_filled(pieces: int) -> None:
    """Where it is about a spacing round, nothing moved after 11 and 12 iterations: the flow had
    stalled, with .14 and .16 of the area empty."""
    row = fill(SHAPES["cone"](10, 0.8, pieces), None, "nothing", 0)
    assert not is_wrong(row) and row["strands"] == 1


def test_little_that_lies_in_balance_is_pushed_too() -> None:
    """What grows from a stroke runs ahead in four strands, and then the rest is laid: a stretch of
    thirty spacings, which is little of all, kept four strands in place of eight, and places two
    radii from any. Of 5,000 spacings .0012 stayed empty."""
    mesh = SHAPES["strip"](1000, 8, 1)
    options = core.default_options("even")
    options.radius = 0.5
    with core.Surface(mesh.vertices, mesh.faces) as surface:
        flow = core.Flow(surface, options, stroke_at_the_end(mesh))
    with flow:
        assert flow.run() == "converged"
        assert flow.gaps().radii[0] < 1.8 * options.radius
        assert flow.statistics()["crossings"] == 0
