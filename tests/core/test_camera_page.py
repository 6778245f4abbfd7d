# SPDX-License-Identifier: GPL-3.0-or-later
"""A camera's frame on a page, and meshes that are cut off at its sides and divided by distance."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree

import geometry
import numpy as np
import pytest
from meander.model.camera import CameraPage, Page
from meander.model.geometry.clipped_mesh import Triangles
from meander.model.toolpaths.svg import page_pieces
from meander.model.toolpaths.toolpath import strand_of

A4 = Page(210.0, 297.0, 10.0)


def looking_down(
    height: float, width: float, aspect: float, perspective: bool = True, near: float = 0.1
) -> CameraPage:
    """A camera at (0, 0, height) that sees `width` of the plane z = 0 along x, and y upwards."""
    view = np.eye(4)
    view[2, 3] = -height
    projection = np.zeros((4, 4))
    if perspective:
        projection[0, 0] = 2.0 * height / width
        projection[3, 2] = -1.0
    else:
        projection[0, 0] = 2.0 / width
        projection[3, 3] = 1.0
    projection[1, 1] = projection[0, 0] * aspect
    return CameraPage(view, projection, near, 100.0, aspect, A4.turned_to(aspect))


def grid(cells: int, size: float, z: float = 0.0) -> Triangles:
    """A square of side `size` round the z axis."""
    half = 0.5 * size
    square = geometry.rectangle((-half, -half), (half, half), cells, cells)
    return Triangles(square.vertices + (0.0, 0.0, z), square.faces.astype(np.int64))


def area(mesh: Triangles) -> np.ndarray:
    """The vector of every face's area; all of a flat mesh point one way."""
    a, b, c = (mesh.vertices[mesh.faces[:, corner]] for corner in range(3))
    return np.cross(b - a, c - a) / 2.0


def boundary_edges(mesh: Triangles) -> np.ndarray:
    """Edges with one face; fails where an edge has more than two, or two that turn alike."""
    directed = np.vstack([mesh.faces[:, [i, (i + 1) % 3]] for i in range(3)])
    assert len(np.unique(directed, axis=0)) == len(directed)
    _, count = np.unique(np.sort(directed, axis=1), axis=0, return_counts=True)
    assert count.max() <= 2
    edges = np.unique(np.sort(directed, axis=1), axis=0)
    return edges[count == 1]


def test_the_frame_is_as_large_as_the_margins_allow() -> None:
    wide = looking_down(5.0, 4.0, 2.0)
    assert (wide.page.width, wide.page.height) == (297.0, 210.0)
    assert wide.sides == pytest.approx([277.0, 138.5])
    assert wide.corner == pytest.approx([10.0, 35.75])
    high = looking_down(5.0, 4.0, 0.5)
    assert (high.page.width, high.page.height) == (210.0, 297.0)
    assert high.sides == pytest.approx([138.5, 277.0])
    square = looking_down(5.0, 4.0, 1.0)
    assert square.sides == pytest.approx([190.0, 190.0])
    assert not Page(210.0, 297.0, 105.0).has_room and A4.has_room


