# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes with faults are repaired in a copy and filled; those without stay as they are."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from flows import options_of
from meander import core
from meander.model import preparation
from meander.model.preparation import Repair, Share, seam_width

RADIUS = 0.12


def grow(vertices: np.ndarray, faces: np.ndarray, repair: Repair | None) -> tuple[core.Flow, dict]:
    """A short run, its mesh repaired first; None: the mesh as it is."""
    options = options_of(radius=RADIUS, iteration_limit=10)
    prepared = repair.options(vertices, RADIUS) if repair else None
    surface = core.Surface(vertices, faces, prepared)
    flow = core.Flow(surface, options)
    flow.run()
    return flow, surface.statistics()


def broken(generator: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """A sphere, parts of it a soup, with fins, flat and doubled faces, and bow-ties."""
    vertices, faces = (np.asarray(part) for part in geometry.icosphere(2)[:2])
    points, triangles = [*vertices.tolist()], faces.tolist()
    for f in generator.choice(len(triangles), 40, replace=False).tolist():  # loose from the rest
        corners = [len(points) + k for k in range(3)]
        points += (vertices[faces[f]] + generator.uniform(-1e-6, 1e-6, (3, 3))).tolist()
        triangles[f] = corners
    for f in generator.choice(len(faces), 6, replace=False).tolist():
        a, b, c = faces[f].tolist()
        points.append((1.4 * vertices[a]).tolist())
        triangles += [[a, b, len(points) - 1]]  # a fin
        triangles += [[b, c, b], [c, a, b]]  # without area, and doubled
        points += [(1.3 * vertices[c] + d).tolist() for d in ([0.2, 0, 0], [0, 0.2, 0])]
        triangles += [[c, len(points) - 2, len(points) - 1]]  # touches in c only
    return np.array(points), np.array(triangles, dtype=np.uint32)


@pytest.mark.parametrize("number", range(4))
def test_a_curve_fills_what_was_broken(number: int) -> None:
    vertices, faces = broken(np.random.default_rng(number))
    with pytest.raises(core.MeanderError):
        core.Surface(vertices, faces)
    flow, figures = grow(vertices, faces, Repair())
    assert flow.statistics()["crossings"] == 0
    assert all(figures[key] > 0 for key in ("dropped_faces", "cut_edges", "welded_edges"))
    # The sphere is one again, and all else lies beside it: nothing of its area has gone.
    areas = geometry.triangle_areas(vertices, faces)
    _kept, first = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    assert figures["area"] == pytest.approx(areas[first].sum(), rel=0.02)
    assert figures["boundary_loops"] <= 6 + 6 + 6  # of the fins, the ties, and around the fins
    # Nodes name the faces that were passed, and lie where these are.
    nodes = flow.nodes()
    positions = np.einsum("nk,nkj->nj", nodes.barycentrics, vertices[faces[nodes.faces]])
    curve = flow.polylines().positions
    gaps = np.linalg.norm(positions[:, None] - curve[None], axis=2).min(axis=1)
    assert gaps.max() < 1e-4


def test_meshes_without_faults_grow_the_same_curve_to_the_last_bit() -> None:
    for mesh in (geometry.icosphere(2), geometry.torus(24, 12), geometry.grid(8)):
        vertices, faces = np.asarray(mesh[0], dtype=float), np.asarray(mesh[1])
        plain, _ = grow(vertices, faces, None)
        mended, figures = grow(vertices, faces, Repair())
        assert plain.polylines().positions.tobytes() == mended.polylines().positions.tobytes()
        assert figures["welded_edges"] == figures["split_vertices"] == figures["dropped_faces"] == 0


def test_a_one_sided_surface_is_opened_along_a_line() -> None:
    vertices, faces = geometry.moebius(24)
    with pytest.raises(core.MeanderError, match="one side"):
        grow(vertices, faces, Repair(strict=True))
    flow, figures = grow(vertices, faces, Repair())
    # Across the strip, which is one face wide, and nowhere else: one strip with one border.
    assert figures["opened_edges"] == 1
    assert (figures["components"], figures["boundary_loops"]) == (1, 1)
    assert flow.statistics()["crossings"] == 0


def test_strict_refuses_and_all_faults_are_named_in_words() -> None:
    vertices, faces = broken(np.random.default_rng(9))
    with pytest.raises(core.MeanderError):
        grow(vertices, faces, Repair(strict=True))
    found = core.find_faults(vertices, faces, seam_width(vertices, RADIUS))
    text = preparation.faults_in_words(found)
    assert text.startswith("6 faces without area, ")
    assert "places where more than two faces share an edge" in text and " and " in text
    assert not any(word in text for word in ("vertex 1", "index", "manifold"))
    assert "turn off Strict" in preparation.refusal("Ball", found, strict=True)
    # Faults that Strict refuses are those without which it does not.
    clean = geometry.icosphere(2)
    none = core.find_faults(clean[0], clean[1], seam_width(np.asarray(clean[0]), RADIUS))
    assert not len(none.kinds) and preparation.faults_in_words(none) == ""


def test_there_may_be_more_faults_than_room_is_offered_at_first() -> None:
    whole = geometry.icosphere(3)
    vertices = whole.vertices[whole.faces].reshape(-1, 3)
    faces = np.arange(len(vertices)).reshape(-1, 3)
    found = core.find_faults(vertices, faces, 1e-6)
    assert len(found.kinds) == faces.size > 1024
    assert set(found.kinds.tolist()) == {core.FAULTS.index("seam")}
    # Every edge of every face is one of them, once.
    edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    assert np.array_equal(np.unique(edges, axis=0), np.unique(found.elements, axis=0))


def test_repaired_meshes_may_move() -> None:
    vertices, faces = broken(np.random.default_rng(3))
    flow, _figures = grow(vertices, faces, Repair())
    moved = vertices * [1.2, 1.0, 0.8]
    flow.set_vertices(moved)
    flow.step()
    nodes, curve = flow.nodes(), flow.polylines().positions
    positions = np.einsum("nk,nkj->nj", nodes.barycentrics, moved[faces[nodes.faces]])
    assert np.linalg.norm(positions[:, None] - curve[None], axis=2).min(axis=1).max() < 1e-4
    assert flow.statistics()["crossings"] == 0


def test_bad_arguments_are_refused() -> None:
    vertices, faces = np.eye(3), np.array([[0, 1, 2]])
    for options, word in (
        (core.SurfaceOptions(weld_distance=-1.0), "weld distance"),
        (core.SurfaceOptions(weld_distance=float("nan")), "weld distance"),
    ):
        with pytest.raises(core.MeanderError, match=word):
            core.Surface(vertices, faces, options)
    with pytest.raises(core.MeanderError, match="weld distance"):
        core.find_faults(vertices, faces, -1.0)
    with pytest.raises(core.MeanderError, match="refers to vertex 7"):
        core.find_faults(vertices, [[0, 1, 7]])
    with pytest.raises(core.MeanderError, match="no faces"):
        core.find_faults(vertices, np.empty((0, 3), np.uint32))


# ------------------------------------------------------------------------------------------------
# T-junctions, doubled faces, small parts


def strip(xs: list[float], low: float, high: float) -> tuple[np.ndarray, np.ndarray]:
    """A sheet over [0, 1], its lower edge with vertices at xs, fanned from its upper corners."""
    points = [(x, low, 0.0) for x in xs] + [(0.0, high, 0.0), (1.0, high, 0.0)]
    count, left, right = len(xs), len(xs), len(xs) + 1
    middle = count // 2
    faces = [(k, k + 1, left if k < middle else right) for k in range(count - 1)]
    faces.append((left, middle, right))
    return np.array(points), np.array(faces, dtype=np.uint32)


def side_by_side(*sheets: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    shift, vertices, faces = 0, [], []
    for points, triangles in sheets:
        vertices.append(points)
        faces.append(triangles + np.uint32(shift))
        shift += len(points)
    return np.concatenate(vertices), np.concatenate(faces)


def placed(vertices: np.ndarray, generator: np.random.Generator, scale: float) -> np.ndarray:
    axes, _ = np.linalg.qr(generator.normal(size=(3, 3)))
    return scale * (vertices @ axes.T) + scale * generator.normal(size=3)


@pytest.mark.parametrize("number", range(6))
@pytest.mark.parametrize("scale", [1e-4, 1.0, 1e4])
def test_a_crack_between_edges_of_different_division_is_closed(number: int, scale: float) -> None:
    """Two sheets along one line, each with vertices where the other has none, and where it has."""
    generator = np.random.default_rng(number)
    shared = generator.uniform(0.05, 0.95, 2)
    ours, theirs = (
        sorted({0.0, 1.0, *shared, *generator.uniform(0.0, 1.0, count)})
        for count in generator.integers(0, 9, 2)
    )
    upper, lower = strip(ours, 0.0, 1.0), strip(theirs, 0.0, -0.7)
    vertices, faces = side_by_side(upper, (lower[0], lower[1][:, ::-1]))
    vertices = placed(vertices, generator, scale)
    options = Repair().options(vertices, 0.06 * scale)
    with core.Surface(vertices, faces, options) as surface:
        figures = surface.statistics()
        again = surface.outlines(0.05 * scale, 0.1 * scale)[0]
    assert (figures["components"], figures["boundary_loops"]) == (1, 1)
    assert figures["area"] == pytest.approx(1.7 * scale**2, rel=1e-9)
    apart = len(set(ours) ^ set(theirs))
    assert (figures["split_edges"] > 0) == (apart > 0)
    assert len(again.closed) == 1


def test_sheets_that_share_vertices_and_have_a_t_between_them() -> None:
    """The same corners by number, and a vertex halfway that only one side has."""
    vertices = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.5, 0, 0), (0.5, -1, 0)], dtype=float)
    faces = np.array([(0, 1, 2), (0, 4, 3), (3, 4, 1)], dtype=np.uint32)
    with core.Surface(vertices, faces, Repair().options(vertices, 0.1)) as surface:
        figures = surface.statistics()
    assert (figures["components"], figures["split_edges"], figures["faces"]) == (1, 1, 4)
    assert figures["welded_edges"] == 0


