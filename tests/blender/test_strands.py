# SPDX-License-Identifier: GPL-3.0-or-later
"""Strands in Blender: one spline comes back as one spline, strokes keep their ends, guides stay."""

from __future__ import annotations

import bpy
import numpy as np
import panel_layout
import pytest
from meander.run import motion
from meander.ui.panels import MEANDER_PT_figures
from scenes import (
    activate,
    circle_points,
    counts,
    cube,
    fill,
    grid,
    packing,
    point_count,
    poly_curve,
    refused,
    sphere,
    world_splines,
)


def empty(name: str, place: tuple) -> bpy.types.Object:
    thing = bpy.data.objects.new(name, None)
    bpy.context.scene.collection.objects.link(thing)
    thing.location = place
    bpy.context.view_layer.update()
    return thing


def material(name: str) -> bpy.types.Material:
    return bpy.data.materials.new(name)


def distance_to_line(points: np.ndarray, a, b) -> np.ndarray:
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    t = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)[:, None]
    return np.linalg.norm(points - (a + t * (b - a)), axis=1)


LINE = ((-0.6, 0.1, 0.0), (0.6, 0.3, 0.0))


# -- what was one spline comes back as one ---------------------------------------------------------


def test_splines_keep_their_materials_and_the_result_the_seeds_name():
    surface = grid()
    seed = poly_curve("Trail", [[(-0.8, y, 0), (0.8, y, 0)] for y in (-0.7, 0.0, 0.7)], False)
    loop = seed.data.splines.new("POLY")
    ring = circle_points(0.2, 0.0, 12)
    loop.points.add(len(ring) - 1)
    for point, (x, y, z) in zip(loop.points, ring, strict=True):
        point.co = (x, y + 0.35, z, 1)
    loop.use_cyclic_u = True
    for name in ("Red", "Green"):
        seed.data.materials.append(material(name))
    for spline, index in zip(seed.data.splines, (1, 0, 1, 0), strict=True):
        spline.material_index = index
    result = fill(surface, 0.2, seed=seed)
    assert result.name == "Trail Meander"
    assert [slot.name for slot in result.data.materials] == ["Red", "Green"]
    assert [spline.material_index for spline in result.data.splines] == [1, 0, 1, 0]
    assert [spline.use_cyclic_u for spline in result.data.splines] == [False, False, False, True]
    # Going on keeps them, also where the user has changed them since.
    result.data.splines[1].material_index = 1
    result.meander.iteration_limit = 3
    activate(result)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert [spline.material_index for spline in result.data.splines] == [1, 1, 1, 0]


def test_parts_without_a_seed_are_told_of_and_can_be_filled(capfd):
    surface = sphere()
    surface.modifiers.new("Array", "ARRAY").relative_offset_displace = (1.5, 0.0, 0.0)
    seed = poly_curve("Seed", [circle_points(0.45, 0.89)], True)
    result = fill(surface, 0.4, seed=seed)
    assert len(result.data.splines) == 1
    assert result.meander.figures.empty_parts == 1
    for thing in (result, surface):
        activate(thing)
        texts = [text.text for text in panel_layout.drawn(MEANDER_PT_figures, bpy.context).texts()]
        assert "Parts remain empty" in texts, "in Last Run, where one looks"
    result = fill(surface, 0.4, seed=seed, seed_every_part=True)
    assert len(result.data.splines) == 2
    assert result.meander.figures.empty_parts == 0
    assert packing(surface, result) == pytest.approx(1.0, abs=0.2)


# -- one stroke ------------------------------------------------------------------------------------


def test_a_stroke_between_two_objects_fills_and_keeps_its_ends():
    surface = grid()
    ends = [empty("A", (-0.7, -0.7, 0.02)), empty("B", (0.7, 0.5, 0.0))]
    result = fill(surface, 0.2, stroke_from=ends[0], stroke_to=ends[1])
    ((points, cyclic),) = world_splines(result)
    assert not cyclic
    assert np.abs(points[0] - (-0.7, -0.7, 0.0)).max() < 1e-6
    assert np.abs(points[-1] - (0.7, 0.5, 0.0)).max() < 1e-6
    assert packing(surface, result) == pytest.approx(1.0, abs=0.15)
    # The ends stay also when the result goes on.
    result.meander.iteration_limit = 3
    activate(result)
    assert bpy.ops.meander.run() == {"FINISHED"}
    ((points, _cyclic),) = world_splines(result)
    assert np.abs(points[0] - (-0.7, -0.7, 0.0)).max() < 2e-6