@pytest.mark.parametrize("perspective", [True, False])
def test_points_lie_where_they_are_seen(perspective: bool) -> None:
    page = looking_down(5.0, 4.0, 2.0, perspective)
    corners = np.array([[-2.0, -1.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
    middle = page.corner + page.sides / 2.0
    wanted = [page.corner, page.corner + page.sides, middle]
    assert np.allclose(page.on_paper(corners), wanted)
    # Half as far away everything is twice as large, where there is perspective.
    near = np.array([[1.0, 0.0, 2.5]])
    share = 1.0 if perspective else 0.5
    assert np.allclose(page.on_paper(near), [middle + [share * page.sides[0] / 2.0, 0.0]])
    scale = page.millimetres(np.vstack([corners[2:], near]))
    assert scale[0] == pytest.approx(page.sides[0] / 4.0)
    assert scale[1] / scale[0] == pytest.approx(2.0 if perspective else 1.0)


@pytest.mark.parametrize("perspective", [True, False])
def test_the_eye_is_where_light_goes(perspective: bool) -> None:
    page = looking_down(5.0, 4.0, 1.0, perspective, near=1.0)
    points = np.array([[1.0, -1.0, 0.5], [0.3, 0.2, -2.0]])
    directions, lengths = page.towards_eye(points)
    assert np.linalg.norm(directions, axis=1) == pytest.approx(1.0)
    ends = points + lengths[:, None] * directions
    assert page.depths(ends) == pytest.approx(1.0)
    assert np.allclose(page.on_paper(ends), page.on_paper(points))


def test_what_the_frame_holds() -> None:
    page = looking_down(5.0, 4.0, 2.0, near=1.0)
    rng = np.random.default_rng(3)
    points = rng.uniform([-4.0, -3.0, -3.0], [4.0, 3.0, 4.9], (2000, 3))
    paper = page.on_paper(points)
    inside = (paper >= page.corner).all(axis=1)
    inside &= (paper <= page.corner + page.sides).all(axis=1) & (points[:, 2] <= 4.0)
    assert 100 < inside.sum() < 1900
    assert np.array_equal(page.inside(points), inside)
    assert not page.inside([[0.0, 0.0, 6.0]])[0], "behind the camera"


def test_a_mesh_is_cut_at_the_frame() -> None:
    page = looking_down(5.0, 4.0, 2.0)
    cut = grid(7, 9.0).clipped(page.planes())
    assert np.allclose(area(cut).sum(axis=0), [0.0, 0.0, 8.0])
    assert (area(cut)[:, 2] > 0.0).all(), "no face is turned over or folded"
    ends = cut.vertices[boundary_edges(cut)]
    on_rim = np.isclose(np.abs(ends[..., 0]), 2.0) | np.isclose(np.abs(ends[..., 1]), 1.0)
    assert on_rim.all()
    larger = grid(7, 9.0).clipped(page.planes(beyond=page.sides[0] / 4.0))
    assert area(larger).sum(axis=0)[2] == pytest.approx(6.0 * 4.0)


def test_a_plane_through_vertices_cuts_no_slivers() -> None:
    mesh = grid(6, 6.0)  # has vertices at every whole number
    along_edges = np.array([[1.0, 0.0, 0.0, 1.0]])  # x >= -1
    cut = mesh.clipped(along_edges)
    assert area(cut)[:, 2].sum() == pytest.approx(24.0)
    assert area(cut)[:, 2].min() == pytest.approx(0.5)
    diagonal = np.array([[1.0, 1.0, 0.0, 0.0]])  # across faces, through their corners
    cut = mesh.clipped(diagonal)
    assert area(cut)[:, 2].sum() == pytest.approx(18.0)
    assert area(cut)[:, 2].min() == pytest.approx(0.25)
    boundary_edges(cut)


def test_nothing_is_left_of_what_is_outside() -> None:
    page = looking_down(5.0, 4.0, 2.0)
    behind = grid(3, 9.0, z=6.0)
    cut = behind.clipped(page.planes())
    assert len(cut.faces) == len(cut.vertices) == 0
    through = Triangles(np.array([[0.0, 0, -90], [0, 1, -90], [0, 0, 40.0]]), behind.faces[:0])
    through = Triangles(through.vertices, np.array([[0, 1, 2]])).clipped(page.planes())
    assert page.depths(through.vertices).min() == pytest.approx(0.1, rel=1e-4)


def test_edges_are_halved_until_distances_are_alike() -> None:
    page = looking_down(10.0, 4.0, 1.0)
    slope = Triangles(
        np.array([[-1.0, 0, 9], [1, 0, 9], [9.0, 0, -80], [-9.0, 0, -80]]),
        np.array([[0, 1, 2], [0, 2, 3]]),
        values=np.array([9.0, 9.0, -80.0, -80.0]),
        lines=np.array([[1.0, 0, 0], [-1, 0, 0], [1, 0, 0], [-1, 0, 0]]),
    )
    fine = slope.divided(page.depths, 1.25)
    edges = fine.vertices[np.sort(fine.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)]
    depths = page.depths(edges.reshape(-1, 3)).reshape(-1, 2)
    assert (depths.max(axis=1) <= 1.25 * depths.min(axis=1)).all()
    assert np.allclose(area(fine).sum(axis=0), area(slope).sum(axis=0))
    assert len(boundary_edges(fine)) > 4  # and no edge that has only one face within
    on_rim = fine.vertices[boundary_edges(fine)].mean(axis=1)
    sides = np.abs(np.abs(on_rim[:, 0]) - (1.0 + 8.0 * (9.0 - on_rim[:, 2]) / 89.0))
    ends = np.minimum(np.abs(on_rim[:, 2] - 9.0), np.abs(on_rim[:, 2] + 80.0))
    assert np.minimum(sides, ends).max() < 1e-9
    assert np.allclose(fine.values, fine.vertices[:, 2]), "values are linear"
    assert np.allclose(np.abs(fine.lines), [1.0, 0.0, 0.0]), "lines have no sign"


def test_a_page_has_a_layer_for_each_name() -> None:
    points = np.array([[10.0, 20.0, 0.0], [30.0, 20.0, 0.0], [30.0, 45.5, 0.0]])
    up = np.tile([0.0, 0.0, 1.0], (3, 1))
    names = ["Cube", 'a "b" <c> & d', "bad \x01 letter"]
    layers = [(name, [strand_of(points, up, closed)]) for closed, name in enumerate(names)]
    text = "".join(page_pieces(layers, (210.0, 297.0), 0.25, "Camera & Co", "9.9"))
    root = ElementTree.fromstring(text)
    assert (root.get("width"), root.get("height")) == ("210mm", "297mm")
    assert root.get("viewBox") == "0 0 210 297"
    inkscape = "{http://www.inkscape.org/namespaces/inkscape}"
    found = [each for each in root.iter() if each.get(f"{inkscape}groupmode") == "layer"]
    labels = [each.get(f"{inkscape}label") for each in found]
    assert labels == [*names[:2], "bad \ufffd letter"]
    paths = [layer[0] for layer in found]
    assert [path.get("id") for path in paths] == ["strand1", "strand2", "strand3"]
    assert paths[0].get("d") == "M10 277L30 277 30 251.5"
    assert paths[1].get("d") == "M10 277L30 277 30 251.5Z"
    assert math.isclose(float(root[2].get("stroke-width")), 0.25)
