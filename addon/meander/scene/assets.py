# SPDX-License-Identifier: GPL-3.0-or-later
"""Node groups and materials of the file that comes with the add-on, brought into the open one.

Each comes once. It is used again as long as nobody has changed it, which the structure of its node
tree in plain values tells; one that was changed is its user's, and whoever asks next gets a fresh
one beside it.
"""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path
from typing import Any

import bpy

from .blender_versions import group_sockets
from .errors import DataError

FILE = Path(__file__).resolve().parents[1] / "assets" / "meander.blend"
# One more whenever what is in the file changes what it does; earlier copies stay as they are.
VERSION = 4
# On what comes from the file: its version there, and what it was like when it came.
MARK = "meander_asset"
_NAME = "meander_name"
_AS_IT_CAME = "meander_as_it_came"


def node_group(name: str) -> bpy.types.NodeTree:
    """The node group of that name from the add-on's file, as it is there.

    Raises DataError where the file is missing or does not have it.
    """
    return _asset("node_groups", name)


def material(name: str) -> bpy.types.Material:
    """The material of that name from the add-on's file, as it is there; see node_group()."""
    return _asset("materials", name)


def is_asset(block: bpy.types.ID | None, name: str) -> bool:
    """Whether a data-block came from the add-on's file under that name, changed or not."""
    return block is not None and block.get(MARK) is not None and block.get(_NAME) == name


def _asset(collection: str, name: str) -> bpy.types.ID:
    for block in getattr(bpy.data, collection):
        current = is_asset(block, name) and block[MARK] == VERSION and block.library is None
        if current and _unchanged(block):
            return block
    return _appended(collection, name)


def _tree_of(block: bpy.types.ID) -> bpy.types.NodeTree:
    return block.node_tree if isinstance(block, bpy.types.Material) else block


def _state_of(block: bpy.types.ID) -> str:
    colour = block.diffuse_color[:] if isinstance(block, bpy.types.Material) else ()
    return f"{fingerprint(_tree_of(block))} {[round(value, 5) for value in colour]}"


def _unchanged(block: bpy.types.ID) -> bool:
    return block.get(_AS_IT_CAME) == _state_of(block)


def _appended(collection: str, name: str) -> bpy.types.ID:
    try:
        with bpy.data.libraries.load(str(FILE), link=False) as (there, here):
            if name not in getattr(there, collection):
                raise DataError(f"The add-on's file has no '{name}'; install Meander again")
            setattr(here, collection, [name])
    except OSError as error:
        raise DataError(f"'{FILE.name}' of the add-on is missing; install Meander again") from error
    block = getattr(here, collection)[0]
    block.asset_clear()
    block.use_fake_user = False
    block[_NAME] = name
    block[_AS_IT_CAME] = _state_of(block)
    return block


# Settings of nodes that change only how they are drawn.
_DRAWN = frozenset(bpy.types.Node.bl_rna.properties.keys()) - {"mute"}
_VALUES = ("default_value", "min_value", "max_value", "description", "hide_value")


def structure_of(tree: bpy.types.NodeTree) -> dict[str, Any]:
    """The sockets, nodes and links of a tree, as what JSON can hold.

    Where nodes stand, and what is selected, does not count.
    """
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


@cache
def _settings_of(kind: type[bpy.types.Node]) -> list[str]:
    """The names of the settings that nodes of a kind have by themselves: what another add-on gives
    them can go while Blender runs.
    """
    return [
        name
        for name, prop in kind.bl_rna.properties.items()
        if name not in _DRAWN
        and not prop.is_runtime
        and (not prop.is_readonly or prop.type == "POINTER")
    ]


def _node(node: bpy.types.Node) -> dict[str, Any]:
    settings = {name: _plain(getattr(node, name)) for name in _settings_of(type(node))}
    values = {
        socket.identifier: _plain(getattr(socket, "default_value", None))
        for socket in node.inputs
        if not socket.is_linked
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
