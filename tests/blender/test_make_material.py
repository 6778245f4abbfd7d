# SPDX-License-Identifier: GPL-3.0-or-later
"""Make Material: images of the line, packed and wired into a material of its surface."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from meander.run import images
from meander.scene import image_material

SPACING, SIZE = 0.25, 128
KINDS = ("INLAY", "GLAZE", "ENGRAVING")


def make(kind: str, **values: object) -> bpy.types.Material:
    assert bpy.ops.meander.make_material(kind=kind, size=SIZE, **values) == {"FINISHED"}
    return bpy.context.active_object.material_slots[0].material


def pixels_of(image: bpy.types.Image) -> np.ndarray:
    values = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)[..., :3]


def pictures(material: bpy.types.Material) -> dict[str, np.ndarray]:
    return {kind: pixels_of(image) for kind, image in image_material.images_in(material).items()}


def sources(material: bpy.types.Material, name: str) -> set[str]:
    """The kinds of images that an input of the shader comes from."""
    nodes = material.node_tree.nodes
    socket = next(n for n in nodes if n.bl_idname == "ShaderNodeBsdfPrincipled").inputs[name]
    found, todo = set(), [link.from_node for link in socket.links]
    while todo:
        node = todo.pop()
        if node.bl_idname == "ShaderNodeTexImage":
            found.add(node.image["meander_map"])
        todo += [link.from_node for each in node.inputs for link in each.links]
    return found


@pytest.fixture
def result() -> bpy.types.Object:
    return scenes.fill(scenes.grid(), SPACING)


def test_an_inlay_is_where_the_line_is(result: bpy.types.Object) -> None:
    surface = result.meander.surface
    material = make("INLAY")
    assert bpy.context.active_object == surface and result.hide_get()
    assert sources(material, "Base Color") == sources(material, "Metallic") == {"mask"}
    assert sources(material, "Normal") == {"normal"}
    mask = pictures(material)["mask"][..., 0]
    # The map is the whole square, so the share of brass is that of a line so wide.
    share = 0.32 * SPACING * scenes.length_of(result) / 4.0
    assert mask.mean() == pytest.approx(share, rel=0.05)
    for point in scenes.points_of(result)[::37]:
        column, row = ((point[:2] + 1.0) / 2.0 * SIZE).astype(int).clip(0, SIZE - 1)
        assert mask[row, column] > 0.7


@pytest.mark.parametrize("kind", KINDS)
def test_images_are_packed_into_the_file(
    result: bpy.types.Object, kind: str, tmp_path: Path
) -> None:
    material = make(kind)
    name, before = material.name, pictures(material)
    assert all(values.std() > 0.05 for values in before.values())
    scenes.reopened(tmp_path / "a.blend")
    after = pictures(bpy.data.materials[name])
    assert before.keys() == after.keys()
    assert all(np.array_equal(after[each], before[each]) for each in after)
    spaces = {
        each: image.colorspace_settings.name
        for each, image in image_material.images_in(bpy.data.materials[name]).items()
    }
    assert spaces.pop("color", "sRGB") == "sRGB" and set(spaces.values()) <= {"Non-Color"}


def test_a_mesh_keeps_its_own_materials(result: bpy.types.Object) -> None:
    surface, own = result.meander.surface, bpy.data.materials.new("Own")
    surface.data.materials.append(own)
    material = make("ENGRAVING")
    assert surface.data.materials[0] == own
    assert surface.material_slots[0].material == material
    groove = material.node_tree.nodes["Groove"].inputs["Distance"]
    assert groove.default_value == pytest.approx(0.08 * SPACING)


def test_a_mesh_without_a_map_is_unwrapped() -> None:
    surface = scenes.mesh_object(
        "Plate", [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2, 3)]
    )
    result = scenes.fill(surface, 0.5)
    assert not surface.data.uv_layers
    mask = pictures(make("INLAY"))["mask"]
    assert len(surface.data.uv_layers) == 1 and 0.1 < mask.mean() < 0.5
    assert surface.mode == "OBJECT" and result.hide_get()


def test_images_follow_the_curve_unless_they_were_painted(result: bpy.types.Object) -> None:
    material = make("ENGRAVING")
    before = pictures(material)
    counts = len(bpy.data.images), len(bpy.data.materials)
    for spacing in (0.7 * SPACING, SPACING):
        scenes.activate(result)
        result.meander.spacing = spacing
        assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
        after = pictures(material)
        assert not np.array_equal(after["mask"], before["mask"])
        assert not images.is_due(result)
        groove = material.node_tree.nodes["Groove"].inputs["Distance"]
        assert groove.default_value == pytest.approx(0.08 * spacing)
        assert counts == (len(bpy.data.images), len(bpy.data.materials))
        if spacing < SPACING:
            before = after
            image = image_material.images_in(material)["distance"]
            image.pixels[0] = 1.0 - image.pixels[0]
            before["distance"] = pixels_of(image)
            break
    scenes.activate(result)
    result.meander.spacing = SPACING
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
    after = pictures(material)
    assert all(np.array_equal(after[each], before[each]) for each in before)


def test_what_does_not_follow_stays(result: bpy.types.Object) -> None:
    material = make("INLAY", follows=False)
    before = pictures(material)
    scenes.activate(result)
    result.meander.spacing = 0.7 * SPACING
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
    assert np.array_equal(pictures(material)["mask"], before["mask"])


def test_undo_and_redo_show_the_images_that_they_bring_back(result: bpy.types.Object) -> None:
    name = make("ENGRAVING").name
    bpy.ops.ed.undo_push(message="Make Material")
    shown = [pictures(bpy.data.materials[name])]
    scenes.activate(result)
    result.meander.spacing = 0.7 * SPACING
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
    bpy.ops.ed.undo_push(message="Fill Again")
    shown.append(pictures(bpy.data.materials[name]))
    assert not np.array_equal(shown[0]["mask"], shown[1]["mask"])
    for step, expected in ((bpy.ops.ed.undo, shown[0]), (bpy.ops.ed.redo, shown[1])):
        assert step() == {"FINISHED"}
        after = pictures(bpy.data.materials[name])
        assert all(np.array_equal(after[each], expected[each]) for each in expected)
