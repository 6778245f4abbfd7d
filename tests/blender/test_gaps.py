# SPDX-License-Identifier: GPL-3.0-or-later
"""Show Gaps: the places that a run has left empty, stored with the result and selected."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from meander.run import result as result_of_run
from meander.ui import operators, panels
from scenes import activate, cube, fill, grid, matrix_of, poly_curve, sphere, world_splines
from test_addon import draw

# Stopped this early, a curve leaves much of the surface empty.
EARLY = 40


def stopped_early(surface: bpy.types.Object) -> bpy.types.Object:
    return fill(surface, 0.2, iteration_limit=EARLY)


def selected(result: bpy.types.Object) -> np.ndarray:
    """For every point of the splines, whether it is selected, as Edit Mode has it."""
    result.update_from_editmode()
    return np.array([point.select for spline in result.data.splines for point in spline.points])


def world_points(result: bpy.types.Object) -> np.ndarray:
    return np.vstack([points for points, _cyclic in world_splines(result)])


def world_gaps(result: bpy.types.Object) -> np.ndarray:
    matrix = matrix_of(result)
    local = np.array([gap.position[:] for gap in result.meander.figures.gaps])
    return local @ matrix[:3, :3].T + matrix[:3, 3]


def messages(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What the operator reports, which bpy.ops does not return."""
    told: list[str] = []
    original = operators.MEANDER_OT_show_gaps.execute

    class Recorder:
        def __init__(self, operator):
            self._operator = operator

        def report(self, _kind, text: str) -> None:
            told.append(text)

    monkeypatch.setattr(
        operators.MEANDER_OT_show_gaps,
        "execute",
        lambda self, context: original(Recorder(self), context),
    )
    return told


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_points_around_every_gap_are_selected(monkeypatch, mode):
    surface = grid()
    surface.scale = (1.0, 2.0, 1.0)
    surface.rotation_euler = (0.5, 0.6, 0.7)
    surface.location = (1.0, 2.0, 3.0)
    result = stopped_early(surface)
    gaps, points = world_gaps(result), world_points(result)
    assert len(gaps)
    told = messages(monkeypatch)
    bpy.ops.object.mode_set(mode=mode)
    assert bpy.ops.meander.show_gaps() == {"FINISHED"}
    assert result.mode == "EDIT"
    chosen = selected(result)
    assert 0 < chosen.sum() < len(chosen)
    near = np.zeros(len(points), dtype=bool)
    for gap in gaps:
        distance = np.linalg.norm(points - gap, axis=1)
        assert chosen[distance.argmin()]
        near |= distance <= 1.3 * distance.min()
    assert not np.any(chosen & ~near)
    assert f"{len(gaps)} gaps" in told[-1]
    bpy.ops.object.mode_set(mode="OBJECT")


def test_sizes_are_distances_over_half_the_spacing():
    result = stopped_early(grid())
    figures = result.meander.figures
    sizes = [gap.size for gap in figures.gaps]
    assert sizes == sorted(sizes, reverse=True) and min(sizes) >= 1.2 - 1e-6
    assert figures.largest_gap == pytest.approx(sizes[0])
    assert figures.gap_count == len(sizes)
    points = world_points(result)
    for gap, size in zip(world_gaps(result), sizes, strict=True):
        # Points are up to 0.4 r apart.
        assert np.linalg.norm(points - gap, axis=1).min() / 0.1 == pytest.approx(size, rel=0.03)


def test_a_selection_made_before_is_gone():
    result = stopped_early(sphere())
    for spline in result.data.splines:
        spline.points.foreach_set("select", np.ones(len(spline.points), dtype=bool))
    assert bpy.ops.meander.show_gaps() == {"FINISHED"}
    assert not selected(result).all()
    bpy.ops.object.mode_set(mode="OBJECT")


def test_without_gaps_a_plain_message(monkeypatch):
    result = fill(cube(), 0.5)
    figures = result.meander.figures
    figures.gaps.clear()
    figures.gap_count = 0
    told = messages(monkeypatch)
    assert bpy.ops.meander.show_gaps() == {"CANCELLED"}
    assert result.mode == "OBJECT"
    assert told == [f"{result.name}: the last run left no gaps"]
    shown = draw(panels.MEANDER_PT_figures)
    assert "None" in shown and "Show Gaps" not in shown


def test_the_panel_names_the_largest():
    surface = sphere()
    result = stopped_early(surface)
    figures = result.meander.figures
    shown = draw(panels.MEANDER_PT_figures)
    assert f"{figures.gap_count:,}" in shown
    assert f"{figures.largest_gap:.2f}" in shown
    assert "Show Gaps" in shown
    # The surface has the figures of the run, but no points to select.
    activate(surface)
    assert figures.gap_count == surface.meander.figures.gap_count
    assert len(surface.meander.figures.gaps) == 0
    shown = draw(panels.MEANDER_PT_figures)
    assert "Gaps" in shown and "Show Gaps" not in shown


def test_only_on_results():
    assert not bpy.ops.meander.show_gaps.poll()
    activate(sphere())
    assert not bpy.ops.meander.show_gaps.poll()
    activate(poly_curve("Any", [[(0, 0, 0), (1, 0, 0)]], False))
    assert not bpy.ops.meander.show_gaps.poll()
    result = stopped_early(cube())
    assert bpy.ops.meander.show_gaps.poll()
    result.hide_set(True)
    assert not bpy.ops.meander.show_gaps.poll()


def test_gaps_are_saved_with_the_file(tmp_path):
    result = stopped_early(sphere())
    name, gaps = result.name, world_gaps(result)
    path = str(tmp_path / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.open_mainfile(filepath=path)
    result = activate(bpy.data.objects[name])
    assert np.array_equal(world_gaps(result), gaps)
    assert bpy.ops.meander.show_gaps() == {"FINISHED"}
    assert selected(result).any()
    bpy.ops.object.mode_set(mode="OBJECT")


def test_going_on_replaces_the_gaps():
    result = stopped_early(sphere())
    before = result.meander.figures.largest_gap
    result.meander.iteration_limit = 200
    assert bpy.ops.meander.run() == {"FINISHED"}
    after = result.meander.figures
    assert after.largest_gap < min(before, 1.6)
    assert len(after.gaps) == after.gap_count


def test_of_many_gaps_the_largest_are_kept(monkeypatch):
    monkeypatch.setattr(result_of_run, "MOST_GAPS", 2)
    result = stopped_early(grid())
    figures = result.meander.figures
    assert figures.gap_count > 2 == len(figures.gaps)
    told = messages(monkeypatch)
    assert bpy.ops.meander.show_gaps() == {"FINISHED"}
    assert f"2 of {figures.gap_count} gaps" in told[-1]
    bpy.ops.object.mode_set(mode="OBJECT")


def test_the_tooltip_follows_the_guidelines():
    text = bpy.ops.meander.show_gaps.get_rna_type().description
    assert text and not text.endswith(".") and "  " not in text
