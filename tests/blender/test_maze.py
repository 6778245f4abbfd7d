# SPDX-License-Identifier: GPL-3.0-or-later
"""The walls of a maze as an object: their size, their doors, and what is refused."""

from __future__ import annotations

import math
import re

import bpy
import numpy as np
import pytest
import scenes
from mathutils.bvhtree import BVHTree

SPACING = 0.3


def maze(result: bpy.types.Object, **given: object) -> bpy.types.Object:
    scenes.activate(result)
    assert bpy.ops.meander.maze(**given) == {"FINISHED"}
    return bpy.context.view_layer.objects.active


def points_of(thing: bpy.types.Object) -> np.ndarray:
    matrix = scenes.matrix_of(thing)
    local = np.array([vertex.co[:] for vertex in thing.data.vertices])
    return local @ matrix[:3, :3].T + matrix[:3, 3]


def check_watertight(thing: bpy.types.Object) -> float:
    """Every edge has two faces that turn alike; the volume in the world."""
    rings = [list(polygon.vertices) for polygon in thing.data.polygons]
    directed = [pair for ring in rings for pair in zip(ring, ring[1:] + ring[:1])]
    assert len(set(directed)) == len(directed)
    assert set(directed) == {(b, a) for a, b in directed}
    thing.data.calc_loop_triangles()
    triangles = np.array([triangle.vertices[:] for triangle in thing.data.loop_triangles])
    return float(np.linalg.det(points_of(thing)[triangles]).sum() / 6.0)


def test_walls_stand_on_the_line(tmp_path) -> None:
    surface = scenes.sphere(subdivisions=4)
    result = scenes.fill(surface, SPACING)
    length = scenes.length_of(result)
    walls = maze(result, doors="NONE", width=0.25, height=0.5)
    assert walls.name == f"{result.name} Maze" and walls.parent == surface
    assert result.hide_get() and not surface.hide_get() and surface.visible_get()
    # From half of their width below the surface up to their height.
    away = np.linalg.norm(points_of(walls), axis=1) - 1.0
    assert away.max() == pytest.approx(0.5 * SPACING, abs=0.01)
    assert away.min() == pytest.approx(-0.125 * SPACING, abs=0.01)
    high = 0.625 * SPACING
    assert check_watertight(walls) == pytest.approx(length * 0.25 * SPACING * high, rel=0.12)
    # Every wall is nowhere farther from the line than half of its width.
    tree = BVHTree.FromPolygons(*line_tree(result))
    feet = points_of(walls)[0::4]
    found = [tree.find_nearest(point.tolist())[3] for point in feet]
    assert max(found) < 0.3 * SPACING


def line_tree(result: bpy.types.Object) -> tuple[list, list]:
    """The splines as faces without area."""
    vertices, faces = [], []
    for points, cyclic in scenes.world_splines(result):
        ring = np.vstack([points, points[:1]]) if cyclic else points
        first = len(vertices)
        vertices += ring.tolist()
        faces += [[first + k, first + k + 1, first + k] for k in range(len(ring) - 1)]
    return vertices, faces


def test_doors_are_two_gaps() -> None:
    surface = scenes.sphere()
    result = scenes.fill(surface, SPACING)
    length = scenes.length_of(result)
    whole = maze(result, doors="NONE")
    assert scenes.pieces_of(whole.data) == 1
    volume = check_watertight(whole)
    opened = maze(result, doors="CHOSEN", first_door=0.25, second_door=0.5, door_width=1.0)
    assert scenes.pieces_of(opened.data) == 2
    gaps = 2.0 * (1.0 + 0.2) * SPACING  # as wide between the walls' ends, which are square
    assert check_watertight(opened) / volume == pytest.approx(1.0 - gaps / length, rel=0.02)
    (points, _cyclic), = scenes.world_splines(result)
    ring = np.vstack([points, points[:1]])
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(ring, axis=0), axis=1))])
    for share in (0.25, 0.5):
        place = np.array([np.interp(share * at[-1], at, ring[:, axis]) for axis in range(3)])
        nearest = np.linalg.norm(points_of(opened) - place, axis=1).min()
        assert 0.35 * SPACING < nearest < 0.8 * SPACING
        assert np.linalg.norm(points_of(whole) - place, axis=1).min() < 0.25 * SPACING


