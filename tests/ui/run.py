# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: the modal operator as a user meets it, with a window, real keys and clicks.

    LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1280x800x24 -nolisten tcp" \
      blender --factory-startup --enable-event-simulate --window-geometry 0 0 1280 800 \
      --python-exit-code 1 --python tests/ui/run.py

Leaves pictures of what it saw in build/ui and ends with exit code 0 or 7. The story is a generator
that a timer of Blender's advances: each `yield` lets the window live for the seconds it names.
"""

from __future__ import annotations

import os
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "build" / "ui"
# Another add-on folder can be tried with the same story.
sys.path.insert(0, os.environ.get("MEANDER_ADDON_PARENT", str(ROOT / "addon")))
sys.path.append(str(ROOT / "tests"))

import meander  # noqa: E402
import processor_time  # noqa: E402
from meander.run import session  # noqa: E402
from meander.scene import ramp  # noqa: E402
from meander.ui import operators, panels  # noqa: E402

# The story takes 25 s on a quiet machine, most of it computing. This is for one that is busy or far
# slower, and lets the story tell where it stands before scripts/test.sh ends it.
TIME_LIMIT = 250.0
SURFACE = "Suzanne"
# Fine enough for a run that is still going when it is looked at, and coarse enough for one second.
FINE, COARSE = 0.04, 0.12
RESULT = "Suzanne Meander"

status_texts: list[str | None] = []
panel_draws = 0
last_session: session.Session | None = None


# ------------------------------------------------------------------------------------------------
# The window


def window_override() -> dict:
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    sidebar = next(region for region in area.regions if region.type == "UI")
    return {"window": window, "area": area, "region": sidebar}


def key(kind: str, ctrl: bool = False) -> None:
    window = bpy.context.window_manager.windows[0]
    for value in ("PRESS", "RELEASE"):
        window.event_simulate(type=kind, value=value, x=400, y=400, ctrl=ctrl)


def click(x: int, y: int) -> None:
    window = bpy.context.window_manager.windows[0]
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    for value in ("PRESS", "RELEASE"):
        window.event_simulate(type="LEFTMOUSE", value=value, x=x, y=y)


def picture(name: str) -> None:
    window = bpy.context.window_manager.windows[0]
    with bpy.context.temp_override(window=window):
        bpy.ops.screen.screenshot(filepath=str(PICTURES / f"{name}.png"))


def press_run(restart: bool = False) -> None:
    """As the button does: from the sidebar's region, by INVOKE_DEFAULT."""
    global last_session
    with bpy.context.temp_override(**window_override()):
        outcome = bpy.ops.meander.run("INVOKE_DEFAULT", restart=restart)
        assert outcome == {"RUNNING_MODAL"}, outcome
        assert not bpy.ops.meander.run.poll(), "a second run must wait"
    last_session = session.current()
    assert not last_session.stepper.finished
    assert_no_python_thread()


def show_panel() -> Iterator[float]:
    """Opens the sidebar and clicks its tabs until the panel is drawn."""
    override = window_override()
    override["area"].spaces.active.show_region_ui = True
    yield 0.5
    sidebar = window_override()["region"]
    x = sidebar.x + sidebar.width - 9
    for y in range(sidebar.y + sidebar.height - 100, sidebar.y + 100, -30):
        if panel_draws:
            break
        click(x, y)
        yield 0.2
    assert panel_draws, "the panel was not drawn: no tab of the sidebar shows it"


# ------------------------------------------------------------------------------------------------
# The scene


def build_scene() -> None:
    for thing in list(bpy.data.objects):
        if thing.type == "MESH":
            bpy.data.objects.remove(thing)
    bpy.ops.mesh.primitive_monkey_add(size=2.0)
    suzanne = bpy.context.active_object
    suzanne.modifiers.new("Subdivision", "SUBSURF").levels = 2
    suzanne.scale = (1.0, 1.2, 0.9)
    bpy.ops.object.shade_smooth()
    choose_spacing(FINE)


def choose_spacing(spacing: float) -> None:
    bpy.context.view_layer.objects.active.meander.spacing = spacing
    bpy.ops.ed.undo_push(message="Spacing")


def look_at_surface() -> None:
    override = window_override()
    override["region"] = next(r for r in override["area"].regions if r.type == "WINDOW")
    with bpy.context.temp_override(**override):
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.view3d.view_selected()
        bpy.ops.view3d.view_orbit(angle=0.4, type="ORBITLEFT")


def splines_of(name: str) -> list[bytes]:
    splines = []
    for spline in bpy.data.objects[name].data.splines:
        points = np.empty(4 * len(spline.points), dtype=np.float32)
        spline.points.foreach_get("co", points)
        splines.append(points.tobytes() + bytes([spline.use_cyclic_u]))
    return splines


