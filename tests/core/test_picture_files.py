# SPDX-License-Identifier: GPL-3.0-or-later
"""What files of other programs hold of a picture: its size in their units, and its lights."""

from __future__ import annotations

import json
import re
import struct
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from meander import batch
from meander.cli import wishes

pytest.importorskip("PIL")
# A sheet of 80 by 60 mm, and a line on it.
WIDTH, PEN = 80.0, 4.0
# These need a package of their own.
EXTRA = (".dst", ".pes", ".usdc", ".usd")


@pytest.fixture(scope="module")
def grey(tmp_path_factory: pytest.TempPathFactory) -> Path:
    from PIL import Image

    path = tmp_path_factory.mktemp("pictures") / "grey.png"
    Image.new("L", (80, 60), 76).save(path)
    return path


def run(grey: Path, out: Path, *more: object) -> Path:
    words = ("--picture", grey, "--width", WIDTH, "--pen", PEN, "--tone", "value", "--quiet")
    words = (*words, "--output", out, *more)
    assert batch.main([str(word) for word in words]) == 0
    return out


@pytest.mark.parametrize("suffix", [each for each in wishes.OUTPUTS if each not in EXTRA])
def test_every_kind_that_is_named_is_written(grey: Path, tmp_path: Path, suffix: str) -> None:
    assert run(grey, tmp_path / f"a.b{suffix}").stat().st_size > 0
    assert [path.name for path in tmp_path.iterdir()] == [f"a.b{suffix}"]


def assert_is_the_sheet(points: np.ndarray, unit: float) -> None:
    """Points fill 80 by 60 mm, to the spacing, from the lower left corner.

    unit   in millimetres
    """
    low, high = points.min(axis=0) * unit, points.max(axis=0) * unit
    assert (low > 0.0).all() and (low < 2.5 * PEN).all()
    assert (high < [WIDTH, 60.0]).all() and (high > [WIDTH - 2.5 * PEN, 60.0 - 2.5 * PEN]).all()


def test_a_scene_has_the_sheet_in_metres_and_the_line_as_wide_as_the_pen(
    grey: Path, tmp_path: Path
) -> None:
    text = run(grey, tmp_path / "a.usda").read_text()
    assert "metersPerUnit = 1\n" in text
    (points,) = re.findall(r"point3f\[\] points = \[(.*)\]", text)
    found = np.array(re.findall(r"\(([^,]+), ([^,]+), [^)]+\)", points), dtype=float)
    assert_is_the_sheet(found, 1000.0)
    (width,) = re.findall(r"widths = \[([^]]+)\]", text)
    assert float(width) == pytest.approx(PEN / 1000.0)
    wider = run(grey, tmp_path / "b.usda", "--thickness", 0.5).read_text()
    assert f"widths = [{width}]" not in wider
    data = run(grey, tmp_path / "a.glb").read_bytes()
    scene = json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])
    (box,) = ((each["min"], each["max"]) for each in scene["accessors"] if "min" in each)
    size = np.subtract(box[1], box[0])
    assert sorted(size) == pytest.approx([PEN / 1000.0, 0.058, 0.078], abs=0.003)


def test_poses_are_in_metres(grey: Path, tmp_path: Path) -> None:
    text = run(grey, tmp_path / "a.yaml").read_text()
    place = r"position:\s+x: (\S+)\s+y: (\S+)"
    assert_is_the_sheet(np.array(re.findall(place, text), dtype=float), 1000.0)
    higher = run(grey, tmp_path / "b.yaml", "--standoff", 5).read_text()
    heights = re.findall(r"position:\s+x: \S+\s+y: \S+\s+z: (\S+)", higher)
    assert np.array(heights, dtype=float) == pytest.approx(0.005)


def test_lights_are_a_pitch_apart_along_the_line(grey: Path, tmp_path: Path) -> None:
    report = tmp_path / "a.json"
    path = run(grey, tmp_path / "a.pixelblaze.json", "--pitch", 5, "--report", report)
    lights = np.array(json.loads(path.read_text()))[:, :2]
    length = json.loads(report.read_text())["length"]
    assert len(lights) == pytest.approx(length / 5.0, abs=1.0)
    steps = np.linalg.norm(np.diff(lights, axis=0), axis=1)
    # A turn is a shorter way through the air; all lights are to one scale.
    assert (steps <= np.median(steps) * 1.01).all() and np.median(steps) > 0.9 * steps.max()
    model = ElementTree.parse(run(grey, tmp_path / "a.xmodel", "--pitch", 5)).getroot()
    assert len(re.findall(r"\d+", model.get("CustomModel"))) == len(lights)


def test_each_ink_has_a_file_of_its_kind(grey: Path, tmp_path: Path) -> None:
    run(grey, tmp_path / "a.wled.json", "--inks", "cyan,magenta")
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "a_cyan.wled.json", "a_magenta.wled.json",
    ]  # fmt: skip


def test_it_is_said_that_tones_are_corrected(tmp_path: Path, capsys) -> None:
    from PIL import Image

    values = np.full((60, 80), 255, dtype=np.uint8)
    values[10:50, 15:65:3] = 0
    Image.fromarray(values).save(tmp_path / "hatching.png")
    words = ("--picture", tmp_path / "hatching.png", "--width", 80, "--pen", 3)
    assert batch.main([str(word) for word in (*words, "--output", tmp_path / "a.svg")]) == 0
    told = capsys.readouterr()
    assert 1 <= (told.out + told.err).count("meander: correcting tones\n") <= 2