def test_the_way_goes_from_door_to_door() -> None:
    spacing = 0.17  # the way depends on the curve: on six sheets it is 13 to 25 spacings long
    sheet = scenes.grid(cells=16)
    result = scenes.fill(sheet, spacing)
    walls = maze(result, solution=True)
    way = bpy.data.objects[f"{walls.name} Solution"]
    assert way.type == "CURVE" and way.parent == sheet and way.meander.surface is None
    (points, cyclic), = scenes.world_splines(way)
    assert not cyclic and way.data.bevel_depth == pytest.approx(0.08 * spacing)
    vertices = points_of(walls)
    tree = BVHTree.FromPolygons(
        vertices.tolist(), [list(polygon.vertices) for polygon in walls.data.polygons]
    )
    clear = [tree.find_nearest(point.tolist())[3] for point in points]
    # On fourteen sheets and spacings the narrowest place is .08 to .26 of a spacing from a wall.
    assert min(clear) > 0.05 * spacing, "no wall stands in the way"
    for end in points[[0, -1]]:
        assert (1.0 - np.abs(end[:2])).min() < spacing, "doors at the border of the sheet"
    assert np.linalg.norm(np.diff(points, axis=0), axis=1).sum() > 15.0 * spacing


@pytest.mark.parametrize("scale", [(1.3, 1.3, 1.3), (-1.0, 1.0, 1.0), (1.0, 1.5, 0.5)])
def test_objects_that_are_scaled_turned_or_mirrored(scale: tuple) -> None:
    surface = scenes.sphere()
    surface.scale, surface.location = scale, (1.0, 2.0, 3.0)
    surface.rotation_euler = (0.3, 0.4, math.pi / 3)
    bpy.context.view_layer.update()
    result = scenes.fill(surface, SPACING)
    length = scenes.length_of(result)
    walls = maze(result, doors="NONE")
    # Blender turns the faces of what is mirrored by itself.
    volume = check_watertight(walls) * math.copysign(1.0, scale[0])
    assert volume == pytest.approx(length * 0.2 * 0.7 * SPACING**2, rel=0.15)
    outward = np.linalg.norm(points_of(walls)[1] - surface.location)
    assert outward > np.linalg.norm(points_of(walls)[0] - surface.location)


def refused(result: bpy.types.Object, **given: object) -> str:
    scenes.activate(result)
    before = scenes.counts()
    with pytest.raises(RuntimeError) as caught:
        bpy.ops.meander.maze(**given)
    assert scenes.counts() == before
    return str(caught.value).removeprefix("Error: ").strip()


def test_a_curve_with_one_side_is_refused() -> None:
    sheet = scenes.grid(cells=8)
    sheet.meander.seed = scenes.poly_curve("Stroke", [[(-0.5, 0.0, 0.0), (0.5, 0.0, 0.0)]], False)
    sentence = refused(scenes.fill(sheet, 0.4))
    assert sentence.startswith("The curve has only one side, and walls that end part nothing; fill")


def test_several_parts_have_walls_of_their_own() -> None:
    one, other = scenes.sphere(), scenes.cube()
    other.location.x = 4.0
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.join()
    both = scenes.activate(bpy.context.view_layer.objects.active)
    assert {one, other} & {both}
    result = scenes.fill(both, 0.5)
    assert len(result.data.splines) == 2
    assert scenes.pieces_of(maze(result, doors="NONE").data) == 2
    assert scenes.pieces_of(maze(result).data) == 3, "one of them has two doors"


def disc(radius: float, rings: int) -> bpy.types.Object:
    vertices, faces = [(0.0, 0.0, 0.0)], []
    for ring in range(1, rings + 1):
        for k in range(48):
            angle = 2.0 * math.pi * k / 48
            away = radius * ring / rings
            vertices.append((away * math.cos(angle), away * math.sin(angle), 0.0))
    for k in range(48):
        faces.append((0, 1 + k, 1 + (k + 1) % 48))
        for ring in range(rings - 1):
            a, b = 1 + 48 * ring, 1 + 48 * (ring + 1)
            faces.append((a + k, b + k, b + (k + 1) % 48, a + (k + 1) % 48))
    return scenes.mesh_object("Disc", vertices, faces)


@pytest.mark.parametrize("spacing", [0.11, 0.13, 0.15, 0.17])
def test_a_maze_on_a_disc_leads_through_its_middle(spacing: float, capfd) -> None:
    result = scenes.fill(disc(1.0, 12), spacing)
    walls = maze(result, solution=True)
    way = bpy.data.objects[f"{walls.name} Solution"]
    ((points, _cyclic),) = scenes.world_splines(way)
    # By the straight line, three quarters of the disc; by angle, more than a quarter turn.
    assert np.linalg.norm(points[0] - points[-1]) > 1.4
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    rim = np.linalg.norm(points[1:, :2], axis=1) > 1.0 - 2.0 * spacing
    assert steps[rim].sum() < 0.6 * steps.sum()
    assert steps.sum() > 12.0 * spacing
    said = capfd.readouterr().out
    found = re.search(r"(\d+) spacings from door to door, (\d+) turns?, (\d+) dead ends?", said)
    assert found, said
    length, turns, ends = (int(number) for number in found.groups())
    assert length == pytest.approx(steps.sum() / spacing, abs=1.0)
    assert 2 <= turns <= length and 1 <= ends < 200
