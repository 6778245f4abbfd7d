# SPDX-License-Identifier: GPL-3.0-or-later
"""A drawing of what the camera sees."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator

import bpy
from dialogs import chosen
from meander.run import camera as drawings
from meander.ui import camera as camera_operator
from stage import (
    PICTURES,
    assert_no_timer,
    assert_nothing_left_over,
    key,
    look_at_surface,
    picture,
    seen,
    state,
    status_texts,
    step,
    until,
)

FILES = PICTURES / "drawn"
SMOOTHED = True


def drawn(name: str, spacing: float, **wishes: object) -> Iterator[float]:
    path, picture = FILES / f"{name}.svg", f"camera_dialog_{name}"
    yield from chosen("draw_camera", path, picture, spacing=spacing, **wishes)


def going() -> bool:
    return drawings.going.current is not None


def nothing_is_left() -> Iterator[float]:
    assert_nothing_left_over()
    yield from assert_no_timer()


def drawn_to_the_end() -> Iterator[float]:
    before = state()
    yield from drawn("page", 5.0)
    yield from until(going, "the drawing begins")
    assert not bpy.ops.meander.draw_camera.poll(), "a second one must wait"
    assert not bpy.ops.meander.run.poll(), "and so must a curve"
    yield from until(lambda: any("of 2: " in (text or "") for text in status_texts), "its words")
    picture("camera_drawing")
    yield from until(lambda: not going(), "the drawing ends")
    layers = [
        element.get("{http://www.inkscape.org/namespaces/inkscape}label")
        for element in ElementTree.parse(FILES / "page.svg").getroot().iter()
    ]
    assert [label for label in layers if label] == ["Cube", "Suzanne"]
    assert state() == before, "nothing is left in the scene"
    yield from nothing_is_left()


def as_dark_as_the_lamps_make_it() -> Iterator[float]:
    """The spacing does not count: a page of one strand is asked for, and shades are drawn."""
    yield from drawn("shade", 50.0, use_tone=True, line_width=3.0)
    yield from until(going, "the drawing begins")
    yield from until(lambda: not going(), "the drawing ends")
    assert (FILES / "shade.svg").stat().st_size > 0
    yield from nothing_is_left()


def ended_by_esc() -> Iterator[float]:
    before = state()
    yield from drawn("never", 1.0)
    yield from until(going, "the drawing begins")
    key("ESC", at=(40, 20))
    yield 0.3
    assert going(), "outside of the view the key means something else"
    key("ESC")
    yield from until(lambda: not going(), "the drawing ends")
    yield from seen("camera_ended")
    assert not (FILES / "never.svg").exists() and state() == before
    yield from nothing_is_left()


def asked_before_a_large_page() -> Iterator[float]:
    ask, large = camera_operator.MEANDER_OT_ask_draw, camera_operator.is_large
    camera_operator.is_large = lambda estimate: estimate.points > 5000
    before, draws = state(), []
    original = ask.draw

    def draw(self: bpy.types.Operator, context: bpy.types.Context) -> None:
        draws.append(self.figures)
        original(self, context)

    ask.draw = draw
    # Away from it: nothing is drawn. On its button: it is.
    for answer in ("ESC", "RET"):
        draws.clear()
        yield from drawn(f"large_{answer}", 1.0)
        yield from until(lambda: draws, "the question")
        yield from seen(f"camera_asks_{answer}")
        assert not going() and " points, " in draws[0], draws
        key(answer)
        yield 0.3
        assert answer == "RET" or not going()
    yield from until(going, "the drawing begins")
    key("ESC")
    yield from until(lambda: not going(), "the drawing ends")
    ask.draw, camera_operator.is_large = original, large
    assert state() == before
    yield from nothing_is_left()


def refused_in_the_panel() -> Iterator[float]:
    camera = bpy.context.scene.camera
    camera.data.type = "PANO"
    yield from drawn("pano", 5.0)
    yield 0.3
    assert not going() and not (FILES / "pano.svg").exists()
    camera.data.type = "PERSP"


def story() -> Iterator[float]:
    FILES.mkdir(parents=True, exist_ok=True)
    for path in FILES.iterdir():
        path.unlink()
    bpy.ops.mesh.primitive_monkey_add(size=2.0, location=(2.5, -1.0, 0.0))
    look_at_surface()
    bpy.ops.ed.undo_push(message="Scene")
    step("the dialog, and a page with a layer for each object")
    yield from drawn_to_the_end()
    step("a page as dark as the lamps make it")
    yield from as_dark_as_the_lamps_make_it()
    step("Esc ends it, and leaves nothing")
    yield from ended_by_esc()
    step("a very large page is asked for first")
    yield from asked_before_a_large_page()
    step("what cannot be drawn is said, and nothing goes on")
    yield from refused_in_the_panel()
