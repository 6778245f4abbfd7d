# SPDX-License-Identifier: GPL-3.0-or-later
"""Several meshes, Edit Mode and faults."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
from mathutils import Vector
from meander.run import notes, session
from stage import (
    activate,
    assert_nothing_left_over,
    ended,
    key,
    picture,
    press_run,
    redrawn,
    seen,
    show_panel,
    status_texts,
    step,
    undo,
    until,
    window_override,
)

# A run at the one comes to its end at once, at the other never: stage.options_of.
SOON, NEVER = 0.4, 0.05


def results() -> set[str]:
    return {thing.name for thing in bpy.data.objects if thing.type == "CURVE" and thing.users_scene}


def build() -> None:
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    for number, (name, spacing) in enumerate((("A", SOON), ("B", NEVER), ("C", SOON))):
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, location=(2.5 * number, 0, 0))
        sphere = bpy.context.active_object
        sphere.name, sphere.meander.spacing = name, spacing
    bpy.ops.ed.undo_push(message="Scene")


def several() -> Iterator[float]:
    step("several meshes are filled one after another; Esc leaves what is done")
    activate("A", "B", "C")
    press_run()
    assert session.current().place == "1 of 3"
    yield from until(lambda: not ended() and session.current().place == "2 of 3", "the second")
    assert results() == {"A Meander"}
    yield from until(lambda: any("2 of 3" in (text or "") for text in status_texts), "its text")
    picture("6_second_of_three")
    key("ESC")
    yield from until(ended, "the end by Esc")
    assert results() == {"A Meander"}
    yield from undo()
    assert not results()
    yield from undo(redo=True)
    assert results() == {"A Meander"}
    bpy.data.objects["B"].meander.spacing = SOON
    activate("B", "C")
    press_run()
    yield from until(ended, "both")
    assert results() == {"A Meander", "B Meander", "C Meander"}
    yield from undo()
    assert results() == {"A Meander", "B Meander"}, "each has an undo step of its own"
    assert_nothing_left_over()


def in_edit_mode() -> Iterator[float]:
    step("in Edit Mode the selected faces are filled; undo and redo lose nothing")
    activate("C")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_mode(type="FACE")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    for polygon in bpy.data.objects["C"].data.polygons:
        polygon.select = polygon.center.z > 0.0
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.ed.undo_push(message="Half")
    press_run()
    yield from until(ended, "the end in Edit Mode")
    assert bpy.context.mode == "EDIT_MESH" and "C Meander" in results()
    points = [p.co.z for s in bpy.data.objects["C Meander"].data.splines for p in s.points]
    assert min(points) > -0.05
    yield from seen("6_half_in_edit_mode")
    for _ in range(2):
        yield from undo()
    assert "C Meander" not in results()
    for _ in range(2):
        yield from undo(redo=True)
    assert "C Meander" in results()
    assert len([p for s in bpy.data.objects["C Meander"].data.splines for p in s.points]) == len(
        points
    )
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


def faults() -> Iterator[float]:
    step("faults that Strict refuses are said in the panel, selected and framed by Show")
    places = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1), (-1, -2, 0), (-1, -1, 0)]
    mesh = bpy.data.meshes.new("Torn")
    mesh.from_pydata(places, [], [(0, 1, 2), (0, 2, 3), (0, 2, 4), (1, 5, 6)])
    torn = bpy.data.objects.new("Torn", mesh)
    torn.location = (0.0, 30.0, 0.0)
    bpy.context.scene.collection.objects.link(torn)
    activate("Torn")
    torn.meander.spacing, torn.meander.strict = SOON, True
    with bpy.context.temp_override(**window_override()):
        bpy.ops.meander.run("INVOKE_DEFAULT")
    yield from until(ended, "the refusal")
    assert "1 place where more than two faces" in torn.meander.problem.sentence
    yield from seen("6_refused")
    with bpy.context.temp_override(**window_override()):
        assert bpy.ops.meander.select_problem() == {"FINISHED"}
    yield from redrawn()
    assert bpy.context.mode == "EDIT_MESH"
    assert [v.index for v in torn.data.vertices if v.select] == [0, 1, 2]
    view = window_override()["area"].spaces.active.region_3d
    yield from until(
        lambda: (view.view_location - Vector((0.5, 30.5, 0.0))).length < 0.5, "the faults in view"
    )
    yield from seen("6_shown")
    bpy.ops.object.mode_set(mode="OBJECT")
    torn.scale.x = 0.0
    bpy.context.view_layer.update()
    with bpy.context.temp_override(**window_override()):
        # As an error it would be raised here, and pop up under the cursor of who presses.
        assert bpy.ops.meander.run("INVOKE_DEFAULT") == {"CANCELLED"}
    assert "scaled to nothing" in notes.of(torn)
    notes.clear(torn)
    with bpy.context.temp_override(**window_override()):
        assert bpy.ops.meander.propose_spacing("INVOKE_DEFAULT") == {"CANCELLED"}
    assert "scaled to nothing" in notes.of(torn), "any button"
    yield from seen("6_note")
    torn.scale.x = 1.0
    bpy.context.view_layer.update()
    assert not notes.of(torn), "what it was said of has changed"
    torn.meander.strict = False
    press_run()
    yield from until(ended, "the repaired mesh")
    assert torn.meander.last_result.meander.figures.mended == 2
    assert not torn.meander.problem.sentence
    activate("Torn")
    yield from seen("6_repaired")
    assert_nothing_left_over()


def story() -> Iterator[float]:
    build()
    yield from show_panel()
    yield from several()
    yield from in_edit_mode()
    yield from faults()
