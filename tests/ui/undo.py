# SPDX-License-Identifier: GPL-3.0-or-later
"""A subdivided surface after undo and redo.

Without a window nothing is subdivided by the graphics card, and there is nothing to lose.
"""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import stage
from meander.scene.changes import shape_count
from meander.scene.meshes import surface_now, triangles_of
from stage import (
    COARSE,
    SURFACE,
    build_scene,
    choose_spacing,
    ended,
    press_run,
    redrawn,
    step,
    undo,
    until,
)

# Of which every one is an undo step.
SPACINGS = (0.3, 0.25, 0.2, 0.15, COARSE)


def surface() -> bpy.types.Object:
    return bpy.data.objects[SURFACE]


def face_count() -> int:
    return len(triangles_of(surface(), bpy.context.evaluated_depsgraph_get())[1])


def evaluate_unread() -> None:
    """Evaluates the surface anew: a mesh that was read before the undo stays whole by itself."""
    surface().update_tag(refresh={"DATA"})
    bpy.context.view_layer.update()


def settings_undone(whole: int) -> Iterator[float]:
    for spacing in SPACINGS:
        choose_spacing(spacing)
    yield from redrawn()
    for redo in (False, False, True, False):
        evaluate_unread()
        unchanged = shape_count(surface())
        yield from undo(redo)
        assert shape_count(surface()) == unchanged
        assert face_count() == whole, (redo, face_count(), whole)
    assert abs(surface().meander.spacing - SPACINGS[2]) < 0.01 * SPACINGS[2]


def shape_undone(whole: int) -> Iterator[float]:
    surface().modifiers[0].levels = surface().modifiers[0].render_levels = 1
    bpy.ops.ed.undo_push(message="Levels")
    yield from redrawn()
    assert 4 * face_count() == whole
    changed = shape_count(surface())
    yield from undo()
    assert face_count() == whole
    assert shape_count(surface()) > changed


def frame_after_undo(whole: int) -> Iterator[float]:
    counts = []

    def note(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
        counts.append(len(surface_now(surface(), depsgraph)[1]))

    choose_spacing(COARSE)
    choose_spacing(SPACINGS[0])
    yield from redrawn()
    evaluate_unread()
    yield from undo()
    bpy.app.handlers.frame_change_post.append(note)
    bpy.context.scene.frame_set(bpy.context.scene.frame_current + 1)
    bpy.app.handlers.frame_change_post.remove(note)
    assert counts == [whole], (counts, whole)


def run_after_undo(whole: int) -> Iterator[float]:
    choose_spacing(COARSE)
    choose_spacing(SPACINGS[0])
    yield from redrawn()
    evaluate_unread()
    yield from undo()
    press_run()
    assert len(stage.last_session.plan.problem.faces) == whole
    yield from until(ended, "the end of the run")


def story() -> Iterator[float]:
    build_scene(levels=2)
    yield from redrawn()
    whole = face_count()
    # At two levels; each makes as many faces of one as it has corners, three at least.
    assert whole > 2 * 12 * len(surface().data.polygons)
    step("settings that are undone leave a subdivided surface whole, and its shape the same")
    yield from settings_undone(whole)
    step("a shape that is undone is another one")
    yield from shape_undone(whole)
    step("a change of the frame after an undo finds the whole surface")
    yield from frame_after_undo(whole)
    step("so does a run")
    yield from run_after_undo(whole)
