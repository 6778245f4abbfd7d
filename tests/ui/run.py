# SPDX-License-Identifier: GPL-3.0-or-later
"""The modal operator as a user meets it, from a first fill to a new file under a run."""

from __future__ import annotations

from collections.abc import Generator, Iterator

import bpy
import meander
from meander.scene import density, look
from meander.ui import density as density_panel
from meander.ui import panels
from stage import (
    COARSE,
    FINE,
    RESULT,
    SURFACE,
    assert_no_timer,
    assert_nothing_left_over,
    build_scene,
    changed_share,
    choose_spacing,
    ended,
    grown_to,
    key,
    look_at_surface,
    point_count,
    press_run,
    redrawn,
    seen,
    show_panel,
    shown_points,
    state,
    status_texts,
    step,
    undo,
    until,
    window_override,
)

OPEN = (panels.MEANDER_PT_guidance, density_panel.MEANDER_PT_density)
SMOOTHED = True


def window_opens() -> Iterator[float]:
    build_scene()
    # Inside out, as many meshes are: what grows has to be seen all the same.
    bpy.data.objects[SURFACE].data.flip_normals()
    look_at_surface()
    yield from show_panel()


def shaped_ramp() -> Iterator[float]:
    step("a curve shapes the ramp")
    settings = bpy.context.view_layer.objects.active.meander
    settings.density_group = bpy.context.active_object.vertex_groups.new(name="Fine").name
    settings.density_interpolation = "FREE"
    mapping = density.node_of(settings.density_ramp).mapping
    mapping.curves[0].points.new(0.35, 0.8)
    mapping.update()
    yield from seen("1_ramp")
    settings.density_interpolation = "TONE"
    yield from seen("1_tone")
    settings.density_interpolation, settings.density_group = "LINEAR", ""
    yield from seen("1_plain")


def growing() -> Generator[float, None, dict]:
    step("the curve grows on screen")
    before = state()
    press_run()
    yield from until(lambda: shown_points() > 0, "a first curve")
    counts = [shown_points()]
    while len(counts) < 3:
        yield from until(grown_to(counts[-1] + 1), f"more points than {counts}")
        counts.append(shown_points())
    assert counts == sorted(set(counts)), counts
    # Grown enough for a picture worth looking at.
    yield from until(grown_to(9000), "half of it")
    yield from seen("2_running")
    changed = changed_share("1_plain", "2_running")
    assert changed > 0.02, f"only {changed:.1%} of the view has changed"
    assert not ended(), "the run ended before it could be cancelled"
    assert status_texts[-1] and "Esc" in status_texts[-1], status_texts[-1:]
    assert state() == before, "a growing curve is drawn, but is no object"
    return before


def esc(before: dict) -> Iterator[float]:
    step("Esc restores the scene")
    key("ESC")
    yield from until(ended, "the end after Esc")
    assert state() == before
    assert_nothing_left_over()
    yield from assert_no_timer()


def run_to_the_end() -> Generator[float, None, dict]:
    step("a run to the end")
    choose_spacing(COARSE)
    before = state()
    press_run()
    yield from until(ended, "the end of the run")
    yield from seen("3_done")
    assert_nothing_left_over()
    result = bpy.data.objects[RESULT]
    assert bpy.context.view_layer.objects.active == result
    assert result.meander.surface.name == SURFACE
    assert look.radius_of(result) > 0.0
    assert result.meander.figures.stop_reason == "converged", result.meander.figures.stop_reason
    assert all(spline.use_cyclic_u for spline in result.data.splines)
    drawn = f"{result.name} Round"  # what its look draws
    assert set(bpy.data.curves.keys()) == {result.data.name, drawn}
    yield from assert_no_timer()
    return before


def esc_of_a_continued_run() -> Iterator[float]:
    step("Esc gives a continued result its splines back")
    bpy.data.objects[RESULT].meander.spacing = FINE
    before_continued = state()
    press_run()
    yield from until(lambda: shown_points() > 0, "a first curve")
    yield from seen("4_continued")
    assert state() == before_continued, "a result keeps its splines until it has new ones"
    key("ESC")
    yield from until(ended, "the end after Esc")
    assert state() == before_continued
    assert_nothing_left_over()


def undo_of_a_run(before: dict) -> Iterator[float]:
    step("Ctrl-Z takes the curve away again")
    yield from undo()
    yield from until(lambda: state() == before, f"{before} again")


def enter() -> Iterator[float]:
    step("Enter stops and keeps")
    choose_spacing(FINE)
    press_run()
    yield from until(grown_to(50), "some points")
    key("RET")
    yield from until(ended, "the end after Enter")
    assert_nothing_left_over()
    assert bpy.data.objects[RESULT].meander.figures.stop_reason == "cancelled"
    assert point_count() >= 50


def start_over_and_stop() -> Iterator[float]:
    step("Fill Again, and the Stop button")
    press_run(restart=True)
    yield from seen("4_start_over")
    with bpy.context.temp_override(**window_override()):
        bpy.ops.meander.stop()
    yield from until(ended, "the end after Stop")
    assert_nothing_left_over()


def surface_deleted() -> Iterator[float]:
    step("the surface is deleted under the run")
    bpy.context.view_layer.objects.active = bpy.data.objects[SURFACE]
    press_run()
    yield from until(lambda: shown_points() > 0, "a first curve")
    bpy.data.objects.remove(bpy.data.objects[SURFACE])
    yield from until(ended, "the end after the deletion")
    assert_nothing_left_over()
    assert f"{RESULT}.001" not in bpy.data.objects


def unregistering() -> Iterator[float]:
    step("unregistering ends a run")
    build_scene()
    press_run()
    yield from until(lambda: shown_points() > 0, "a first curve")
    meander.unregister()
    assert_nothing_left_over()
    yield from redrawn()
    meander.register()


def new_file() -> Iterator[float]:
    step("a new file ends a run")
    press_run()
    yield from until(lambda: shown_points() > 0, "a first curve")
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.ops.wm.read_homefile(use_factory_startup=True, load_ui=False)
    yield from redrawn()
    assert_nothing_left_over()
    assert not bpy.data.curves


def story() -> Iterator[float]:
    yield from window_opens()
    yield from shaped_ramp()
    before = yield from growing()
    yield from esc(before)
    before = yield from run_to_the_end()
    yield from esc_of_a_continued_run()
    yield from undo_of_a_run(before)
    yield from enter()
    yield from start_over_and_stop()
    yield from surface_deleted()
    yield from unregistering()
    yield from new_file()
