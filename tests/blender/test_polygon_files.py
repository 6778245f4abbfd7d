# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons in files: our readers find the surface that Blender's own importers find.

Polygons are random ones: concave, with holes that bridges join to their rims, not quite flat, and
touching themselves. Areas are compared one polygon at a time.
"""

from __future__ import annotations

from pathlib import Path

import bpy
import geometry
import numpy as np
import pytest
from meander.model.files import meshes

COUNT = 20
Polygon = np.ndarray  # (n, 3)


def star(rng: np.random.Generator, corners: int) -> np.ndarray:
    """A concave polygon around the origin, (n, 2), counter-clockwise."""
    angles = np.sort(rng.uniform(0.0, 2.0 * np.pi, corners - 3))
    angles = np.sort(np.concatenate([angles, [0.1, 2.2, 4.3]]))
    radii = rng.uniform(0.3, 1.0, corners)
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])


def comb(rng: np.random.Generator, teeth: int) -> np.ndarray:
    """Spikes of random heights on a bar."""
    x = np.arange(2 * teeth + 1, dtype=float)
    y = np.where(np.arange(2 * teeth + 1) % 2, rng.uniform(0.5, 2.0, 2 * teeth + 1), 0.2)
    top = np.column_stack([x, y])[::-1]
    return np.vstack([[[0.0, 0.0], [2.0 * teeth, 0.0]], top])


def bridged(rng: np.random.Generator) -> np.ndarray:
    """A star-shaped hole in a larger rim, joined by a bridge that the polygon passes twice."""
    rim = np.array([(-3.0, -3.0), (3.0, -3.0), (3.0, 3.0), (-3.0, 3.0)])
    hole = star(rng, 9)[::-1]
    first = int(np.argmin(hole.sum(axis=1)))
    hole = np.roll(hole, -first, axis=0)
    return np.vstack([rim, rim[:1], hole, hole[:1]])


def touching(rng: np.random.Generator) -> np.ndarray:
    """Two lobes that meet in one point, where the polygon passes twice."""
    one = star(rng, 7) + [1.5, 0.0]
    other = star(rng, 7) - [1.5, 0.0]
    left, right = int(np.argmin(one[:, 0])), int(np.argmax(other[:, 0]))
    one, other = np.roll(one, -left, axis=0), np.roll(other, -right, axis=0)
    meeting = np.zeros((1, 2))
    return np.vstack([meeting, one[1:], meeting, other[1:]])


def turned(rng: np.random.Generator, flat: np.ndarray, bent: float) -> Polygon:
    """In space: at a random angle, and so far from flat."""
    axes, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    places = np.column_stack([flat, bent * rng.normal(size=len(flat))])
    return places @ axes.T + rng.normal(size=3)


KINDS = {
    "concave": (lambda rng: star(rng, int(rng.integers(5, 30))), 0.0),
    "quadrangles": (lambda rng: star(rng, 4), 0.0),
    "bent quadrangles": (lambda rng: star(rng, 4), 0.2),
    "comb": (lambda rng: comb(rng, int(rng.integers(2, 12))), 0.0),
    "bridged": (bridged, 0.0),
    "touching": (touching, 0.0),
    "not quite flat": (lambda rng: star(rng, int(rng.integers(5, 30))), 0.02),
}


def polygons_of(kind: str) -> list[Polygon]:
    make, bent = KINDS[kind]
    rng = np.random.default_rng(list(KINDS).index(kind))
    # Single precision is what Blender keeps.
    return [
        turned(rng, make(rng), bent).astype(np.float32).astype(float) for _ in range(COUNT)
    ]


def obj_of(polygons: list[Polygon]) -> bytes:
    lines, at = [], 0
    for polygon in polygons:
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in polygon.tolist()]
        lines.append("f " + " ".join(str(at + k + 1) for k in range(len(polygon))))
        at += len(polygon)
    return ("\n".join(lines) + "\n").encode()


def ply_of(polygons: list[Polygon]) -> bytes:
    places = np.concatenate(polygons)
    lines = ["ply", "format ascii 1.0", f"element vertex {len(places)}"]
    lines += [f"property float {axis}" for axis in "xyz"]
    lines += [f"element face {len(polygons)}", "property list uchar int vertex_indices"]
    lines.append("end_header")
    lines += [f"{x!r} {y!r} {z!r}" for x, y, z in places.tolist()]
    at = 0
    for polygon in polygons:
        lines.append(" ".join(map(str, (len(polygon), *range(at, at + len(polygon))))))
        at += len(polygon)
    return ("\n".join(lines) + "\n").encode()


def imported(path: Path) -> bpy.types.Mesh:
    before = set(bpy.data.objects)
    if path.suffix == ".obj":
        bpy.ops.wm.obj_import(filepath=str(path), forward_axis="Y", up_axis="Z")
    elif bpy.app.version >= (3, 6, 0):
        bpy.ops.wm.ply_import(filepath=str(path), forward_axis="Y", up_axis="Z")
    else:
        bpy.ops.import_mesh.ply(filepath=str(path))
    (made,) = set(bpy.data.objects) - before
    return made.data


def areas_in_blender(path: Path) -> float:
    mesh = imported(path)
    mesh.calc_loop_triangles()
    places = np.array([vertex.co[:] for vertex in mesh.vertices], dtype=float)
    triangles = np.array([t.vertices[:] for t in mesh.loop_triangles])
    return float(geometry.triangle_areas(places, triangles).sum())


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("suffix", [".obj", ".ply"])
def test_a_polygon_has_the_area_that_it_has_in_blender(kind, suffix, tmp_path):
    path = tmp_path / f"mesh{suffix}"
    write = {".obj": obj_of, ".ply": ply_of}[suffix]
    for number, polygon in enumerate(polygons_of(kind)):
        path.write_bytes(write([polygon]))
        ours = meshes.read(path)
        area = float(geometry.triangle_areas(ours.vertices, ours.faces).sum())
        assert area == pytest.approx(areas_in_blender(path), rel=2e-5), f"polygon {number}"
        assert len(ours.faces) <= len(polygon) - 2


@pytest.mark.parametrize("suffix", [".obj", ".ply"])
def test_many_polygons_in_one_file(suffix, tmp_path):
    polygons = [polygon for kind in KINDS for polygon in polygons_of(kind)]
    path = tmp_path / f"mesh{suffix}"
    path.write_bytes({".obj": obj_of, ".ply": ply_of}[suffix](polygons))
    ours = meshes.read(path)
    area = float(geometry.triangle_areas(ours.vertices, ours.faces).sum())
    assert area == pytest.approx(areas_in_blender(path), rel=2e-5)
    assert sorted(set(ours.polygons.tolist())) == list(range(len(polygons)))


def test_vertices_that_a_bridge_passes_twice(tmp_path):
    """The same numbers on both sides of the bridge, where Blender's importer mends the polygon."""
    rng = np.random.default_rng(5)
    for _ in range(COUNT):
        ring = bridged(rng)
        places, numbers = [], []
        for corner in ring.tolist():
            if corner not in places:
                places.append(corner)
            numbers.append(places.index(corner) + 1)
        path = tmp_path / "mesh.obj"
        text = "".join(f"v {x!r} {y!r} 0\n" for x, y in np.float32(places).tolist())
        path.write_text(text + "f " + " ".join(map(str, numbers)) + "\n")
        ours = meshes.read(path)
        area = float(geometry.triangle_areas(ours.vertices, ours.faces).sum())
        assert area == pytest.approx(areas_in_blender(path), rel=2e-5)


