# SPDX-License-Identifier: GPL-3.0-or-later
"""A brush that is dipped: what it draws is the curve, and it goes on where it was empty."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch
from meander.model.files.whole import FileError
from meander.model.toolpaths.gcode import Motion, gcode_pieces
from test_gcode_tools import Machine, flat_drawing

PALETTE = np.array([-30.0, 12.5, 0.0])
DIPS = {"dip_every": 150.0, "dip_x": -30.0, "dip_y": 12.5}


def drawn(motion: Motion, drawing) -> list[np.ndarray]:
    """What is drawn, and where the brush is dipped, in millimetres."""
    run = Machine(motion.tool).run("".join(gcode_pieces(drawing, motion, "a", "1")), 0.0)
    places = [np.array(place) * drawing.millimetres for place in run.drawn]
    return [p[np.append(True, np.abs(np.diff(p, axis=0)).sum(axis=1) > 0)] for p in places]


def length(way: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(way, axis=0), axis=1).sum())


def is_dip(way: np.ndarray) -> bool:
    return len(way) == 1 and np.allclose(way, PALETTE, atol=1e-3)


@pytest.mark.parametrize("relative", [False, True])
@pytest.mark.parametrize("tool", ["pen", "servo"])
@pytest.mark.parametrize("unit", ["mm", "in"])
def test_it_goes_on_where_it_was_empty(tool: str, relative: bool, unit: str) -> None:
    drawing = replace(flat_drawing(), unit=unit)
    motion = Motion(tool=tool, relative=relative, servo_down=10.0, **DIPS)
    found = drawn(motion, drawing)
    plain = drawn(replace(motion, dip_every=0.0), drawing)
    assert is_dip(found[0]) and not any(map(is_dip, plain))
    # Between two dips there is as much line as a brush holds, over several strands too.
    dips = [k for k, way in enumerate(found) if is_dip(way)]
    held = [sum(map(length, found[a + 1 : b])) for a, b in zip(dips, [*dips[1:], len(found)])]
    assert np.allclose(held[:-1], 150.0, atol=1e-2) and 0 < held[-1] <= 150.0
    assert sum(held) == pytest.approx(sum(map(length, plain)), abs=0.1)
    # The stretches of a strand are the strand.
    ways = [way for way in found if not is_dip(way)]
    for whole in plain:
        joined = ways.pop(0)
        while length(joined) < length(whole) - 0.1:
            assert np.allclose(joined[-1], ways[0][0], atol=1e-3)
            joined = np.concatenate([joined, ways.pop(0)])
        assert all(np.abs(joined - corner).sum(axis=1).min() < 1e-2 for corner in whole)
    assert ways == []


def test_arcs_are_cut_where_the_brush_is_empty() -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False)
    circle = np.column_stack([50 + 40 * np.cos(turn), 50 + 40 * np.sin(turn), 0 * turn])
    first = flat_drawing()
    strand = replace(first.strands[1], points=circle, normals=np.tile([0.0, 0.0, 1.0], (200, 1)))
    drawing = replace(first, strands=[strand]).with_arcs(0.01)
    text = "".join(gcode_pieces(drawing, Motion(**DIPS), "a", "1"))
    at, down, gone = np.zeros(2), False, []
    for line in text.splitlines():
        code, *rest = line.split(";")[0].split() or [""]
        values = {word[0]: float(word[1:]) for word in rest}
        place = np.array([values.get("X", at[0]), values.get("Y", at[1])])
        if code == "G1" and values.get("Z") == 0.0:
            down = not np.allclose(at, PALETTE[:2])
            gone += [] if down else [0.0]
        elif code in ("G2", "G3"):
            centre = at + [values["I"], values["J"]]
            a, b = at - centre, place - centre
            assert np.linalg.norm(a) == pytest.approx(40.0, abs=0.02)
            assert np.linalg.norm(b) == pytest.approx(40.0, abs=0.02)
            gone[-1] += 40.0 * np.arccos(np.clip(a @ b / (np.linalg.norm(a) ** 2), -1, 1))
        elif code == "G1" and down:
            gone[-1] += float(np.linalg.norm(place - at))
        at = place
    assert gone == [pytest.approx(150.0, abs=0.1), pytest.approx(80 * np.pi - 150.0, abs=0.5)]


@pytest.mark.parametrize(
    ("motion", "words"),
    [(Motion(tool="laser", **DIPS), "laser"), (Motion(dip_every=1e-6), "more than 100,000")],
)
def test_what_is_no_brush_is_a_sentence(motion: Motion, words: str) -> None:
    with pytest.raises(FileError) as refusal:
        "".join(gcode_pieces(flat_drawing(), motion, "a", "1"))
    assert words in str(refusal.value)


def test_the_command_dips(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    mesh = geometry.write_obj(tmp_path / "square.obj", geometry.grid(6))
    argv = ["--input", mesh, "--output", tmp_path / "out.gcode", "--spacing", "0.3"]
    argv += ["--layout", "top", "--size", "100", "--iterations", "2"]
    argv += ["--dip-every", "60", "--dip-x", "-2e1", "--dip-height", "-1.5"]
    assert batch.main([str(one) for one in argv]) == 0, capsys.readouterr().err
    text = (tmp_path / "out.gcode").read_text()
    assert text.count("; paint\nG0 X-20 Y0") == text.count("; paint") > 2
    assert text.count("\nG1 Z-1.5 F1200\n") == text.count("; paint")
