# SPDX-License-Identifier: GPL-3.0-or-later
"""What is known of a result's points, as a file and as attributes of a mesh."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import bpy
import numpy as np
import scenes


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
    ways = [float(row["arc_length"]) for row in rows if row["strand"] == "0"]
    assert 0.09 < ways[1] <= 0.1
    assert np.allclose(np.diff(ways), ways[1])


def test_mesh_has_the_attributes() -> None:
    result = scenes.fill(scenes.sphere(), 0.4)
    points = np.vstack([points for points, _cyclic in scenes.world_splines(result)])
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
    ways = values("arc_length", "float", 1)[:, 0]
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    assert np.allclose(np.diff(ways), steps, atol=1e-5)
    normals, tangents = values("surface_normal", "float", 3), values("tangent", "float", 3)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-5)
    assert np.abs((normals * tangents).sum(axis=1)).max() < 0.3
