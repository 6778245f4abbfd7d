# SPDX-License-Identifier: GPL-3.0-or-later
"""The popup of six variations: opened, looked at, and one of them chosen with the mouse."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
from meander.ui import variations
from stage import (
    COARSE,
    RESULT,
    changed_share,
    click,
    ended,
    pixels_of,
    redrawn,
    seen,
    step,
    suzanne_in_view,
    until,
    window_override,
)

# Of the button of the variation that is chosen, in Blender's dark theme.
CHOSEN = (0.28, 0.45, 0.70)
MIDDLE = (430, 300)


def open_popup() -> None:
    """As the button at the end of the row does, with the mouse in the view."""
    bpy.context.window_manager.windows[0].cursor_warp(*MIDDLE)
    with bpy.context.temp_override(**window_override()):
        assert bpy.ops.meander.show_variations("INVOKE_DEFAULT") == {"FINISHED"}


def chosen_button(name: str) -> tuple[int, int, int]:
    """The middle of the popup's button that is pressed, and how wide it is."""
    pixels = pixels_of(name)
    rows, columns = (abs(pixels[:, :, :3] - CHOSEN).max(axis=2) < 0.06).nonzero()
    inside = (rows > 100) & (rows < 400)  # not the axes of the view
    assert inside.sum() > 200, f"{inside.sum()} pixels of a pressed button"
    rows, columns = rows[inside], columns[inside]
    width = int(columns.max() - columns.min())
    area = window_override()["area"]
    view = next(region for region in area.regions if region.type == "WINDOW")
    x, y = int(columns.min()) + width // 2, int(rows.min() + rows.max()) // 2
    return view.x + x, view.y + y, width


def story() -> Iterator[float]:
    yield from suzanne_in_view(COARSE)
    yield from seen("variations_before")
    step("six variations are shown before anything is filled")
    open_popup()
    yield from seen("variations_popup")
    assert len(variations.shown.pictures) == 6
    assert changed_share("variations_before", "variations_popup") > 0.2
    x, y, width = chosen_button("variations_popup")

    step("a click on the second fills with it, and closes the popup")
    place = int(x + 1.07 * width), y
    window = bpy.context.window_manager.windows[0]
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=place[0], y=place[1])
    yield from redrawn()  # a button takes a click once the mouse is seen over it
    click(*place)
    yield from until(lambda: RESULT in bpy.data.objects and ended(), "the end of the run")
    yield from seen("variations_filled")
    result = bpy.data.objects[RESULT]
    made = result.meander.figures.variation
    assert made == 1 == result.meander.variation, (made, x, y, width)

    step("New Curve makes the next")
    with bpy.context.temp_override(**window_override()):
        bpy.ops.meander.run("INVOKE_DEFAULT", True, beside=True)
    yield from until(lambda: f"{RESULT}.001" in bpy.data.objects and ended(), "another curve")
    assert bpy.data.objects[f"{RESULT}.001"].meander.figures.variation == 2
    yield from seen("variations_new_curve")
