# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry in a window, from its row in the panel."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np
from meander.run import notes, session
from meander.ui import panels
from stage import (
    RESULT,
    SURFACE,
    activate,
    changed_share,
    ended,
    press_run,
    seen,
    step,
    suzanne_in_view,
    undo,
    until,
    window_override,
)

SPACING = 0.06
OPEN, CLOSED = (panels.MEANDER_PT_guidance,), (panels.MEANDER_PT_figures,)


def asymmetry() -> float:
    """How far the result reaches farther on one side, and how many points more it has there: of
    both the larger, as shares."""
    splines = bpy.data.objects[RESULT].data.splines
    x = np.array([point.co.x for spline in splines for point in spline.points])
    left, right = np.count_nonzero(x < 0.0), np.count_nonzero(x > 0.0)
    return max(abs(x.max() + x.min()) / np.ptp(x), abs(left - right) / len(x))


def crossings() -> int:
    """How often the result goes through the plane of symmetry."""
    count = 0
    for spline in bpy.data.objects[RESULT].data.splines:
        x = np.array([point.co.x for point in spline.points])
        sides = np.sign(x[np.abs(x) > 1e-6])
        count += int(np.count_nonzero(sides != np.roll(sides, -1)))
    return count


def window_opens() -> Iterator[float]:
    yield from suzanne_in_view(SPACING)
    yield from seen("mirror_1_off")


def filling() -> Iterator[float]:
    step("both halves grow before one's eyes, and become one curve")
    bpy.data.objects[SURFACE].meander.mirror = "X"
    bpy.ops.ed.undo_push(message="Symmetry")
    press_run()
    yield from until(
        lambda: session.current() is None or session.current().latest is not None, "a curve"
    )
    running = session.current()
    if running is not None and running.latest is not None:
        x = running.latest.polylines.positions[:, 0]
        assert abs(x.max() + x.min()) < 1e-6 and len(x) % 2 == 0
    yield from seen("mirror_2_growing")
    yield from until(ended, "the end of the run")
    yield from seen("mirror_3_done")
    assert asymmetry() < 0.01, asymmetry()
    assert bpy.data.objects[RESULT].meander.mirror == "X"


def hiding_the_seam() -> Iterator[float]:
    step("Hide Seam has strands cross the plane, and stays one line a part that the plane meets")
    lines = len(bpy.data.objects[RESULT].data.splines)
    surface = activate(SURFACE)
    surface.meander.hide_seam = True
    bpy.ops.ed.undo_push(message="Hide Seam")
    before = crossings()
    press_run(restart=True)
    yield from until(ended, "the end of the run")
    yield from seen("mirror_4_hidden_seam")
    assert changed_share("mirror_3_done", "mirror_4_hidden_seam") > 0.05
    assert crossings() > 5 * before, (before, crossings())
    assert len(bpy.data.objects[RESULT].data.splines) == lines
    yield from undo()
    assert crossings() == before
    surface = activate(SURFACE)
    surface.meander.hide_seam = False


def refusing() -> Iterator[float]:
    step("an axis in which the mesh is no mirror image is refused, and the panel says so")
    surface = bpy.data.objects[SURFACE]
    bpy.context.view_layer.objects.active = surface
    surface.meander.mirror = "Y"
    before = asymmetry()
    with bpy.context.temp_override(**window_override()):
        bpy.ops.meander.run("INVOKE_DEFAULT")
    yield from until(ended, "the refusal")
    yield from seen("mirror_5_refused")
    assert asymmetry() == before
    assert "mirror image in Y" in (notes.of(surface) or surface.meander.problem.sentence)


def story() -> Iterator[float]:
    yield from window_opens()
    yield from filling()
    yield from hiding_the_seam()
    yield from refusing()
