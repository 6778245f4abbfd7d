# SPDX-License-Identifier: GPL-3.0-or-later
"""What is added to Blender when the add-on is enabled, in the order in which it is needed."""

from __future__ import annotations

from . import (
    alignment,
    camera,
    cut,
    density,
    drawing,
    events,
    export,
    fill,
    gaps,
    help,
    light,
    live,
    look,
    made,
    maps,
    material,
    maze,
    menu,
    motion,
    operators,
    panels,
    picture,
    points,
    preferences,
    preparation,
    presets,
    rendered,
    seeds,
    settings,
    strands,
    terms,
    variations,
)

# Panels name their parent, so the main one comes before its sub-panels.
_MODULES = (
    preferences,
    settings,
    fill,
    live,
    variations,
    operators,
    gaps,
    made,
    help,
    presets,
    panels,
    look,
    density,
    alignment,
    terms,
    motion,
    cut,
    material,
    maze,
    export,
    camera,
    light,
    maps,
    picture,
    points,
    preparation,
    rendered,
    drawing,
    seeds,
    strands,
    menu,
    events,  # last, so that whatever they call is there
)


def register() -> None:
    """Adds the settings, handlers, operators, panels and menu entries to Blender."""
    for module in _MODULES:
        module.register()


def unregister() -> None:
    """Takes everything out again; a run that is still going is cancelled first."""
    for module in reversed(_MODULES):
        module.unregister()
