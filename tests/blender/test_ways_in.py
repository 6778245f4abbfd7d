# SPDX-License-Identifier: GPL-3.0-or-later
"""What leads to and from the panel: menus, presets, pages."""

from __future__ import annotations

import fnmatch
from pathlib import Path
from types import SimpleNamespace

import bpy
import panel_layout
import pytest
from mathutils import Vector
from meander.ui import help as pages
from meander.ui import presets
from meander.ui.menu import MEANDER_MT_object
from meander.ui.panels import MEANDER_PT_main
from panel_layout import Layout
from scenes import activate, cube, fill, poly_curve, sphere

SHIPPED = ("Even", "Flowing", "Organic", "Few_Corners", "Rows", "As_Published")

ROOT = Path(__file__).resolve().parents[2]
AS_PUBLISHED = presets.SHIPPED / "As_Published.py"


@pytest.fixture
def own_scripts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the user's presets are during a test."""
    folder = tmp_path / "scripts"
    monkeypatch.setattr(
        bpy.utils,
        "user_resource",
        lambda _kind, path="", create=False: str(made(folder / path, create)),
    )
    monkeypatch.setattr(
        bpy.utils,
        "preset_paths",
        lambda subdir: [str(made(folder / "presets" / subdir, True)), str(presets.SHIPPED)],
    )
    return folder / "presets" / "meander"


def made(folder: Path, create: bool) -> Path:
    if create:
        folder.mkdir(parents=True, exist_ok=True)
    return folder


def use(path: Path) -> set[str]:
    return bpy.ops.meander.use_preset(filepath=str(path))


def values(settings: bpy.types.PropertyGroup) -> dict:
    return {name: getattr(settings, name) for name in presets.SETTINGS}


def test_every_shipped_preset_sets_all_that_presets_hold():
    settings = cube().meander
    seen = []
    for name in SHIPPED:
        bpy.ops.object.select_all(action="DESELECT")
        settings.segment_share, settings.alignment_weight = 0.3, 4.5
        settings.align_across = settings.use_outline = settings.use_weights = True
        settings.spacing = 0.7
        assert use(presets.SHIPPED / f"{name}.py") == {"FINISHED"}
        assert settings.spacing == pytest.approx(0.7)
        assert settings.segment_share == 0.0 and not settings.use_outline
        seen.append(tuple(values(settings).values()))
        text = (presets.SHIPPED / f"{name}.py").read_text()
        assert all(f"settings.{setting} = " in text for setting in presets.SETTINGS)
    assert len(set(seen)) == len(SHIPPED)


def test_even_is_what_a_new_mesh_has():
    fresh = values(cube().meander)
    settings = activate(sphere()).meander
    settings.preset, settings.start_spacing_factor = "FINEST", 3.0
    use(presets.SHIPPED / "Even.py")
    assert values(settings) == fresh


def test_organic_winds_more_than_even():
    # Of one curve chance decides: the ratio is 1.05 to 1.57 for spacings from 0.15 to 0.25.
    turns = {"Even": 0.0, "Organic": 0.0}
    for name in turns:
        for spacing in (0.15, 0.2, 0.25):
            surface = activate(sphere())
            use(presets.SHIPPED / f"{name}.py")
            turns[name] += turning(fill(surface, spacing))
    assert turns["Organic"] > 1.1 * turns["Even"]


def turning(result: bpy.types.Object) -> float:
    """How much the curve turns, in radians per spacing."""
    total = length = 0.0
    for spline in result.data.splines:
        points = [Vector(point.co[:3]) for point in spline.points]
        ways = [b - a for a, b in zip(points, points[1:]) if (b - a).length > 1e-6]
        length += sum(way.length for way in ways)
        total += sum(one.angle(other) for one, other in zip(ways, ways[1:]))
    return total / length * result.meander.spacing


def test_a_preset_is_added_used_and_removed(own_scripts):
    settings = cube().meander
    settings.preset, settings.alignment_source, settings.align_across = "FINEST", "SMOOTH", True
    wanted = values(settings)
    assert bpy.ops.meander.add_preset(name="My Rows") == {"FINISHED"}
    (file,) = own_scripts.glob("*.py")
    use(presets.SHIPPED / "Even.py")
    assert values(settings) != wanted
    assert use(file) == {"FINISHED"} and values(settings) == wanted
    layout = Layout()
    drawn = presets.MEANDER_PT_presets
    assert {str(presets.SHIPPED), str(own_scripts)} == set(presets.folders())
    assert drawn.preset_add_operator == "meander.add_preset" and layout.children == []
    assert bpy.ops.meander.add_preset(name="My Rows", remove_name=True) == {"FINISHED"}
    assert not list(own_scripts.glob("*.py"))


