# SPDX-License-Identifier: GPL-3.0-or-later
"""A curve cut by length: parts of at most that length that make up the whole, each a layer."""

from __future__ import annotations

import csv
from pathlib import Path
from xml.etree import ElementTree

import geometry
import numpy as np
import pytest
from flows import fill
from meander.model.toolpaths import toolpath
from meander.model.toolpaths.parts import parted


def ring(count: int = 400) -> toolpath.Strand:
    t = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    radii = 5.0 + np.sin(7 * t)
    points = np.column_stack([radii * np.cos(t), radii * np.sin(t), np.sin(3 * t)])
    return toolpath.strand_of(points, np.tile([0.0, 0.0, 1.0], (count, 1)), True)


def line() -> toolpath.Strand:
    whole = ring()
    return toolpath.strand_of(whole.points[:250], whole.normals[:250], False)


def length_of(points: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("overlap", [0.0, 0.4, -0.4])
@pytest.mark.parametrize("share", [0.05, 0.31, 0.5, 0.99])
def test_parts_make_up_the_whole(closed: bool, overlap: float, share: float) -> None:
    strand = ring() if closed else line()
    limit = share * strand.length
    parts = parted([strand], limit, overlap)
    lengths = [length_of(part.points) for part in parts]
    assert max(lengths) <= limit * (1 + 1e-9)
    assert [part.part for part in parts] == list(range(1, len(parts) + 1))
    assert all(not part.closed and part.length == pytest.approx(n, rel=1e-9)
               for part, n in zip(parts, lengths))  # fmt: skip
    joints = len(parts) if closed else len(parts) - 1
    assert sum(lengths) == pytest.approx(strand.length + joints * overlap, rel=1e-9)
    fewest = int(np.ceil(strand.length / limit))
    assert fewest <= len(parts) <= fewest + 1 + int(2 * len(parts) * max(overlap, 0.0) / limit)
    # Neighbours meet, overlap, or leave the gap.
    for one, other in zip(parts[:-1], parts[1:]):
        if overlap == 0.0:
            assert np.allclose(one.points[-1], other.points[0])
        away = np.linalg.norm(strand.points - one.points[len(one.points) // 2], axis=1)
        assert away.min() < 0.2


def test_what_is_short_stays_as_it_is() -> None:
    parts = parted([ring(), line()], 1e6)
    assert [part.closed for part in parts] == [True, False]
    assert [part.part for part in parts] == [1, 2]


@pytest.fixture
def sheet(tmp_path: Path) -> Path:
    return geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(8))


def run(mesh: Path, name: str, *extra: str) -> int:
    return fill(mesh, mesh.with_name(name), "--spacing", "0.1", "--quiet", *extra)


def test_every_part_is_a_layer(sheet: Path) -> None:
    given = ("--part-length", "3", "--part-overlap", "0.05")
    drawn = (*given, "--layout", "top", "--input-unit", "cm", "--scale", "10")
    assert run(sheet, "a.csv", *given) == 0
    with sheet.with_name("a.csv").open() as file:
        rows = list(csv.DictReader(file))
    count = int(rows[-1]["strand"]) + 1
    assert count >= 3 and all(row["face"] and row["w0"] for row in rows)
    assert run(sheet, "a.svg", *drawn) == 0
    tree = ElementTree.parse(sheet.with_name("a.svg"))
    name = "{http://www.inkscape.org/namespaces/inkscape}label"
    labels = [group.get(name) for group in tree.iter("{http://www.w3.org/2000/svg}g")]
    assert labels[1:] == [f"part {k + 1}" for k in range(count)]
    assert run(sheet, "a.gcode", *drawn) == 0
    text = sheet.with_name("a.gcode").read_text()
    assert text.count("\nM0 ; part ") == count - 1
    assert run(sheet, "a.dxf", *drawn) == 0
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.readfile(sheet.with_name("a.dxf"))
    layers = [line.dxf.layer for line in document.modelspace().query("POLYLINE")]
    assert layers == [f"MEANDER_{k + 1}" for k in range(count)]
    assert all(layer in document.layers for layer in layers)


@pytest.mark.parametrize(
    ("extra", "name", "words"),
    [
        (("--part-length", "1"), "a.obj", "--part-length needs"),
        (("--part-overlap", "1"), "a.csv", "give both"),
        (("--part-length", "1", "--part-overlap", "0.7"), "a.csv", "more than half"),
        (("--part-length", "1e-9"), "a.csv", "choose a greater length"),
    ],
)
def test_what_means_nothing_is_refused(sheet: Path, extra, name, words, capsys) -> None:
    assert run(sheet, name, *extra) == 2
    assert words in capsys.readouterr().err
