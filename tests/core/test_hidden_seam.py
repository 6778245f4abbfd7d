# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetry whose strands cross the plane instead of running along it, judged by brute force."""

from __future__ import annotations

import json
from pathlib import Path

import geometry
import numpy as np
import pytest
import test_mirror
from flows import options_of
from meander import core
from meander.model.geometry.half_mesh import section
from meander.model.geometry.reflection import mirror_of
from meander.model.opening import open_flow
from meander.model.problem import Problem, begin_along_directions
from sentences import assert_sentence
from test_mirror import Filled, assert_nothing_is_left_empty, bumpy, command, on_sheet, sheet

# Farther from the plane than this, in spacings, nothing differs from the image of the other half.
ALIKE = 7.0


def filled(mesh: geometry.Mesh, spacing: float, hide: bool = True, **changes) -> Filled:
    """A run with symmetry to its end, as the panel and the command begin it."""
    mirror = mirror_of("x", None, hide)
    return test_mirror.filled(mesh, spacing, mirror, begin_along_directions, **changes)


def seam(run: Filled) -> float:
    """Along which share of the plane, where it meets the surface, a strand runs beside it: abreast,
    within a spacing, and turned by less than 30 degrees."""
    spacing, curve = run.spacing, run.curve
    lines = section(run.mesh.vertices, run.mesh.faces, run.mirror.heights(run.mesh.vertices))
    sides = lines[:, 1] - lines[:, 0]
    lengths = np.linalg.norm(sides, axis=1)
    pieces = geometry.pieces_of(curve.offsets, curve.closed)
    begins, ends = curve.positions[pieces[:, 0]], curve.positions[pieces[:, 1]]
    ways = ends - begins
    ways /= np.maximum(np.linalg.norm(ways, axis=1), 1e-12)[:, None]
    middles = (begins + ends) / 2.0
    beside = 0.0
    for begin, side, length in zip(lines[:, 0], sides, lengths, strict=True):
        count = int(np.ceil(5.0 * length / spacing))
        for k in range(count):
            place, along = begin + (k + 0.5) / count * side, side / length
            apart = middles - place
            near = (apart * apart).sum(axis=1) < spacing**2
            near &= np.abs(apart @ along) < 0.25 * spacing
            near &= np.abs(ways @ along) > np.cos(np.radians(30.0))
            beside += length / count * bool(near.any())
    return float(beside / lengths.sum())


MODELS = {"ball": (geometry.icosphere(4), 0.12), "bumpy": (bumpy(4), 0.08)}


@pytest.fixture(scope="module", params=MODELS)
def run(request: pytest.FixtureRequest) -> Filled:
    return filled(*MODELS[request.param])


def test_it_is_one_closed_line_that_crosses_nothing(run: Filled) -> None:
    assert run.curve.closed.tolist() == [1]
    assert run.crossings() == []
    assert run.figures["joined"] == 1 and run.figures["why"] is None
    size = np.linalg.norm(np.ptp(run.mesh.vertices, axis=0))
    assert geometry.off_surface(run.mesh, run.curve.positions).max() < 1e-9 * size


def test_strands_cross_the_plane_instead_of_running_along_it(run: Filled) -> None:
    """Plain, nine tenths of the plane have a strand along them."""
    assert seam(run) < 0.2
    heights = run.heights()
    sides = np.sign(heights[np.abs(heights) > 1e-9 * run.spacing])
    count = np.count_nonzero(sides != np.roll(sides, -1))
    assert count == run.figures["crossings"]
    around = 2.0 * np.pi * np.abs(run.mesh.vertices[:, 1:]).max()
    assert count > 0.7 * around / run.spacing


def test_it_is_measured_by_what_is_seen() -> None:
    assert seam(filled(*MODELS["bumpy"], hide=False)) > 0.8


