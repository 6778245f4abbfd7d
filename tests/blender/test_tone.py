# SPDX-License-Identifier: GPL-3.0-or-later
"""Tone on surfaces, and the light of a scene as the tone of what a camera draws of it."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from mathutils import Matrix, Vector
from meander.model.density import TONE, shares_of_ink
from meander.model.picture.tone import Tone
from meander.run.plan import plan_run
from meander.scene import density, look
from test_camera_drawing import camera, drawn, plane, steps_of

PEN = 1.6


def toned(source: str) -> bpy.types.Object:
    """A square with a source of brightness from 0 at the left to 1 at the right."""
    thing = scenes.grid(cells=20)
    across = np.array([(vertex.co.x + 1.0) / 2.0 for vertex in thing.data.vertices])
    settings = thing.meander
    settings.density_source, settings.density_interpolation = source, TONE.upper()
    if source == "GROUP":
        group = thing.vertex_groups.new(name="light")
        for index, weight in enumerate(across):
            group.add([index], weight, "REPLACE")
        settings.density_group = "light"
    elif source == "COLOR":
        colors = thing.data.color_attributes.new("light", "FLOAT_COLOR", "POINT")
        colors.data.foreach_set("color", np.repeat(across, 4).astype(np.float32))
        settings.density_color = "light"
    else:
        uv = thing.data.uv_layers.new(name="UV")
        for loop, element in zip(thing.data.loops, uv.data):
            element.uv = (across[loop.vertex_index], 0.5)
        image = bpy.data.images.new("light", 64, 2, float_buffer=True)
        image.colorspace_settings.name = "Non-Color"
        row = ((np.arange(64) + 0.5) / 64).repeat(4)
        image.pixels.foreach_set(np.tile(row, 2).astype(np.float32))
        settings.density_image = image
    scenes.activate(thing)
    return thing


@pytest.mark.parametrize("source", ["GROUP", "COLOR", "IMAGE"])
def test_brightness_of_a_surface_is_its_tone(source: str) -> None:
    thing = toned(source)
    settings = thing.meander
    settings.tone_kind, settings.tone_line, settings.tone_darkest = "LIGHT", 0.8, 0.8
    plan = plan_run(bpy.context)
    across = np.array([(vertex.co.x + 1.0) / 2.0 for vertex in thing.data.vertices])
    inside = (across > 0.02) & (across < 0.98)  # an image is repeated at its ends
    share = (1.0 - across).clip(0.06, 0.8)
    assert plan.problem.density[inside] == pytest.approx((share / 0.4)[inside] ** 2, rel=0.02)
    # The line is as thick as was thought of, wherever it is.
    assert plan.look.radius == pytest.approx(0.2) and not plan.radius_follows
    settings.tone_negative = True
    share = across.clip(0.06, 0.8)
    again = plan_run(bpy.context).problem.density
    assert again[inside] == pytest.approx((share / 0.4)[inside] ** 2, rel=0.02)


def test_a_tone_goes_into_settings_and_out_again() -> None:
    thing = toned("COLOR")
    choice = density.choice_of(thing.meander)
    assert choice.is_tone and choice.line == 0.5
    chosen = replace(choice, tone=Tone("value", 0.8, 0.1, negative=True), line=0.25)
    density.store_choice(chosen, thing.meander)
    assert density.choice_of(thing.meander) == chosen
    thing.meander.density_source = "CURVATURE"
    assert not density.choice_of(thing.meander).is_tone


def test_a_curve_with_a_tone_is_filled_and_as_thick_as_its_line() -> None:
    thing = toned("COLOR")
    thing.meander.tone_lightest = 0.2
    result = scenes.fill(thing, 0.12, start="FULL", use_bevel=True)
    assert look.radius_of(result) == pytest.approx(0.03, rel=1e-3)
    ((points, _cyclic),) = scenes.world_splines(result)
    middle, steps = scene_steps(points)
    dark = steps[(middle[:, 0] > -0.8) & (middle[:, 0] < -0.2)].sum()
    bright = steps[(middle[:, 0] > 0.2) & (middle[:, 0] < 0.8)].sum()
    share = shares_of_ink(np.linspace(0.0, 1.0, 101), Tone(lightest=0.2))
    wanted = share[10:41].mean() / share[60:91].mean()
    assert dark / bright == pytest.approx(wanted, rel=0.2)


def scene_steps(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    following = np.roll(points, -1, axis=0)
    return (points + following) / 2.0, np.linalg.norm(following - points, axis=1)


# ------------------------------------------------------------------------------------------------
# The light of a scene


def sun(direction: tuple, strength: float) -> None:
    data = bpy.data.lights.new("Sun", "SUN")
    data.energy = strength
    thing = bpy.data.objects.new("Sun", data)
    bpy.context.scene.collection.objects.link(thing)
    thing.rotation_euler = Vector(direction).to_track_quat("-Z", "Y").to_euler()
    bpy.context.view_layer.update()


def ink(paths: list, box: tuple[float, float, float, float]) -> float:
    """The share of ink in a box of the page."""
    left, top, right, bottom = box
    middles, lengths = steps_of(paths)
    inside = (
        (middles[:, 0] > left) & (middles[:, 0] < right)
        & (middles[:, 1] > top) & (middles[:, 1] < bottom)
    )  # fmt: skip
    return lengths[inside].sum() * PEN / ((right - left) * (bottom - top))


def bounds(paths: list, by: float) -> tuple[float, float, float, float]:
    """Of what is drawn, without a border."""
    points = np.vstack(paths)
    (left, top), (right, bottom) = points.min(axis=0), points.max(axis=0)
    return left + by, top + by, right - by, bottom - by


@pytest.mark.parametrize("lean", [0.0, 55.0])
def test_a_plane_is_as_dark_on_paper_as_its_light(tmp_path: Path, lean: float) -> None:
    """Whatever the angle at which it is seen: the sun makes both .6 of white."""
    eye = camera((0.0, -30.0, 0.0))
    eye.data.type, eye.data.ortho_scale = "ORTHO", 3.0
    bpy.context.scene.world = None
    plane("Plane", 2.0, (0.0, 0.0, 0.0), math.radians(lean))
    normal = Matrix.Rotation(-math.radians(lean), 3, "X") @ Vector((0.0, -1.0, 0.0))
    sun(tuple(-normal), 0.6 * math.pi)
    found = drawn(tmp_path / "a.svg", 9.0, line_width=PEN, use_tone=True, tone_kind="LIGHT")
    paths = found["Plane"]
    assert ink(paths, bounds(paths, 8.0)) == pytest.approx(0.4, abs=0.035)


def test_what_stands_in_the_light_throws_a_shadow_though_it_is_not_seen(tmp_path: Path) -> None:
    eye = camera((0.0, -30.0, 0.0))
    eye.data.type, eye.data.ortho_scale = "ORTHO", 3.0
    bpy.context.scene.world = None
    plane("Wall", 2.0, (0.0, 0.0, 0.0))
    screen = plane("Screen", 2.0, (1.0, -1.0, 0.0))
    screen.visible_camera = False
    sun((0.0, 1.0, 0.0), 0.8 * math.pi)
    found = drawn(tmp_path / "a.svg", 9.0, line_width=PEN, use_tone=True, tone_kind="LIGHT",
                  darkest=0.7)  # fmt: skip
    left, top, right, bottom = bounds(found["Wall"], 8.0)
    middle = (left + right) / 2.0
    assert ink(found["Wall"], (left, top, middle - 8.0, bottom)) == pytest.approx(0.2, abs=0.04)
    assert ink(found["Wall"], (middle + 8.0, top, right, bottom)) == pytest.approx(0.7, abs=0.07)
