# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result is to do when its surface moves."""

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, PointerProperty

from ..run import following


def _begin_again(settings: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """What follows was made for the settings as they were."""
    following.begin(settings.id_data, context)


class MotionSettings:
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
    motion: EnumProperty(
        name="Motion",
        description="What becomes of the curve when the surface changes its shape",
        items=(
            ("EVEN", "Keep Even", "The flow goes on: strands stay at the spacing"),
            ("STICK", "Stick", "Points stay on their faces, as a texture does"),
        ),
        default="EVEN",
        options=set(),
        update=_begin_again,
    )
    motion_steps: IntProperty(
        name="Steps",
        description="Iterations for each frame; more keep the spacing through faster motion",
        default=3,
        min=1,
        soft_max=20,
        max=1000,
        options=set(),
        update=_begin_again,
    )
    bake: PointerProperty(
        type=bpy.types.Collection,
        name="Baked Frames",
        description="The collection of the frames that were baked from this curve",
        options=set(),
    )