def test_a_file_that_blender_writes_is_the_surface_in_blender(tmp_path):
    """Blender writes polygons as they are, also those that a Boolean leaves."""
    bpy.ops.mesh.primitive_cube_add(size=2.0)
    cube = bpy.context.object
    bpy.ops.mesh.primitive_cylinder_add(radius=0.6, depth=3.0, vertices=12)
    cutter = bpy.context.object
    hole = cube.modifiers.new("Hole", "BOOLEAN")
    hole.operation, hole.object = "DIFFERENCE", cutter
    bpy.context.view_layer.objects.active = cube
    bpy.ops.object.modifier_apply(modifier="Hole")
    bpy.data.objects.remove(cutter)
    cube.data.calc_loop_triangles()
    places = np.array([vertex.co[:] for vertex in cube.data.vertices], dtype=float)
    triangles = np.array([t.vertices[:] for t in cube.data.loop_triangles])
    path = tmp_path / "cube.obj"
    bpy.ops.wm.obj_export(filepath=str(path))
    ours = meshes.read(path)
    assert max(len(polygon.vertices) for polygon in cube.data.polygons) > 4
    assert geometry.triangle_areas(ours.vertices, ours.faces).sum() == pytest.approx(
        geometry.triangle_areas(places, triangles).sum(), rel=1e-4
    )
