# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result is to do when its surface moves."""

import bpy
from bpy.props import BoolProperty, PointerProperty

from ..run import motion


def _begin_again(settings: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """What follows was made for the settings as they were."""
    motion.begin(settings.id_data, context)


class FollowSettings:
    """Settings on a result, mixed into MeanderSettings."""

    follow: BoolProperty(
        name="Follow",
        description=(
            "Update the curve whenever the frame changes. It needs this add-on: bake the frames "
            "for files that render elsewhere"
        ),
        default=False,
        options=set(),
        update=_begin_again,
    )
    bake: PointerProperty(
        type=bpy.types.Collection,
        name="Baked Frames",
        description="The collection of the frames that were baked from this curve",
        options=set(),
    )
