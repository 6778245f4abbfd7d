# SPDX-License-Identifier: GPL-3.0-or-later
"""How many lines a mesh gets, and what is said of it: one a part, and cracks part nothing.

The meshes are made of pieces of which it is known whether they hang together.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import geometry
import numpy as np
import pytest
from geometry import rectangle as sheet
from meander import batch

SPACING = 0.2


@dataclass(frozen=True)
class Brought:
    title: str
    pieces: tuple[geometry.Mesh, ...]
    lines: int = 1
    small: int = 0
    words: tuple[str, ...] = ()


def moved(piece: geometry.Mesh, by: tuple, scale: float = 1.0) -> geometry.Mesh:
    return geometry.mesh(piece.vertices * scale + np.array(by), piece.faces)


def rolled(piece: geometry.Mesh) -> geometry.Mesh:
    """x around an axis, in facets of an eighth of a turn, so that edges along y stay straight."""
    turns = piece.vertices[:, 0]
    whole = np.floor(turns)
    corners = np.array([[np.cos(k * np.pi / 4), np.sin(k * np.pi / 4)] for k in range(10)])
    low, high = corners[whole.astype(int)], corners[whole.astype(int) + 1]
    flat = low + (turns - whole)[:, None] * (high - low)
    return geometry.mesh(np.column_stack([flat, piece.vertices[:, 1]]), piece.faces)


def bricks() -> tuple[geometry.Mesh, ...]:
    """Rows of bricks, every second one shifted by half a brick: each corner lies on an edge."""
    found = []
    for row in range(4):
        marks = [0.0, *np.arange(0.125 + 0.125 * (row % 2), 1.0, 0.25), 1.0]
        for left, right in zip(marks, marks[1:]):
            found.append(sheet((left, row / 4), (right, (row + 1) / 4), 1, 1))
    return tuple(found)


def turned(piece: geometry.Mesh, axis: int) -> geometry.Mesh:
    return geometry.mesh(np.roll(piece.vertices, axis, axis=1), piece.faces)


def flipped(piece: geometry.Mesh) -> geometry.Mesh:
    return geometry.mesh(piece.vertices, piece.faces[:, ::-1])


def box() -> tuple[geometry.Mesh, ...]:
    """Six sides with as many cells as they have numbers."""
    found = []
    for axis in range(3):
        for side in (0, 1):
            cells = 1 + 2 * axis + side
            piece = turned(moved(sheet((0, 0), (1, 1), cells, cells), (0, 0, side)), axis)
            found.append(piece if side else flipped(piece))
    return tuple(found)


def specks(count: int) -> tuple[geometry.Mesh, ...]:
    return tuple(moved(sheet((0, 0), (0.05, 0.05), 1, 1), (2.0 + k, 0, 0)) for k in range(count))


PLATE = sheet((0, 0), (1, 1), 4, 4)
BALL = geometry.icosphere(2)
BROUGHT = (
    Brought("cells half as large beside", (PLATE, sheet((1, 0), (2, 1), 8, 8))),
    Brought("cells a quarter as large beside", (sheet((0, 0), (1, 1), 2, 2),
                                               sheet((1, 0), (2, 1), 8, 8))),
    Brought("the same, wound the other way round", (PLATE, flipped(sheet((1, 0), (2, 1), 8, 8)))),
    Brought("strips of 2, 3 and 5 cells", (sheet((0, 0), (0.5, 1), 1, 2),
                                           sheet((0.5, 0), (1, 1), 1, 3),
                                           sheet((1, 0), (1.5, 1), 1, 5))),
    Brought("a wall of bricks", bricks()),
    Brought("a box whose sides are divided each in its way", box()),
    Brought("a tube of two halves", (rolled(sheet((0, 0), (4, 2), 4, 3)),
                                     rolled(sheet((4, 0), (8, 2), 4, 4)))),
    Brought("one sheet over the end of another", (PLATE, sheet((1, -1), (2, 2), 2, 7))),
    Brought("a gap that is seen", (PLATE, moved(PLATE, (1.02, 0, 0))), 2),
    Brought("four plates", tuple(moved(PLATE, (1.5 * k, 0, 0)) for k in range(4)), 4),
    Brought("balls in balls", (BALL, moved(BALL, (0, 0, 0), 0.7), moved(BALL, (0, 0, 0), 0.4)), 3),
    Brought("sheets through each other", (PLATE, moved(turned(PLATE, 1), (0.47, 0.03, -0.52))), 2),
    Brought("plates that touch in a corner", (PLATE, moved(PLATE, (1, 1, 0))), 2),
    Brought("specks beside a plate", (PLATE, *specks(5)), 6, 5),
    Brought("the same without them", (PLATE, *specks(5)), 1, 0, ("--smallest-part", "0.1")),
)  # fmt: skip


def written(path: Path, pieces: tuple[geometry.Mesh, ...]) -> Path:
    """All of them, each with vertices of its own, as separate exporters write them."""
    text, count = "", 0
    for piece in pieces:
        text += "".join("v {!r} {!r} {!r}\n".format(*place) for place in piece.vertices.tolist())
        text += "".join("f {} {} {}\n".format(*(face + 1 + count)) for face in piece.faces)
        count += len(piece.vertices)
    path.write_text(text)
    return path


def area_of(pieces: tuple[geometry.Mesh, ...]) -> float:
    return sum(float(geometry.triangle_areas(*piece).sum()) for piece in pieces)


@pytest.mark.parametrize("brought", BROUGHT, ids=lambda brought: brought.title)
def test_a_mesh_has_as_many_lines_as_parts(tmp_path: Path, capsys, brought: Brought) -> None:
    mesh = written(tmp_path / "mesh.obj", brought.pieces)
    report = tmp_path / "report.json"
    given = ["--input", mesh, "--output", tmp_path / "out.obj", "--report", report]
    given += ["--spacing", SPACING, *brought.words]
    assert batch.main([str(one) for one in given]) == 0
    record = json.loads(report.read_text())
    lines = record["lines"]
    assert (lines["count"], lines["small_parts"]) == (brought.lines, brought.small)
    said = capsys.readouterr().out
    if brought.lines == 1:
        assert not lines["why"]
    else:
        small = f", {brought.small} of them smaller than the spacing" if brought.small else ""
        assert f"{brought.lines} lines: the mesh has {brought.lines} parts{small}" in said
    kept = brought.pieces if not brought.words else brought.pieces[:1]
    assert record["surface"]["area"] == pytest.approx(area_of(kept), rel=1e-6)
