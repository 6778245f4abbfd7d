# SPDX-License-Identifier: GPL-3.0-or-later
"""What is accepted for a file has an effect on it, and no number gets into a file that no machine
can read; what has none is refused with what it is for."""

from __future__ import annotations

import argparse
import itertools
import re
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch
from meander.cli import flags
from meander.cli.values import BadInput, Parser
from meander.model.options.export import ROWS
from meander.model.options.machines import MACHINE_ROWS, without_effect
from meander.model.toolpaths.drawing import Drawing
from meander.model.toolpaths.gcode import MACHINES, TOOLS, Motion, gcode_pieces
from meander.model.toolpaths.toolpath import strand_of
from sentences import assert_sentence

# A value for each that is not its default.
OTHERS = {
    "feed": 700.0, "travel_feed": 800.0, "lift": 3.5, "layer_offset": 1.5, "layers": 2,
    "layer_height": 0.75, "extrusion": 0.05, "power": 44.0, "servo_down": 11.0, "servo_up": 77.0,
    "relative": True, "dip_every": 3.0, "dip_x": -5.0, "dip_y": 6.0, "dip_height": -2.0,
}  # fmt: skip
BESIDE = [{}, {"layers": 2}, {"dip_every": 3.0}]


def _text(values: dict[str, object]) -> str:
    points = np.array([[[0.0, 0, 1], [9, 1, 2], [9, 9, 3]], [[1.0, 20, 1], [2, 30, 1], [9, 20, 2]]])
    normals = np.tile([0.0, 0.6, 0.8], (3, 1))
    strands = [strand_of(each, normals, False) for each in points]
    return "".join(gcode_pieces(Drawing(strands, "mm", False), Motion(**values), "a", "1"))


@pytest.mark.parametrize("tool", [name for name, _label, _tip in TOOLS])
@pytest.mark.parametrize("machine", [name for name, _label, _tip in MACHINES])
def test_what_is_accepted_changes_the_gcode(tool: str, machine: str) -> None:
    defaults = {row.setting: row.default for row in MACHINE_ROWS}
    refused = 0
    for beside, (setting, value) in itertools.product(BESIDE, OTHERS.items()):
        if setting in beside or (beside.get("dip_every") and tool not in ("pen", "servo")):
            continue
        if setting == "dip_every" and tool not in ("pen", "servo"):
            continue  # which the writer refuses
        base = {"tool": tool, "machine": machine, **beside}
        given = {**base, setting: value}
        idle = without_effect(given, defaults | given)
        changed = _text(given) != _text(base)
        assert (idle is None) == changed, (given, idle)
        if idle is not None:
            refused += 1
            assert idle[0] == setting
    assert refused >= 10


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--dip-x", "5"], "--dip-x is for --dip-every"),
        (["--layer-height", "1"], "--layer-height is for --layers"),
        (["--layer-height", "1", "--layers", "1"], "--layer-height is for --layers"),
        (["--servo-up", "5", "--tool", "laser"], "--servo-up is for --tool servo"),
        (["--power", "5"], "--power is for --tool laser or spindle"),
        (["--lift", "5", "--tool", "laser"], "--lift is for --tool pen or spindle"),
    ],
)
def test_the_command_says_what_it_is_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], options: list[str], words: str
) -> None:
    mesh = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(4))
    argv = ["--input", str(mesh), "--output", str(tmp_path / "a.gcode"), "--spacing", "0.4"]
    assert batch.main([*argv, "--layout", "top", *options]) == 2
    line = capsys.readouterr().err.strip()
    assert words in line
    assert_sentence(line.removeprefix("meander: "))
    assert not (tmp_path / "a.gcode").exists()


def _read(row_flag: str, text: str) -> float:
    parser = Parser()
    flags.add_flags(parser, "export", ROWS)
    found: argparse.Namespace = parser.parse_args([f"{row_flag}={text}"])
    return getattr(found, row_flag[2:].replace("-", "_"))


def test_no_number_of_a_machine_is_beyond_what_its_setting_has() -> None:
    for row in MACHINE_ROWS:
        if row.kind is not float:
            continue
        for text in ("1e300", "-1e300", "1e-9"):
            try:
                value = _read(row.flag.name, text)
            except BadInput:
                continue
            assert row.least <= value, row.setting
            assert row.greatest is None or value <= row.greatest, row.setting
    with pytest.raises(BadInput, match=r"0\.1"):
        _read("--travel-feed", "0.00001")  # would be F0


def test_a_length_is_said_with_how_often_it_is_followed() -> None:
    assert "length 40" not in _text({})
    (head,) = re.findall("; 2 strands, length (.*)", _text({"layers": 3}))
    assert head.endswith(" mm, 3 times over")
    (head,) = re.findall("; 2 strands, length (.*)", _text({}))
    assert head.endswith(" mm")
