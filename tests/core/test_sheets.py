# SPDX-License-Identifier: GPL-3.0-or-later
"""Drawings in sheets of paper: laid together, what is on them is the drawing, and marks meet."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import geometry
import numpy as np
import pytest
from flows import fill
from meander.cli import writing
from meander.model import sheets as files
from meander.model.files.whole import FileError
from meander.model.toolpaths.drawing import Drawing
from meander.model.toolpaths.sheets import Paper, number_of, sheets_of
from meander.model.toolpaths.toolpath import Strand, strand_of
from sentences import assert_sentence
from test_gcode_tools import Machine

SVG = "{http://www.w3.org/2000/svg}"
# Files have thousandths of a millimetre.
ROUNDED = 1e-3


def strand(points: np.ndarray, closed: bool = False, part: int = 0) -> Strand:
    places = np.column_stack([np.asarray(points, dtype=float), np.zeros(len(points))])
    made = strand_of(places, np.tile([0.0, 0.0, 1.0], (len(places), 1)), closed)
    return replace(made, part=part)


def ring(one: Strand) -> np.ndarray:
    return (np.vstack([one.points, one.points[:1]]) if one.closed else one.points)[:, :2]


def length(way: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(way, axis=0), axis=1).sum())


def places_of(parted) -> dict[str, np.ndarray]:
    """Where the lower left corner of each sheet lies when they are laid together, from that of the
    first column and the last row: margins lie upon one another."""
    width = parted.paper.width - 2.0 * parted.paper.margin
    height = parted.paper.height - 2.0 * parted.paper.margin
    return {
        sheet.name: np.array([(sheet.column - 1) * width, (parted.rows - sheet.row) * height])
        for sheet in parted.drawn
    }


def joined(pieces: list[np.ndarray], tolerance: float) -> list[np.ndarray]:
    """Ways (n, 2) put together where one ends and another begins, each used once."""
    left, whole = list(pieces), []
    while left:
        way = left.pop(0)
        while True:
            for place, other in enumerate(left):
                if np.abs(way[-1] - other[0]).max() <= tolerance:
                    way = np.vstack([way, left.pop(place)[1:]])
                    break
                if np.abs(other[-1] - way[0]).max() <= tolerance:
                    way = np.vstack([left.pop(place), way[1:]])
                    break
            else:
                break
        whole.append(way)
    return whole


def assert_same_way(found: np.ndarray, wanted: np.ndarray, tolerance: float) -> None:
    """The same corners in the same order, and between them none that is off the line."""
    assert length(found) == pytest.approx(length(wanted), abs=len(found) * tolerance)
    if np.abs(wanted[0] - wanted[-1]).max() <= tolerance:  # which may begin elsewhere
        begin = int(np.abs(found - wanted[0]).max(axis=1).argmin())
        found = np.vstack([found[begin:], found[1 : begin + 1]])
    at = 0
    for here, there in zip(wanted[:-1], wanted[1:]):
        assert np.abs(found[at] - here).max() <= tolerance
        while np.abs(found[at] - there).max() > tolerance:
            at += 1
            away = found[at] - here
            along = (there - here) / np.linalg.norm(there - here)
            assert abs(away[0] * along[1] - away[1] * along[0]) <= tolerance
    assert np.abs(found[-1] - wanted[-1]).max() <= tolerance


def walk(rng: np.random.Generator, count: int, size: float) -> np.ndarray:
    return np.cumsum(rng.normal(scale=size / 9.0, size=(count, 2)), axis=0)


@pytest.mark.parametrize("number", range(12))
def test_sheets_laid_together_are_the_drawing(number: int) -> None:
    rng = np.random.default_rng(number)
    unit, millimetres = [("mm", 1.0), ("cm", 10.0), ("in", 25.4)][number % 3]
    size = [60.0, 300.0, 900.0][number // 4] / millimetres
    ways = [walk(rng, int(rng.integers(2, 60)), size) for _ in range(4)]
    whole = Drawing([strand(way, k % 2 == 1) for k, way in enumerate(ways)], unit, True)
    paper = Paper(200.0 + 30.0 * (number % 4), 150.0, [0.0, 3.0, 15.0][number % 3])
    parted = sheets_of(whole, paper)
    mm, there = whole.millimetres, places_of(parted)
    middle = np.add(*(corner[:2] for corner in whole.box())) / 2.0
    room = np.array([paper.width, paper.height]) - 2.0 * paper.margin
    # The drawing lies in the middle of them.
    shift = room * (parted.columns, parted.rows) / 2.0 + paper.margin - middle * mm
    pieces = []
    for sheet in parted.drawn:
        of_page = np.vstack([ring(one) for one in sheet.drawing.strands]) * mm
        assert (of_page >= paper.margin - 1e-6).all()
        assert (of_page <= np.array([paper.width, paper.height]) - paper.margin + 1e-6).all()
        pieces += [ring(one) * mm + there[sheet.name] for one in sheet.drawing.strands]
    found = joined(pieces, 1e-6)
    assert len(found) == len(ways)
    for way in (ring(one) * mm + shift for one in whole.strands):
        best = min(found, key=lambda each: abs(length(each) - length(way)))
        assert_same_way(best, way, 1e-6)
    assert parted.rows * parted.columns == number_of(whole, paper)
    assert len(parted.drawn) + len(parted.empty) == parted.rows * parted.columns


def test_pieces_come_in_the_order_of_the_line() -> None:
    turns = np.arange(0.0, 40.0, 0.05)
    spiral = np.column_stack([np.cos(turns), np.sin(turns)]) * (10.0 + 5.0 * turns)[:, None]
    parted = sheets_of(Drawing([strand(spiral, part=3)], "mm", True), Paper(120, 120, 10.0))
    for sheet in parted.drawn:
        centre = places_of(parted)[sheet.name]
        middle = np.array([parted.columns, parted.rows]) * 50.0 + 10.0
        away = [np.linalg.norm(ring(each) + centre - middle, axis=1).mean()
                for each in sheet.drawing.strands]  # fmt: skip
        assert away == sorted(away)
        assert all(each.part == 3 for each in sheet.drawing.strands)


def test_a_closed_line_is_one_piece_through_its_beginning() -> None:
    square = strand([(50, 10), (90, 10), (90, 40), (10, 40), (10, 10)], closed=True)
    parted = sheets_of(Drawing([square], "mm", True), Paper(60, 60, 10.0))
    assert [len(sheet.drawing.strands) for sheet in parted.drawn] == [1, 1]
    small = strand([(50, 10), (60, 10), (60, 20)], closed=True)
    parted = sheets_of(Drawing([small], "mm", True), Paper(60, 60, 10.0))
    assert parted.drawn[0].drawing.strands[0].closed, "what one sheet holds stays closed"


@pytest.mark.parametrize(
    "points",
    [
        [(0, 0), (40, 40), (80, 80)],  # from sheet to sheet through a corner
        [(0, 0), (80, 80)],
        [(0, 40), (80, 40), (80, 0)],  # along an edge
        [(0, 0), (40, 20), (0, 40), (80, 80)],  # touches one
        [(0, 0), (0, 0), (80, 80), (80, 80)],
        [(0, 0), (40, 40), (40, 40), (40, 40), (80, 0)],
    ],
)
def test_corners_and_edges_make_no_dots(points: list) -> None:
    frame = strand([(0, 0), (80, 0), (80, 80), (0, 80)], closed=True)
    parted = sheets_of(Drawing([frame, strand(points)], "mm", True), Paper(60, 60, 10.0))
    assert (parted.rows, parted.columns) == (2, 2), "what fits to the last bit fits"
    pieces = [ring(one) + places_of(parted)[sheet.name]
              for sheet in parted.drawn for one in sheet.drawing.strands]  # fmt: skip
    assert min(map(length, pieces)) > 1.0
    assert sum(map(length, pieces)) == pytest.approx(320.0 + length(np.array(points, float)))


def crosses(sheet, there: np.ndarray) -> set[tuple]:
    return {tuple(np.round(np.sort(ring(mark) + there, axis=0), 6).ravel())
            for mark in sheet.drawing.page.marks}  # fmt: skip


@pytest.mark.parametrize("margin", [3.0, 15.0])
def test_marks_of_neighbours_meet_and_lie_on_the_paper(margin: float) -> None:
    frame = strand([(0, 0), (280, 0), (280, 350), (0, 350)], closed=True)
    across = strand([(0, 0), (280, 350)]), strand([(280, 0), (0, 350)])
    parted = sheets_of(Drawing([frame, *across], "mm", True), Paper(140, 140, margin))
    assert not parted.empty
    there = places_of(parted)
    by_place = {(sheet.row, sheet.column): crosses(sheet, there[sheet.name])
                for sheet in parted.drawn}  # fmt: skip
    for (row, column), marks in by_place.items():
        assert len(marks) == 8
        for neighbour in ((row, column + 1), (row + 1, column)):
            if neighbour in by_place:
                assert len(marks & by_place[neighbour]) == 4
    for sheet in parted.drawn:
        ends = np.vstack([ring(mark) for mark in sheet.drawing.page.marks])
        assert ends.min() >= 0.0 and ends.max() <= 140.0
    none = sheets_of(Drawing([frame], "mm", True), Paper(140, 140, 0.0))
    assert not none.drawn[0].drawing.page.marks, "without a margin the paper's edges meet"


def test_what_has_a_name_may_lie_and_what_is_too_much_is_refused() -> None:
    wide = Drawing([strand([(0, 0), (260, 100)])], "mm", True)
    assert number_of(wide, Paper(210.0, 297.0)) == 2
    assert sheets_of(wide, Paper(210.0, 297.0, turns=True)).paper.width == 297.0
    for paper in (Paper(20.0, 20.0, 10.0), Paper(2.0, 2.0, 0.5)):
        with pytest.raises(FileError) as refusal:
            sheets_of(wide, paper)
        assert_sentence(str(refusal.value))


# ------------------------------------------------------------------------------------------------
# Files


@pytest.fixture(scope="module")
def mesh(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return geometry.write_obj(tmp_path_factory.mktemp("mesh") / "mesh.obj", geometry.grid(6))


def run(mesh: Path, output: Path, *extra: object) -> int:
    return fill(mesh, output, "--spacing", "0.1", "--iterations", "80", *extra)


def svg(path: Path) -> tuple[list[np.ndarray], list[np.ndarray], np.ndarray]:
    """Lines, marks and the sides of a page in millimetres, y upwards from its lower left corner."""
    root = ElementTree.parse(path).getroot()
    assert root.get("width").endswith("mm")
    sides = np.array(root.get("viewBox").split()[2:], dtype=float)
    lines, marks = [], []
    for path_element in root.iter(f"{SVG}path"):
        text = path_element.get("d")
        way = np.array(re.findall(r"-?\d+\.?\d*", text), dtype=float).reshape(-1, 2)
        way = np.vstack([way, way[:1]]) if text.endswith("Z") else way
        way = way * [1.0, -1.0] + [0.0, sides[1]]
        (marks if path_element.get("id").startswith("mark") else lines).append(way)
    return lines, marks, sides


def dxf(path: Path) -> tuple[list[np.ndarray], list[np.ndarray], np.ndarray]:
    text = path.read_text().split("\n")
    pairs = [(int(code), value) for code, value in zip(text[::2], text[1::2])]
    high = [i for i, pair in enumerate(pairs) if pair == (9, "$EXTMAX")][0]
    sides = np.array([float(pairs[high + 1][1]), float(pairs[high + 2][1])])
    found: dict[str, list] = {}
    for i, (code, value) in enumerate(pairs):
        if (code, value) == (0, "POLYLINE"):
            found.setdefault(pairs[i + 1][1], []).append([])
        elif (code, value) == (0, "VERTEX"):
            place = [float(pairs[i + 2][1]), float(pairs[i + 3][1])]
            found[pairs[i + 1][1]][-1].append(place)
    ways = {layer: [np.array(way) for way in those] for layer, those in found.items()}
    return ways["MEANDER"], ways.get("MEANDER_MARKS", []), sides


def gcode(path: Path) -> tuple[list[np.ndarray], list[np.ndarray], np.ndarray]:
    drawn = [np.array(way)[:, :2] for way in Machine("pen").run(path.read_text(), 0.0).drawn]
    drawn = [way[np.append(True, np.abs(np.diff(way, axis=0)).sum(axis=1) > 0)] for way in drawn]
    marks = path.read_text().count("; mark ")
    return drawn[marks:], drawn[:marks], np.array([210.0, 297.0])


READERS = {"svg": svg, "dxf": dxf, "nc": gcode}


@pytest.mark.parametrize("suffix", READERS)
def test_files_of_sheets_are_the_file_of_the_whole(mesh: Path, tmp_path: Path, suffix: str) -> None:
    output, report = tmp_path / f"out.{suffix}", tmp_path / "out.json"
    asked = ("--layout", "top", "--size", "500", "--sheet", "210x297", "--sheet-margin", "12")
    assert run(mesh, output, *asked, "--report", report, "--quiet") == 0
    entry = json.loads(report.read_text())["drawing"]["sheets"]
    assert (entry["paper"], entry["margin"]) == ([210.0, 297.0], 12.0)
    names = {each["file"] for each in entry["written"]}
    assert names == {path.name for path in tmp_path.iterdir()} - {"out.json", output.name, "mesh"}
    assert len(names) == 6 and f"out_r2c3.{suffix}" in names and not entry["empty"]
    pieces, marks = [], {}
    for each in entry["written"]:
        lines, crosses, sides = READERS[suffix](tmp_path / each["file"])
        assert len(lines) == each["paths"] and sides.tolist() == [210.0, 297.0]
        assert sum(map(length, lines)) == pytest.approx(each["length"], abs=0.1)
        everything = np.vstack(lines + crosses)
        assert (everything >= 0.0).all() and (everything <= sides).all()
        there = np.array([(each["column"] - 1) * 186.0, (entry["rows"] - each["row"]) * 273.0])
        pieces += [way + there for way in lines]
        for cross in crosses:
            place = tuple(np.round(cross + there, 3).ravel())
            marks[place] = marks.get(place, 0) + 1
    # Twelve crosses of two strokes: of four sheets in the middle, of two at the sides, of one.
    assert sorted(marks.values()) == [1] * 8 + [2] * 12 + [4] * 4
    (whole,), _marks, _sides = READERS[suffix](output)
    (found,) = joined(pieces, 2 * ROUNDED)
    if suffix == "dxf":
        whole = np.vstack([whole, whole[:1]])
    box = [np.array([way.min(axis=0), way.max(axis=0)]).mean(axis=0) for way in (found, whole)]
    assert_same_way(found - box[0], whole - box[1], 4 * ROUNDED)


def test_arcs_of_sheets_begin_and_end_where_they_meet(mesh: Path, tmp_path: Path) -> None:
    asked = ("--layout", "top", "--size", "500", "--sheet", "a4", "--arcs", "0.1", "--quiet")
    assert run(mesh, tmp_path / "out.svg", *asked) == 0
    ends: dict[tuple, int] = {}
    arcs = 0
    for path in sorted(tmp_path.glob("out_*.svg")):
        row, column = map(int, re.fullmatch(r"out_r(\d)c(\d)", path.stem).groups())
        root = ElementTree.parse(path).getroot()
        sides = np.array(root.get("viewBox").split()[2:], dtype=float)
        for element in root.iter(f"{SVG}path"):
            text = element.get("d")
            if element.get("id").startswith("mark") or text.endswith("Z"):
                continue
            arcs += text.count("A")
            numbers = re.findall(r"-?\d+\.?\d*", text)
            for x, y in (numbers[:2], numbers[-2:]):
                place = (round(float(x) + (column - 1) * (sides[0] - 30.0), 2),
                         round(float(y) + (row - 1) * (sides[1] - 30.0), 2))  # fmt: skip
                ends[place] = ends.get(place, 0) + 1
    assert arcs > 4 and ends and set(ends.values()) == {2}


def test_sheets_with_nothing_on_them_are_said_and_not_written(tmp_path, capsys) -> None:
    """Two bodies in opposite corners."""
    grid = geometry.grid(6, 1.0)
    apart = grid.vertices + [4.0, 4.0, 0.0]
    both = geometry.mesh(
        np.vstack([grid.vertices, apart]), np.vstack([grid.faces, grid.faces + len(apart)])
    )
    mesh = geometry.write_obj(tmp_path / "two.obj", both)
    asked = ("--layout", "top", "--size", "380", "--sheet", "220x220", "--report")
    assert run(mesh, tmp_path / "out.svg", *asked, tmp_path / "out.json") == 0
    said = capsys.readouterr().out
    assert "2 sheets of 220 x 220 mm, out_r1c2.svg to out_r2c1.svg; nothing lies on" in said
    assert "r1c1, r2c2, which are not written" in said
    assert {path.name for path in tmp_path.glob("out_*")} == {"out_r1c2.svg", "out_r2c1.svg"}
    assert json.loads((tmp_path / "out.json").read_text())["drawing"]["sheets"]["empty"] == [
        "r1c1", "r2c2",
    ]  # fmt: skip


@pytest.mark.parametrize(
    "output, options, said",
    [
        ("out.obj", ("--sheet", "a4"), "does nothing for an --output of kind .obj"),
        ("out.dst", ("--sheet", "a4"), "does nothing for an --output of kind .dst"),
        ("out.pes", ("--sheet", "a4"), "give a --size that fits into the hoop"),
        ("out.dxf", ("--sheet", "a4"), "flat; give a --layout such as top"),
        ("out.svg", ("--sheet-margin", "3"), "give both or none"),
        ("out.svg", ("--sheet", "a4", "--sheet-margin", "105"), "leaves nothing of a sheet of 210"),
        ("out.svg", ("--sheet", "b7"), "is no paper; choose from a5"),
        ("out.svg", ("--sheet", "2x2", "--sheet-margin", ".5"), "more than 1,000"),
        ("-", ("--sheet", "a4", "--output-format", "svg"), "several files"),
    ],
)
def test_what_cannot_be_is_one_sentence(mesh, tmp_path, monkeypatch, capsys, output, options, said):
    monkeypatch.chdir(tmp_path)
    assert run(mesh, Path(output), *options, "--quiet") == 2
    error = capsys.readouterr().err.strip()
    assert_sentence(error)
    assert said in error
    assert not list(tmp_path.iterdir())


def test_sheets_stay_as_they_were_where_another_file_cannot_be_written(
    mesh: Path, tmp_path: Path, monkeypatch, capsys
) -> None:
    asked = ("--layout", "top", "--size", "380", "--sheet", "220x220", "--report")
    output, report = tmp_path / "out.svg", tmp_path / "out.json"
    assert run(mesh, output, *asked, report) == 0
    sheets = {path: path.read_bytes() for path in tmp_path.glob("out*")}
    assert len(sheets) > 3

    def full(*_arguments: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(writing.report, "write_report", full)
    assert run(mesh, output, *asked, report, "--variation", "1") == 2
    assert "out.json cannot be written (No space left" in capsys.readouterr().err
    assert {path: path.read_bytes() for path in tmp_path.glob("out*")} == sheets
    assert not [path for path in tmp_path.iterdir() if path.name.startswith(".")]


def test_no_sheet_is_written_over_what_is_read(mesh: Path, tmp_path: Path, capsys) -> None:
    head = tmp_path / "out_r1c1.nc"
    head.write_text("G17\n")
    other = tmp_path / "head.nc"
    asked = ("--layout", "top", "--sheet", "a4", "--header")
    assert run(mesh, tmp_path / "out.nc", *asked, head) == 2
    assert "--sheet would overwrite --header" in capsys.readouterr().err
    head.rename(other)
    (tmp_path / "out_r1c1.nc").symlink_to(other)
    assert run(mesh, tmp_path / "out.nc", *asked, other) == 2
    assert other.read_text() == "G17\n"
    assert files.is_of(Path("a/b.svg"), Path("a/b_r12c3.svg"))
    assert not files.is_of(Path("a/b.svg"), Path("a/b_r0c3.svg"))
    assert not files.is_of(Path("a/b.svg"), Path("b_r1c3.svg"))
