# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions, borders and faulty meshes in Blender: what is filled, reported, and selected."""

from __future__ import annotations

import json

import bpy
import numpy as np
import pytest
from scenes import activate, fill, grid, mesh_object, points_of, refused, saved, world_splines

SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]


def told(surface: bpy.types.Object) -> str:
    """What the last run has done to the mesh, in words."""
    return surface.meander.last_result.meander.figures.preparation


def half_and_half() -> bpy.types.Object:
    """A square from -1 to 1 whose faces with x > 0 are marked in every way there is."""
    surface = grid(20)
    mesh = surface.data
    for name in ("Left", "Right"):
        mesh.materials.append(bpy.data.materials.new(name))
    right = np.array([polygon.center.x > 0.0 for polygon in mesh.polygons])
    mesh.polygons.foreach_set("material_index", right.astype(np.int32))
    mesh.attributes.new("flag", "BOOLEAN", "FACE").data.foreach_set("value", right)
    mesh.attributes.new("number", "INT", "FACE").data.foreach_set("value", 3 * right.astype(int))
    mesh.attributes.new("height", "FLOAT", "FACE")
    group = surface.vertex_groups.new(name="Slope")
    for vertex in mesh.vertices:
        group.add([vertex.index], (vertex.co.x + 1.0) / 2.0, "REPLACE")
    if hasattr(surface, "face_maps"):
        surface.face_maps.new(name="Nothing")
        surface.face_maps.new(name="Map").add(np.flatnonzero(right).tolist())
    return surface


@pytest.mark.parametrize(
    "settings",
    [
        {"mask_source": "MATERIAL", "mask_material": "Right"},
        {"mask_source": "MATERIAL", "mask_material": "Left", "mask_inverted": True},
        {"mask_source": "ATTRIBUTE", "mask_attribute": "flag"},
        {"mask_source": "ATTRIBUTE", "mask_attribute": "number"},
        {"mask_source": "ATTRIBUTE", "mask_attribute": "Map"},
        {"mask_source": "GROUP", "mask_group": "Slope"},
    ],
)
def test_the_curve_stays_in_the_part_chosen(settings):
    surface = half_and_half()
    if settings.get("mask_attribute") == "Map" and not hasattr(surface, "face_maps"):
        pytest.skip("this Blender has no face maps")
    points = points_of(fill(surface, 0.2, **settings))
    assert points[:, 0].min() > 0.0
    assert points[:, 0].min() < 0.2 and points[:, 0].max() > 0.8
    assert "left out 200 faces" in told(surface).replace("400", "200")


def test_a_threshold_runs_through_faces_and_can_be_turned_round():
    surface = half_and_half()
    settings = {"mask_source": "GROUP", "mask_group": "Slope", "mask_threshold": 0.62}
    high = points_of(fill(surface, 0.2, **settings))
    assert 0.24 < high[:, 0].min() < 0.4
    assert "clipped" in told(surface)
    low = points_of(fill(activate(surface), 0.2, **settings, mask_inverted=True))
    assert 0.1 < low[:, 0].max() < 0.24


@pytest.mark.parametrize(
    ("settings", "word"),
    [
        ({"mask_source": "MATERIAL"}, "Choose the material"),
        ({"mask_source": "MATERIAL", "mask_material": "Gold"}, "'Left', 'Right'"),
        ({"mask_source": "ATTRIBUTE", "mask_attribute": "height"}, "float per face"),
        ({"mask_source": "ATTRIBUTE", "mask_attribute": "depth"}, "'flag'"),
        ({"mask_source": "GROUP", "mask_group": "Slope", "mask_threshold": 1.0}, "no faces"),
        ({"mask_source": "GROUP", "mask_group": "Nowhere"}, "'Slope'"),
    ],
)
def test_masks_without_faces_are_refused(settings, word):
    surface = half_and_half()
    if "no faces" in word:
        surface.vertex_groups["Slope"].add(range(len(surface.data.vertices)), 0.5, "REPLACE")
    assert word in refused(surface, **settings)


def test_the_distance_from_the_border():
    surface = grid(20)
    for distance in (0.25, 1.0):
        points = points_of(fill(activate(surface), 0.2, border_distance=distance))
        side = np.sort(1.0 - np.abs(points[:, :2]).max(axis=1))
        assert 0.2 * distance * 0.3 < side[0] < 0.2 * distance * 1.1


