# SPDX-License-Identifier: GPL-3.0-or-later
"""The modifier that gives a result its look: which it is, and what it is set to."""

from __future__ import annotations

from typing import Any

import bpy

from . import assets
from .node_structure import group_sockets

GROUP = "Meander Look"


def modifier_of(thing: bpy.types.Object) -> bpy.types.NodesModifier | None:
    """The modifier that gives a curve its look; None where there is none."""
    return next((other for other in thing.modifiers if _is_look(other)), None)


def shaping_modifiers(thing: bpy.types.Object) -> list[bpy.types.Modifier]:
    """Those that change the line itself: what comes before its look, of which a body is made."""
    shaping = []
    for modifier in thing.modifiers:
        if _is_look(modifier):
            break
        shaping.append(modifier)
    return shaping


def _is_look(modifier: bpy.types.Modifier) -> bool:
    return modifier.type == "NODES" and assets.is_asset(modifier.node_group, GROUP)


def path_of(modifier: bpy.types.NodesModifier, name: str) -> str | None:
    """Where a modifier keeps an input of its group, as layouts want it; None: the user's group has
    no such input any more."""
    identifier = _identifier(modifier, name)
    return None if identifier is None else f'["{identifier}"]'


def value_of(modifier: bpy.types.NodesModifier, name: str) -> Any:
    """What an input of the group is set to; None where there is no such input."""
    identifier = _identifier(modifier, name)
    return None if identifier is None else modifier[identifier]


def set_value(modifier: bpy.types.NodesModifier, name: str, value: Any) -> None:
    """Sets an input of the group; nothing happens where there is no such input."""
    identifier = _identifier(modifier, name)
    if identifier is None:
        return
    if isinstance(modifier[identifier], float):  # a whole number would make another property of it
        value = float(value)
    modifier[identifier] = value
    if bpy.app.version < (4, 0):
        # There the property is a new one, and choosing the group brings its limits and slider back.
        modifier.node_group = modifier.node_group
    modifier.id_data.update_tag()


def _identifier(modifier: bpy.types.NodesModifier, name: str) -> str | None:
    for socket in group_sockets(modifier.node_group, "INPUT"):
        if socket.name == name and socket.identifier in modifier.keys():
            return socket.identifier
    return None
