# SPDX-License-Identifier: GPL-3.0-or-later
"""The tab Meander in every state: every text fits into the sidebar as it is first opened.

The states are those of one setting after the other: every choice of every list, every switch both
ways, on a mesh, in Edit Mode, on a result, and while a curve grows.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import bpy
from meander import core
from meander.model.estimate import Remaining
from meander.run import estimate
from meander.ui.panels import MEANDER_PT_main
from panel_layout import drawn, panels, texts_of
from scenes import activate, cube, fill
from watched_runs import begin, tick_until


def excesses(state: str) -> Iterator[str]:
    for panel in panels():
        layout = drawn(panel, bpy.context)
        for text in layout.texts() if layout is not None else ():
            if text.excess > 0.0:
                yield f"{panel.bl_label}: {text.text!r} by {text.excess:.0f} pixels ({state})"


def of_every_setting(settings: bpy.types.PropertyGroup) -> Iterator[str]:
    yield from excesses("as it is")
    for known in settings.bl_rna.properties:
        before = getattr(settings, known.identifier)
        if known.type == "ENUM":
            values = [item.identifier for item in known.enum_items]
        elif known.type == "BOOLEAN":
            values = [not before]
        else:
            continue
        for value in values:
            setattr(settings, known.identifier, value)
            yield from excesses(f"{known.identifier} {value}")
        setattr(settings, known.identifier, before)


def one_each(found: Iterator[str]) -> list[str]:
    """Of a text that is too wide in many states, the first."""
    return sorted({line.partition(" (")[0]: line for line in reversed(list(found))}.values())


def test_every_text_fits_on_a_mesh():
    surface = cube()
    found = list(of_every_setting(surface.meander))
    bpy.ops.object.mode_set(mode="EDIT")
    found += excesses("in Edit Mode")
    bpy.ops.object.mode_set(mode="OBJECT")
    surface.meander.problem.kind = "face"
    surface.meander.figures.empty_parts = 2
    found += excesses("refused")
    assert not one_each(found), "\n".join(one_each(found))


def test_every_text_fits_on_a_result():
    result = fill(cube(), 0.5, use_bevel=True)
    found = list(of_every_setting(result.meander))
    figures = result.meander.figures
    figures.lines, figures.closed_lines, figures.wide_gaps = 1234, 0, 1234
    for reason in ("converged", "iteration_limit", "stalled", "cancelled"):
        figures.stop_reason = reason
        found += excesses(reason)
    activate(None)
    found += excesses("nothing active")
    assert not one_each(found), "\n".join(one_each(found))


def test_every_text_fits_while_a_curve_grows(windowed):
    surface = cube()
    surface.meander.spacing = 0.0
    found = list(excesses("automatic spacing"))
    estimate.measure(surface)
    running = begin(surface, 0.05)
    for phase in core.PHASES:
        tick_until(running, lambda: running.shown_points > 0)
        latest = running.latest
        running.latest = replace(latest, phase=phase, nodes=1_234_567, length=12345.678)
        running._remaining = Remaining()
        running._remaining.note(0.0, 0.0)
        running._remaining.note(5400.0, 0.51)
        assert "min" in running.left_text()
        found += excesses(phase)
    running.suspend()
    found += excesses("suspended")
    surface.meander.spacing = 0.0004
    found += excesses("a large run")
    assert not one_each(found), "\n".join(one_each(found))


def shown_below(parent: str) -> list[str]:
    """The labels of the panels that stand there now, from top to bottom."""
    found = [panel for panel in panels() if getattr(panel, "bl_parent_id", "") == parent]
    found = [panel for panel in found if drawn(panel, bpy.context) is not None]
    return [panel.bl_label for panel in sorted(found, key=lambda panel: panel.bl_order)]


def test_the_panels_are_few_and_in_the_order_of_use():
    surface = cube()
    assert shown_below("MEANDER_PT_main") == ["Look", "Guidance", "Output", "Advanced"]
    fill(surface, 0.5, use_bevel=True)
    assert shown_below("MEANDER_PT_main") == ["Last Run", "Look", "Guidance", "Output", "Advanced"]
    assert shown_below("MEANDER_PT_look") == ["Along the Line"]
    guidance = ["Density", "Seed and Strands", "Direction", "Region"]
    assert shown_below("MEANDER_PT_guidance") == guidance
    assert shown_below("MEANDER_PT_output") == ["Motion", "Make", "Export"]
    assert shown_below("MEANDER_PT_advanced") == ["Strand Shape", "Mesh Repair"]
    for panel in panels():
        if panel.bl_label not in ("Meander", "Last Run", "Draw Seed"):
            assert "DEFAULT_CLOSED" in panel.bl_options, panel.bl_label


def test_what_counts_in_halves_of_the_spacing_is_shown_in_spacings():
    result = fill(cube(), 0.5, density_smoothing=3.0, reach=5.0)
    settings = result.meander
    assert settings.density_smoothing_in_spacings == 1.5 and settings.reach_in_spacings == 2.5
    settings.segment_share_in_spacings = 0.1
    assert abs(settings.segment_share - 0.2) < 1e-6
    for panel in panels():
        layout = drawn(panel, bpy.context)
        for text in layout.texts() if layout is not None else ():
            assert "half" not in text.text.lower() and "power" not in text.text.lower()


def test_a_run_is_named_where_another_object_is_selected(windowed):
    surface, other = cube(), cube()
    surface.name, other.name = "Grows", "Waits"
    running = begin(surface, 0.1)
    tick_until(running, lambda: running.shown_points > 0)
    assert "Waits" not in texts_of(MEANDER_PT_main)
    activate(other)
    found = texts_of(MEANDER_PT_main)
    assert found.index("Waits") < found.index("Grows"), "the progress is under its own name"
    running.end()


def test_several_objects_are_counted():
    surface, other = cube(), cube()
    other.location.x = 5.0
    activate(surface)
    assert "Automatic" in texts_of(MEANDER_PT_main) and "2 objects" not in texts_of(MEANDER_PT_main)
    estimate.measure(surface)
    assert any(text.startswith("Automatic: ") for text in texts_of(MEANDER_PT_main))
    other.select_set(True)
    found = texts_of(MEANDER_PT_main)
    assert "2 objects" in found and "Automatic for each" in found
