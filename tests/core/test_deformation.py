# SPDX-License-Identifier: GPL-3.0-or-later
"""A moving surface and the data of every point, through the bridge."""

import numpy as np
import pytest
from meander import core


def _tube(around=28, along=22, height=5.0):
    angles = 2 * np.pi * np.arange(around) / around
    levels = np.linspace(0.0, height, along + 1)
    vertices = np.array([[np.cos(a), np.sin(a), z] for z in levels for a in angles])
    faces = []
    for j in range(along):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            faces += [[a, b, b + around], [a, b + around, a + around]]
    return vertices, np.array(faces, dtype=np.uint32)


def _area(vertices, faces):
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


@pytest.fixture
def grown():
    vertices, faces = _tube()
    options = core.default_options()
    options.radius = 0.25
    options.threads = 1
    with core.Surface(vertices, faces) as surface:
        flow = core.Flow(surface, options)
    with flow:
        flow.run()
        yield vertices, faces, flow


def test_spacing_stays_even_while_the_surface_stretches(grown):
    vertices, faces, flow = grown
    for frame in range(1, 9):
        moved = vertices * [1.0, 1.0, 1.0 + frame / 8]
        flow.set_vertices(moved)
        for _ in range(4):
            flow.step()
        figures = flow.statistics()
        assert figures["crossings"] == 0
        assert figures["polishing"]
        # The curve lags behind by a few percent, more or less with the face it began in.
        assert 0.93 < 0.5 * figures["length"] / _area(moved, faces) < 1.05
        assert figures["spacing_target"] == pytest.approx(0.5)
    # Left alone, it catches up: 1.045 to 1.056 from six first faces.
    assert flow.run() == "converged"
    assert 0.98 < 0.5 * flow.statistics()["length"] / _area(moved, faces) < 1.07


def test_guides_ride_along_and_are_cut_as_finely_as_the_surface_stretches():
    """On faces that stretch evenly a straight guide stays straight, and on its faces."""
    vertices, faces = _tube()
    up = np.column_stack([np.full(30, 0.98), np.full(30, 0.1), np.linspace(0.6, 4.4, 30)])
    seed = core.Seed(up, np.array([0, 30], np.uint32), np.array([0], np.uint8))
    seed.guides, seed.loops = np.ones(1, dtype=np.uint8), True
    options = core.default_options()
    options.radius, options.segment_length = 0.25, 0.05
    with core.Surface(vertices, faces) as surface:
        flow = core.Flow(surface, options, seed)
    with flow:
        flow.run()
        curve = flow.polylines()
        first = curve.positions[curve.offsets[0] : curve.offsets[1]]
        for stretch in (1.3, 2.0, 3.0):
            factors = np.array([1.0, 1.0, stretch])
            flow.set_vertices(vertices * factors)
            for _ in range(5):
                flow.step()
            assert flow.statistics()["crossings"] == 0
            curve = flow.polylines()
            moved = curve.positions[curve.offsets[0] : curve.offsets[1]]
            lengths = np.linalg.norm(np.diff(moved, axis=0), axis=1)
            assert lengths.max() < 2.01 * 0.05
            distance = np.linalg.norm(moved[None] - (first * factors)[:, None], axis=2).min(axis=1)
            assert distance.max() < 1e-6  # where it was drawn it still is
        # Nothing grows nearer to it than to itself.
        rest = curve.positions[curve.offsets[1] :]
        assert np.linalg.norm(rest[:, None] - moved[None], axis=2).min() > 0.5 * 0.25


def test_refusals_are_sentences_and_leave_the_flow_alone(grown):
    vertices, _faces, flow = grown
    before = flow.polylines().positions
    for wrong, words in (
        (vertices[:-1], "vertices now and had"),
        (vertices * [1.0, 1.0, 0.0], "no area"),
        (vertices * 0.01, "below the spacing"),
        (np.where(np.arange(len(vertices))[:, None] == 5, np.nan, vertices), "Vertex 5"),
        (vertices[:, :2], "vertices"),
    ):
        with pytest.raises(core.MeanderError, match=words):
            flow.set_vertices(wrong)
    assert np.array_equal(flow.polylines().positions, before)
    flow.start()
    with pytest.raises(core.MeanderError, match="wait"):
        flow.set_vertices(vertices)
    flow.wait()


def test_point_data_belong_to_the_polylines(grown):
    vertices, faces, flow = grown
    curve, data = flow.polylines(), flow.point_data()
    rebuilt = np.einsum("nk,nkj->nj", data.barycentrics, vertices[faces[data.faces]])
    assert np.allclose(rebuilt, curve.positions, atol=1e-12)
    assert np.array_equal(data.normals, curve.normals)
    assert np.allclose(np.linalg.norm(data.tangents, axis=1), 1.0)
    pieces = np.linalg.norm(np.diff(curve.positions, axis=0), axis=1)
    inside = np.ones(len(pieces), dtype=bool)
    inside[curve.offsets[1:-1].astype(int) - 1] = False
    assert np.allclose(np.diff(data.arc_lengths)[inside], pieces[inside])
    # Spacings of 0.5 leave half of it on both sides.
    assert 0.2 < np.median(data.radii) < 0.3


def test_a_prepared_part_of_a_mesh_follows_the_whole_mesh():
    vertices, faces = _tube()
    heights = vertices[:, 2].copy()
    preparation = core.SurfaceOptions(vertex_mask=5.0 - heights, mask_threshold=1.9)
    options = core.default_options()
    options.radius = 0.3
    with core.Surface(vertices, faces, preparation) as surface:
        flow = core.Flow(surface, options)
    with flow:
        flow.run()
        for stretch in (1.2, 1.4):
            moved = vertices * [1.0, 1.0, stretch]
            flow.set_vertices(moved)
            flow.step()
            flow.step()
            curve, data = flow.polylines(), flow.point_data()
            rebuilt = np.einsum("nk,nkj->nj", data.barycentrics, moved[faces[data.faces]])
            assert np.allclose(rebuilt, curve.positions, atol=1e-9)
            # The mask's edge runs through faces, and rides with them.
            assert 2.7 * stretch < curve.positions[:, 2].max() < 3.1001 * stretch
            assert flow.statistics()["crossings"] == 0
        with pytest.raises(core.MeanderError, match="vertices now and had"):
            flow.set_vertices(moved[:-1])
