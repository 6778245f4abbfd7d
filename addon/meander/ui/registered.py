# SPDX-License-Identifier: GPL-3.0-or-later
"""What a module of panels and operators does when the add-on is enabled, and when it is not."""

from __future__ import annotations

from collections.abc import Callable

import bpy


def registration(*classes: type) -> tuple[Callable[[], None], Callable[[], None]]:
    """The functions register and unregister of a module that has only classes, in their order."""

    def register() -> None:
        for cls in classes:
            bpy.utils.register_class(cls)

    def unregister() -> None:
        for cls in reversed(classes):
            bpy.utils.unregister_class(cls)

    return register, unregister
