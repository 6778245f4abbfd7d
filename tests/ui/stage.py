# SPDX-License-Identifier: GPL-3.0-or-later
"""What the stories in a window share: the window, real keys, a scene, and who tells them.

A story is a module with a generator `story`, which a timer of Blender's advances: each `yield` lets
the window live for the seconds it names. It leaves pictures of what it saw in build/ui. Panels that
have to be in them are in its OPEN, and those that would push them out of the view in its CLOSED.
"""

from __future__ import annotations

import importlib
import os
import subprocess
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

import bpy
import meander
import numpy as np
import processor_time
from meander import core
from meander.run import pace, plan, session
from meander.run.lasting import why_busy
from meander.ui import panels

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "build" / "ui"
# A program that takes a picture of the screen, as words before the file's name; empty: Blender,
# whose own pictures are black with the software driver of Debian 13.
CAMERA = os.environ.get("MEANDER_CAMERA", "").split()

# A story takes 15 s on a quiet machine, most of it computing. This is for one that is busy or far
# slower.
TIME_LIMIT = 250.0
# For how long a story waits for what has to come: it costs nothing where it comes at once, and what
# has not come by then does not come at all.
PATIENCE = 60.0
SURFACE = "Suzanne"
# A run at the coarse spacing comes to its end within seconds, and one at half of it within some
# more. One that is finer goes on until it is stopped, however fast the machine: see options_of().
FINE, COARSE = 0.055, 0.12
FINEST_THAT_ENDS = 0.5 * COARSE
RESULT = "Suzanne Meander"

status_texts: list[str | None] = []
panel_draws = 0
last_session: session.Session | None = None


# ------------------------------------------------------------------------------------------------
# Runs that do not end by themselves

FOR_EVER = 2**32 - 1


def options_of(settings: bpy.types.PropertyGroup, spacing: float) -> core.FlowOptions:
    """The options of a flow; where the spacing is fine it removes hairpins for ever.

    No setting keeps a curve from settling, and how long that takes is a matter of the machine. Such
    a run still makes its iterations and changes its curve, so to a window it is like any other.
    """
    options = options_of_settings(settings, spacing)
    if spacing < 0.99 * FINEST_THAT_ENDS:
        options.hairpin_removal_iterations = options.iteration_limit = FOR_EVER
        # Watched for as long as the story takes, it would count all processors of the machine.
        options.threads = 1
    return options


options_of_settings = plan.options_of


# ------------------------------------------------------------------------------------------------
# The window

# Stories wait for pictures of a growing curve, which come rarely where the processors draw.
pace.LONGEST_WAIT = 0.4
# A picture is drawn by the processors, and smoothing its edges takes nearly half of that. So it is
# off but in stories that say SMOOTHED: there a run, which turns it off for as long as drawing is
# slow, has to give it back.
smoothing = "OFF"
# In a window of 960 x 600 there is as much as in one of 1280 x 800 by a scale of 1, in which the
# pictures of the pages are taken.
SCALE = float(os.environ.get("MEANDER_UI_SCALE", "0.75"))


def prefer() -> None:
    preferences = bpy.context.preferences
    preferences.system.viewport_aa = smoothing
    preferences.view.ui_scale = SCALE
    preferences.view.show_splash = False
    preferences.view.smooth_view = 0  # a view that turns at once
    preferences.view.filebrowser_display_type = "SCREEN"


def window_override() -> dict:
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    sidebar = next(region for region in area.regions if region.type == "UI")
    return {"window": window, "area": area, "region": sidebar}


def view_override() -> dict:
    """The same, but for the view beside the sidebar."""
    override = window_override()
    view = next(region for region in override["area"].regions if region.type == "WINDOW")
    return {**override, "region": view}


def press(name: str, **options: object) -> bpy.types.Object:
    """As a button of the panel does: with an undo step. Returns what is active then."""
    with bpy.context.temp_override(**window_override()):
        outcome = getattr(bpy.ops.meander, name)("INVOKE_DEFAULT", True, **options)
    assert outcome == {"FINISHED"}, outcome
    return bpy.context.view_layer.objects.active


IN_VIEW = (300, 300)


def key(kind: str, at: tuple[int, int] = IN_VIEW, **modifiers: bool) -> None:
    window = bpy.context.window_manager.windows[0]
    for value in ("PRESS", "RELEASE"):
        window.event_simulate(type=kind, value=value, x=at[0], y=at[1], **modifiers)