def state() -> dict:
    """What a cancelled run must leave as it was."""
    active = bpy.context.view_layer.objects.active
    return {
        "objects": sorted(bpy.data.objects.keys()),
        "curves": sorted(bpy.data.curves.keys()),
        "meshes": sorted(bpy.data.meshes.keys()),
        "active": active.name if active else None,
        "selected": sorted(thing.name for thing in bpy.data.objects if thing.select_get()),
        "spacing": [(thing.name, thing.meander.spacing) for thing in bpy.data.objects],
        "splines": {
            thing.name: (thing.data.name, thing.data.bevel_depth, splines_of(thing.name))
            for thing in bpy.data.objects
            if thing.type == "CURVE"
        },
    }


def point_count() -> int:
    """Of the result, once there is one."""
    thing = bpy.data.objects.get(RESULT)
    return sum(len(spline.points) for spline in thing.data.splines) if thing else 0


def shown_points() -> int:
    """Of the growing curve, as the views have it."""
    running = session.current()
    return running.shown_points if running is not None else 0


def changed_share(one: str, other: str) -> float:
    """How much of the 3D view is another in two pictures; the sidebar and headers are left out."""
    area = window_override()["area"]
    view = next(region for region in area.regions if region.type == "WINDOW")
    sidebar = window_override()["region"]
    pixels = []
    for name in (one, other):
        image = bpy.data.images.load(str(PICTURES / f"{name}.png"))
        everything = np.empty(len(image.pixels), dtype=np.float32)
        image.pixels.foreach_get(everything)
        everything = everything.reshape(image.size[1], image.size[0], 4)
        pixels.append(everything[view.y : view.y + view.height - 80, view.x : sidebar.x, :3])
        bpy.data.images.remove(image)
    return float((np.abs(pixels[0] - pixels[1]).max(axis=2) > 0.1).mean())


def assert_no_python_thread() -> None:
    """Blender 3.4 crashes now and then when operators run beside a Python thread that computes."""
    assert threading.enumerate() == [threading.main_thread()], threading.enumerate()


def assert_nothing_left_over() -> None:
    assert session.current() is None
    assert last_session is not None and last_session.stepper.finished
    assert_no_python_thread()
    assert status_texts and status_texts[-1] is None, status_texts[-3:]
    assert bpy.context.preferences.system.viewport_aa == smoothing  # off while drawing is slow


# How many timer events the window gets: none, once a run has given its own back.
timer_events = 0


class TEST_OT_count_timers(bpy.types.Operator):
    bl_idname = "test.count_timers"
    bl_label = "Count Timer Events"

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        global timer_events
        timer_events = 0
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, _context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        global timer_events
        if event.type == "TIMER":
            timer_events += 1
        return {"FINISHED"} if event.type == "F13" else {"PASS_THROUGH"}


def assert_no_timer() -> Iterator[float]:
    with bpy.context.temp_override(**window_override()):
        bpy.ops.test.count_timers("INVOKE_DEFAULT")
    yield 1.0
    key("F13")
    yield 0.2
    # A timer of ours would have come ten times; one or two may be Blender's own.
    assert timer_events < 4, f"{timer_events} timer events in a second"


def until(condition: Callable[[], bool], seconds: float, what: str) -> Iterator[float]:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"not within {seconds} s: {what}"
        yield 0.05


def ended() -> bool:
    return session.current() is None


def grown_to(points: int) -> Callable[[], bool]:
    return lambda: shown_points() >= points or ended()


# ------------------------------------------------------------------------------------------------
# The story


