# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of text are written in blocks, with the bytes of Python's own formatting, and one that is
interrupted is as it was."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from meander import core
from meander.model import export
from meander.model.files import obj, rows
from meander.model.toolpaths import poses, toolpath
from meander.model.toolpaths.toolpath import Strand

FORMATS = ("csv", "obj", "svg", "dxf", "gcode", "relative.gcode", "poses.csv")


def strands() -> list[Strand]:
    """A closed and an open one, with points of both signs and some at whole numbers."""
    angle = np.linspace(0.0, 12.0, 61)[:-1]
    points = np.stack([np.cos(angle) * (1 + angle), np.sin(angle) * angle, 0.0 * angle], axis=1)
    points[10], points[20] = np.round(points[10]), -points[20] * 1e-5
    up = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    known = (np.abs(points[:, :2]), np.arange(len(points)), np.abs(points) / 3.0)
    whole = toolpath.strand_of(points, up, True, *known)
    beside = toolpath.strand_of(points[:7] + [30.0, 0.0, 0.0], up[:7], False)
    return [whole, replace(beside, radii=np.ones((7, 2)))]


def write(path: Path, lines: list[Strand]) -> None:
    name = path.name.split(".", 1)[1]
    if name == "obj":
        offsets = np.cumsum([0] + [len(line.points) for line in lines])
        points = np.concatenate([line.points for line in lines])
        closed = np.array([line.closed for line in lines])
        curve = core.Polylines(points, points, offsets, closed)
        obj.write_obj_curve(path, curve)
    elif name == "csv":
        toolpath.write(path, lines, "1")
    elif name == "poses.csv":
        poses.write(path, [poses.poses_of(line, 0.1, 0.5) for line in lines], "1")
    else:
        kind = export.format_of(path)
        values = export.DEFAULTS | {"layout_as": "top", "relative": "relative" in name}
        export.write(path, kind, export.prepared(lines, kind, values, 1.0), values, "a", "1")


@pytest.mark.parametrize("name", FORMATS)
def test_blocks_of_any_size_make_the_same_file(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = []
    for size in (1, 7, 1000):
        monkeypatch.setattr(rows, "_BLOCK", size)
        write(tmp_path / f"a.{name}", strands())
        found.append((tmp_path / f"a.{name}").read_bytes())
    assert found[0] == found[1] == found[2]
    assert found[0].endswith(b"\n")


@pytest.mark.parametrize("name", FORMATS)
def test_an_interrupted_file_is_as_it_was(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An interruption is heard between two blocks, and nothing is left beside the file."""
    path = tmp_path / f"a.{name}"
    path.write_bytes(b"earlier")
    made = []

    def interrupted(pattern: str, values: np.ndarray) -> bytes:
        made.append(len(values))
        if len(made) == 3:
            raise KeyboardInterrupt
        return core_rows(pattern, values)

    core_rows = core.text_rows
    monkeypatch.setattr(rows, "_BLOCK", 20)
    monkeypatch.setattr(core, "text_rows", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write(path, strands())
    assert path.read_bytes() == b"earlier"
    assert [item.name for item in tmp_path.iterdir()] == [path.name]


def test_rows_have_the_bytes_of_pythons_formatting() -> None:
    random = np.random.default_rng(4)
    values = random.normal(size=(3000, 4)) * 10.0 ** random.integers(-12, 20, (3000, 4))
    values[:8, 0] = 0.0, -0.0, 0.5, 1.5, -2.5, 1e-5, np.nan, -np.inf
    text = core.text_rows("%.17g;%.9g %.3f%%%.12g\n", values).decode("ascii")
    assert text == "".join(f"{a:.17g};{b:.9g} {c:.3f}%{d:.12g}\n" for a, b, c, d in values.tolist())
    places = np.arange(-50.0, 50.0)[:, None] * 12345.5
    expected = "".join(f"{int(row[0])}," for row in places)
    assert core.text_rows("%d,", places).decode("ascii") == expected


def test_only_a_few_blocks_are_made_ahead(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a file of any length a few blocks are in memory, and all come in their order."""
    made = []

    def noted(pattern: str, values: np.ndarray) -> bytes:
        made.append(len(values))
        return core_rows(pattern, values)

    core_rows = core.text_rows
    monkeypatch.setattr(rows, "_BLOCK", 10)
    monkeypatch.setattr(core, "text_rows", noted)
    pieces = rows.rows("%d\n", np.arange(1000))
    assert isinstance(pieces, Iterator)
    first = next(pieces)
    assert first == "".join(f"{n}\n" for n in range(10))
    assert len(made) <= 4
    assert first + "".join(pieces) == "".join(f"{n}\n" for n in range(1000))


def test_patterns_that_mean_nothing_are_refused() -> None:
    for pattern, columns in (("%g", 1), ("%.18g", 1), ("%d %d", 1), ("none", 1), ("%", 1)):
        with pytest.raises(core.MeanderError) as refusal:
            core.text_rows(pattern, np.zeros((2, columns)))
        assert refusal.value.status == core.Status.INVALID_ARGUMENT
