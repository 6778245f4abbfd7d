# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: what showing the curve costs the solver, and how long a result takes to write.

    xvfb-run -a -s "-screen 0 1280x800x24 -nolisten tcp" \
      blender --factory-startup --window-geometry 0 0 1280 800 \
      --python-exit-code 1 --python benchmarks/bench_blender.py -- \
      [--repeat N] [--threads T] [--nodes N ...] [--sidebar 0|1] [--maximised] [--only ROW ...]

Prints JSON objects, one a line. All of them have `width` and `height` of the window, `view_width`
and `view_height` of the 3D view, `sidebar`, `renderer` and `threads` of the solver. Seconds are
processor time where the key has `cpu` in it, and clock time elsewhere.

    bare      redraws of the 3D view a second that Blender reaches in this window with nothing of
              ours in it and nothing else to do, and seconds of all processors for each redraw;
              `main_cpu`, those of Blender's own thread. `smooth` with Blender's smoothing of edges,
              `plain` without
    picture   what one picture of a changed curve takes, in seconds of all processors:
              `bare_cpu`, a redraw without the curve; `still_cpu`, with the curve, unchanged, on
              top of it; `copy_cpu`, from the arrays of the solver to those of the view;
              `evaluate_cpu`, Blender's evaluation of the scene; `batch_cpu`, by how much drawing a
              changed curve takes longer than drawing an unchanged one. `our_cpu` is all but the
              bare redraw
    watched   medians of the same run in one go and in the modal operator: `solver_speed`, ratio of
              the seconds of the iterations alone; `speed`, ratio of the seconds until the window
              knows of the end (1: showing costs nothing); `finishing`, seconds from there to the
              finished result; `cpu_alone` and `cpu_watched`, seconds of all processors until the
              end is known; `main_cpu_share`, of Blender's own thread in each second of the run, and
              `tick_cpu_share` of it in the operator; redraws of the 3D view, of the sidebar beside
              it, and copies of the curve shown, per second; `all_others`, how many processors other
              programs kept busy in each pair of runs (Linux): where they did, clock times and
              their ratios say little
    write     seconds to write a curve of 200,000 points into a curve object

Where there is no graphics card, set LIBGL_ALWAYS_SOFTWARE=1; the drawing then takes processors away
from the solver, which a card would not. With GALLIUM_NOOP=1 as well, Mesa's driver takes every
command and draws nothing: the window stays black, and what remains is the work that Blender and
the add-on do on a processor before a card begins. Such rows have the renderer NOOP.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import sys
import time
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy
import gpu
import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, os.environ.get("MEANDER_ADDON_PARENT", str(ROOT / "addon")))
sys.path.append(str(ROOT / "benchmarks"))

import meander  # noqa: E402
from meander import core  # noqa: E402
from meander.run import session  # noqa: E402
from meander.run.plan import plan_run  # noqa: E402
from meander.run.preview import GrowingCurve, Preview  # noqa: E402
from meander.run.stepper import Stepper  # noqa: E402
from meander.scene import curve_writer, transforms  # noqa: E402
from moments import Moment, Tally  # noqa: E402

# The spacing that takes about this many nodes; the run converges before the limit.
SPACING, NODES, ITERATIONS = 0.04, 50_000, 400
POINTS, STRANDS = 200_000, 20
BARE_SECONDS, MOST_REDRAWS = 1.0, 200
ROWS = ("bare", "picture", "write", "watched")


tally = Tally()


def count_redraw() -> None:
    tally.redraws += 1


def count_panel_redraw() -> None:
    tally.panel_redraws += 1


def count_shown(original: Callable) -> Callable:
    def show(self: Preview, *arguments: Any) -> None:
        tally.shown += 1
        original(self, *arguments)

    return show


def measure_tick(original: Callable) -> Callable:
    def tick(self: session.Session, context: bpy.types.Context) -> bool:
        begin = time.thread_time()
        try:
            return original(self, context)
        finally:
            tally.ticks += 1
            tally.tick_cpu += time.thread_time() - begin

    return tick


def note_end(original: Callable) -> Callable:
    def keep(self: session.Session, context: bpy.types.Context) -> Any:
        tally.known = Moment()
        return original(self, context)

    return keep


def build_scene() -> bpy.types.Object:
    for thing in list(bpy.data.objects):
        if thing.type == "MESH":
            bpy.data.objects.remove(thing)
    bpy.ops.mesh.primitive_monkey_add(size=2.0)
    suzanne = bpy.context.active_object
    suzanne.modifiers.new("Subdivision", "SUBSURF").levels = 2
    suzanne.meander.threads = given.threads
    suzanne.meander.iteration_limit = ITERATIONS
    return suzanne


