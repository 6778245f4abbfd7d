# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: what showing the curve costs the solver, and how long a result takes to write.

    xvfb-run -a -s "-screen 0 1280x800x24 -nolisten tcp" \
      blender --factory-startup --window-geometry 0 0 1280 800 \
      --python-exit-code 1 --python scripts/bench_blender.py -- [--repeat N] [--threads T]

Prints JSON objects, one a line:

    bare      redraws of the 3D view for a second that Blender reaches in this window while nothing
              of ours is there and nothing else is done, and seconds of all processors for each;
              `smooth` with Blender's smoothing of edges, `plain` without
    watched   medians of the same run in one go and in the modal operator: `solver_speed`, ratio of
              the seconds of the iterations alone; `speed`, ratio of the seconds until the window
              knows of the end (1: showing costs nothing); `finishing`, seconds from there to the
              finished result; `cpu_alone` and `cpu_watched`, seconds of all processors until the
              end is known; redraws of the 3D view, of the sidebar beside it, and copies of the
              curve shown, for a second
    write     seconds to write a curve of 200,000 points into a curve object

Set LIBGL_ALWAYS_SOFTWARE=1 where there is no graphics card; the drawing then takes processors away
from the solver, which a card would not.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import sys
import time
import traceback
from collections.abc import Iterator
from pathlib import Path

import bpy
import gpu
import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, os.environ.get("MEANDER_ADDON_PARENT", str(ROOT / "addon")))

import meander  # noqa: E402
from meander import blender_data, core, session  # noqa: E402

# Fine enough for 30,000 points; converges before the limit.
SPACING, ITERATIONS = 0.04, 400
POINTS, STRANDS = 200_000, 20

BARE_REDRAWS = 12

redraws = 0
panel_redraws = 0
shown = 0
known = known_processors = 0.0


def count_redraw() -> None:
    global redraws
    redraws += 1


def count_panel_redraw() -> None:
    global panel_redraws
    panel_redraws += 1


def note_end(original):
    def keep(self, context):
        global known, known_processors
        known, known_processors = time.perf_counter(), time.process_time()
        return original(self, context)

    return keep


def count_shown(original):
    def show(self, polylines) -> None:
        global shown
        shown += 1
        original(self, polylines)

    return show


def build_scene() -> bpy.types.Object:
    for thing in list(bpy.data.objects):
        if thing.type == "MESH":
            bpy.data.objects.remove(thing)
    bpy.ops.mesh.primitive_monkey_add(size=2.0)
    suzanne = bpy.context.active_object
    suzanne.modifiers.new("Subdivision", "SUBSURF").levels = 2
    suzanne.meander.spacing = SPACING
    suzanne.meander.threads = given.threads
    suzanne.meander.iteration_limit = ITERATIONS
    return suzanne


def view_override() -> dict:
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return {"window": window, "area": area, "region": region}


def in_one_go() -> tuple[float, float, float, int]:
    with bpy.context.temp_override(**view_override()):
        plan = session.plan_run(bpy.context)
    stepper = session.Stepper(plan.problem)
    begin, begin_processors = time.perf_counter(), time.process_time()
    stepper.run()
    seconds = time.perf_counter() - begin
    processors = time.process_time() - begin_processors
    figures = stepper.result()[1]
    return seconds, processors, figures["seconds_total"], figures["iterations"]


def watched() -> Iterator[float]:
    """Runs the operator; leaves its seconds, iterations, redraws and pictures in `last`."""
    global redraws, panel_redraws, shown
    with bpy.context.temp_override(**view_override()):
        redraws = panel_redraws = shown = 0
        begin, begin_processors = time.perf_counter(), time.process_time()
        outcome = bpy.ops.meander.run("INVOKE_DEFAULT")
    assert outcome == {"RUNNING_MODAL"}, outcome
    while session.current() is not None:
        yield 0.05
    last.update(
        seconds=known - begin,
        processors=known_processors - begin_processors,
        finishing=time.perf_counter() - known,
        redraws=redraws,
        panel_redraws=panel_redraws,
        shown=shown,
    )
    result = bpy.context.view_layer.objects.active
    figures = result.meander.figures
    last.update(iterations=figures.iterations, solver=figures.seconds)
    bpy.data.objects.remove(result)


last: dict = {}