def test_what_ships_is_not_removed(own_scripts):
    cube()
    remove = {"name": "Few Corners", "remove_name": True}
    assert bpy.ops.meander.add_preset(**remove) == {"CANCELLED"}
    assert bpy.ops.meander.add_preset(name="Few Corners") == {"CANCELLED"}, "nor hidden by another"
    assert not list(own_scripts.glob("*.py"))
    assert (presets.SHIPPED / "Few_Corners.py").is_file()


def listed_presets() -> dict[str, bool]:
    """The presets of the menu, and whether it offers to remove them."""
    found = {}

    def path_menu(paths, _operator, *, filter_ext, add_operator):
        assert paths, "Blender writes 'Missing Paths' where it gets none"
        for path in [path for folder in paths for path in Path(folder).iterdir()]:
            if filter_ext(path.suffix):
                assert path.stem not in found
                found[path.stem] = add_operator is not None

    menu = SimpleNamespace(
        layout=Layout(), path_menu=path_menu, preset_operator="", preset_add_operator="add"
    )
    presets.MEANDER_PT_presets.draw(menu, bpy.context)
    return found


def test_only_what_users_add_offers_to_be_removed(own_scripts, monkeypatch):
    cube()
    assert listed_presets() == dict.fromkeys(SHIPPED, False)
    bpy.ops.meander.add_preset(name="My_Rows")
    assert listed_presets() == dict.fromkeys(SHIPPED, False) | {"My_Rows": True}
    monkeypatch.setattr(bpy.utils, "preset_paths", lambda _subdir: [])
    assert listed_presets() == dict.fromkeys(SHIPPED, False)


def test_a_preset_is_one_undo_step():
    settings = cube().meander
    name = bpy.context.active_object.name
    bpy.ops.ed.undo_push(message="before")
    with bpy.context.temp_override():
        bpy.ops.meander.use_preset("EXEC_DEFAULT", True, filepath=str(AS_PUBLISHED))
    assert settings.preset == "PAPER"
    bpy.ops.ed.undo()
    assert bpy.data.objects[name].meander.preset == "EVEN"
    bpy.ops.ed.redo()
    assert bpy.data.objects[name].meander.preset == "PAPER"


def test_a_preset_needs_something_to_fill():
    activate(poly_curve("Any", [[(0, 0, 0), (1, 0, 0)]], False))
    assert not bpy.ops.meander.use_preset.poll() and not bpy.ops.meander.add_preset.poll()


def test_the_preset_that_is_active_is_named(own_scripts):
    surface = cube()
    assert presets.active_name(surface.meander) == "Even"
    for name in SHIPPED:
        bpy.ops.meander.use_preset(filepath=str(presets.SHIPPED / f"{name}.py"))
        assert presets.active_name(surface.meander) == name.replace("_", " ")
    surface.meander.border_distance += 0.3
    assert presets.active_name(surface.meander) == ""
    texts = panel_layout.drawn(MEANDER_PT_main, bpy.context).texts()
    assert "Custom" in [text.text for text in texts]
    bpy.ops.meander.add_preset(name="My Own")
    assert presets.active_name(surface.meander) == "My Own"
    fill(surface, 0.6)
    assert presets.active_name(surface.meander.last_result.meander) == "My Own"


def shown_in(menu: str) -> list[str]:
    """The texts of our entries in a menu of Blender's."""
    layout = Layout()

    class Menu:
        pass

    this = Menu()
    this.layout = layout
    for function in getattr(bpy.types, menu)._dyn_ui_initialize():
        if function.__module__.startswith("meander"):
            function(this, bpy.context)
    return [item.label for item in layout.children]


def test_the_menus_offer_to_fill():
    cube()
    for menu in ("VIEW3D_MT_object", "VIEW3D_MT_edit_mesh", "VIEW3D_MT_paint_weight"):
        assert shown_in(menu) == ["Meander"]
    assert shown_in("VIEW3D_MT_curve_add") == ["Fill with Curve (Meander)"]


