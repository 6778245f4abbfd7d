# SPDX-License-Identifier: GPL-3.0-or-later
"""The line with round turns that the look of a result draws in place of its curve."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
from meander.run import rounding
from meander.scene import drawn_line, look
from scenes import column, fill, reopened, sphere, world_splines

SPACING = 0.35
RADIUS = 0.2 * SPACING


def rings(result: bpy.types.Object) -> np.ndarray:
    """The middles of the rings of a result's body."""
    bpy.context.view_layer.update()
    mesh = result.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    places = column(mesh.vertices, "co", 3)
    return places.reshape(-1, 8, 3).mean(axis=1)


def farthest(points: np.ndarray, line: np.ndarray) -> float:
    """From the nearest piece of a closed line, at most."""
    way = np.roll(line, -1, axis=0) - line
    squares = (way**2).sum(axis=1)
    worst = 0.0
    for point in points:
        share = np.clip(((point - line) * way).sum(axis=1) / squares, 0.0, 1.0)
        worst = max(worst, np.linalg.norm(line + share[:, None] * way - point, axis=1).min())
    return worst


@pytest.fixture
def result() -> bpy.types.Object:
    return fill(sphere(subdivisions=3), SPACING, iteration_limit=45, use_bevel=True)


def line_of(thing: bpy.types.Object) -> np.ndarray:
    ((points, _closed),) = world_splines(thing)
    return points


def test_a_new_curve_is_drawn_round_and_stays_as_it_is(result: bpy.types.Object) -> None:
    modifier = look.modifier_of(result)
    assert look.value_of(modifier, "Round") == pytest.approx(look.ROUND)
    curve, drawn = line_of(result), line_of(drawn_line.drawn_of(result))
    found = rings(result)
    assert farthest(found, drawn) < 0.01 * SPACING
    assert 0.02 * SPACING < farthest(found, curve) < (look.ROUND + 0.01) * SPACING
    assert not drawn_line.drawn_of(result).users_scene
    assert not drawn_line.is_due(result)


def test_another_round_draws_another_line(result: bpy.types.Object) -> None:
    modifier, curve = look.modifier_of(result), line_of(result)
    for value in (0.0, 0.25):
        look.set_value(modifier, "Round", value)
        assert drawn_line.is_due(result)
        rounding.on_output()  # as before a picture is rendered
        assert not drawn_line.is_due(result)
        assert farthest(rings(result), curve) < (value + 0.04) * SPACING
    assert farthest(rings(result), curve) > look.ROUND * SPACING
    assert np.array_equal(line_of(result), curve)
    names = [thing.name for thing in bpy.data.objects if thing.name.endswith("Round")]
    assert len(names) == 1  # the line before it has gone


def test_a_curve_that_was_edited_is_drawn_as_it_is(result: bpy.types.Object) -> None:
    for point in result.data.splines[0].points[:40]:
        point.co.xyz *= 1.05
    result.data.update_tag()
    bpy.context.view_layer.update()
    # At creases a body goes round them.
    assert farthest(rings(result), line_of(result)) < 0.04 * SPACING
    assert not drawn_line.is_due(result)


def test_a_deformed_curve_is_drawn_as_it_is(result: bpy.types.Object) -> None:
    lattice = bpy.data.objects.new("Lattice", bpy.data.lattices.new("Lattice"))
    bpy.context.collection.objects.link(lattice)
    lattice.scale = (3.0, 3.0, 3.0)
    for point in lattice.data.points:
        point.co_deform.z *= 1.5
    modifier = result.modifiers.new("Lattice", "LATTICE")
    modifier.object, modifier.use_apply_on_spline = lattice, True
    with bpy.context.temp_override(object=result):
        bpy.ops.object.modifier_move_to_index(modifier="Lattice", index=0)
    assert np.abs(rings(result)[:, 2]).max() > 1.2


def test_a_file_keeps_the_drawn_line(result: bpy.types.Object, tmp_path: Path) -> None:
    before, name = rings(result), result.name
    reopened(tmp_path / "a.blend")
    assert np.allclose(rings(bpy.data.objects[name]), before, atol=1e-6)


def test_filling_again_draws_again_as_the_look_says(result: bpy.types.Object) -> None:
    look.set_value(look.modifier_of(result), "Round", 0.2)
    again = fill(result.meander.surface, SPACING, iteration_limit=30)
    assert again == result
    assert farthest(rings(result), line_of(drawn_line.drawn_of(result))) < 0.01 * SPACING
    assert not drawn_line.is_due(result)