def test_values_of_vertices_follow_where_an_edge_was_split() -> None:
    """The weights of a piece are those of the caller's face: a density of it is linear."""
    vertices, faces = side_by_side(
        strip([0.0, 1.0], 0.0, 1.0), strip([0.0, 0.3, 0.7, 1.0], 0.0, -1.0)
    )
    options = options_of(radius=0.05, iteration_limit=20)
    prepared = Repair().options(vertices, 0.05)
    with core.Surface(vertices, faces, prepared) as surface, core.Flow(surface, options) as flow:
        assert surface.statistics()["components"] == 1
        flow.run()
        nodes, curve = flow.nodes(), flow.polylines()
    places = np.einsum("nk,nkj->nj", nodes.barycentrics, vertices[faces[nodes.faces]])
    for place in places[:: max(1, len(places) // 50)]:
        assert np.linalg.norm(curve.positions - place, axis=1).min() < 1e-9


def test_what_only_touches_an_edge_is_no_crack() -> None:
    """A corner on an edge of another sheet, and sheets that lie on each other."""
    corner = (
        np.array([(0.5, 0, 0), (0.8, -1, 0), (0.2, -1, 0)], dtype=float),
        np.array([(0, 1, 2)], dtype=np.uint32),
    )
    sheet = strip([0.0, 1.0], 0.0, 1.0)
    upon = strip([0.0, 0.5, 1.0], 0.0, 1.0)
    for other, parts in ((corner, 2), (upon, 2)):
        vertices, faces = side_by_side(sheet, other)
        with core.Surface(vertices, faces, Repair().options(vertices, 0.05)) as surface:
            figures = surface.statistics()
        assert (figures["components"], figures["split_edges"]) == (parts, 0)


def test_cracks_are_faults_that_are_shown() -> None:
    vertices, faces = side_by_side(
        strip([0.0, 1.0], 0.0, 1.0), strip([0.0, 0.5, 1.0], 0.0, -1.0)
    )
    found = core.find_faults(vertices, faces, seam_width(vertices, 0.05))
    assert {core.FAULTS[kind] for kind in found.kinds} == {"seam"}
    assert [0, 1] in found.elements.tolist()


def test_doubled_faces_are_called_that() -> None:
    vertices, faces = geometry.icosphere(1)
    both = np.concatenate([faces, faces[:, ::-1]])
    with core.Surface(vertices, both, Repair().options(vertices, 0.1)) as surface:
        figures = surface.statistics()
    assert figures["doubled_faces"] == figures["dropped_faces"] == len(faces)
    assert preparation.described(figures) == f"dropped {len(faces)} doubled faces"


def test_parts_below_a_size_are_left_out() -> None:
    sphere = geometry.icosphere(1)
    vertices, faces = side_by_side(
        *((size * sphere.vertices + 5 * k, sphere.faces) for k, size in enumerate((1, 0.1, 0.01)))
    )
    for smallest, parts in ((0.0, 3), (0.1, 2), (1.0, 1), (Share(0.01), 2)):
        repair = Repair(smallest_part=smallest)
        with core.Surface(vertices, faces, repair.options(vertices, 0.1)) as surface:
            figures = surface.statistics()
        assert (figures["components"], figures["small_parts"]) == (parts, 3 - parts)
    with pytest.raises(core.MeanderError, match="All parts of the mesh are smaller than 100"):
        core.Surface(vertices, faces, Repair(smallest_part=100.0).options(vertices, 0.1))