def test_the_menu_has_every_operator():
    """Menu Search finds what is in a menu."""
    called = []

    class Noted(Layout):
        def operator(self, idname, text=None, **options):
            given = super().operator(idname, text, **options)
            called.append((idname, text, given))
            return given

    def texts_of_run() -> list[tuple[str | None, dict]]:
        called.clear()
        this = SimpleNamespace(layout=Noted())
        MEANDER_MT_object.draw(this, bpy.context)
        # Menu Search shows the text alone: no two may be the same, and each says what it does.
        texts = [item.label for item in this.layout.children if item.kind == "operator"]
        assert len(set(texts)) == len(texts)
        assert not {"Done", "Show", "Stop", "Images"} & set(texts)
        # The same verbs as on the buttons, which have their operators' own labels.
        own = {text for idname, text, _given in called if idname != "meander.run"}
        assert own == {None}
        # What goes on with a run that was stopped stands there only when there is one, and a
        # variation is chosen by its picture.
        of_panels = {"live", "ask_run", "ask_draw", "use_preset", "add_preset", "resume"}
        of_panels.add("use_variation")
        operators = {f"meander.{name}" for name in set(dir(bpy.ops.meander)) - of_panels}
        assert {idname for idname, _text, _given in called} == operators
        return [(text, vars(given)) for idname, text, given in called if idname == "meander.run"]

    # The same words as in the panel, for the same things.
    activate(None)
    assert texts_of_run() == [(None, {})]
    surface = cube()
    assert texts_of_run() == [(None, {})]
    result = fill(surface, 0.5)
    new = ("New Curve", {"beside": True})
    assert texts_of_run() == [("Continue", {}), ("Fill Again", {"restart": True}), new]
    activate(surface)
    again = ("Fill Again", {})
    assert texts_of_run() == [("Continue", {"go_on": True}), again, new]
    assert result.meander.surface == surface


def test_help_opens_a_page_or_says_why_not(tmp_path, monkeypatch, capfd):
    opened = []
    monkeypatch.setattr(pages, "_HOME", tmp_path)  # as if installed, with the pages in docs
    (tmp_path / "blender_manifest.toml").write_text('id = "meander"\n')
    (tmp_path / "docs").mkdir()
    monkeypatch.setattr(pages.webbrowser, "open", lambda address: opened.append(address) or True)
    with pytest.raises(RuntimeError, match="The pages are not built; run scripts/build_site.sh"):
        bpy.ops.meander.open_help(page="density")
    (tmp_path / "docs" / "density.html").write_text("<html></html>")
    assert bpy.ops.meander.open_help(page="density") == {"FINISHED"}
    assert opened == [(tmp_path / "docs" / "density.html").as_uri()]
    monkeypatch.setattr(pages.webbrowser, "open", lambda _address: False)
    capfd.readouterr()
    assert bpy.ops.meander.open_help(page="density") == {"FINISHED"}
    assert "No browser opens; the page is file://" in capfd.readouterr().out


def test_every_page_exists_and_every_setting_has_one():
    for page, _label, _tip in pages.PAGES:
        assert (ROOT / "docs" / f"{page}.md").is_file(), page
    prefix, mapping = pages.manual_map()
    assert (prefix, mapping[0][1]) == ("", pages.address_of("density"))

    def page_of(name: str) -> str:
        return next(url for pattern, url in mapping if fnmatch.fnmatchcase(name, pattern))

    for name in bpy.types.Object.bl_rna.properties["meander"].fixed_type.properties.keys():
        assert page_of(f"bpy.types.meandersettings.{name}")
    assert page_of("bpy.types.meandersettings.mask_group") == pages.address_of("surfaces")
    assert page_of("bpy.types.meandersettings.bevel_share") == pages.address_of("look")
    assert page_of("bpy.types.meandersettings.live") == pages.address_of("live")
    assert page_of("bpy.types.meandersettings.spacing") == pages.address_of("settings")
    assert page_of("bpy.ops.meander.two_tone") == pages.address_of("making")
    assert page_of("bpy.ops.meander.bake_motion") == pages.address_of("motion")
    assert page_of("bpy.ops.meander.run") == pages.address_of("index")


@pytest.mark.parametrize("name", SHIPPED)
def test_every_preset_fills_a_plane(name):
    """Also Rows, whose axis may stand straight up from it."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=8, y_subdivisions=8, size=2)
    plane = bpy.context.active_object
    plane.meander.spacing = 0.2
    bpy.ops.meander.use_preset(filepath=str(presets.SHIPPED / f"{name}.py"))
    assert bpy.ops.meander.run() == {"FINISHED"}
    figures = plane.meander.last_result.meander.figures
    assert figures.stop_reason in {"converged", "iteration_limit"} and figures.lines == 1
