# SPDX-License-Identifier: GPL-3.0-or-later
"""A light result and an export by the dialog."""

from __future__ import annotations

import os
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path

import bpy
from meander.run import images
from meander.ui import cut, panels
from stage import (
    PICTURES,
    assert_nothing_left_over,
    browser,
    click,
    key,
    look_at_surface,
    redrawn,
    seen,
    show_panel,
    status_texts,
    step,
    undo,
    until,
    window_override,
)

# Open from the start, and what is above it closed, so that it is in the pictures.
OPEN = (panels.MEANDER_PT_output, cut.MEANDER_PT_make)
CLOSED = (panels.MEANDER_PT_figures,)

FILES = PICTURES / "exported"


def points() -> int:
    splines = bpy.context.view_layer.objects.active.data.splines
    return sum(len(spline.points) for spline in splines)


def paper(path: Path) -> list[float]:
    box = ElementTree.parse(path).getroot().get("viewBox")
    return [float(text) for text in box.split()[2:]]


def made_light() -> Iterator[float]:
    before = points()
    with bpy.context.temp_override(**window_override()):
        assert bpy.ops.meander.make_light("INVOKE_DEFAULT", True) == {"FINISHED"}
    assert points() < 0.6 * before, (points(), before)
    yield from seen("export_panel")
    yield from undo()
    yield from until(lambda: points() == before, "the points are back")
    assert not bpy.context.view_layer.objects.active.meander.use_light


def chosen_in_the_dialog() -> Iterator[float]:
    with bpy.context.temp_override(**window_override()):
        bpy.ops.meander.export_toolpath("INVOKE_DEFAULT", file_format="SVG", size=90.0)
    yield from until(lambda: browser() is not None, "the dialog")
    yield from redrawn()
    area = browser()
    operator = area.spaces.active.active_operator
    assert operator.bl_idname == "MEANDER_OT_export_toolpath"
    assert operator.layout_as == "UV", "a torus hides half of itself from above"
    yield from seen("export_dialog")
    area.spaces.active.params.directory = os.fsencode(f"{FILES}/")
    area.spaces.active.params.filename = "dialog.svg"
    yield from redrawn()
    window = bpy.context.window_manager.windows[0]
    with bpy.context.temp_override(window=window, area=area, region=area.regions[-1]):
        bpy.ops.file.execute()
    path = FILES / "dialog.svg"
    yield from until(path.is_file, "the file")
    assert abs(max(paper(path)) - 90.6) < 0.01


def seen_in_the_view() -> Iterator[float]:
    override = window_override()
    override["region"] = next(r for r in override["area"].regions if r.type == "WINDOW")
    with bpy.context.temp_override(**override):
        bpy.ops.view3d.view_axis(type="FRONT")
    yield from redrawn()
    thing = bpy.context.view_layer.objects.active
    places = [thing.matrix_world @ p.co.to_3d() for s in thing.data.splines for p in s.points]
    wide, high = (max(p[axis] for p in places) - min(p[axis] for p in places) for axis in (0, 2))
    path = FILES / "view.svg"
    with bpy.context.temp_override(**override):
        bpy.ops.meander.export_toolpath(
            filepath=str(path), layout_as="VIEW", scale=0.1, round_turns=False
        )
    found = paper(path)
    assert abs(found[0] - 0.6 - 100.0 * wide) < 0.1 and abs(found[1] - 0.6 - 100.0 * high) < 0.1


def images_by_the_dialog() -> Iterator[float]:
    """The format changes the end of the name, and the end of the name the format."""
    with bpy.context.temp_override(**window_override()):
        bpy.ops.meander.maps("INVOKE_DEFAULT", size=64, kinds={"MASK", "COLOR"})
    yield from until(lambda: browser() is not None, "the dialog")
    yield from redrawn()
    area = browser()
    space = area.spaces.active
    operator = space.active_operator
    assert space.params.filename == "Torus_Meander.png" and operator.file_format == "PNG"
    yield from seen("images_dialog")
    space.params.directory = os.fsencode(f"{FILES}/")
    space.params.filename = "torus.exr"
    yield from redrawn()
    buttons = next(region for region in area.regions if region.type == "EXECUTE")
    # What a script executes leaves the browser open.
    click(buttons.x + buttons.width - 50, buttons.y + buttons.height // 2)
    paths = [FILES / f"torus_{kind}.exr" for kind in ("mask", "color")]
    yield from until(lambda: all(path.is_file() for path in paths), "the files")
    yield from until(lambda: browser() is None, "the view again")
    yield from seen("images_written")


def images_ended_by_esc() -> Iterator[float]:
    """Large ones, of which nothing is left."""

    def going() -> bool:
        return images.going.current is not None

    with bpy.context.temp_override(**window_override()):
        bpy.ops.meander.maps("INVOKE_DEFAULT", size=2048)
    yield from until(lambda: browser() is not None, "the dialog")
    yield from redrawn()
    area = browser()
    area.spaces.active.params.directory = os.fsencode(f"{FILES}/")
    area.spaces.active.params.filename = "never.png"
    yield from redrawn()
    buttons = next(region for region in area.regions if region.type == "EXECUTE")
    click(buttons.x + buttons.width - 50, buttons.y + buttons.height // 2)
    yield from until(going, "the work begins")
    assert not bpy.ops.meander.maps.poll(), "a second one must wait"
    yield from until(lambda: any("Images: " in (text or "") for text in status_texts), "its words")
    key("ESC", at=(40, 20))
    yield 0.3
    assert going(), "outside of the view the key means something else"
    key("ESC")
    yield from until(lambda: not going(), "the work ends")
    assert not list(FILES.glob("never*"))
    assert_nothing_left_over()  # the browser has timers of Blender's own, which are not counted


def story() -> Iterator[float]:
    FILES.mkdir(parents=True, exist_ok=True)
    for path in FILES.iterdir():
        path.unlink()
    for thing in list(bpy.data.objects):
        if thing.type == "MESH":
            bpy.data.objects.remove(thing)
    bpy.ops.mesh.primitive_torus_add()
    look_at_surface()
    bpy.context.active_object.meander.spacing = 0.2
    assert bpy.ops.meander.run() == {"FINISHED"}
    bpy.ops.ed.undo_push(message="Filled")
    yield from show_panel()
    step("a result is made light, and Ctrl+Z brings its points back")
    yield from made_light()
    step("the dialog writes a file with the settings beside it")
    yield from chosen_in_the_dialog()
    step("the view as the layout")
    yield from seen_in_the_view()
    step("images, whose format is chosen by the name")
    yield from images_by_the_dialog()
    step("Esc ends images, and leaves nothing")
    yield from images_ended_by_esc()