def view_override() -> dict:
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return {"window": window, "area": area, "region": region}


def say(row: str, **figures: Any) -> None:
    window, region = view_override()["window"], view_override()["region"]
    about = {
        "row": row,
        "width": window.width,
        "height": window.height,
        "view_width": region.width,
        "view_height": region.height,
        "sidebar": view_override()["area"].spaces.active.show_region_ui,
        "renderer": gpu.platform.renderer_get(),
        "threads": given.threads,
    }
    print(json.dumps({**about, **figures}), flush=True)


def redraw() -> None:
    """Draws the view and composes the window, at once."""
    view_override()["region"].tag_redraw()
    # The timer prints what it has measured as warnings, one line for each redraw.
    sys.stdout.flush()
    kept = os.dup(1)
    try:
        os.dup2(nowhere, 1)
        with bpy.context.temp_override(**view_override()):
            bpy.ops.wm.redraw_timer(type="DRAW_SWAP", iterations=1)
    finally:
        os.dup2(kept, 1)
        os.close(kept)


def repeated(work: Callable[[], None]) -> tuple[float, float, float]:
    """Seconds of the clock, of all processors and of this thread; means of calls in one second."""
    work()  # the first drawing compiles its programs
    begin = now = Moment()
    calls = 0
    while calls < MOST_REDRAWS and now.clock - begin.clock < BARE_SECONDS:
        work()
        calls += 1
        now = Moment()
    clock, cpu, main = now.since(begin)
    return clock / calls, cpu / calls, main / calls


def bare_figures() -> dict[str, float]:
    clock, cpu, main_cpu = repeated(redraw)
    return {
        "redraws_per_second": round(1.0 / clock, 1),
        "cpu_seconds": round(cpu, 5),
        "main_cpu": round(main_cpu, 5),
    }


def bare() -> None:
    """Redraws of nothing but Blender's own interface."""
    system = bpy.context.preferences.system
    before = system.viewport_aa
    smooth = bare_figures()
    system.viewport_aa = "OFF"
    plain = bare_figures()
    system.viewport_aa = before
    say("bare", smooth=smooth, plain=plain)


def picture(surface: bpy.types.Object, polylines: core.Polylines) -> None:
    """What a picture of these polylines takes, without smoothing, part by part."""
    system = bpy.context.preferences.system
    before = system.viewport_aa
    system.viewport_aa = "OFF"
    matrix = transforms.world_matrix(surface)
    bare_cpu = repeated(redraw)[1]
    curve = GrowingCurve(lambda: surface, bpy.context.scene.name, matrix)
    taken = {"copy_cpu": 0.0, "evaluate_cpu": 0.0, "draw_cpu": 0.0}
    moved = 0

    def measured(key: str, work: Callable, *arguments: Any) -> None:
        begin = time.process_time()
        work(*arguments)
        taken[key] += time.process_time() - begin

    def show() -> None:
        nonlocal moved
        moved += 1
        measured("copy_cpu", curve.show, polylines, 1e-3 * (moved % 10))
        measured("evaluate_cpu", bpy.context.view_layer.update)
        measured("draw_cpu", redraw)

    show()
    taken = dict.fromkeys(taken, 0.0)
    moved = 0
    repeated(show)
    parts = {key: seconds / moved for key, seconds in taken.items()}
    still = repeated(redraw)[1]
    curve.remove()
    system.viewport_aa = before
    parts["batch_cpu"] = parts.pop("draw_cpu") - still
    parts["still_cpu"] = still - bare_cpu
    say(
        "picture",
        points=len(polylines.positions),
        bare_cpu=round(bare_cpu, 5),
        our_cpu=round(sum(parts.values()), 5),
        **{key: round(seconds, 5) for key, seconds in parts.items()},
    )


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
    curve = curve_writer.write_curve(polylines, surface, "Bench")
    bpy.context.view_layer.update()
    seconds = time.perf_counter() - begin
    assert sum(len(spline.points) for spline in curve.data.splines) == POINTS
    bpy.data.objects.remove(curve)
    return seconds


def in_one_go() -> tuple[dict[str, float], core.Polylines]:
    with bpy.context.temp_override(**view_override()):
        plan = plan_run(bpy.context)
    stepper = Stepper(plan.problem)
    begin = Moment()
    stepper.run()
    end = Moment()
    clock, cpu, _main = end.since(begin)
    snapshot, figures, _reason = stepper.result()
    run = {"clock": clock, "cpu": cpu, "solver": figures["seconds_total"]}
    run["iterations"] = figures["iterations"]
    run["others"] = end.others_since(begin)
    return run, snapshot.polylines


