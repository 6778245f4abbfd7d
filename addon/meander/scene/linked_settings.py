# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the settings on an object are: on itself, or in the scene where it cannot keep them.

Blender saves nothing that is changed in a linked object, and of an override nothing of ours; nor
may a linked object name a curve of the file. So settings of those live in the scene, as an entry
that names the object: Blender itself stores that as library and name, and follows it when the
library moves. Read settings by settings_of(), and change those of a surface by
settings_to_change(); the settings of a curve that Meander has made are its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import bpy

from .settings import copied


def is_from_file(thing: bpy.types.ID) -> bool:
    """Whether a data-block comes from another file, so that what is changed in it is not saved."""
    return thing.library is not None or thing.override_library is not None


def _entry_of(thing: bpy.types.Object) -> Any | None:
    entries = (entry for scene in bpy.data.scenes for entry in scene.meander_linked)
    return next((entry for entry in entries if entry.surface == thing), None)


def settings_of(thing: bpy.types.Object) -> bpy.types.PropertyGroup:
    """The settings on an object, to be read; cheap, for panels."""
    entry = _entry_of(thing)
    return thing.meander if entry is None else entry.settings


def can_be_changed(thing: bpy.types.Object) -> bool:
    """Whether settings_of() are settings that a file keeps."""
    return not is_from_file(thing) or _entry_of(thing) is not None


def settings_to_change(thing: bpy.types.Object) -> bpy.types.PropertyGroup:
    """The settings on a surface, to be changed; not for panels.

    Those of one from another file begin as they are there, in a scene that has the object.
    """
    if can_be_changed(thing):
        return settings_of(thing)
    scenes = [scene for scene in thing.users_scene if scene.library is None]
    if not scenes:
        return thing.meander
    entry = scenes[0].meander_linked.add()
    entry.surface = thing
    for name in copied(thing.meander):
        if thing.meander.is_property_set(name):
            setattr(entry.settings, name, getattr(thing.meander, name))
    return entry.settings


def owner_of(settings: bpy.types.PropertyGroup) -> bpy.types.Object | None:
    """The object whose settings these are."""
    owner = settings.id_data
    if not isinstance(owner, bpy.types.Scene):
        return owner
    found = (entry.surface for entry in owner.meander_linked if entry.settings == settings)
    return next(found, None)


@contextmanager
def lent(thing: bpy.types.Object, names: Iterable[str]) -> Iterator[None]:
    """For what knows ``object.meander`` alone, such as Blender's presets: meanwhile that has the
    settings of these names, numbers and choices only, which are taken back from there.
    """
    own, settings = thing.meander, settings_to_change(thing)
    if own == settings:
        yield
        return
    before = {name: getattr(own, name) for name in names}
    for name in before:
        setattr(own, name, getattr(settings, name))
    try:
        yield
    finally:
        for name, value in before.items():
            setattr(settings, name, getattr(own, name))
            setattr(own, name, value)


def before_save() -> None:
    """Lets go of objects that are in no scene any more, which would stay in the file."""
    for scene in bpy.data.scenes:
        if scene.library is not None:
            continue
        for index in reversed(range(len(scene.meander_linked))):
            surface = scene.meander_linked[index].surface
            if surface is None or not surface.users_scene:
                scene.meander_linked.remove(index)