def test_an_outline_first():
    surface = grid(20)
    curve = fill(surface, 0.2, use_outline=True, border_distance=0.75)
    strands = world_splines(curve)
    assert len(strands) == 2 and all(closed for _points, closed in strands)
    side = 1.0 - np.abs(strands[0][0][:, :2]).max(axis=1)
    assert abs(np.median(side) - 0.15) < 0.01
    assert (1.0 - np.abs(strands[1][0][:, :2]).max(axis=1)).min() > 0.2
    activate(curve)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert len(world_splines(curve)) == 2
    assert "0.1" in refused(surface, 0.2, border_distance=0.0)


def test_loose_edges_and_vertices_are_reported():
    surface = mesh_object("Loose", [*SQUARE, (5, 5, 5), (6, 6, 6), (7, 7, 7)], [(0, 1, 2, 3)])
    surface.data.edges.add(1)
    surface.data.edges[-1].vertices = (4, 5)
    surface.data.update()
    fill(surface, 0.2)
    assert told(surface) == "ignored 3 loose vertices, ignored 1 loose edge"


def soup(surface: bpy.types.Object) -> bpy.types.Object:
    """The same faces, none of which shares a vertex with another."""
    mesh = surface.data
    vertices = [mesh.vertices[v].co[:] for face in mesh.polygons for v in face.vertices]
    ends = np.cumsum([0] + [len(face.vertices) for face in mesh.polygons])
    faces = [list(range(a, b)) for a, b in zip(ends[:-1], ends[1:])]
    return mesh_object("Soup", vertices, faces)


def test_merging_makes_one_surface_of_a_soup():
    surface = soup(grid(6))
    curve = fill(surface, 0.2, use_merge=True, merge_distance=0.001, strict=True)
    assert len(world_splines(curve)) == 1
    assert told(surface) == "merged 95 vertices"
    assert len(surface.data.vertices) == 144  # the mesh itself is left alone
    curve = fill(activate(surface), 0.2, use_merge=False, strict=False)
    assert len(world_splines(curve)) == 1
    assert told(surface) == "closed 60 edges of seams"


def bow_tie() -> bpy.types.Object:
    return mesh_object(
        "Bow", [(0, 0, 0), (1, 1, 0), (1, -1, 0), (-1, 1, 0), (-1, -1, 0)], [(0, 1, 2), (0, 3, 4)]
    )


def fin() -> bpy.types.Object:
    return mesh_object("Fin", [*SQUARE, (0.5, 0.5, 1)], [(0, 1, 2), (0, 2, 3), (0, 2, 4)])


def flat() -> bpy.types.Object:
    return mesh_object("Flat", [*SQUARE, (2, 0, 0)], [(0, 1, 2), (0, 2, 3), (0, 1, 4)])


def torn() -> bpy.types.Object:
    """The same fault twice, and another: a bow-tie, and two fins."""
    first = fin()
    x = [(v.co.x + 5, v.co.y, v.co.z) for v in first.data.vertices]
    both = [*(v.co[:] for v in first.data.vertices), *x, (2, -1, 0), (1, -1, 0)]
    faces = [tuple(face.vertices) for face in first.data.polygons]
    bpy.data.objects.remove(first)
    faces += [tuple(v + 5 for v in face) for face in faces] + [(1, 10, 11)]
    return mesh_object("Torn", both, faces)


