# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees written as text: nodes with their values, joined as they are made. Blender 3.4."""

from __future__ import annotations

from typing import Any

import bpy

# The column of a node is one more than that of what it needs.
_COLUMN, _ROW = 190.0, 170.0


class Tree:
    """A node tree that is filled node by node.

    A value of a socket is a number or the like, or an output of another node of the tree, which is
    then joined to it.
    """

    def __init__(self, tree: bpy.types.NodeTree) -> None:
        self.tree = tree
        self._columns: dict[str, int] = {}
        self._rows: dict[int, int] = {}

    def add(
        self, kind: str, values: dict[Any, Any] | None = None, **properties: Any
    ) -> bpy.types.Node:
        """A node of a kind (its bl_idname).

        values       of its inputs, by name or number; of several with that name, the first that
                     the properties leave visible
        properties   of the node itself, such as its operation
        """
        node = self.tree.nodes.new(kind)
        for name, value in properties.items():
            setattr(node, name, value)
        column = 0
        for key, value in (values or {}).items():
            socket = self._socket(node, key)
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, socket)
                column = max(column, self._columns[value.node.name] + 1)
            else:
                socket.default_value = value
        self._columns[node.name] = column
        row = self._rows.get(column, 0)
        self._rows[column] = row + 1
        node.location = (column * _COLUMN, -row * _ROW)
        return node

    def math(self, operation: str, *values: Any) -> bpy.types.NodeSocket:
        """A Math node's result."""
        return self.add("ShaderNodeMath", dict(enumerate(values)), operation=operation).outputs[0]

    @staticmethod
    def _socket(node: bpy.types.Node, key: Any) -> bpy.types.NodeSocket:
        if isinstance(key, int):
            return node.inputs[key]
        found = [socket for socket in node.inputs if socket.name == key and socket.enabled]
        if not found:
            raise KeyError(f"{node.bl_idname} has no input {key}")
        return found[0]


def visible(sockets: Any, name: str) -> bpy.types.NodeSocket:
    """Of the sockets with a name, the one that the settings of the node show."""
    return next(socket for socket in sockets if socket.name == name and socket.enabled)


def switch(
    tree: Tree, condition: bpy.types.NodeSocket, no: object, yes: object, kind: str
) -> bpy.types.NodeSocket:
    """One of two values, or geometries, by a condition; `kind` is the node's input type."""
    node = tree.add(
        "GeometryNodeSwitch", {"Switch": condition, "False": no, "True": yes}, input_type=kind
    )
    return visible(node.outputs, "Output")


def geometry_group(name: str, tip: str) -> bpy.types.NodeTree:
    """An empty Geometry Nodes group from geometry to geometry, marked as an asset."""
    group = bpy.data.node_groups.new(name, "GeometryNodeTree")
    group.inputs.new("NodeSocketGeometry", "Geometry")
    group.outputs.new("NodeSocketGeometry", "Geometry")
    mark(group, tip, "Modifiers")
    return group


def declare(
    group: bpy.types.NodeTree,
    kind: str,
    name: str,
    tip: str,
    default: Any = None,
    least: float | None = None,
    greatest: float | None = None,
) -> None:
    """An input of a group, as its users see it; `kind` is the socket's bl_idname."""
    socket = group.inputs.new(kind, name)
    socket.description = tip
    if default is not None:
        socket.default_value = default
    if least is not None:
        socket.min_value = least
    if greatest is not None:
        socket.max_value = greatest


# The catalogs of the asset browser: their numbers are in the files of users, never to be changed.
CATALOGS = {
    "Modifiers": "5d0f6b5e-52c6-4f2b-9a6e-0f3f5f8c7a01",
    "Materials": "5d0f6b5e-52c6-4f2b-9a6e-0f3f5f8c7a02",
}


def mark(block: bpy.types.ID, tip: str, catalog: str) -> None:
    """Makes a data-block an asset."""
    block.asset_mark()
    block.asset_data.description = tip
    block.asset_data.author = "Meander"
    block.asset_data.catalog_id = CATALOGS[catalog]
    block.asset_data.tags.new("Meander")
