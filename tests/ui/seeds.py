# SPDX-License-Identifier: GPL-3.0-or-later
"""A seed is drawn with the mouse, looked at, undone and filled."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
from meander.run import seeds, session
from meander.ui import drawing as seed_drawing
from stage import (
    changed_share,
    choose_spacing,
    coloured,
    ended,
    key,
    look_at_surface,
    press_run,
    redrawn,
    seen,
    show_panel,
    status_texts,
    step,
    until,
    window_override,
)


def view_center() -> tuple[int, int]:
    area = window_override()["area"]
    region = next(region for region in area.regions if region.type == "WINDOW")
    return region.x + (region.width - window_override()["region"].width) // 2, (
        region.y + region.height // 2
    )


def drag(begin: tuple[int, int], end: tuple[int, int]) -> Iterator[float]:
    """One stroke with the left button."""
    window = bpy.context.window_manager.windows[0]
    places = [
        (
            round(begin[0] + (end[0] - begin[0]) * i / 6),
            round(begin[1] + (end[1] - begin[1]) * i / 6),
        )
        for i in range(7)
    ]
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=places[0][0], y=places[0][1])
    yield 0.1
    window.event_simulate(type="LEFTMOUSE", value="PRESS", x=places[0][0], y=places[0][1])
    yield 0.05
    for x, y in places:
        window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
        yield 0.02
    window.event_simulate(type="LEFTMOUSE", value="RELEASE", x=places[-1][0], y=places[-1][1])
    yield 0.1


def press(operator: str, **options: object) -> set[str]:
    with bpy.context.temp_override(**window_override()):
        return getattr(bpy.ops.meander, operator)("INVOKE_DEFAULT", True, **options)


def tool() -> str | None:
    found = bpy.context.workspace.tools.from_space_view3d_mode("EDIT_CURVE", create=False)
    return None if found is None else found.idname


def drawing_panel_says() -> str:
    return seed_drawing.drawn.current.problem


def surface() -> bpy.types.Object:
    return bpy.data.objects["Sphere"]


def window_opens() -> Iterator[float]:
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16)
    bpy.ops.object.shade_smooth()
    choose_spacing(0.35)
    look_at_surface()
    yield from show_panel()


def drawing() -> Iterator[float]:
    step("a seed is drawn on the surface")
    paint = bpy.context.scene.tool_settings.curve_paint_settings
    paint.depth_mode, paint.surface_offset = "CURSOR", 0.5
    assert press("draw_seed") == {"FINISHED"}
    curve = surface().meander.seed
    assert bpy.context.view_layer.objects.active == curve and curve.mode == "EDIT"
    assert tool() == "builtin.draw" and paint.depth_mode == "SURFACE"
    yield from seen("seeds_1_drawing")
    x, y = view_center()
    yield from drag((x - 70, y - 40), (x + 70, y - 40))
    yield from drag((x - 70, y + 40), (x + 70, y + 40))
    yield from until(lambda: len(curve.data.splines) == 2, "two strokes")
    yield from until(lambda: seeds.is_shown(surface()), "the strokes on the surface")
    yield from seen("seeds_2_drawn")
    # A line as wide as the preview's is on all of both strokes.
    assert coloured("seeds_2_drawn", (1.0, 0.5, 0.05)) > 2 * 120 * seeds.WIDTH / 2
    step("a stroke that crosses another is said to, and undone")
    yield from drag((x, y - 90), (x, y + 90))
    yield from until(lambda: "cross" in drawing_panel_says(), "the refusal")
    yield from seen("seeds_2_crossing")
    key("Z", view_center(), ctrl=True)
    yield from until(lambda: len(curve.data.splines) == 2, "the stroke undone")
    yield from until(lambda: seeds.is_shown(surface()), "the strokes on the surface")
    assert not drawing_panel_says()
    assert status_texts[-1] is not None and "Draw on the surface" in status_texts[-1]
    assert press("end_seed") == {"FINISHED"}
    yield from redrawn()
    assert bpy.context.view_layer.objects.active == surface() and surface().mode == "OBJECT"
    assert (paint.depth_mode, round(paint.surface_offset, 3)) == ("CURSOR", 0.5)
    assert tool() != "builtin.draw" and status_texts[-1] is None
    points = [point.co for spline in curve.data.splines for point in spline.bezier_points]
    assert points and all(abs(point.length - 1.0) < 0.06 for point in points), points


def previewing() -> Iterator[float]:
    step("what a run would start from is shown, and hidden when it changes")
    assert seeds.is_shown(surface()), "the strokes are still shown"
    press("preview_seed")
    assert not seeds.is_shown(surface())
    yield from seen("seeds_3_before")
    assert press("preview_seed") == {"FINISHED"}
    assert seeds.is_shown(surface())
    yield from seen("seeds_4_preview")
    share = changed_share("seeds_3_before", "seeds_4_preview")
    assert share > 0.0005, share
    surface().meander.spacing = 0.3
    yield from until(lambda: not seeds.is_shown(surface()), "the stale preview hidden")
    yield from seen("seeds_5_stale")
    assert changed_share("seeds_3_before", "seeds_5_stale") < share / 4
    press("preview_seed")
    assert seeds.is_shown(surface())


def filling() -> Iterator[float]:
    step("the drawn strands are filled from, and the preview goes")
    press_run()
    assert not seeds.is_shown(surface())
    yield from until(ended, "the end of the run")
    result = bpy.data.objects["Sphere Seed Meander"]
    assert [spline.use_cyclic_u for spline in result.data.splines] == [False, False]
    yield from seen("seeds_6_filled")
    assert session.current() is None


def leaving_by_tab() -> Iterator[float]:
    step("leaving by Tab is End Drawing: it gives everything back, the seed that there was too")
    bpy.context.view_layer.objects.active = surface()
    seed = surface().meander.seed.name
    bpy.ops.ed.undo_push(message="Surface")
    press("draw_seed")
    yield from redrawn()
    assert tool() == "builtin.draw"
    key("TAB", view_center())
    yield from until(lambda: bpy.context.mode == "OBJECT", "Object Mode")
    yield from until(lambda: status_texts[-1] is None, "the status bar given back")
    paint = bpy.context.scene.tool_settings.curve_paint_settings
    assert (paint.depth_mode, round(paint.surface_offset, 3)) == ("CURSOR", 0.5)
    yield from until(lambda: bpy.context.view_layer.objects.active == surface(), "the surface")
    assert surface().select_get()
    assert surface().meander.seed.name == seed, "nothing was drawn"
    things = bpy.context.scene.objects
    assert sum(thing.name.startswith("Sphere Seed") for thing in things) == 2
    with bpy.context.temp_override(**window_override()):
        bpy.context.view_layer.objects.active = surface().meander.seed
        bpy.ops.object.mode_set(mode="EDIT")
        yield from redrawn()
        assert tool() != "builtin.draw", "the tool is still borrowed"
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.context.view_layer.objects.active = surface()
    for redo in (False, False, True, True):
        yield from undone(redo)
    assert surface().meander.seed.name == seed
    things = bpy.context.scene.objects
    assert sum(thing.name.startswith("Sphere Seed") for thing in things) == 2


def undone(redo: bool) -> Iterator[float]:
    (bpy.ops.ed.redo if redo else bpy.ops.ed.undo)()
    yield 0.05


def edges_and_undo() -> Iterator[float]:
    step("a seed of edges is undone in one step")
    bpy.context.view_layer.objects.active = surface()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.ed.undo_push(message="Edit Mode")
    with bpy.context.temp_override(**window_override()):
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.object.mode_set(mode="OBJECT")
        for edge in surface().data.edges:
            edge.select = all(abs(surface().data.vertices[i].co.z) < 1e-6 for i in edge.vertices)
        bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.ed.undo_push(message="Select")
    before = sorted(bpy.data.objects.keys())
    yield from seen("seeds_7_edit_mode")
    assert press("seed_from_edges") == {"FINISHED"}
    yield from redrawn()
    assert len(bpy.data.objects) == len(before) + 1
    assert surface().meander.seed.data.splines[0].use_cyclic_u
    key("Z", view_center(), ctrl=True)
    yield from until(lambda: sorted(bpy.data.objects.keys()) == before, "the undone seed")
    yield from redrawn()
    assert surface().mode == "EDIT"


def story() -> Iterator[float]:
    yield from window_opens()
    yield from drawing()
    yield from previewing()
    yield from filling()
    yield from leaving_by_tab()
    yield from edges_and_undo()
