# SPDX-License-Identifier: GPL-3.0-or-later
"""Seeds made of a mesh's own edges, and seeds that are drawn some way off the surface."""

from __future__ import annotations

import re

import bpy
import numpy as np
import pytest
from meander.run import seeds
from meander.ui import drawing as seed_drawing
from scenes import (
    activate,
    circle_points,
    counts,
    fill,
    grid,
    in_edit_mode,
    packing,
    poly_curve,
    refused,
    sphere,
    world_splines,
)


def select_edges(surface: bpy.types.Object, chosen) -> None:
    """Selects the edges for whose two ends `chosen` is true, as Edit Mode has it."""
    mesh = surface.data
    for items in (mesh.vertices, mesh.polygons, mesh.edges):
        items.foreach_set("select", np.zeros(len(items), dtype=bool))
    for edge in mesh.edges:
        if all(chosen(mesh.vertices[i].co) for i in edge.vertices):
            edge.select = True
            for i in edge.vertices:
                mesh.vertices[i].select = True
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_mode(type="EDGE")


def test_selected_edges_become_strands_along_them():
    surface = grid(8)
    surface.modifiers.new("Lift", "DISPLACE").strength = 0.5

    # A row of edges from side to side, and a loop.
    def chosen(place):
        on_row = abs(place.y + 0.5) < 1e-6
        ring = max(abs(place.x), abs(place.y - 0.5))
        return on_row or abs(ring - 0.25) < 1e-6

    select_edges(surface, chosen)
    assert bpy.ops.meander.seed_from_edges() == {"FINISHED"}
    # Back where undo knows of new objects, and the surface is ready to be filled.
    assert surface.mode == "OBJECT" and bpy.context.view_layer.objects.active == surface
    seed = surface.meander.seed
    assert seed.parent == surface and seed.name == f"{surface.name} Seed"
    (row, open_one), (loop, closed_one) = world_splines(seed)
    assert (open_one, closed_one) == (False, True)
    assert len(row) == 9 and len(loop) == 8
    # Where the modifier shows them.
    lift = bpy.context.evaluated_depsgraph_get()
    shown = surface.evaluated_get(lift).data.vertices
    assert np.allclose(row[:, 2], shown[0].co.z, atol=1e-6) and shown[0].co.z != 0
    assert np.abs(row[:, 1] + 0.5).max() < 1e-6
    result = fill(surface, 0.2)
    assert [spline.use_cyclic_u for spline in result.data.splines] == [False, True]
    assert packing(surface, result) == pytest.approx(1.0, abs=0.15)


def test_edges_that_branch_are_refused_as_a_seed_and_taken_as_guides():
    surface = grid(4)
    select_edges(surface, lambda place: abs(place.x) < 1e-6 or abs(place.y) < 1e-6)
    before = counts()
    with pytest.raises(RuntimeError, match="branch at one vertex"):
        bpy.ops.meander.seed_from_edges()
    assert surface.mode == "EDIT" and counts() == before
    assert bpy.ops.meander.seed_from_edges(guides=True) == {"FINISHED"}
    assert surface.meander.seed is None
    assert len(surface.meander.guides.data.splines) == 4
    result = fill(surface, 0.3)
    assert result.meander.figures.guides == 4
    # The cross parts the sheet into four.
    assert sum(spline.use_cyclic_u for spline in result.data.splines) == 4


def test_no_edges_are_refused():
    surface = grid(4)
    select_edges(surface, lambda place: False)
    with pytest.raises(RuntimeError, match="No edges are selected"):
        bpy.ops.meander.seed_from_edges()
    bpy.ops.object.mode_set(mode="OBJECT")


def ring_with_hole() -> bpy.types.Object:
    surface = grid(6)
    in_edit_mode(surface, lambda middle: max(abs(middle.x), abs(middle.y)) < 0.4)
    bpy.ops.mesh.delete(type="FACE")
    bpy.ops.object.mode_set(mode="OBJECT")
    return surface


