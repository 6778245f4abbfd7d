# SPDX-License-Identifier: GPL-3.0-or-later
"""What was made of a curve follows it when it is another, and keeps what its user gave it."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from meander.run import remade
from meander.scene.look import modifier_of, set_value, value_of

SPACING = 0.4
MAKERS = ("two_tone", "relief", "ribbon", "maze", "cut_along_curve")


def vertices_of(thing: bpy.types.Object) -> np.ndarray:
    return scenes.column(thing.data.vertices, "co", 3)


def fill_again(result: bpy.types.Object, spacing: float) -> None:
    scenes.activate(result)
    result.meander.spacing = spacing
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}


def fresh(maker: str, result: bpy.types.Object, **values: object) -> np.ndarray:
    """The points of what a maker makes of a result as it is now."""
    scenes.activate(result)
    assert getattr(bpy.ops.meander, maker)(hide=False, **values) == {"FINISHED"}
    thing = bpy.context.active_object
    found = vertices_of(thing)
    bpy.data.objects.remove(thing)
    return found


@pytest.mark.parametrize("maker", MAKERS)
def test_what_was_made_is_made_again_when_the_curve_is_filled_again(maker: str) -> None:
    result = scenes.fill(scenes.sphere(), SPACING)
    assert getattr(bpy.ops.meander, maker)() == {"FINISHED"}
    made, mine = bpy.context.active_object, bpy.data.materials.new("Mine")
    made.location.x, made.name = 3.0, "My Vase"
    made.modifiers.new("Mine", "SOLIDIFY")
    if made.data.materials:
        made.data.materials[0] = mine
    before, counts = vertices_of(made), scenes.counts()
    fill_again(result, 0.8 * SPACING)
    after = vertices_of(made)
    assert len(after) > len(before)
    assert scenes.counts() == counts
    assert made.name == "My Vase" and made.location.x == 3.0 and "Mine" in made.modifiers
    assert not made.data.materials or made.data.materials[0] == mine
    assert np.array_equal(after, fresh(maker, result))
    assert not remade.is_due(result)


def test_both_halves_keep_their_places_and_sides() -> None:
    result = scenes.fill(scenes.sphere(), SPACING)
    assert bpy.ops.meander.two_tone(parts="TWO") == {"FINISHED"}
    both = sorted(bpy.context.selected_objects, key=lambda thing: thing.name)
    sides = [thing.data.attributes["side"].data[0].value for thing in both]
    fill_again(result, 0.8 * SPACING)
    assert [thing.data.attributes["side"].data[0].value for thing in both] == sides
    assert sorted(sides) == [-1, 1]


def test_a_relief_is_told_the_spacing_unless_somebody_has() -> None:
    result = scenes.fill(scenes.sphere(), SPACING)
    assert bpy.ops.meander.relief() == {"FINISHED"}
    relief = bpy.context.active_object
    fill_again(result, 0.8 * SPACING)
    modifier = relief.modifiers["Relief"]
    assert value_of(modifier, "Spacing") == pytest.approx(0.8 * SPACING)
    set_value(modifier, "Spacing", 0.1)
    fill_again(result, SPACING)
    assert value_of(modifier, "Spacing") == pytest.approx(0.1)


def test_what_is_not_to_follow_stays_until_it_is_asked_for() -> None:
    result = scenes.fill(scenes.sphere(), SPACING)
    assert bpy.ops.meander.ribbon(detail=0.0) == {"FINISHED"}
    ribbon = bpy.context.active_object
    ribbon.meander.keep_up = False
    before = vertices_of(ribbon)
    fill_again(result, 0.8 * SPACING)
    assert np.array_equal(vertices_of(ribbon), before)
    scenes.activate(ribbon)
    assert bpy.ops.meander.make_again() == {"FINISHED"}
    assert np.array_equal(vertices_of(ribbon), fresh("ribbon", result, detail=0.0))


def test_what_somebody_has_edited_is_left_alone() -> None:
    result = scenes.fill(scenes.sphere(), SPACING)
    assert bpy.ops.meander.two_tone() == {"FINISHED"}
    made = bpy.context.active_object
    made.data.vertices[0].co.x += 0.5
    before = vertices_of(made)
    fill_again(result, 0.8 * SPACING)
    assert np.array_equal(vertices_of(made), before)
    scenes.activate(made)
    assert bpy.ops.meander.make_again() == {"FINISHED"}
    assert len(vertices_of(made)) > len(before)


def test_a_curve_that_makes_no_maze_leaves_the_walls_as_they_are() -> None:
    surface = scenes.sphere()
    result = scenes.fill(surface, SPACING)
    assert bpy.ops.meander.maze() == {"FINISHED"}
    walls = bpy.context.active_object
    before = vertices_of(walls)
    stroke = scenes.poly_curve("Stroke", [[(1, 0, 0), (0.9, 0.3, 0.0), (0.8, 0.6, 0.0)]], False)
    result.meander.seed = stroke
    fill_again(result, SPACING)  # an open line
    assert not result.data.splines[0].use_cyclic_u
    assert np.array_equal(vertices_of(walls), before)


def test_duplicates_follow_too_and_a_file_keeps_how(tmp_path: Path) -> None:
    result = scenes.fill(scenes.sphere(), SPACING)
    assert bpy.ops.meander.two_tone() == {"FINISHED"}
    made = bpy.context.active_object
    linked, own = made.copy(), made.copy()
    own.data = made.data.copy()
    for thing in (linked, own):
        bpy.context.collection.objects.link(thing)
    names = [thing.name for thing in (made, linked, own, result)]
    scenes.reopened(tmp_path / "made.blend")
    made, linked, own, result = (bpy.data.objects[name] for name in names)
    fill_again(result, 0.8 * SPACING)
    assert linked.data == made.data != own.data
    assert np.array_equal(vertices_of(own), vertices_of(made))
    assert len(vertices_of(made)) == len(fresh("two_tone", result))


def test_live_lets_it_follow() -> None:
    surface = scenes.sphere()
    result = scenes.fill(surface, SPACING, live=True, use_bevel=True)
    assert modifier_of(result) is not None
    assert bpy.ops.meander.two_tone() == {"FINISHED"}
    made = bpy.context.active_object
    scenes.activate(surface)
    surface.meander.spacing = 0.8 * SPACING
    assert bpy.ops.meander.live() == {"FINISHED"}
    assert np.array_equal(vertices_of(made), fresh("two_tone", result))
