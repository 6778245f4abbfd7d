# SPDX-License-Identifier: GPL-3.0-or-later
"""What is made of the curve keeps its promises or says so: crossings of flat drawings, stitches,
units and axes of mesh files, sizes that no machine takes."""

from __future__ import annotations

import json
from pathlib import Path

import geometry
import numpy as np
import pytest
from meander import batch
from meander.model.geometry.flat_crossings import crossings, segments_of
from meander.model.toolpaths import embroidery, parts, toolpath
from meander.model.toolpaths.drawing import drawing_of
from sentences import assert_sentence


def run(mesh: Path, name: str, *extra: str, spacing: float = 0.2) -> int:
    report = mesh.with_name("report.json")
    given = ["--input", mesh, "--output", mesh.with_name(name), "--spacing", spacing]
    return batch.main([str(a) for a in (*given, "--quiet", "--report", report, *extra)])


def figures(mesh: Path) -> dict:
    return json.loads(mesh.with_name("report.json").read_text())


# ------------------------------------------------------------------------------------------------
# Crossings


def by_brute_force(ways: list[np.ndarray]) -> int:
    """How many pairs of segments cross within both, in whole numbers and so exactly."""
    pieces = [(w[k], w[k + 1]) for w in ways for k in range(len(w) - 1)]

    def side(a, b, p) -> int:
        value = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        return (value > 0) - (value < 0)

    return sum(
        side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0
        for i, (a, b) in enumerate(pieces)
        for c, d in pieces[:i]
    )


@pytest.mark.parametrize("number", range(5))
def test_every_crossing_is_counted_and_none_else(number: int) -> None:
    rng = np.random.default_rng(number)
    ways = [rng.integers(0, 40, size=(int(rng.integers(2, 60)), 2)) for _ in range(3)]
    begin, end, _owner = segments_of([w.astype(float) for w in ways], [False] * 3)
    whole = [[tuple(map(int, p)) for p in w] for w in ways]
    first, second, places = crossings(begin, end)
    assert len(places) == by_brute_force(whole)
    for a, b, c, d, place in zip(
        begin[first], end[first], begin[second], end[second], places, strict=True
    ):
        for p, q in ((a, b), (c, d)):
            cross = (q - p)[0] * (place - p)[1] - (q - p)[1] * (place - p)[0]
            assert abs(cross) < 1e-6 * np.linalg.norm(q - p)


def test_a_drawing_that_crosses_itself_says_so(tmp_path: Path, capsys) -> None:
    """Both sides of a ball, seen from above."""
    ball = geometry.write_obj(tmp_path / "ball.obj", geometry.icosphere(3))
    assert run(ball, "a.svg", "--layout", "top", "--size", "100") == 0
    drawing = figures(ball)["drawing"]
    said = capsys.readouterr().err
    assert drawing["crossings"] > 50 and len(drawing["crossing_places"]) == 20
    assert f"crosses itself at {drawing['crossings']:,} places" in said
    assert_sentence(said.strip())
    assert "leave out what is hidden by Visible Only (--visible-only)" in said


def test_a_flat_surface_has_a_drawing_without_crossings(tmp_path: Path, capsys) -> None:
    sheet = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(8))
    for name in ("a.svg", "a.dxf", "a.gcode"):
        assert run(sheet, name, "--layout", "top", "--size", "100", spacing=0.08) == 0
        assert figures(sheet)["drawing"]["crossings"] == 0
    assert run(sheet, "b.svg", "--chord-tolerance", "0.03", "--size", "100", spacing=0.05) == 0
    drawing, said = figures(sheet)["drawing"], capsys.readouterr().err
    assert (drawing["crossings"] > 0) == ("crosses itself" in said)


# ------------------------------------------------------------------------------------------------
# Stitches


