# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves of a scene in files of other programs: names, what of a bake is written, refusals. The
files themselves are read by other programs in tests/core/test_scene_files.py and test_lights.py."""

from __future__ import annotations

import json
import re
from pathlib import Path

import bpy
import numpy as np
import pytest
from scenes import activate, fill


@pytest.fixture
def result() -> bpy.types.Object:
    bpy.ops.mesh.primitive_torus_add(major_segments=24, minor_segments=12)
    return activate(fill(bpy.context.active_object, 0.3))


def export(path: Path, **given) -> None:
    assert bpy.ops.meander.export_toolpath(filepath=str(path), **given) == {"FINISHED"}


@pytest.mark.parametrize(
    ("given", "name"),
    [
        ({"filepath": "a.usda"}, "a.usda"),
        ({"filepath": "a.svg", "file_format": "GLB"}, "a.glb"),
        ({"filepath": "a.wled.json", "layout_as": "UV", "pitch": 40.0}, "a.wled.json"),
        ({"filepath": "a.wled.json", "file_format": "PIXELBLAZE"}, "a.pixelblaze.json"),
        ({"filepath": "a.json", "file_format": "XLIGHTS", "pitch": 200.0}, "a.xmodel"),
        ({"filepath": "a.b", "file_format": "ROS", "frame_id": "base"}, "a.b.yaml"),
        ({"filepath": "a.json"}, "a.json"),
    ],
)
def test_names_say_the_format_and_formats_the_name(result, tmp_path: Path, given, name) -> None:
    export(tmp_path / given["filepath"], **{k: v for k, v in given.items() if k != "filepath"})
    assert [each.name for each in tmp_path.iterdir()] == [name]


def test_lights_of_a_torus_are_in_its_place(result, tmp_path: Path) -> None:
    export(tmp_path / "a.pixelblaze.json", pitch=50.0)
    places = np.array(json.loads((tmp_path / "a.pixelblaze.json").read_text())) / 1000.0
    off = np.hypot(np.hypot(places[:, 0], places[:, 1]) - 1.0, places[:, 2])
    assert 0.22 < off.min() and off.max() < 0.26


def samples(path: Path) -> dict[int, np.ndarray]:
    """Points by time, of the text of a closed curve."""
    found = re.search(r"point3f\[\] points\.timeSamples = \{ (.*) \}", path.read_text())[1]
    return {
        int(time): np.array(re.findall(r"[-+.e\d]+", row), dtype=float).reshape(-1, 3)
        for time, row in re.findall(r"(\d+): \[(.*?)\]", found)
    }


def test_baked_frames_are_samples_in_time(result, tmp_path: Path) -> None:
    surface, scene = result.meander.surface, bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 3
    for frame in (1, 3):
        surface.location.x = frame - 1.0
        surface.keyframe_insert("location", frame=frame)
    scene.frame_set(1)
    for motion in ("EVEN", "STICK"):
        result.meander.motion = motion
        activate(result)
        assert bpy.ops.meander.bake_motion(frame_start=1, frame_end=3) == {"FINISHED"}
        scene.frame_set(2)
        export(tmp_path / "a.usda")
        assert scene.frame_current == 2
        for frame, points in samples(tmp_path / "a.usda").items():
            middle = float((points[:, 0].max() + points[:, 0].min()) / 2.0)
            assert middle == pytest.approx((0.0, 1.0, 2.0)[frame - 1], abs=0.02), (motion, frame)
        assert len(samples(tmp_path / "a.usda")) == 3
        export(tmp_path / "b.usda", animated=False)
        assert "timeSamples" not in (tmp_path / "b.usda").read_text()
        assert bpy.ops.meander.clear_bake() == {"FINISHED"}


def test_binary_usd_says_what_it_needs(result, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr("meander.model.toolpaths.usd.is_there", lambda: False)
    with pytest.raises(RuntimeError, match="usd-core"):
        bpy.ops.meander.export_toolpath(filepath=str(tmp_path / "a.usdc"))
    assert not list(tmp_path.iterdir())
