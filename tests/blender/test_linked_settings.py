# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of a mesh from another file: they live in the scene, and are saved with it."""

from __future__ import annotations

import ast
from pathlib import Path

import bpy
import panel_layout
import pytest
from meander.scene.linked_settings import settings_of
from meander.scene.results import last_result
from meander.ui import presets
from panel_layout import Layout, drawn
from scenes import activate, poly_curve, sphere

QUICK = 20  # iterations


def library(folder: Path, with_curve: bool = True) -> Path:
    """A file with a sphere that somebody has set up, and a curve on it."""
    surface = sphere()
    surface.name = "Lib"
    surface.meander.spacing, surface.meander.iteration_limit = 0.6, QUICK
    path, things = folder / "library.blend", {surface}
    if with_curve:
        assert bpy.ops.meander.run() == {"FINISHED"}
        result = last_result(surface, bpy.context.scene)
        result.name = "LibCurve"
        things.add(result)
    bpy.data.libraries.write(str(path), things)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    return path


def linked(path: Path, name: str = "Lib", how: str = "linked") -> bpy.types.Object:
    with bpy.data.libraries.load(str(path), link=True) as (_there, here):
        here.objects = [name]
    thing = bpy.data.objects[name]
    bpy.context.scene.collection.objects.link(thing)
    if how == "overridden":
        thing = thing.override_create(remap_local_usages=True)
    return activate(thing)


def panel_settings(monkeypatch) -> list[bpy.types.PropertyGroup]:
    """Whose settings every panel of the tab shows, each group once."""
    found = []
    prop = Layout.prop

    def noted(self, data, name, *arguments, **options):
        if data.bl_rna.identifier == "MeanderSettings" and data not in found:
            found.append(data)
        prop(self, data, name, *arguments, **options)

    with monkeypatch.context() as patched:
        patched.setattr(Layout, "prop", noted)
        for panel in panel_layout.panels():
            drawn(panel, bpy.context)
    return found


def labels() -> str:
    layout = Layout()
    for panel in panel_layout.panels():
        layout.children.append(drawn(panel, bpy.context) or Layout())
    assert not [text.text for text in layout.texts() if text.excess > 0.0], "cut texts"
    return " ".join(text.text for text in layout.texts())


