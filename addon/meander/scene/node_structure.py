# SPDX-License-Identifier: GPL-3.0-or-later
"""What a node tree is, in plain values: to tell whether two are the same, or one was edited.

Where nodes stand, and what is selected, does not count.
"""

from __future__ import annotations

import hashlib
from typing import Any

import bpy

from .blender_versions import group_sockets

# Settings of nodes that change only how they are drawn.
_DRAWN = frozenset(bpy.types.Node.bl_rna.properties.keys()) - {"mute"}
_VALUES = ("default_value", "min_value", "max_value", "description", "hide_value")


def structure_of(tree: bpy.types.NodeTree) -> dict[str, Any]:
    """The sockets, nodes and links of a tree, as what JSON can hold."""
    return {
        "kind": tree.bl_idname,
        "inputs": [_declared(socket) for socket in group_sockets(tree, "INPUT")],
        "outputs": [_declared(socket) for socket in group_sockets(tree, "OUTPUT")],
        "nodes": {node.name: _node(node) for node in tree.nodes},
        "links": sorted(
            [
                link.from_node.name,
                link.from_socket.identifier,
                link.to_node.name,
                link.to_socket.identifier,
            ]
            for link in tree.links
        ),
    }


def fingerprint(tree: bpy.types.NodeTree) -> str:
    """A short text that is another one when the tree is, in the same Blender."""
    return hashlib.sha256(repr(structure_of(tree)).encode()).hexdigest()[:16]


def _declared(socket: Any) -> list[Any]:
    kind = getattr(socket, "socket_type", None) or socket.bl_socket_idname
    return [socket.name, kind, *(_plain(getattr(socket, name, None)) for name in _VALUES)]


def _node(node: bpy.types.Node) -> dict[str, Any]:
    settings = {
        name: _plain(getattr(node, name))
        for name, prop in node.bl_rna.properties.items()
        if name not in _DRAWN and (not prop.is_readonly or prop.type == "POINTER")
    }
    linked = {socket.identifier for socket in node.inputs if socket.is_linked}
    values = {
        socket.identifier: _plain(getattr(socket, "default_value", None))
        for socket in node.inputs
        if socket.identifier not in linked
    }
    return {"kind": node.bl_idname, "settings": settings, "values": values}


def _plain(value: Any) -> Any:
    """A value as numbers, texts and lists; data-blocks by their names."""
    if isinstance(value, float):
        return float(f"{value:.6g}")
    if isinstance(value, (str, int, type(None))):
        return value
    if isinstance(value, bpy.types.ID):
        return value.name
    if isinstance(value, bpy.types.ColorRamp):
        return [
            value.interpolation,
            *([_plain(element.position), _plain(element.color)] for element in value.elements),
        ]
    if isinstance(value, bpy.types.CurveMapping):
        return [[_plain(point.location) for point in curve.points] for curve in value.curves]
    if isinstance(value, bpy.types.bpy_struct):  # part of Blender, such as the group's interface
        return None
    return [_plain(item) for item in value]
