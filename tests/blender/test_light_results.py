# SPDX-License-Identifier: GPL-3.0-or-later
"""Results with fewer points: by a run, by the button, and gone on from."""

from __future__ import annotations

import json
from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from meander import batch


def test_a_run_makes_a_light_result_that_goes_on(tmp_path: Path) -> None:
    ball = scenes.sphere()
    whole = scenes.fill(ball, 0.3)
    length, many = scenes.length_of(whole), scenes.point_count(whole)
    result = scenes.fill(scenes.sphere(), 0.3, use_light=True, radius_follows=True, use_bevel=True)
    assert result != whole
    few = scenes.point_count(result)
    assert few < 0.5 * many
    assert scenes.length_of(result) == pytest.approx(length, rel=0.01)
    assert {round(point.radius, 3) for point in result.data.splines[0].points} != {1.0}
    # What is known of the points is about those that are left.
    path = tmp_path / "path.json"
    export = bpy.ops.meander.export_toolpath
    assert export(filepath=str(path), file_format="JSON", round_turns=False) == {"FINISHED"}
    strands = json.loads(path.read_text())["strands"]
    assert sum(len(strand["r_plus"]) for strand in strands) == few
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert scenes.point_count(result) < 0.5 * many
    assert scenes.length_of(result) == pytest.approx(length, rel=0.05)


def test_the_button_makes_a_result_light() -> None:
    ball = scenes.sphere()
    ball.scale = (2.0, 2.0, 2.0)
    result = scenes.fill(ball, 0.5)
    before = scenes.points_of(result)
    for number, spline in enumerate(result.data.splines):
        spline.points.foreach_set("radius", np.arange(len(spline.points), dtype=np.float32))
        spline.material_index = number
    cyclic = [spline.use_cyclic_u for spline in result.data.splines]
    result.meander.light_tolerance = 0.02
    assert bpy.ops.meander.make_light() == {"FINISHED"}
    after = scenes.points_of(result)
    assert len(after) < 0.4 * len(before)
    assert result.meander.use_light
    assert [spline.use_cyclic_u for spline in result.data.splines] == cyclic
    # Radii tell which points they are: the very same, with what they had.
    first = result.data.splines[0]
    at = np.array([point.radius for point in first.points]).astype(int)
    assert (before[at] == after[: len(at)]).all()
    # Between two that are left, all that went is near.
    for begin, end in zip(at[:-1], at[1:]):
        chord = before[end] - before[begin]
        away = before[begin : end + 1] - before[begin]
        share = np.clip(away @ chord / (chord @ chord), 0.0, 1.0)
        assert np.linalg.norm(away - np.outer(share, chord), axis=1).max() <= 0.02 * 0.5 * 1.001
    assert bpy.ops.meander.points_to_mesh() == {"FINISHED"}
    mesh = bpy.context.view_layer.objects.get(f"{result.name} Points").data
    assert len(mesh.attributes["r_plus"].data) == len(after)
    # A limit, and once more changes nothing.
    scenes.activate(result)
    result.meander.point_limit = len(after) // 2
    assert bpy.ops.meander.make_light() == {"FINISHED"}
    assert scenes.point_count(result) <= len(after) // 2


def test_baked_frames_are_light_too() -> None:
    result = scenes.fill(scenes.sphere(), 0.4, use_light=True)
    final = scenes.point_count(result)
    assert bpy.ops.meander.bake_growth(every=40) == {"FINISHED"}
    frames = sorted(result.meander.bake.objects, key=lambda thing: thing.name)
    assert scenes.point_count(frames[-1]) == final


def test_what_cannot_be_light_says_why() -> None:
    result = scenes.fill(scenes.sphere(), 0.5)
    result.data.splines.new("BEZIER")
    with pytest.raises(RuntimeError, match="convert them to Poly"):
        bpy.ops.meander.make_light()
    assert not result.meander.use_light


def test_a_light_result_that_crosses_itself_is_counted(tmp_path: Path) -> None:
    """The report counts as a search of every pair does; what is near enough crosses nowhere."""
    scenes.grid()
    scene, report = tmp_path / "scene.blend", tmp_path / "r.json"
    bpy.ops.wm.save_as_mainfile(filepath=str(scene))
    for light in ((), ("--light", "0.01")):
        given = ["--input", scene, "--output", tmp_path / "out.blend", "--report", report]
        given += ["--spacing", "0.15", "--iterations", "150", "--quiet", *light]
        assert batch.main([str(a) for a in given]) == 0
        found = json.loads(report.read_text())["points"]["crossings"]
        assert found == (0 if light else None)
