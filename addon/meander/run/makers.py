# SPDX-License-Identifier: GPL-3.0-or-later
"""What is made of a surface that was cut along its curve: each maker by its name and its values.

The buttons and what makes the same again when the curve is another have these in common.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import bpy

from ..model.cut import light_colours, one_side
from ..model.maze import Doors, Maze, NoMaze
from ..scene import assets
from ..scene.columns import column
from ..scene.cut import UV_MAP, sharpen_line
from ..scene.errors import DataError
from ..scene.look import set_value
from ..scene.maze import write_walls, write_way
from ..scene.solid_view import colour_corners
from ..scene.transforms import mean_scale
from .cut import CutResult, cut_result, paint, paint_sides

Values = dict[str, Any]
# The objects, and what more there is to say, from a comma on.
Made = tuple[list[bpy.types.Object], str]

# What has a finer mesh than this, in half spacings, takes Blender long to draw.
_FINEST = 0.1
# The tube of a way through a maze, in spacings.
_WAY = 0.08
# How far a wall may be from the line, for round turns; as looks begin with.
_ROUND = 0.12
# The input of a modifier that is told the spacing.
SPACING = "Spacing"


@dataclass(frozen=True)
class Maker:
    """How a cut is made, and what of it.

    suffix        of the names of what is made
    make          makes the objects; raises DataError
    values        the names of what it is asked for, all of which make() is given
    detail        where `values` have none
    middle_lines  likewise
    sides         the sides are to be those at least where the curve does not part the surface
    round         the tolerance of the line with round turns that it takes, in spacings; 0: none
    """

    suffix: str
    make: Callable[[CutResult, str, Values], Made]
    values: tuple[str, ...]
    detail: float = 0.0
    middle_lines: bool = False
    sides: bool = False
    round: float = 0.0


def make(
    kind: str,
    values: Values,
    result: bpy.types.Object,
    scene: bpy.types.Scene,
    depsgraph: bpy.types.Depsgraph,
) -> Made:
    """Makes new objects of a result, beside its surface. Raises DataError and core.MeanderError."""
    maker = MAKERS[kind]
    detail = values.get("detail", maker.detail)
    cut = cut_result(
        result,
        scene,
        depsgraph,
        max(detail, _FINEST) if detail > 0.0 else 0.0,
        values.get("middle_lines", maker.middle_lines),
        maker.sides,
        maker.round,
    )
    return maker.make(cut, f"{result.name} {maker.suffix}", values)


def own_spacing(cut: CutResult) -> float:
    """In the space of the surface."""
    return cut.plan.spacing / mean_scale(cut.plan.matrix)


def _cut(cut: CutResult, name: str, _values: Values) -> Made:
    return [cut.make(name)], ""


def _two_tone(cut: CutResult, name: str, values: Values) -> Made:
    materials = [assets.material(f"Meander Side {number}") for number in (1, 2)]
    if values["parts"] == "ONE":
        whole = cut.make(name)
        paint_sides(whole, materials)
        made = [whole]
    else:
        made = []
        for side, material in zip((1, -1), materials, strict=True):
            made.append(cut.make(name, one_side(cut.cut, side)))
            paint(made[-1], material)
    if cut.parted:
        return made, ""
    return made, ", whose colors also meet halfway between turns, since the curve has one side only"


def _relief(cut: CutResult, name: str, _values: Values) -> Made:
    group, material = assets.node_group("Meander Relief"), assets.material("Meander Coral")
    made = cut.make(name, keep_normals=False)
    sharpen_line(made)
    paint(made, material)
    modifier = made.modifiers.new("Relief", "NODES")
    modifier.node_group = group
    set_value(modifier, SPACING, own_spacing(cut))
    return [made], ""


def _ribbon(cut: CutResult, name: str, values: Values) -> Made:
    material = assets.material("Meander Running Lights") if values["running_lights"] else None
    made = cut.make(name)
    if material is not None:
        paint(made, material)
    uv = column(made.data.uv_layers[UV_MAP].data, "uv", 2)
    colour_corners(made.data, light_colours(uv))
    return [made], ""


def _maze(cut: CutResult, name: str, values: Values) -> Made:
    surface, matrix, spacing = cut.plan.surface.find(), cut.plan.matrix, cut.plan.spacing
    try:
        maze = Maze(cut.cut, spacing)
    except NoMaze as problem:
        raise DataError(
            f"The curve {problem}; fill a sheet or a shape without handles with one closed curve"
        ) from problem
    doors = _doors(maze, values)
    width, height = values["width"], values["height"]
    made = [
        write_walls(
            name, cut.cut, cut.drawn, surface, matrix, spacing,
            (width * spacing, height * spacing),
            (doors, (values["door_width"] + width) * spacing),
        )
    ]  # fmt: skip
    if doors is None:
        return made, ""
    vertices = maze.way(doors)
    way = maze.places(vertices, doors)
    remark = f", {maze.hardness(vertices, way)}"
    if not doors.through:
        remark += "; the way keeps to the rim, try another variation"
    if values["solution"]:
        made.append(write_way(f"{name} Solution", way, surface, matrix, _WAY * own_spacing(cut)))
    return made, remark


def _doors(maze: Maze, values: Values) -> Doors | None:
    if values["doors"] == "NONE":
        return None
    if values["doors"] == "CHOSEN":
        return maze.doors_at(values["first_door"], values["second_door"])
    return maze.farthest_doors()


MAKERS = {
    "cut_along_curve": Maker("Cut", _cut, ("detail", "middle_lines")),
    "two_tone": Maker("Two-Tone", _two_tone, ("parts",), sides=True),
    "relief": Maker("Relief", _relief, ("detail",), middle_lines=True),
    "ribbon": Maker("Ribbon", _ribbon, ("detail", "running_lights"), middle_lines=True),
    "maze": Maker(
        "Maze",
        _maze,
        ("height", "width", "doors", "first_door", "second_door", "door_width", "solution"),
        detail=0.5,
        middle_lines=True,
        round=_ROUND,
    ),
}
