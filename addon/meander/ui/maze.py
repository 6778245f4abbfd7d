# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a maze of a result: walls along its line, two doors, and the way between them."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty

from ..model.maze import Doors, Maze, NoMaze
from ..run.cut import CutResult
from ..scene.errors import DataError
from ..scene.maze import write_walls, write_way
from ..scene.transforms import mean_scale
from .cut import Cut, hide_originals

# Of the way's tube, in spacings.
_WAY = 0.08


class MEANDER_OT_maze(Cut, bpy.types.Operator):
    bl_idname = "meander.maze"
    bl_label = "Maze"
    bl_description = (
        "Build walls along the curve, with two doors: a closed curve has two sides, in each of "
        "which one way only leads from any place to any other"
    )
    suffix = "Maze"
    middle_lines = True
    takes_place = False  # the surface is its floor
    detail = 0.5

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

    _remark = ""

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

    def make(self, cut: CutResult, name: str) -> list[bpy.types.Object]:
        surface, matrix, spacing = cut.plan.surface.find(), cut.plan.matrix, cut.plan.spacing
        try:
            maze = Maze(cut.cut, spacing)
        except NoMaze as problem:
            raise DataError(
                f"The curve {problem}; fill a sheet or a shape without handles with one closed "
                "curve"
            ) from problem
        doors = self._doors(maze)
        made = [
            write_walls(
                name, cut.cut, surface, matrix, spacing,
                (self.width * spacing, self.height * spacing),
                (doors, (self.door_width + self.width) * spacing),
            )
        ]  # fmt: skip
        self._remark = ""
        if doors is not None:
            vertices = maze.way(doors)
            self._remark = f", {maze.hardness(vertices)}"
            if not doors.through:
                self._remark += "; the way keeps to the rim, try another variation"
            if self.solution:
                way = cut.cut.positions[vertices]
                thickness = _WAY * spacing / mean_scale(matrix)
                made.append(write_way(f"{name} Solution", way, surface, matrix, thickness))
        return made

    def _doors(self, maze: Maze) -> Doors | None:
        if self.doors == "NONE":
            return None
        if self.doors == "CHOSEN":
            return maze.doors_at(self.first_door, self.second_door)
        return maze.farthest_doors()

    def remark(self, _cut: CutResult) -> str:
        return self._remark


def register() -> None:
    bpy.utils.register_class(MEANDER_OT_maze)


def unregister() -> None:
    bpy.utils.unregister_class(MEANDER_OT_maze)
