# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: the modal operator as a user meets it, with a window, real keys and clicks.

    LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1280x800x24 -nolisten tcp" \
      blender --factory-startup --enable-event-simulate --window-geometry 0 0 1280 800 \
      --python-exit-code 1 --python tests/ui/run.py

The others beside it are started in the same way.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Generator, Iterator
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
# Another add-on folder can be tried with the same story.
ADDONS = os.environ.get("MEANDER_ADDON_PARENT", str(HERE.parents[1] / "addon"))
sys.path[:0] = [str(HERE), str(HERE.parent), ADDONS]

import meander  # noqa: E402
from meander.scene import density, look  # noqa: E402
from stage import (  # noqa: E402
    COARSE,
    FINE,
    FINEST,
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
    picture,
    point_count,
    press_run,
    show_panel,
    shown_points,
    state,
    status_texts,
    step,
    tell,
    until,
    window_override,
)


def window_opens() -> Iterator[float]:
    yield 1.0
    build_scene()
    # Inside out, as many meshes are: what grows has to be seen all the same.
    bpy.data.objects[SURFACE].data.flip_normals()
    yield 0.5
    look_at_surface()
    yield from show_panel()
    yield 0.3
    picture("1_before")


def shaped_ramp() -> Iterator[float]:
    step("a curve shapes the ramp")
    settings = bpy.context.view_layer.objects.active.meander
    settings.density_group = bpy.context.active_object.vertex_groups.new(name="Fine").name
    settings.density_interpolation = "FREE"
    mapping = density.node_of(settings.density_ramp).mapping
    mapping.curves[0].points.new(0.35, 0.8)
    mapping.update()
    yield 0.5
    picture("1_ramp")
    settings.density_interpolation, settings.density_group = "LINEAR", ""
    yield 0.5
    picture("1_plain")


def growing() -> Generator[float, None, dict]:
    step("the curve grows on screen")
    choose_spacing(FINEST)
    before = state()
    press_run()
    yield from until(lambda: shown_points() > 0, "a first curve")
    counts = [shown_points()]
    while len(counts) < 3:
        yield from until(grown_to(counts[-1] + 1), f"more points than {counts}")
        counts.append(shown_points())
    assert counts == sorted(set(counts)), counts
    # Grown enough for a picture worth looking at.
    yield from until(grown_to(60000), "a third of it")
    yield 0.2
    picture("2_running")
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
    yield 0.5
    picture("3_done")
    assert_nothing_left_over()
    result = bpy.data.objects[RESULT]
    assert bpy.context.view_layer.objects.active == result
    assert result.meander.surface.name == SURFACE
    assert look.radius_of(result) > 0.0
    assert result.meander.figures.stop_reason == "converged", result.meander.figures.stop_reason
    assert all(spline.use_cyclic_u for spline in result.data.splines)
    assert set(bpy.data.curves.keys()) == {result.data.name}
    yield from assert_no_timer()
    return before


def esc_of_a_continued_run() -> Iterator[float]:
    step("Esc gives a continued result its splines back")
    bpy.data.objects[RESULT].meander.spacing = FINE
    before_continued = state()
    press_run()
    yield from until(lambda: shown_points() > 0, "a first curve")
    yield 0.3
    picture("4_continued")
    assert state() == before_continued, "a result keeps its splines until it has new ones"
    key("ESC")
    yield from until(ended, "the end after Esc")
    assert state() == before_continued
    assert_nothing_left_over()


def undo_of_a_run(before: dict) -> Iterator[float]:
    step("Ctrl-Z takes the curve away again")
    key("Z", ctrl=True)
    yield 0.7
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
    yield 0.5
    picture("4_start_over")
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
    yield 0.3
    meander.unregister()
    assert_nothing_left_over()
    yield 0.3
    meander.register()


def new_file() -> Iterator[float]:
    step("a new file ends a run")
    press_run()
    yield 0.3
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.ops.wm.read_homefile(use_factory_startup=True, load_ui=False)
    yield 0.5
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


tell(story())