def story() -> Iterator[float]:
    yield 1.0
    build_scene()
    yield 0.5
    look_at_surface()
    yield from show_panel()
    yield 0.3
    picture("1_before")
    before = state()

    step("a curve shapes the ramp")
    settings = bpy.context.view_layer.objects.active.meander
    settings.density_group = bpy.context.active_object.vertex_groups.new(name="Fine").name
    settings.density_interpolation = "FREE"
    mapping = ramp.node_of(settings.density_ramp).mapping
    mapping.curves[0].points.new(0.35, 0.8)
    mapping.update()
    yield 0.5
    picture("1_ramp")
    settings.density_interpolation, settings.density_group = "LINEAR", ""
    yield 0.5
    picture("1_plain")
    before = state()

    step("the curve grows on screen")
    press_run()
    yield from until(lambda: shown_points() > 0, 5.0, "a first curve")
    counts = [shown_points()]
    while len(counts) < 3 and not ended():
        yield from until(grown_to(counts[-1] + 1), 10.0, f"more points than {counts}")
        counts.append(shown_points())
    assert not ended(), f"the run ended after {counts}; the scene is too easy"
    assert counts == sorted(set(counts)), counts
    # Grown enough for a picture worth looking at.
    yield from until(lambda: ended() or session.current().progress() > 0.5, 10.0, "half of it")
    yield 0.2
    picture("2_running")
    changed = changed_share("1_plain", "2_running")
    assert changed > 0.02, f"only {changed:.1%} of the view has changed"
    assert not ended(), "the run ended before it could be cancelled; the scene is too easy"
    assert status_texts[-1] and "Esc" in status_texts[-1], status_texts[-1:]
    assert state() == before, "a growing curve is drawn, but is no object"

    step("Esc restores the scene")
    key("ESC")
    yield from until(ended, 5.0, "the end after Esc")
    assert state() == before
    assert_nothing_left_over()
    yield from assert_no_timer()

    step("a run to the end")
    choose_spacing(COARSE)
    before = state()
    press_run()
    yield from until(ended, 30.0, "the end of the run")
    yield 0.5
    picture("3_done")
    assert_nothing_left_over()
    result = bpy.data.objects[RESULT]
    assert bpy.context.view_layer.objects.active == result
    assert result.meander.surface.name == SURFACE
    assert result.data.bevel_depth > 0.0
    assert result.meander.figures.stop_reason == "converged", result.meander.figures.stop_reason
    assert all(spline.use_cyclic_u for spline in result.data.splines)
    assert set(bpy.data.curves.keys()) == {result.data.name}
    yield from assert_no_timer()

    step("Esc gives a continued result its splines back")
    bpy.data.objects[RESULT].meander.spacing = FINE
    before_continued = state()
    press_run()
    yield from until(lambda: shown_points() > 0, 10.0, "a first curve")
    yield 0.3
    picture("4_continued")
    assert not bpy.data.objects[RESULT].data.splines
    key("ESC")
    yield from until(ended, 5.0, "the end after Esc")
    assert state() == before_continued
    assert_nothing_left_over()

    step("Ctrl-Z takes the curve away again")
    key("Z", ctrl=True)
    yield 0.7
    assert state() == before, {"before": before, "now": state()}

    step("Enter stops and keeps")
    choose_spacing(FINE)
    press_run()
    yield from until(grown_to(50), 10.0, "some points")
    key("RET")
    yield from until(ended, 5.0, "the end after Enter")
    assert_nothing_left_over()
    assert bpy.data.objects[RESULT].meander.figures.stop_reason == "cancelled"
    assert point_count() >= 50

    step("Start Over, and the Stop button")
    press_run(restart=True)
    yield 0.5
    picture("4_start_over")
    with bpy.context.temp_override(**window_override()):
        bpy.ops.meander.stop()
    yield from until(ended, 5.0, "the end after Stop")
    assert_nothing_left_over()

    step("the surface is deleted under the run")
    bpy.context.view_layer.objects.active = bpy.data.objects[SURFACE]
    press_run()
    yield from until(lambda: shown_points() > 0, 5.0, "a first curve")
    bpy.data.objects.remove(bpy.data.objects[SURFACE])
    yield from until(ended, 5.0, "the end after the deletion")
    assert_nothing_left_over()
    assert f"{RESULT}.001" not in bpy.data.objects

    step("unregistering ends a run")
    build_scene()
    press_run()
    yield 0.3
    meander.unregister()
    assert_nothing_left_over()
    yield 0.3
    meander.register()

    step("a new file ends a run")
    press_run()
    yield 0.3
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.ops.wm.read_homefile(use_factory_startup=True, load_ui=False)
    yield 0.5
    assert_nothing_left_over()
    assert not bpy.data.curves


# ------------------------------------------------------------------------------------------------
# The teller

passed: list[str] = []
present_step = "the window opens"
begin, step_begin = time.monotonic(), processor_time.spent()
telling = story()


def step(name: str) -> None:
    global present_step, step_begin
    passed.append(present_step)
    processor_time.note(present_step, processor_time.spent() - step_begin)
    step_begin = processor_time.spent()
    print(f"[{time.monotonic() - begin:5.1f} s] ok: {present_step}", flush=True)
    present_step = name


def finish(failed: int) -> None:
    # os._exit, since an Esc press alone would already make Blender's own exit code 1.
    print(f"{len(passed)} passed, {failed} failed", flush=True)
    sys.stderr.flush()
    os._exit(7 if failed else 0)


def tell() -> float:
    try:
        assert time.monotonic() - begin < TIME_LIMIT, f"not done within {TIME_LIMIT} s"
        return next(telling)
    except StopIteration:
        step("")
        finish(0)
    except BaseException:
        traceback.print_exc()
        print(f"FAILED: {present_step}", flush=True)
        try:
            picture("failed")
        except RuntimeError as error:
            print(f"no picture: {error}", flush=True)
        finish(1)


def spy() -> None:
    """Notes the status texts and whether the panel is drawn; neither can be asked for."""
    original_status = bpy.types.WorkSpace.status_text_set

    def status_text_set(self: bpy.types.WorkSpace, text: str | None) -> None:
        status_texts.append(text)
        original_status(self, text)

    bpy.types.WorkSpace.status_text_set = status_text_set

    original_draw = panels.MEANDER_PT_main.draw

    def draw(self: bpy.types.Panel, context: bpy.types.Context) -> None:
        global panel_draws
        panel_draws += 1
        original_draw(self, context)

    panels.MEANDER_PT_main.draw = draw


PICTURES.mkdir(parents=True, exist_ok=True)
bpy.context.preferences.view.show_splash = False
smoothing = bpy.context.preferences.system.viewport_aa
spy()
meander.register()
bpy.utils.register_class(TEST_OT_count_timers)
assert operators.MEANDER_OT_run.is_registered
bpy.app.timers.register(tell, first_interval=0.5, persistent=True)