def test_a_stroke_between_two_vertices():
    surface = sphere()
    chosen = [0, 7]
    for vertex in surface.data.vertices:
        vertex.select = vertex.index in chosen
    for items in (surface.data.edges, surface.data.polygons):
        for item in items:
            item.select = False
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.meander.stroke_from_vertices() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    stroke = surface.meander.seed
    assert stroke.name == f"{surface.name} Stroke" and surface.meander.fixed_ends
    assert stroke.parent == surface
    result = fill(surface, 0.3)
    ((points, cyclic),) = world_splines(result)
    assert not cyclic
    wanted = [surface.data.vertices[i].co[:] for i in chosen]
    assert np.abs(points[[0, -1]] - wanted).max() < 1e-6
    assert packing(surface, result) == pytest.approx(1.0, abs=0.15)


def test_a_stroke_needs_two_vertices():
    surface = cube()
    for vertex in surface.data.vertices:
        vertex.select = vertex.index < 3
    bpy.ops.object.mode_set(mode="EDIT")
    before = counts()
    with pytest.raises(RuntimeError, match="select two, the ends"):
        bpy.ops.meander.stroke_from_vertices()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert counts() == before


def test_a_stroke_needs_both_ends_on_one_part():
    surface = grid()
    a = empty("A", (0.0, 0.0, 0.0))
    assert "One end of the stroke is missing" in refused(surface, stroke_from=a)
    surface.modifiers.new("Array", "ARRAY").relative_offset_displace = (1.5, 0.0, 0.0)
    b = empty("B", (3.0, 0.0, 0.0))
    sentence = refused(surface, stroke_to=b)
    assert "leaves its part of the surface" in sentence and "'A to B'" in sentence


# -- guides ----------------------------------------------------------------------------------------


def test_guides_stay_as_drawn_and_are_splines_of_the_result():
    surface = grid()
    guides = poly_curve("Guides", [list(LINE)], False)
    guides.data.materials.append(material("Ink"))
    result = fill(surface, 0.2, guides=guides)
    splines = world_splines(result)
    assert [cyclic for _points, cyclic in splines] == [False, True]
    assert distance_to_line(splines[0][0], *LINE).max() < 1e-6
    for end, drawn in zip(splines[0][0][[0, -1]], LINE, strict=True):
        assert np.abs(end - drawn).max() < 1e-6
    # The others keep about the spacing from it.
    away = distance_to_line(splines[1][0], *LINE)
    assert 0.6 * 0.2 < away.min() < 1.4 * 0.2
    assert packing(surface, result) == pytest.approx(1.0, abs=0.15)
    assert (result.meander.figures.first_guide, result.meander.figures.guides) == (0, 1)
    assert [m.name for m in result.data.materials] == ["Ink"]


def test_a_result_with_guides_goes_on_and_they_still_stay():
    surface = grid()
    guides = poly_curve("Guides", [list(LINE)], False)
    seed = poly_curve("Seed", [[(-0.5, -0.6, 0), (0.5, -0.6, 0)]], False)
    result = fill(surface, 0.2, guides=guides, seed=seed, iteration_limit=20)
    drawn_object = result.meander.guides
    for redrawn in (drawn_object, None):  # read from where they were drawn, or from the result
        result.meander.guides = redrawn
        activate(result)
        assert bpy.ops.meander.run() == {"FINISHED"}
        splines = world_splines(result)
        assert [cyclic for _points, cyclic in splines] == [False, False]
        assert distance_to_line(splines[1][0], *LINE).max() < 1e-5
        figures = result.meander.figures
        assert (figures.strands, figures.first_guide, figures.guides) == (2, 1, 1)
    result.data.splines.remove(result.data.splines[0])
    assert "use Fill Again" in refused(result)


def test_guides_can_be_left_out_of_the_result():
    surface = grid()
    guides = poly_curve("Guides", [list(LINE)], False)
    result = fill(surface, 0.2, guides=guides, keep_guides=False)
    ((points, cyclic),) = world_splines(result)
    assert cyclic and distance_to_line(points, *LINE).min() > 0.6 * 0.2
    around = np.vstack([points, points[:1]])
    length = np.linalg.norm(np.diff(around, axis=0), axis=1).sum()
    assert result.meander.figures.length == pytest.approx(length, rel=1e-4)
    assert result.meander.figures.guides == 0
    # It goes on with the guides where they were drawn.
    activate(result)
    assert bpy.ops.meander.run() == {"FINISHED"}
    ((points, cyclic),) = world_splines(result)
    assert cyclic and distance_to_line(points, *LINE).min() > 0.6 * 0.2


