# SPDX-License-Identifier: GPL-3.0-or-later
"""What was made of a curve, and the images of its material, follow it to another curve."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np
from live import choose, looked
from meander.run import images, remade
from meander.scene import image_material
from stage import (
    COARSE,
    FINE,
    RESULT,
    SURFACE,
    activate,
    changed_share,
    choose_spacing,
    ended,
    key,
    press,
    press_run,
    redrawn,
    seen,
    shown_points,
    splines_of,
    state,
    step,
    suzanne_in_view,
    undo,
    until,
    window_override,
)

SIZE = 256
# A value of a pixel that differs by so much is another; of so many of them, it is another picture.
ANOTHER, MOST_ALIKE = 0.25, 0.02


def pictures() -> dict[str, np.ndarray]:
    """The values of the images on Suzanne, by their kinds, as Blender draws them."""
    found = {}
    material = bpy.data.objects[SURFACE].material_slots[0].material
    for kind, image in image_material.images_in(material).items():
        values = np.empty(len(image.pixels), dtype=np.float32)
        image.pixels.foreach_get(values)
        found[kind] = values
    return found


def differ(before: dict[str, np.ndarray]) -> bool:
    """Whether every image is another picture. Of one that is as it was no value has changed."""
    shares = [
        float((np.abs(values - before[kind]) > ANOTHER).mean())
        for kind, values in pictures().items()
    ]
    assert shares and all(share == 0.0 or share > MOST_ALIKE for share in shares), shares
    assert len({share > 0.0 for share in shares}) == 1, shares
    return shares[0] > 0.0


def fill_again(spacing: float, active: str = SURFACE) -> Iterator[float]:
    activate(active)
    choose_spacing(spacing)
    yield from seen("follow_2_before")
    press_run(restart=True)
    yield from until(ended, "the run ends")


def material() -> Iterator[float]:
    step("Make Material shows the line by images, in the view too")
    press("make_material", kind="ENGRAVING", size=SIZE)
    assert bpy.data.objects[RESULT].hide_get()
    window_override()["area"].spaces.active.shading.color_type = "TEXTURE"
    yield from seen("follow_1_material")
    assert changed_share("follow_0_filled", "follow_1_material") > 0.05


def another_spacing() -> Iterator[float]:
    step("Fill Again at another spacing, and the images are of the new line")
    first, before = splines_of(RESULT), pictures()
    yield from fill_again(1.6 * COARSE)
    assert splines_of(RESULT) != first
    yield from images_follow()
    assert differ(before)
    yield from seen("follow_3_another")
    assert changed_share("follow_2_before", "follow_3_another") > 0.05

    step("one step of undo takes back line and images, and redo brings both")
    second, after = splines_of(RESULT), pictures()
    for redo in (False, True, False):
        yield from undo(redo)
        yield 0.3
        assert splines_of(RESULT) == (second if redo else first), redo
        assert not differ(after if redo else before), redo
    yield from seen("follow_4_undone")
    assert changed_share("follow_2_before", "follow_4_undone") < 0.01
    yield from undo(redo=True)
    yield 0.3


def esc() -> Iterator[float]:
    step("Esc leaves the line and its images as they were")
    activate(SURFACE)
    choose_spacing(FINE)
    before, shown = state(), pictures()
    press_run(restart=True)
    yield from until(lambda: shown_points() > 0, "a first curve")
    key("ESC")
    yield from until(ended, "the end after Esc")
    yield from redrawn()
    assert state() == before
    assert not images.is_due(bpy.data.objects[RESULT]) and not differ(shown)


def images_follow() -> Iterator[float]:
    yield from until(lambda: not images.is_due(bpy.data.objects[RESULT]), "the images follow")


def with_live() -> Iterator[float]:
    step("with Live images follow once the line rests, in the same step of undo")
    surface = activate(SURFACE)
    surface.meander.live = True
    choose_spacing(1.5 * COARSE)
    press_run(restart=True)
    yield from until(ended, "the run ends")
    yield from images_follow()
    yield from looked()
    first, before = splines_of(RESULT), pictures()
    choose(activate(SURFACE), "spacing", 1.3 * COARSE)
    yield from until(lambda: ended() and splines_of(RESULT) != first, "the line follows")
    yield from images_follow()
    assert differ(before)
    second, after = splines_of(RESULT), pictures()
    for redo in (False, True):
        yield from undo(redo)
        yield 0.3
        assert ended() and splines_of(RESULT) == (second if redo else first), redo
        assert not differ(after if redo else before), redo
    choose(activate(SURFACE), "live", False)


def meshes() -> Iterator[float]:
    step("two-tone, ribbon and maze are of the new line as soon as the run ends")
    made = []
    for name, options in (("two_tone", {}), ("ribbon", {}), ("maze", {"solution": True})):
        press("select_curve")  # the one before has hidden it
        made.append(press(name, **options).name)
    made.append(f"{made[-1]} Solution")

    def counts() -> list[int]:
        things = [bpy.data.objects[name].data for name in made]
        return [
            len(data.vertices) if isinstance(data, bpy.types.Mesh)
            else sum(len(spline.points) for spline in data.splines)
            for data in things
        ]  # fmt: skip

    before, first = counts(), splines_of(RESULT)
    press("select_curve")
    yield from fill_again(1.8 * COARSE, RESULT)
    after = counts()
    assert not remade.is_due(bpy.data.objects[RESULT])
    assert all(one != other for one, other in zip(before, after, strict=True)), (before, after)
    yield from images_follow()
    yield from seen("follow_5_meshes")
    yield from undo()
    yield 0.3
    assert counts() == before and splines_of(RESULT) == first


def story() -> Iterator[float]:
    yield from suzanne_in_view(COARSE)
    step("Suzanne is filled")
    press_run()
    yield from until(ended, "the run ends")
    yield from seen("follow_0_filled")
    yield from material()
    yield from another_spacing()
    yield from esc()
    yield from with_live()
    yield from meshes()
