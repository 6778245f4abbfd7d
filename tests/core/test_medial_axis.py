# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances along the surface: every sheet is filled by itself, however near another one is."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from meander import core
from numpy.typing import NDArray

RADIUS = 0.06


def square(cells: int) -> geometry.Mesh:
    """The unit square in the plane z = 0."""
    x, y = np.meshgrid(np.linspace(0, 1, cells + 1), np.linspace(0, 1, cells + 1))
    vertices = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    corner = np.arange(cells * (cells + 1)).reshape(cells, cells + 1)[:, :-1].ravel()
    above = corner + cells + 1
    faces = [[corner, corner + 1, above + 1], [corner, above + 1, above]]
    return geometry.Mesh(vertices, np.hstack(faces).T.astype(np.uint32))


def plate(cells: int, thickness: float) -> geometry.Mesh:
    """A closed box over the unit square; the second half of the vertices is its lower side's."""
    vertices, faces = square(cells)
    n, row, edge = len(vertices), cells + 1, np.arange(cells)
    rim = np.concatenate(
        [edge, edge * row + cells, row * row - 1 - edge, (cells - edge) * row]
    )  # once round
    after = np.roll(rim, -1)
    walls = np.hstack([[rim, rim + n, after + n], [rim, after + n, after]]).T
    faces = np.concatenate([faces, faces[:, ::-1] + n, walls]).astype(np.uint32)
    return geometry.Mesh(np.concatenate([vertices, vertices - [0, 0, thickness]]), faces)


def crossing_sheets(cells: int) -> geometry.Mesh:
    """Two squares that pass through each other, at 35 degrees."""
    vertices, faces = square(cells)
    angle, y = np.radians(35), vertices[:, 1] - 0.5
    other = np.column_stack([vertices[:, 0], 0.5 + y * np.cos(angle), y * np.sin(angle) + 0.001])
    return geometry.Mesh(
        np.concatenate([vertices, other]), np.concatenate([faces, faces + np.uint32(len(vertices))])
    )


def grow(
    mesh: geometry.Mesh,
    axis: core.MedialAxis = core.MedialAxis.GEODESIC,
    radius: float = RADIUS,
) -> core.Flow:
    options = core.default_options("even")
    options.radius = radius
    options.medial_axis = axis
    flow = core.Flow(core.Surface(*mesh), options)
    assert flow.run() == "converged"
    return flow


def uncovered(mesh: geometry.Mesh, flow: core.Flow, faces: NDArray[np.bool_]) -> float:
    """The distance, in r, that all but 1 % of some faces keep from the nodes on the same faces."""
    nodes = flow.nodes()
    corners = mesh.vertices[mesh.faces[nodes.faces]]
    places = (corners * nodes.barycentrics[:, :, None]).sum(axis=1)[faces[nodes.faces]]
    if not len(places):
        return np.inf
    a, b, c = np.moveaxis(mesh.vertices[mesh.faces], 1, 0)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) * faces
    rng = np.random.default_rng(4)
    chosen = rng.choice(len(area), 1500, p=area / area.sum())
    weights = rng.dirichlet([1, 1, 1], 1500)
    samples = (mesh.vertices[mesh.faces[chosen]] * weights[:, :, None]).sum(axis=1)
    distance = np.linalg.norm(samples[:, None] - places[None], axis=2).min(axis=1)
    return float(np.quantile(distance, 0.99)) / RADIUS


SCENES = {
    "thin plate": plate(8, 0.2 * RADIUS),
    "thin plate of large faces": plate(2, 0.2 * RADIUS),
    "crossing sheets": crossing_sheets(9),
}


