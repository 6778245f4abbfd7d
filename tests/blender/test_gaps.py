# SPDX-License-Identifier: GPL-3.0-or-later
"""Show Gaps: the places that a run has left empty, stored with the result and marked."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from meander.run import gaps as gap_marks
from meander.run import result as result_of_run
from meander.ui import gaps as gaps_operator
from meander.ui import panels
from meander.ui.watched import unfilled
from panel_layout import texts_of
from scenes import (
    activate,
    cube,
    fill,
    grid,
    matrix_of,
    points_of,
    poly_curve,
    reopened,
    sphere,
)

# Stopped this early, a curve leaves much of the surface empty.
EARLY = 40


def stopped_early(surface: bpy.types.Object, limit: int = EARLY) -> bpy.types.Object:
    return fill(surface, 0.2, iteration_limit=limit)


def world_gaps(result: bpy.types.Object) -> np.ndarray:
    matrix = matrix_of(result)
    local = np.array([gap.position[:] for gap in result.meander.figures.gaps])
    return local @ matrix[:3, :3].T + matrix[:3, 3]


def messages(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What the operator reports, which bpy.ops does not return."""
    told: list[str] = []
    original = gaps_operator.MEANDER_OT_show_gaps.execute

    class Recorder:
        def __init__(self, operator):
            self._operator = operator

        def report(self, _kind, text: str) -> None:
            told.append(text)

    monkeypatch.setattr(
        gaps_operator.MEANDER_OT_show_gaps,
        "execute",
        lambda self, context: original(Recorder(self), context),
    )
    return told


def data() -> dict:
    """What Show Gaps must leave as it is."""
    return {
        name: len(getattr(bpy.data, name))
        for name in ("objects", "curves", "meshes", "materials", "collections", "node_groups")
    } | {"selected": [thing.name for thing in bpy.context.selected_objects]}


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_gaps_that_matter_are_marked_and_nothing_else_changes(monkeypatch, mode):
    surface = grid()
    surface.scale = (1.0, 2.0, 1.0)
    surface.rotation_euler = (0.5, 0.6, 0.7)
    surface.location = (1.0, 2.0, 3.0)
    result = stopped_early(surface)
    points = points_of(result)
    told = messages(monkeypatch)
    bpy.ops.object.mode_set(mode=mode)
    before = data()
    assert bpy.ops.meander.show_gaps() == {"FINISHED"}
    assert result.mode == mode and data() == before
    assert gap_marks.shown_of(result)
    places, sizes = gap_marks.places(result)
    figures = result.meander.figures
    assert 0 < len(places) == figures.wide_gaps < figures.gap_count
    for place, size in zip(places, sizes, strict=True):
        distance = np.linalg.norm(points - place, axis=1).min()
        assert distance == pytest.approx(size, rel=0.03) and distance > 1.45 * 0.1
    assert f"{len(places)} gaps" in told[-1]
    assert "Hide Gaps" in texts_of(panels.MEANDER_PT_figures)
    assert bpy.ops.meander.show_gaps() == {"FINISHED"}
    assert not gap_marks.shown_of(result) and data() == before
    bpy.ops.object.mode_set(mode="OBJECT")


def test_rings_face_the_viewer_around_their_places():
    generator = np.random.default_rng(4)
    centres, radii = generator.normal(size=(5, 3)), generator.uniform(0.1, 2.0, 5)
    axes, _ = np.linalg.qr(generator.normal(size=(3, 3)))
    right, up = axes[:, 0], axes[:, 1]
    towards = np.cross(right, up)
    corners = gap_marks.rings(centres, radii, right, up).reshape(5, -1, 2, 3)
    away = corners - (centres + radii[:, None] * towards)[:, None, None]
    assert np.allclose(np.linalg.norm(away, axis=3), radii[:, None, None])
    assert np.allclose(away @ towards, 0.0)
    # Each line goes on where the one before has ended, all the way round.
    assert np.array_equal(corners[:, :, 1], np.roll(corners[:, :, 0], -1, axis=1))


