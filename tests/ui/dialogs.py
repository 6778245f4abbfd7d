# SPDX-License-Identifier: GPL-3.0-or-later
"""Dialogs that choose a file."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import bpy
from stage import click, redrawn, seen, until, window_override


def browser() -> bpy.types.Area | None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "FILE_BROWSER":
                return area
    return None


def chosen(
    operator: str,
    path: Path,
    picture: str = "",
    look: Callable[[bpy.types.SpaceFileBrowser], None] = lambda space: None,
    **wishes: object,
) -> Iterator[float]:
    """The dialog of an operator, as a menu opens it, a name that is typed there, and its button.

    look   judges what is shown at first
    """
    with bpy.context.temp_override(**window_override()):
        getattr(bpy.ops.meander, operator)("INVOKE_DEFAULT", **wishes)
    yield from until(lambda: browser() is not None, "the dialog")
    yield from redrawn()
    area = browser()
    space = area.spaces.active
    assert space.active_operator.bl_idname == f"MEANDER_OT_{operator}"
    look(space)
    if picture:
        yield from seen(picture)
    space.params.directory = os.fsencode(f"{path.parent}/")
    space.params.filename = path.name
    yield from redrawn()
    buttons = next(region for region in area.regions if region.type == "EXECUTE")
    # What a script executes leaves the browser open.
    click(buttons.x + buttons.width - 50, buttons.y + buttons.height // 2)
    yield from until(lambda: browser() is None, "the view again")
