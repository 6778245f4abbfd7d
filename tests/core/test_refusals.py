# SPDX-License-Identifier: GPL-3.0-or-later
"""What cannot be used is refused with one sentence that names the element."""

from __future__ import annotations

from dataclasses import replace

import geometry
import numpy as np
import pytest
from flows import options_of
from meander import core
from sentences import assert_sentence

NAN, INF = float("nan"), float("inf")
SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]


def refused(call, *arguments, **keywords) -> core.MeanderError:
    with pytest.raises(core.MeanderError) as caught:
        call(*arguments, **keywords)
    assert_sentence(str(caught.value))
    return caught.value


# ------------------------------------------------------------------------------------------------
# Meshes


def test_wrong_arrays() -> None:
    good = geometry.grid(2)
    refused(core.Surface, good.vertices[:, :2], good.faces)
    refused(core.Surface, good.vertices, good.faces.ravel())
    refused(core.Surface, good.vertices, good.faces.astype(np.float64))
    # -1 must not turn into 4294967295.
    negative = good.faces.astype(np.int64)
    negative[0, 0] = -1
    refused(core.Surface, good.vertices, negative)


def test_other_integer_types_and_strides_are_taken() -> None:
    good = geometry.grid(2)
    surface = core.Surface(np.asfortranarray(good.vertices), good.faces.astype(np.int32)[::-1])
    assert surface.statistics()["faces"] == len(good.faces)


# ------------------------------------------------------------------------------------------------
# Options and density


@pytest.fixture(scope="module")
def square() -> core.Surface:
    return core.Surface(*geometry.grid(8))


def options_with(**changes) -> core.FlowOptions:
    return options_of(**{"radius": 0.05} | changes)


BAD_OPTIONS = [
    {"radius": NAN},
    {"radius": INF},
    {"radius": -0.1},
    {"radius": 20.0},  # spacing larger than the surface
    {"segment_length": -1.0},
    {"segment_length": 0.06},  # greater than r
    {"max_radius": 0.06},  # less than 1.5 r
    {"length_weight": -1.0},
    {"bending_weight": NAN},
    {"medial_weight": 0.0},
    {"step": 0.0},
    {"step": 2.5},
    {"tunings": {"growth_coarsening": 0.5}},
    {"tunings": {"hairpin_removal_gentleness": -0.1}},
    {"tunings": {"hairpin_removal_gentleness": 1.1}},
    {"tunings": {"hairpin_removal_gentleness": NAN}},
    {"tunings": {"polish_length_gain": "much"}},
    {"tunings": {"polish_length_game": 1.0}},
    {"iteration_limit": 0},
    {"iteration_limit": -1},
    {"iteration_limit": 2**40},
    {"threads": 257},
    {"threads": -1},
    {"threads": 1.5},
    {"stop_rule": 7},
    {"boundary_rule": 7},
    {"preset": "none"},
    {"radius": "wide"},
]


@pytest.mark.parametrize("changes", BAD_OPTIONS, ids=str)
def test_bad_option(square: core.Surface, changes: dict) -> None:
    error = refused(core.Flow, square, options_with(**changes))
    assert error.status == core.Status.INVALID_ARGUMENT


def test_unknown_preset() -> None:
    refused(core.default_options, "fast")


@pytest.mark.parametrize("bad", [0.0, -1.0, NAN, INF, 1e9])
def test_bad_density(square: core.Surface, bad: float) -> None:
    density = np.ones(square.vertex_count)
    density[5] = bad
    refused(core.Flow, square, options_with(), density=density)


@pytest.mark.parametrize(
    ("level", "word"), [(1e-12, "larger than the surface"), (1e10, "nodes"), (1e14, "nodes")]
)
def test_density_that_the_mesh_cannot_hold(level: float, word: str) -> None:
    """Such densities used to hang, or to fill the memory, before the first step."""
    mesh = geometry.cube()
    density = np.full(len(mesh.vertices), level)
    options = options_with(radius=0.1)
    error = refused(core.Flow, core.Surface(*mesh), options, density=density)
    assert error.status == core.Status.INVALID_ARGUMENT
    assert word in str(error)


def test_the_ends_of_the_ranges_are_taken(square: core.Surface) -> None:
    """1.5 r, computed in floating point, is not always 1.5 r again when it is divided by r."""
    for radius in np.linspace(0.05, 0.2, 61):
        options = options_with(radius=float(radius), max_radius=1.5 * float(radius))
        core.Flow(square, options).close()
        options.max_radius, options.segment_length = 1e6 * float(radius), float(radius)
        core.Flow(square, options).close()