def test_sizes_are_distances_over_half_the_spacing():
    result = stopped_early(grid())
    figures = result.meander.figures
    sizes = [gap.size for gap in figures.gaps]
    assert sizes == sorted(sizes, reverse=True) and min(sizes) >= 1.2 - 1e-6
    assert figures.largest_gap == pytest.approx(sizes[0])
    assert figures.gap_count == len(sizes)
    points = points_of(result)
    for gap, size in zip(world_gaps(result), sizes, strict=True):
        # Points are up to 0.4 r apart.
        assert np.linalg.norm(points - gap, axis=1).min() / 0.1 == pytest.approx(size, rel=0.03)


def test_another_spacing_chosen_moves_no_mark():
    result = stopped_early(cube())
    before = gap_marks.places(result)
    result.meander.spacing *= 3.0
    assert all(map(np.array_equal, gap_marks.places(result), before))


def test_without_gaps_a_plain_message(monkeypatch):
    result = fill(cube(), 0.5)
    figures = result.meander.figures
    figures.gaps.clear()
    figures.gap_count = figures.wide_gaps = 0
    told = messages(monkeypatch)
    assert bpy.ops.meander.show_gaps() == {"CANCELLED"}
    assert result.mode == "OBJECT"
    assert told == [f"{result.name}: the last run left no gaps"]
    shown = texts_of(panels.MEANDER_PT_figures)
    assert "Gaps" not in shown and "Show Gaps" not in shown


def test_only_wide_gaps_are_named():
    surface = sphere()
    result = stopped_early(surface, EARLY + 20)
    figures = result.meander.figures
    shown = texts_of(panels.MEANDER_PT_figures)
    assert shown[shown.index("Gaps") + 1] == f"{figures.wide_gaps:,}"
    assert figures.wide_gaps == sum(gap.size > 1.6 for gap in figures.gaps)
    assert "Show Gaps" in shown
    activate(surface)
    assert texts_of(panels.MEANDER_PT_figures) == shown, "a surface shows what its curve does"
    assert bpy.ops.meander.show_gaps() == {"FINISHED"}
    assert gap_marks.shown_of(result)
    gap_marks.hide()


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
    reopened(tmp_path / "saved.blend")
    result = activate(bpy.data.objects[name])
    assert np.array_equal(world_gaps(result), gaps)
    result.meander.figures.wide_gaps = -1  # as results of earlier versions have it
    assert bpy.ops.meander.show_gaps() == {"FINISHED"}
    assert gap_marks.shown_of(result)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert gap_marks.marks.current is None, "another file has no marks"


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
    assert figures.wide_gaps > 2 == len(figures.gaps)
    told = messages(monkeypatch)
    assert bpy.ops.meander.show_gaps() == {"FINISHED"}
    assert f"2 of {figures.wide_gaps} gaps" in told[-1]


def test_the_tooltip_follows_the_guidelines():
    text = bpy.ops.meander.show_gaps.get_rna_type().description
    assert text and not text.endswith(".") and "  " not in text


def test_what_is_empty_is_in_the_row_of_the_gaps():
    """And a surface that is filled has no such row: the panel is as long as it was."""
    result = fill(sphere(), 0.2, iteration_limit=4)
    figures = result.meander.figures
    assert figures.empty_share > 0.1 and figures.narrow_share == 0.0
    activate(result)
    texts = texts_of(panels.MEANDER_PT_figures)
    assert "Empty" in texts and "Gaps" not in texts
    assert f"{100 * figures.empty_share:.0f} % in {figures.wide_gaps:,}" in texts
    figures.empty_share, figures.narrow_share = 0.0, 0.04
    texts = texts_of(panels.MEANDER_PT_figures)
    assert "Too Narrow" in texts and "4 %" in texts and "Gaps" not in texts
    figures.narrow_share = 0.0
    assert "Gaps" in texts_of(panels.MEANDER_PT_figures)


def test_a_run_that_converged_without_filling_says_so():
    figures = fill(sphere(), 0.2, iteration_limit=4).meander.figures
    assert unfilled(figures) == ""  # its end is said already
    figures.stop_reason = "converged"
    assert unfilled(figures).endswith("choose Start: Full, or a smaller spacing")
    figures.empty_share, figures.narrow_share = 0.0, 0.04
    assert "narrower than a spacing" in unfilled(figures)
    figures.narrow_share = 0.0
    assert unfilled(figures) == ""
