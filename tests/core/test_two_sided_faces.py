# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons that are there twice are filled once, and what only looks like that stays as it is."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import options_of
from meander import batch, core
from meander.model import preparation
from meander.model.preparation import Repair

Polygons = tuple[np.ndarray, list[list[int]]]

CASES: list[Callable[[], tuple[Polygons, float]]] = []  # with the area of one side
STAYING: list[Callable[[], tuple[Polygons, int]]] = []  # with how many parts there are


def case(make: Callable[[], tuple[Polygons, float]]) -> Callable[[], tuple[Polygons, float]]:
    CASES.append(make)
    return make


def staying(make: Callable[[], tuple[Polygons, int]]) -> Callable[[], tuple[Polygons, int]]:
    STAYING.append(make)
    return make


def figures(mesh: Polygons, scale: float = 1.0) -> dict:
    """What becomes of a mesh of polygons where it is repaired as Blender and the command do."""
    vertices = np.asarray(mesh[0], dtype=np.float64) * scale
    corners = np.array([v for polygon in mesh[1] for v in polygon], dtype=np.uint32)
    faces, polygons = core.triangulated(vertices, corners, np.cumsum([len(p) for p in mesh[1]]))
    prepared = Repair().options(vertices, 0.05 * scale, polygons)
    with core.Surface(vertices, faces, prepared) as surface:
        return surface.statistics()


def turned(polygons: Sequence[Sequence[int]], by: int = 0) -> list[list[int]]:
    """Each wound the other way, its vertices counted from `by`."""
    return [[v + by for v in reversed(polygon)] for polygon in polygons]


def quads(n: int = 6, height: Callable = lambda x, y: 0.0 * x) -> Polygons:
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1), indexing="ij")
    vertices = np.stack([x, y, height(x, y)], axis=-1).reshape(-1, 3)
    first = [i * (n + 1) + j for i in range(n) for j in range(n)]
    return vertices, [[a, a + n + 1, a + n + 2, a + 1] for a in first]


def hill(n: int = 6) -> Polygons:
    return quads(n, lambda x, y: 0.2 * np.sin(3 * x) * np.cos(2 * y))


def area(mesh: Polygons) -> float:
    """Of the triangles that Blender makes of it."""
    return figures((np.asarray(mesh[0]), mesh[1]))["area"]


def box(low: Sequence[float] = (0, 0, 0), size: Sequence[float] = (1, 1, 1)) -> Polygons:
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    vertices = np.asarray(low, dtype=float) + np.array(corners) * np.asarray(size, dtype=float)
    polygons = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return vertices, polygons


def beside(*meshes: Polygons) -> Polygons:
    """Several meshes in one, each with vertices of its own."""
    vertices: list[np.ndarray] = []
    polygons: list[list[int]] = []
    for mesh in meshes:
        count = sum(map(len, vertices))
        vertices.append(np.asarray(mesh[0], dtype=float))
        polygons += [[v + count for v in polygon] for polygon in mesh[1]]
    return np.concatenate(vertices), polygons


def loose(mesh: Polygons) -> Polygons:
    """Every polygon on corners of its own."""
    corners = [v for polygon in mesh[1] for v in polygon]
    ends = np.cumsum([0, *map(len, mesh[1])])
    return mesh[0][corners], [list(range(a, b)) for a, b in zip(ends[:-1], ends[1:], strict=True)]


@case
def a_leaf_of_quads() -> tuple[Polygons, float]:
    vertices, polygons = quads()
    return (vertices, polygons + turned(polygons)), 1.0


@case
def a_leaf_that_is_bent() -> tuple[Polygons, float]:
    vertices, polygons = hill()
    return (vertices, polygons + turned(polygons)), area(hill())


@case
def a_bent_leaf_whose_back_has_vertices_of_its_own() -> tuple[Polygons, float]:
    vertices, polygons = hill()
    return beside((vertices, polygons), (vertices, turned(polygons))), area(hill())