def test_boundaries_become_closed_strands_all_or_the_selected():
    surface = ring_with_hole()
    assert bpy.ops.meander.seed_from_boundary() == {"FINISHED"}
    extents = [np.abs(points).max() for points, cyclic in world_splines(surface.meander.seed)]
    assert sorted(extents) == pytest.approx([1 / 3, 1.0], abs=1e-6)
    assert all(spline.use_cyclic_u for spline in surface.meander.seed.data.splines)
    result = fill(surface, 0.2)
    assert [spline.use_cyclic_u for spline in result.data.splines] == [True, True]
    assert packing(surface, result) == pytest.approx(1.0, abs=0.15)
    # Of the mesh with its modifiers: a mirror image has a boundary of its own.
    activate(surface)
    surface.modifiers.new("Array", "ARRAY").relative_offset_displace = (1.5, 0.0, 0.0)
    assert bpy.ops.meander.seed_from_boundary() == {"FINISHED"}
    assert len(surface.meander.seed.data.splines) == 4
    # With one edge of the hole selected, only that loop.
    select_edges(surface, lambda place: abs(place.x - 1 / 3) < 1e-5 and -0.4 < place.y < 0.05)
    assert bpy.ops.meander.seed_from_boundary() == {"FINISHED"}
    ((points, cyclic),) = world_splines(surface.meander.seed)
    assert cyclic and np.abs(points).max() == pytest.approx(1 / 3, abs=1e-5)


def test_a_closed_mesh_has_no_boundary():
    sphere()
    with pytest.raises(RuntimeError, match="has no boundary"):
        bpy.ops.meander.seed_from_boundary()


# -- off the surface -------------------------------------------------------------------------------


def test_a_seed_off_the_surface_is_laid_on_it_and_the_summary_says_so(capfd):
    surface = sphere(subdivisions=4)
    seed = poly_curve("Halo", [circle_points(1.3, 0.2, 32)], True)
    bpy.context.scene.unit_settings.system = "METRIC"
    bpy.context.scene.unit_settings.length_unit = "CENTIMETERS"
    bpy.context.scene.unit_settings.scale_length = 0.01
    result = fill(surface, 0.3, seed=seed)
    assert packing(surface, result) == pytest.approx(1.0, abs=0.15)
    assert "moved the seed to the surface, from up to 0.319 cm away" in capfd.readouterr().out
    sentence = refused(surface, seed=poly_curve("Far", [circle_points(3.0, 0.0)], True))
    assert "of spline 1 of 'Far' is 2" in sentence and "cm away from the surface" in sentence
    # What has grown has to lie where it is: it may be of another frame.
    activate(result)
    surface.scale = (1.4, 1.4, 1.4)
    result.matrix_parent_inverse = np.diag([1 / 1.4, 1 / 1.4, 1 / 1.4, 1.0]).tolist()
    bpy.context.view_layer.update()
    assert "away from the surface" in refused(result)
    # Neither where guides are drawn some way off.
    result.meander.guides = poly_curve("Bar", [[(-0.5, 0.0, 1.7), (0.5, 0.0, 1.7)]], False)
    result.meander.figures.guides, result.meander.figures.first_guide = 0, 0
    assert "does not lie on its surface" in refused(result)


def test_a_result_goes_on_with_guides_drawn_off_the_surface():
    surface = sphere()
    bar = poly_curve("Bar", [[(-0.3, 0.0, 1.3), (0.3, 0.0, 1.3)]], False)
    result = fill(surface, 0.4, guides=bar, iteration_limit=20)
    assert result.meander.figures.guides == 1
    activate(result)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert result.meander.figures.guides == 1
    assert [spline.use_cyclic_u for spline in result.data.splines] == [False, True]


# -- drawing and looking ---------------------------------------------------------------------------


def test_a_seed_is_drawn_in_edit_mode_and_nothing_drawn_changes_nothing():
    surface = grid(4)
    earlier = surface.meander.seed = poly_curve("Earlier", [[(-0.5, 0, 0), (0.5, 0, 0)]], False)
    paint = bpy.context.scene.tool_settings.curve_paint_settings
    paint.depth_mode, paint.surface_offset = "CURSOR", 0.25
    before = counts()
    assert bpy.ops.meander.draw_seed() == {"FINISHED"}
    assert bpy.context.mode == "EDIT_CURVE" and paint.depth_mode == "SURFACE"
    assert bpy.ops.meander.end_seed() == {"FINISHED"}
    assert surface.meander.seed == earlier and counts() == before
    assert (paint.depth_mode, paint.surface_offset) == ("CURSOR", 0.25)
    assert bpy.context.view_layer.objects.active == surface and bpy.context.mode == "OBJECT"
    assert not bpy.ops.meander.end_seed.poll()
    bpy.ops.meander.draw_seed()
    assert bpy.ops.curve.primitive_bezier_curve_add(radius=0.4) == {"FINISHED"}
    assert bpy.ops.meander.end_seed() == {"FINISHED"}
    drawn = surface.meander.seed
    assert drawn.show_in_front  # what bends less than the surface runs below it
    assert drawn != earlier and drawn.parent == surface and len(drawn.data.splines) == 1
    result = fill(surface, 0.3)
    ((_points, cyclic),) = world_splines(result)
    assert not cyclic