def zigzag(spacing: float, rows: int) -> toolpath.Strand:
    """Rows a spacing apart that are joined by half circles."""
    points = []
    for row in range(rows):
        xs = np.linspace(0.0, 20.0, 41)
        points += [(x, row * spacing) for x in (xs if row % 2 == 0 else xs[::-1])]
        angles = np.linspace(-np.pi / 2, np.pi / 2, 9)[1:-1]
        side = 1.0 if row % 2 == 0 else -1.0
        middle = (20.0 if row % 2 == 0 else 0.0, (row + 0.5) * spacing)
        points += [
            (middle[0] + side * np.cos(a) * spacing / 2, middle[1] + np.sin(a) * spacing / 2)
            for a in angles
        ]
    flat = np.column_stack([np.array(points), np.zeros(len(points))])
    return toolpath.strand_of(flat, np.tile([0.0, 0.0, 1.0], (len(flat), 1)), False)


@pytest.mark.parametrize("stitch", [1.0, 2.5, 4.0, 12.0])
@pytest.mark.parametrize("tolerance", [0.0, 0.05, 0.3])
def test_stitches_keep_within_the_tolerance(stitch: float, tolerance: float) -> None:
    curve = zigzag(1.0, 12)
    drawing = drawing_of([curve], "mm", 0.001, 1.0, 0.0, True, 1.0)
    thread = embroidery.stitched(drawing, stitch, tolerance)
    (strand,) = thread.strands
    # What the grid of a machine adds, of which no finer tolerance is any use.
    grid = 0.1 * np.sqrt(0.5)
    allowed = max(tolerance or 0.1, grid) + grid
    assert geometry.farthest(drawing.strands[0].points, strand.points) <= allowed * (1 + 1e-9)
    lengths = np.linalg.norm(np.diff(strand.points, axis=0), axis=1)
    assert lengths.max() <= stitch * (1 + 1e-9) and lengths.min() >= 0.3 * (1 - 1e-9)
    assert np.abs(10.0 * strand.points - np.round(10.0 * strand.points)).max() < 1e-6
    assert len(thread.crossings()) == 0
    # The ends of the curve are those of the thread, and where it is straight stitches are long.
    assert np.abs(strand.points[[0, -1]] - drawing.strands[0].points[[0, -1]]).max() <= 0.0501
    assert len(strand.points) < len(curve.points) * max(1.0, 2.0 / stitch) * 2


def test_the_command_stitches_what_the_machine_reads(tmp_path: Path) -> None:
    pyembroidery = pytest.importorskip("pyembroidery")
    sheet = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(8))
    for stitch in ("2.5", "6"):
        given = ("--layout", "top", "--size", "60", "--stitch-length", stitch)
        assert run(sheet, "a.dst", *given, spacing=0.03) == 0
        pattern = pyembroidery.read(str(tmp_path / "a.dst"))
        places = [
            (x / 10.0, y / 10.0)
            for x, y, command in pattern.stitches
            if command & pyembroidery.COMMAND_MASK == pyembroidery.STITCH
        ]
        thread = np.linalg.norm(np.diff(np.array(places), axis=0), axis=1)
        drawing = figures(sheet)["drawing"]
        assert drawing["crossings"] == 0
        assert thread.sum() == pytest.approx(drawing["length"], rel=0.03)
        curve = figures(sheet)["length"] * 60.0  # the sheet is about 1 wide, and so 60 mm
        assert drawing["length"] == pytest.approx(curve, rel=0.06)


# What is stitched: a mesh, a spacing, and options.
STITCHED = {
    "a sheet": ("grid", 0.03, ("--size", "60")),
    "a small sheet": ("grid", 0.05, ("--size", "10")),
    "a tiny sheet": ("grid", 0.1, ("--size", "4")),
    "long stitches": ("grid", 0.05, ("--size", "60", "--stitch-length", "12.1")),
    "a fine tolerance": ("grid", 0.05, ("--size", "60", "--stitch-tolerance", "0.01")),
    "short stitches": ("grid", 0.05, ("--size", "60", "--stitch-length", "0.7")),
    "parts": ("grid", 0.06, ("--size", "60", "--part-length", "3")),
    "parts that overlap": (
        "grid", 0.06, ("--size", "60", "--part-length", "3", "--part-overlap", "0.1")
    ),
    "two balls": ("two_spheres", 0.3, ("--size", "30")),
    "longer ones at least": ("grid", 0.06, ("--size", "60", "--least-stitch", "1")),
    "a cube seen from above": ("cube", 0.2, ("--size", "50")),
}  # fmt: skip


