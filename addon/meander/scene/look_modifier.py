# SPDX-License-Identifier: GPL-3.0-or-later
"""The modifier that gives a result its look: which it is, and what it is set to."""

from __future__ import annotations

from typing import Any

import bpy

from . import assets
from .blender_versions import group_sockets, input_place, input_value, set_input_value

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


def place_of(modifier: bpy.types.NodesModifier, name: str) -> tuple[Any, str] | None:
    """What holds an input of the group, and the property's name there, as layouts want it; None:
    the user's group has no such input any more."""
    identifier = _identifier(modifier, name)
    return None if identifier is None else input_place(modifier, identifier)


def value_of(modifier: bpy.types.NodesModifier, name: str) -> Any:
    """What an input of the group is set to; None where there is no such input."""
    identifier = _identifier(modifier, name)
    return None if identifier is None else input_value(modifier, identifier)


def set_value(modifier: bpy.types.NodesModifier, name: str, value: Any) -> None:
    """Sets an input of the group; nothing happens where there is no such input."""
    identifier = _identifier(modifier, name)
    if identifier is not None:
        set_input_value(modifier, identifier, value)


def copy_values(source: bpy.types.NodesModifier, target: bpy.types.NodesModifier) -> None:
    """Sets all inputs of a modifier to what another one of the same group has."""
    for socket in group_sockets(source.node_group, "INPUT"):
        if input_place(source, socket.identifier) is not None:
            set_input_value(target, socket.identifier, input_value(source, socket.identifier))


def _identifier(modifier: bpy.types.NodesModifier, name: str) -> str | None:
    for socket in group_sockets(modifier.node_group, "INPUT"):
        if socket.name == name and input_place(modifier, socket.identifier) is not None:
            return socket.identifier
    return None
