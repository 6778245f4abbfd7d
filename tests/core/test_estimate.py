# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run is said to come to, before it, against what it comes to."""

from __future__ import annotations

import math
import sys
from dataclasses import replace

import flows
import geometry
import numpy as np
import peaks
import pytest
from meander import core
from meander.cli.limits import of_process
from meander.model.estimate import (
    Estimate,
    Speeds,
    cost_of,
    described,
    estimated,
    extent_of,
    hanging_in_words,
)
from meander.model.geometry.reflection import mirror_of
from meander.model.mirror import halving
from meander.model.problem import Problem
from meander.model.steps import at_once

# What is shown is rounded to two digits; nobody decides anything by a tenth.
WITHIN = 0.15


def options_of(preset: str, spacing: float) -> core.FlowOptions:
    return flows.options_of(preset, radius=spacing / 2.0)


def points_of_run(vertices, faces, options, density=None, face_mask=None) -> tuple[int, float]:
    """The points of the curve, and the share of the area that is filled."""
    prepared = core.SurfaceOptions()
    prepared.face_mask = face_mask
    with core.Surface(vertices, faces, prepared) as surface:
        filled = surface.statistics()["area"]
        with core.Flow(surface, options, None, density) as flow:
            assert flow.run() == "converged"
            curve = flow.polylines()
    return len(curve.positions), filled / geometry.triangle_areas(vertices, faces).sum()


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
    extent = replace(extent_of(vertices, faces), edge_density=0.0, faces=0)
    coarse, fine = (
        estimated(extent, options_of("even", spacing), False, Speeds()) for spacing in (0.1, 0.05)
    )
    assert fine.points == pytest.approx(4 * coarse.points, rel=1e-3)
    assert fine.memory == pytest.approx(4 * coarse.memory, rel=1e-3)
    assert 4 * coarse.seconds < fine.seconds < 6 * coarse.seconds


def test_the_speed_is_that_of_the_runs_before():
    speeds = Speeds()

    def cost_of(preset: str) -> tuple[core.FlowOptions, core.Cost]:
        options = options_of(preset, 0.1)
        return options, core.estimate_cost(core.Extent(0, 50.0, 50.0, 0.0), options)

    options, cost = cost_of("even")
    before = speeds.seconds(options, cost)
    speeds.learn(options, 100, 1000.0)
    assert speeds.seconds(options, cost) == before, "a small run says nothing"
    speeds.learn(options, round(cost.nodes), 3.0 * before)
    assert speeds.seconds(options, cost) == pytest.approx(3.0 * before, rel=1e-3)
    paper = cost_of("paper")
    assert speeds.seconds(*paper) == pytest.approx(3.0 * Speeds().seconds(*paper), rel=1e-3)
    speeds.learn(options, round(cost.nodes), before)
    assert before < speeds.seconds(options, cost) < 3.0 * before


def test_surfaces_without_area_have_no_points():
    vertices, faces = np.zeros((3, 3)), np.array([[0, 1, 2]])
    estimate = estimated(extent_of(vertices, faces), options_of("even", 0.1), True, Speeds())
    assert estimate.points == 0 and estimate.seconds < 1e-6


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


def test_blender_is_advised_against_where_it_would_hang():
    assert hanging_in_words(600_000, True) == ""
    assert "2 s" in hanging_in_words(620_000, True)
    words = hanging_in_words(3_000_000, True)
    assert "9 s" in words and "batch command" in words
    assert words.endswith(" --output curve.npz"), "the format that is written soonest"
    assert max(len(line) for line in words.splitlines()) <= 52 and words.count("\n") == 1


def test_a_bare_curve_hangs_it_later():
    assert hanging_in_words(2_000_000, False) == ""
    assert "10 s" in hanging_in_words(10_000_000, False)


def test_edges_are_counted_once():
    vertices, faces = geometry.icosphere(2)
    pairs = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique = np.unique(pairs, axis=0)
    lengths = np.linalg.norm(vertices[unique[:, 0]] - vertices[unique[:, 1]], axis=1).sum()
    extent = extent_of(vertices, faces)
    assert extent.edge_density * extent.node_area == pytest.approx(lengths)
    assert math.isclose(extent.length_area, 4.0 * math.pi, rel_tol=0.1)
    assert extent.faces == len(faces)


def grow_by_a_cosine(vertices):
    return np.exp(np.cos(3.0 * vertices[:, 0]))


