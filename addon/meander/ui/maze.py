# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a maze of a result: walls along its line, two doors, and the way between them."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty

from .cut import Cut, hide_originals
from .registered import registration


class MEANDER_OT_maze(Cut, bpy.types.Operator):
    bl_idname = "meander.maze"
    bl_label = "Maze"
    bl_description = (
        "Build walls along the curve, with two doors: a closed curve has two sides, in each of "
        "which one way only leads from any place to any other"
    )
    maker = "maze"
    takes_place = False  # the surface is its floor

    height: FloatProperty(
        name="Height", description="Of the walls, in spacings", default=0.6, min=0.01, soft_max=2.0
    )
    width: FloatProperty(
        name="Width",
        description="Of the walls, in spacings; corridors have the rest",
        default=0.2,
        min=0.01,
        max=0.9,
    )
    doors: EnumProperty(
        name="Doors",
        description="Where gaps in the wall lead into the maze",
        items=(
            ("FAR", "Far Apart", "With a long way between them; of a sheet on two of its sides"),
            ("CHOSEN", "Chosen", "At two places along the curve"),
            ("NONE", "None", "A wall without gaps"),
        ),
    )
    first_door: FloatProperty(
        name="First",
        description="Place of a door along the curve, 0 at its beginning and 1 at its end",
        default=0.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    second_door: FloatProperty(
        name="Second",
        description="Place of the other door along the curve",
        default=0.5,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    door_width: FloatProperty(
        name="Door Width",
        description="Of the gap in the wall, in spacings",
        default=0.8,
        min=0.05,
        soft_max=1.5,
    )
    solution: BoolProperty(
        name="Solution",
        description="Make a curve of the way from door to door",
        default=False,
    )
    hide: hide_originals()

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in ("height", "width", "doors"):
            layout.prop(self, name)
        column = layout.column(align=True)
        if self.doors == "CHOSEN":
            column.prop(self, "first_door")
            column.prop(self, "second_door")
        if self.doors != "NONE":
            column.prop(self, "door_width")
            layout.prop(self, "solution")
        layout.prop(self, "hide", text="Hide Curve")


register, unregister = registration(MEANDER_OT_maze)
