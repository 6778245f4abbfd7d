# SPDX-License-Identifier: GPL-3.0-or-later
"""What is added to Blender when the add-on is enabled, in the order in which it is needed."""

from __future__ import annotations

from ..run import (
    estimates,
    following,
    gap_marks,
    live,
    notes,
    seed_preview,
    session,
    suspended,
)
from ..scene import after_undo, changes, identity, linked_settings, look_material, solid_view
from . import (
    camera_operator,
    cut_panel,
    export_operator,
    gaps_operator,
    help,
    light_operator,
    live_operator,
    look_panel,
    maps_operator,
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
    identity,
    changes,
    linked_settings,
    after_undo,
    look_material,
    solid_view,
    preferences,
    settings,
    session,
    suspended,
    live,
    notes,
    seed_preview,
    estimates,
    following,
    gap_marks,
    run_operators,
    live_operator,
    operators,
    gaps_operator,
    help,
    presets,
    panels,
    look_panel,
    term_panels,
    motion_panel,
    cut_panel,
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
)


def register() -> None:
    """Adds the settings, handlers, operators, panels and menu entries to Blender."""
    for module in _MODULES:
        module.register()


def unregister() -> None:
    """Takes everything out again; a run that is still going is cancelled first."""
    for module in reversed(_MODULES):
        module.unregister()