@pytest.mark.parametrize("density", [None, grow_by_a_cosine])
def test_the_library_measures_the_same_extent(density):
    vertices, faces = geometry.icosphere(3)
    vertices = 7.0 * vertices * (1.0 + 0.2 * vertices[:, :1] ** 2)
    values = None if density is None else density(vertices)
    ours = extent_of(vertices, faces, values)
    with core.Surface(vertices, faces) as surface:
        theirs = surface.extent(values)
    assert theirs.faces == ours.faces
    for name in ("length_area", "node_area", "edge_density"):
        # Inside of the library vertices are rounded to 2^-30 of the diagonal.
        assert getattr(theirs, name) == pytest.approx(getattr(ours, name), rel=1e-7)
    # A defect is what is left of angles that nearly add up to a turn.
    assert theirs.curvature == pytest.approx(ours.curvature, rel=1e-4)


def test_the_curvature_of_a_sphere_is_four_pi_and_a_flat_sheet_has_none():
    vertices, faces = geometry.icosphere(4)
    assert extent_of(vertices, faces).curvature == pytest.approx(1.0, rel=0.01)
    assert extent_of(3.0 * vertices, faces).curvature == pytest.approx(1.0 / 9.0, rel=0.01)
    flat, squares = geometry.grid(12)
    assert extent_of(flat, squares).curvature < 1e-9


def test_a_full_start_takes_less_than_half_the_time():
    options = options_of("even", 0.1)
    extent = core.Extent(1000, 50.0, 50.0, 7.0)
    grown = core.estimate_cost(extent, options)
    options.start = core.Start.FULL
    full = core.estimate_cost(extent, options)
    assert 0.2 < full.processor_seconds / grown.processor_seconds < 0.5
    # Its segments are longer: five models and two tori have .84 to .95 of the nodes.
    assert 0.8 < full.nodes / grown.nodes < 0.95


@pytest.mark.parametrize("preset", ["even", "paper", "finest"])
def test_with_symmetry_only_one_half_takes_its_time(preset):
    """Measured, it takes .49 to .74 of the time of the whole: one half grows, and both are laid on
    the surface as one line."""
    vertices, faces = geometry.icosphere(4)
    extent, options = extent_of(vertices, faces), options_of(preset, 0.04)
    whole, symmetric = (estimated(extent, options, True, Speeds(), both) for both in (False, True))
    assert 0.4 < symmetric.seconds / whole.seconds < 0.75
    assert (symmetric.points, symmetric.memory) == (whole.points, whole.memory)
    problem = Problem(vertices, faces, options, mirror=mirror_of("x", None))
    told = []
    half = at_once(halving(problem, accept=told.append))
    assert told == [half.cost]
    assert half.cost.nodes == pytest.approx(cost_of(extent, options).nodes, rel=1e-6)
    seconds = cost_of(extent, options, True).processor_seconds
    assert half.cost.processor_seconds == pytest.approx(seconds, rel=1e-6)


def test_a_crumpled_surface_takes_longer():
    options = options_of("even", 0.1)
    plain = core.estimate_cost(core.Extent(0, 50.0, 50.0, 0.0), options)
    crumpled = core.estimate_cost(core.Extent(0, 50.0, 50.0, 0.0, 1e4), options)
    assert 1.3 < crumpled.processor_seconds / plain.processor_seconds < 2.5
    assert crumpled.nodes == plain.nodes


def test_what_a_mask_leaves_out_is_no_part_of_the_extent():
    vertices, faces = geometry.icosphere(3)
    prepared = core.SurfaceOptions()
    prepared.face_mask = vertices[faces].mean(axis=1)[:, 0] > 0.0
    with core.Surface(vertices, faces, prepared) as surface:
        extent, area = surface.extent(np.full(len(vertices), 4.0)), surface.statistics()["area"]
    assert extent.node_area == pytest.approx(4.0 * area)
    assert extent.length_area == pytest.approx(2.0 * area)


# Runs of the batch command from a full start, on tori like those of docs/performance.md, on two
# threads, and on a rough ball, on one: faces, length of edges over area, curvature, spacing;
# processor seconds, and bytes of the process.
MANY_FACES = [
    (100_110, 191.7, 4.1, 0.08, 2.0, 135e6),
    (1_000_386, 606.0, 16.9, 0.04, 9.3, 730e6),
    (1_000_386, 606.0, 16.9, 0.16, 6.0, 740e6),
    (2_999_250, 1049.2, 43.1, 0.04, 25.0, 1700e6),
    (2_999_250, 1049.2, 43.1, 0.08, 23.8, 1690e6),
    (9_999_808, 1915.8, 134.2, 0.04, 76.9, 5435e6),
    (1_002_528, 564.7, 128.8, 0.1334, 8.5, 943e6),  # a ball that is smoothed
]


