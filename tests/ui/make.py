# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result makes of its surface."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np
from meander.ui import cut, panels
from stage import (
    COARSE,
    RESULT,
    SURFACE,
    changed_share,
    ended,
    pixels_of,
    press,
    press_run,
    seen,
    step,
    suzanne_in_view,
    undo,
    until,
    window_override,
)

OPEN = (panels.MEANDER_PT_output, cut.MEANDER_PT_make)


def hidden(name: str) -> bool:
    return bpy.data.objects[name].hide_get()


def sides_of(name: str) -> np.ndarray:
    polygons = bpy.data.objects[name].data.polygons
    sides = np.empty(len(polygons), dtype=np.int32)
    polygons.foreach_get("material_index", sides)
    return sides


def glowing_share(name: str) -> float:
    """Of what a picture shows before the gray of the view, how much is rather red than blue."""
    pixels = pixels_of(name)
    red, _green, blue = np.moveaxis(pixels, 2, 0)
    thing = (np.abs(pixels - pixels[5, 5]) > 0.05).any(axis=2)
    return float((red > 1.5 * blue)[thing].mean())


def story() -> Iterator[float]:
    yield from suzanne_in_view(COARSE)
    step("Suzanne is filled")
    press_run()
    yield from until(ended, "the run ends")
    yield from seen("make_panel")
    with bpy.context.temp_override(**window_override()):
        assert bpy.ops.meander.two_tone.poll()

    step("Two-Tone stands in the place of the curve and its surface")
    press("two_tone")
    yield from seen("make_two_tone")
    made = f"{RESULT} Two-Tone"
    assert bpy.context.view_layer.objects.active == bpy.data.objects[made]
    assert hidden(RESULT) and hidden(SURFACE)
    sides = sides_of(made)
    assert 0.3 < sides.mean() < 0.7
    assert changed_share("make_panel", "make_two_tone") > 0.05
    box = next(r for r in window_override()["area"].regions if r.type == "HUD")
    assert box.width > 100, "Adjust Last Operation is not shown"

    step("its panel leads back to the curve")
    assert not bpy.ops.meander.run.poll()
    press("select_curve")
    yield from seen("make_select_curve")
    assert bpy.context.view_layer.objects.active == bpy.data.objects[RESULT]
    assert not hidden(RESULT) and hidden(SURFACE)
    assert changed_share("make_two_tone", "make_select_curve") > 0.05
    yield from undo()
    assert bpy.context.view_layer.objects.active == bpy.data.objects[made] and hidden(RESULT)

    step("undo takes it back, and redo brings it again")
    yield from undo()
    assert made not in bpy.data.objects
    assert not hidden(RESULT) and not hidden(SURFACE)
    assert bpy.context.view_layer.objects.active == bpy.data.objects[RESULT]
    yield from undo(redo=True)
    assert np.array_equal(sides_of(made), sides)
    assert hidden(RESULT) and hidden(SURFACE)

    step("Relief after undo")
    yield from undo()
    press("relief")
    yield from seen("make_relief")
    relief = bpy.context.view_layer.objects.active
    assert relief.modifiers[0].node_group.name.startswith("Meander Relief")
    assert changed_share("make_two_tone", "make_relief") > 0.05

    step("Ribbon shows its lights in Solid view, and nothing that is seen is under what is hidden")
    yield from undo()
    press("ribbon")
    yield from seen("make_ribbon")
    ribbon = bpy.context.view_layer.objects.active
    assert ribbon.select_get() and ribbon.visible_get() and ribbon.parent is None
    # One material is one colour all over: it glows everywhere, or nowhere.
    glowing = glowing_share("make_ribbon")
    assert 0.1 < glowing < 0.9, glowing
    shading = window_override()["area"].spaces.active.shading
    assert shading.color_type == "VERTEX"
    yield from undo()
    assert shading.color_type == "MATERIAL", "the view is left as it was for the ribbon"
    yield from undo(redo=True)
    assert shading.color_type == "VERTEX"

    step("Animate Growth shows how the line grew, by the frame")
    yield from undo()
    assert not hidden(RESULT)
    with bpy.context.temp_override(**window_override()):
        assert bpy.ops.meander.animate_growth("EXEC_DEFAULT", True, frames=40) == {"FINISHED"}
    for frame in (10, 40):
        bpy.context.scene.frame_set(frame)
        yield from seen(f"make_growth_{frame}")
    assert changed_share("make_growth_10", "make_growth_40") > 0.02
    # The last frame is the line itself.
    assert changed_share("make_panel", "make_growth_40") < 0.01
    yield from undo()
    assert bpy.data.objects[RESULT].meander.bake is None

    step("Maze has walls and two doors, and the box at the lower left opens others")
    press("maze", solution=True)
    yield from seen("make_maze")
    walls = bpy.context.view_layer.objects.active
    assert walls.name == f"{RESULT} Maze" and hidden(RESULT) and not hidden(SURFACE)
    assert f"{walls.name} Solution" in bpy.data.objects
    assert changed_share("make_panel", "make_maze") > 0.05
    box = next(r for r in window_override()["area"].regions if r.type == "HUD")
    assert box.width > 100, "Adjust Last Operation is not shown"
    operator = bpy.context.window_manager.operators[-1]
    faces = len(walls.data.polygons)
    operator.doors = "NONE"
    with bpy.context.temp_override(**window_override()):
        bpy.ops.ed.undo_redo()
    yield from seen("make_maze_closed")
    walls = bpy.context.view_layer.objects.active
    assert walls.name == f"{RESULT} Maze" and len(walls.data.polygons) != faces
    assert f"{walls.name} Solution" not in bpy.data.objects
