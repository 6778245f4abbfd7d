# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on as Blender sees it: registering, the manifest, what the panel shows."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from types import SimpleNamespace

import bpy
import meander
import pytest
from meander.run import estimate, session
from meander.run.lasting import lasting
from meander.run.plan import plan_run
from meander.ui import alignment, density, look, panels, strands, terms
from meander.ui import fill as run_operators
from scenes import activate, cube, fill, poly_curve, sphere
from watched_runs import begin, tick_until


class Layout:
    """Takes every call of a layout, notes what is shown, and checks that it exists."""

    def __init__(self, shown: list[str]) -> None:
        self.shown = shown

    def prop(self, data, name, text=None, **_options) -> None:
        if name.startswith("["):  # a custom property, such as an input of a modifier's group
            data.path_resolve(name)
            self.shown.append(text)
            return
        known = data.bl_rna.properties[name]
        self.shown.append(known.name if text is None else text)

    def prop_search(self, data, name, source, items, text=None, **_options) -> None:
        assert hasattr(source, items)
        self.prop(data, name, text)

    def template_ID(self, data, name, text=None, **_options) -> None:
        self.prop(data, name, text)

    def template_color_ramp(self, data, name, **_options) -> None:
        assert isinstance(getattr(data, name), bpy.types.ColorRamp)

    def operator(self, idname, text=None, **_options) -> SimpleNamespace:
        kind, name = idname.split(".")
        label = getattr(getattr(bpy.ops, kind), name).get_rna_type().name
        self.shown.append(label if text is None else text)
        return SimpleNamespace()

    def popover(self, panel, text=None, **_options) -> None:
        known = getattr(bpy.types, panel)
        self.shown.append(known.bl_label if text is None else text)

    def label(self, text="", **_options) -> None:
        self.shown.append(text)

    def progress(self, text="", **_options) -> None:
        self.shown.append(text)

    def _nested(self, **_options) -> Layout:
        return Layout(self.shown)

    row = column = split = box = _nested


def draw(panel: type[bpy.types.Panel]) -> list[str] | None:
    """What a panel shows now; None if it is hidden."""
    if hasattr(panel, "poll") and not panel.poll(bpy.context):
        return None
    shown: list[str] = []

    class Drawn:
        layout = Layout(shown)

        def __getattr__(self, name):
            return getattr(panel, name).__get__(self)

    panel.draw(Drawn(), bpy.context)
    return shown


def test_registering_twice():
    meander.unregister()
    assert not hasattr(bpy.types.Object, "meander")
    meander.register()
    meander.unregister()
    meander.register()
    assert hasattr(bpy.types.Object, "meander")


def test_manifest_and_bl_info_say_the_same():
    folder = Path(meander.__file__).parent
    manifest = tomllib.loads((folder / "blender_manifest.toml").read_text())
    assert manifest["version"] == ".".join(map(str, meander.bl_info["version"]))
    assert manifest["name"] == meander.bl_info["name"]
    assert len(manifest["tagline"]) <= 64
    assert not manifest["tagline"].endswith(".")
    assert meander.bl_info["blender"] == (3, 4, 0)


def test_labels_and_tooltips_follow_the_guidelines():
    settings = sphere().meander
    for name, item in settings.bl_rna.properties.items():
        if name in {"rna_type", "name", "figures"}:
            continue
        assert item.description, name
        assert not item.description.endswith("."), name
        assert item.name == item.name.title().replace("Uv", "UV"), name


def test_panel_without_a_mesh_says_what_to_do():
    assert draw(panels.MEANDER_PT_main) == ["Select a mesh to fill"]
    activate(poly_curve("Any", [[(0, 0, 0), (1, 0, 0)]], False))
    assert draw(panels.MEANDER_PT_main)[:2] == ["'Any' has no faces; give", "it a bevel or an"]
    assert draw(density.MEANDER_PT_density) is None


def test_panel_on_a_mesh():
    cube()
    shown = draw(panels.MEANDER_PT_main)
    assert {"Cube", "Spacing", "Fill with Curve"} <= set(shown)
    assert draw(panels.MEANDER_PT_figures) is None
    # What is greyed says why.
    assert {"Group", "No vertex groups"} <= set(draw(density.MEANDER_PT_density))
    assert "Quality" in draw(panels.MEANDER_PT_advanced)
    assert "Seed" in draw(strands.MEANDER_PT_strands)
    assert {"Thickness", "Profile"} <= set(draw(look.MEANDER_PT_look))


def test_density_panel_shows_what_its_source_needs():
    settings = cube().meander
    for source, label in (
        ("GROUP", "Group"),
        ("ATTRIBUTE", "Attribute"),
        ("COLOR", "Color"),
        ("IMAGE", "UV Map"),
        ("CURVATURE", "Smoothing"),
    ):
        settings.density_source = source
        shown = draw(density.MEANDER_PT_density)
        assert {"Source", label, "Of the spacing", "At Low", "At High", "Ramp"} <= set(shown)
    settings.density_source = "NONE"
    assert draw(density.MEANDER_PT_density) == ["Source"]


