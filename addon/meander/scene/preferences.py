# SPDX-License-Identifier: GPL-3.0-or-later
"""The preferences of the add-on, as runs read them; `ui` declares them."""

from __future__ import annotations

from typing import Any

import bpy

# "meander" as an add-on of 3.4, "bl_ext.user_default.meander" as an extension.
PACKAGE = __package__.rpartition(".")[0]


def _of_the_user() -> Any | None:
    """None where the package is registered but not installed."""
    addon = bpy.context.preferences.addons.get(PACKAGE)
    return None if addon is None else addon.preferences


def preferred(name: str, default: Any = 0) -> Any:
    """A preference as the user has set it, or a default where there are none."""
    found = _of_the_user()
    return default if found is None else getattr(found, name)