def click(x: int, y: int, button: str = "LEFTMOUSE") -> None:
    window = bpy.context.window_manager.windows[0]
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    for value in ("PRESS", "RELEASE"):
        window.event_simulate(type=button, value=value, x=x, y=y)


def middle_of(area_type: str) -> tuple[int, int]:
    """A place in the main region of an editor."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == area_type)
    region = next(region for region in area.regions if region.type == "WINDOW")
    return region.x + region.width // 2, region.y + region.height // 2


def redrawn() -> Iterator[float]:
    """Until the window shows all that is so by now: Blender draws before it calls a timer again."""
    for _ in range(2):  # a region may find its size while it is drawn
        yield 0.05


def seen(name: str) -> Iterator[float]:
    """A picture of what is so by now."""
    yield from redrawn()
    picture(name)


def picture(name: str) -> None:
    """A picture of what was drawn last."""
    if CAMERA:
        subprocess.run([*CAMERA, PICTURES / f"{name}.png"], check=True)
        return
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
    yield from redrawn()
    sidebar = window_override()["region"]
    x = sidebar.x + sidebar.width - 7
    # From below: the last tab is that of the add-on.
    for y in range(sidebar.y + 75, sidebar.y + sidebar.height - 75, 24):
        if panel_draws:
            break
        click(x, y)
        yield 0.02
    yield from redrawn()
    assert panel_draws, "the panel was not drawn: no tab of the sidebar shows it"


# ------------------------------------------------------------------------------------------------
# The scene


def build_scene(spacing: float = FINE, levels: int = 1) -> None:
    for thing in list(bpy.data.objects):
        if thing.type == "MESH":
            bpy.data.objects.remove(thing)
    bpy.ops.mesh.primitive_monkey_add(size=2.0)
    suzanne = bpy.context.active_object
    subdivision = suzanne.modifiers.new("Subdivision", "SUBSURF")
    subdivision.levels = subdivision.render_levels = levels
    suzanne.scale = (1.0, 1.2, 0.9)
    bpy.ops.object.shade_smooth()
    choose_spacing(spacing)


def suzanne_in_view(spacing: float = FINE) -> Iterator[float]:
    """And her panel in the sidebar."""
    build_scene(spacing)
    look_at_surface()
    yield from show_panel()


def choose_spacing(spacing: float) -> None:
    bpy.context.view_layer.objects.active.meander.spacing = spacing
    bpy.ops.ed.undo_push(message="Spacing")


def look_at_surface() -> None:
    with bpy.context.temp_override(**view_override()):
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


def pixels_of(name: str) -> np.ndarray:
    """The 3D view in a picture, (rows, columns, 3); the sidebar and headers are left out."""
    area = window_override()["area"]
    view = next(region for region in area.regions if region.type == "WINDOW")
    sidebar = window_override()["region"]
    image = bpy.data.images.load(str(PICTURES / f"{name}.png"))
    everything = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(everything)
    everything = everything.reshape(image.size[1], image.size[0], 4)
    bpy.data.images.remove(image)
    return everything[view.y : view.y + view.height - 80, view.x : sidebar.x, :3]


def changed_share(one: str, other: str) -> float:
    """How much of the 3D view is another in two pictures."""
    return float((np.abs(pixels_of(one) - pixels_of(other)).max(axis=2) > 0.1).mean())


def coloured(name: str, color: tuple[float, float, float]) -> int:
    """How many pixels of the 3D view in a picture have about this colour, as it is on screen."""
    return int((np.abs(pixels_of(name) - np.array(color)).max(axis=2) < 0.15).sum())


def assert_no_python_thread() -> None:
    """Blender 3.4 crashes now and then when operators run beside a Python thread that computes."""
    assert threading.enumerate() == [threading.main_thread()], threading.enumerate()


def assert_nothing_left_over() -> None:
    """Of a run or a drawing that has ended."""
    assert why_busy() is None
    assert last_session is None or last_session.stepper.finished
    assert_no_python_thread()
    assert not status_texts or status_texts[-1] is None, status_texts[-3:]
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
    # A timer of ours would come nine times, and never end. One or two may be Blender's own, or more
    # while a sidebar that has changed moves its panels to their places.
    end = time.monotonic() + PATIENCE
    while True:
        with bpy.context.temp_override(**window_override()):
            bpy.ops.test.count_timers("INVOKE_DEFAULT")
        yield 0.6
        key("F13")
        yield 0.05
        if timer_events < 4:
            return
        assert time.monotonic() < end, f"{timer_events} timer events in half a second"


def until(condition: Callable[[], bool], what: str) -> Iterator[float]:
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, f"not within {PATIENCE} s: {what}"
        yield 0.05


def activate(*names: str) -> bpy.types.Object:
    """Selects these, the first of them active, which is returned."""
    for thing in bpy.data.objects:
        thing.select_set(thing.name in names)
    bpy.context.view_layer.objects.active = bpy.data.objects[names[0]]
    return bpy.data.objects[names[0]]


def undo(redo: bool = False) -> Iterator[float]:
    """Ctrl+Z or Ctrl+Shift+Z, and what the window makes of it."""
    done = []
    handlers = bpy.app.handlers.redo_post if redo else bpy.app.handlers.undo_post

    def note(*_arguments: object) -> None:
        done.append(True)

    handlers.append(note)
    key("Z", ctrl=True, shift=redo)
    yield from until(lambda: bool(done), "redo" if redo else "undo")
    handlers.remove(note)
    yield 0.05


def ended() -> bool:
    return session.current() is None


def grown_to(points: int) -> Callable[[], bool]:
    return lambda: shown_points() >= points or ended()


# ------------------------------------------------------------------------------------------------
# The teller

passed = failed = 0
present_story, present_step = "", ""
begin = story_begin = time.monotonic()
step_begin = 0.0
changed_panels: list[tuple[type[bpy.types.Panel], set[str]]] = []


def step(name: str) -> None:
    """The one before it has passed."""
    global passed, present_step, step_begin
    passed += 1
    told = f"{present_story}: {present_step}"
    processor_time.note(told, processor_time.spent() - step_begin)
    step_begin = processor_time.spent()
    print(f"[{time.monotonic() - begin:5.1f} s] ok: {told}", flush=True)
    present_step = name


def open_window(story: ModuleType) -> None:
    """The window and its file as Blender starts with them, and the add-on registered anew."""
    global last_session, panel_draws, smoothing
    meander.unregister()  # which ends a run that a story has failed in
    for window in bpy.context.window_manager.windows[1:]:
        with bpy.context.temp_override(window=window):
            bpy.ops.wm.window_close()
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.ops.wm.read_homefile(use_factory_startup=True)
    smoothing = "FXAA" if getattr(story, "SMOOTHED", False) else "OFF"
    prefer()
    last_session, panel_draws = None, 0
    status_texts.clear()
    plan.options_of = options_of
    while changed_panels:
        panel, options = changed_panels.pop()
        panel.bl_options = options
    for kind, options in (("OPEN", set()), ("CLOSED", {"DEFAULT_CLOSED"})):
        for panel in getattr(story, kind, ()):
            changed_panels.append((panel, getattr(panel, "bl_options", set())))
            panel.bl_options = options
    meander.register()


def all_told(names: list[str]) -> Iterator[float]:
    """Every story in the same window; what goes wrong in one does not end the others."""
    global failed, present_story, present_step, story_begin
    for name in names:
        present_story, present_step, story_begin = name, "the window opens", time.monotonic()
        try:
            story = importlib.import_module(name)
            open_window(story)
            yield from redrawn()
            for seconds in story.story():
                yield seconds
                assert time.monotonic() - story_begin < TIME_LIMIT, f"not done in {TIME_LIMIT} s"
            assert_nothing_left_over()
            step("")
        except Exception:
            failed += 1
            traceback.print_exc()
            print(f"FAILED: {name}: {present_step}", flush=True)
            try:
                picture(f"failed_{name}")
            except RuntimeError as error:
                print(f"no picture: {error}", flush=True)


def tell(names: list[str]) -> None:
    """Tells these stories, one after another; the process ends with them, by exit code 0 or 7."""
    telling = all_told(names)

    def further() -> float:
        try:
            return next(telling)
        except BaseException as end:
            if not isinstance(end, StopIteration):
                traceback.print_exc()
            told = isinstance(end, StopIteration) and not failed
            print(f"{passed} passed, {failed or 1 - told} failed", flush=True)
            sys.stderr.flush()
            # os._exit, since an Esc press alone would already make Blender's own exit code 1.
            os._exit(0 if told else 7)

    PICTURES.mkdir(parents=True, exist_ok=True)
    prefer()
    spy()
    meander.register()
    bpy.utils.register_class(TEST_OT_count_timers)
    bpy.app.timers.register(further, first_interval=0.5, persistent=True)


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
