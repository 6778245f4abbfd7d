# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of LEDs: lights at their pitch along the line, in the order of the strip, in every map."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import fill
from meander import batch

SPACING, SIZE = 0.1, 1000.0


@pytest.fixture(scope="module")
def sheet(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return geometry.write_obj(tmp_path_factory.mktemp("sheet") / "sheet.obj", geometry.grid(8))


def run(mesh: Path, name: str, *extra: str) -> Path:
    output = mesh.with_name(name)
    report = mesh.with_name("report.json")
    assert fill(mesh, output, "--spacing", SPACING, "--quiet", "--report", report, *extra) == 0
    return output


def lights(mesh: Path, *extra: str) -> np.ndarray:
    return np.array(json.loads(run(mesh, "a.pixelblaze.json", *extra).read_text()))


def test_lights_are_a_pitch_apart_along_the_line(sheet: Path) -> None:
    rows = np.genfromtxt(run(sheet, "a.csv"), delimiter=",", names=True)
    points = np.column_stack([rows[axis] for axis in "xyz"]) * 1000.0
    ring = np.vstack([points, points[:1]])
    arcs = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(ring, axis=0), axis=1)))
    found = lights(sheet, "--pitch", "20")
    report = json.loads(sheet.with_name("report.json").read_text())
    assert report["drawing"]["unit"] == "mm" and report["points"]["written"] == len(found)
    wanted = 20.0 * np.arange(len(found))
    on_line = np.column_stack([np.interp(wanted, arcs, ring[:, axis]) for axis in range(3)])
    assert np.abs(found - on_line).max() < 0.01
    assert 9.99 <= arcs[-1] - wanted[-1] <= 30.01


def is_gridded(cells: np.ndarray, along: np.ndarray) -> bool:
    """Whether there is a size of cells by which every place is in its own, to a
    hundredth of a millimetre, which is what the other file is written to."""
    along = along - along.min()
    least = ((along - 0.01) / (cells + 0.5)).max()
    greatest = np.min((along + 0.01)[cells > 0] / (cells[cells > 0] - 0.5), initial=np.inf)
    return bool(least <= greatest)


@pytest.mark.parametrize("pitch", ["8", "16.667", "50"])
def test_wled_has_every_light_in_its_cell(sheet: Path, pitch: str) -> None:
    given = ("--layout", "top", "--size", "1000", "--pitch", pitch)
    places = lights(sheet, *given)
    record = json.loads(run(sheet, "a.wled.json", *given).read_text())
    grid = np.array(record["map"]).reshape(record["height"], record["width"])
    assert sorted(grid[grid >= 0]) == list(range(len(places))) and (grid >= -1).all()
    row, column = np.nonzero(grid >= 0)
    order = np.argsort(grid[row, column])
    columns, rows = column[order], (record["height"] - 1 - row)[order]
    assert is_gridded(columns, places[:, 0]) and is_gridded(rows, places[:, 1])


def decoded(text: str, shape: tuple[int, int, int]) -> dict[int, tuple[int, int, int]]:
    """Light: layer, row, column, of the text that xLights calls CustomModel."""
    layers = [[row.split(",") for row in layer.split(";")] for layer in text.split("|")]
    assert np.array(layers, dtype=object).shape == shape
    return {
        int(cell): (layer, row, column)
        for layer, rows in enumerate(layers)
        for row, cells in enumerate(rows)
        for column, cell in enumerate(cells)
        if cell
    }


@pytest.mark.parametrize("layout", ["space", "top"])
def test_xlights_has_them_from_one_on(tmp_path: Path, layout: str) -> None:
    ball = geometry.write_obj(tmp_path / 'a "b" & c.obj', geometry.icosphere(2))
    mesh = ball if layout == "space" else geometry.write_obj(tmp_path / "s.obj", geometry.grid(4))
    given = ("--layout", layout, "--size", "400", "--pitch", "20", "--spacing", "0.3")
    places = lights(mesh, *given)
    root = ElementTree.parse(run(mesh, 'a "b" & c.xmodel', *given)).getroot()
    assert root.tag == "custommodel" and root.get("name") == 'a "b" & c'
    width, height, depth = (int(root.get(name)) for name in ("parm1", "parm2", "Depth"))
    cells = decoded(root.get("CustomModel"), (depth, height, width))
    assert sorted(cells) == list(range(1, len(places) + 1))
    packed = [each.split(",") for each in root.get("CustomModelCompressed").split(";")]
    numbers = [list(map(int, each)) for each in packed]
    assert {light: (*(rest[2:] or (0,)), *rest[:2]) for light, *rest in numbers} == cells
    # To the right along x, down from the top, and back along y.
    table = np.array([cells[light] for light in sorted(cells)])
    up = places[:, 2] if layout == "space" else places[:, 1]
    pairs = [(table[:, 2], places[:, 0]), (height - 1 - table[:, 1], up)]
    if layout == "space":
        pairs.append((table[:, 0], places[:, 1]))
    assert all(is_gridded(cells_along, along) for cells_along, along in pairs)


def test_both_sides_of_a_ball_are_no_grid(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    ball = geometry.write_obj(tmp_path / "ball.obj", geometry.icosphere(3))
    given = ["--input", ball, "--output", tmp_path / "a.wled.json", "--spacing", "0.3", "--quiet"]
    assert batch.main([str(each) for each in (*given, "--size", "1000")]) == 2
    assert "shows the surface once" in capsys.readouterr().err
    assert not (tmp_path / "a.wled.json").exists()


def test_parts_and_places_go_on_counting(sheet: Path) -> None:
    whole = lights(sheet, "--pitch", "20")
    parts = lights(sheet, "--pitch", "20", "--part-length", "2")
    assert abs(len(parts) - len(whole)) <= 8
    backwards = lights(sheet, "--pitch", "20", "--backwards")
    assert len(backwards) == len(whole)