def test_strokes_are_shown_and_what_a_run_would_refuse_is_said():
    """What a timer asks for in a window."""
    surface = grid(8)
    assert bpy.ops.meander.draw_seed() == {"FINISHED"}
    drawing, curve = seed_drawing.drawn.current, surface.meander.seed
    for turn, shown in ((0.0, True), (1.0, False)):
        bpy.ops.curve.primitive_bezier_curve_add(radius=0.4, rotation=(0.0, 0.0, turn))
        seed_drawing._show_strokes(drawing, curve)
        assert seeds.is_shown(surface)
        assert bool(drawing.problem) != shown
    assert "crosses or touches itself" in drawing.problem
    bpy.ops.meander.end_seed()


def test_the_preview_shows_what_a_run_starts_from_until_that_changes(capfd):
    surface = grid(8)
    assert bpy.ops.meander.preview_seed() == {"FINISHED"}
    assert "Starts from one strand" in capfd.readouterr().out
    assert seeds.is_shown(surface)
    surface.meander.guides = poly_curve("Wall", [[(0, -1, 0), (0, 1, 0)]], False)
    assert not seeds.is_shown(surface)
    assert bpy.ops.meander.preview_seed() == {"FINISHED"}
    assert "Starts from 2 strands and one guide" in capfd.readouterr().out
    assert bpy.ops.meander.preview_seed() == {"FINISHED"}  # no longer
    assert not seeds.is_shown(surface)
    # A seed that is refused is shown as drawn, with the places marked.
    bow = [(-0.8, -0.5, 0.1), (-0.2, 0.5, 0.1), (-0.8, 0.5, 0.2), (-0.2, -0.5, 0.2)]
    surface.meander.seed = poly_curve("Bow", [bow], False)
    with pytest.raises(RuntimeError, match="just after points 1 and 3 of spline 1 of 'Bow'"):
        bpy.ops.meander.preview_seed()
    assert seeds.is_shown(surface)
    surface.meander.seed = None
    fill(surface, 0.3)
    assert not seeds.is_shown(surface)


def test_points_of_a_bezier_curve_are_told_by_its_control_points():
    surface = grid(8)
    bow = [(-0.8, -0.5, 0), (-0.2, 0.5, 0), (-0.8, 0.5, 0), (-0.2, -0.5, 0)]
    line = [(0.2, 0.5, 0), (0.2, -0.5, 0)]
    seed = poly_curve("Bow", [line, bow], False, "BEZIER")
    for spline in seed.data.splines:
        for point in spline.bezier_points:
            point.handle_left_type = point.handle_right_type = "VECTOR"
    sentence = refused(surface, seed=seed)
    assert re.search(r"after points [12] and [34] of spline 2 of 'Bow'", sentence), sentence


def text_on_grid(words: str) -> bpy.types.Object:
    data = bpy.data.curves.new("Words", "FONT")
    data.body, data.size, data.extrude = words, 0.8, 0.1
    data.align_x = data.align_y = "CENTER"
    thing = bpy.data.objects.new("Words", data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def test_a_text_is_a_seed_and_a_guide_by_its_outlines():
    surface = grid(8)
    words = text_on_grid("OI")
    words.location.z = 0.05
    result = fill(surface, 0.12, seed=words)
    # The ring has an outline inside and one outside, the bar has one.
    assert [cyclic for _points, cyclic in world_splines(result)] == [True] * 3
    assert packing(surface, result) == pytest.approx(1.0, abs=0.15)
    assert result.name == "Words Meander"
    activate(surface)
    surface.meander.seed = None
    guided = fill(surface, 0.12, guides=words)
    assert guided.meander.figures.guides == 3
    words.data.body = "O"
    bpy.context.view_layer.update()
    assert fill(surface, 0.12).meander.figures.guides == 2