@pytest.mark.parametrize("name", STITCHED)
def test_no_stitch_of_a_file_is_shorter_than_the_least(name: str, tmp_path: Path) -> None:
    pyembroidery = pytest.importorskip("pyembroidery")
    made, spacing, words = STITCHED[name]
    mesh = geometry.grid(8) if made == "grid" else getattr(geometry, made)()
    path = geometry.write_obj(tmp_path / "mesh.obj", mesh)
    assert run(path, "a.dst", "--layout", "top", *words, spacing=spacing) == 0
    given = dict(zip(words[::2], map(float, words[1::2]), strict=True))
    pattern = pyembroidery.read(str(tmp_path / "a.dst"))
    rows = np.array([(x, y, c & pyembroidery.COMMAND_MASK) for x, y, c in pattern.stitches])
    lengths = np.linalg.norm(np.diff(rows[:, :2], axis=0, prepend=[[0, 0]]), axis=1) / 10.0
    of_stitch = lengths[rows[:, 2] == pyembroidery.STITCH]
    assert len(of_stitch) > 20
    assert of_stitch.min() >= given.get("--least-stitch", 0.3) - 1e-9
    assert of_stitch.max() <= given.get("--stitch-length", 2.5) + 1e-9
    # A machine stops between parts, so that the thread can be changed, and nowhere else.
    stops = int(np.count_nonzero(rows[:, 2] == pyembroidery.COLOR_CHANGE))
    strands = int(np.count_nonzero(rows[:, 2] == pyembroidery.TRIM))
    assert stops == (strands - 1 if "--part-length" in given else 0)
    assert ("--part-length" in given) == (stops > 0)


@pytest.mark.parametrize("length", [0.29, 0.31, 0.35, 0.41, 0.6, 1.0, 2.6, 3.1])
@pytest.mark.parametrize("closed", [False, True])
def test_parts_as_short_as_a_stitch_have_none_that_is_shorter(length: float, closed: bool) -> None:
    """The grid of a machine takes the ends of a part nearer to each other."""
    turn = np.linspace(0.0, 2 * np.pi, 400, endpoint=False)
    radius = 20.0 + 3.0 * np.sin(7 * turn)
    points = np.column_stack([radius * np.cos(turn), radius * np.sin(turn), 0.0 * turn])
    curve = toolpath.strand_of(points, np.tile([0.0, 0.0, 1.0], (len(turn), 1)), closed)
    drawing = drawing_of(parts.parted([curve], length), "mm", 0.001, 1.0, 0.0, True, 1.0)
    thread = embroidery.stitched(drawing, 2.5, 0.0)
    lengths = np.concatenate(
        [np.linalg.norm(np.diff(each.points, axis=0), axis=1) for each in thread.strands]
    )
    assert lengths.min() >= 0.3 * (1 - 1e-9) and lengths.max() <= 2.5 * (1 + 1e-9)
    assert len(thread.strands) == len(drawing.strands) or length < 0.45


def test_what_is_smaller_than_a_stitch_is_a_sentence(tmp_path: Path, capsys) -> None:
    pytest.importorskip("pyembroidery")
    sheet = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(8))
    assert run(sheet, "a.dst", "--layout", "top", "--size", "0.05") == 2
    said = capsys.readouterr().err.strip()
    assert_sentence(said)
    assert "shorter than a stitch" in said and not (tmp_path / "a.dst").exists()


# ------------------------------------------------------------------------------------------------
# Units and axes


@pytest.fixture
def plate(tmp_path: Path) -> Path:
    """A square of side 90, as many programs write it: in millimetres, and y points up."""
    vertices, faces = geometry.grid(4)
    lying = np.column_stack([vertices[:, 0], np.zeros(len(vertices)), -vertices[:, 1]])
    return geometry.write_obj(tmp_path / "plate.obj", geometry.Mesh(90.0 * lying, faces))


