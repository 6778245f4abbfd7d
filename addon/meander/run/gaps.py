# SPDX-License-Identifier: GPL-3.0-or-later
"""Rings over the 3D views around the places that a run has left empty.

They are drawn, not made: no object, no selection and no mode changes, and nothing of them is saved.
"""

from __future__ import annotations

import math

import bpy
import gpu
import numpy as np
from mathutils import Vector

from ..model.last_run import GAP_THAT_MATTERS
from ..scene.blender_versions import flat_shader
from ..scene.identity import Key
from ..scene.results import made_spacing
from ..scene.settings import surface_of
from ..scene.transforms import to_world, world_matrix
from . import session
from .lasting import Activity
from .window import redraw

_COLOR = (1.0, 0.2, 0.05)
# Of a ring behind something, so that one knows that it is there.
_HIDDEN = 0.3
_WIDTH = 2.5
# In spacings: where a run was ended early, a ring around all that is empty would say nothing.
_LARGEST_RING = 1.5
_CORNERS = 24
# To the right and upwards in a view.
_AXES = (Vector((1.0, 0.0, 0.0)), Vector((0.0, 1.0, 0.0)))


def places(result: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """The gaps of a result that matter: where, (n, 3), and how wide, (n,); in world units.

    Of very many gaps only the largest are kept with a result.
    """
    gaps = [gap for gap in result.meander.figures.gaps if gap.size > GAP_THAT_MATTERS]
    if not gaps:
        return np.empty((0, 3)), np.empty(0)
    centres = np.array([gap.position[:] for gap in gaps], dtype=np.float64)
    sizes = np.array([gap.size for gap in gaps], dtype=np.float64)
    return to_world(centres, world_matrix(result)), sizes * made_spacing(result) / 2.0


def rings(
    centres: np.ndarray, radii: np.ndarray, right: np.ndarray, up: np.ndarray
) -> np.ndarray:
    """Circles that face the viewer: pairs of points, (2 n k, 3).

    right, up   unit vectors of the view; a ring stands its radius in front of its place
    """
    angles = 2.0 * math.pi * np.arange(_CORNERS) / _CORNERS
    circle = np.cos(angles)[:, None] * right + np.sin(angles)[:, None] * up
    corners = circle[None] * radii[:, None, None] + (
        centres + radii[:, None] * np.cross(right, up)
    )[:, None]
    return np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 3)


class Marks:
    def __init__(self, result: bpy.types.Object) -> None:
        self._result = Key(result)
        self._handler = bpy.types.SpaceView3D.draw_handler_add(
            self._draw, (), "WINDOW", "POST_VIEW"
        )

    def are_of(self, result: bpy.types.Object) -> bool:
        return self._result.find() == result

    def remove(self) -> None:
        bpy.types.SpaceView3D.draw_handler_remove(self._handler, "WINDOW")
        redraw("WINDOW", "UI")

    def _draw(self) -> None:
        context = bpy.context
        result = self._result.find()
        if result is None or session.current() is not None or surface_of(result) is None:
            return
        if not result.visible_get(viewport=context.space_data):
            return
        centres, radii = places(result)
        if not len(centres):
            return
        rotation = context.region_data.view_rotation
        right, up = (np.array(rotation @ axis) for axis in _AXES)
        most = _LARGEST_RING * made_spacing(result)
        corners = rings(centres, np.minimum(radii, most), right, up).astype(np.float32)
        shader = gpu.shader.from_builtin(flat_shader())
        points = gpu.types.GPUVertBuf(shader.format_calc(), len(corners))
        points.attr_fill("pos", corners)
        batch = gpu.types.GPUBatch(type="LINES", buf=points)
        test, width = gpu.state.depth_test_get(), gpu.state.line_width_get()
        blend = gpu.state.blend_get()
        gpu.state.blend_set("ALPHA")
        gpu.state.line_width_set(_WIDTH)
        shader.bind()
        for depth_test, alpha in (("NONE", _HIDDEN), ("LESS_EQUAL", 1.0)):
            gpu.state.depth_test_set(depth_test)
            shader.uniform_float("color", (*_COLOR, alpha))
            batch.draw(shader)
        gpu.state.line_width_set(width)
        gpu.state.depth_test_set(test)
        gpu.state.blend_set(blend)


# Of one result at a time.
marks: Activity[Marks] = Activity(Marks.remove)


def show(result: bpy.types.Object) -> None:
    """Draws the rings of a result from now on, instead of another's."""
    marks.begin(Marks(result))
    redraw("WINDOW", "UI")


def hide() -> None:
    """Draws no more. May be called at any time."""
    marks.end()


def shown_of(result: bpy.types.Object) -> bool:
    """Whether the rings of this result are drawn."""
    return marks.current is not None and marks.current.are_of(result)
