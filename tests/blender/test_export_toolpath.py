# SPDX-License-Identifier: GPL-3.0-or-later
"""What is known of a result's points, as a file and as attributes of a mesh."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from meander.scene import look


def test_files_hold_the_curve_with_normals(tmp_path: Path) -> None:
    result = scenes.fill(scenes.sphere(), 0.4)
    splines = scenes.world_splines(result)
    path = tmp_path / "path.json"
    export = bpy.ops.meander.export_toolpath
    assert export(filepath=str(path), file_format="JSON") == {"FINISHED"}
    strands = json.loads(path.read_text())["strands"]
    assert [strand["closed"] for strand in strands] == [cyclic for _points, cyclic in splines]
    points = np.array(strands[0]["points"])
    assert np.allclose(points, splines[0][0], atol=1e-6)
    outward = points / np.linalg.norm(points, axis=1, keepdims=True)
    assert (np.array(strands[0]["normals"]) * outward).sum(axis=1).min() > 0.99
    assert export(
        filepath=str(tmp_path / "few"), file_format="CSV", resample="STEP", step=0.1
    ) == {"FINISHED"}
    with (tmp_path / "few.csv").open() as file:
        rows = list(csv.DictReader(file))
    arc_lengths = [float(row["arc_length"]) for row in rows if row["strand"] == "0"]
    assert 0.09 < arc_lengths[1] <= 0.1
    assert np.allclose(np.diff(arc_lengths), arc_lengths[1])
    # A name says the format of a file, here numpy's.
    assert export(filepath=str(tmp_path / "all.npz")) == {"FINISHED"}
    with np.load(tmp_path / "all.npz") as arrays:
        assert np.array_equal(arrays["points"][: arrays["offsets"][1]], points)
        assert len(arrays["faces"]) == len(arrays["points"])


def test_mesh_has_the_attributes() -> None:
    result = scenes.fill(scenes.sphere(), 0.4)
    points = scenes.points_of(result)
    assert bpy.ops.meander.points_to_mesh() == {"FINISHED"}
    mesh = bpy.data.objects[f"{result.name} Points"].data
    count = len(mesh.vertices)
    assert count == len(points) == len(mesh.edges)

    def values(name: str, key: str, width: int) -> np.ndarray:
        buffer = np.empty(width * count, dtype=np.int32 if key == "int" else np.float32)
        mesh.attributes[name].data.foreach_get("vector" if width == 3 else "value", buffer)
        return buffer.reshape(count, -1)

    vertices, faces = scenes.world_triangles(result.meander.surface)
    triangles = values("triangle", "int", 1)[:, 0]
    weights = values("weights", "float", 3)
    rebuilt = np.einsum("nk,nkj->nj", weights, vertices[faces[triangles]])
    assert np.allclose(rebuilt, points, atol=0.005)
    arc_lengths = values("arc_length", "float", 1)[:, 0]
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    assert np.allclose(np.diff(arc_lengths), steps, atol=1e-5)
    normals, tangents = values("surface_normal", "float", 3), values("tangent", "float", 3)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-5)
    assert np.abs((normals * tangents).sum(axis=1)).max() < 0.3


def _attribute(data, name: str, width: int = 1) -> np.ndarray:
    attribute = data.attributes[name]
    whole = attribute.data_type == "INT"
    buffer = np.empty(width * len(attribute.data), dtype=np.int32 if whole else np.float32)
    attribute.data.foreach_get("vector" if width == 3 else "value", buffer)
    return buffer.reshape(-1, width) if width > 1 else buffer


def _check_points(thing: bpy.types.Object, result: bpy.types.Object, radius: float) -> None:
    """Positions against triangles and weights, directions and room against the surface."""
    data, surface = thing.data, result.meander.surface
    if thing.type == "MESH":
        local = np.array([vertex.co for vertex in data.vertices])
    else:
        local = _attribute(data, "position", 3)
    matrix = np.array([row[:] for row in surface.matrix_world])
    points = local @ matrix[:3, :3].T + matrix[:3, 3]
    vertices, faces = scenes.world_triangles(surface)
    corners = vertices[faces[_attribute(data, "triangle")]]
    rebuilt = np.einsum("nk,nkj->nj", _attribute(data, "weights", 3), corners)
    assert np.allclose(rebuilt, points, atol=2e-4)
    normals, tangents = _attribute(data, "surface_normal", 3), _attribute(data, "tangent", 3)
    assert np.abs((normals * tangents).sum(axis=1)).max() < 0.3
    room = np.column_stack([_attribute(data, "r_plus"), _attribute(data, "r_minus")])
    assert (room > 0.0).all()
    assert 0.8 * radius < np.median(room) < 1.2 * radius
    assert result.parent == surface == thing.parent


@pytest.mark.parametrize("kind", ["MESH", "CURVES"])
def test_a_run_makes_an_object_of_all_points(kind: str) -> None:
    ball = scenes.sphere()
    ball.scale = (1.5, 1.5, 1.5)
    ball.meander.points_as = kind
    if kind == "CURVES" and bpy.app.version < (4, 2):
        ball.meander.spacing = 0.4
        with pytest.raises(RuntimeError, match="4.2"):
            bpy.ops.meander.run()
        return
    result = scenes.fill(ball, 0.4)
    thing = result.meander.figures.points
    assert thing.name == f"{result.name} Points"
    assert thing.type == kind
    _check_points(thing, result, 0.2)
    if kind == "CURVES":
        assert len(thing.data.curves) == len(result.data.splines)
        cyclic = [item.value for item in thing.data.attributes["cyclic"].data]
        assert cyclic == [spline.use_cyclic_u for spline in result.data.splines]
        assert {item.value for item in thing.data.attributes["curve_type"].data} == {1}
    # More than the result has: nothing that nearly coincides was taken out.
    own = scenes.point_count(result)
    assert len(thing.data.attributes["r_plus"].data) >= own
    # Going on replaces it.
    count = len(bpy.data.objects)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert len(bpy.data.objects) == count


def test_the_room_is_known_until_the_points_change(tmp_path: Path) -> None:
    scenes.fill(scenes.sphere(), 0.4)
    scenes.reopened(tmp_path / "kept.blend")
    result = scenes.activate(bpy.data.objects["Icosphere Meander"])
    assert bpy.ops.meander.points_to_mesh() == {"FINISHED"}
    _check_points(bpy.data.objects[f"{result.name} Points"], result, 0.2)
    path = tmp_path / "path.json"
    export = bpy.ops.meander.export_toolpath
    scenes.activate(result)
    assert export(filepath=str(path), file_format="JSON", resample="STEP", step=0.05) == {
        "FINISHED"
    }
    strand = json.loads(path.read_text())["strands"][0]
    assert 0.16 < np.median([strand["r_plus"], strand["r_minus"]]) < 0.24
    assert len(strand["weights"]) == len(strand["faces"]) == len(strand["points"])
    result.data.splines[0].points.add(1)
    assert export(filepath=str(path), file_format="JSON") == {"FINISHED"}
    assert json.loads(path.read_text())["strands"][0]["r_plus"] is None


def test_points_to_hair_curves() -> None:
    result = scenes.fill(scenes.sphere(), 0.4, use_bevel=True)
    if bpy.app.version < (4, 2):
        with pytest.raises(RuntimeError, match="4.2"):
            bpy.ops.meander.points_to_curves()
        return
    assert bpy.ops.meander.points_to_curves() == {"FINISHED"}
    thing = bpy.data.objects[f"{result.name} Points"]
    _check_points(thing, result, 0.2)
    radius = _attribute(thing.data, "radius")
    assert np.allclose(radius, look.radius_of(result))


@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_the_room_is_on_the_side_that_its_name_says(mirror: float) -> None:
    """Two rings: between them there is little room, inside the smaller one there is much."""
    sheet = scenes.grid(cells=20)
    sheet.scale = (mirror, 1.0, 1.0)
    sheet.meander.points_as = "MESH"
    rings = [scenes.circle_points(radius, 0.0, 60) for radius in (0.4, 0.5)]
    sheet.meander.seed = scenes.poly_curve("Rings", rings, True)
    result = scenes.fill(sheet, 0.1, iteration_limit=1)
    data = result.meander.figures.points.data
    linear = np.array([row[:3] for row in result.meander.surface.matrix_world])[:3]
    points = np.array([vertex.co for vertex in data.vertices]) @ linear.T
    tangents = _attribute(data, "tangent", 3) @ linear.T
    normals = _attribute(data, "surface_normal", 3) @ np.linalg.inv(linear)
    assert (normals[:, 2] > 0.99).all()  # to the outside, also of a mirrored mesh
    right = np.cross(tangents, normals)
    inner = _attribute(data, "strand") == 0
    to_the_right = (right * points).sum(axis=1)[inner] > 0.0
    plus, minus = _attribute(data, "r_plus")[inner], _attribute(data, "r_minus")[inner]
    between = np.where(to_the_right, plus, minus)
    inside = np.where(to_the_right, minus, plus)
    distance = [np.median(np.linalg.norm(points[ring], axis=1)) for ring in (inner, ~inner)]
    assert np.median(between) == pytest.approx((distance[1] - distance[0]) / 2.0, rel=0.02)
    assert np.median(inside) > 1.1 * np.median(between)