@pytest.mark.parametrize("how", ["linked", "overridden"])
def test_settings_chosen_in_the_panel_stay_with_the_file(tmp_path, monkeypatch, how):
    surface = linked(library(tmp_path), how=how)
    assert "Choose Settings" in labels()
    assert bpy.ops.meander.choose_settings() == {"FINISHED"}
    assert "Choose Settings" not in labels()
    [settings] = panel_settings(monkeypatch)
    assert settings.id_data == bpy.context.scene, "what the panel shows can be changed and saved"
    assert settings.spacing == pytest.approx(0.6), "they begin as the library has them"
    settings.spacing, settings.density_source, settings.bending_weight = 0.45, "CURVATURE", 0.3
    seed = poly_curve("Seed", [[(1, 0, 0), (0, 1, 0), (-1, 0, 0)]], cyclic=True)
    settings.seed = seed
    assert bpy.ops.meander.run() == {"FINISHED"}
    result = last_result(surface, bpy.context.scene)
    assert result.meander.spacing == pytest.approx(0.45)
    before = len(result.data.splines[0].points)
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    path = str(folder / "work.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, check_existing=False)
    bpy.ops.wm.open_mainfile(filepath=path)
    surface = next(thing for thing in bpy.context.scene.objects if thing.name == "Lib")
    settings = settings_of(surface)
    assert settings.spacing == pytest.approx(0.45)
    assert settings.density_source == "CURVATURE"
    assert settings.bending_weight == pytest.approx(0.3)
    assert settings.seed == bpy.data.objects["Seed"]
    assert last_result(surface, bpy.context.scene).meander.figures.stop_reason, "Last Run too"
    activate(surface)
    shown = panel_settings(monkeypatch)
    assert settings in shown and surface.meander not in shown
    assert bpy.ops.meander.run() == {"FINISHED"}
    curves = [thing for thing in bpy.context.scene.objects if thing.type == "CURVE"]
    assert len(curves) == 2, "the seed, and the curve that was updated"
    result = last_result(surface, bpy.context.scene)
    assert len(result.data.splines[0].points) == before


def test_a_linked_mesh_takes_presets_and_gives_them(tmp_path, monkeypatch):
    surface = linked(library(tmp_path))
    flowing = str(presets.SHIPPED / "Flowing.py")
    assert bpy.ops.meander.use_preset(filepath=flowing) == {"FINISHED"}
    settings = settings_of(surface)
    assert settings.id_data == bpy.context.scene
    assert presets.active_name(settings) == "Flowing"
    assert presets.active_name(surface.meander) != "Flowing", "the linked object is as it was"
    settings.bending_weight = 0.77
    monkeypatch.setattr(bpy.utils, "user_resource", lambda *_args, **_options: str(tmp_path))
    assert bpy.ops.meander.add_preset(name="Own") == {"FINISHED"}
    [written] = tmp_path.rglob("Own.py")
    assert presets._values_of(written)["bending_weight"] == pytest.approx(0.77)
    assert presets.active_name(surface.meander) != "Own"


def test_a_linked_mesh_is_filled_without_a_word_on_the_console(tmp_path, capfd):
    """Settings in the scene have no look, and are not asked for one."""
    linked(library(tmp_path, with_curve=False))
    capfd.readouterr()
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert "Traceback" not in "".join(capfd.readouterr())


def test_a_linked_mesh_takes_seeds(tmp_path):
    surface = linked(library(tmp_path))
    assert bpy.ops.meander.propose_spacing() == {"FINISHED"}
    assert settings_of(surface).spacing != pytest.approx(0.6)
    assert bpy.ops.meander.draw_seed() == {"FINISHED"}
    assert settings_of(surface).seed == bpy.context.active_object
    assert bpy.ops.meander.end_seed() == {"FINISHED"}
    assert settings_of(surface).seed is None


def test_undo_takes_settings_of_a_linked_mesh_back(tmp_path):
    surface = linked(library(tmp_path))
    bpy.ops.ed.undo_push(message="linked")
    bpy.ops.meander.choose_settings()
    settings_of(surface).spacing = 0.3
    bpy.ops.ed.undo_push(message="changed")
    bpy.ops.ed.undo()
    surface = bpy.context.active_object
    assert surface.library is not None
    assert settings_of(surface).spacing == pytest.approx(0.6)
    bpy.ops.ed.redo()
    assert settings_of(bpy.context.active_object).spacing == pytest.approx(0.3)


def test_a_linked_mesh_that_was_deleted_is_not_kept_in_the_file(tmp_path):
    surface = linked(library(tmp_path, with_curve=False))
    bpy.ops.meander.choose_settings()
    bpy.context.scene.collection.objects.unlink(surface)
    path = str(tmp_path / "work.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, check_existing=False)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert not [thing for thing in bpy.data.objects if thing.library is not None]


def test_a_linked_curve_says_why_nothing_can_be_changed(tmp_path):
    curve = linked(library(tmp_path), "LibCurve")
    before = [tuple(point.co) for point in curve.data.splines[0].points]
    with pytest.raises(RuntimeError, match="linked from another file"):
        bpy.ops.meander.run()
    assert [tuple(point.co) for point in curve.data.splines[0].points] == before
    assert "linked from another file" in labels()
    for name in ("choose_settings", "propose_spacing", "use_preset", "add_preset"):
        assert not getattr(bpy.ops.meander, name).poll(), name


# What holds a surface in the code: its settings may be in the scene, as settings_of() knows.
SURFACES = {"surface", "surface_object", "mesh_object"}


def reads_settings_of_a_surface(tree: ast.AST) -> list[int]:
    """The lines that read object.meander of what may be linked."""
    return [
        node.lineno
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute) and node.attr == "meander"
        and (isinstance(node.value, ast.Call) or getattr(node.value, "id", "") in SURFACES)
    ]  # fmt: skip


def test_settings_of_surfaces_are_read_in_one_place():
    assert reads_settings_of_a_surface(ast.parse("surface.meander.live")) == [1]
    assert reads_settings_of_a_surface(ast.parse("key.find().meander.live")) == [1]
    assert reads_settings_of_a_surface(ast.parse("result.meander.live")) == []
    package = Path(presets.__file__).parents[1]
    found = [
        f"{path.relative_to(package)}:{line}"
        for room in ("scene", "run", "ui", "headless")
        for path in sorted((package / room).glob("*.py"))
        for line in reads_settings_of_a_surface(ast.parse(path.read_text(encoding="utf-8")))
    ]
    assert found == []