def test_alignment_panel_shows_what_its_source_needs():
    settings = cube().meander
    assert draw(alignment.MEANDER_PT_alignment) == ["Along"]
    for source, label in (
        ("AXIS", "Space"),
        ("CURVATURE", "Smoothing"),
        ("SMOOTH", "Strength"),
        ("STROKES", "Curves"),
        ("UV", "UV Map"),
        ("ATTRIBUTE", "Attribute"),
    ):
        settings.alignment_source = source
        assert {label, "Strength", "Across"} <= set(draw(alignment.MEANDER_PT_alignment))


def test_weights_panel_warns_of_what_is_seldom_meant():
    settings = cube().meander
    quiet = draw(terms.MEANDER_PT_weights)
    assert {"Custom", "Stiffness", "Detail", "Sight", "Start Wide"} <= set(quiet)
    settings.segment_share = 0.9
    warned = draw(terms.MEANDER_PT_weights)
    assert len(warned) > len(quiet)
    assert all(len(line) <= 36 for line in warned)
    assert "0.45 of the spacing" in " ".join(warned) and warned[-1].endswith("0.2.")


def test_panel_on_a_result():
    fill(cube(), 0.5)
    shown = draw(panels.MEANDER_PT_main)
    assert {"Cube", "Continue", "Fill Again"} <= set(shown)
    shown = draw(panels.MEANDER_PT_figures)
    assert shown[0] == "One closed line" and shown[1] == "Even" and shown[2].endswith(" %")
    live = {"Profile", "Radius", "Resolution", "Lift", "By Spacing", "Solid View"}
    assert live <= set(draw(look.MEANDER_PT_look))
    result = activate(bpy.context.active_object)
    surface = activate(result.meander.surface)
    assert {"Fill Again", "New Curve"} <= set(draw(panels.MEANDER_PT_main))
    assert live | {""} <= set(draw(look.MEANDER_PT_look))
    activate(result).modifiers.clear()
    assert {"Radius", "Add Live Look"} <= set(draw(look.MEANDER_PT_look))
    bpy.data.objects.remove(result)
    activate(surface)
    assert "Thickness" in draw(look.MEANDER_PT_look)


@pytest.mark.parametrize("system", ["NONE", "METRIC", "IMPERIAL"])
def test_figures_in_all_units(system):
    bpy.context.scene.unit_settings.system = system
    fill(cube(), 0.5)
    assert draw(panels.MEANDER_PT_figures)


def test_panel_while_running(monkeypatch):
    cube()
    plan = plan_run(bpy.context)
    monkeypatch.setattr(lasting, "session", session.Session(plan))
    shown = draw(panels.MEANDER_PT_main)
    assert "Stop Filling" in shown and "Fill with Curve" not in shown
    assert not bpy.ops.meander.run.poll()
    assert bpy.ops.meander.stop.poll()


def test_panel_after_esc(windowed):
    surface = sphere()
    running = begin(surface, 0.05)
    tick_until(running, lambda: running.latest and running.latest.iterations > 0)
    running.suspend()
    shown = draw(panels.MEANDER_PT_main)
    assert "Fill with Curve" in shown
    assert [text for text in shown if text.startswith("Continue at ")]
    surface.meander.spacing = 0.2
    assert not [text for text in draw(panels.MEANDER_PT_main) if text.startswith("Continue")]


def test_three_verbs_say_what_they_keep(windowed):
    """Once there is a curve, on it and on its mesh: it goes on, is replaced, or stays."""
    result = fill(sphere(), 0.5)
    surface = result.meander.surface
    kept = {
        (result, (("restart", False),)): "keeps its strands",
        (result, (("restart", True),)): "keeps the looks",
        (surface, (("restart", False),)): "keeps the looks",
        (surface, (("beside", True),)): "leaves the curve",
    }
    for (thing, options), says in kept.items():
        activate(thing)
        given = {"restart": False, "beside": False, **dict(options)}
        tip = run_operators.MEANDER_OT_run.description(bpy.context, SimpleNamespace(**given))
        assert says in tip, tip
    assert "keeps all" in run_operators.MEANDER_OT_resume.bl_description
    activate(result)
    result.meander.spacing = 0.05
    running = session.Session(plan_run(bpy.context))
    running.start(bpy.context)
    tick_until(running, lambda: running.latest and running.latest.iterations > 0)
    running.suspend()
    # A run that was ended goes on, in the place of one that would begin anew from the same curve.
    shown = draw(panels.MEANDER_PT_main)
    buttons = [text for text in shown if text.startswith(("Continue", "Fill", "New"))]
    assert buttons[0].startswith("Continue at ") and buttons[1:] == ["Fill Again", "New Curve"]


def test_panel_says_what_to_expect():
    surface = cube()
    surface.meander.spacing = 0.1
    estimate.measure(surface)
    (line,) = (text for text in draw(panels.MEANDER_PT_main) if "points" in text)
    assert re.fullmatch(r"[\d,]+ points, \d+ \w+, \d+ MB", line), line
    # The sidebar of Blender's default width has room for so many characters.
    assert len(line) < 33


def test_menu_entry():
    assert bpy.ops.meander.run.get_rna_type().name == "Fill with Curve"
    assert any(
        getattr(entry, "__module__", "") == "meander.ui.menu"
        for entry in bpy.types.VIEW3D_MT_object._dyn_ui_initialize()
    )
