# SPDX-License-Identifier: GPL-3.0-or-later
"""What was made from a curve says so, leads back to the curve, and is no surface by itself."""

from __future__ import annotations

from pathlib import Path

import bpy
import pytest
import scenes
from meander.scene.results import last_result
from panel_layout import drawn, panels
from test_finding import too_wide

SPACING = 0.4
MAKERS = ("two_tone", "relief", "ribbon", "maze", "cut_along_curve")


def texts() -> str:
    """All that stands in the sidebar, with a space between."""
    layouts = (drawn(panel, bpy.context) for panel in panels())
    return " ".join(text.text for each in layouts if each is not None for text in each.texts())


@pytest.mark.parametrize("maker", MAKERS)
def test_the_panel_leads_from_what_was_made_to_its_curve(maker: str) -> None:
    surface = scenes.sphere()
    result = scenes.fill(surface, SPACING, use_bevel=True)
    assert getattr(bpy.ops.meander, maker)() == {"FINISHED"}
    made = bpy.context.active_object
    assert made != result and result.hide_get()
    found = texts()
    assert f"Made from {result.name}" in found and "Select Curve" in found
    assert "Fill with Curve" not in found and "Spacing" not in found
    assert too_wide() == []
    assert not bpy.ops.meander.run.poll()
    assert bpy.ops.meander.select_curve() == {"FINISHED"}
    assert bpy.context.active_object == result and result.select_get()
    assert result.visible_get() and not result.hide_render
    assert made.visible_get() and not made.select_get()
    assert "Fill Again" in texts()
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}


def test_both_objects_of_a_maze_are_no_surfaces() -> None:
    result = scenes.fill(scenes.grid(cells=16), 0.2)
    assert bpy.ops.meander.maze(solution=True) == {"FINISHED"}
    both = bpy.context.selected_objects[:]
    assert len(both) == 2
    for thing in both:
        bpy.context.view_layer.objects.active = thing
        assert "2 objects" not in texts() and f"Made from {result.name}" in texts()
        assert not bpy.ops.meander.run.poll()
    # Nor do they count where another is filled.
    other = scenes.cube()
    for thing in both:
        thing.select_set(True)
    assert "3 objects" not in texts() and bpy.context.active_object == other


def test_points_say_where_they_are_from() -> None:
    result = scenes.fill(scenes.sphere(), SPACING, points_as="MESH")
    assert bpy.ops.meander.points_to_mesh() == {"FINISHED"}
    of_run, by_hand = result.meander.figures.points, bpy.data.objects[f"{result.name} Points.001"]
    for thing in (of_run, by_hand):
        scenes.activate(thing)
        assert f"Made from {result.name}" in texts()
    # They are replaced by the next run, and not kept by what they name.
    scenes.activate(result)
    bpy.data.objects.remove(by_hand)
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
    assert f"{result.name} Points.001" not in bpy.data.objects


def test_who_wants_to_fills_what_was_made() -> None:
    scenes.fill(scenes.sphere(), SPACING)
    assert bpy.ops.meander.relief() == {"FINISHED"}
    relief = bpy.context.active_object
    assert "Use as Surface" in texts()
    assert bpy.ops.meander.use_as_surface() == {"FINISHED"}
    assert bpy.context.active_object == relief
    assert "Fill with Curve" in texts() and "Made from" not in texts()
    assert bpy.ops.meander.run.poll()


def test_a_hidden_curve_is_told_on_its_mesh() -> None:
    surface = scenes.sphere()
    result = scenes.fill(surface, SPACING)
    assert bpy.ops.meander.maze() == {"FINISHED"}
    scenes.activate(surface)
    assert "Curve is hidden" in texts() and "Select Curve" in texts()
    assert too_wide() == []
    assert bpy.ops.meander.select_curve() == {"FINISHED"}
    assert bpy.context.active_object == result and result.visible_get()
    assert "Curve is hidden" not in texts() and "Select Curve" not in texts()
    # Whatever hides it.
    for hide in ("hide_set", "hide_viewport"):
        scenes.activate(surface)
        result.hide_set(True) if hide == "hide_set" else setattr(result, hide, True)
        assert "Curve is hidden" in texts()
        assert bpy.ops.meander.select_curve() == {"FINISHED"} and result.visible_get()


def test_a_curve_that_no_button_can_show_is_said() -> None:
    surface = scenes.sphere()
    result = scenes.fill(surface, SPACING)
    assert bpy.ops.meander.two_tone() == {"FINISHED"}
    made = bpy.context.active_object
    elsewhere = bpy.data.collections.new("Elsewhere")
    bpy.context.scene.collection.children.link(elsewhere)
    for each in result.users_collection:
        each.objects.unlink(result)
    elsewhere.objects.link(result)
    bpy.context.view_layer.layer_collection.children["Elsewhere"].hide_viewport = True
    with pytest.raises(RuntimeError, match="does not show; show 'Elsewhere'"):
        bpy.ops.meander.select_curve()
    assert bpy.context.active_object == made
    bpy.context.view_layer.layer_collection.children["Elsewhere"].exclude = True
    with pytest.raises(RuntimeError, match="does not show; show 'Elsewhere'"):
        bpy.ops.meander.select_curve()


def test_what_was_made_from_a_deleted_curve_is_a_mesh_like_any_other(tmp_path: Path) -> None:
    surface = scenes.sphere()
    result = scenes.fill(surface, SPACING)
    assert bpy.ops.meander.two_tone(hide=False) == {"FINISHED"}
    made, name = bpy.context.active_object, result.name
    scenes.activate(result)
    assert bpy.ops.object.delete() == {"FINISHED"}
    scenes.activate(made)
    assert "Made from" not in texts() and "Fill with Curve" in texts()
    # Nor does it keep the curve's name from the next one, or the curve in the file.
    scenes.activate(surface)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert last_result(surface, bpy.context.scene).name == name
    scenes.activate(made)
    assert "Made from" not in texts()
    made.meander.made_from = bpy.data.objects[name]
    scenes.activate(made.meander.made_from)
    assert bpy.ops.object.delete() == {"FINISHED"}
    surface.meander.last_result = None  # which keeps it for undo
    scenes.reopened(tmp_path / "made.blend")
    assert name not in bpy.data.objects
