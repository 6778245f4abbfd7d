# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on as Blender sees it: registering, the manifest, what the panel shows."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from types import SimpleNamespace

import bpy
import meander
from meander.run import estimate, session
from meander.run.plan import plan_run
from meander.ui import alignment, density, look, panels, strands, terms
from meander.ui import fill as run_operators
from panel_layout import texts_of
from scenes import activate, cube, fill, poly_curve, sphere
from watched_runs import begin, tick_until


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
    assert texts_of(panels.MEANDER_PT_main) == ["Select a mesh to fill"]
    activate(poly_curve("Any", [[(0, 0, 0), (1, 0, 0)]], False))
    assert texts_of(panels.MEANDER_PT_main)[:2] == ["'Any' has no faces; give", "it a bevel or an"]
    assert texts_of(density.MEANDER_PT_density) == []


def test_panel_on_a_mesh():
    cube()
    shown = texts_of(panels.MEANDER_PT_main)
    assert {"Cube", "Spacing", "Fill with Curve"} <= set(shown)
    assert texts_of(panels.MEANDER_PT_figures) == []
    # What is greyed says why.
    assert {"Group", "No vertex groups"} <= set(texts_of(density.MEANDER_PT_density))
    assert "Quality" in texts_of(panels.MEANDER_PT_advanced)
    assert "Seed" in texts_of(strands.MEANDER_PT_strands)
    assert {"Thickness", "Profile"} <= set(texts_of(look.MEANDER_PT_look))


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
        shown = texts_of(density.MEANDER_PT_density)
        assert {"Source", label, "Of the spacing", "At Low", "At High", "Ramp"} <= set(shown)
    settings.density_source = "NONE"
    assert texts_of(density.MEANDER_PT_density) == ["Source", "None"]


def test_alignment_panel_shows_what_its_source_needs():
    settings = cube().meander
    assert texts_of(alignment.MEANDER_PT_alignment) == ["Along", "None"]
    for source, label in (
        ("AXIS", "Space"),
        ("CURVATURE", "Smoothing"),
        ("SMOOTH", "Strength"),
        ("STROKES", "Curves"),
        ("UV", "UV Map"),
        ("ATTRIBUTE", "Attribute"),
    ):
        settings.alignment_source = source
        assert {label, "Strength", "Across"} <= set(texts_of(alignment.MEANDER_PT_alignment))


def test_weights_panel_warns_of_what_is_seldom_meant():
    settings = cube().meander
    quiet = texts_of(terms.MEANDER_PT_weights)
    assert {"Custom", "Stiffness", "Detail", "Sight", "Start Wide"} <= set(quiet)
    settings.segment_share = 0.9
    warned = texts_of(terms.MEANDER_PT_weights)
    assert len(warned) > len(quiet)
    assert all(len(line) <= 36 for line in warned)
    assert "0.45 of the spacing" in " ".join(warned) and warned[-1].endswith("0.2.")


def test_panel_on_a_result():
    fill(cube(), 0.5, use_bevel=True)
    shown = texts_of(panels.MEANDER_PT_main)
    assert {"Cube", "Continue", "Fill Again"} <= set(shown)
    shown = texts_of(panels.MEANDER_PT_figures)
    assert shown[0] == "One closed line" and shown[1] == "Even" and shown[2].endswith(" %")
    live = {"Profile", "Radius", "Resolution", "Lift", "By Spacing", "Solid View"}
    assert live <= set(texts_of(look.MEANDER_PT_look))
    result = activate(bpy.context.active_object)
    surface = activate(result.meander.surface)
    assert {"Fill Again", "New Curve"} <= set(texts_of(panels.MEANDER_PT_main))
    assert live <= set(texts_of(look.MEANDER_PT_look))
    activate(result).modifiers.clear()
    assert {"Radius", "Add Live Look"} <= set(texts_of(look.MEANDER_PT_look))
    bpy.data.objects.remove(result)
    activate(surface)
    assert "Thickness" in texts_of(look.MEANDER_PT_look)


def test_figures_in_all_units():
    fill(cube(), 0.5)
    for system in ("NONE", "METRIC", "IMPERIAL"):
        bpy.context.scene.unit_settings.system = system
        assert texts_of(panels.MEANDER_PT_figures)


def test_panel_while_running(monkeypatch):
    cube()
    plan = plan_run(bpy.context)
    monkeypatch.setattr(session.running, "current", session.Session(plan))
    shown = texts_of(panels.MEANDER_PT_main)
    assert "Stop Filling" in shown and "Fill with Curve" not in shown
    assert not bpy.ops.meander.run.poll()
    assert bpy.ops.meander.stop.poll()


def test_panel_after_esc(windowed):
    surface = sphere()
    running = begin(surface, 0.05)
    tick_until(running, lambda: running.latest and running.latest.iterations > 0)
    running.suspend()
    shown = texts_of(panels.MEANDER_PT_main)
    assert "Fill with Curve" in shown
    assert [text for text in shown if text.startswith("Continue at ")]
    surface.meander.spacing = 0.2
    assert not [text for text in texts_of(panels.MEANDER_PT_main) if text.startswith("Continue")]


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
        given = {"restart": False, "beside": False, "go_on": False, **dict(options)}
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
    shown = texts_of(panels.MEANDER_PT_main)
    buttons = [text for text in shown if text.startswith(("Continue", "Fill", "New"))]
    assert buttons[0].startswith("Continue at ") and buttons[1:] == ["Fill Again", "New Curve"]


def test_panel_says_what_to_expect():
    surface = cube()
    surface.meander.spacing = 0.1
    estimate.measure(surface)
    (line,) = (text for text in texts_of(panels.MEANDER_PT_main) if "points" in text)
    assert re.fullmatch(r"[\d,]+ points, \d+ \w+, \d+ MB", line), line
    # The sidebar of Blender's default width has room for so many characters.
    assert len(line) < 33
