# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panel says can be read and found: lengths, names, what is off and why."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import pytest
from meander.model.estimate import in_words
from meander.run import estimate as estimates
from meander.run import live
from meander.scene import options as flow_options
from meander.scene import preferences
from meander.scene.lengths import length_text
from meander.ui import fill as run_operators
from meander.ui.cut import MEANDER_PT_make
from meander.ui.panels import MEANDER_PT_advanced, MEANDER_PT_figures, MEANDER_PT_main
from meander.ui.points import MEANDER_PT_points
from meander.ui.preferences import MeanderPreferences
from panel_layout import Layout, drawn, panels, texts_of
from scenes import activate, cube, fill, grid
from watched_runs import begin, tick_until


def test_hair_curves_are_off_where_scripts_cannot_make_them():
    fill(grid(), 0.4)
    assert bpy.ops.meander.points_to_mesh.poll()
    assert bpy.ops.meander.points_to_curves.poll() == (bpy.app.version >= (4, 2))


@pytest.mark.parametrize(
    ("system", "unit", "scale", "said"),
    [
        ("METRIC", "METERS", 1.0, "0.09828 m"),
        ("METRIC", "CENTIMETERS", 1.0, "9.828 cm"),
        ("METRIC", "MILLIMETERS", 1.0, "98.28 mm"),
        ("METRIC", "METERS", 0.001, "9.828e-05 m"),
        ("METRIC", "KILOMETERS", 1000.0, "0.09828 km"),
        ("IMPERIAL", "INCHES", 0.0254, '0.09828"'),
        ("IMPERIAL", "FEET", 0.3048, "0.09828'"),
        ("NONE", None, 1.0, "0.09828"),
    ],
)
def test_lengths_are_in_the_unit_of_the_fields(system, unit, scale, said):
    settings = bpy.context.scene.unit_settings
    settings.system, settings.scale_length = system, scale
    if unit is not None:
        settings.length_unit = unit
    assert length_text(bpy.context.scene, 0.098284, 4) == said


def too_wide() -> list[str]:
    every = (drawn(panel, bpy.context) for panel in panels())
    return [
        f"{text.text} by {text.excess:.0f}"
        for layout in every if layout is not None
        for text in layout.texts() if text.excess > 0.0
    ]  # fmt: skip


def test_names_and_counts_are_read_whole():
    """Those that Blender and the add-on give."""
    surface = grid()
    surface.name = "Suzanne.001"
    result = fill(surface, 0.4, use_bevel=True)
    assert result.name == "Suzanne.001 Meander"
    assert too_wide() == []
    activate(surface)
    figures = result.meander.figures
    figures.mended, figures.smoothing = 12918, 0.4
    figures.lines, figures.lines_why = 201, "the mesh has 201 parts, 199 of them smaller than that"
    assert "12,918 repaired" in texts_of(MEANDER_PT_main)
    assert too_wide() == []


def test_the_time_left_is_there_at_once(windowed):
    surface = grid()
    surface.meander.spacing = 0.04
    estimates.measure(surface)
    expected = estimates.shown([surface]).seconds
    running = begin(surface, 0.04)
    try:
        assert running.left_text() == in_words(expected)
        assert running.progress_text().endswith(f"{in_words(expected)} left")
        tick_until(running, lambda: running.progress() > 0.2)
        assert running.left_text()
    finally:
        running.suspend()
        running.end()


def test_export_writes_files_and_make_makes_objects():
    surface = grid()
    assert drawn(MEANDER_PT_points, bpy.context) is None, "there is nothing to export"
    assert {"Light Result", "Tolerance", "Points As"} <= set(texts_of(MEANDER_PT_make))
    assert "Relief" not in texts_of(MEANDER_PT_make)
    fill(surface, 0.4)
    assert texts_of(MEANDER_PT_points) == ["Export Curve", "Write Images", "Draw from Camera"]
    assert {"Relief", "Light Result", "Make Light", "Points As", "Points to Mesh"} <= set(
        texts_of(MEANDER_PT_make)
    )