@pytest.mark.parametrize("run", MANY_FACES)
def test_many_faces_take_what_they_have_taken(run):
    faces, edges, curvature, spacing, seconds, memory = run
    options = options_of("even", spacing)
    options.start = core.Start.FULL
    cost = core.estimate_cost(core.Extent(faces, 16.02, 16.02, edges, curvature), options)
    mesh = Problem(np.empty((faces // 2, 3)), np.empty((faces, 3), dtype=np.uint32), options)
    told = of_process(cost, mesh)
    assert 0.75 < told.processor_seconds / seconds < 1.34
    assert 0.75 < told.memory / memory < 1.34


def test_a_mesh_of_many_faces_says_nothing_of_the_speed():
    options, faces = options_of("even", 0.04), 3_000_000
    options.start = core.Start.FULL
    cost = core.estimate_cost(core.Extent(faces, 16.0, 16.0, 1050.0), options)
    speeds, usual = Speeds(), Speeds()
    speeds.learn(options, round(cost.nodes), usual.seconds(options, cost), faces)
    assert speeds.seconds(options, cost) == pytest.approx(usual.seconds(options, cost), rel=0.15)


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_a_cost_does_not_depend_on_the_unit(size):
    options = options_of("finest", 0.1 * size)
    options.segment_length = 0.3 * options.radius
    extent = core.Extent(1000, 5.0 * size**2, 6.0 * size**2, 7.0 / size, 80.0 / size**2)
    cost = core.estimate_cost(extent, options)
    plain = options_of("finest", 0.1)
    plain.segment_length = 0.3 * plain.radius
    expected = core.estimate_cost(core.Extent(1000, 5.0, 6.0, 7.0, 80.0), plain)
    assert cost.length / size == pytest.approx(expected.length)
    for name in ("nodes", "points", "memory", "processor_seconds"):
        assert getattr(cost, name) == pytest.approx(getattr(expected, name))


def test_a_limit_of_iterations_lowers_the_seconds_only():
    options = options_of("even", 0.1)
    extent = core.Extent(1000, 5.0, 5.0, 7.0)
    whole = core.estimate_cost(extent, options)
    options.iteration_limit = 10
    short = core.estimate_cost(extent, options)
    assert replace(short, processor_seconds=0.0) == replace(whole, processor_seconds=0.0)
    assert short.processor_seconds < 0.1 * whole.processor_seconds


@pytest.mark.parametrize("spacing", [1e-300, 1e-322])
def test_a_cost_without_a_number_is_infinite(spacing):
    cost = core.estimate_cost(core.Extent(1, 1.0, 1.0, 1.0), options_of("even", spacing))
    assert all(value == math.inf for value in vars(cost).values())


@pytest.mark.parametrize("largest", ["length_area", "node_area", "edge_density", "curvature"])
@pytest.mark.parametrize("spacing", [1e-3, 1e300])
def test_a_cost_is_a_number_or_infinite_whatever_the_extent(largest, spacing):
    extent = replace(core.Extent(0, 0.0, 0.0, 0.0), **{largest: sys.float_info.max})
    cost = core.estimate_cost(extent, options_of("even", spacing))
    assert not any(math.isnan(value) for value in vars(cost).values())


@pytest.mark.parametrize("figure", ["length_area", "node_area", "edge_density", "curvature"])
@pytest.mark.parametrize("wrong", [-1.0, math.nan, math.inf])
def test_figures_that_are_none_are_refused(figure, wrong):
    extent = replace(core.Extent(1, 1.0, 1.0, 1.0), **{figure: wrong})
    with pytest.raises(core.MeanderError, match="extent"):
        core.estimate_cost(extent, options_of("even", 0.1))


@pytest.mark.parametrize("spacing", [0.0, -1.0, math.nan, math.inf])
def test_a_spacing_that_is_none_is_refused(spacing):
    with pytest.raises(core.MeanderError, match="spacing"):
        core.estimate_cost(core.Extent(1, 1.0, 1.0, 1.0), options_of("even", spacing))


# A sphere, and what filling it is expected to take.
PREPARE = """
preset, spacing, subdivisions = given[:3]
vertices, faces = geometry.icosphere(int(subdivisions))
options = core.default_options(preset)
options.radius = float(spacing) / 2
options.iteration_limit = 40
if len(given) > 3:
    options.start = core.Start.FULL
"""
FILL = """
surface = core.Surface(vertices, faces)
told = core.estimate_cost(surface.extent(), options).memory
flow = core.Flow(surface, options)
flow.run()
"""


@peaks.linux_tells
@pytest.mark.parametrize(
    ("preset", "spacing", "subdivisions"), [("paper", 0.06, 4), ("paper", 0.4, 6), ("even", 0.4, 6)]
)
def test_the_memory_that_a_run_takes(preset, spacing, subdivisions):
    taken, expected = peaks.peak_of(PREPARE, FILL, preset, spacing, subdivisions)
    assert expected == pytest.approx(taken, rel=0.3)


@peaks.linux_tells
def test_the_memory_of_many_faces_from_a_full_start():
    taken, expected = peaks.peak_of(PREPARE, FILL, "even", 0.2, 7, "full")
    assert expected == pytest.approx(taken, rel=0.3)
