# SPDX-License-Identifier: GPL-3.0-or-later
"""What a third hour with the panel came upon: strokes of direction, plugs of scripts, units."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from meander.model import strands
from meander.scene import look
from meander.ui import alignment, camera, drawing, preferences
from panel_layout import drawn, texts_of
from scenes import activate, fill, grid, sphere, world_splines


def drawn_line(curve: bpy.types.Object, points: list[tuple]) -> None:
    bpy.ops.object.mode_set(mode="OBJECT")
    spline = curve.data.splines.new("POLY")
    spline.points.add(len(points) - 1)
    for point, place in zip(spline.points, points, strict=True):
        point.co = (*place, 1.0)


def test_strokes_of_direction_are_drawn():
    surface = grid()
    surface.meander.alignment_source = "STROKES"
    assert drawn(alignment.MEANDER_PT_alignment, bpy.context) is not None
    assert bpy.ops.meander.draw_seed(setting="alignment_strokes") == {"FINISHED"}
    curve = bpy.context.active_object
    assert surface.meander.alignment_strokes == curve and surface.meander.seed is None
    assert "Strands run along strokes" in texts_of(drawing.MEANDER_PT_drawing)
    drawn_line(curve, [(-0.9, 0.0, 0.0), (0.0, 0.0, 0.0), (0.9, 0.0, 0.0)])
    drawing.watch()
    assert bpy.context.view_layer.objects.active == surface
    result = fill(surface, 0.2, start="FULL")
    along = across = 0.0
    for points, _cyclic in world_splines(result):
        steps = np.abs(np.diff(points, axis=0))
        along, across = along + steps[:, 0].sum(), across + steps[:, 1].sum()
    assert along > 3.0 * across


def test_without_a_stroke_the_direction_is_what_it_was():
    surface = grid()
    bpy.ops.meander.draw_seed(setting="alignment_strokes")
    bpy.ops.object.mode_set(mode="OBJECT")
    drawing.watch()
    assert surface.meander.alignment_strokes is None
    assert len(bpy.data.curves) == 0


def test_plugs_that_a_script_chooses_have_their_material():
    surface = sphere()
    result = fill(surface, 0.4, use_bevel=True)
    look.set_value(look.modifier_of(result), "Ends", 3)
    result.update_tag()
    bpy.context.view_layer.update()
    material = look.value_of(look.modifier_of(result), "Ends Material")
    assert material is not None and material.name == look.ENDS


def test_lengths_on_paper_have_their_unit():
    rna = bpy.ops.meander.draw_camera.get_rna_type().properties
    for name in ("spacing", "width", "height", "margin", "line_width"):
        assert rna[name].name.endswith("(mm)"), name
    assert camera.PageSettings.__annotations__


def test_the_entry_of_the_add_on_has_a_way_to_its_pages():
    found: list[str] = []

    class Layout:
        def __getattr__(self, _name):
            return lambda *_given, **_options: Layout()

        def operator(self, name, **_options):
            found.append(name)

    entry = type("Entry", (), {"layout": Layout()})()
    preferences.MeanderPreferences.draw(entry, bpy.context)
    assert found == ["meander.open_help"]


@pytest.mark.parametrize(
    "numbers, where", [([1, 4, 4], "near point 4"), (None, "between points 2")]
)
def test_a_jump_is_between_two_points_or_near_one(numbers, where):
    from meander import core

    seed = core.Seed(
        points=np.zeros((3, 3)),
        offsets=np.array([0, 3], dtype=np.uint32),
        closed=np.array([0], dtype=np.uint8),
    )
    part = strands.Part("Trail", seed, numbers=None if numbers is None else np.array(numbers))
    figures = {"seed_jumps": 1, "seed_jump_point": 1, "seed_jump_point2": 2}
    assert f"surface {where}" in strands.fit_warning(figures, [part])
    figures["seed_jumps"] = 3
    assert f"farthest {where}" in strands.fit_warning(figures, [part])


def test_a_curve_of_directions_offers_the_fill_of_its_mesh():
    from meander.ui.fill import seeded_mesh

    surface = grid()
    bpy.ops.meander.draw_seed(setting="alignment_strokes")
    curve = bpy.context.active_object
    drawn_line(curve, [(-0.9, 0.0, 0.0), (0.9, 0.0, 0.0)])
    drawing.watch()
    activate(curve)
    assert seeded_mesh(bpy.context) == surface
