# SPDX-License-Identifier: GPL-3.0-or-later
"""What is added to Blender when the add-on is enabled, in the order in which it is needed."""

from __future__ import annotations

from . import (
    camera_operator,
    cut_panel,
    events,
    export_operator,
    gaps_operator,
    help,
    light_operator,
    live_operator,
    look_panel,
    made_operators,
    maps_operator,
    maze_operator,
    menu,
    motion_panel,
    operators,
    panels,
    points_panel,
    preferences,
    preparation_panels,
    presets,
    run_operators,
    seed_drawing,
    seed_operators,
    settings,
    strand_panel,
    term_panels,
)

# Panels name their parent, so the main one comes before its sub-panels.
_MODULES = (
    preferences,
    settings,
    run_operators,
    live_operator,
    operators,
    gaps_operator,
    made_operators,
    help,
    presets,
    panels,
    look_panel,
    term_panels,
    motion_panel,
    cut_panel,
    maze_operator,
    export_operator,
    camera_operator,
    light_operator,
    maps_operator,
    points_panel,
    preparation_panels,
    seed_drawing,
    seed_operators,
    strand_panel,
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
