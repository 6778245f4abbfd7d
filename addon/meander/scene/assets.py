# SPDX-License-Identifier: GPL-3.0-or-later
"""Node groups and materials of the file that comes with the add-on, brought into the open one.

Each comes once. It is used again as long as nobody has changed it; one that was changed is its
user's, and whoever asks next gets a fresh one beside it.
"""

from __future__ import annotations

from pathlib import Path

import bpy

from .errors import DataError
from .node_structure import fingerprint

FILE = Path(__file__).resolve().parents[1] / "assets" / "meander.blend"
# One more whenever what is in the file changes what it does; earlier copies stay as they are.
VERSION = 2
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