def write_seconds(surface: bpy.types.Object) -> float:
    angles = np.linspace(0.0, 200.0, POINTS)
    positions = np.stack([np.cos(angles), np.sin(angles), angles / 200.0], axis=1)
    polylines = core.Polylines(
        positions=positions,
        normals=np.zeros_like(positions),
        offsets=np.linspace(0, POINTS, STRANDS + 1).astype(np.uint32),
        closed=np.ones(STRANDS, dtype=bool),
    )
    begin = time.perf_counter()
    curve = blender_data.write_curve(polylines, surface, "Bench")
    bpy.context.view_layer.update()
    seconds = time.perf_counter() - begin
    assert sum(len(spline.points) for spline in curve.data.splines) == POINTS
    bpy.data.objects.remove(curve)
    return seconds


def bare_rate() -> dict[str, float]:
    """Redraws for a second, and what each costs, while nothing but Blender's own is drawn."""
    with bpy.context.temp_override(**view_override()):
        bpy.ops.wm.redraw_timer(type="DRAW_SWAP", iterations=1)
        begin, begin_processors = time.perf_counter(), time.process_time()
        for _ in range(BARE_REDRAWS):
            view_override()["region"].tag_redraw()
            bpy.ops.wm.redraw_timer(type="DRAW_SWAP", iterations=1)
        seconds = time.perf_counter() - begin
        processors = time.process_time() - begin_processors
    return {
        "redraws_per_second": round(BARE_REDRAWS / seconds, 1),
        "cpu_seconds": round(processors / BARE_REDRAWS, 4),
    }


def bare() -> None:
    system = bpy.context.preferences.system
    before = system.viewport_aa
    smooth = bare_rate()
    system.viewport_aa = "OFF"
    plain = bare_rate()
    system.viewport_aa = before
    window = bpy.context.window_manager.windows[0]
    row = {"row": "bare", "width": window.width, "height": window.height}
    row["renderer"] = gpu.platform.renderer_get()
    print(json.dumps({**row, "smooth": smooth, "plain": plain}), flush=True)


def story() -> Iterator[float]:
    yield 1.0
    surface = build_scene()
    view_override()["area"].spaces.active.show_region_ui = True
    yield 0.5
    bare()
    writes = [write_seconds(surface) for _ in range(5)]
    print(json.dumps({"row": "write", "points": POINTS, "strands": STRANDS,
                      "seconds": round(statistics.median(writes), 4),
                      "all_seconds": [round(s, 4) for s in writes]}), flush=True)
    yield from watched()  # the first drawing compiles its programs
    cpu_alone, cpu_watched, finishing = [], [], []
    alone, seen, solver, rates, panels, pictures = [], [], [], [], [], []
    for _ in range(given.repeat):
        bpy.context.view_layer.objects.active = surface
        seconds, processors, solver_seconds, iterations = in_one_go()
        alone.append(seconds)
        cpu_alone.append(processors)
        yield from watched()
        assert last["iterations"] == iterations, (last, iterations)
        seen.append(last["seconds"])
        cpu_watched.append(last["processors"])
        finishing.append(last["finishing"])
        solver.append(solver_seconds / last["solver"])
        rates.append(last["redraws"] / last["seconds"])
        panels.append(last["panel_redraws"] / last["seconds"])
        pictures.append(last["shown"] / last["seconds"])
    print(json.dumps({"row": "watched", "threads": given.threads, "iterations": iterations,
                      "seconds_alone": round(statistics.median(alone), 3),
                      "seconds_watched": round(statistics.median(seen), 3),
                      "speed": round(statistics.median(a / s for a, s in zip(alone, seen)), 3),
                      "solver_speed": round(statistics.median(solver), 3),
                      "finishing": round(statistics.median(finishing), 3),
                      "cpu_alone": round(statistics.median(cpu_alone), 3),
                      "cpu_watched": round(statistics.median(cpu_watched), 3),
                      "redraws_per_second": round(statistics.median(rates), 1),
                      "panel_redraws_per_second": round(statistics.median(panels), 1),
                      "shown_per_second": round(statistics.median(pictures), 1)}), flush=True)


def tell() -> float | None:
    try:
        return next(telling)
    except StopIteration:
        sys.stdout.flush()
        os._exit(0)
    except BaseException:
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(7)


parser = argparse.ArgumentParser()
parser.add_argument("--repeat", type=int, default=3)
parser.add_argument("--threads", type=int, default=0, help="of the solver; 0: all")
given = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
bpy.context.preferences.view.show_splash = False
meander.register()
session.Session._show = count_shown(session.Session._show)
session.Session.keep = note_end(session.Session.keep)
bpy.types.SpaceView3D.draw_handler_add(count_redraw, (), "WINDOW", "POST_VIEW")
bpy.types.SpaceView3D.draw_handler_add(count_panel_redraw, (), "UI", "POST_PIXEL")
telling = story()
bpy.app.timers.register(tell, first_interval=0.5, persistent=True)
