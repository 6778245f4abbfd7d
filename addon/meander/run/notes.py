# SPDX-License-Identifier: GPL-3.0-or-later
"""Why something was refused last, for the panel: a sentence on an object, which stays as long as
what a run on it would mean does.
"""

from __future__ import annotations

import bpy

from ..scene.identity import number_of
from .lasting import Memory
from .meaning import Meaning, meaning_of

# By the number of the object, and with who left it.
_notes: Memory[int, tuple[str, Meaning | None, str]] = Memory()


def keep(thing: bpy.types.Object | None, sentence: str, by: str = "") -> None:
    """Notes a sentence on an object, instead of the one before it.

    by   which operator says so; empty: a run
    """
    if thing is not None:
        _notes[number_of(thing)] = sentence, meaning_of(thing), by


def clear(thing: bpy.types.Object | None, by: str | None = None) -> None:
    """Takes a note away: that of one operator, or with None whosever it is."""
    if thing is None:
        return
    _sentence, _meaning, left_by = _notes.get(number_of(thing), ("", None, ""))
    if by in (None, left_by):
        _notes.pop(number_of(thing), None)


def of(thing: bpy.types.Object) -> str:
    """The note on an object; empty where there is none, or what it was said of has changed."""
    sentence, meaning, _by = _notes.get(number_of(thing), ("", None, ""))
    if not sentence:
        return ""
    now = meaning_of(thing)
    same = now is None if meaning is None else meaning.same_as(now)
    return sentence if same else ""
