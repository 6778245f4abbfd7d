# SPDX-License-Identifier: GPL-3.0-or-later
"""What the views show of a run: the curve as it grows, and a box of a result that is continued.

The growing curve is no data of Blender's at all: evaluating an object for every picture took ten
times as long as handing its points to the graphics card. It is drawn where the surface is, and
moves along with it. A result that is continued keeps its own data; the views only draw less of it.
So whatever is saved, undone or ended meanwhile holds the whole result.
"""

from __future__ import annotations

from collections.abc import Callable

import bpy
import gpu
import numpy as np
from mathutils import Matrix, Vector

from .. import core
from ..scene.blender_versions import flat_shader
from ..scene.identity import Key
from .plan import Plan


def segments_of(polylines: core.Polylines, share: float = 1.0) -> np.ndarray:
    """The two points of every segment, int32 (n, 2), closing ones included.

    share   of every strand, from its first point on
    """
    begins = np.arange(len(polylines.positions), dtype=np.int32)
    ends = begins + 1
    offsets = np.asarray(polylines.offsets, dtype=np.int64)
    closed = np.asarray(polylines.closed, dtype=bool)
    lasts = offsets[1:] - 1
    ends[lasts] = offsets[:-1]
    kept = np.ones(len(begins), dtype=bool)
    kept[lasts[~closed]] = False
    if share < 1.0:
        counts = np.diff(offsets)
        kept &= begins - np.repeat(offsets[:-1], counts) < np.repeat(share * counts, counts)
    return np.stack([begins, ends], axis=1)[kept]


def _nearer(lift: float, depth: float, perspective: bool) -> Matrix:
    """In the space of a view: moves what lies at a depth towards the viewer, by `lift`.

    It stays in its place on screen, as all that comes nearer in proportion does in a perspective.
    """
    if not perspective:
        return Matrix.Translation((0.0, 0.0, lift))
    share = min(lift / depth, 0.1) if depth > 0.0 else 0.0
    return Matrix.Scale(1.0 - share, 4)


class GrowingCurve:
    """Lines over the views of a scene, from show() to remove().

    find         gives the surface, or None when it is gone
    find_scene   likewise
    matrix       world matrix of the surface when the curve was computed
    color        red, green, blue; None: that of curves that are not selected
    width        of the lines, in pixels
    """

    def __init__(
        self,
        find: Callable[[], bpy.types.Object | None],
        find_scene: Callable[[], bpy.types.Scene | None],
        matrix: np.ndarray,
        color: tuple[float, float, float] | None = None,
        width: float = 1.0,
    ) -> None:
        self._color, self._width = color, width
        self._find = find
        self._find_scene = find_scene
        self._inverse = Matrix(np.linalg.inv(matrix).tolist())
        self._positions = np.empty((0, 3), dtype=np.float32)
        self._segments = np.empty((0, 2), dtype=np.int32)
        self._lift, self._middle = 0.0, Vector()
        self._batch: gpu.types.GPUBatch | None = None  # made in a view, where there is a context
        self._handler = bpy.types.SpaceView3D.draw_handler_add(
            self._draw, (), "WINDOW", "POST_VIEW"
        )

    def show(self, polylines: core.Polylines, lift: float, share: float = 1.0) -> None:
        """Takes the curve to draw from now on, `lift` nearer to the viewer, in world units.

        Of every strand only this share is drawn, from its first point on.

        A line that lies in the surface flickers; a little in front of it, it is clear. It is not
        lifted along the normals: they point inwards where a mesh is inside out, and away from who
        looks at the back of a sheet. The views have to be redrawn by the caller.
        """
        self._positions = polylines.positions.astype(np.float32)
        self._lift = lift
        if len(self._positions):
            self._middle = Vector(self._positions.mean(axis=0).tolist())
        self._segments = segments_of(polylines, share)
        self._batch = None

    @property
    def point_count(self) -> int:
        """How many points the curve has that is shown."""
        return len(self._positions)

    def remove(self) -> None:
        """Draws no more. May be called more than once."""
        if self._handler is not None:
            bpy.types.SpaceView3D.draw_handler_remove(self._handler, "WINDOW")
        self._handler = self._batch = None

    def _draw(self) -> None:
        context = bpy.context
        surface = self._find()
        if surface is None or context.scene != self._find_scene() or not len(self._segments):
            return
        space = context.space_data
        if space is None or (space.local_view is not None and not surface.local_view_get(space)):
            return
        shader = gpu.shader.from_builtin(flat_shader())
        if self._batch is None:
            self._batch = self._new_batch(shader)
        color = self._color or context.preferences.themes[0].view_3d.wire
        test, width = gpu.state.depth_test_get(), gpu.state.line_width_get()
        gpu.state.depth_test_set("LESS_EQUAL")
        gpu.state.line_width_set(self._width)
        with gpu.matrix.push_pop():
            gpu.matrix.multiply_matrix(surface.matrix_world @ self._inverse)
            seen = gpu.matrix.get_model_view_matrix()
            depth = -(seen @ self._middle).z
            perspective = gpu.matrix.get_projection_matrix()[3][3] == 0.0
            gpu.matrix.load_matrix(_nearer(self._lift, depth, perspective) @ seen)
            shader.bind()
            shader.uniform_float("color", (*color[:3], 1.0))
            self._batch.draw(shader)
        gpu.state.line_width_set(width)
        gpu.state.depth_test_set(test)

    def _new_batch(self, shader: gpu.types.GPUShader) -> gpu.types.GPUBatch:
        points = gpu.types.GPUVertBuf(shader.format_calc(), len(self._positions))
        points.attr_fill("pos", self._positions)
        segments = gpu.types.GPUIndexBuf(type="LINES", seq=self._segments)
        return gpu.types.GPUBatch(type="LINES", buf=points, elem=segments)