@case
def a_solidify_of_thickness_0() -> tuple[Polygons, float]:
    n = 6
    vertices, polygons = hill(n)
    count = len(vertices)
    rim = [i * (n + 1) for i in range(n)] + [n * (n + 1) + j for j in range(n)]
    rim += [i * (n + 1) + n for i in range(n, 0, -1)] + list(range(n, 0, -1))
    sides = [[a, b, b + count, a + count] for a, b in zip(rim, rim[1:] + rim[:1], strict=True)]
    polygons = polygons + turned(polygons, count) + sides
    return (np.vstack([vertices, vertices]), polygons), area(hill())


@case
def a_soup_of_triangles_each_of_them_there_once_more() -> tuple[Polygons, float]:
    vertices, faces = geometry.icosphere(2)[:2]
    front = loose((np.asarray(vertices), np.asarray(faces).tolist()))
    back = loose((np.asarray(vertices), np.asarray(faces)[:, ::-1].tolist()))
    return beside(front, back), area((np.asarray(vertices), np.asarray(faces).tolist()))


@case
def a_concave_polygon_from_both_sides() -> tuple[Polygons, float]:
    turn = np.arange(14) * np.pi / 7
    radius = np.where(np.arange(14) % 2, 1.0, 0.4)
    star = np.stack([radius * np.cos(turn), radius * np.sin(turn), 0 * turn], axis=1)
    polygon = list(range(14))
    return (star, [polygon, [*polygon[::-1][5:], *polygon[::-1][:5]]]), area((star, [polygon]))


@case
def a_polygon_with_a_hole_from_both_sides() -> tuple[Polygons, float]:
    rim = [(0, 0, 0), (3, 0, 0), (3, 3, 0), (0, 3, 0)]
    hole = [(1, 1, 0), (1, 2, 0), (2, 2, 0), (2, 1, 0)]
    polygon = [0, 1, 2, 3, 0, 4, 5, 6, 7, 4]
    return (np.array(rim + hole, dtype=float), [polygon, polygon[::-1]]), 8.0


@case
def triangles_with_another_diagonal() -> tuple[Polygons, float]:
    vertices, polygons = quads()
    one = [triangle for a, b, c, d in polygons for triangle in ([a, b, c], [a, c, d])]
    other = [triangle for a, b, c, d in polygons for triangle in ([a, d, b], [b, d, c])]
    return (vertices, one + other), 1.0


def _bent(own: bool, front: Sequence[int], back: Sequence[int]) -> tuple[Polygons, float]:
    """A hill of triangles, each quad divided from one of its corners, whose back is divided from
    others; with 4 in `back` that has quads."""
    vertices, polygons = hill()

    def divided(starts: Sequence[int]) -> list[list[int]]:
        found = []
        for number, quad in enumerate(polygons):
            at = starts[number % len(starts)]
            a, b, c, d = [*quad[at:], *quad[:at]]
            found += [[a, b, c, d]] if at == 4 else [[a, b, c], [a, c, d]]
        return found

    shown = turned(divided(back), len(vertices) if own else 0)
    size = area((vertices, divided(front)))
    return (np.vstack([vertices, vertices]) if own else vertices, divided(front) + shown), size


@case
def bent_triangles_whose_back_has_the_other_diagonals() -> tuple[Polygons, float]:
    return _bent(False, [0], [1])


@case
def bent_triangles_whose_back_has_others_and_vertices_of_its_own() -> tuple[Polygons, float]:
    return _bent(True, [1], [0])


@case
def bent_triangles_whose_back_has_others_here_and_there() -> tuple[Polygons, float]:
    return _bent(True, [0, 1, 1], [0, 0, 1, 1, 0])


@case
def bent_triangles_whose_back_has_quads() -> tuple[Polygons, float]:
    return _bent(True, [1], [4])


@case
def a_copy_that_was_never_moved() -> tuple[Polygons, float]:
    mesh = box()
    return beside(mesh, mesh), 6.0


@case
def a_box_with_a_loose_lid_before_its_own() -> tuple[Polygons, float]:
    """The lid that stays is joined to the box."""
    vertices, polygons = box()
    return beside((vertices, [polygons[5][1:] + polygons[5][:1]]), (vertices, polygons)), 6.0