def test_strands_cross_at_right_angles(run: Filled) -> None:
    curve = run.curve
    heights, after = run.heights(), np.roll(run.heights(), -1)
    begins = np.flatnonzero((heights > 0.0) != (after > 0.0))
    ways = curve.positions[(begins + 1) % len(heights)] - curve.positions[begins]
    rise = np.abs(ways @ run.mirror.normal) / np.linalg.norm(ways, axis=1)
    assert np.median(rise) > np.cos(np.radians(10.0))


def test_the_halves_differ_only_beside_the_plane(run: Filled) -> None:
    curve = run.curve
    far = np.abs(run.heights()) > ALIKE * run.spacing
    assert far.sum() > 200
    images = run.mirror.images(curve.positions[far])[::7]
    samples = geometry.samples_of(curve.positions, curve.offsets, curve.closed, run.spacing / 30)
    assert geometry.distance_to_samples(images, samples).max() < 0.03 * run.spacing


def test_nothing_is_left_empty(run: Filled) -> None:
    assert_nothing_is_left_empty(run)


def test_the_same_bytes_for_any_number_of_threads() -> None:
    curves = [filled(bumpy(3), 0.16, threads=threads).curve for threads in (1, 2, 1)]
    assert curves[0].positions.tobytes() == curves[1].positions.tobytes()
    assert curves[0].positions.tobytes() == curves[2].positions.tobytes()


def test_a_filled_line_goes_on_as_one_line(run: Filled) -> None:
    curve = run.curve
    seed = core.Seed(curve.positions, curve.offsets, curve.closed)
    for hide in (True, False):
        after = filled(run.mesh, 1.1 * run.spacing, hide, seed=seed)
        assert after.curve.closed.tolist() == [1] and after.crossings() == []
        assert after.figures["joined"] == 1


def test_directions_that_are_given_are_kept() -> None:
    along = np.tile([0.0, 1.0, 0.0], (len(sheet().vertices), 1))
    run = filled(sheet(), 0.1, directions=along, alignment_weight=2.0)
    ways = np.diff(run.curve.positions, axis=0)
    share = np.abs(ways[:, 1]).sum() / np.linalg.norm(ways, axis=1).sum()
    assert share > 0.7


def test_rows_lead_to_the_plane_whatever_options_a_run_takes_on_its_way() -> None:
    """As Live has it take others, which know nothing of the plane."""
    options = options_of(radius=0.1, alignment_weight=1.0)
    ball = bumpy(3)
    along = np.tile([0.0, 1.0, 0.0], (len(ball.vertices), 1))
    for directions, weight in ((None, None), (along, 1.0)):
        mirror = mirror_of("x", None, True)
        problem = Problem(
            ball.vertices, ball.faces, options, mirror=mirror, directions=directions
        )
        with (opened := open_flow(problem)).flow:
            held = opened.problem.options.alignment_weight
            assert opened.part.options_of(options).alignment_weight == held
            assert weight is None or held == weight


def test_guides_and_open_strands_stay_as_they_are() -> None:
    guide = [(0.3, -0.5), (0.3, 0.5)]
    run = filled(sheet(), 0.12, seed=on_sheet(guide, closed=False, guide=True))
    assert run.guides.sum() == 2 and run.crossings() == []
    run = filled(sheet(), 0.2, seed=on_sheet([(0.3, 0.1), (0.6, 0.3)], closed=False))
    assert run.curve.closed.tolist() == [0, 0] and run.crossings() == []


def test_the_command_hides_the_seam(tmp_path: Path) -> None:
    options = ("--spacing", 0.2, "--mirror", "x", "--hide-seam")
    assert command(tmp_path, bumpy(4), *options) == 0
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["options"]["hide_seam"] is True and report["mirror"]["crossings"] > 10
    assert report["lines"]["closed"] == report["lines"]["count"] == 1 and report["crossings"] == 0


def test_the_command_wants_a_plane(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    assert command(tmp_path, bumpy(3), "--hide-seam") == 2
    assert_sentence(capsys.readouterr().err.strip().removeprefix("meander: "))