def test_steps_and_threads_are_in_the_preferences(monkeypatch):
    surface = grid()
    assert not {"Most Steps", "Threads"} & set(texts_of(MEANDER_PT_advanced))
    known = MeanderPreferences.bl_rna.properties.keys()
    assert {"iteration_limit", "threads"} <= set(known)
    own = flow_options.options_of(surface.meander, 0.2)
    monkeypatch.setattr(
        preferences, "_of_the_user", lambda: SimpleNamespace(iteration_limit=17, threads=1)
    )
    options = flow_options.options_of(surface.meander, 0.2)
    assert (options.iteration_limit, options.threads) == (17, 1)
    surface.meander.iteration_limit = 40  # by a script, or in an earlier version
    assert flow_options.options_of(surface.meander, 0.2).iteration_limit == 40
    assert "Most Steps" in texts_of(MEANDER_PT_advanced), "what limits a run can be seen"
    monkeypatch.undo()
    surface.meander.iteration_limit = 0
    assert flow_options.options_of(surface.meander, 0.2) == own
    layout = Layout()
    MeanderPreferences.draw(
        SimpleNamespace(layout=layout, bl_rna=MeanderPreferences.bl_rna, **dict.fromkeys(known, 0)),
        bpy.context,
    )
    assert {"Most Steps", "Threads", "Points"} <= {text.text for text in layout.texts()}


def test_live_begins_no_very_large_curve_where_nothing_is_kept(monkeypatch):
    """As after a run without it, after Esc, and in a file that was opened."""
    surface = grid()
    result = fill(surface, 0.2)
    before = [len(spline.points) for spline in result.data.splines]
    activate(surface)
    monkeypatch.setattr(run_operators, "is_large", lambda estimate: estimate.points > 20_000)
    surface.meander.live, surface.meander.spacing = True, 0.001
    assert bpy.ops.meander.live() == {"CANCELLED"}
    assert "The curve would be very large" in " ".join(texts_of(MEANDER_PT_main))
    assert [len(spline.points) for spline in result.data.splines] == before
    surface.meander.spacing = 0.15
    assert bpy.ops.meander.live() == {"FINISHED"}
    # What is as large already goes on.
    monkeypatch.setattr(run_operators, "is_large", lambda estimate: True)
    live.finished.end()
    surface.meander.spacing = 0.16
    assert bpy.ops.meander.live() == {"FINISHED"}


def test_a_spacing_that_live_refuses_leaves_a_note(monkeypatch):
    surface = grid()
    result = fill(surface, 0.2, live=True)
    before = [len(spline.points) for spline in result.data.splines]
    activate(surface)
    assert "very large" not in " ".join(texts_of(MEANDER_PT_main))
    monkeypatch.setattr(run_operators, "is_large", lambda estimate: estimate.points > 20_000)
    surface.meander.spacing = 0.001
    assert bpy.ops.meander.live() == {"CANCELLED"}
    assert "The curve would be very large" in " ".join(texts_of(MEANDER_PT_main))
    assert too_wide() == []
    surface.meander.spacing = 0.2
    assert "very large" not in " ".join(texts_of(MEANDER_PT_main))
    surface.meander.spacing = 0.001
    assert "very large" in " ".join(texts_of(MEANDER_PT_main)), "it is still so"
    surface.meander.spacing = 0.15
    bpy.ops.meander.live()
    assert "very large" not in " ".join(texts_of(MEANDER_PT_main))
    assert [len(spline.points) for spline in result.data.splines] != before


def test_scripts_get_errors_as_ever():
    surface = grid()
    surface.scale.x = 0.0
    with pytest.raises(RuntimeError, match="scaled to nothing"):
        bpy.ops.meander.run()
    assert "nothing" not in " ".join(texts_of(MEANDER_PT_main))


def test_spacing_and_last_run_have_one_unit():
    surface = cube()
    fill(surface, 0.15, iteration_limit=100)
    activate(surface)
    found = texts_of(MEANDER_PT_figures)
    spacing, length = (found[found.index(name) + 1] for name in ("Median Spacing", "Length"))
    assert spacing.endswith(" m") and length.endswith(" m")
    assert float(spacing[:-2]) == pytest.approx(0.15, rel=0.2)
    assert float(length[:-2]) > 100.0
    surface.meander.spacing = 0.0
    assert not [text for text in texts_of(MEANDER_PT_main) if text.endswith("cm")]
