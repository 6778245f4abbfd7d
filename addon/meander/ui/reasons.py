# SPDX-License-Identifier: GPL-3.0-or-later
"""Buttons that say why they cannot be pressed."""

from __future__ import annotations

from collections.abc import Iterator

import bpy

Reasons = Iterator[str | None]


class Reasoned:
    """An operator that cannot begin as long as there is a reason against it."""

    @classmethod
    def reasons(cls, context: bpy.types.Context) -> Reasons:
        """What may stand against it, None where that does not; the first one is shown, and what
        comes after it is not asked for."""
        raise NotImplementedError

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        reason = next((each for each in cls.reasons(context) if each is not None), None)
        if reason is not None:
            cls.poll_message_set(reason)
        return reason is None


def not_in_object_mode(context: bpy.types.Context) -> str | None:
    return None if context.mode == "OBJECT" else "Works in Object Mode"
