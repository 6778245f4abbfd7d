# SPDX-License-Identifier: GPL-3.0-or-later
"""A curve that follows its settings and a brush."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
from meander.run import live, remade, session, suspended
from meander.ui import live as live_operator
from stage import (
    IN_VIEW,
    RESULT,
    SURFACE,
    activate,
    assert_nothing_left_over,
    choose_spacing,
    ended,
    key,
    picture,
    point_count,
    press_run,
    redrawn,
    seen,
    shown_points,
    splines_of,
    step,
    suzanne_in_view,
    undo,
    until,
    view_override,
    window_override,
)

# A run takes a second.
SPACING = 0.3


def choose(thing: bpy.types.Object, setting: str, value: object) -> None:
    """As the panel does: the value, and an undo step."""
    setattr(thing.meander, setting, value)
    bpy.ops.ed.undo_push(message=setting)


def looked() -> Iterator[float]:
    """Until the timer has noted what the settings ask for; no user is quicker."""
    live_operator._looked_at.clear()
    yield from until(lambda: bool(live_operator._looked_at), "the timer looks")


def follows() -> Iterator[float]:
    """Until a run has begun by itself and has come to its end."""
    yield from until(lambda: not ended(), "a live run begins")
    yield from until(ended, "the live run ends")


def brush(value: str, x: int, y: int) -> None:
    window = bpy.context.window_manager.windows[0]
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    if value != "NOTHING":
        window.event_simulate(type="LEFTMOUSE", value=value, x=x, y=y)


def weights() -> list[float]:
    group = bpy.data.objects[SURFACE].vertex_groups["Dense"].index
    return [
        element.weight
        for vertex in bpy.data.objects[SURFACE].data.vertices
        for element in vertex.groups
        if element.group == group
    ]


def after_a_run() -> Iterator[float]:
    step("a finished curve follows its spacing")
    yield from suzanne_in_view()
    suzanne = bpy.data.objects[SURFACE]
    suzanne.meander.live = True
    choose_spacing(SPACING)
    press_run()
    yield from until(ended, "the first run ends")
    first = splines_of(RESULT)
    result = activate(RESULT)
    yield from looked()
    choose(result, "spacing", 0.95 * SPACING)
    yield from follows()
    second = splines_of(RESULT)
    assert second != first
    assert abs(suzanne.meander.spacing - 0.95 * SPACING) < 1e-6
    yield from seen("live_after")

    step("what is undone is not done again")
    yield from undo()
    assert splines_of(RESULT) == first
    yield 0.4
    assert ended()
    assert splines_of(RESULT) == first
    yield from undo(redo=True)
    yield 0.4
    assert ended()
    assert splines_of(RESULT) == second

    step("a change and the curve that followed it are one step of undo, and of redo")
    for redo in (False, True, False, True):
        yield from undo(redo)
        wanted, spacing = (second, 0.95 * SPACING) if redo else (first, SPACING)
        yield 0.3
        assert ended() and splines_of(RESULT) == wanted
        for name in (SURFACE, RESULT):
            assert abs(bpy.data.objects[name].meander.spacing - spacing) < 1e-6, (name, redo)
    step("what stands between them is a step of its own")
    bpy.data.objects[RESULT].location.x += 1.0
    bpy.ops.ed.undo_push(message="Move")
    yield from undo()
    yield 0.3
    assert splines_of(RESULT) == second and abs(bpy.data.objects[RESULT].location.x) < 1e-6
    assert abs(bpy.data.objects[SURFACE].meander.spacing - 0.95 * SPACING) < 1e-6

    step("what was made of the curve follows once it rests, in the same step of undo")
    with bpy.context.temp_override(**window_override()):
        assert bpy.ops.meander.two_tone(hide=False) == {"FINISHED"}
    made = bpy.context.view_layer.objects.active.name
    bpy.ops.ed.undo_push(message="Two-Tone")
    result = activate(RESULT)
    bpy.ops.ed.undo_push(message="Select")

    def corners() -> int:
        return len(bpy.data.objects[made].data.vertices)

    before = corners()
    yield from looked()
    choose(result, "spacing", 0.85 * SPACING)
    yield from until(lambda: ended() and splines_of(RESULT) != second, "the curve follows")
    closer = splines_of(RESULT)
    yield from until(lambda: corners() != before, "the two-tone follows")
    after = corners()
    assert remade.is_due(bpy.data.objects[RESULT]) is False
    for redo in (False, True, False):
        yield from undo(redo)
        yield 0.3
        wanted = (closer, after) if redo else (second, before)
        assert (splines_of(RESULT), corners()) == wanted, redo
    with bpy.context.temp_override(**window_override()):
        bpy.data.objects.remove(bpy.data.objects[made])
    bpy.ops.ed.undo_push(message="Delete")

    step("Esc takes the last wish back, and the curve keeps what it was")
    activate(SURFACE)
    yield from looked()
    choose(bpy.data.objects[SURFACE], "spacing", 0.04)
    yield from until(lambda: not ended(), "a live run begins")
    yield from until(lambda: shown_points() > 0, "it shows a curve")
    picture("live_during")
    key("ESC")
    yield from until(ended, "Esc ends it")
    assert splines_of(RESULT) == second
    yield 0.4
    assert ended()
    suspended.kept.end()


def in_a_second_window() -> Iterator[float]:
    step("a curve follows its settings in a second window, which shows another scene")
    windows = bpy.context.window_manager.windows
    first = set(windows)
    with bpy.context.temp_override(**window_override()):
        bpy.ops.wm.window_new_main()
    second = next(window for window in windows if window not in first)
    home = windows[0].scene
    with bpy.context.temp_override(window=second):
        bpy.ops.scene.new(type="NEW")
    yield from redrawn()
    view = next(area for area in second.screen.areas if area.type == "VIEW_3D")
    with bpy.context.temp_override(window=second, area=view):
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, radius=1.0)
        ball = bpy.context.view_layer.objects.active
        ball.meander.spacing, ball.meander.live = SPACING, True
        assert bpy.ops.meander.run() == {"FINISHED"}
    result = ball.meander.last_result
    assert second.scene != home and result.users_scene[:] == (second.scene,)
    yield from looked()
    before = splines_of(result.name)
    choose(result, "spacing", 0.9 * SPACING)
    yield from follows()
    assert splines_of(result.name) != before
    assert result.users_scene[:] == (second.scene,)
    other = second.scene
    with bpy.context.temp_override(window=second):
        bpy.ops.wm.window_close()
    bpy.data.scenes.remove(other)
    yield from redrawn()


def while_painting() -> Iterator[float]:
    step("a curve follows the brush")
    suzanne = activate(SURFACE)
    group = suzanne.vertex_groups.new(name="Dense")
    group.add(range(len(suzanne.data.vertices)), 0.0, "REPLACE")
    suzanne.vertex_groups.active_index = group.index
    choose(suzanne, "live", False)
    yield from redrawn()
    for setting, value in (
        ("density_source", "GROUP"),
        ("density_group", "Dense"),
        ("spacing", SPACING),
        ("live", True),
    ):
        choose(suzanne, setting, value)
    press_run()
    yield from until(ended, "the run ends")
    yield from looked()
    even = splines_of(RESULT)
    with bpy.context.temp_override(**view_override()):
        bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
        settings = bpy.context.tool_settings
        if settings.weight_paint.brush is None:  # Debian 13's Blender comes without brushes
            own = bpy.data.brushes.new("Paint", mode="WEIGHT_PAINT")
            own.asset_mark()
            bpy.ops.brush.asset_activate(
                asset_library_type="LOCAL", relative_asset_identifier=f"Brush/{own.name}"
            )
    settings.unified_paint_settings.size = 60
    settings.unified_paint_settings.weight = 1.0
    yield from redrawn()
    before = point_count()
    x, y = IN_VIEW
    for lift in (0, 40):  # the second stroke often meets a run that is still going
        brush("PRESS", x - 60, y + lift)
        for k in range(5):
            brush("NOTHING", x - 60 + 30 * k, y + lift + 9 * k)
            yield 0.05
        assert max(weights()) > 0.0, "the brush has not painted"
        # The brush is still held.
        if not lift:
            yield from until(lambda: not ended(), "the curve takes the paint")
            yield from until(lambda: shown_points() > 0, "the curve is shown under the brush")
            picture("live_brush")
        brush("RELEASE", x + 60, y + lift + 36)
    yield from until(lambda: ended() and point_count() > before, "the painted curve is the result")
    yield 0.5
    yield from until(ended, "the last run ends")
    assert splines_of(RESULT) != even
    assert bpy.context.mode == "PAINT_WEIGHT"
    yield from seen("live_painted")


def story() -> Iterator[float]:
    yield from after_a_run()
    yield from in_a_second_window()
    yield from while_painting()
    step("Live off gives the flow back")
    choose(bpy.data.objects[SURFACE], "live", False)
    yield from until(lambda: live.finished.current is None, "the flow given back")
    assert session.current() is None
    assert_nothing_left_over()
