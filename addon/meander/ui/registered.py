# SPDX-License-Identifier: GPL-3.0-or-later
"""What a module of panels and operators does when the add-on is enabled, and when it is not."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import bpy

_Draw = Callable[[bpy.types.Menu, bpy.types.Context], None]
_NO_MENUS: Mapping[str, _Draw] = {}


def registration(
    *classes: type, menus: Mapping[str, _Draw] = _NO_MENUS
) -> tuple[Callable[[], None], Callable[[], None]]:
    """The functions register and unregister of a module that has only classes, in their order.

    menus   menus of Blender's, and what adds to each
    """

    def register() -> None:
        for cls in classes:
            bpy.utils.register_class(cls)
        for name, draw in menus.items():
            getattr(bpy.types, name).append(draw)

    def unregister() -> None:
        for name, draw in menus.items():
            getattr(bpy.types, name).remove(draw)
        for cls in reversed(classes):
            bpy.utils.unregister_class(cls)

    return register, unregister
