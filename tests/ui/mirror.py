# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender script: symmetry in a window, from its row in the panel; started like run.py."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
ADDONS = os.environ.get("MEANDER_ADDON_PARENT", str(HERE.parents[1] / "addon"))
sys.path[:0] = [str(HERE), str(HERE.parent), ADDONS]

from meander.run import notes, session  # noqa: E402
from meander.ui import panels  # noqa: E402
from stage import (  # noqa: E402
    RESULT,
    SURFACE,
    build_scene,
    choose_spacing,
    ended,
    look_at_surface,
    picture,
    press_run,
    show_panel,
    step,
    tell,
    until,
    window_override,
)

SPACING = 0.06
# Open, to be seen.
panels.MEANDER_PT_guidance.bl_options = set()
panels.MEANDER_PT_figures.bl_options = {"DEFAULT_CLOSED"}


def asymmetry() -> float:
    """How far the result reaches farther on one side, and how many points more it has there: of
    both the larger, as shares."""
    splines = bpy.data.objects[RESULT].data.splines
    x = np.array([point.co.x for spline in splines for point in spline.points])
    left, right = np.count_nonzero(x < 0.0), np.count_nonzero(x > 0.0)
    return max(abs(x.max() + x.min()) / np.ptp(x), abs(left - right) / len(x))


def window_opens() -> Iterator[float]:
    yield 1.0
    build_scene()
    choose_spacing(SPACING)
    yield 0.3
    look_at_surface()
    yield from show_panel()
    yield 0.5
    picture("mirror_1_off")


def filling() -> Iterator[float]:
    step("both halves grow before one's eyes, and become one curve")
    bpy.data.objects[SURFACE].meander.mirror = "X"
    bpy.ops.ed.undo_push(message="Symmetry")
    yield 0.3
    press_run()
    yield from until(
        lambda: session.current() is None or session.current().latest is not None, "a curve"
    )
    running = session.current()
    if running is not None and running.latest is not None:
        x = running.latest.polylines.positions[:, 0]
        assert abs(x.max() + x.min()) < 1e-6 and len(x) % 2 == 0
    yield 0.6
    picture("mirror_2_growing")
    yield from until(ended, "the end of the run")
    yield 1.0
    picture("mirror_3_done")
    assert asymmetry() < 0.01, asymmetry()
    assert bpy.data.objects[RESULT].meander.mirror == "X"


def refusing() -> Iterator[float]:
    step("an axis in which the mesh is no mirror image is refused, and the panel says so")
    surface = bpy.data.objects[SURFACE]
    bpy.context.view_layer.objects.active = surface
    surface.meander.mirror = "Y"
    before = asymmetry()
    with bpy.context.temp_override(**window_override()):
        bpy.ops.meander.run("INVOKE_DEFAULT")
    yield from until(ended, "the refusal")
    yield 0.7
    picture("mirror_4_refused")
    assert asymmetry() == before
    assert "mirror image in Y" in (notes.of(surface) or surface.meander.problem.sentence)


def story() -> Iterator[float]:
    yield from window_opens()
    yield from filling()
    yield from refusing()


tell(story())
