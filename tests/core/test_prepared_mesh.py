# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes with faults, and parts of meshes: what comes out speaks of the mesh that went in."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from flows import options_of
from meander import core
from sentences import assert_sentence

SPACING = 0.3
PREPARED = (
    "merged_vertices",
    "dropped_faces",
    "split_vertices",
    "cut_edges",
    "masked_faces",
    "clipped_faces",
)


def grid(n: int) -> geometry.Mesh:
    return geometry.grid(n, 3.0)


def soup(vertices: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The same triangles, none of which shares a vertex with another, as an STL file has them."""
    return vertices[faces].reshape(-1, 3), np.arange(faces.size, dtype=np.uint32).reshape(-1, 3)


def done(surface: core.Surface) -> dict[str, int]:
    figures = surface.statistics()
    return {name: figures[name] for name in PREPARED if figures[name]}


def run(
    surface: core.Surface, density: np.ndarray | None = None, iterations: int = 12
) -> core.Flow:
    options = options_of(radius=SPACING / 2, iteration_limit=iterations)
    flow = core.Flow(surface, options, density=density)
    flow.run()
    assert flow.statistics()["crossings"] == 0
    return flow


def node_positions(flow: core.Flow, vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    nodes = flow.nodes()
    return np.einsum("nk,nkj->nj", nodes.barycentrics, vertices[faces[nodes.faces]])


def assert_on_curve(positions: np.ndarray, curve: core.Polylines, tolerance: float) -> None:
    """Every position is a point of the polylines."""
    gaps = np.linalg.norm(positions[:, None] - curve.positions[None], axis=2).min(axis=1)
    assert gaps.max() <= tolerance


def test_options_that_do_nothing_change_nothing() -> None:
    vertices, faces = grid(8)
    plain = run(core.Surface(vertices, faces)).polylines()
    same = run(core.Surface(vertices, faces, core.SurfaceOptions())).polylines()
    assert np.array_equal(plain.positions, same.positions)
    # Options without anything to do still renumber, and must not change the curve.
    every = core.SurfaceOptions(1e-6, True, True, True, face_mask=np.ones(len(faces), dtype=bool))
    prepared = core.Surface(vertices, faces, every)
    assert done(prepared) == {}
    assert np.array_equal(plain.positions, run(prepared).polylines().positions)


def test_a_soup_of_triangles_is_welded() -> None:
    vertices, faces = grid(8)
    loose, loose_faces = soup(vertices, faces)
    assert core.Surface(loose, loose_faces).statistics()["components"] == len(faces)
    surface = core.Surface(loose, loose_faces, core.SurfaceOptions(merge_distance=1e-6))
    figures = surface.statistics()
    assert (figures["vertices"], figures["components"], figures["boundary_loops"]) == (81, 1, 1)
    assert done(surface) == {"merged_vertices": len(loose) - 81}
    flow = run(surface, density=np.ones(len(loose)))
    assert_on_curve(node_positions(flow, loose, loose_faces), flow.polylines(), 1e-6)


def test_bow_ties_are_split_when_asked() -> None:
    vertices = np.array([[0, 0, 0], [-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float)
    faces = np.array([[0, 1, 2], [0, 3, 4]])
    with pytest.raises(core.MeanderError, match="Vertex 0 .*bow-tie") as refusal:
        core.Surface(vertices, faces)
    assert (refusal.value.element_kind, refusal.value.elements) == ("vertex", (0,))
    surface = core.Surface(vertices, faces, core.SurfaceOptions(split_bow_ties=True))
    assert surface.statistics()["components"] == 2
    assert done(surface) == {"split_vertices": 1}


def fin() -> tuple[np.ndarray, np.ndarray]:
    """A square sheet with a fin standing on the middle of it, along whole edges."""
    vertices, faces = grid(6)
    row = 3 * 7 + np.arange(1, 6)  # vertices of the sheet on which the fin stands
    top = np.arange(len(row)) + len(vertices)
    vertices = np.vstack([vertices, vertices[row] + [0.0, 0.0, 1.0]])
    low, high = row[:-1], row[1:]
    side = [np.stack([low, high, top[1:]], 1), np.stack([low, top[1:], top[:-1]], 1)]
    return vertices, np.vstack([faces, *side]).astype(np.uint32)


def test_edges_with_three_faces_become_boundaries_when_asked() -> None:
    vertices, faces = fin()
    with pytest.raises(core.MeanderError, match="has 3 faces") as refusal:
        core.Surface(vertices, faces)
    assert refusal.value.element_kind == "edge"
    assert set(refusal.value.elements) <= set(range(22, 27))
    surface = core.Surface(vertices, faces, core.SurfaceOptions(cut_non_manifold=True))
    figures = surface.statistics()
    assert done(surface) == {"cut_edges": 4}
    # The sheet with a slit, and the fin.
    assert (figures["components"], figures["boundary_loops"]) == (2, 3)
    flow = run(surface)
    positions = node_positions(flow, vertices, faces)
    assert_on_curve(positions, flow.polylines(), 1e-9)
    on_fin = flow.nodes().faces >= 72
    assert on_fin.any() and not on_fin.all()
    # No strand of the sheet crosses the line on which the fin stands.
    curve = flow.polylines()
    points = curve.positions
    sheet = np.abs(points[:, 2]) < 1e-9
    after = np.arange(len(points)) + 1
    for begin, end in zip(curve.offsets[:-1], curve.offsets[1:], strict=True):
        after[end - 1] = begin  # all are closed
    both = sheet & sheet[after]
    y0, y1 = points[both, 1] - 1.5, points[after[both], 1] - 1.5
    crossing = y0 * y1 < 0
    x = points[both, 0] + (points[after[both], 0] - points[both, 0]) * y0 / np.where(
        y0 == y1, 1.0, y0 - y1
    )
    assert not (crossing & (x > 0.5) & (x < 2.5)).any()


def test_faces_without_area_are_dissolved_when_asked() -> None:
    vertices, faces = grid(4)
    # A T-junction: a vertex in the middle of an edge, known to one side only.
    a, b = 6, 7
    on_edge = np.vstack([vertices, (vertices[a] + vertices[b]) / 2])
    m = len(vertices)
    above = next(f for f, face in enumerate(faces.tolist()) if {a, b} <= set(face))
    face = faces[above].tolist()
    at = next(k for k in range(3) if {face[k], face[(k + 1) % 3]} == {a, b})
    p, q, r = face[at], face[(at + 1) % 3], face[(at + 2) % 3]
    split = np.delete(faces, above, axis=0)
    split = np.vstack([split, [[p, m, r], [m, q, r], [p, q, m]]]).astype(np.uint32)
    with pytest.raises(core.MeanderError, match="no area"):
        core.Surface(on_edge, split)
    surface = core.Surface(on_edge, split, core.SurfaceOptions(drop_degenerate=True))
    figures = surface.statistics()
    assert done(surface) == {"dropped_faces": 1}
    # No slit: the face beyond was divided at the vertex.
    assert (figures["faces"], figures["boundary_loops"]) == (34, 1)
    assert figures["area"] == pytest.approx(9.0)
    flow = run(surface)
    assert_on_curve(node_positions(flow, on_edge, split), flow.polylines(), 1e-9)


def test_needles_doubled_faces_and_repeated_corners_go_when_asked() -> None:
    vertices, faces = grid(4)
    twin = np.vstack([vertices, vertices[12] + [1e-12, 0.0, 0.0]])
    n = len(vertices)
    changed = faces.copy()
    for f, face in enumerate(changed.tolist()):  # half of the faces at vertex 12 use its double
        if 12 in face and f >= 16:
            changed[f] = [n if v == 12 else v for v in face]
    needles = [[12, n, 11], [12, n, 13], [5, 5, 6]]
    changed = np.vstack([changed, needles, changed[:3]]).astype(np.uint32)
    surface = core.Surface(twin, changed, core.SurfaceOptions(drop_degenerate=True))
    figures = surface.statistics()
    assert (figures["faces"], figures["components"], figures["boundary_loops"]) == (32, 1, 1)
    assert done(surface) == {"merged_vertices": 1, "dropped_faces": 6}


def test_a_face_mask_keeps_the_curve_inside() -> None:
    vertices, faces = grid(8)
    middles = vertices[faces].mean(axis=1)
    # Two rectangles that meet in one vertex: the mask's edge parts them.
    mask = (middles[:, 0] < 1.5) == (middles[:, 1] < 1.5)
    surface = core.Surface(vertices, faces, core.SurfaceOptions(face_mask=mask))
    figures = surface.statistics()
    assert figures["components"] == 2
    assert done(surface) == {"masked_faces": int((~mask).sum()), "split_vertices": 1}
    flow = run(surface)
    assert mask[flow.nodes().faces].all()
    assert_on_curve(node_positions(flow, vertices, faces), flow.polylines(), 1e-9)


@pytest.mark.parametrize("n", [5, 24])
def test_a_threshold_cuts_through_faces(n: int) -> None:
    vertices, faces = grid(n)
    value = 1.2 - np.linalg.norm(vertices - [1.5, 1.5, 0.0], axis=1)  # a disc
    surface = core.Surface(vertices, faces, core.SurfaceOptions(vertex_mask=value))
    figures = surface.statistics()
    assert (figures["components"], figures["boundary_loops"]) == (1, 1)
    assert figures["clipped_faces"] > 0 and figures["masked_faces"] > 0
    if n == 24:
        assert figures["area"] == pytest.approx(np.pi * 1.2**2, rel=0.02)
    flow = run(surface, density=1.0 + 0.0 * value)
    nodes = flow.nodes()
    inside = np.einsum("nk,nk->n", nodes.barycentrics, value[faces[nodes.faces]])
    snapped = 0.1 * 3.0 * np.sqrt(2) / n  # the edge may run through a vertex instead
    assert inside.min() > -snapped
    assert np.abs(nodes.barycentrics.sum(axis=1) - 1).max() < 1e-12
    assert nodes.barycentrics.min() > -1e-12
    assert_on_curve(node_positions(flow, vertices, faces), flow.polylines(), 1e-9)


def test_random_thresholds_never_leave_what_the_check_refuses() -> None:
    vertices, faces = grid(10)
    generator = np.random.default_rng(7)
    for round in range(60):
        value = generator.normal(size=len(vertices))
        if round % 3 == 0:
            value = np.round(value)  # many vertices exactly on the edge
        if round % 3 == 1:
            value = np.sin(vertices @ generator.normal(size=3) * 3.0)
        threshold = float(np.round(np.median(value)))
        if round % 3 == 1:
            threshold = float(np.median(value))
        surface = core.Surface(
            vertices, faces, core.SurfaceOptions(vertex_mask=value, mask_threshold=threshold)
        )
        figures = surface.statistics()
        assert figures["faces"] >= len(faces) - figures["masked_faces"] - figures["clipped_faces"]
        assert 0 < figures["area"] <= 9.0 + 1e-9


def test_errors_name_what_the_caller_passed() -> None:
    vertices, faces = grid(4)
    bow_tie = np.vstack([vertices, [[-1, 0, 0], [-1, -1, 0]]])
    n = len(vertices)
    with_tie = np.vstack([[[0, n, n + 1]], faces]).astype(np.uint32)
    mask = np.ones(len(with_tie), dtype=bool)
    mask[20:] = False  # renumbers what comes behind, and leaves vertex 0 alone
    with pytest.raises(core.MeanderError, match="Vertex 0 ") as refusal:
        core.Surface(bow_tie, with_tie, core.SurfaceOptions(face_mask=mask))
    assert refusal.value.elements == (0,)
    flat = np.vstack([faces, [[24, 24, 23]]]).astype(np.uint32)
    only = np.zeros(len(flat), dtype=bool)
    only[[5, 9, 32]] = True
    with pytest.raises(core.MeanderError, match="Face 32 uses vertex 24 twice") as refusal:
        core.Surface(vertices, flat, core.SurfaceOptions(face_mask=only))
    assert (refusal.value.element_kind, refusal.value.elements) == ("face", (32,))


def test_a_density_is_that_of_the_callers_vertices() -> None:
    vertices, faces = grid(8)
    mask = vertices[faces].mean(axis=1)[:, 0] < 1.5
    options = core.SurfaceOptions(face_mask=mask)
    density = np.where(vertices[:, 1] < 1.5, 4.0, 1.0)
    masked = run(core.Surface(vertices, faces, options), density, iterations=40)
    # The same part as a mesh of its own, its vertices in the same order.
    used, renumbered = np.unique(faces[mask], return_inverse=True)
    alone = core.Surface(vertices[used], renumbered.reshape(-1, 3))
    other = run(alone, density[used], iterations=40)
    assert np.array_equal(masked.polylines().positions, other.polylines().positions)
    with pytest.raises(core.MeanderError, match="81 vertices"):
        run(core.Surface(vertices, faces, options), density[used])
    density[80] = -1.0
    with pytest.raises(core.MeanderError, match="vertex 80"):
        run(core.Surface(vertices, faces, options), density)


def test_bad_options_are_refused_with_one_sentence() -> None:
    vertices, faces = grid(2)
    zeros = np.zeros(len(faces))
    for options, words in (
        (core.SurfaceOptions(merge_distance=-1.0), "merge distance"),
        (core.SurfaceOptions(merge_distance=float("nan")), "merge distance"),
        (core.SurfaceOptions(merge_distance=100.0), "leave no faces"),
        (core.SurfaceOptions(face_mask=zeros.astype(bool)), "leaves no faces"),
        (core.SurfaceOptions(vertex_mask=np.zeros(9), mask_threshold=0.5), "leaves no faces"),
        (core.SurfaceOptions(vertex_mask=np.full(9, np.nan)), "vertex 0"),
        (core.SurfaceOptions(mask_threshold=float("inf")), "threshold"),
        (core.SurfaceOptions(vertex_mask=np.zeros(8)), "9 vertices"),
        (core.SurfaceOptions(face_mask=np.ones(3, dtype=bool)), "8 faces"),
    ):
        with pytest.raises(core.MeanderError, match=words) as refusal:
            core.Surface(vertices, faces, options)
        assert_sentence(str(refusal.value))
