# SPDX-License-Identifier: GPL-3.0-or-later
"""Plates as people bring them, in any unit and standing on any side: what is drawn has the size
that they have in the world, measured in the bytes of the file."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch

# From the plane of a grid into the file: the columns are where its x and y go.
FLAT = ((1, 0, 0), (0, 1, 0))
UPRIGHT = ((1, 0, 0), (0, 0, 1))  # in the plane of x and z
SIDEWAYS = ((0, 1, 0), (0, 0, 1))  # of y and z
LYING_Y_UP = ((1, 0, 0), (0, 0, -1))  # on the ground of a file whose y axis points up


@dataclass(frozen=True)
class Plate:
    """A plate of sides (in units of the file), and what is to come of it: sides in those of the
    drawing, up to the half spacing that the curve stays away from the rim on each side."""

    title: str
    sides: tuple[float, float]
    drawn: tuple[float, float]
    suffix: str
    words: tuple[str, ...] = ()
    place: tuple = FLAT
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)


PLATES = (
    Plate("millimetres", (200, 120), (200, 120), "svg", ("--input-unit", "mm")),
    Plate("centimetres", (20, 12), (200, 120), "svg", ("--input-unit", "cm")),
    Plate("inches", (8, 5), (203.2, 127), "dxf", ("--input-unit", "in")),
    Plate("metres, which nobody says", (0.2, 0.12), (200, 120), "gcode"),
    Plate("metres, which somebody says", (1.5, 2.5), (1500, 2500), "svg", ("--input-unit", "m")),
    Plate("y points up", (200, 120), (200, 120), "svg",
          ("--input-unit", "mm", "--input-up", "y"), LYING_Y_UP),
    Plate("inches of a file whose y points up", (8, 5), (8, 5), "gcode",
          ("--input-unit", "in", "--input-up", "y", "--unit", "in"), LYING_Y_UP),
    Plate("far from the origin", (200, 120), (200, 120), "gcode", ("--input-unit", "mm"), FLAT,
          (1e5, -2e5, 3e4)),
    Plate("below the origin", (30, 90), (30, 90), "dxf", ("--input-unit", "mm"), FLAT,
          (-60.0, -400.0, -5.0)),
    Plate("upright, from the front", (200, 120), (200, 120), "svg",
          ("--input-unit", "mm", "--layout", "front"), UPRIGHT),
    Plate("upright, from the side", (200, 120), (200, 120), "gcode",
          ("--input-unit", "mm", "--layout", "side"), SIDEWAYS),
    Plate("as large as the paper", (7, 3), (90, 90 * 3 / 7), "svg",
          ("--input-unit", "in", "--size", "90")),
    Plate("half as large, in centimetres", (200, 120), (10, 6), "dxf",
          ("--input-unit", "mm", "--scale", "0.5", "--unit", "cm")),
)  # fmt: skip


def bounds(path: Path) -> np.ndarray:
    """The sides of the box around everything that is drawn, by the words of each format."""
    text = path.read_text()
    if path.suffix == ".svg":
        ways = re.findall(r' d="([^"]*)"', text)
        points = np.array(re.findall(r"(-?[\d.]+)[ ,](-?[\d.]+)", " ".join(ways)), dtype=float)
    elif path.suffix == ".dxf":
        lines = [line.strip() for line in text.splitlines()]
        begin = lines.index("ENTITIES")
        pairs = list(zip(lines[begin + 1 :: 2], lines[begin + 2 :: 2], strict=False))
        points = np.array([[float(value) for code, value in pairs if code == wanted]
                           for wanted in ("10", "20")])  # fmt: skip
        points = points.T[np.any(points.T != 0.0, axis=1)]
    else:
        place, drawn = np.zeros(2), []
        for line in text.splitlines():
            for axis, number in re.findall(r"([XY])(-?[\d.]+)", line.split(";")[0]):
                place["XY".index(axis)] = float(number)
            if line.startswith("G1") and ("X" in line or "Y" in line):
                drawn.append(place.copy())
        points = np.array(drawn)
    return np.ptp(points, axis=0)


@pytest.mark.parametrize("plate", PLATES, ids=lambda plate: plate.title)
def test_a_plate_has_its_size(tmp_path: Path, plate: Plate) -> None:
    flat, faces = geometry.grid(16)
    vertices = flat[:, :2] * plate.sides @ np.array(plate.place, dtype=float) + plate.at
    mesh = geometry.write_obj(tmp_path / "plate.obj", geometry.Mesh(vertices, faces))
    report = tmp_path / "r.json"
    spacing = min(plate.sides) / 8.0
    output = tmp_path / f"a.{plate.suffix}"
    given = ["--input", mesh, "--output", output, "--report", report, "--spacing", spacing]
    assert batch.main([str(a) for a in (*given, "--quiet", *plate.words)]) == 0
    scale = plate.drawn[0] / plate.sides[0]
    sides = bounds(output)
    wanted = np.array(plate.drawn) - scale * spacing
    if "--size" in plate.words:  # which is that of the line, and not of the plate
        assert sides.max() == pytest.approx(90.0, abs=0.02)
        wanted *= 90.0 / wanted.max()
    assert sides == pytest.approx(wanted, abs=0.5 * scale * spacing)
    figures = json.loads(report.read_text())
    assert figures["drawing"]["sides"][:2] == pytest.approx(sides, rel=0.01, abs=0.02)
    assert figures["drawing"]["crossings"] in (0, None)
