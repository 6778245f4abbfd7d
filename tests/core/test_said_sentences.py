# SPDX-License-Identifier: GPL-3.0-or-later
"""Every sentence of the table in said_sentences.py comes up: what it is said of is tried here.

A sentence that is added and not tried fails the test, and so does a try that says nothing.
"""

from __future__ import annotations

import contextlib
import io
import os
import shlex
from collections.abc import Callable
from pathlib import Path

import geometry
import numpy as np
import pytest
from file_cases import CASES, SQUARE, binary_stl, obj, ply, stl
from meander import batch, core
from meander.cli import command, limits, picture
from meander.cli.place import Place
from meander.cli.values import BadInput
from meander.model.files import meshes, whole
from meander.model.toolpaths import drawing, embroidery, gcode, toolpath
from said_sentences import OF_THE_COMMAND, missing, sentences
from sentences import assert_sentence

# Options behind --input sheet.obj --output out.obj --spacing 0.3 --iterations 1, which they may
# give again; each is one refusal or warning.
TRIES = """
--input a.fbx
--input none.obj
--input none.ply --object Name
--input sheet.obj --object Name
--input sheet.obj --seed-object Name
--frame 3
--run-scripts
--output out.fbx
--output folder.obj
--output -
--output-format svg
--input - --seed -
--output - --output-format obj --report -
--cut -
--backwards
--density-color Col
--density-color rgb
--begin-at 0 0
--output out.svg --begin-at 0 0 0
--output none/out.obj
--output out.obj/
--outward
--output out.gcode --layout top --header inches.txt
--output sheet.obj
--output long
--seed line.obj --seed-object Name --input shot.blend
--cut a.fbx
--cut-detail 1
--cut-middle-lines
--mirror x --outline
--mirror x
--mirror z
--hide-seam
--maps a.jpg
--maps a.png
--map-size 64
--maps a.png --map-kinds colour
--density-curvature mean --density-group Name
--density-group Name
--uv-map Name
--uv-map Name --input shot.blend
--density-smoothing 1 --density-group Name --input shot.blend
--density-curvature mean --spacing-factors 9 1
--density-curvature mean --density-ramp 0:1,1:2 --spacing-factors 1 2
--spacing-factors 1 2
--density-curvature mean --density-ramp 0:1
--density-curvature mean --density-ramp 0:1,2:1
--density-curvature mean --density-ramp 0:1,1:9
--density-curvature mean --density-ramp 0:1,0:1
--density-curvature mean --density-ramp 0:1,x
--pen 0.1
--negative
--tone-group Name
--tone-color rgb --darkest 0.2 --lightest 0.3
--tone-color rgb --levels 50 20
--tone-color rgb --density-curvature mean
--output out.svg --layout view
--output out.svg --layout uv
--output out.dxf --visible-only
--output out.svg --layout-map Name
--layout top
--input-unit mm
--output out.svg --input shot.blend --input-up y
--output out.svg --header head.txt
--output out.gcode --header none.txt
--seed folder.obj
--density-group "" --input shot.blend
--input ""
--output out.gcode --header hold.txt
--output out.svg --input-unit m --scale 99
--output out.svg --layout front --iterations 300 --size 90 --spacing 0.1
--limit-nodes 10
--limit-memory 0.001
--bake-frames 5 1
--bake-frames 1 5
--motion stick
--mask-group a --mask-material b
--mask-group a
--mask-threshold 0.3
--mask-invert
--outline --boundary-distance 0.05
--guides line.obj --guides-object Name --input shot.blend
--from 0 0 0
--from 0 0 0 --to 1 1 0 --seed line.obj
--leave-out-guides
--seed line.ply
--from 0 0 0 --from-vertex 1 --to 1 1 0
--from 0 0 0 --to 0 0 0
--from 0 0 0 --to-vertex 9999
--target-length 5
--direction x --direction-object Name
--direction Name
--direction x --direction-smoothing 1
--direction-angle Name
--direction x --direction-angle Name
--alignment 2
--across
--output out.csv --resample-step 1 --chord-tolerance 1
--resample-step 1
--part-length 1
--output out.csv --part-overlap 1
--output out.csv --sheet a4
--output out.dxf --sheet a4
--output out.svg --sheet a0
--output out.svg --sheet-margin 9
--output out.svg --sheet a4 --sheet-margin 105
--output out.svg --sheet 2x2 --sheet-margin 0.5
--output - --output-format svg --sheet a4
--output head.gcode --layout top --sheet a4 --header head_r1c1.gcode
--output out.csv --part-length 1 --part-overlap 1
--poses
--output out.csv --standoff 1
--output out.svg --frame-id map
--point-limit 3
--output out.usda --bake-frames 1 5 --input shot.blend --layout top
--output out.wled.json --size 9000 --pitch 0.5
--output out.xmodel --scale 1000 --pitch 0.1
--output out.svg --lines pairs
--points mesh
--spacing nan
--mask-threshold 5 --mask-group a
--spacing 0
--threads 1.5
--seed plain.obj
--seed branch.obj
--seed twice.obj
--output out.csv --resample-step 1e-9
--output out.csv --part-length 1e-9
--output out.svg --scale 1e-9
--output out.gcode --unit cm
--output out.gcode --arcs 0.1
--least-bend-radius 1 --bridge
--least-bend-radius 1 --input cube.obj
--output out.csv --resample-step 0.9 --input ball.obj --spacing 0.15 --iterations 300
--output out.svg --layout top --input ball.obj --size 90 --iterations 200
--output out.svg --layout top --chord-tolerance 0.3 --spacing 0.1 --iterations 300 --size 90
"""