@case
def a_floor_and_a_wall_with_two_sides() -> tuple[Polygons, float]:
    vertices = np.array([(x, y, 0) for x in (0, 1, 2) for y in (0, 1)] + [(1, 0, 1), (1, 1, 1)])
    polygons = [[0, 2, 3, 1], [2, 4, 5, 3], [2, 6, 7, 3]]
    return (vertices.astype(float), polygons + turned(polygons)), 3.0


@case
def a_leaf_with_two_sides_on_a_floor_with_one() -> tuple[Polygons, float]:
    vertices = np.array([(x, y, 0) for x in (0, 1, 2) for y in (0, 1)] + [(1, 0, 1), (1, 1, 1)])
    return (vertices.astype(float), [[0, 2, 3, 1], [2, 4, 5, 3], [2, 6, 7, 3], [3, 7, 6, 2]]), 3.0


@case
def a_bent_leaf_whose_back_is_not_quite_in_its_place() -> tuple[Polygons, float]:
    """As far behind as half a millionth of its size."""
    vertices, polygons = hill()
    size = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    behind = vertices - (0, 0, 5e-7 * size)
    return beside((vertices, polygons), (behind, turned(polygons))), area(hill())


@case
def a_leaf_in_single_precision_far_from_the_origin() -> tuple[Polygons, float]:
    """Its back was moved there in another way."""
    vertices, polygons = hill()
    way = np.array([5.0, -4.0, 3.0])
    front = (vertices + way).astype(np.float32)
    back = ((vertices * 0.1).astype(np.float32) + (way * 0.1).astype(np.float32)) * np.float32(10)
    assert (front != back).any()
    return beside((front, polygons), (back, turned(polygons))), area((front, polygons))


@staying
def a_sheet_of_three_millionths() -> tuple[Polygons, int]:
    return box(size=(1, 1, 3e-6)), 1


@staying
def a_sheet_with_a_thickness() -> tuple[Polygons, int]:
    return box(size=(1, 1, 1e-5)), 1


@staying
def two_boxes_on_each_other() -> tuple[Polygons, int]:
    return beside(box(), box((0, 0, 1))), 2


@staying
def a_tetrahedron() -> tuple[Polygons, int]:
    vertices = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
    return (vertices, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]), 1


@staying
def a_flat_tetrahedron() -> tuple[Polygons, int]:
    """It has an angle of more than a right one at two opposite edges."""
    vertices = np.array([(0, 0, 0), (1, 0, 0.1), (1, 1, 0), (0, 1, 0.1)])
    return (vertices, [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]), 1


@staying
def a_lens() -> tuple[Polygons, int]:
    """Two fans of triangles on one rim, whose tips are a ten-thousandth of their size apart."""
    turn = np.arange(12) * np.pi / 6
    rim = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    edges = [(k, (k + 1) % 12) for k in range(12)]
    vertices = np.vstack([rim, [(0, 0, 1e-4), (0, 0, -1e-4)]])
    return (vertices, [[a, b, 12] for a, b in edges] + [[b, a, 13] for a, b in edges]), 1


@staying
def a_hexagon_over_a_bent_one() -> tuple[Polygons, int]:
    """Quadrangles on the corners of others, in another order."""
    vertices = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1)], dtype=float)
    return (vertices, [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]), 1


@pytest.mark.parametrize("make", CASES, ids=lambda make: make.__name__)
@pytest.mark.parametrize("scale", [1.0, 1e-4], ids=["large", "small"])
def test_both_sides_are_filled_once(
    make: Callable[[], tuple[Polygons, float]], scale: float
) -> None:
    mesh, one_side = make()
    found = figures(mesh, scale)
    assert found["components"] == (2 if "floor" in make.__name__ else 1)
    assert found["area"] == pytest.approx(one_side * scale**2, rel=1e-9)
    assert "doubled face" in preparation.described(found)


