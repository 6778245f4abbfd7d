# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances in images of a folded sheet: unrolled it is a square, where its ways are straight."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from flows import flow_on
from meander import core

SPACING, FOLDS = 0.1, 20


def folded(angles: np.ndarray) -> tuple[geometry.Mesh, geometry.Mesh]:
    """A sheet of strips across, each at one of these angles to the ground, and the unit square that
    it unrolls to."""
    flat = geometry.rectangle((0.0, 0.0), (1.0, 1.0), len(angles), len(angles))
    steps = np.column_stack([np.cos(angles), np.sin(angles)]) / len(angles)
    way = np.vstack([np.zeros(2), np.cumsum(steps, axis=0)])
    at = way[np.rint(flat.vertices[:, 0] * len(angles)).astype(int)]
    vertices = np.column_stack([at[:, 0], flat.vertices[:, 1], at[:, 1]])
    return geometry.mesh(vertices, flat.faces), flat


@pytest.mark.parametrize(
    "angles",
    [np.tile([0.3, -0.3], FOLDS // 2), np.linspace(0.0, 5.0, FOLDS)],
    ids=["pleats", "roll"],
)
def test_distances_lead_over_folds(angles: np.ndarray) -> None:
    """At places spread over the area, and at the vertices halfway between two turns."""
    sheet, flat = folded(angles)
    with flow_on(sheet, radius=SPACING / 2, iteration_limit=120) as flow:
        flow.run()
        cut = core.cut_surface(flow, SPACING / 8, middle_lines=True)
        ordinary = len(core.cut_surface(flow, SPACING / 8, middle_lines=False).positions)
    corners = flat.faces[cut.vertex_faces]
    unrolled = np.einsum("nk,nkx->nx", cut.vertex_weights, flat.vertices[corners])[:, :2]
    a, b = np.moveaxis(unrolled[cut.line_edges()], 1, 0)
    areas = geometry.triangle_areas(cut.positions, cut.faces)
    rng = np.random.default_rng(1)
    faces = rng.choice(len(areas), 20_000, p=areas / areas.sum()).astype(np.int32)
    weights = rng.dirichlet([1.0, 1.0, 1.0], len(faces)).astype(np.float32)
    places = np.einsum("nk,nkx->nx", weights, unrolled[cut.faces[faces]])
    true = np.minimum(geometry.distance_to_pieces(places, a, b) / SPACING, 1.0)
    off = core.cut_places(cut, SPACING, faces, weights, False).distances / SPACING - true
    assert (np.abs(off) < 0.01).mean() > 0.99
    # The vertices between two turns lie where the ways to both are equally long.
    between = slice(ordinary, None)
    off = cut.distances[between] - geometry.distance_to_pieces(unrolled[between], a, b)
    assert len(off) > 1000 and (np.abs(off) < 0.01 * SPACING).mean() > 0.97
