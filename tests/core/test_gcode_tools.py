# SPDX-License-Identifier: GPL-3.0-or-later
"""G-code for pens, spindles, lasers and servos, as controllers run it.

Lines are taken apart by the package gcodeparser where it is there, which knows nothing of ours.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch, core
from meander.model import export
from meander.model.toolpaths import toolpath
from meander.model.toolpaths.drawing import Drawing
from meander.model.toolpaths.gcode import MACHINES, TOOLS, Motion, gcode_pieces


def words_of(line: str) -> list[tuple[str, dict[str, float]]]:
    """The commands of a line: code and values."""
    line = line.split(";")[0].strip()
    if not line:
        return []
    if re.match(r"[A-Z_]+ ", line) and "=" in line:  # Klipper's own commands
        name, *values = line.split()
        return [(name, {key: float(v) for key, v in (w.split("=") for w in values)
                        if re.fullmatch(r"[-\d.]+", v)})]  # fmt: skip
    try:
        from gcodeparser import GcodeParser
    except ImportError:
        code, *rest = line.split()
        return [(code, {word[0]: float(word[1:]) for word in rest})]
    return [
        (f"{parsed.command[0]}{parsed.command[1]}", dict(parsed.params))
        for parsed in GcodeParser(line).lines
    ]


@dataclass
class Machine:
    """Follows moves, and notes what is drawn: every run of moves while the tool is on."""

    tool: str
    drawn: list[list[np.ndarray]] = field(default_factory=list)
    travelled: float = 0.0
    strengths: set[float] = field(default_factory=set)
    angles: list[float] = field(default_factory=list)
    waits: int = 0
    spinning: bool = False
    ended: bool = False

    def run(self, text: str, low: float) -> Machine:
        """low   the height at which a pen or a spindle draws"""
        at, relative, on = np.zeros(3), False, False
        for line in text.splitlines():
            for code, values in words_of(line):
                if code in ("G90", "G91"):
                    relative = code == "G91"
                elif code in ("G0", "G1"):
                    place = at.copy()
                    for axis, name in enumerate("XYZ"):
                        if name in values:
                            place[axis] = values[name] + (at[axis] if relative else 0.0)
                    if self.tool in ("pen", "spindle"):
                        down = place[2] <= low + 1e-6
                        if down and not on:
                            self.drawn.append([place])
                        on = down
                    if on and (self.tool in ("laser", "servo") or place[2] <= low + 1e-6):
                        self.drawn[-1].append(place)
                        assert code == "G1" or self.tool in ("pen", "spindle")
                    else:
                        self.travelled += float(np.linalg.norm(place - at))
                    at = place
                elif code in ("M3", "M4", "M5", "M280", "SET_PIN", "SET_SERVO"):
                    on = self._switch(code, values, on, at)
                elif code == "G4":
                    self.waits += 1
                elif code in ("M2", "M400"):
                    self.ended = True
        assert self.ended and not self.spinning
        return self

    def _switch(self, code: str, values: dict[str, float], on: bool, at: np.ndarray) -> bool:
        strength = values.get("S", values.get("VALUE", values.get("ANGLE", 0.0)))
        off = code == "M5" or (code == "SET_PIN" and strength == 0.0)
        if self.tool == "servo":
            self.angles.append(strength)
            now = strength == min(self.angles) and len(set(self.angles)) > 1
        elif self.tool == "laser":
            now = not off
            if now:
                self.strengths.add(strength)
        else:
            self.spinning = not off
            self.strengths |= set() if off else {strength}
            return on
        if now and not on:
            self.drawn.append([at])
        return now


def flat_drawing() -> Drawing:
    rng = np.random.default_rng(4)
    ways = [np.column_stack([rng.uniform(0, 90, (40, 2)), np.zeros(40)]) for _ in range(3)]
    up = np.tile([0.0, 0.0, 1.0], (40, 1))
    return Drawing([toolpath.strand_of(w, up, k == 1) for k, w in enumerate(ways)], "mm", True)


@pytest.mark.parametrize("relative", [False, True])
@pytest.mark.parametrize("machine", [name for name, _label, _tip in MACHINES])
@pytest.mark.parametrize("tool", [name for name, _label, _tip in TOOLS])
def test_what_is_drawn_is_the_curve(tool: str, machine: str, relative: bool) -> None:
    drawing = flat_drawing()
    motion = Motion(tool=tool, machine=machine, relative=relative, power=40.0, servo_down=10.0)
    run = Machine(tool).run("".join(gcode_pieces(drawing, motion, "a", "1")), 0.0)
    assert len(run.drawn) == len(drawing.strands)
    for places, strand in zip(run.drawn, drawing.strands):
        way = np.vstack([strand.points, strand.points[:1]]) if strand.closed else strand.points
        found = np.array(places)
        # A place may be given twice, where the tool comes down.
        found = found[np.append(True, np.abs(np.diff(found, axis=0)).sum(axis=1) > 0)]
        assert np.allclose(found, way, atol=1e-4)
    full = {"generic": 1000.0, "grbl": 1000.0, "marlin": 255.0, "klipper": 1.0}[machine]
    if tool in ("laser", "spindle"):
        assert list(run.strengths) == [pytest.approx(0.4 * full)]
    if tool == "servo":
        assert set(run.angles) == {10.0, 60.0} and run.angles[0] == run.angles[-1] == 60.0
        assert run.waits == len(run.angles)


def test_no_error_adds_up_in_relative_moves() -> None:
    """After 20,000 moves the tool is where it should be."""
    steps = np.random.default_rng(0).normal(size=(20_000, 3)) * [0.013, 0.017, 0.0]
    way = np.cumsum(steps, axis=0)
    strand = toolpath.strand_of(way, np.tile([0.0, 0.0, 1.0], (len(way), 1)), False)
    motion = Motion(tool="laser", relative=True)
    text = "".join(gcode_pieces(Drawing([strand], "mm", True), motion, "a", "1"))
    at, relative = np.zeros(2), False
    for line in text.splitlines():
        relative = relative or line.startswith("G91")
        found = dict(re.findall(r"([XY])([-\d.]+)", line.split(";")[0]))
        if found:
            step = np.array([float(found["X"]), float(found["Y"])])
            at = at + step if relative else step
    assert np.abs(at - way[-1, :2]).max() < 1e-4


def test_a_laser_in_space_follows_the_height() -> None:
    way = np.array([(0, 0, 0), (10, 0, 5), (20, 0, 1)], dtype=float)
    strand = toolpath.strand_of(way, np.tile([0.0, 0.0, 1.0], (3, 1)), False)
    text = "".join(gcode_pieces(Drawing([strand], "mm", False), Motion(tool="laser"), "a", "1"))
    run = Machine("laser").run(text, 0.0)
    assert np.allclose(run.drawn[0], way)


def test_head_and_foot_of_a_file(tmp_path: Path, capsys) -> None:
    mesh = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(6))
    (tmp_path / "head.txt").write_text("\ufeff$H\nM8 ; aus\u00dfen", encoding="utf-8")
    (tmp_path / "foot.txt").write_text("M30\n")
    given = ["--input", mesh, "--output", tmp_path / "a.nc", "--spacing", "0.2", "--quiet"]
    given += ["--size", "90", "--layout", "top", "--tool", "laser", "--machine", "grbl"]
    files = ["--header", tmp_path / "head.txt", "--footer", tmp_path / "foot.txt"]
    assert batch.main([str(a) for a in (*given, *files)]) == 0
    text = (tmp_path / "a.nc").read_text(encoding="utf-8").splitlines()
    unit = text.index("G21 ; millimetres")
    assert text[unit + 1 : unit + 4] == ["$H", "M8 ; aus_en", "G90 ; absolute positions"]
    assert text[-2:] == ["M5", "M30"] and "G17" not in text and "M2 ; end" not in text
    assert batch.main([str(a) for a in (*given, "--header", tmp_path / "none")]) == 2
    given[3] = tmp_path / "a.svg"
    assert batch.main([str(a) for a in given]) == 2
    assert "does nothing" in capsys.readouterr().err


# Names of objects and files, which become comments.
NAMES = (
    "Hold!", "Ready?", "~start", "100%", "(nested) name", "Größe", "手", "a\x18b", "a\nG0 Z-50",
    "50% (draft)!", "tab\tname", "plain name-1.2",
)  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("machine", ["grbl", "marlin"])
def test_a_comment_holds_nothing_that_a_machine_acts_on(name: str, machine: str) -> None:
    text = "".join(gcode_pieces(flat_drawing(), Motion(machine=machine), name, "1"))
    assert text.isascii() and not set("!?~%()\x18\t") & set(text)
    assert text.splitlines()[0].startswith("; ") and text.splitlines()[1].startswith("; 3 strands")
    if name == NAMES[-1]:
        assert text.startswith(f"; {name}, Meander 1\n")


@pytest.mark.parametrize(
    ("line", "becomes"),
    [
        ("M8 ; Achtung! (50%)", "M8 ; Achtung_ _50__"),
        ("G21 (mm) G17 (plane?)", "G21  G17 ; mm plane_"),
        ("(all of it ~)", "; all of it _"),
        ("%", "%"),
        ("", ""),
        ("$H", "$H"),
    ],
)
def test_comments_of_a_head_are_cleaned(line: str, becomes: str, tmp_path: Path) -> None:
    (tmp_path / "head.txt").write_text(f"G54\n{line}\n", encoding="utf-8")
    assert export.lines_of(tmp_path / "head.txt") == ["G54", becomes]


@pytest.mark.parametrize("line", ["M117 Ready!", "?", "~", "G0 X1\u2212", "M3\x18", "M117 Größe"])
def test_a_head_that_would_stop_the_machine_is_a_sentence(
    line: str, tmp_path: Path, capsys
) -> None:
    mesh = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(6))
    (tmp_path / "head.txt").write_text(f"G54\n{line}\n", encoding="utf-8")
    given = ["--input", mesh, "--output", tmp_path / "a.nc", "--spacing", "0.2", "--quiet"]
    assert batch.main([str(a) for a in (*given, "--header", tmp_path / "head.txt")]) == 2
    said = capsys.readouterr().err
    assert "head.txt, line 2" in said and len(said.splitlines()) == 1
    assert not (tmp_path / "a.nc").exists()


@pytest.mark.parametrize("machine", ["generic", "grbl", "marlin", "klipper"])
@pytest.mark.parametrize("tool", ["pen", "laser", "spindle", "servo"])
@pytest.mark.parametrize("extrusion", [0.0, 0.05])
def test_the_machine_is_left_as_it_was(machine: str, tool: str, extrusion: float) -> None:
    for relative in (False, True):
        motion = Motion(machine=machine, tool=tool, extrusion=extrusion, relative=relative)
        lines = "".join(gcode_pieces(flat_drawing(), motion, "a", "1")).splitlines()
        words = [line.split(";")[0].strip() for line in lines]
        modes = [word for word in words if word in ("G90", "G91")]
        assert modes == (["G90", "G91", "G90"] if relative else ["G90"])
        extruders = [word for word in words if word in ("M82", "M83")]
        assert extruders == (["M83", "M82"] if extrusion else [])
        # Nothing moves after that, and the foot comes last.
        last = max(place for place, word in enumerate(words) if word[:3] in ("G0 ", "G1 "))
        assert all(place > last for place, word in enumerate(words) if word == "M82")
        assert words[-1] in ("M2", "M400")


def test_every_tool_and_machine_is_a_choice_of_the_command() -> None:
    assert export.DEFAULTS["tool"] == "pen" and export.DEFAULTS["machine"] == "generic"
    assert core.VERSION in "".join(gcode_pieces(flat_drawing(), Motion(), "a", core.VERSION))


def test_an_empty_head_is_none(tmp_path) -> None:
    (tmp_path / "head.gcode").write_text("")
    assert export.lines_of(tmp_path / "head.gcode") == []
    text = "".join(gcode_pieces(flat_drawing(), Motion(machine="grbl"), "a", "1", head=[]))
    assert "G17" not in text and "G21" in text
