# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of files as scripts and people give them: // is the folder of the .blend; a folder, and no
name at all, are refused in a sentence, and nothing is written anywhere."""

from __future__ import annotations

from pathlib import Path

import bpy
import pytest
import scenes


@pytest.fixture
def result(tmp_path: Path) -> bpy.types.Object:
    scenes.activate(scenes.fill(scenes.grid(), 0.5))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    return bpy.context.active_object


@pytest.mark.parametrize("name", ["//rel.svg", "//rel", "//./rel.svg", "//../{folder}/rel.svg"])
def test_two_slashes_are_the_folder_of_the_scene(result, tmp_path: Path, name: str) -> None:
    name = name.format(folder=tmp_path.name)
    bpy.ops.meander.export_toolpath(filepath=name, file_format="SVG")
    assert sorted(path.name for path in tmp_path.glob("rel*")) == ["rel.svg"]


# Other operators that write files, what they need besides, and what they write for "//rel".
OTHERS = {
    "maps": ({"size": 32, "kinds": {"MASK"}}, "rel_mask.png"),
    "draw_camera": ({"spacing": 20.0}, "rel.svg"),
}


def written_by(operator: str, name: str) -> None:
    given, _file = OTHERS[operator]
    getattr(bpy.ops.meander, operator)(filepath=name, **given)


@pytest.fixture
def seen(result) -> bpy.types.Object:
    """The result again, in front of a camera, its surface with a UV map."""
    eye = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    eye.location = (0.0, 0.0, 8.0)
    bpy.context.scene.collection.objects.link(eye)
    bpy.context.scene.camera = eye
    bpy.ops.wm.save_mainfile()
    return result


@pytest.mark.parametrize("operator", OTHERS)
@pytest.mark.parametrize("name", ["//rel", "//./rel", "//../{folder}/rel"])
def test_maps_and_cameras_take_two_slashes_too(
    seen, tmp_path: Path, operator: str, name: str
) -> None:
    written_by(operator, name.format(folder=tmp_path.name))
    assert [path.name for path in tmp_path.glob("rel*")] == [OTHERS[operator][1]]


@pytest.mark.parametrize("operator", OTHERS)
@pytest.mark.parametrize("name", ["", " ", "{folder}/", "{folder}/new/", "//", "//new/"])
def test_maps_and_cameras_refuse_what_names_no_file(
    seen, tmp_path: Path, operator: str, name: str
) -> None:
    before = sorted(tmp_path.parent.rglob("*"))
    with pytest.raises(RuntimeError) as refused:
        written_by(operator, name.format(folder=tmp_path))
    assert "give a" in str(refused.value) and "Traceback" not in str(refused.value)
    assert sorted(tmp_path.parent.rglob("*")) == before


@pytest.mark.parametrize("name", ["", " ", "{folder}/", "{folder}/new/", "//", "//new/"])
def test_what_names_no_file_is_a_sentence(result, tmp_path: Path, name: str) -> None:
    before = sorted(tmp_path.parent.rglob("*"))
    with pytest.raises(RuntimeError) as refused:
        bpy.ops.meander.export_toolpath(filepath=name.format(folder=tmp_path), file_format="SVG")
    assert "give a" in str(refused.value) and "Traceback" not in str(refused.value)
    assert sorted(tmp_path.parent.rglob("*")) == before


def test_beside_a_scene_that_is_not_saved(tmp_path: Path) -> None:
    scenes.activate(scenes.fill(scenes.grid(), 0.5))
    if bpy.data.filepath:
        pytest.skip("the scene has been saved")
    with pytest.raises(RuntimeError) as refused:
        bpy.ops.meander.export_toolpath(filepath="//rel.svg", file_format="SVG")
    assert "is not saved" in str(refused.value)