@pytest.mark.parametrize("suffix", ["svg", "dxf", "gcode"])
def test_what_no_machine_can_draw_is_refused(plate: Path, suffix: str, capsys) -> None:
    out, given = f"a.{suffix}", ("--layout", "top", "--input-up", "y", "--input-unit", "mm")
    assert run(plate, out, *given, "--scale", "1e-5", spacing=9) == 2
    said = capsys.readouterr().err
    assert " mm wide, which no machine can draw; say by --input-unit" in said and "--force" in said
    assert_sentence(said.strip())
    assert not (plate.parent / out).exists()
    assert run(plate, out, *given, "--scale", "1e-5", "--force", spacing=9) == 0


@pytest.mark.parametrize("suffix", ["svg", "dxf", "gcode"])
def test_what_no_machine_takes_is_refused(plate: Path, suffix: str, capsys) -> None:
    out, given = f"a.{suffix}", ("--layout", "top")
    assert run(plate, out, *given, "--input-up", "y", spacing=9) == 2
    said = capsys.readouterr().err
    assert "--input-unit" in said and "--force" in said and "m wide" in said
    assert_sentence(said.strip())
    assert run(plate, out, *given, "--input-unit", "mm", spacing=9) == 2
    said = capsys.readouterr().err
    assert "edge on" in said and "--layout front" in said and "--input-up y" in said
    assert_sentence(said.strip())
    assert not plate.with_name(out).exists() and not plate.with_name("report.json").exists()
    assert run(plate, out, *given, "--input-unit", "mm", "--input-up", "y", spacing=9) == 0
    sides = sorted(figures(plate)["drawing"]["sides"])
    assert 70 < sides[1] <= sides[2] < 90
    options = figures(plate)["options"]
    assert (options["input_unit"], options["input_up"]) == ("mm", "y")
    for forced in ("--input-unit mm --force", "--input-up y --force"):
        assert run(plate, out, *given, *forced.split(), spacing=9) == 0


def test_the_report_says_what_was_assumed(plate: Path) -> None:
    assert run(plate, "a.svg", "--layout", "front", "--size", "50", spacing=9) == 0
    options = figures(plate)["options"]
    assert (options["input_unit"], options["input_up"]) == ("m", "z")


@pytest.mark.parametrize(
    ("unit", "millimetres"), [("mm", 1.0), ("cm", 10.0), ("in", 25.4), ("m", 1000.0)]
)
def test_the_unit_of_the_file_is_that_of_the_drawing(plate: Path, unit, millimetres) -> None:
    given = ("--layout", "front", "--input-unit", unit, "--force")
    assert run(plate, "a.svg", *given, spacing=9) == 0
    assert run(plate, "b.svg", *given, "--unit", "in", spacing=9) == 0
    inches = max(figures(plate)["drawing"]["sides"])
    assert inches * 25.4 == pytest.approx(max(sides_of(plate, "a.svg")), abs=0.01)
    assert 75 * millimetres < inches * 25.4 < 90 * millimetres


def sides_of(plate: Path, name: str) -> list[float]:
    """Of an SVG file, without the margin, as its own text says."""
    head = plate.with_name(name).read_text().split("<title>")[0]
    return [float(head.split(f'{side}="')[1].split("mm")[0]) - 0.6 for side in ("width", "height")]


def test_a_straight_line_is_not_seen_edge_on(tmp_path: Path) -> None:
    sheet = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(8))
    ends = ("--from", "0", "0.5", "0", "--to", "1", "0.5", "0")
    given = (*ends, "--iterations", "1", "--layout", "top", "--input-unit", "cm")
    assert run(sheet, "a.svg", *given, spacing=0.9) == 0


@pytest.mark.parametrize(
    ("extra", "words"),
    [
        (("--input-unit", "mm", "--output", "a.obj"), "does nothing"),
        (("--input-up", "y", "--output", "a.json"), "does nothing"),
        (("--lines", "pairs", "--output", "a.svg"), "--lines is for"),
    ],
)
def test_options_that_do_nothing_are_refused(plate: Path, extra, words, capsys) -> None:
    assert run(plate, "x.svg", *extra) == 2
    assert words in capsys.readouterr().err


