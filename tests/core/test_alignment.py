# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of a UV map, means of lines, and what terms do to options."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from meander import core
from meander.model import alignment, density
from meander.model.density import Choice
from sentences import assert_sentence


def test_uv_lines_are_those_of_the_map():
    """Random triangles whose coordinates are linear in space: u and v lines are known."""
    rng = np.random.default_rng(2)
    places = rng.normal(size=(50, 3, 3))
    frame = rng.normal(size=(50, 2, 3))  # du and dv in space
    uv = np.einsum("mck,mik->mci", places, frame)
    for axis in (0, 1):
        lines = alignment.uv_lines(places, uv, axis)
        a, b = places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]
        normals = np.cross(a, b)
        # In the face, the other coordinate constant, and as long as the root of twice the area.
        assert np.abs((lines * normals).sum(axis=1)).max() < 1e-9
        assert np.abs((lines * frame[:, 1 - axis]).sum(axis=1)).max() < 1e-9
        lengths = np.linalg.norm(lines, axis=1)
        assert lengths**2 == pytest.approx(np.linalg.norm(normals, axis=1))
    degenerate = np.zeros_like(uv)
    assert (alignment.uv_lines(places, degenerate, 0) == 0.0).all()


def test_the_mean_of_lines_ignores_their_signs():
    faces = np.array([[0, 1, 2], [0, 1, 2], [0, 3, 2]])
    lines = np.array([[1.0, 0.1, 0.0], [-1.0, 0.1, 0.0], [0.0, 0.0, 0.0]])
    mean = alignment.mean_lines(lines, faces, 5)
    assert np.abs(mean[:3]) == pytest.approx(np.array([[1.0, 0, 0]] * 3))
    assert (mean[3:] == 0.0).all()


@pytest.mark.parametrize("kind", density.CURVATURES)
def test_density_by_curvature(kind):
    """The ramp of the absolute curvature that the library gives, from 0 to its 95th percentile."""
    vertices, faces = geometry.icosphere(3)
    vertices = vertices * (1.0, 1.0, 2.0)
    choice = Choice("CURVATURE", kind, factors=(1.0, 0.25), smoothing=1.5)
    with core.Surface(vertices, faces) as surface:
        found = density.curvature_density(choice, 0.2)(surface)
        values = surface.curvature(f"absolute_{kind}", 0.3)
    top = np.sort(values)[int(0.95 * len(values)) :].min()
    for value, result in zip(values, found):
        if value > 1.05 * top:
            assert result == pytest.approx(16.0)
        factor = 1.0 - 0.75 * min(value / np.percentile(values, 95.0), 1.0)
        assert result == pytest.approx(1.0 / factor**2)
    # The tips of the ellipsoid bend most.
    assert found[np.argmax(np.abs(vertices[:, 2]))] > found[np.argmin(np.abs(vertices[:, 2]))]


def test_a_flat_surface_has_no_curvature_to_follow():
    vertices, faces = geometry.grid(6)
    turn, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    with core.Surface(vertices @ turn, faces) as surface:
        found = density.curvature_density(Choice("CURVATURE", "mean"), 0.1)(surface)
    assert (found == 1.0).all()


def _turned(mesh):
    """Anywhere, where its places are rounded."""
    turn, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    return geometry.Mesh((mesh.vertices @ turn).astype(np.float32), mesh.faces)


def test_what_bends_a_little_has_directions_of_curvature():
    """A sheet of which a tenth of a radian is seen from end to end."""
    mesh = geometry.grid(20)
    angle = 0.1 * mesh.vertices[:, 0] / np.ptp(mesh.vertices[:, 0])
    radius = np.ptp(mesh.vertices[:, 0]) / 0.1
    rolled = np.stack([radius * np.sin(angle), mesh.vertices[:, 1], radius * np.cos(angle)], axis=1)
    with core.Surface(rolled, mesh.faces) as surface:
        lines = surface.directions("curvature_min", 0.1)
    assert np.abs(lines[:, 1]).min() > 0.99


@pytest.mark.parametrize(
    ("mesh", "kind", "words"),
    [
        (geometry.grid(5), "curvature_min", "bends nowhere"),
        (geometry.grid(5), "curvature_max", "bends nowhere"),
        (_turned(geometry.grid(5)), "curvature_min", "bends nowhere"),
        (_turned(geometry.grid(30)), "curvature_max", "bends nowhere"),
        (geometry.icosphere(1), "boundary", "no boundary to run along"),
        (geometry.grid(1), "boundary", "is a corner of its boundary"),
    ],
)
def test_a_direction_that_is_nowhere_is_said_as_what_it_is(mesh, kind, words):
    """Nobody gave vectors, so none is to be other than 0."""
    with core.Surface(mesh.vertices, mesh.faces) as surface:
        with pytest.raises(core.MeanderError, match=words) as refusal:
            alignment.computed(kind)(surface)
    assert_sentence(str(refusal.value))
