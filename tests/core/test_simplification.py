# SPDX-License-Identifier: GPL-3.0-or-later
"""Light curves: near the whole one by brute force, no crossings by counting them, continuable."""

from __future__ import annotations

import json
import time

import geometry
import numpy as np
import pytest
from conftest import polylines
from flows import flow_on
from meander import batch, core
from meander.model.files import obj
from meander.model.geometry import simplification, thinning
from meander.model.geometry.simplification import Light
from sentences import assert_sentence


def between(begin, end):
    """Places along pieces, their ends among them."""
    return np.vstack([begin + share * (end - begin) for share in np.linspace(0.0, 1.0, 5)])


def crossings(begin, end, up):
    """How often pieces cross that share no end, seen along `up`, (3,) or (n, 3), by brute force."""
    count = 0
    turned = np.cross(up, end - begin)  # to the left of each piece
    for index in range(len(begin)):
        a, b, c, d = begin[index], end[index], begin[index + 1 :], end[index + 1 :]
        left = turned[index]
        sides = ((c - a) @ left) * ((d - a) @ left)
        others = turned[index + 1 :]
        across = ((a - c) * others).sum(axis=1) * ((b - c) * others).sum(axis=1)
        near = np.linalg.norm((c + d - a - b) / 2, axis=1)
        reach = (np.linalg.norm(d - c, axis=1) + np.linalg.norm(b - a)) / 2
        count += int(((sides < 0) & (across < 0) & (near < reach)).sum())
    return count


@pytest.mark.parametrize(
    ("name", "share"), [("icosphere", 0.01), ("grid", 0.01), ("grid", 0.25), ("torus", 0.25)]
)
def test_a_light_curve_is_near_the_whole_one_and_crosses_nothing(model, name, share):
    grown = model(name)
    spacing = 2.0 * grown.radius
    kept = simplification.light_points(grown.curve, Light(share), spacing)
    light = thinning.with_points(grown.curve, kept)
    assert (np.diff(kept) > 0).all() and light.closed.tolist() == grown.curve.closed.tolist()
    assert np.isin(grown.curve.offsets[:-1], kept).all()
    assert len(kept) < (0.5 if share < 0.1 else 0.12) * len(grown.curve.positions)
    whole, few = geometry.ends_of(grown.curve), geometry.ends_of(light)
    tolerance = share * spacing * (1.0 + 1e-9)
    assert geometry.distance_to_pieces(between(*whole)[::5], *few).max() <= tolerance
    assert geometry.distance_to_pieces(between(*few)[::5], *whole).max() <= tolerance
    up = few[0] if name == "icosphere" else np.array([0.0, 0.0, 1.0])
    if name != "torus":  # which has no direction from which nothing hides anything
        assert crossings(*few, up) == 0


def test_a_spiral_into_which_another_is_wound_stays_one():
    """Two strands side by side around one another: pulled straight they would cross."""
    angle = np.linspace(0.0, 20.0 * np.pi, 2000)
    strands = []
    for phase in (0.0, np.pi):
        out = 0.05 + 0.02 * angle / (2.0 * np.pi)
        strands.append(
            np.column_stack([out * np.cos(angle + phase), out * np.sin(angle + phase), 0 * angle])
        )
    whole = polylines(*((strand, False) for strand in strands))
    up = np.array([0.0, 0.0, 1.0])
    rough = [(strand[simplification.kept_within(strand, False, 0.03)], False) for strand in strands]
    assert crossings(*geometry.ends_of(polylines(*rough)), up) > 0
    light = thinning.with_points(whole, simplification.light_points(whole, Light(0.03), 1.0))
    assert crossings(*geometry.ends_of(light), up) == 0
    assert len(light.positions) < 1000


