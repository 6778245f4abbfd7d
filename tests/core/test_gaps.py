# SPDX-License-Identifier: GPL-3.0-or-later
"""Gaps: what they are, checked by brute force over samples of the surface."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from conftest import MODELS
from meander import core
from sentences import assert_sentence

# Samples of the curve are this far apart, those of the surface about as far (in r).
SAMPLES = 0.1


def flow_on(name: str) -> tuple[geometry.Mesh, float, core.Flow]:
    make, radius = MODELS[name]
    mesh = make()
    options = core.default_options()
    options.radius = radius
    with core.Surface(mesh.vertices, mesh.faces) as surface:
        return mesh, radius, core.Flow(surface, options)


@pytest.mark.parametrize("name", sorted(MODELS))
@pytest.mark.parametrize("steps", [5, 60])
def test_gaps_are_the_places_farthest_from_the_curve(name: str, steps: int) -> None:
    mesh, radius, flow = flow_on(name)
    with flow:
        for _ in range(steps):
            flow.step()
        gaps, curve = flow.gaps(1.05), flow.polylines()
    count = len(gaps)
    assert gaps.positions.shape == (count, 3)
    assert gaps.radii.shape == gaps.sizes.shape == gaps.faces.shape == (count,)
    assert (gaps.positions.dtype, gaps.sizes.dtype, gaps.faces.dtype) == (float, float, np.uint32)
    assert np.all(gaps.sizes >= 1.05) and np.all(np.diff(gaps.sizes) <= 0)
    np.testing.assert_allclose(gaps.sizes, gaps.radii / radius, rtol=1e-9)

    # On the surface, in the face that is named, and as far from the curve as it says.
    off = geometry.off_faces(mesh, gaps.positions)[np.arange(count), gaps.faces]
    assert off.max() <= 1e-9 * radius
    samples = geometry.samples_of(
        curve.positions, curve.offsets, curve.closed, gap=SAMPLES * radius
    )
    distance = geometry.distance_to_samples(gaps.positions, samples)
    assert np.abs(distance - gaps.radii).max() <= 0.05 * radius

    # No gap within a larger one, and nothing on the surface is farther than the largest.
    for k in range(1, count):
        apart = np.linalg.norm(gaps.positions[:k] - gaps.positions[k], axis=1)
        assert np.all(apart >= gaps.radii[:k] * (1 - 1e-9))
    points = geometry.sample_surface(mesh, 3000)
    farthest = geometry.distance_to_samples(points, samples).max()
    assert gaps.radii[0] >= farthest - 0.1 * radius


def test_a_filled_surface_has_small_gaps() -> None:
    _mesh, radius, flow = flow_on("torus")
    with flow:
        flow.step()
        assert flow.gaps().sizes[0] > 3
        flow.run()
        before = flow.polylines().positions.tobytes()
        gaps = flow.gaps()
        assert flow.polylines().positions.tobytes() == before
        assert len(flow.gaps(100.0)) == 0
    # Two hairpins before a straight strand that do not give way would leave 1.5.
    assert np.all((gaps.sizes >= 1.2) & (gaps.sizes < 1.6))
    np.testing.assert_allclose(gaps.radii, gaps.sizes * radius, rtol=1e-9)


@pytest.mark.parametrize("size", [0.5, -1.0, float("nan"), float("inf")])
def test_sizes_out_of_range_are_refused(size: float) -> None:
    _mesh, _radius, flow = flow_on("cube")
    with flow, pytest.raises(core.MeanderError) as refusal:
        flow.gaps(size)
    assert_sentence(str(refusal.value))
