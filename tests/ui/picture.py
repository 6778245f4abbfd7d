# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture in one line: chosen in the dialog, drawn while one looks on, undone, and changed."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np
from dialogs import chosen
from meander.model.files.png import png
from stage import (
    PICTURES,
    changed_share,
    ended,
    seen,
    show_panel,
    state,
    step,
    undo,
    until,
    view_override,
    window_override,
)

FILES = PICTURES / "photographs"
SHEET, LINE = "ball", "ball Meander"


def photograph() -> None:
    """A shaded ball before a wall."""
    FILES.mkdir(parents=True, exist_ok=True)
    place = (np.arange(60) + 0.5) / 60
    x, y = np.meshgrid(place, place)
    inside = ((x - 0.5) ** 2 + (y - 0.5) ** 2) / 0.1
    shade = 0.15 + 0.6 * np.sqrt(np.clip(1.0 - inside, 0.0, 1.0))
    values = np.where(inside < 1.0, shade, 0.5 + 0.4 * x)
    (FILES / f"{SHEET}.png").write_bytes(png((65535 * values).round().astype(np.uint16)))


def from_above() -> None:
    with bpy.context.temp_override(**view_override()):
        bpy.ops.view3d.view_axis(type="TOP")
        bpy.ops.view3d.view_selected()


def story() -> Iterator[float]:
    photograph()
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    # A unit is a millimetre, or the sheet would be as small as on paper.
    bpy.context.scene.unit_settings.scale_length = 0.001
    bpy.ops.ed.undo_push(message="Scene")
    before = state()

    step("the dialog makes the sheet, and its line grows while one looks on")
    yield from chosen(
        "picture", FILES / f"{SHEET}.png", "picture_dialog", width=60.0, pen=1.6
    )
    yield from until(lambda: SHEET in bpy.data.objects, "the sheet")
    from_above()
    yield from show_panel()
    yield from until(lambda: LINE in bpy.data.objects and ended(), "the line")
    yield from seen("picture_drawn")
    line, sheet = bpy.data.objects[LINE], bpy.data.objects[SHEET]
    assert line.meander.surface == sheet and len(line.data.splines) == 1
    assert line.data.splines[0].use_cyclic_u
    assert tuple(round(side) for side in sheet.dimensions) == (60, 60, 0)
    points = len(line.data.splines[0].points)

    step("undo takes the line away, and then the sheet")
    yield from undo()
    assert LINE not in bpy.data.objects and SHEET in bpy.data.objects
    yield from undo()
    assert state() == before
    yield from undo(redo=True)
    yield from undo(redo=True)
    assert len(bpy.data.objects[LINE].data.splines[0].points) == points

    step("a larger spacing on the sheet makes all of it lighter")
    sheet = bpy.data.objects[SHEET]
    bpy.context.view_layer.objects.active = sheet
    sheet.meander.spacing *= 1.6
    with bpy.context.temp_override(**window_override()):
        bpy.ops.meander.run("INVOKE_DEFAULT", True)
    yield from until(
        lambda: ended() and len(bpy.data.objects[LINE].data.splines[0].points) < 0.7 * points,
        "the lighter line",
    )
    yield from seen("picture_lighter")
    assert changed_share("picture_drawn", "picture_lighter") > 0.02
