# SPDX-License-Identifier: GPL-3.0-or-later
"""Every term of the energy does to the curve what it says."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from flows import flow_on, options_of
from meander import core
from numpy.typing import NDArray
from sentences import assert_sentence

SPACING = 0.06


def sheet(width: float, height: float) -> geometry.Mesh:
    """A flat rectangle of squares of about a spacing, each of two triangles."""
    across, up = round(width / SPACING), round(height / SPACING)
    return geometry.rectangle((0, 0), (width, height), across, up)


def grow(
    mesh: tuple[NDArray, NDArray],
    preset: str = "even",
    directions: NDArray | None = None,
    kind: str = "along",
    seed: core.Seed | None = None,
    **changes,
) -> tuple[core.Polylines, dict]:
    flow = flow_on(mesh, preset, seed=seed, radius=SPACING / 2, **changes)
    if directions is not None:
        flow.set_directions(directions, kind)
    flow.run()
    figures = flow.statistics()
    assert figures["crossings"] == 0
    return flow.polylines(), figures


def resampled(curve: core.Polylines, step: float) -> NDArray[np.float64]:
    """Points at even steps along the only strand, which is closed."""
    assert curve.closed.tolist() == [1]
    points = np.vstack([curve.positions, curve.positions[:1]])
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    at = np.linspace(0, along[-1], round(along[-1] / step), endpoint=False)
    return np.stack([np.interp(at, along, points[:, k]) for k in range(3)], axis=1)


def aligned_share(curve: core.Polylines, direction: tuple, degrees: float = 15) -> float:
    """The share of the length that lies within an angle of a direction."""
    points = np.vstack([curve.positions, curve.positions[:1]])
    chord = np.diff(points, axis=0)
    length = np.linalg.norm(chord, axis=1)
    near = np.abs(chord @ np.array(direction)) >= np.cos(np.radians(degrees)) * length
    return length[near].sum() / length.sum()


def tight_share(curve: core.Polylines) -> float:
    """The share of the length whose radius of curvature is below half of r."""
    r = SPACING / 2
    b = resampled(curve, 0.1 * r)
    a, c = np.roll(b, 2, axis=0), np.roll(b, -2, axis=0)
    sides = [np.linalg.norm(side, axis=1) for side in (b - a, c - b, c - a)]
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return np.mean(4 * area / np.prod(sides, axis=0) > 2 / r)


def corners(curve: core.Polylines) -> int:
    """Turns of more than 60 degrees within an arc length of r."""
    r = SPACING / 2
    points = resampled(curve, 0.1 * r)
    chord = np.roll(points, -2, axis=0) - points
    chord /= np.linalg.norm(chord, axis=1)[:, None]
    over = (chord * np.roll(chord, -10, axis=0)).sum(axis=1) < 0.5
    return int(np.sum(over & ~np.roll(over, 1)))


def median(figures: dict) -> float:
    return figures["spacing_median"] / SPACING


# ------------------------------------------------------------------------------------------------
# Field alignment


def test_the_curve_lies_along_a_field() -> None:
    mesh = sheet(3.0, 0.6)
    plain, _ = grow(mesh)
    field = np.tile([-2.0, 0, 0], (len(mesh[0]), 1))
    field[::3] *= -1  # signs do not matter
    curve, figures = grow(mesh, directions=field, alignment_weight=3.0)
    assert aligned_share(curve, (1, 0, 0)) > 0.9 > 0.75 > aligned_share(plain, (1, 0, 0))
    assert median(figures) == pytest.approx(1, abs=0.12)


def loop(x: float, y: float) -> core.Seed:
    """A closed strand of 6 x 1 spacings around a point of a sheet."""
    along = np.linspace(-3, 3, 20)
    lower = np.stack([along, 0 * along - 0.5, 0 * along], axis=1)
    points = np.concatenate([lower, lower[::-1] * [1, -1, 1]]) * SPACING + [x, y, 0]
    return core.Seed(points, np.array([0, len(points)], np.uint32), np.array([1], np.uint8))


@pytest.mark.parametrize("at", [0.25, 0.5])
def test_a_large_weight_leaves_little_but_turns(at: float) -> None:
    """Wherever it begins: of 33 spacings 2.3 have to turn, see docs/terms.md."""
    mesh = sheet(33 * SPACING, 17 * SPACING)
    field = np.tile([1.0, 0, 0], (len(mesh[0]), 1))
    seed = loop(at * 33 * SPACING, 8.5 * SPACING)
    curve, figures = grow(mesh, directions=field, seed=seed, alignment_weight=4.0)
    assert 1 - 2.3 / 33 + 0.02 > aligned_share(curve, (1, 0, 0)) > 0.84
    assert median(figures) == pytest.approx(1, abs=0.15)
    assert figures["spacing_p05"] > 0.5 * SPACING


def test_the_curve_lies_across_a_field() -> None:
    mesh = sheet(1.0, 1.0)
    field = np.tile([1.0, 0, 0], (len(mesh[0]), 1))
    curve, _ = grow(mesh, directions=field, kind="across", alignment_weight=2.0)
    assert aligned_share(curve, (0, 1, 0)) > 3 * aligned_share(curve, (1, 0, 0))


def test_a_field_without_weight_does_nothing() -> None:
    mesh = sheet(0.5, 0.5)
    field = np.tile([1.0, 0, 0], (len(mesh[0]), 1))
    with_field, _ = grow(mesh, directions=field, iteration_limit=20)
    plain, _ = grow(mesh, alignment_weight=1.0, iteration_limit=20)
    default, _ = grow(mesh, iteration_limit=20)
    assert with_field.positions.tobytes() == default.positions.tobytes()
    assert plain.positions.tobytes() == default.positions.tobytes()


@pytest.mark.parametrize(
    "field",
    [np.zeros((121, 3)), np.full((121, 3), np.nan), [[0.0, 0, 1]] * 121, np.ones((5, 3))],
    ids=["zero", "NaN", "upright", "too short"],
)
def test_fields_that_say_nothing_are_refused(field: NDArray) -> None:
    mesh = sheet(10 * SPACING, 10 * SPACING)
    assert len(mesh[0]) == 121
    flow = flow_on(mesh, radius=SPACING / 2)
    with pytest.raises(core.MeanderError) as refusal:
        flow.set_directions(field)
    assert_sentence(str(refusal.value))


def test_fields_come_before_the_first_step() -> None:
    mesh = sheet(0.6, 0.6)
    flow = flow_on(mesh, radius=SPACING / 2)
    flow.set_directions(np.ones((len(mesh[0]), 3)))
    flow.set_directions(None)
    flow.step()
    with pytest.raises(core.MeanderError, match="before the first iteration"):
        flow.set_directions(np.ones((len(mesh[0]), 3)))


# ------------------------------------------------------------------------------------------------
# Bending, powers, lengths


def test_bending_makes_turns_wider() -> None:
    mesh = sheet(1.0, 1.0)
    shares = [
        tight_share(grow(mesh, "paper", bending_weight=weight)[0]) for weight in (0, 0.1, 0.5)
    ]
    assert shares[0] > 1.5 * shares[1] > 2 * shares[2]


def test_even_curves_turn_round_a_circle_of_half_the_spacing() -> None:
    """Hairpins join strands 2 r apart, so none should turn more sharply than 1 / r (.009; .025 if
    bending weighs the same everywhere)."""
    r = SPACING / 2
    points = resampled(grow(sheet(1.0, 1.0), "even")[0], 0.1 * r)
    chord = (np.roll(points, -1, axis=0) - points)[:, :2]
    angle = np.unwrap(np.arctan2(chord[:, 1], chord[:, 0]))
    whole = angle[-1] - angle[0]
    window = 15  # 1.5 r
    turns = 2 * np.pi * np.round(whole / (2 * np.pi))
    after = np.concatenate([angle[window:], angle[:window] + turns])
    curvature = np.abs(after - angle) / 1.5
    assert np.mean(curvature > 0.8) > 0.05  # there are hairpins
    assert np.mean(curvature > 1.2) < 0.015


@pytest.mark.parametrize("preset", core.PRESETS[:2])
def test_powers_leave_the_spacing(preset: str) -> None:
    """The spacing of plain powers is 0.94 (even) and 0.88 to 0.99 (paper) of the target."""
    mesh = sheet(1.0, 1.0)
    for p, q in ((2, 2), (2, 3), (2, 6), (4, 2), (3, 4)):
        _, figures = grow(mesh, preset, length_power=p, medial_power=q)
        assert median(figures) == pytest.approx(0.95, abs=0.1), (p, q)


def test_weights_mean_the_same_at_every_scale() -> None:
    vertices, faces = sheet(0.6, 0.6)
    changes = {"bending_weight": 0.7, "length_weight": 0.2, "alignment_weight": 0.5,
               "medial_power": 3.0, "length_power": 3.0, "iteration_limit": 30}  # fmt: skip
    field = np.tile([1.0, 0.5, 0], (len(vertices), 1))
    curves = []
    for scale in (1.0, 1e-3, 1e3):
        options = options_of(**changes, radius=SPACING / 2 * scale)
        flow = core.Flow(core.Surface(vertices * scale, faces), options)
        flow.set_directions(field / scale)
        flow.run()
        curves.append(flow.polylines().positions / scale)
    for other in curves[1:]:
        np.testing.assert_allclose(other, curves[0], atol=1e-9)


def test_spacing_does_not_depend_on_the_segment_length() -> None:
    mesh = sheet(1.0, 1.0)
    medians = [
        median(grow(mesh, segment_length=share * SPACING / 2)[1]) for share in (0.15, 0.2, 0.3)
    ]
    assert max(medians) - min(medians) < 0.06


def test_a_wide_start_leaves_few_corners() -> None:
    mesh = sheet(1.5, 1.5)
    paper, paper_figures = grow(mesh, "paper")
    progressive, figures = grow(mesh, start_spacing_factor=4.0)
    assert median(figures) == pytest.approx(median(paper_figures), abs=0.1)
    assert figures["spacing_target"] == pytest.approx(SPACING)
    assert corners(progressive) < 0.5 * corners(paper)


# ------------------------------------------------------------------------------------------------
# Warnings


def test_defaults_give_no_warning() -> None:
    for preset in core.PRESETS:
        options = options_of(preset, radius=1.0)
        assert core.option_warnings(options) == []


@pytest.mark.parametrize(
    ("name", "value", "said", "fine"),
    [
        ("segment_length", 0.41, "0.205 of the spacing", 0.4),
        ("max_radius", 1.9, "0.95 times the spacing", 2.0),
        ("length_weight", 6.0, "is 6;", 1.0),
        ("bending_weight", 20.0, "is 20;", 2.0),
        ("alignment_weight", 6.0, "is 6;", 4.0),
    ],
)
def test_what_is_seldom_meant_is_said(name: str, value: float, said: str, fine: float) -> None:
    options = options_of(radius=1.0)
    setattr(options, name, value)
    (warning,) = core.option_warnings(options)
    assert_sentence(warning)
    assert said in warning
    setattr(options, name, fine)
    assert core.option_warnings(options) == []


# ------------------------------------------------------------------------------------------------
# Fields of a surface


def test_curvature_scales_with_the_mesh() -> None:
    angle = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    rings = [np.stack([np.cos(angle), np.sin(angle), 0 * angle + z], axis=1) for z in range(3)]
    vertices = np.vstack(rings)
    faces = []
    for ring in range(2):
        for k in range(48):
            a, b = 48 * ring + k, 48 * ring + (k + 1) % 48
            faces += [[a, b, b + 48], [a, b + 48, a + 48]]
    for scale in (1.0, 100.0):
        surface = core.Surface(scale * vertices, np.array(faces, dtype=np.uint32))
        middle = slice(48, 96)
        assert surface.curvature("mean")[middle] * scale == pytest.approx(0.5, rel=0.01)
        assert surface.curvature("gaussian")[middle] * scale**2 == pytest.approx(0, abs=1e-6)
        along, round_it = (surface.directions(kind) for kind in core.DIRECTIONS[:2])
        assert np.abs(along[middle, 2]) == pytest.approx(1, abs=1e-4)
        assert np.abs(round_it[middle, 2]) == pytest.approx(0, abs=1e-4)


@pytest.mark.parametrize("far", [40.0, 1e9, 1e86, 1.7e308])
def test_a_stroke_from_far_away_is_as_good_as_one_from_nearby(far: float) -> None:
    """It is looked at every half of an edge, but not where nothing is near."""
    surface = core.Surface(*sheet(0.3, 0.3))
    field = surface.extended_directions([[0.15, 0.15, 0], [far, 0.15, 0]], [0, 2])
    assert np.linalg.norm(field, axis=1) == pytest.approx(1)
    assert (np.abs(field[:, 0]) > 0.99).all()


def test_fields_refuse_what_they_do_not_know() -> None:
    surface = core.Surface(*sheet(0.3, 0.3))
    for call in (
        lambda: surface.curvature("sharp"),
        lambda: surface.curvature("mean", -1),
        lambda: surface.directions("smooth", 100.0),
        lambda: surface.extended_directions([[0, 0, 0]], [0, 2]),
        lambda: surface.extended_directions([[0, 0, np.nan], [1, 0, 0]], [0, 2]),
    ):
        with pytest.raises(core.MeanderError) as refusal:
            call()
        assert_sentence(str(refusal.value))


def test_fields_of_a_part_are_those_of_its_own_vertices() -> None:
    """What a mask leaves out has no direction, and needs none."""
    vertices, faces = sheet(1.2, 0.6)
    inside = vertices[:, 0] - 0.63  # cuts edges between two columns of vertices
    surface = core.Surface(vertices, faces, core.SurfaceOptions(vertex_mask=inside))
    directions = surface.directions("smooth")
    assert directions.shape == vertices.shape
    kept = inside >= 0
    assert np.linalg.norm(directions[kept], axis=1) == pytest.approx(1)
    assert np.linalg.norm(directions[inside < -SPACING], axis=1) == pytest.approx(0)
    directions[~kept] = np.nan
    options = options_of(radius=SPACING / 2, alignment_weight=1.0)
    flow = core.Flow(surface, options)
    flow.set_directions(directions)
    for _ in range(5):
        flow.step()
    assert flow.statistics()["crossings"] == 0
