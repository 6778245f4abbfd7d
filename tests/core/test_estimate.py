# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run is said to come to, before it, against what it comes to."""

from __future__ import annotations

import math
from dataclasses import replace

import geometry
import numpy as np
import pytest
from meander import core
from meander.model.estimate import Estimate, Speeds, described, estimated, extent_of

# What is shown is rounded to two digits; nobody decides anything by a tenth.
WITHIN = 0.15


def options_of(preset: str, spacing: float) -> core.FlowOptions:
    options = core.default_options(preset)
    options.radius = spacing / 2.0
    return options


def points_of_run(vertices, faces, options, density=None, face_mask=None) -> tuple[int, float]:
    """The points of the curve, and the share of the area that is filled."""
    prepared = core.SurfaceOptions()
    prepared.face_mask = face_mask
    with core.Surface(vertices, faces, prepared) as surface:
        filled = surface.statistics()["area"]
        with core.Flow(surface, options, None, density) as flow:
            assert flow.run() == "converged"
            curve = flow.polylines()
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0
    return len(curve.positions), filled / area


@pytest.mark.parametrize("preset", ["even", "paper"])
@pytest.mark.parametrize("subdivisions", [2, 4])
def test_the_points_of_a_sphere(preset, subdivisions):
    vertices, faces = geometry.icosphere(subdivisions)
    options = options_of(preset, 0.15)
    points, _share = points_of_run(vertices, faces, options)
    estimate = estimated(extent_of(vertices, faces), options, True, Speeds())
    assert estimate.points == pytest.approx(points, rel=WITHIN)


def test_the_segment_length_counts():
    vertices, faces = geometry.icosphere(3)
    options = options_of("even", 0.2)
    options.segment_length = 0.4 * options.radius
    points, _share = points_of_run(vertices, faces, options)
    estimate = estimated(extent_of(vertices, faces), options, True, Speeds())
    assert estimate.points == pytest.approx(points, rel=WITHIN)


def test_density_and_mask_count():
    vertices, faces = geometry.icosphere(4)
    density = np.where(vertices[:, 2] > 0.0, 4.0, 1.0)
    mask = vertices[faces].mean(axis=1)[:, 0] > 0.0
    options = options_of("even", 0.2)
    points, share = points_of_run(vertices, faces, options, density, mask)
    assert share == pytest.approx(0.5, abs=0.05)
    estimate = estimated(extent_of(vertices, faces, density, share), options, True, Speeds())
    assert estimate.points == pytest.approx(points, rel=WITHIN)


def test_half_the_spacing_takes_four_times_as_much():
    vertices, faces = geometry.icosphere(0)
    extent = replace(extent_of(vertices, faces), edges=0.0, faces=0)
    coarse, fine = (
        estimated(extent, options_of("even", spacing), False, Speeds()) for spacing in (0.1, 0.05)
    )
    assert fine.points == pytest.approx(4 * coarse.points, rel=1e-3)
    assert fine.memory == pytest.approx(4 * coarse.memory, rel=1e-3)
    assert 4 * coarse.seconds < fine.seconds < 6 * coarse.seconds


def test_the_speed_is_that_of_the_runs_before():
    speeds = Speeds()
    options = options_of("even", 0.1)
    before = speeds.seconds(options, 50_000)
    speeds.learn(options, 100, 1000.0)
    assert speeds.seconds(options, 50_000) == before, "a small run says nothing"
    speeds.learn(options, 50_000, 3.0 * before)
    assert speeds.seconds(options, 50_000) == pytest.approx(3.0 * before)
    paper = options_of("paper", 0.1)
    assert speeds.seconds(paper, 50_000) == pytest.approx(3.0 * Speeds().seconds(paper, 50_000))
    speeds.learn(options, 50_000, before)
    assert before < speeds.seconds(options, 50_000) < 3.0 * before


def test_surfaces_without_area_have_no_points():
    vertices, faces = np.zeros((3, 3)), np.array([[0, 1, 2]])
    estimate = estimated(extent_of(vertices, faces), options_of("even", 0.1), True, Speeds())
    assert estimate.points == 0 and estimate.seconds == 0.0


@pytest.mark.parametrize(
    ("points", "seconds", "memory", "words"),
    [
        (11_234, 1.2, 31e6, "11,000 points, 1 s, 31 MB"),
        (0, 0.0, 0, "1 points, 1 s, 1 MB"),
        (999, 59.7, 994e6, "1,000 points, 60 s, 990 MB"),
        (994_999, 100.0, 995e6, "990,000 points, 1 min, 1 GB"),
        (4_123_000, 16 * 60, 2.16e9, "4.1 M points, 16 min, 2.2 GB"),
        (83e6, 5.9e3, 46e9, "83 M points, 98 min, 46 GB"),
        (83e6, 7.3e3, 46e9, "83 M points, 2 h, 46 GB"),
        (83e6, 864e3, 46e9, "83 M points, 10 days, 46 GB"),
        (8.3e9, 864e6, 46e12, "8.3 G points, 10,000 days, 46 TB"),
    ],
)
def test_in_words(points, seconds, memory, words):
    assert described(Estimate(int(points), seconds, int(memory))) == words


def test_edges_are_counted_once():
    vertices, faces = geometry.icosphere(2)
    pairs = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique = np.unique(pairs, axis=0)
    lengths = np.linalg.norm(vertices[unique[:, 0]] - vertices[unique[:, 1]], axis=1).sum()
    extent = extent_of(vertices, faces)
    assert extent.edges * extent.node_area == pytest.approx(lengths)
    assert math.isclose(extent.length_area, 4.0 * math.pi, rel_tol=0.1)
    assert extent.faces == len(faces)
