# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines and arcs in place of points: near the curve both ways, few, and the same in every format,
as readers of these formats see them."""

from __future__ import annotations

import re
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch
from meander.model.geometry.arcs import Moves, fitted
from meander.model.toolpaths import toolpath
from meander.model.toolpaths.drawing import Drawing
from meander.model.toolpaths.dxf import dxf_pieces
from meander.model.toolpaths.gcode import Motion, gcode_pieces
from meander.model.toolpaths.svg import svg_pieces

UP = [0.0, 0.0, 1.0]


def smooth(rng: np.random.Generator, count: int) -> np.ndarray:
    """A closed way of a few waves around a circle of radius 30."""
    angles = np.linspace(0.0, 2.0 * np.pi, count + 1)
    radii = 30.0 + sum(
        rng.uniform(-4, 4) * np.sin(k * angles + rng.uniform(0, 6)) for k in range(1, 6)
    )
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])


def between(way: np.ndarray, count: int) -> np.ndarray:
    shares = np.linspace(0.0, 1.0, count, endpoint=False)
    return (way[:-1, None] + shares[:, None] * np.diff(way, axis=0)[:, None]).reshape(-1, 2)


@pytest.mark.parametrize("number", range(4))
@pytest.mark.parametrize("tolerance", [0.3, 0.02])
def test_arcs_are_near_the_curve_and_the_curve_near_them(number: int, tolerance: float) -> None:
    way = smooth(np.random.default_rng(number), 700)
    moves = fitted(way, tolerance)
    flat = moves.flattened(1e-4)
    assert geometry.farthest(between(way, 4), flat) <= tolerance + 1e-4
    assert geometry.farthest(flat, way) <= tolerance + 1e-4
    assert np.array_equal(moves.ends[-1], way[-1]) and np.array_equal(moves.start, way[0])
    assert len(moves.ends) < len(way) / 5
    assert np.abs(moves.turns).max() < np.pi


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_what_is_a_line_or_a_circle_is_found(scale: float) -> None:
    angles = np.linspace(-np.pi / 2, np.pi / 2, 40)
    track = np.vstack(
        [
            np.column_stack([np.linspace(0.0, 9.0, 30), np.zeros(30)]),
            np.column_stack([10.0 + 2 * np.cos(angles), 2.0 + 2 * np.sin(angles)]),
            np.column_stack([np.linspace(9.0, 0.0, 30), np.full(30, 4.0)]),
        ]
    )
    moves = fitted(scale * track, scale * 0.01)
    assert len(moves.ends) <= 5
    radii = moves.radii[moves.turns != 0]
    assert len(radii) and np.allclose(radii, 2.0 * scale, rtol=0.02)
    assert np.abs(moves.turns).sum() == pytest.approx(np.pi, rel=0.05)


@pytest.mark.parametrize("tolerance", [1e-300, 1e-12, 0.0])
def test_no_tolerance_is_too_small_for_chords(tolerance: float) -> None:
    half = Moves(np.array([1.0, 0.0]), np.array([[-1.0, 0.0]]), np.zeros((1, 2)), np.array([np.pi]))
    places = half.flattened(tolerance)
    assert 100 < len(places) < 3000
    middles = (places[:-1] + places[1:]) / 2.0
    assert (np.linalg.norm(middles, axis=1) > 1.0 - 1e-6).all()


def test_corners_and_repeated_points_are_kept() -> None:
    rng = np.random.default_rng(3)
    for way in (
        rng.uniform(0, 9, (200, 2)),
        np.repeat(rng.uniform(0, 9, (50, 2)), 2, axis=0),
        np.array([(0, 0), (1, 0), (0, 0), (1, 0)], dtype=float),
    ):
        moves = fitted(way, 1e-3)
        flat = moves.flattened(1e-5)
        assert geometry.farthest(way, flat) <= 1e-3 + 1e-5
        assert geometry.farthest(flat, way) <= 1e-3 + 1e-5


@pytest.fixture
def drawing() -> Drawing:
    rng = np.random.default_rng(9)
    ways = [smooth(rng, 500)[:-1], smooth(rng, 300)[40:260] + [80.0, 0.0]]
    strands = [
        toolpath.strand_of(
            np.column_stack([w - [-50, -50], np.zeros(len(w))]), np.tile(UP, (len(w), 1)), k == 0
        )
        for k, w in enumerate(ways)
    ]
    return Drawing(strands, "mm", True, 1.0).with_arcs(0.05)


def test_g_code_is_the_same_way(drawing: Drawing) -> None:
    for relative in (False, True):
        text = "".join(gcode_pieces(drawing, Motion(tool="laser", relative=relative), "a", "1"))
        at, now, found = np.zeros(2), False, []
        for line in text.splitlines():
            line = line.split(";")[0]
            values = {k: float(v) for k, v in re.findall(r"([A-Z])(-?[\d.]+)", line)}
            code = line.split(" ")[0]
            now = now or code == "G91"
            if code == "G0":
                found.append([])
            if code not in ("G0", "G1", "G2", "G3"):
                continue
            end = np.array([values["X"], values["Y"]]) + (at if now else 0.0)
            if code in ("G2", "G3"):
                centre = at + [values["I"], values["J"]]
                one, two = np.linalg.norm(at - centre), np.linalg.norm(end - centre)
                assert abs(one - two) < 1e-3  # what a controller checks
                first, last = (np.arctan2(*(p - centre)[::-1]) for p in (at, end))
                turn = (last - first) % (2 * np.pi)
                turn = turn if code == "G3" else turn - 2 * np.pi
                angles = first + turn * np.linspace(0, 1, 60)
                around = np.column_stack([np.cos(angles), np.sin(angles)])
                found[-1] += (centre + one * around).tolist()
            found[-1].append(end.tolist())
            at = end
        assert len(found) == 2
        for places, moves in zip(found, drawing.moves):
            assert geometry.farthest(np.array(places), moves.flattened(1e-4)) < 2e-3
            assert geometry.farthest(moves.flattened(1e-2), np.array(places)) < 2e-2


def test_an_svg_file_is_the_same_way(drawing: Drawing) -> None:
    svgpathtools = pytest.importorskip("svgpathtools")
    text = "".join(svg_pieces(drawing, 0.3, "a", "1"))
    low, high = drawing.box()
    for data, moves in zip(re.findall(r' d="([^"]+)"', text), drawing.moves):
        path = svgpathtools.parse_path(data)
        assert any(isinstance(piece, svgpathtools.Arc) for piece in path)
        places = np.array([piece.point(t) for piece in path for t in np.linspace(0, 1, 40)])
        flat = np.column_stack([places.real + low[0] - 0.3, high[1] + 0.3 - places.imag])
        assert geometry.farthest(flat, moves.flattened(1e-4)) < 5e-3
        assert geometry.farthest(moves.flattened(1e-2), flat) < 5e-2


def test_a_dxf_file_is_the_same_way(drawing: Drawing, tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    from ezdxf import path as ezdxf_path

    file = tmp_path / "a.dxf"
    file.write_text("".join(dxf_pieces(drawing)), encoding="ascii")
    found = list(ezdxf.readfile(file).modelspace().query("POLYLINE"))
    assert len(found) == 2 and found[0].is_closed and not found[1].is_closed
    for polyline, moves in zip(found, drawing.moves):
        assert any(vertex.dxf.bulge for vertex in polyline.vertices)
        places = np.array([(p.x, p.y) for p in ezdxf_path.make_path(polyline).flattening(1e-3)])
        assert geometry.farthest(places, moves.flattened(1e-4)) < 5e-3
        assert geometry.farthest(moves.flattened(1e-2), places) < 5e-2


def test_files_with_arcs_are_a_fifth_as_long(tmp_path: Path, capsys) -> None:
    mesh = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(8))
    for suffix in ("svg", "dxf", "gcode"):
        sizes = []
        for arcs in ((), ("--arcs", "0.2")):
            out = tmp_path / f"a.{suffix}"
            given = ["--input", mesh, "--output", out, "--spacing", "0.06", "--size", "100"]
            given += ["--layout", "top", "--quiet", *arcs]
            assert batch.main([str(a) for a in given]) == 0
            sizes.append(out.stat().st_size)
        assert sizes[1] < sizes[0] / 4
        assert capsys.readouterr().err == ""  # nothing crosses
    given = ["--input", mesh, "--output", tmp_path / "b.gcode", "--spacing", "0.2", "--quiet"]
    given += ["--size", "100", "--arcs", "0.1"]
    assert batch.main([str(a) for a in given]) == 2
    assert "give a --layout that is flat" in capsys.readouterr().err
