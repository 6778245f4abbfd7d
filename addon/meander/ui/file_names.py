# SPDX-License-Identifier: GPL-3.0-or-later
"""Which file a name stands for that was typed or given by a script."""

from __future__ import annotations

import os

import bpy

from ..scene.errors import DataError


def file_named(name: str, suffixes: str) -> str:
    """The whole path of a file that is to be written, // being the folder of the .blend.

    suffixes   what its name may end in, in words

    Raises DataError for a name that is empty, a folder's, or beside a .blend that is not saved.
    """
    if not name.strip():
        raise DataError(f"No file is named; give a name that ends in {suffixes}")
    if name.startswith("//") and not bpy.data.filepath:
        raise DataError(
            f"{name} lies beside the .blend, which is not saved; save it, or give a whole path"
        )
    path = bpy.path.abspath(name)
    if path.endswith(("/", os.sep)):
        raise DataError(f"{path} is a folder; give a file name")
    return path
