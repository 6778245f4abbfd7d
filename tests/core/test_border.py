# SPDX-License-Identifier: GPL-3.0-or-later
"""The distance that a curve keeps from the boundary."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from flows import options_of
from meander import core
from sentences import assert_sentence
from test_prepared_mesh import grid

SPACING = 0.2
HOLES = ((0.9, 0.9, 0.35), (2.1, 2.0, 0.45))  # x, y, radius


def distances(points: np.ndarray, curve: core.Polylines) -> np.ndarray:
    """Straight distances of the points from the curve, all pairs."""
    return geometry.distance_to_pieces(points, *geometry.ends_of(curve))


def square_outline(size: float = 3.0) -> np.ndarray:
    t = np.linspace(0.0, size, 120, endpoint=False)
    zero, full = np.zeros_like(t), np.full_like(t, size)
    sides = [(t, zero), (full, t), (t, full), (zero, t)]
    return np.vstack([np.stack([x, y, zero], axis=1) for x, y in sides])


def hole_outlines() -> np.ndarray:
    angle = np.linspace(0.0, 2.0 * np.pi, 100, endpoint=False)
    return np.vstack(
        [
            np.stack([x + r * np.cos(angle), y + r * np.sin(angle), 0.0 * angle], axis=1)
            for x, y, r in HOLES
        ]
    )


def with_holes() -> core.Surface:
    vertices, faces = grid(30)
    outside = [np.hypot(vertices[:, 0] - x, vertices[:, 1] - y) - r for x, y, r in HOLES]
    options = core.SurfaceOptions(vertex_mask=np.minimum(*outside))
    return core.Surface(vertices, faces, options)


def fill(surface: core.Surface, distance: float, spacing: float = SPACING) -> core.Flow:
    options = options_of(radius=spacing / 2, boundary_distance=distance)
    flow = core.Flow(surface, options)
    flow.run()
    assert flow.statistics()["crossings"] == 0
    return flow


def test_the_default_is_half_a_spacing() -> None:
    for preset in core.PRESETS:
        assert core.default_options(preset).boundary_distance == 0.5


@pytest.mark.parametrize("distance", [0.25, 0.5, 1.0, 2.0])
def test_strands_rest_at_the_distance_asked_for(distance: float) -> None:
    # 12 % of the distance, or 3 % of the spacing where that is more.
    tolerance = max(0.12 * distance, 0.03)
    spacing = 0.12 if distance > 1.0 else SPACING  # there has to be room between the strips
    curve = fill(core.Surface(*grid(1)), distance, spacing).polylines()
    outline = distances(square_outline(), curve) / spacing
    assert np.median(outline) == pytest.approx(distance, abs=tolerance)
    curve = fill(with_holes(), distance, spacing).polylines()
    outline = distances(square_outline(), curve) / spacing
    assert np.median(outline) == pytest.approx(distance, abs=tolerance)
    holes = distances(hole_outlines(), curve) / spacing
    # A round border bends its strands, which draws them outward by a little more.
    assert np.median(holes) == pytest.approx(distance, abs=1.25 * tolerance)


def border_edges(faces: np.ndarray) -> np.ndarray:
    sides = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, count = np.unique(sides, axis=0, return_counts=True)
    return edges[count == 1]


def distance_from_border(points: np.ndarray, vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    edges = border_edges(faces)
    return geometry.distance_to_pieces(points, vertices[edges[:, 0]], vertices[edges[:, 1]])


@pytest.mark.parametrize("cells", [1, 6, 15, 30])
def test_no_strand_stays_in_the_corner_where_it_began(cells: int) -> None:
    # The first face, where the curve begins, is one in the corner of the square.
    vertices, faces = grid(cells)
    curve = fill(core.Surface(vertices, faces), 0.5).polylines()
    assert distance_from_border(curve.positions, vertices, faces).min() > 0.5 * SPACING / 2
    assert distances(square_outline(), curve).max() < 1.7 * SPACING / 2


def test_strands_keep_away_from_corners_that_jut_out() -> None:
    vertices, faces = grid(15)
    middle = vertices[faces].mean(axis=1)
    holes = np.abs(middle[:, :2, None] - (0.85, 2.15)).min(axis=2).max(axis=1) < 0.3
    # Jagged edges; the outline of the square stays.
    inside = np.abs(vertices[:, :2] - 1.5).max(axis=1) < 1.49
    rng = np.random.default_rng(1)
    vertices[inside, :2] += rng.uniform(-0.06, 0.06, (inside.sum(), 2))
    faces = faces[~holes]
    curve = fill(core.Surface(vertices, faces), 0.5).polylines()
    assert distance_from_border(curve.positions, vertices, faces).min() > 0.5 * SPACING / 2
    edges = vertices[border_edges(faces)]
    points = np.vstack([(1 - t) * edges[:, 0] + t * edges[:, 1] for t in (0.0, 0.25, 0.5, 0.75)])
    assert distances(points, curve).max() < 1.8 * SPACING / 2


@pytest.mark.parametrize("rolled", [0.0, 0.625])
def test_strands_come_to_rest_between_two_corners(rolled: float) -> None:
    # Sixteen square holes on their corners, 1.6 r apart: there is hardly room for two strands.
    radius, half_diagonal, gap = 0.06, 4.0, 1.6
    at = 0.55 + radius * (2 * half_diagonal + gap) * np.arange(4)
    centres = np.stack(np.meshgrid(at, at), axis=-1).reshape(-1, 2)
    vertices, faces = grid(120)
    apart = np.abs(vertices[:, None, :2] - centres).sum(axis=2).min(axis=1)
    faces = np.roll(faces, -int(rolled * len(faces)), axis=0)  # the curve begins elsewhere
    options = core.SurfaceOptions(vertex_mask=apart - half_diagonal * radius)
    surface = core.Surface(vertices, faces, options)
    curve = fill(surface, 0.5, 2 * radius).polylines()
    corners = np.array([(1, 0), (0, 1), (-1, 0), (0, -1)]) * half_diagonal * radius
    points = (centres[:, None] + corners).reshape(-1, 2)
    points = np.column_stack([points, np.zeros(len(points))])
    assert distances(points, curve).min() > 0.5 * radius


def test_at_distance_0_strands_run_along_the_border() -> None:
    outline = distances(square_outline(), fill(with_holes(), 0.0).polylines()) / SPACING
    assert np.median(outline) < 0.03
    assert np.percentile(outline, 99) < 0.7


def test_a_strip_left_empty_on_purpose_is_no_gap() -> None:
    spacing = 0.12
    flow = fill(with_holes(), 2.0, spacing)
    near = distances(np.vstack([square_outline(), hole_outlines()]), flow.polylines())
    assert np.median(near) > 3.5 * spacing / 2  # which would be a gap anywhere else
    gaps = flow.gaps(2.0)
    to_corner = np.minimum(gaps.positions, 3.0 - gaps.positions)[:, :2].max(axis=1, initial=0.0)
    assert to_corner.max(initial=0.0) < spacing  # a corner is farther away than a side


@pytest.mark.parametrize(("spacing", "distance"), [(0.2, 2.0), (0.3, 1.0), (0.3, 1.5)])
def test_a_curve_does_not_begin_in_a_strip_to_be_left_empty(
    spacing: float, distance: float
) -> None:
    # The first face is in a corner of the square; from there the curve once found no way out.
    flow = fill(with_holes(), distance, spacing)
    assert flow.statistics()["stop_reason"] == "converged"
    assert flow.statistics()["length"] * spacing > 0.5 * 9


def test_the_density_scales_the_distance() -> None:
    vertices, faces = grid(1)
    options = options_of(radius=SPACING, boundary_distance=1.0)
    flow = core.Flow(core.Surface(vertices, faces), options, density=np.full(4, 4.0))
    flow.run()
    outline = distances(square_outline(), flow.polylines()) / SPACING
    assert np.median(outline) == pytest.approx(1.0, abs=0.12)


def test_distances_that_make_no_sense_are_refused() -> None:
    surface = core.Surface(*grid(2))
    for change in (
        {"boundary_distance": -0.1},
        {"boundary_distance": 2.1},
        {"boundary_distance": float("nan")},
        {"boundary_distance": 1.0, "boundary_rule": core.BoundaryRule.OBSTACLE},
    ):
        options = options_of(radius=SPACING / 2, **change)
        with pytest.raises(core.MeanderError, match="boundary_distance") as refusal:
            core.Flow(surface, options)
        assert_sentence(str(refusal.value))
