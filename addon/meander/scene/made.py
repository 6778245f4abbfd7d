# SPDX-License-Identifier: GPL-3.0-or-later
"""What was made from a curve, and the way back to it.

Each such object names its curve, which is hidden where it stands in the curve's place.
"""

from __future__ import annotations

from collections.abc import Iterable

import bpy

from .errors import DataError


def name_curve(made: Iterable[bpy.types.Object], curve: bpy.types.Object) -> None:
    """Notes on objects that they were made from a curve."""
    for thing in made:
        thing.meander.made_from = curve


def made_from(thing: bpy.types.Object | None) -> bpy.types.Object | None:
    """The curve that an object was made from; None for any other object, and where that curve has
    been deleted."""
    settings = getattr(thing, "meander", None)  # which the batch command may do without
    curve = settings.made_from if settings is not None else None
    return curve if curve is not None and curve.users_scene else None


def let_go(curve: bpy.types.Object) -> None:
    """Has no object name a curve any more."""
    for thing in bpy.data.objects:
        if thing.meander.made_from == curve:
            thing.meander.made_from = None


def before_save() -> None:
    """Lets go of curves that are in no scene any more, which would stay in the file."""
    for thing in bpy.data.objects:
        curve = thing.meander.made_from
        if thing.library is None and curve is not None and not curve.users_scene:
            thing.meander.made_from = None


def bring_into_view(curve: bpy.types.Object, context: bpy.types.Context) -> None:
    """Shows a curve, selects it and nothing else, and makes it active.

    Raises DataError where it is in nothing that the view layer shows.
    """
    view_layer = context.view_layer
    in_layer = view_layer.objects.get(curve.name) == curve
    if in_layer:
        if curve.library is None:
            curve.hide_viewport = curve.hide_render = False
        curve.hide_set(False)
        _show_in_local_view(curve, context)
    if not in_layer or not curve.visible_get(view_layer=view_layer):
        where = ", ".join(f"'{each.name}'" for each in curve.users_collection)
        raise DataError(
            f"'{curve.name}' is in what this view layer does not show; show {where or 'its scene'}"
        )
    for other in list(context.selected_objects):
        other.select_set(False)
    curve.select_set(True)
    view_layer.objects.active = curve


def _show_in_local_view(curve: bpy.types.Object, context: bpy.types.Context) -> None:
    space = context.space_data
    if space is not None and space.type == "VIEW_3D" and space.local_view is not None:
        curve.local_view_set(space, True)