# ------------------------------------------------------------------------------------------------
# Lines


def test_pairs_are_the_same_curve(tmp_path: Path) -> None:
    from meander.model.files.obj import read_obj_curve

    ball = geometry.write_obj(tmp_path / "ball.obj", geometry.two_spheres())
    assert run(ball, "a.obj", spacing=0.4) == 0
    assert run(ball, "b.obj", "--lines", "pairs", spacing=0.4) == 0
    one, other = (read_obj_curve(tmp_path / name) for name in ("a.obj", "b.obj"))
    assert one.points.tobytes() == other.points.tobytes()
    assert one.closed.tolist() == other.closed.tolist() == [1, 1]
    lines = [line for line in (tmp_path / "b.obj").read_text().splitlines() if line[:2] == "l "]
    assert {len(line.split()) for line in lines} == {3}
    assert len(lines) == len(one.points)


def test_a_run_says_why_there_are_several_lines(tmp_path: Path, capsys) -> None:
    two = geometry.write_obj(tmp_path / "two.obj", geometry.two_spheres())
    out = tmp_path / "out.obj"
    given = ["--input", str(two), "--output", str(out), "--spacing", "0.4"]
    report = tmp_path / "report.json"
    assert batch.main([*given, "--report", str(report)]) == 0
    assert "2 lines: the mesh has 2 parts\n" in capsys.readouterr().out
    assert json.loads(report.read_text())["lines"] == {
        "parts": 2, "small_parts": 0, "count": 2, "closed": 2, "why": "the mesh has 2 parts",
    }  # fmt: skip
    again = [*given[:2], "--output", str(tmp_path / "again.obj"), *given[4:]]
    assert batch.main([*again, "--seed", str(out), "--smallest-part", "0.1%"]) == 0
    assert "2 lines: the mesh has 2 parts" in capsys.readouterr().out
    assert batch.main([*given, "--bridge"]) == 0
    assert "one " in capsys.readouterr().out
    ball = geometry.write_obj(tmp_path / "ball.obj", geometry.icosphere(2))
    seed = tmp_path / "seed.obj"
    rings = [
        [(np.cos(a) * c, np.sin(a) * c, z) for a in np.linspace(0, 6.28, 20)[:-1]]
        for z, c in ((0.5, 0.86), (-0.5, 0.86))
    ]
    text, count = "", 0
    for ring in rings:
        text += "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in np.array(ring).tolist())
        text += "l " + " ".join(str(count + k + 1) for k in (*range(len(ring)), 0)) + "\n"
        count += len(ring)
    seed.write_text(text)
    given[1] = str(ball)
    assert batch.main([*given, "--seed", str(seed)]) == 0
    assert "2 lines: the seed has as many strands" in capsys.readouterr().out


@pytest.mark.parametrize("letter", ["\x01", "\x1f", "\x0b", "\ufffe", "\udc80", "&<\"'"])
def test_any_name_gives_a_drawing_that_can_be_read(tmp_path: Path, letter: str) -> None:
    from xml.etree import ElementTree

    name = f"a{letter}b.svg"
    sheet = geometry.write_obj(tmp_path / "sheet.obj", geometry.grid(4))
    try:
        tmp_path.joinpath(name).touch()
    except (OSError, ValueError):
        pytest.skip("no file can be called so here")
    given = ["--input", str(sheet), "--output", str(tmp_path / name), "--spacing", "0.3"]
    assert batch.main([*given, "--report", str(tmp_path / "r.json"), "--iterations", "2"]) == 0
    tree = ElementTree.parse(tmp_path / name)
    (title,) = tree.iter("{http://www.w3.org/2000/svg}title")
    assert title.text.startswith("a") and title.text.endswith("b")
    json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))
    for suffix in ("gcode", "dxf"):
        given[3] = str(tmp_path / f"a{letter}b.{suffix}")
        assert batch.main([*given, "--quiet", "--iterations", "2"]) == 0
        assert Path(given[3]).read_bytes().isascii()