@pytest.mark.parametrize("far", [1e100, 1e160, 1e300])
def test_seed_too_far_to_measure(square: core.Surface, far: float) -> None:
    seed = core.Seed(
        np.array([[0.2, 0.2, 0.0], [0.8, 0.2, 0.0], [far, 0.8, 0.0]]),
        np.array([0, 3], np.uint32),
        np.array([1], np.uint8),
    )
    error = refused(core.Flow, square, options_with(radius=0.1), seed)
    assert error.elements == (2,)
    assert len(str(error)) < 200


def test_density_of_the_wrong_length(square: core.Surface) -> None:
    refused(core.Flow, square, options_with(), density=np.ones(square.vertex_count - 1))
    refused(core.Flow, square, options_with(), density=np.ones((square.vertex_count, 1)))


# ------------------------------------------------------------------------------------------------
# Seeds


def seed_of(*strands, closed: bool = False) -> core.Seed:
    points = np.array([point for strand in strands for point in strand], dtype=np.float64)
    offsets = np.cumsum([0] + [len(strand) for strand in strands]).astype(np.uint32)
    return core.Seed(points, offsets, np.full(len(strands), closed, dtype=np.uint8))


BAD_SEEDS = {
    "off the surface": seed_of([[0.2, 0.2, 0], [0.5, 0.5, 0.3], [0.8, 0.8, 0]]),
    "crossing itself": seed_of([[0.2, 0.2, 0], [0.8, 0.8, 0], [0.8, 0.2, 0], [0.2, 0.8, 0]]),
    "crossing another": seed_of([[0.2, 0.2, 0], [0.8, 0.8, 0]], [[0.2, 0.8, 0], [0.8, 0.2, 0]]),
    "touching itself": seed_of([[0.2, 0.2, 0], [0.8, 0.2, 0], [0.8, 0.8, 0], [0.5, 0.2, 0]]),
    "closed with two points": seed_of([[0.2, 0.2, 0], [0.8, 0.2, 0]], closed=True),
    "open with one point": seed_of([[0.2, 0.2, 0]]),
    "same point twice": seed_of([[0.2, 0.2, 0], [0.2, 0.2, 0]]),
    "empty strand": seed_of([]),
    "NaN": seed_of([[0.2, 0.2, 0], [NAN, 0.5, 0]]),
}


@pytest.mark.parametrize("name", BAD_SEEDS)
def test_bad_seed(square: core.Surface, name: str) -> None:
    if name == "empty strand":
        BAD_SEEDS[name].points = np.empty((0, 3))
    error = refused(core.Flow, square, options_with(), BAD_SEEDS[name])
    assert error.status == core.Status.INVALID_SEED


@pytest.mark.parametrize("reach", [-1.0, NAN, INF])
def test_a_reach_that_is_no_length(square: core.Surface, reach: float) -> None:
    seed = replace(seed_of([[0.2, 0.2, 0], [0.8, 0.8, 0]]), max_distance=reach)
    error = refused(core.Flow, square, options_with(), seed)
    assert error.status == core.Status.INVALID_ARGUMENT


def test_seed_arrays_that_disagree(square: core.Surface) -> None:
    points = np.array([[0.2, 0.2, 0], [0.8, 0.2, 0]])
    for offsets, closed, fixed in (
        ([0, 3], [0], None),  # beyond the points
        ([0, 1], [0], None),  # short of them
        ([1, 2], [0], None),  # not from 0
        ([0, 2, 1, 2], [0, 0, 0], None),  # falling
        ([0, 2], [0, 0], None),  # more strands than offsets
        ([0], [], None),  # no strand
        ([0, 2], [0], [1]),  # too few flags
    ):
        seed = core.Seed(
            points,
            np.array(offsets, dtype=np.uint32),
            np.array(closed, dtype=np.uint8),
            None if fixed is None else np.array(fixed, dtype=np.uint8),
        )
        error = refused(core.Flow, square, options_with(), seed)
        assert error.status == core.Status.INVALID_SEED


