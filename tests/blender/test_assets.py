# SPDX-License-Identifier: GPL-3.0-or-later
"""The asset file: that it is what its script makes, and how its contents come into a file."""

from __future__ import annotations

import sys
from pathlib import Path

import bpy
import pytest
from meander.scene import assets
from meander.scene.assets import structure_of
from meander.scene.errors import DataError
from scenes import counts, reopened

ROOT = Path(__file__).resolve().parents[2]
# The interface of node groups is another from 4.0 on; files of 3.4 are read there.
ONLY_3_4 = pytest.mark.skipif(bpy.app.version >= (3, 5), reason="assets are made in Blender 3.4")


def contents() -> dict[str, object]:
    """Every tree and material of the add-on's file, marked and as plain values."""
    with bpy.data.libraries.load(str(assets.FILE), link=True) as (there, here):
        here.node_groups, here.materials = there.node_groups, there.materials
    return described([*here.node_groups, *here.materials])


def described(blocks: list[bpy.types.ID]) -> dict[str, object]:
    found = {}
    for block in blocks:
        data = block.asset_data
        found[block.name] = (
            block[assets.MARK],
            (data.description, data.catalog_id, [tag.name for tag in data.tags]),
            structure_of(getattr(block, "node_tree", None) or block),
        )
    return found


@ONLY_3_4
def test_the_file_is_what_its_script_makes():
    stored = contents()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    sys.path.insert(0, str(ROOT / "assets"))
    try:
        import make_assets
    finally:
        sys.path.pop(0)
    made = described(make_assets.build())
    assert set(made) == set(stored)
    for name, what in made.items():
        assert what == stored[name], f"{name}: run assets/make_assets.py again"


def test_every_asset_has_a_catalog_and_a_description():
    numbers = {
        line.split(":")[0]
        for line in (assets.FILE.parent / "blender_assets.cats.txt").read_text().splitlines()
        if ":" in line
    }
    found = contents()
    assert {"Meander Look", "Meander Line"} <= set(found)
    for name, (_version, (description, catalog, _tags), structure) in found.items():
        assert catalog in numbers and description, name
        assert all(node["kind"] != "NodeUndefined" for node in structure["nodes"].values()), name


def test_an_asset_comes_once_until_it_is_changed():
    first = assets.node_group("Meander Look")
    before = counts()
    assert first.asset_data is None and not first.use_fake_user
    first.name = "My Own Name"
    assert assets.node_group("Meander Look") == first
    assert counts() == before
    node = next(node for node in first.nodes if node.bl_idname == "GeometryNodeCurveToMesh")
    node.inputs["Fill Caps"].default_value = False
    second = assets.node_group("Meander Look")
    assert second != first and assets.node_group("Meander Look") == second
    assert not node.inputs["Fill Caps"].default_value
    assert assets.is_asset(first, "Meander Look") and assets.is_asset(second, "Meander Look")


def test_a_changed_material_stays_its_owners():
    first = assets.material("Meander Line")
    assert assets.material("Meander Line") == first
    first.diffuse_color = (1.0, 0.0, 0.0, 1.0)
    second = assets.material("Meander Line")
    assert second != first
    ramp = next(n for n in second.node_tree.nodes if n.bl_idname == "ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].color = (1.0, 1.0, 1.0, 1.0)
    assert assets.material("Meander Line") not in (first, second)


def test_assets_are_used_again_after_the_file_was_read(tmp_path):
    group = assets.node_group("Meander Look")
    group.use_fake_user = True
    reopened(tmp_path / "saved.blend")
    assert assets.node_group("Meander Look") == bpy.data.node_groups["Meander Look"]


def test_a_missing_file_is_said_in_a_sentence(monkeypatch, tmp_path):
    monkeypatch.setattr(assets, "FILE", tmp_path / "meander.blend")
    with pytest.raises(DataError, match="install Meander again"):
        assets.node_group("Meander Look")


def test_what_another_add_on_gives_nodes_is_no_setting_of_theirs():
    tree = bpy.data.node_groups.new("Any", "GeometryNodeTree")
    tree.nodes.new("GeometryNodeCurveToMesh")
    plain = assets.fingerprint(tree)
    assets._settings_of.cache_clear()
    bpy.types.Node.noted = bpy.props.StringProperty()
    try:
        assert assets.fingerprint(tree) == plain
    finally:
        del bpy.types.Node.noted
    assert assets.fingerprint(tree) == plain
