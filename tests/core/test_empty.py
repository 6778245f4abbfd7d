# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run leaves empty: the figures by samples of the surface, and what the command says."""

from __future__ import annotations

import ast
import json
import re
from pathlib import Path

import geometry
import numpy as np
import pytest
from conftest import PACKAGE
from flows import flow_on
from meander import batch, core
from meander.cli import command
from meander.cli.place import Place
from meander.model import start
from meander.model.empty import Empty, empty_of, narrow_remark, percent, remark
from meander.model.options.presets import PRESETS
from sentences import assert_sentence

# Samples of a strip, and cells of the search, are about .2 r apart.
SAMPLED = 0.01


def strip(length: float, width: float, pieces: int) -> geometry.Mesh:
    """A flat strip along x of so many quads."""
    return geometry.rectangle((0.0, 0.0), (length, width), pieces, 1)


def gaps_after(
    mesh: tuple[np.ndarray, np.ndarray], radius: float, steps: int, seed: core.Seed | None = None
) -> tuple:
    with flow_on(mesh, seed=seed, radius=radius) as flow:
        for _ in range(steps):
            flow.step()
        return flow.gaps(), flow.polylines()


@pytest.mark.parametrize("pieces", [1, 40])
def test_the_share_is_that_of_samples(pieces: int) -> None:
    radius = 0.05
    gaps, curve = gaps_after(strip(8.0, 0.4, pieces), radius, 12)
    x, y = np.meshgrid(np.arange(0.005, 8.0, 0.01), np.arange(0.005, 0.4, 0.01))
    samples = np.column_stack([x.ravel(), y.ravel()])
    points = curve.positions[:, :2]
    far = np.ones(len(samples), dtype=bool)
    for point in points:
        far &= np.linalg.norm(samples - point, axis=1) > 1.6 * radius
    assert gaps.empty_share == pytest.approx(far.mean(), abs=SAMPLED)
    assert far.mean() > 0.1 and gaps.narrow_share == 0.0


def test_what_is_narrower_than_a_spacing_counts_by_itself() -> None:
    """A strip by its width, a pipe by its girth; a curve has no room for its way back there. Where
    nothing is drawn both are filled at once, so a stroke in their first face begins to grow."""

    def stroke(mesh: tuple[np.ndarray, np.ndarray]) -> core.Seed:
        corners = mesh[0][mesh[1][0]]
        ends = np.stack([corners.mean(axis=0), 0.5 * (corners.mean(axis=0) + corners[0])])
        return core.Seed(ends, np.array([0, 2], np.uint32), np.zeros(1, np.uint8))

    for mesh in (strip(6.0, 0.08, 30), geometry.tube(8, 30, 6.0, 0.013)):
        gaps, _curve = gaps_after(mesh, 0.05, 3, stroke(mesh))
        assert gaps.narrow_share > 0.8 and gaps.empty_share == 0.0
        assert np.all(gaps.narrow)
    for mesh in (strip(6.0, 0.13, 30), geometry.tube(8, 30, 6.0, 0.022)):
        gaps, _curve = gaps_after(mesh, 0.05, 3, stroke(mesh))
        assert gaps.empty_share > 0.8 and gaps.narrow_share < 0.01


def test_the_points_of_sharp_corners_are_narrow() -> None:
    """A line half a spacing from both sides of a corner of 60 degrees turns a spacing from its
    point, where the surface is narrower than one; in a corner of 90 degrees it comes nearer."""
    radius, height = 0.05, 0.5 * np.sqrt(3.0)
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, height, 0.0]])
    mesh = corners, np.array([[0, 1, 2]], dtype=np.uint32)
    options = core.default_options()
    options.radius = radius
    with core.Surface(*mesh) as surface:
        flow = core.Flow(surface, options)
    with flow:
        assert flow.run() == "converged"
        gaps, curve = flow.gaps(), flow.polylines()
    # Samples of a corner, and which of them are farther than 1.6 r from the line.
    step = 0.001
    x, y = np.meshgrid(np.arange(0.5 * step, 0.04, step), np.arange(0.5 * step, 0.04, step))
    samples = np.column_stack([x.ravel(), y.ravel()])
    samples = samples[samples[:, 1] < np.sqrt(3.0) * samples[:, 0]]
    far = 0.0
    ends = np.roll(curve.positions, -1, axis=0)
    line = np.vstack([curve.positions + k / 20 * (ends - curve.positions) for k in range(20)])
    for corner, inward in zip(corners, (0.0, 2.0 * np.pi / 3.0, 4.0 * np.pi / 3.0)):
        turn = np.array([[np.cos(inward), np.sin(inward)], [-np.sin(inward), np.cos(inward)]])
        places = samples @ turn + corner[:2]
        near = line[np.linalg.norm(line - corner, axis=1) < 0.2, :2]
        distance = np.linalg.norm(places[:, None] - near, axis=2).min(axis=1)
        far += step**2 * np.count_nonzero(distance > 1.6 * radius)
    assert far / (0.5 * height) > 0.0005
    assert gaps.empty_share + gaps.narrow_share == pytest.approx(far / (0.5 * height), rel=0.3)
    assert gaps.narrow_share > 2 * gaps.empty_share
    at_corner = np.linalg.norm(gaps.positions[:, None] - corners, axis=2).min(axis=1) < 0.1 * radius
    assert at_corner.sum() >= 2 and np.all(gaps.narrow[at_corner])


