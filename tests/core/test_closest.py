# SPDX-License-Identifier: GPL-3.0-or-later
"""The nearest points of triangles, by brute force; what they are of is in the caller's numbers."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from meander import core
from sentences import assert_sentence


def soup(count: int = 80) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangles that are no surface, some without area, and points among them."""
    random = np.random.default_rng(5)
    vertices = random.normal(size=(60, 3))
    faces = random.integers(0, 60, size=(count, 3)).astype(np.uint32)
    return vertices, faces, random.normal(size=(80, 3))


def test_they_are_those_of_brute_force() -> None:
    vertices, faces, points = soup()
    found = core.find_closest(vertices, faces, points)
    steps = np.linspace(0.0, 1.0, 21)
    weights = np.array([(1 - s, s * (1 - t), s * t) for s in steps for t in steps])
    samples = np.einsum("wk,fkd->fwd", weights, vertices[faces]).reshape(-1, 3)
    nearest = geometry.distance_to_samples(points, samples)
    assert np.all(found.distances <= nearest + 1e-12)
    assert np.all(nearest - found.distances < 0.15)
    places = geometry.points_at(geometry.Mesh(vertices, faces), found.faces, found.weights)
    assert np.linalg.norm(places - points, axis=1) == pytest.approx(found.distances, abs=1e-14)
    assert found.weights.min() >= 0.0
    for threads in (1, 2, 7):
        again = core.find_closest(vertices, faces, points, threads)
        assert all(a.tobytes() == b.tobytes() for a, b in zip(found, again, strict=True))


def test_a_millimetre_ten_kilometres_away() -> None:
    mesh = geometry.icosphere(3)
    vertices = mesh.vertices * 1e-3 + [1e4, 1e4, 0.0]
    middles = vertices[mesh.faces].mean(axis=1)
    found = core.find_closest(vertices, mesh.faces, middles)
    assert np.array_equal(found.faces, np.arange(len(mesh.faces)))
    assert found.distances.max() < 1e-11  # the coordinates' own rounding


def test_a_surface_tells_the_faces_that_were_passed() -> None:
    vertices, faces = geometry.icosphere(2)
    faces = np.array(faces)
    faces[::3] = faces[::3, ::-1]  # which the surface turns
    mask = vertices[faces].mean(axis=1)[:, 0] > 0.0
    points = 1.3 * vertices
    options = core.SurfaceOptions(face_mask=mask, split_bow_ties=True)
    with core.Surface(vertices, faces, options) as surface:
        found = surface.find_closest(points)
    assert mask[found.faces].all()
    mesh = geometry.Mesh(vertices, faces)
    places = geometry.points_at(mesh, found.faces, found.weights)
    assert np.linalg.norm(places - points, axis=1) == pytest.approx(found.distances)
    kept = core.find_closest(vertices, faces[mask], points)
    assert found.distances == pytest.approx(kept.distances, abs=1e-12)
    with pytest.raises(core.MeanderError):
        surface.find_closest(points)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_points_that_lie_nowhere_are_refused(bad: float) -> None:
    vertices, faces, points = soup()
    points[7, 1] = bad
    with pytest.raises(core.MeanderError) as caught:
        core.find_closest(vertices, faces, points)
    assert_sentence(str(caught.value))
    assert "Point 7 " in str(caught.value)


def test_a_cancel_ends_it() -> None:
    with core.Context() as context:
        context.cancel()
        with pytest.raises(core.MeanderError) as caught:
            core.find_closest(*soup(), context=context)
    assert caught.value.status == core.Status.CANCELLED


def test_meshes_of_nothing_are_refused() -> None:
    vertices, faces, points = soup()
    for of in ((vertices, faces[:0]), (vertices * np.nan, faces), (vertices[:9], faces)):
        with pytest.raises(core.MeanderError) as caught:
            core.find_closest(*of, points)
        assert_sentence(str(caught.value).rstrip("."))