@pytest.mark.parametrize("make", STAYING, ids=lambda make: make.__name__)
def test_what_has_a_room_in_it_keeps_both_sides(make: Callable[[], tuple[Polygons, int]]) -> None:
    mesh, parts = make()
    found = figures(mesh)
    assert (found["components"], found["boundary_loops"]) == (parts, 0)
    assert found["doubled_faces"] == found["dropped_faces"] == 0


def test_a_copy_of_what_touches_leaves_all_of_it() -> None:
    """Two boxes with a wall in common are two, also where each is there twice."""
    touching = beside(box(), box((0, 0, 1)))
    found = figures(beside(touching, touching))
    assert (found["components"], found["boundary_loops"]) == (2, 0)
    assert found["area"] == pytest.approx(12.0)


def test_a_mesh_without_doubles_is_left_as_it_is() -> None:
    """With what is to be left out, or without, the same curve to the last bit."""
    vertices, faces = geometry.icosphere(3)[:2]
    curves = []
    options = options_of(radius=0.1, iteration_limit=10)
    for prepared in (None, Repair().options(np.asarray(vertices), 0.1)):
        surface = core.Surface(vertices, faces, prepared)
        with core.Flow(surface, options) as flow:
            flow.run()
            curves.append(flow.polylines().positions.tobytes())
    assert curves[0] == curves[1]


def test_a_line_over_a_leaf() -> None:
    """One line over the surface once, on faces that were given."""
    mesh, _ = a_bent_leaf_whose_back_has_vertices_of_its_own()
    vertices = np.asarray(mesh[0])
    corners = np.array([v for polygon in mesh[1] for v in polygon], dtype=np.uint32)
    faces, polygons = core.triangulated(vertices, corners, np.cumsum([4] * len(mesh[1])))
    options = options_of(radius=0.05)
    prepared = Repair().options(vertices, 0.05, polygons)
    with core.Surface(vertices, faces, prepared) as surface, core.Flow(surface, options) as flow:
        flow.run()
        nodes, curve = flow.nodes(), flow.polylines()
    assert len(curve.closed) == 1
    assert nodes.faces.max() < len(faces) // 2  # those of the front, which come first


def test_the_polygons_of_all_faces_are_named() -> None:
    vertices, faces = geometry.icosphere(1)[:2]
    prepared = core.SurfaceOptions(drop_doubled=True, polygons=np.zeros(3, dtype=np.uint32))
    with pytest.raises(core.MeanderError, match="polygons must have one value for each"):
        core.Surface(vertices, faces, prepared)


@pytest.mark.parametrize("own", [False, True])
@pytest.mark.parametrize("cells", [5, 6])
def test_symmetry_halves_what_is_left(tmp_path: Path, own: bool, cells: int) -> None:
    """Five quads across, the plane cuts both twins of those in the middle."""
    along = np.linspace(-0.5, 0.5, cells + 1)
    places = [(x, y, 0.0) for x in along for y in along]
    corners = [cells + 1, 0, 1, cells + 2]
    front = [
        [k * (cells + 1) + j + c for c in corners] for k in range(cells) for j in range(cells)
    ]
    shift = len(places) if own else 0
    back = [[corner + shift for corner in quad[::-1]] for quad in front]
    curves = []
    for name, quads in (("one", front), ("two", front + back)):
        lines = [f"v {x:.9g} {y:.9g} {z:g}" for x, y, z in places * 2]
        lines += [f"f {' '.join(str(corner + 1) for corner in quad)}" for quad in quads]
        mesh, output = tmp_path / f"{name}.obj", tmp_path / f"{name}_curve.obj"
        mesh.write_text("\n".join(lines))
        given = ["--input", mesh, "--output", output, "--spacing", "0.15", "--mirror", "x"]
        report = ["--report", tmp_path / "report.json", "--quiet"]
        assert batch.main([str(each) for each in (*given, *report)]) == 0
        curves.append(output.read_text().partition("\nv")[2])
    done = json.loads((tmp_path / "report.json").read_text())
    assert done["preparation"]["doubled_faces"] == 2 * cells * cells
    assert done["preparation"]["masked_faces"] == 0 and done["lines"]["count"] == 1
    assert curves[0] == curves[1]