# How far in front of the surface the preview is drawn, in spacings: on slopes too, where a pixel of
# the line lies beside the line.
PREVIEW_LIFT = 0.15


class Preview:
    """The growing curve in the views of one scene, from the first show() to end()."""

    def __init__(self, plan: Plan, scene: bpy.types.Scene) -> None:
        self._plan = plan
        self._scene = Key(scene)
        self._growing: GrowingCurve | None = None

    @property
    def point_count(self) -> int:
        """How many points the curve has that the views show."""
        return self._growing.point_count if self._growing is not None else 0

    def show(self, polylines: core.Polylines, share: float = 1.0) -> None:
        """Takes the curve to show from now on, or the first share of every strand.

        The caller has the views redrawn.
        """
        plan = self._plan
        if self._growing is None:
            self._growing = GrowingCurve(plan.surface.find, self._scene.find, plan.matrix)
        self._growing.show(polylines, PREVIEW_LIFT * plan.spacing, share)
        self.keep_result_out()

    def keep_result_out(self) -> None:
        """Draws a result that is continued as a box, as soon as there is a curve to see instead.

        To be called at every tick: what is evaluated again meanwhile would be drawn in full.
        """
        if self._growing is not None:
            self._draw_result(as_box=True)

    def _draw_result(self, as_box: bool) -> None:
        result = self._plan.result.find() if self._plan.result else None
        scene = self._scene.find()
        if result is not None and scene is not None:
            # In Edit Mode the user sees what he edits.
            draw_as_box(result, as_box and result.mode == "OBJECT", scene)

    def end(self) -> None:
        """Draws no more, but the result in full. May be called more than once."""
        if self._growing is None:
            return
        self._growing.remove()
        self._growing = None
        self._draw_result(as_box=False)


def draw_as_box(object: bpy.types.Object, box: bool, scene: bpy.types.Scene) -> None:
    """Lets the views of a scene draw an object as a box of its size, or as it is.

    Only the evaluated copy that the dependency graph draws is told so. The object itself stays as
    it is, so that no undo step, file, autosave or crash can keep it from being seen; at worst it is
    drawn in full, when the graph makes a new copy. The kind of display alone is never taken over
    from the copy: hiding it would deselect the object.
    """
    wanted = "BOUNDS" if box else object.display_type
    for layer in scene.view_layers:
        if layer.depsgraph is None:  # no window shows it
            continue
        evaluated = object.evaluated_get(layer.depsgraph)
        # An object that the graph does not have is its own copy.
        if evaluated.is_evaluated and evaluated.display_type != wanted:
            evaluated.display_type = wanted
