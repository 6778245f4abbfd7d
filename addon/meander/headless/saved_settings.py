# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that a .blend holds, readable whether the add-on is enabled or not."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy

from ..ui import settings


@contextmanager
def saved_settings() -> Iterator[None]:
    """Makes ``object.meander`` readable while the block lasts, whether the add-on is on or not."""
    if hasattr(bpy.types.Object, "meander"):
        yield
        return
    settings.register()
    try:
        yield
    finally:
        settings.unregister()  # what is left registered at exit hangs the bpy module
