# SPDX-License-Identifier: GPL-3.0-or-later
"""A light result and an export by the dialog."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path

import bpy
from dialogs import chosen
from meander.run import images
from meander.ui import cut, panels
from stage import (
    PICTURES,
    assert_nothing_left_over,
    key,
    look_at_surface,
    press,
    redrawn,
    seen,
    show_panel,
    status_texts,
    step,
    undo,
    until,
    view_override,
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
    press("make_light")
    assert points() < 0.6 * before, (points(), before)
    yield from seen("export_panel")
    yield from undo()
    yield from until(lambda: points() == before, "the points are back")
    assert not bpy.context.view_layer.objects.active.meander.use_light


def chosen_in_the_dialog() -> Iterator[float]:
    def look(space: bpy.types.SpaceFileBrowser) -> None:
        assert space.active_operator.layout_as == "UV", "a torus hides half of itself from above"

    path, wishes = FILES / "dialog.svg", {"file_format": "SVG", "size": 90.0}
    yield from chosen("export_toolpath", path, "export_dialog", look, **wishes)
    yield from until(path.is_file, "the file")
    assert abs(max(paper(path)) - 90.6) < 0.01


def seen_in_the_view() -> Iterator[float]:
    override = view_override()
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

    def look(space: bpy.types.SpaceFileBrowser) -> None:
        assert space.params.filename == "Torus_Meander.png"
        assert space.active_operator.file_format == "PNG"

    wishes = {"size": 64, "kinds": {"MASK", "COLOR"}}
    yield from chosen("maps", FILES / "torus.exr", "images_dialog", look, **wishes)
    paths = [FILES / f"torus_{kind}.exr" for kind in ("mask", "color")]
    yield from until(lambda: all(path.is_file() for path in paths), "the files")
    yield from seen("images_written")


def images_ended_by_esc() -> Iterator[float]:
    """Large ones, of which nothing is left."""

    def going() -> bool:
        return images.going.current is not None

    yield from chosen("maps", FILES / "never.png", size=2048)
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
