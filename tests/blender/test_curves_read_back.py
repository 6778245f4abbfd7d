# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves that the command writes as OBJ, read by Blender's own importer: all points, all segments.

The importer of Blender 3.4 reads two points of a line, so --lines pairs is for it, and for others
like it; both are the same curve.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import bpy
import geometry
import numpy as np
import pytest
from meander import batch
from scenes import column


@dataclass(frozen=True)
class Written:
    title: str
    mesh: geometry.Mesh
    spacing: float
    words: tuple[str, ...] = ()


def scaled(mesh: geometry.Mesh, scale: float, by: float = 0.0) -> geometry.Mesh:
    return geometry.mesh(mesh.vertices * scale + by, mesh.faces)


GRID, BALL = geometry.grid(8), geometry.icosphere(2)
WRITTEN = (
    Written("a sheet", GRID, 0.1),
    Written("a ball", BALL, 0.3),
    Written("two parts", geometry.two_spheres(), 0.4),
    Written("a ball in thousandths", scaled(BALL, 1e-3), 3e-4),
    Written("a ball in thousands", scaled(BALL, 1e3), 300.0),
    Written("a ball far from the origin", scaled(BALL, 1.0, 100.0), 0.3),
    Written("an open stroke", GRID, 0.1, ("--from", "0", "0", "0", "--to", "1", "1", "0")),
    Written("a light curve", BALL, 0.3, ("--light", "0.1")),
)
LINES = ("pairs",) if bpy.app.version < (4, 0) else ("pairs", "strands")


def read_by_blender(path: Path) -> tuple[np.ndarray, np.ndarray]:
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    axes = {"up_axis": "Z", "forward_axis": "Y"}
    bpy.ops.wm.obj_import(filepath=str(path), **axes)
    meshes = [thing.data for thing in bpy.data.objects if thing.type == "MESH"]
    points, edges, count = [], [], 0
    for mesh in meshes:
        points.append(column(mesh.vertices, "co", 3))
        edges.append(column(mesh.edges, "vertices", 2, np.int32) + count)
        count += len(mesh.vertices)
    return np.vstack(points).astype(np.float64), np.vstack(edges)


def as_written(path: Path) -> tuple[np.ndarray, np.ndarray]:
    rows = [line.split() for line in path.read_text().splitlines()]
    points = np.array([row[1:] for row in rows if row and row[0] == "v"], dtype=float)
    edges = [
        (int(a) - 1, int(b) - 1)
        for row in rows if row and row[0] == "l"
        for a, b in zip(row[1:], row[2:])
    ]  # fmt: skip
    return points, np.array(edges)


@pytest.mark.parametrize("lines", LINES)
@pytest.mark.parametrize("curve", WRITTEN, ids=lambda curve: curve.title)
def test_blender_reads_all_of_a_curve(tmp_path: Path, curve: Written, lines: str) -> None:
    mesh = geometry.write_obj(tmp_path / "mesh.obj", curve.mesh)
    out, report = tmp_path / "out.obj", tmp_path / "report.json"
    given = ["--input", mesh, "--output", out, "--report", report, "--spacing", curve.spacing]
    given += ["--lines", lines, "--quiet", "--iterations", "40", *curve.words]
    assert batch.main([str(one) for one in given]) == 0
    points, edges = read_by_blender(out)
    wanted_points, wanted_edges = as_written(out)
    assert len(points) == len(wanted_points)
    assert len(edges) == len(wanted_edges)
    # Single precision, of coordinates that may be far from the origin.
    assert np.abs(points - wanted_points).max() < 1e-6 * np.abs(wanted_points).max()
    pairs = {tuple(sorted(pair)) for pair in edges.tolist()}
    assert pairs == {tuple(sorted(pair)) for pair in wanted_edges.tolist()}
    if "--light" not in curve.words:
        length = np.linalg.norm(np.diff(wanted_points[wanted_edges], axis=1)[:, 0], axis=1).sum()
        assert length == pytest.approx(json.loads(report.read_text())["length"], rel=1e-6)