def test_a_limit_finds_its_tolerance(model):
    grown = model("icosphere")
    spacing, count = 2.0 * grown.radius, len(grown.curve.positions)
    for limit in (count // 3, count // 8):
        kept = simplification.light_points(grown.curve, Light(0.0, limit), spacing)
        assert 0.8 * limit < len(kept) <= limit
    # One that cannot be kept takes the greatest tolerance.
    fewest = simplification.light_points(grown.curve, Light(0.0, 3), spacing)
    greatest = Light(simplification.GREATEST_SHARE)
    assert (fewest == simplification.light_points(grown.curve, greatest, spacing)).all()
    # One that is kept anyway changes nothing.
    easy = simplification.light_points(grown.curve, Light(0.01, count), spacing)
    assert (easy == simplification.light_points(grown.curve, Light(0.01), spacing)).all()


def test_what_is_small_or_straight_keeps_its_kind():
    ring = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]) * 1e-3
    line = np.linspace([0.0, 0, 5], [9.0, 0, 5], 400)
    for scale in (1e-9, 1.0, 1e9):
        whole = polylines((ring * scale, True), (line * scale, False))
        kept = simplification.light_points(whole, Light(0.25), scale)
        light = thinning.with_points(whole, kept)
        assert np.diff(light.offsets).tolist() == [3, 2]
        assert light.positions[-1].tolist() == whole.positions[-1].tolist()


def test_two_hundred_thousand_points_take_less_than_a_second():
    turn = np.linspace(0.0, 2.0 * np.pi, 51)[:-1]
    rows = np.arange(4000)[:, None]
    x = np.where(rows % 2, np.pi - turn / 2, turn / 2)
    y = rows * 0.1 + 0.01 * np.sin(4.0 * x)
    line = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    begin = time.process_time()
    kept = simplification.light_points(polylines((line, False)), Light(0.01), 0.1)
    assert time.process_time() - begin < 4.0  # room for a machine a quarter as fast
    assert len(kept) < 0.5 * len(line)


def test_the_flow_goes_on_from_a_light_curve(model):
    for name in ("icosphere", "torus"):
        grown = model(name)
        for share in (0.01, 0.1):
            kept = simplification.light_points(grown.curve, Light(share), 2.0 * grown.radius)
            light = thinning.with_points(grown.curve, kept)
            seed = core.Seed(light.positions, light.offsets, light.closed)
            with flow_on(grown.mesh, seed=seed, radius=grown.radius, iteration_limit=1) as flow:
                flow.run()
                figures = flow.statistics()
            assert figures["crossings"] == 0
            assert figures["length"] == pytest.approx(grown.statistics["length"], rel=0.04)


def test_the_command_writes_light_curves(tmp_path):
    geometry.write_obj(tmp_path / "ball.obj", geometry.icosphere(3))

    def run(name, *extra):
        given = ["--input", tmp_path / "ball.obj", "--output", tmp_path / name, "--spacing", "0.3"]
        given += ["--quiet", "--report", tmp_path / "report.json", *extra]
        assert batch.main([str(item) for item in given]) == 0
        return json.loads((tmp_path / "report.json").read_text())

    whole = run("whole.obj")
    assert whole["points"]["all"] == whole["points"]["written"]
    assert whole["options"]["light"] is None
    record = run("light.obj", "--light", "0.02")
    assert record["options"]["light"] == 0.02
    assert record["points"]["written"] < 0.4 * record["points"]["all"]
    light = obj.read_obj_curve(tmp_path / "light.obj")
    assert len(light.points) == record["points"]["written"]
    every = {tuple(point) for point in obj.read_obj_curve(tmp_path / "whole.obj").points}
    assert {tuple(point) for point in light.points} <= every
    few = run("few.json", "--point-limit", "200")
    assert few["points"]["written"] <= 200


@pytest.mark.parametrize("name", ["few.obj", "few.csv", "few.gcode"])
def test_a_point_limit_that_no_tolerance_holds_is_said(tmp_path, capsys, name):
    geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(4))
    given = ["--input", tmp_path / "sheet.obj", "--output", tmp_path / name, "--spacing", "0.3"]
    given += ["--quiet", "--report", tmp_path / "report.json", "--point-limit"]
    top = ["--layout", "top"] if name.endswith("gcode") else []
    assert batch.main([str(item) for item in [*given, "3", *top]]) == 0
    record = json.loads((tmp_path / "report.json").read_text())
    (warning,) = record["warnings"]
    assert warning.startswith(f"{record['points']['written']:,} points are left")
    assert warning in capsys.readouterr().err
    assert_sentence(warning)
    limit = record["points"]["written"]
    assert batch.main([str(item) for item in [*given, limit, *top]]) == 0
    assert json.loads((tmp_path / "report.json").read_text())["warnings"] == []
    assert capsys.readouterr().err == ""
