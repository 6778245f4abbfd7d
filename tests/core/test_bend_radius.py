# SPDX-License-Identifier: GPL-3.0-or-later
"""The sharpest bend of a curve: of circles and helices it is known."""

from __future__ import annotations

import json
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch, core
from meander.model.least_bend import sharpest_bend


def polylines(*ways: np.ndarray, closed: bool) -> core.Polylines:
    points = np.concatenate(ways)
    offsets = np.cumsum([0] + [len(way) for way in ways]).astype(np.uint32)
    flags = np.full(len(ways), closed, dtype=np.uint8)
    return core.Polylines(points, np.zeros_like(points), offsets, flags)


def circle(radius: float, count: int = 2000, pitch: float = 0.0) -> np.ndarray:
    t = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    return np.column_stack([radius * np.cos(t), radius * np.sin(t), pitch * t])


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_circles_and_helices(scale: float) -> None:
    bend = sharpest_bend(polylines(scale * circle(2.0), scale * circle(0.7), closed=True), scale)
    assert bend.radius == pytest.approx(0.7 * scale, rel=1e-3) and bend.strand == 1
    helix = sharpest_bend(polylines(scale * circle(2.0, pitch=1.5), closed=False), scale)
    assert helix.radius == pytest.approx(scale * (4.0 + 1.5**2) / 2.0, rel=0.01)


def test_a_straight_line_does_not_bend_and_a_short_one_has_no_arc() -> None:
    line = np.column_stack([np.linspace(0, 9, 50), np.zeros(50), np.zeros(50)])
    assert sharpest_bend(polylines(line, closed=False), 1.0).radius > 1e6
    assert sharpest_bend(polylines(line[:2], closed=False), 1.0) is None


def test_where_it_is() -> None:
    """Two straight pieces joined by a quarter circle of radius 0.5 around (5, 0.5)."""
    t = np.linspace(-np.pi / 2, 0.0, 100)
    turn = np.column_stack([5.0 + 0.5 * np.cos(t), 0.5 + 0.5 * np.sin(t), np.zeros(100)])
    way = np.vstack([[(0, 0, 0)], turn, [(5.5, 6, 0)]])
    bend = sharpest_bend(polylines(way, closed=False), 0.4)
    assert bend.radius == pytest.approx(0.5, rel=0.02)
    assert np.linalg.norm(bend.place - [5.35, 0.15, 0.0]) < 0.3
    back = np.array([(0, 0, 0), (3, 0, 0), (0, 0, 0.0)])
    assert sharpest_bend(polylines(back, closed=False), 1.0).radius < 0.2


def test_the_report_has_it(tmp_path: Path) -> None:
    mesh = geometry.write_obj(tmp_path / "ball.obj", geometry.icosphere(3))
    report = tmp_path / "r.json"
    radii = []
    for stiffness in ("0", "3"):
        given = ["--input", mesh, "--output", tmp_path / "a.obj", "--spacing", "0.4", "--quiet"]
        given += ["--report", report, "--bending", stiffness]
        assert batch.main([str(a) for a in given]) == 0
        bend = json.loads(report.read_text())["bend"]
        assert np.linalg.norm(bend["place"]) == pytest.approx(1.0, abs=0.02)
        radii.append(bend["least_radius"])
    assert 0.005 < radii[0] < radii[1] < 1.0  # stiffness makes turns wider; a ball bends all
