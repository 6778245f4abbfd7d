# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender as the batch command sees it. Nothing here imports bpy before it is asked for something:
the module takes a second to load, and files without a scene do not need it.
"""

from __future__ import annotations

import argparse
import importlib.util
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import core
from ..cli.grown import Grown
from ..cli.input import Input
from ..cli.values import BadInput
from ..model.picture.image import Image
from ..model.toolpaths import bridges, toolpath
from ..model.toolpaths.drawing import axes_of


class Blender:
    """A `cli.place.Host`, which says what each does."""

    def __init__(self) -> None:
        self._of_scene = ExitStack()

    def leave_scene(self) -> None:
        """Ends what read_scene() has begun: surfaces are filled as rendered, whatever it costs."""
        self._of_scene.close()

    def read_scene(self, arguments: argparse.Namespace) -> Input:
        from ..scene.rendered import whatever_it_costs
        from . import scene_input

        self._of_scene.enter_context(whatever_it_costs())
        return scene_input.read(arguments)

    def in_polygons(self, error: core.MeanderError, surface_object: Any) -> core.MeanderError:
        from . import scene_input

        return scene_input.in_polygons(error, surface_object)

    def refuse_points(self, points: str | None) -> None:
        from . import scene_output

        scene_output.refuse_points(points)

    def write_scene(
        self, path: Path, arguments: argparse.Namespace, given: Input, grown: Grown
    ) -> tuple[int, bridges.Joined | None, NDArray[np.float64] | None]:
        from . import scene_output

        return scene_output.write_scene(path, arguments, given, grown)

    def baked_frames(
        self, arguments: argparse.Namespace, given: Input, grown: Grown
    ) -> tuple[list[tuple[float, list[toolpath.Strand]]], float]:
        from . import scene_output

        return scene_output.baked_frames(arguments, given, grown)

    def write_cut_scene(
        self, path: Path, arguments: argparse.Namespace, given: Input, cut: core.CutSurface
    ) -> None:
        from . import scene_output

        scene_output.write_cut_scene(path, arguments, given, cut)

    def visible(
        self, strands: Sequence[toolpath.Strand], layout: str, given: Input
    ) -> list[toolpath.Strand]:
        import bpy  # noqa: F401  (under the bpy module, mathutils is not there before it)

        from ..scene.visible import visible_strands

        mesh = given.problem
        return visible_strands(strands, *axes_of(layout), mesh.vertices, mesh.faces)

    def unrolled(
        self, strands: Sequence[toolpath.Strand], given: Input, uv_map: str
    ) -> list[toolpath.Strand]:
        import bpy

        from ..scene.errors import DataError
        from ..scene.layouts import unrolled_strands

        depsgraph = bpy.context.evaluated_depsgraph_get()
        try:
            return unrolled_strands(strands, given.surface_object, depsgraph, uv_map)
        except DataError as refusal:
            raise BadInput(f"--layout uv is not possible here: {refusal}") from refusal

    def map_corners(self, given: Input, uv_map: str) -> NDArray[np.float64]:
        import bpy

        from ..scene.errors import DataError
        from ..scene.layouts import map_of

        depsgraph = bpy.context.evaluated_depsgraph_get()
        try:
            return map_of(given.surface_object, depsgraph, uv_map)
        except DataError as refusal:
            raise BadInput(f"--maps is not possible here: {refusal}") from refusal

    def image_file(self, name: str) -> Path | None:
        import bpy

        image = bpy.data.images.get(name)
        if image is None or not image.filepath:
            return None
        return Path(bpy.path.abspath(image.filepath, library=image.library))

    def read_picture(self, path: Path) -> Image:
        from ..scene.picture import read_picture

        return read_picture(path)

    def metres(self) -> float:
        import bpy

        from ..scene.layouts import metres_of

        return metres_of(bpy.context.scene)


def blender_if_there() -> Blender | None:
    """Blender, where this Python is Blender's or has the bpy module."""
    return Blender() if importlib.util.find_spec("bpy") is not None else None