@pytest.mark.parametrize(
    ("build", "setting", "mode", "chosen", "fault", "word"),
    [
        (bow_tie, "split_bow_ties", 0, {0}, "1 place where parts touch in one", "split 1 vertex"),
        (fin, "", 1, {0, 2}, "1 place where more than two faces share an", "cut 1 edge with more"),
        (flat, "drop_degenerate", 2, {0, 1, 4}, "1 face without area", "dropped 1 face"),
        (torn, "", 0, {0, 1, 2, 5, 7}, "2 places where more than two faces", "split 1 vertex"),
    ],
)
def test_faults_are_shown_and_mended(build, setting, mode, chosen, fault, word):
    surface = build()
    sentence = refused(surface, spacing=0.1, strict=True)
    assert fault in sentence and "turn off Strict" in sentence
    assert surface.meander.problem.sentence == sentence
    assert bpy.ops.meander.select_problem() == {"FINISHED"}
    assert surface.mode == "EDIT"
    assert bpy.context.tool_settings.mesh_select_mode[mode]
    bpy.ops.object.mode_set(mode="OBJECT")
    assert {vertex.index for vertex in surface.data.vertices if vertex.select} == chosen
    if setting:  # by itself
        fill(activate(surface), 0.1, **{setting: True})
        assert word in told(surface)
        bpy.data.objects.remove(bpy.context.object)
    before = len(surface.data.vertices), len(surface.data.polygons)
    fill(activate(surface), 0.1, strict=False)
    assert word in told(surface)
    result = surface.meander.last_result
    assert result.meander.figures.mended > 0 and not surface.meander.problem.sentence
    assert (len(surface.data.vertices), len(surface.data.polygons)) == before


def test_faults_that_modifiers_make_are_not_guessed():
    corners = [(0, 0, 0), (1, 1, 0), (1, -1, 0), (0, 0, 0), (-1, 1, 0), (-1, -1, 0)]
    surface = mesh_object("Welded", corners, [(0, 1, 2), (3, 4, 5)])
    surface.modifiers.new("Weld", "WELD")
    assert "touch in one point" in refused(surface, spacing=0.1, strict=True)
    with pytest.raises(RuntimeError, match="modifiers"):
        bpy.ops.meander.select_problem()


def test_vertices_without_a_position_remain_and_are_shown():
    surface = mesh_object("Lost", [*SQUARE, (0, float("nan"), 0)], [(0, 1, 2, 3), (0, 1, 4)])
    sentence = refused(surface, spacing=0.1)
    assert "1 vertex without a position" in sentence and "correct" in sentence
    assert bpy.ops.meander.select_problem() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert [vertex.index for vertex in surface.data.vertices if vertex.select] == [4]


def test_results_keep_how_they_were_made():
    surface = half_and_half()
    curve = fill(surface, 0.2, mask_source="GROUP", mask_group="Slope", border_distance=1.0)
    assert curve.meander.mask_group == "Slope"
    assert curve.meander.border_distance == 1.0
    activate(curve)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert points_of(curve)[:, 0].min() > 0.05


def test_the_batch_command(tmp_path, run_batch):
    surface = half_and_half()
    surface.name = "Square"
    path = saved(tmp_path / "scene.blend")
    curve, report = tmp_path / "curve.obj", tmp_path / "report.json"
    base = ["--input", path, "--object", "Square", "--spacing", "0.2", "--iterations", "40"]
    base += ["--output", curve, "--report", report]
    done = run_batch(
        *base,
        *("--mask-group", "Slope", "--mask-threshold", "0.62", "--border-distance", "1"),
        *("--merge-distance", "0.0001", "--split-bow-ties", "--drop-degenerate", "--outline"),
    )
    assert done.returncode == 0, done.stderr
    record = json.loads(report.read_text())
    assert record["options"]["mask_group"] == "Slope"
    assert record["options"]["mask_threshold"] == 0.62
    assert record["options"]["boundary_distance"] == 1.0
    assert record["options"]["merge_distance"] == 0.0001
    assert record["preparation"]["clipped_faces"] > 0
    assert record["preparation"]["merged_vertices"] == 0
    assert "clipped" in done.stdout
    assert record["guides"] == 1 and record["preparation"]["skipped_outlines"] == 0
    x = [float(line.split()[1]) for line in curve.read_text().splitlines() if line[:2] == "v "]
    assert min(x) > 0.3
    assert record["options"]["strict"] is False
    before = curve.read_bytes()
    for extra, word in (
        (("--mask-group", "Nowhere"), "Nowhere"),
        (("--mask-material", "Left", "--mask-attribute", "flag"), "both given"),
        (("--mask-threshold", "0.5"), "--mask-group"),
    ):
        done = run_batch(*base, *extra)
        assert done.returncode == 2 and word in done.stderr
        assert len(done.stderr.strip().splitlines()) == 1
        assert curve.read_bytes() == before
