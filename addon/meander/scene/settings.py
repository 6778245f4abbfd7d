# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings on an object: whose they are, and how a result takes them over.

The property groups themselves are declared in `ui`; what is here reads plain attributes.
"""

from __future__ import annotations

import bpy

from .fillable import has_faces, is_result
from .made import made_from

# What belongs to one object: what it lies on, what its last run came to, and what it does now.
_OWN = frozenset(
    {
        "rna_type",
        "name",
        "surface",
        "figures",
        "problem",
        "follow",
        "bake",
        "last_result",
        "made_from",
        "made_by",
        "keep_up",
        "made_material",
        "made_material_by",
        "shown_profile",
        "shown_ends",
    }
)


# What ends so shows another setting, which counts in halves of the spacing, in whole ones.
IN_SPACINGS = "_in_spacings"


def is_copied(name: str) -> bool:
    """Whether a result takes a setting over from those that it was made with."""
    return name not in _OWN and not name.endswith(IN_SPACINGS)


def copied(settings: bpy.types.PropertyGroup) -> list[str]:
    """The names of the settings that a result takes over from those that it was made with."""
    return [name for name in settings.bl_rna.properties.keys() if is_copied(name)]


def copy_settings(source: bpy.types.PropertyGroup, target: bpy.types.PropertyGroup) -> None:
    """Copies what a user can choose, not the surface and not the figures."""
    former = target.density_ramp
    for name in copied(source):
        setattr(target, name, getattr(source, name))
    if target.density_ramp not in (None, former):
        # Each has its own, so that one may be changed and the other is what it was made with.
        target.density_ramp = target.density_ramp.copy()


def is_untouched(settings: bpy.types.PropertyGroup) -> bool:
    """Whether nobody has chosen anything. Blender counts a pointer as set that was only read."""
    return not any(
        settings.is_property_set(name)
        and (settings.bl_rna.properties[name].type != "POINTER" or getattr(settings, name))
        for name in copied(settings)
    )


def adopt(
    source: bpy.types.PropertyGroup,
    target: bpy.types.PropertyGroup,
    without: frozenset[str] = frozenset(),
) -> None:
    """Gives settings that nobody has touched the choices that another object has made, but for
    some.

    Only numbers, switches and choices: names and objects belong to the mesh that they are of.
    """
    if not is_untouched(target):
        return
    for name in copied(target):
        kind = source.bl_rna.properties[name].type
        own = kind in {"POINTER", "STRING", "COLLECTION"} or name.endswith("_source")
        if not own and name not in without and source.is_property_set(name):
            setattr(target, name, getattr(source, name))


def surface_of(object: bpy.types.Object | None) -> bpy.types.Object | None:
    """The surface that an object stands for: what has faces itself, or the surface of a result.

    None for what was made from a curve: that is looked at, and rarely filled.
    """
    if is_result(object):
        return object.meander.surface
    return object if has_faces(object) and made_from(object) is None else None