def test_a_filled_surface_is_not_empty() -> None:
    mesh = geometry.icosphere(3)
    with flow_on(mesh, radius=0.12) as flow:
        assert flow.run() == "converged"
        empty = empty_of(flow.gaps())
    assert empty.share == empty.narrow == 0.0 and not empty.matters


def test_bodies_in_one_another_are_empty_each_by_itself() -> None:
    """The strand of one body covers nothing of another that it runs through."""
    ball = geometry.icosphere(3)
    vertices = np.vstack([ball.vertices, ball.vertices + [0.3, 0.0, 0.0]])
    faces = np.vstack([ball.faces, ball.faces + np.uint32(len(ball.vertices))])
    turns = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    ring = np.column_stack([0.0 * turns, np.cos(turns), np.sin(turns)])
    seed = core.Seed(ring, np.array([0, 40], np.uint32), np.ones(1, np.uint8), max_distance=0.05)
    flow = flow_on((vertices, faces), seed=seed, radius=0.12)
    with flow:
        flow.run()
        gaps = flow.gaps()
    assert gaps.empty_share == pytest.approx(0.5, abs=SAMPLED)
    assert np.all(gaps.faces[gaps.sizes > 1.6] >= len(ball.faces))


def test_the_search_for_gaps_can_be_cancelled() -> None:
    flow = flow_on(geometry.icosphere(3), radius=0.12)
    with flow, core.Context() as context:
        flow.step()
        context.cancel()
        with pytest.raises(core.MeanderError) as refusal:
            flow.gaps(context=context)
        assert refusal.value.status == core.Status.CANCELLED


# ------------------------------------------------------------------------------------------------
# What is said


def test_what_is_empty_is_said_with_its_place_and_what_helps() -> None:
    helps = ("raise --iterations", "begin full", "choose a smaller spacing")
    empty = Empty(0.56, 0.0, 28.0, (71.5, 0.2, 0.0))
    said = remark(empty, "converged", helps)
    assert "56 % of the surface is empty" in said and "(71.5, 0.2, 0)" in said
    assert said.endswith("begin full")
    assert remark(empty, "iteration_limit", helps).endswith("raise --iterations")
    assert remark(empty, "converged", ("", "", helps[2])).endswith(helps[2])
    assert remark(Empty(0.0009, 0.5), "converged", helps) == ""
    assert narrow_remark(Empty(0.0, 0.0009)) == ""
    assert "3 % of the surface is narrower than a spacing" in narrow_remark(Empty(0.0, 0.03))
    assert percent(0.0021) == "0.2 %"


def test_how_a_run_began_is_said() -> None:
    figures = {"start_full_parts": 9, "start_grown_parts": 3, "start_no_room_parts": 3}
    assert start.entry(figures, True)["why"] == [
        "3 parts: no line has room, as where the surface is narrower than two spacings"
    ]
    assert start.remark(figures).startswith("3 of 12 parts have grown instead of beginning full")
    assert start.notice(figures) == "3 parts grew, not full: no room"
    assert start.remark({}) == start.notice({"start_full_parts": 2}) == ""
    assert start.entry({}, False) == {
        "asked": "grow", "full_parts": 0, "grown_parts": 0, "completed_parts": 0, "why": [],
    }  # fmt: skip


def test_presets_are_those_of_the_panel() -> None:
    """Each sets what its file does, and leaves the rest at its default, as the file does."""
    files = {file.stem: file for file in (PACKAGE / "presets" / "meander").glob("*.py")}
    known = {"Even", "As_Published", *(name.title().replace("-", "_") for name in PRESETS)}
    assert set(files) == known
    for name, preset in PRESETS.items():
        text = files[name.title().replace("-", "_")].read_text(encoding="utf-8")
        written = dict(re.findall(r"settings\.(\w+) = (.+)", text))
        for setting, value in preset.items():
            said = ast.literal_eval(written[setting])
            assert (said.lower() if isinstance(said, str) else said) == value, (name, setting)
        if written["use_weights"] == "False":
            assert not {"length_weight", "bending_weight", "medial_power"} & set(preset)
        for setting in ("start", "start_spacing_factor", "medial_axis", "alignment_source"):
            unsaid = {"PRESET", "NONE", "1.0"}
            assert setting in preset or written[setting].strip('"') in unsaid, (name, setting)