@pytest.mark.parametrize(
    "vertices",
    [
        [[0, 0, 0], [1, 0, 0], [1, 1]],
        [[0, 0, 0], [1, 0, 0], "far"],
        [["a", "b", "c"]] * 3,
        [[None, None, None]] * 3,
        [[0, 0, 1j]] * 3,
        np.array([[1, 2, 3], [4, 5]], dtype=object),
        {"x": 1},
        None,
        "vertices",
        [[[0, 0, 0]]],
        np.zeros((3, 3), dtype="M8[s]"),
        object(),
    ],
)
def test_arrays_that_are_none(vertices) -> None:
    """Ragged ones and ones without numbers are a sentence of ours, wherever an array is taken."""
    faces = [[0, 1, 2]]
    refused(core.Surface, vertices, faces)
    refused(core.Surface, SQUARE, vertices)
    refused(core.find_faults, vertices, faces)
    refused(core.triangulated, vertices, [0, 1, 2], [3])
    if vertices is not None:
        refused(core.Surface, SQUARE, faces, core.SurfaceOptions(vertex_mask=vertices))
    with core.Surface(SQUARE, faces) as surface:
        options = options_of(radius=0.2)
        if vertices is not None:
            refused(core.Flow, surface, options, None, vertices)
            refused(surface.extent, vertices)
        refused(core.Flow, surface, options, core.Seed(vertices, [0, 3], [0]))
        refused(surface.extended_directions, vertices, [0, 3])


# ------------------------------------------------------------------------------------------------
# One cause, one wording


REPAIRED = core.SurfaceOptions(make_manifold=True, drop_degenerate=True, weld_distance=1e-9)
FLAT = {
    "a line": [[0, 0, 0], [1, 0, 0], [2, 0, 0]],
    "a point": [[1, 1, 1], [1, 1, 1], [1, 1, 1]],
    "a line aslant": [[0, 0, 0], [1, 2, 3], [-1, -2, -3]],
    "two corners": [[0, 0, 0], [1, 0, 0], [1, 0, 0]],
}


@pytest.mark.parametrize("name", FLAT)
def test_a_mesh_without_area_is_no_matter_of_merging(name: str) -> None:
    said = str(refused(core.Surface, FLAT[name], [[0, 1, 2]], REPAIRED))
    assert "No face of the mesh has an area" in said and "merge" not in said
    merged = replace(REPAIRED, merge_distance=10.0)
    assert "smaller merge distance" in str(refused(core.Surface, SQUARE, [[0, 1, 2]], merged))


@pytest.mark.parametrize("scale", [1e155, 1e160, 1e200, 1e300])
def test_a_mesh_of_astronomical_size_is_too_large(scale: float) -> None:
    said = str(refused(core.Surface, scale * np.array(SQUARE), [[0, 1, 2]], REPAIRED))
    assert "too large to measure; scale it down" in said


@pytest.mark.parametrize("spacing", [0.04, 0.5, 0.99])
def test_a_spacing_below_the_diagonal_is_not_said_to_be_above_it(spacing: float) -> None:
    strip = np.array([[0, 0, 0], [1, 0, 0], [1, 1e-3, 0], [0, 1e-3, 0]], dtype=float)
    options = replace(core.default_options("even"), radius=spacing / 2)
    with core.Surface(strip, [[0, 1, 2], [0, 2, 3]]) as surface:
        said = str(refused(core.Flow, surface, options))
        assert "diagonal" not in said and "square of the surface's area, which is 0.0316" in said
        options.radius = 1.5
        assert "its diagonal is 1)" in str(refused(core.Flow, surface, options))


@pytest.mark.parametrize("scale", [1e-140, 1e-30, 1e150])
def test_the_automatic_spacing_goes_with_the_size(scale: float) -> None:
    mesh = geometry.grid(4)
    wanted = core.automatic_spacing(*mesh)
    assert core.automatic_spacing(scale * mesh.vertices, mesh.faces) == pytest.approx(
        scale * wanted, rel=1e-9
    )
    assert core.automatic_spacing(1e-170 * mesh.vertices, mesh.faces) == pytest.approx(
        1e-170 * wanted, rel=1e-9
    )
    with core.Surface(scale * mesh.vertices, mesh.faces) as surface:
        flow = core.Flow(surface, core.default_options("even"))
        assert flow.statistics()["spacing_target"] == pytest.approx(scale * wanted, rel=1e-9)


def test_a_seed_that_comes_back_to_its_first_point_is_closed() -> None:
    ring = np.array([[0.2, 0.2, 0], [0.8, 0.2, 0], [0.8, 0.8, 0], [0.2, 0.8, 0], [0.2, 0.2, 0]])
    mesh, options = geometry.grid(8), replace(core.default_options("even"), radius=0.1)
    with core.Surface(*mesh) as surface:
        for closed in (0, 1):
            flow = core.Flow(surface, options, core.Seed(ring, [0, 5], [closed]))
            assert flow.polylines().closed.tolist() == [1]
            assert len(flow.nodes().faces) >= 4
        there_and_back = core.Seed(ring[[0, 1, 0]], [0, 3], [0])
        assert "crosses or touches itself" in str(
            refused(core.Flow, surface, options, there_and_back)
        )