# The same behind --output out.svg.
PICTURES = """
--picture none.png
--picture a.png --test-strip
--test-strip --crop 0 0 1 1
--test-strip --output out.fbx
--test-strip --preview out.jpg
--test-strip --arcs 0.1 --output out.obj
--test-strip --lightest 0.4 --darkest 0.3
--test-strip --levels 90 10
--test-strip --output folder.obj
--test-strip --output long
--test-strip --output none/out.svg
--test-strip --report out.svg
--picture shot.blend --output - --output-format dxf --inks cyan,black
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("said")
    points = "".join(f"v {x} {y} 0\n" for x, y in SQUARE)
    (folder / "sheet.obj").write_text(geometry.obj_text(geometry.grid(6)))
    (folder / "ball.obj").write_text(geometry.obj_text(geometry.icosphere(2)))
    (folder / "cube.obj").write_text(geometry.obj_text(geometry.cube()))
    (folder / "line.obj").write_text(points + "l 1 2 3\n")
    (folder / "plain.obj").write_text(points)
    (folder / "branch.obj").write_text(points + "l 1 2 3\nl 2 4\n")
    (folder / "twice.obj").write_text(points + "l 1 2\nl 2 1\n")
    for name in ("shot.blend", "a.fbx", "line.ply", "head.txt", "head_r1c1.gcode"):
        (folder / name).write_text("x")
    (folder / "hold.txt").write_text("M117 Hold!")
    (folder / "inches.txt").write_text("G20")
    (folder / "folder.obj").mkdir()
    return folder


def said_of(call: Callable[[], object]) -> str:
    """What a call says: its refusal, or what it prints on the error stream."""
    stream = io.StringIO()
    with contextlib.redirect_stderr(stream):
        try:
            call()
        except (BadInput, core.MeanderError, whole.FileError) as refusal:
            stream.write(str(refusal))
    return stream.getvalue().strip()


def tried(folder: Path, line: str) -> str:
    base = ["--input", "sheet.obj", "--output", "out.obj", "--spacing", "0.3", "--iterations", "1"]
    words = shlex.split(line)
    if picture.is_asked(words):
        base = ["--output", "out.svg"]
    words = ["x" * 300 + ".obj" if word == "long" else word for word in words]
    at = Path.cwd()
    os.chdir(folder)
    try:
        said = said_of(lambda: batch.main([*base, "--quiet", *words]))
        if "needs Blender" in said:  # what is said where there is one, which is not asked here
            place = Place("batch.py", lambda _line: None, NoScene())
            said += "\n" + said_of(lambda: command.main([*base, *words], place))
        return said
    finally:
        os.chdir(at)


class NoScene:
    """Stands for Blender until the options have been looked at."""

    def __getattr__(self, name: str) -> Callable[..., None]:
        def refuse(*_arguments: object) -> None:
            raise BadInput(f"Blender would be asked for {name}; look at the options first")

        return refuse


def reading(folder: Path, name: str, data: bytes) -> str:
    path = folder / name
    path.write_bytes(data)
    return said_of(lambda: meshes.read(path))


def others(folder: Path) -> list[str]:
    """Sentences that no option leads to by itself."""
    flat = np.zeros((2, 3))
    up = np.tile([0.0, 0.0, 1.0], (2, 1))
    strand = toolpath.strand_of(flat + [[0, 0, 0], [1, 0, 0]], up, False)
    wide = drawing.Drawing([toolpath.strand_of(2e3 * strand.points, up, False)], "mm", True)
    face_of_nothing = obj(SQUARE, "f 1 2 1 2\n")
    spiky = "facet normal 0 0 1\nouter loop\n" + "vertex 0 0 0\nvertex 1 0 0\n" * 2
    cost = core.Cost(**{name: 1e6 for name in core.Cost.__dataclass_fields__})
    namespace = type("Arguments", (), {"limit_nodes": 10**9, "limit_memory": 1e-6})()
    found = [
        said_of(lambda: drawing.drawing_of([], "mm", 1.0, 1.0, 0.0, True)),
        said_of(lambda: drawing.drawing_of(
            [toolpath.strand_of(flat + np.nan, up, False)], "mm", 1.0, 1.0, 0.0, True)),
        said_of(lambda: drawing.drawing_of(
            [toolpath.strand_of(0.0 * flat, up, False)], "mm", 1.0, 1.0, 0.0, True)),
        said_of(lambda: "".join(gcode.gcode_pieces(
            drawing.Drawing([strand], "cm", True), gcode.Motion(), "a", "1"))),
        *(said_of(lambda motion=motion: "".join(gcode.gcode_pieces(
            drawing.Drawing([strand], "mm", True), motion, "a", "1")))
          for motion in (gcode.Motion(tool="laser", dip_every=1.0), gcode.Motion(dip_every=1e-9))),
        reading(folder, "a.obj", face_of_nothing),
        reading(folder, "a.stl", f"solid a\n{spiky}endloop\nendfacet\n".encode()),
        reading(folder, "b.stl", binary_stl(0)[:84]),
        reading(folder, "c.stl", stl().replace(b"vertex", b"corner")),
        reading(folder, "a.fbx", b"x"),
        reading(folder, "a.ply", b"\x1f\x8b packed"),
        reading(folder, "b.ply", ply("", 1).replace(b"format ascii 1.0\n", b"")),
        reading(folder, "c.ply", ply("", 1).replace(b"end_header", b"end")),
        reading(folder, "d.ply", ply("0 0 1 0 1 1 0 1 3 0 1 2\n", 1).replace(
            b"property float z\n", b"")),
        reading(folder, "e.ply", ply("", 1).replace(b"float z", b"float y")),
        reading(folder, "f.ply", ply("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 -7\n", 1)),
        reading(folder, "g.ply", ply("0 0 0\n1 0 0\n1 1 0\n0 1 0\n-3 0 1 2\n", 1)),
        said_of(lambda: limits.refuse_large(cost, namespace)),
        said_of(lambda: batch.main(["--input", str(folder / "sheet.obj"), "--output",
            str(folder / "gaps.obj"), "--iterations", "1", "--quiet", "--fail-on-gaps"])),
        said_of(lambda: batch.main(["--input", str(folder / "sheet.obj"), "--output", "a.obj",
            "--target-length", "9", "--least-bend-radius", "1"])),
    ]  # fmt: skip
    if embroidery.is_there():
        found.append(said_of(lambda: embroidery.embroidery_bytes(wide, "a", ".dst")))
    return found


# What cannot come up here, and where it is tried.
ELSEWHERE = {
    "With Symmetry": "needs a surface that is its own mirror image: test_mirror.py",
    "The curve and its mirror image": "the same",
    "leaves nothing of a sheet": "refused before by the command: test_sheets.py",
    "are available; choose ": "needs a machine without memory: test_memory_limit.py",
    "cannot be written to; choose another": "needs a user without rights: test_whole_files.py",
    "is protected against writing": "the same",
    "cannot be used in Blender, which prints": "needs Blender: test_standard_streams.py",
    "is not a finite number at vertex": "needs such a file: test_density_of_files.py",
    "has colours that are no numbers": "the same",
    "has colours that are neither numbers": "the same",
    "has no numbers '\0' of vertices": "the same",
    "has no colours of vertices or": "the same",
    "needs UVs, which a .stl": "the same",
    "has no UVs; unwrap": "the same",
    "has faces without UVs": "the same",
    "has UVs that are": "the same",
    "has a face with a UV that": "the same",
    "no spacing gives a length": "test_target_length.py",
    "there is no standard output": "needs streams of its own: test_closed_pipe.py",
    "the standard output cannot be written": "the same",
    "which no machine can do": "needs pyembroidery",
    "All strands are shorter than a stitch": "the same: test_what_machines_take.py",
    "would overwrite \0, from which this run": "needs Blender: tests/blender/test_maps.py",
    "is not within the picture": "needs Pillow: test_picture.py",
    "--maps is not possible here: the UV map": "needs Blender: tests/blender/test_maps.py",
}


@pytest.fixture(scope="module")
def said(folder: Path) -> dict[str, str]:
    lines = (TRIES + PICTURES).split("\n")
    found = {line: tried(folder, line) for line in lines if line}
    for case in CASES:
        found[f"{case.kind}: {case.title}"] = f"FILE{case.said}" if case.said else ""
    for number, text in enumerate(others(folder)):
        found[f"other {number}"] = text
    return found


def test_every_try_says_one_sentence(said: dict[str, str]) -> None:
    silent = [line for line, text in said.items() if not text and ": " not in line]
    assert silent == []
    for line, text in said.items():
        for sentence in text.splitlines():
            assert "Traceback" not in sentence, line
            assert_sentence(sentence.removeprefix("meander: ").removeprefix("warning: "))


def test_every_sentence_comes_up(said: dict[str, str]) -> None:
    everything = "\n".join(said.values())
    assert missing(OF_THE_COMMAND, everything.splitlines(), ELSEWHERE) == []
    assert len(sentences(OF_THE_COMMAND)) > 100
