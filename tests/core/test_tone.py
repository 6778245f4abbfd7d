# SPDX-License-Identifier: GPL-3.0-or-later
"""Tone on surfaces: shares of ink, a line that has them, and the light of lamps."""

from __future__ import annotations

import json
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch
from meander.model import density, lighting
from meander.model.picture import tone

PEN = 0.04
# Away from the border, by the middles of six columns.
COLUMNS = np.linspace(0.0, 2.0, 7)


def sheet(path: Path, coded: np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
    """Twice as wide as high; colours of its vertices in sRGB as OBJ files have them."""
    points, faces = geometry.rectangle((0.0, 0.0), (2.0, 1.0), 40, 20)
    grey = np.tile(coded, 21) if coded is not None else np.ones(len(points))
    rows = [f"v {p[0]:.6g} {p[1]:.6g} 0 {g:.5f} {g:.5f} {g:.5f}" for p, g in zip(points, grey)]
    rows += ["f {} {} {}".format(*(face + 1)) for face in faces]
    path.write_text("\n".join([*rows, ""]))
    return points, faces


def ink_in_columns(strands: list[np.ndarray]) -> np.ndarray:
    """The share of ink by length alone."""
    found = np.zeros(len(COLUMNS) - 1)
    for points in strands:
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        middles = (points[1:, 0] + points[:-1, 0]) / 2
        found += np.histogram(middles, COLUMNS, weights=steps)[0]
    return found * PEN / np.diff(COLUMNS)


def test_the_command_draws_the_tone_of_colours(tmp_path: Path) -> None:
    coded = np.linspace(0.15, 0.75, 41)
    path, out, report = (tmp_path / name for name in ("a.obj", "out.json", "report.json"))
    sheet(path, coded)
    words = ("--input", path, "--tone-color", "rgb", "--pen", PEN, "--tone", "value",
             "--start", "full", "--output", out, "--report", report, "--quiet")  # fmt: skip
    assert batch.main([str(word) for word in words]) == 0
    strands = []
    for strand in json.loads(out.read_text())["strands"]:
        points = np.array(strand["points"])
        strands.append(np.vstack([points, points[:1]]) if strand["closed"] else points)
    wanted = 1.0 - np.interp((COLUMNS[1:] + COLUMNS[:-1]) / 2, np.linspace(0, 2, 41), coded)
    # By length, without what lies outside of the first strand.
    assert ink_in_columns(strands)[1:-1] == pytest.approx(wanted[1:-1], rel=0.06)
    options = json.loads(report.read_text())["options"]
    assert options["tone_color"] == "rgb" and options["tone"] == "value"
    assert options["pen"] == pytest.approx(PEN) and options["spacing"] == pytest.approx(2 * PEN)


@pytest.mark.parametrize("kind", tone.TONES)
def test_shares_fall_with_the_light_and_stay_within_the_pen(kind: str) -> None:
    light = np.linspace(-0.1, 1.2, 200)
    share = density.shares_of_ink(light, tone.Tone(kind))
    assert (np.diff(share) <= 0.0).all()
    assert share.max() == pytest.approx(0.9) and share.min() == pytest.approx(0.06)


def test_a_light_line_has_the_share_that_is_bright() -> None:
    light = np.linspace(0.1, 0.85, 50)
    dark, bright = (
        density.shares_of_ink(light, tone.Tone("light", negative=negative))
        for negative in (False, True)
    )
    assert np.allclose(dark, 1.0 - light) and np.allclose(bright, light)
    assert (np.diff(density.shares_of_ink(light, tone.Tone(negative=True))) > 0.0).all()


def test_levels_become_the_darkest_and_the_lightest() -> None:
    ends = tone.light_of(np.array([20.0, 70.0]))
    share = density.shares_of_ink(ends, tone.Tone(), tuple(ends))
    assert share == pytest.approx([0.9, 0.06])


def test_a_density_has_the_spacing_of_the_pen_over_the_darkness() -> None:
    light = np.linspace(0.2, 0.9, 30)
    for spacing in (0.1, 0.2):
        found = density.tone_density(light, tone.Tone("light"), 0.03 / spacing)
        assert spacing / np.sqrt(found) == pytest.approx(0.03 / (1.0 - light))


# ------------------------------------------------------------------------------------------------
# Lamps


UP = np.array([0.0, 0.0, 1.0])


def everything(_points: np.ndarray, _towards: np.ndarray, far: np.ndarray) -> np.ndarray:
    return np.ones(len(far), dtype=bool)


def lit(points: list, normals: list, lamp: lighting.Lamp, reaches=everything) -> np.ndarray:
    places, facing = np.array(points, float), np.array(normals, float)
    return lighting.light_on(places, facing, [lamp], 0.0, reaches)


def test_a_sun_of_pi_makes_white_what_faces_it() -> None:
    sun = lighting.Lamp("sun", np.pi, np.zeros(3), -UP)
    tilted = [0.0, np.sin(1.0), np.cos(1.0)]
    found = lit([[0, 0, 0]] * 3, [UP, tilted, -UP], sun)
    assert found == pytest.approx([1.0, np.cos(1.0), 0.0])


def test_a_point_lamp_fades_with_the_square_of_the_distance() -> None:
    lamp = lighting.Lamp("point", 100.0, 3.0 * UP, UP)
    found = lit([[0, 0, 0], [0, 0, 1]], [UP, UP], lamp)
    assert found == pytest.approx([100 / (4 * np.pi**2 * 9), 100 / (4 * np.pi**2 * 4)])


def test_a_far_area_is_four_points_and_has_a_back() -> None:
    sides = np.array([[0.1, 0, 0], [0, 0.1, 0]])
    area = lighting.Lamp("area", 100.0, 20.0 * UP, -UP, sides=sides)
    point = lighting.Lamp("point", 400.0, 20.0 * UP, UP)
    places, normals = [[0, 0, 0], [0, 0, 40]], [UP, -UP]
    found = lit(places, normals, area)
    assert found[0] == pytest.approx(lit(places, normals, point)[0], rel=1e-3) and found[1] == 0.0


def test_a_spot_has_an_edge() -> None:
    spot = lighting.Lamp("spot", 100.0, 2.0 * UP, -UP, cosine=np.cos(0.5), blend=0.2)
    ring = [[2 * np.tan(angle), 0, 0] for angle in (0.0, 0.45, 0.49, 0.55)]
    found = lit(ring, [UP] * 4, spot)
    assert (np.diff(found) < 0.0).all() and found[3] == 0.0


def test_shadows_are_asked_for_the_way_to_the_lamp() -> None:
    asked = []

    def reaches(points: np.ndarray, towards: np.ndarray, far: np.ndarray) -> np.ndarray:
        asked.append((points + far[:, None] * towards, far))
        return points[:, 0] > 0.0

    lamp = lighting.Lamp("point", 100.0, np.array([0.0, 0.0, 2.0]), UP)
    found = lit([[-1, 0, 0], [1, 0, 0]], [UP, UP], lamp, reaches)
    assert found[0] == 0.0 < found[1]
    assert asked[0][0] == pytest.approx(np.tile(lamp.place, (2, 1)))
    quiet = lighting.Lamp("point", 100.0, lamp.place, UP, casts=False)
    assert lit([[-1, 0, 0]], [UP], quiet, reaches)[0] == found[1]
