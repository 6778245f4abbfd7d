# SPDX-License-Identifier: GPL-3.0-or-later
"""Fill, change the look, fill again."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
from meander.scene import look as looks
from meander.ui import look, panels
from stage import (
    COARSE,
    RESULT,
    SURFACE,
    activate,
    changed_share,
    choose_spacing,
    ended,
    key,
    press_run,
    seen,
    splines_of,
    step,
    suzanne_in_view,
    until,
)

WIDE = 2.5 * COARSE
OPEN = (look.MEANDER_PT_look, look.MEANDER_PT_look_color)
CLOSED = (panels.MEANDER_PT_figures,)


def values() -> list[float]:
    modifier = looks.modifier_of(bpy.data.objects[RESULT])
    return [looks.value_of(modifier, name) for name in ("Radius", "Profile", "Spacing")]


def first_fill() -> Iterator[float]:
    yield from suzanne_in_view(WIDE)
    press_run()
    yield from until(ended, "the end of the run")
    yield from seen("7_look_of_a_result")


def looks_act_at_once() -> Iterator[float]:
    step("the look of a result acts at once, has undo, and is shown for the mesh as well")
    result = bpy.data.objects[RESULT]
    result.select_set(False)
    yield from seen("7_look_before")
    looks.set_value(looks.modifier_of(result), "Radius", 0.45)
    result.meander.shown_profile = "RIBBON"
    bpy.ops.ed.undo_push(message="Radius")
    yield from seen("7_look_after")
    assert changed_share("7_look_before", "7_look_after") > 0.05
    chosen = values()
    key("Z", ctrl=True)
    yield from until(lambda: values()[:2] == [values()[0], 0] and values() != chosen, "undo")
    key("Z", ctrl=True, shift=True)
    yield from until(lambda: values() == chosen, "redo")


def material_of_the_slot() -> Iterator[float]:
    step("a material in the first slot is that of the look, after undo and redo too")
    made = bpy.data.materials.new("Mine")
    first = looks.material_of(bpy.data.objects[RESULT]).name
    bpy.ops.ed.undo_push(message="New Material")
    bpy.data.objects[RESULT].material_slots[0].material = made
    bpy.ops.ed.undo_push(message="Material")

    def seen(name: str) -> bool:
        return looks.material_of(bpy.data.objects[RESULT]).name == name

    yield from until(lambda: seen("Mine"), "the material of the slot")
    key("Z", ctrl=True)
    yield from until(lambda: seen(first), "the former material")
    key("Z", ctrl=True, shift=True)
    yield from until(lambda: seen("Mine"), "the material again")


def filling_again() -> Iterator[float]:
    step("filling again keeps the look, and one Ctrl-Z brings the former line back")
    activate(SURFACE)
    former, chosen = splines_of(RESULT), values()
    choose_spacing(COARSE)
    yield from seen("7_look_of_a_mesh")
    press_run()
    yield from until(ended, "the end of the run")
    latter = splines_of(RESULT)
    assert latter != former and f"{RESULT}.001" not in bpy.data.objects
    assert bpy.context.view_layer.objects.active.name == SURFACE
    assert values()[:2] == chosen[:2] and abs(values()[2] * WIDE / COARSE / chosen[2] - 1) < 1e-5
    assert looks.material_of(bpy.data.objects[RESULT]).name == "Mine"
    key("Z", ctrl=True)
    yield from until(lambda: splines_of(RESULT) == former, "the former line")
    assert values() == chosen
    key("Z", ctrl=True, shift=True)
    yield from until(lambda: splines_of(RESULT) == latter, "the new line")


def story() -> Iterator[float]:
    yield from first_fill()
    yield from looks_act_at_once()
    yield from material_of_the_slot()
    yield from filling_again()
