# SPDX-License-Identifier: GPL-3.0-or-later
"""Why something was refused last, for the panel: a sentence on an object, which stays as long as
what a run on it would mean does.
"""

from __future__ import annotations

import bpy
from bpy.app.handlers import persistent

from ..scene.identity import number_of
from .meaning import Meaning, meaning_of

# By the number of the object.
_notes: dict[int, tuple[str, Meaning | None]] = {}


def keep(thing: bpy.types.Object | None, sentence: str) -> None:
    """Notes a sentence on an object; an empty one takes the note away."""
    if thing is None:
        return
    if sentence:
        _notes[number_of(thing)] = sentence, meaning_of(thing)
    else:
        _notes.pop(number_of(thing), None)


def of(thing: bpy.types.Object) -> str:
    """The note on an object; empty where there is none, or what it was said of has changed."""
    sentence, meaning = _notes.get(number_of(thing), ("", None))
    if not sentence:
        return ""
    now = meaning_of(thing)
    same = now is None if meaning is None else meaning.same_as(now)
    return sentence if same else ""


@persistent
def _before_load(*_arguments: object) -> None:
    _notes.clear()


def register() -> None:
    bpy.app.handlers.load_pre.append(_before_load)


def unregister() -> None:
    bpy.app.handlers.load_pre.remove(_before_load)
    _notes.clear()