def test_all_curves_of_a_collection_are_guides_and_make_regions():
    surface = grid()
    collection = bpy.data.collections.new("Drawing")
    bpy.context.scene.collection.children.link(collection)
    lines = {"Across": [(-1, 0, 0), (1, 0, 0)], "Up": [(0.2, 0, 0), (0.2, 1, 0)]}
    for name, line in lines.items():
        drawn = poly_curve(name, [line], False)
        bpy.context.scene.collection.objects.unlink(drawn)
        collection.objects.link(drawn)
    result = fill(surface, 0.25, guide_collection=collection)
    splines = world_splines(result)
    assert [cyclic for _points, cyclic in splines] == [False, False, True, True, True]
    assert packing(surface, result) == pytest.approx(1.0, abs=0.2)


def test_a_guide_that_crosses_the_seed_is_refused_by_name():
    surface = grid()
    guides = poly_curve("Drawn Guides", [[(0, -0.5, 0), (0, 0.5, 0)]], False)
    seed = poly_curve("Drawn Seed", [[(-0.5, 0, 0), (0.5, 0, 0)]], False)
    sentence = refused(surface, guides=guides, seed=seed)
    assert "'Drawn Seed'" in sentence and "'Drawn Guides'" in sentence and "a guide" in sentence


def test_an_empty_collection_of_guides_is_refused():
    collection = bpy.data.collections.new("Nothing Here")
    assert "has no curves" in refused(grid(), guide_collection=collection)


# -- one line of many ------------------------------------------------------------------------------


def test_parts_are_bridged_to_one_line_and_come_apart_to_go_on(capfd):
    surface = grid(10)
    surface.modifiers.new("Array", "ARRAY").relative_offset_displace = (1.05, 0.0, 0.0)
    guides = poly_curve("Guides", [[(-0.5, 0.2, 0), (0.5, 0.2, 0)]], False)
    result = fill(surface, 0.25, bridge_parts=True, guides=guides, points_as="MESH")
    wall, (points, cyclic) = world_splines(result)
    assert not wall[1] and cyclic
    figures = result.meander.figures
    assert (figures.bridge_count, figures.lines, figures.closed_lines) == (2, 1, 1)
    assert (figures.strands, figures.guides, figures.first_guide) == (2, 1, 0)
    assert "joined all strands by 2 bridges" in capfd.readouterr().out
    # Two bridges over the gap between the sheets, beside each other.
    steps = np.roll(points, -1, axis=0) - points
    over = (points[:, 0] < 1.0 + 1e-6) != (np.roll(points, -1, axis=0)[:, 0] < 1.0 + 1e-6)
    assert over.sum() == 2
    assert np.linalg.norm(steps[over], axis=1).sum() == pytest.approx(
        figures.bridge_length, rel=1e-4
    )
    assert np.linalg.norm(np.diff(points[over], axis=0)) < 2 * 0.25
    # The object of all points has the same line.
    edges = figures.points.data.edges
    degrees = np.bincount([vertex for edge in edges for vertex in edge.vertices])
    assert sorted(set(degrees.tolist())) == [1, 2] and (degrees == 1).sum() == 2
    # It goes on as two strands, and is one line again.
    result.meander.iteration_limit = 5
    activate(result)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert [cyclic for _points, cyclic in world_splines(result)] == [False, True]
    result.meander.bridge_parts = False
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert [cyclic for _points, cyclic in world_splines(result)] == [False, True, True]
    assert result.meander.figures.bridge_count == 0 and not result.meander.figures.bridges
    result.meander.bridge_parts = True
    assert bpy.ops.meander.run() == {"FINISHED"}
    result.meander.motion = "EVEN"
    result.meander.follow = True
    assert "has bridges" in motion.problem_of(result)
    result.meander.follow = False
    # Without the guides as splines the line is the first one.
    result.meander.keep_guides = False
    for _ in range(2):
        assert bpy.ops.meander.run() == {"FINISHED"}
        assert [cyclic for _points, cyclic in world_splines(result)] == [True]
    spline = result.data.splines[0]
    spline.points.add(1)
    spline.points[-1].co = (0.3, 0.3, 0.0, 1.0)
    assert "its bridges cannot be taken out; use Fill Again" in refused(result)


def test_a_line_of_bridges_made_light_still_comes_apart():
    surface = grid(10)
    surface.modifiers.new("Array", "ARRAY").relative_offset_displace = (1.05, 0.0, 0.0)
    result = fill(surface, 0.3, bridge_parts=True)
    before = point_count(result)
    activate(result)
    assert bpy.ops.meander.make_light() == {"FINISHED"}
    assert point_count(result) < before
    result.meander.bridge_parts = False
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert [cyclic for _points, cyclic in world_splines(result)] == [True, True]
    assert packing(surface, result) == pytest.approx(1.0, abs=0.15)
