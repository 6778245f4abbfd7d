# SPDX-License-Identifier: GPL-3.0-or-later
"""What the look draws with round turns is what files, baked frames and the command have."""

from __future__ import annotations

import json
from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from meander.run import rounding
from meander.scene import drawn_line, look

SPACING = 0.35


def sharp_share(thing: bpy.types.Object, spacing: float = SPACING) -> float:
    """The share of the length of a line that turns by more than 45 degrees within .3 spacings."""
    sharp = count = 0
    for points, closed in scenes.world_splines(thing):
        points = np.vstack([points, points[:1]]) if closed else points
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        arcs = np.concatenate([[0.0], np.cumsum(steps)])
        places = np.arange(0.0, arcs[-1], 0.03 * spacing)
        even = np.column_stack([np.interp(places, arcs, points[:, axis]) for axis in range(3)])
        ways = np.diff(even, axis=0)
        ways /= np.linalg.norm(ways, axis=1, keepdims=True)
        turns = (ways[:-10] * ways[10:]).sum(axis=1)
        sharp, count = sharp + int((turns < np.cos(np.pi / 4)).sum()), count + len(turns)
    return sharp / count


@pytest.fixture
def result() -> bpy.types.Object:
    return scenes.fill(scenes.sphere(subdivisions=3), SPACING, iteration_limit=45, use_bevel=True)


def exported(path: Path, **options: bool) -> np.ndarray:
    assert bpy.ops.meander.export_toolpath(filepath=str(path), **options) == {"FINISHED"}
    return np.vstack([each["points"] for each in json.loads(path.read_text())["strands"]])


def test_a_file_has_the_line_that_is_seen(result: bpy.types.Object, tmp_path: Path) -> None:
    drawn = scenes.points_of(drawn_line.drawn_of(result))
    written = exported(tmp_path / "round.json")
    assert written.shape == drawn.shape and np.allclose(written, drawn, atol=1e-6)
    curve = exported(tmp_path / "curve.json", round_turns=False)
    assert np.allclose(curve, scenes.points_of(result), atol=1e-6)
    room = json.loads((tmp_path / "round.json").read_text())["strands"][0]
    assert abs(np.median(room["r_plus"]) / SPACING - 0.5) < 0.1
    # What a script has asked for since is drawn first.
    look.set_value(look.modifier_of(result), "Round", 0.25)
    rounder = exported(tmp_path / "rounder.json")
    assert np.allclose(rounder, scenes.points_of(drawn_line.drawn_of(result)), atol=1e-6)
    assert rounder.shape != written.shape or np.abs(rounder - written).max() > 0.02 * SPACING
    # An edited curve is drawn as it is.
    result.data.splines[0].points[0].co.x *= 1.01
    result.data.update_tag()
    bpy.context.view_layer.update()
    assert np.allclose(exported(tmp_path / "edited.json"), scenes.points_of(result), atol=1e-6)


def test_baked_growth_ends_as_what_is_seen(result: bpy.types.Object) -> None:
    drawn = scenes.points_of(drawn_line.drawn_of(result))
    assert bpy.ops.meander.bake_growth(every=15) == {"FINISHED"}
    frames = list(result.meander.bake.objects)
    assert np.allclose(scenes.points_of(frames[-1]), drawn, atol=1e-5)
    # The first loop is no polygon.
    ((loop, _closed),) = scenes.world_splines(frames[0])
    sides = np.roll(loop, -1, axis=0) - loop
    sides /= np.linalg.norm(sides, axis=1, keepdims=True)
    turns = np.degrees(np.arccos((sides * np.roll(sides, 1, axis=0)).sum(axis=1).clip(-1, 1)))
    assert turns.max() < 15.0


@pytest.mark.parametrize("motion", ["EVEN", "STICK"])
def test_baked_frames_are_round(result: bpy.types.Object, motion: str) -> None:
    surface = result.meander.surface
    surface.shape_key_add(name="Basis")
    key = surface.shape_key_add(name="Long", from_mix=False)
    for vertex in key.data:
        vertex.co.z *= 1.2
    for frame in (1, 3):
        key.value = (frame - 1) / 2
        key.keyframe_insert("value", frame=frame)
    bpy.context.scene.frame_set(1)
    result.meander.motion, result.meander.motion_steps = motion, 2
    sharp = []
    for value in (0.0, look.ROUND):
        look.set_value(look.modifier_of(result), "Round", value)
        rounding.on_output()
        scenes.activate(result)
        assert bpy.ops.meander.bake_motion(frame_start=1, frame_end=3) == {"FINISHED"}
        frame = list(result.meander.bake.objects)[0]
        sharp.append(sharp_share(frame))
        scenes.activate(surface)
        assert bpy.ops.meander.clear_bake() == {"FINISHED"}
    assert sharp[0] > 0.02 and sharp[1] < 0.7 * sharp[0], sharp


def test_the_command_writes_a_round_line_into_a_scene(tmp_path: Path, run_batch) -> None:
    scenes.sphere(subdivisions=3).name = "Ball"
    path = scenes.saved(tmp_path / "scene.blend")
    sharp = []
    for name, more in (("plain", ()), ("round", ("--round", str(look.ROUND)))):
        output = tmp_path / f"{name}.blend"
        given = ("--input", path, "--object", "Ball", "--spacing", SPACING, "--output", output)
        assert run_batch(*given, "--iterations", 45, "--quiet", *more).returncode == 0
        bpy.ops.wm.open_mainfile(filepath=str(output))
        (curve,) = (thing for thing in bpy.data.objects if thing.type == "CURVE")
        sharp.append(sharp_share(curve))
    assert sharp[0] > 0.02 and sharp[1] < 0.7 * sharp[0], sharp