# ------------------------------------------------------------------------------------------------
# The command


def run(folder: Path, mesh: Path, *extra: str) -> tuple[int, list[str], dict]:
    said: list[str] = []
    given = ["--input", str(mesh), "--output", str(folder / "o.obj"), "--report"]
    code = command.main([*given, str(folder / "o.json"), *extra], Place("meander", said.append))
    return code, said, json.loads((folder / "o.json").read_text())


def test_gaps_fail_where_that_is_asked_for(tmp_path: Path, capsys) -> None:
    mesh = geometry.write_obj(tmp_path / "ball.obj", geometry.icosphere(3))
    short = ("--spacing", "0.15", "--iterations", "4")
    code, said, report = run(tmp_path, mesh, *short)
    assert code == 0 and report["empty"]["share"] > 0.3
    assert any("raise --iterations" in line for line in said)
    assert any("of the surface empty" in line for line in said[-2:])
    capsys.readouterr()
    code, said, report = run(tmp_path, mesh, *short, "--fail-on-gaps")
    assert code == 3 and report["options"]["fail_on_gaps"] is True
    error = capsys.readouterr().err.strip()
    assert_sentence(error.removeprefix("meander: "))
    assert "% of the surface is empty" in error
    assert report["empty"]["largest"] > 0.075 and len(report["empty"]["where"]) == 3
    code, _said, report = run(tmp_path, mesh, "--spacing", "0.3", "--fail-on-gaps")
    assert code == 0 and report["empty"]["share"] < 0.001 and report["start"]["asked"] == "grow"


def test_what_is_no_surface_has_no_spacing_to_speak_of(tmp_path: Path, capsys) -> None:
    mesh = tmp_path / "line.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
    assert batch.main(["--input", str(mesh), "--output", str(tmp_path / "o.obj")]) == 2
    said = capsys.readouterr().err.splitlines()
    assert len(said) == 1 and "No face of the mesh has an area" in said[0]


def test_the_spacing_is_automatic(tmp_path: Path) -> None:
    ball = geometry.icosphere(3)
    mesh = geometry.write_obj(tmp_path / "ball.obj", ball)
    code, said, report = run(tmp_path, mesh, "--iterations", "2")
    assert code == 0
    spacing = core.automatic_spacing(ball.vertices, ball.faces)
    assert spacing == float(f"{np.sqrt(report['surface']['area']) / 30:.1e}") == 0.12
    assert report["options"]["spacing"] == spacing and report["options"]["spacing_is_automatic"]
    assert said[0].startswith("meander: the spacing is 0.12, which is automatic")
    first = (tmp_path / "o.obj").read_bytes()
    code, said, report = run(tmp_path, mesh, "--iterations", "2", "--spacing", "0.12")
    assert (tmp_path / "o.obj").read_bytes() == first
    assert not report["options"]["spacing_is_automatic"] and "automatic" not in said[0]


def test_a_flow_without_a_radius_takes_the_automatic_one(caplog) -> None:
    ball = geometry.icosphere(3)
    with core.Surface(*ball) as surface, caplog.at_level("INFO", "meander"):
        flow = core.Flow(surface, core.default_options())
    with flow:
        target = flow.statistics()["spacing_target"]
        assert target == pytest.approx(core.automatic_spacing(*ball), rel=1e-9)
    (record,) = caplog.records
    assert_sentence(record.getMessage())


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        (("flowing",), {"preset": "even", "start": core.Start.FULL}),
        (("rows",), {"start": core.Start.FULL, "alignment_weight": 2.0, "direction": "axis",
                     "across": True}),
        (("rows", "--direction", "x", "--alignment", "3"),
         {"alignment_weight": 3.0, "direction": "x", "across": False}),
        (("rows", "--start", "grow"), {"start": core.Start.GROW}),
        (("few-corners",), {"preset": "finest", "start_spacing_factor": 4.0}),
        (("organic", "--length", "2"),
         {"preset": "paper", "length_weight": 2.0, "medial_power": 4.0}),
    ],
)  # fmt: skip
def test_quality_knows_the_presets_of_the_panel(tmp_path: Path, given, expected) -> None:
    mesh = geometry.write_obj(tmp_path / "sheet.obj", strip(1.0, 1.0, 4))
    code, _said, report = run(
        tmp_path, mesh, "--iterations", "2", "--spacing", "0.2", "--quality", *given
    )
    assert code == 0
    found = {name: report["options"][name] for name in expected}
    assert found == {
        name: value.name.lower() if isinstance(value, core.Start) else value
        for name, value in expected.items()
    }
    assert report["options"]["quality"] == given[0]