@pytest.mark.parametrize("name", SCENES)
def test_both_sides_are_filled(name: str) -> None:
    mesh = SCENES[name]
    half = len(mesh.vertices) // 2
    sides = mesh.faces.max(axis=1) < half, mesh.faces.min(axis=1) >= half
    along = grow(mesh)
    assert along.statistics()["crossings"] == 0
    # Nodes are up to 2 h = 0.4 r apart, so this is about 1.3 r from the curve itself.
    assert max(uncovered(mesh, along, side) for side in sides) < 1.35
    through = grow(mesh, core.MedialAxis.EUCLIDEAN)
    assert max(uncovered(mesh, through, side) for side in sides) > 1.7


def test_an_empty_side_of_a_plate_is_a_gap_along_the_surface() -> None:
    """The same curve, laid with both kinds of distance: through space one side covers the other."""
    mesh = SCENES["thin plate"]
    vertices = mesh.vertices
    curve = grow(mesh, core.MedialAxis.EUCLIDEAN).polylines()
    seed = core.Seed(curve.positions, curve.offsets, curve.closed)
    found = {}
    for axis in core.MedialAxis:
        options = core.default_options("even")
        options.radius = RADIUS
        options.medial_axis = axis
        flow = core.Flow(core.Surface(*mesh), options, seed=seed)
        nodes = flow.polylines().positions
        found[axis] = flow.gaps()
        assert flow.gaps().sizes.tobytes() == found[axis].sizes.tobytes()
    through, along = found[core.MedialAxis.EUCLIDEAN], found[core.MedialAxis.GEODESIC]
    assert np.max(through.sizes, initial=0) < 1.5
    assert along.sizes[0] > 1.7
    # The nearest node on its own side of the plate is not much farther than the curve there.
    middle = (vertices[:, 2].min() + vertices[:, 2].max()) / 2
    for place, radius in zip(along.positions[:5], along.radii):
        same_side = nodes[(nodes[:, 2] > middle) == (place[2] > middle)]
        distance = np.linalg.norm(same_side - place, axis=1).min()
        assert radius <= distance + 1e-9
        assert radius > min(distance - 0.4 * RADIUS, 2.99 * RADIUS)  # sizes end at 3 here


def test_any_number_of_threads_gives_the_same_bytes() -> None:
    options = core.default_options("even")
    options.radius = RADIUS
    options.medial_axis = core.MedialAxis.GEODESIC
    surface = core.Surface(*SCENES["thin plate"])
    curves = []
    for threads in (1, 3):
        options.threads = threads
        flow = core.Flow(surface, options)
        for _ in range(40):
            flow.step()
        curves.append(flow.polylines().positions.tobytes())
    assert curves[0] == curves[1]


def test_looking_at_a_flow_changes_nothing() -> None:
    options = core.default_options("even")
    options.radius = 0.1
    options.medial_axis = core.MedialAxis.GEODESIC
    surface = core.Surface(*geometry.torus(24, 12))
    left_alone, watched = core.Flow(surface, options), core.Flow(surface, options)
    for _ in range(30):
        left_alone.step()
        watched.step()
        watched.statistics()
    assert left_alone.polylines().positions.tobytes() == watched.polylines().positions.tobytes()


def test_noise_in_the_vertices_does_not_matter() -> None:
    """Normals that point anywhere: every vertex is moved by up to 0.3 edge lengths."""
    smooth = geometry.icosphere(3)
    edge = np.linalg.norm(np.diff(smooth.vertices[smooth.faces[:, :2]], axis=1), axis=2).mean()
    rng = np.random.default_rng(1)
    away = rng.normal(size=smooth.vertices.shape)
    away *= 0.3 * edge / np.linalg.norm(away, axis=1)[:, None]
    away *= rng.random((len(away), 1)) ** (1 / 3)
    mesh = geometry.Mesh(smooth.vertices + away, smooth.faces)
    everything = np.ones(len(mesh.faces), dtype=bool)
    radius = 1.5 * edge
    for axis in core.MedialAxis:
        flow = grow(mesh, axis, radius=radius)
        assert flow.statistics()["crossings"] == 0
        # Of the nodes, see above.
        assert uncovered(mesh, flow, everything) * RADIUS / radius < 1.35