def watched() -> Iterator[float]:
    """Runs the operator; leaves its figures in `last`."""
    global tally
    with bpy.context.temp_override(**view_override()):
        tally = Tally()
        outcome = bpy.ops.meander.run("INVOKE_DEFAULT")
    assert outcome == {"RUNNING_MODAL"}, outcome
    while session.current() is not None:
        yield 0.2
    finishing = time.perf_counter() - tally.known.clock
    clock, cpu, main_cpu = tally.known.since(tally.begin)
    result = bpy.context.view_layer.objects.active
    figures = result.meander.figures
    last.update(
        clock=clock,
        others=tally.known.others_since(tally.begin),
        cpu=cpu,
        finishing=finishing,
        main_cpu_share=main_cpu / clock,
        tick_cpu_share=tally.tick_cpu / clock,
        redraws_per_second=tally.redraws / clock,
        panel_redraws_per_second=tally.panel_redraws / clock,
        shown_per_second=tally.shown / clock,
        ticks_per_second=tally.ticks / clock,
        iterations=figures.iterations,
        nodes=figures.nodes,
        solver=figures.seconds,
    )
    bpy.data.objects.remove(result)


last: dict = {}


def compared(surface: bpy.types.Object) -> Iterator[float]:
    alone, seen = [], []
    for _ in range(given.repeat):
        bpy.context.view_layer.objects.active = surface
        run, polylines = in_one_go()
        yield from watched()
        assert last["iterations"] == run["iterations"], (last, run)
        alone.append(run)
        seen.append(dict(last))

    def median(runs: list[dict[str, float]], key: str, digits: int = 3) -> float:
        return round(statistics.median(run[key] for run in runs), digits)

    def ratio(key: str) -> list[float]:
        return [round(one[key] / other[key], 3) for one, other in zip(alone, seen)]

    say(
        "watched",
        nodes=last["nodes"],
        points=len(polylines.positions),
        iterations=last["iterations"],
        seconds_alone=median(alone, "clock"),
        seconds_watched=median(seen, "clock"),
        speed=round(statistics.median(ratio("clock")), 3),
        solver_speed=round(statistics.median(ratio("solver")), 3),
        all_solver_speeds=ratio("solver"),
        all_others=[round(max(a["others"], b["others"]), 2) for a, b in zip(alone, seen)],
        finishing=median(seen, "finishing"),
        cpu_alone=median(alone, "cpu"),
        cpu_watched=median(seen, "cpu"),
        **{key: median(seen, key) for key in ("main_cpu_share", "tick_cpu_share")},
        **{key: median(seen, key, 1) for key in last if key.endswith("_per_second")},
    )


def story() -> Iterator[float]:
    yield 1.0
    surface = build_scene()
    view_override()["area"].spaces.active.show_region_ui = bool(given.sidebar)
    if given.maximised:
        with bpy.context.temp_override(**view_override()):
            bpy.ops.screen.screen_full_area(use_hide_panels=True)
    yield 0.5
    if "bare" in given.only:
        bare()
    if "write" in given.only:
        writes = [write_seconds(surface) for _ in range(5)]
        say(
            "write",
            points=POINTS,
            strands=STRANDS,
            seconds=round(statistics.median(writes), 4),
            all_seconds=[round(seconds, 4) for seconds in writes],
        )
    for nodes in given.nodes:
        surface.meander.spacing = SPACING * (NODES / nodes) ** 0.5
        bpy.context.view_layer.objects.active = surface
        if "picture" in given.only:
            picture(surface, in_one_go()[1])
        if "watched" in given.only:
            yield from watched()  # the first drawing compiles its programs
            yield from compared(surface)


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
parser.add_argument("--nodes", type=int, nargs="+", default=[NODES], help="about so many")
parser.add_argument("--sidebar", type=int, choices=(0, 1), default=1, help="shown or not")
parser.add_argument("--maximised", action="store_true", help="nothing but the 3D view")
parser.add_argument("--only", nargs="+", choices=ROWS, default=list(ROWS), metavar="ROW")
given = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
nowhere = os.open(os.devnull, os.O_WRONLY)
bpy.context.preferences.view.show_splash = False
meander.register()
Preview.show = count_shown(Preview.show)
session.Session.tick = measure_tick(session.Session.tick)
session.Session.keep = note_end(session.Session.keep)
bpy.types.SpaceView3D.draw_handler_add(count_redraw, (), "WINDOW", "POST_VIEW")
bpy.types.SpaceView3D.draw_handler_add(count_panel_redraw, (), "UI", "POST_PIXEL")
telling = story()
bpy.app.timers.register(tell, first_interval=0.5, persistent=True)
