# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves as machines get them are as long as what has grown, by a walk through the file."""

from __future__ import annotations

import csv
import itertools
import json
import math
import re
from dataclasses import dataclass
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch


@dataclass(frozen=True)
class Export:
    """What is written: of a mesh, with options, so many times as long as the curve and in so many
    pieces as it has strands."""

    title: str
    mesh: geometry.Mesh
    name: str
    words: tuple[str, ...] = ()
    times: float = 1000.0
    pieces: int = 1
    within: float = 2e-3


GRID, BALL, TORUS = geometry.grid(16), geometry.icosphere(3), geometry.torus(32, 16)
EXPORTS = (
    Export("a pen on a sheet", GRID, "a.gcode", ("--tool", "pen")),
    Export("a laser that goes relative", GRID, "a.nc",
           ("--tool", "laser", "--machine", "grbl", "--relative")),
    Export("a servo under Marlin", GRID, "a.gcode", ("--tool", "servo", "--machine", "marlin")),
    Export("a ball in space", BALL, "a.gcode", ("--force",)),
    Export("a torus in inches", TORUS, "a.gcode", ("--unit", "in", "--force"), 1000 / 25.4),
    Export("two parts", geometry.two_spheres(), "a.gcode", ("--force",), pieces=2),
    Export("three layers", GRID, "a.gcode", ("--layers", "3"), 3000.0, 3),
    Export("arcs of a mill", GRID, "a.gcode",
           ("--tool", "spindle", "--arcs", "0.05", "--layout", "top"),
           within=5e-3),
    Export("a drawing", GRID, "a.svg"),
    Export("a drawing at half the size", GRID, "a.svg", ("--scale", "0.5"), 500.0),
    Export("a table", TORUS, "a.csv", (), 1.0),
    Export("a table in steps", GRID, "a.csv", ("--resample-step", "0.01"), 1.0, 1, 0.02),
    Export("poses for a robot", BALL, "a.json", ("--poses",), 1.0),
    Export("parts of a refill", GRID, "a.csv", ("--part-length", "2.5"), 1.0, 0, 5e-3),
)  # fmt: skip


def of_gcode(path: Path) -> tuple[float, int]:
    """Millimetres or inches that are drawn, and strands: what switches on or comes down begins one.

    Moves with G1, G2 and G3 draw; feeds down and lifts, which move in z alone, do not.
    """
    place, total, pieces, relative, drawing = np.zeros(3), 0.0, 0, False, False
    for line in path.read_text().splitlines():
        words = dict(re.findall(r"([A-Z])(-?[\d.]+)", line.split(";")[0]))
        relative = {"G90": False, "G91": True}.get(line.split(" ")[0], relative)
        move = words.get("G")
        axes = [axis for axis in "XYZ" if axis in words]
        if move not in ("0", "1", "2", "3") or not axes:
            continue
        after = place.copy()
        for axis in axes:
            value = float(words[axis])
            after["XYZ".index(axis)] = value + (place["XYZ".index(axis)] if relative else 0.0)
        if move in ("2", "3"):
            center = place[:2] + [float(words.get("I", 0)), float(words.get("J", 0))]
            a, b = place[:2] - center, after[:2] - center
            turn = math.atan2(a[0] * b[1] - a[1] * b[0], float(a @ b))
            turn = turn % (2 * math.pi) if move == "3" else -turn % (2 * math.pi)
            total += turn * float(np.linalg.norm(a))
        elif move == "1" and ("X" in axes or "Y" in axes):
            total += float(np.linalg.norm(after - place))
        flat = move != "0" and ("X" in axes or "Y" in axes)
        pieces += flat and not drawing
        drawing = flat
        place = after
    return total, pieces


def of_svg(path: Path) -> tuple[float, int]:
    total, pieces = 0.0, 0
    for way in re.findall(r' d="([^"]*)"', path.read_text()):
        points = np.array(re.findall(r"(-?[\d.]+)[ ,](-?[\d.]+)", way), dtype=float)
        if way.rstrip().endswith("Z"):
            points = np.vstack([points, points[:1]])
        total += float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
        pieces += 1
    return total, pieces


def of_table(path: Path) -> tuple[float, int]:
    if path.suffix == ".json":
        ways = [np.array(strand["places"]) for strand in json.loads(path.read_text())["strands"]]
    else:
        rows = csv.DictReader(line for line in path.read_text().splitlines() if line[0] != "#")
        ways = []
        for _strand, group in itertools.groupby(rows, key=lambda row: row["strand"]):
            found = list(group)
            points = [[float(row[axis]) for axis in "xyz"] for row in found]
            closed = found[0].get("closed", "1") in ("1", "True", "true")
            ways.append(np.array([*points, points[0]] if closed else points))
    lengths = [np.linalg.norm(np.diff(way, axis=0), axis=1).sum() for way in ways]
    return float(sum(lengths)), len(ways)


@pytest.mark.parametrize("export", EXPORTS, ids=lambda export: export.title)
def test_the_file_is_as_long_as_the_curve(tmp_path: Path, export: Export) -> None:
    mesh, report = geometry.write_obj(tmp_path / "mesh.obj", export.mesh), tmp_path / "r.json"
    output = tmp_path / export.name
    spacing = 0.1 if export.mesh is GRID else 0.25
    given = ["--input", mesh, "--output", output, "--report", report, "--spacing", spacing]
    assert batch.main([str(a) for a in (*given, "--quiet", *export.words)]) == 0
    figures = json.loads(report.read_text())
    walk = of_svg if output.suffix == ".svg" else of_gcode
    length, pieces = (of_table if output.suffix in (".csv", ".json") else walk)(output)
    assert length == pytest.approx(export.times * figures["length"], rel=export.within)
    assert pieces == (export.pieces or math.ceil(figures["length"] / 2.5))


@pytest.mark.parametrize(
    "words",
    [(), ("--resample-step", "0.2"), ("--chord-tolerance", "0.02"), ("--go-on-from", "0", "0", "1")]
    + [("--part-length", "2", "--part-overlap", overlap) for overlap in ("-0.5", "0.5")]
    + [("--round", "0.3"), ("--light", "0.1"), ("--bridge",)],
    ids=" ".join,
)
def test_the_report_has_the_length_of_the_line_in_a_table(
    words: tuple[str, ...], tmp_path: Path, capsys
) -> None:
    mesh = geometry.write_obj(tmp_path / "mesh.obj", geometry.two_spheres())
    given = ["--input", mesh, "--output", tmp_path / "a.json", "--report", tmp_path / "r.json"]
    given += ["--spacing", "0.4", "--iterations", "40", "--fill-every-part", *words]
    assert batch.main([str(word) for word in given]) == 0
    length = 0.0
    for strand in json.loads((tmp_path / "a.json").read_text())["strands"]:
        points = np.array(strand["points"])
        ring = np.vstack([points, points[:1]]) if strand["closed"] else points
        length += np.linalg.norm(np.diff(ring, axis=0), axis=1).sum()
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["length"] == pytest.approx(length, rel=1e-9)
    assert f"length {length:.6g}" in capsys.readouterr().out
