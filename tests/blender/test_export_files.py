# SPDX-License-Identifier: GPL-3.0-or-later
"""The export of results to files for machines: the operator, the batch command, the embroidery."""

from __future__ import annotations

import json
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from meander import batch
from meander.model import export
from meander.model.toolpaths import embroidery

SVG = "{http://www.w3.org/2000/svg}"


def _export(path: Path, **options) -> None:
    assert bpy.ops.meander.export_toolpath(filepath=str(path), **options) == {"FINISHED"}


def _refused(path: Path, **options) -> str:
    with pytest.raises(RuntimeError) as caught:
        bpy.ops.meander.export_toolpath(filepath=str(path), **options)
    assert not path.exists()
    return str(caught.value).removeprefix("Error: ").strip()


def _paths(path: Path) -> tuple[list[tuple[np.ndarray, bool]], np.ndarray]:
    """The paths of an SVG file, and whether they are closed; the size of its paper."""
    root = ElementTree.parse(path).getroot()
    found = []
    for element in root.iter(f"{SVG}path"):
        numbers = [float(text) for text in re.findall(r"-?\d+\.?\d*", element.get("d"))]
        found.append((np.array(numbers).reshape(-1, 2), element.get("d").endswith("Z")))
    return found, np.array([float(text) for text in root.get("viewBox").split()[2:]])


def _length(points: np.ndarray, closed: bool) -> float:
    around = np.vstack([points, points[:1]]) if closed else points
    return float(np.linalg.norm(np.diff(around, axis=0), axis=1).sum())


def _sheet() -> bpy.types.Object:
    """A square of side 2 with a UV map that is twice as wide as high, and filled."""
    sheet = scenes.grid(cells=8)
    return scenes.fill(sheet, 0.3)


def test_the_view_from_the_top_has_the_scenes_size(tmp_path: Path) -> None:
    result = _sheet()
    splines = scenes.world_splines(result)
    bpy.context.scene.unit_settings.scale_length = 0.01
    _export(tmp_path / "a.svg", line_width=0.5)
    paths, paper = _paths(tmp_path / "a.svg")
    low, high = np.min([s[0].min(0) for s in splines], 0), np.max([s[0].max(0) for s in splines], 0)
    assert np.allclose(paper, (high - low)[:2] * 10.0 + 1.0, atol=0.01)
    for (points, closed), (wanted, cyclic) in zip(paths, splines, strict=True):
        assert closed == cyclic
        wanted = wanted[:, :2] * [10.0, -10.0]
        assert np.allclose(points - points[0], wanted - wanted[0], atol=0.003)


def test_the_unrolled_curve_keeps_its_length_and_is_cut_at_seams(tmp_path: Path) -> None:
    result = _sheet()
    whole = scenes.length_of(result)
    _export(tmp_path / "flat.svg", layout_as="UV", unit="CM", scale=0.1)
    paths, paper = _paths(tmp_path / "flat.svg")
    assert paper.max() < 20.1
    assert sum(_length(*path) for path in paths) == pytest.approx(10.0 * whole, rel=1e-3)
    bpy.ops.mesh.primitive_cube_add(size=2.0, location=(5.0, 0.0, 0.0))
    cube = scenes.activate(bpy.context.active_object)
    cube.scale = (-1.0, 1.0, 1.0)  # a mirrored surface is not a mirrored map
    result = scenes.fill(cube, 0.4, use_light=True, light_tolerance=0.05)
    whole = scenes.length_of(result)
    _export(tmp_path / "cube.svg", layout_as="UV", scale=0.1)
    paths, _paper = _paths(tmp_path / "cube.svg")
    assert len(paths) > 3
    assert sum(_length(*path) for path in paths) == pytest.approx(100.0 * whole, rel=0.02)
    cube.data.uv_layers.remove(cube.data.uv_layers[0])
    cube.data.update()
    assert "has no UV map; unwrap it first" in _refused(tmp_path / "no.svg", layout_as="UV")


def _hill() -> bpy.types.Object:
    hill = scenes.grid(cells=20)
    for vertex in hill.data.vertices:
        vertex.co.z = np.exp(-4.0 * (vertex.co.x**2 + vertex.co.y**2))
    return hill


def _without_map(thing: bpy.types.Object) -> bpy.types.Object:
    while thing.data.uv_layers:
        thing.data.uv_layers.remove(thing.data.uv_layers[0])
    thing.data.update()
    return thing


def _upright() -> bpy.types.Object:
    sheet = _without_map(scenes.grid(cells=8))
    sheet.rotation_euler.x = np.pi / 2
    return sheet


@pytest.mark.parametrize(
    ("build", "layout"),
    [
        (scenes.grid, "TOP"),
        (_hill, "TOP"),
        (scenes.cube, "UV"),
        (scenes.sphere, "UV"),
        (lambda: _without_map(scenes.sphere()), "TOP"),
        (_upright, "FRONT"),
    ],
)
def test_a_flat_file_is_laid_as_its_shape_asks(tmp_path: Path, build, layout: str) -> None:
    scenes.fill(build(), 0.4, iteration_limit=20)
    _export(tmp_path / "a.svg")
    _export(tmp_path / "b.svg", layout_as=layout)
    text = (tmp_path / "a.svg").read_text()
    assert text == (tmp_path / "b.svg").read_text()
    _export(tmp_path / "a.dxf")
    _export(tmp_path / "b.dxf", layout_as="SPACE")
    assert (tmp_path / "a.dxf").read_text() == (tmp_path / "b.dxf").read_text()


def test_a_name_with_an_unknown_end_says_what_it_becomes(
    tmp_path: Path, capfd: pytest.CaptureFixture
) -> None:
    _sheet()
    capfd.readouterr()
    _export(tmp_path / "x.foo")
    assert "x.foo becomes x.foo.svg: " in capfd.readouterr().out
    _export(tmp_path / "y.svg", file_format="DXF")
    assert "y.svg becomes y.dxf: " in capfd.readouterr().out
    _export(tmp_path / "z.svg")
    _export(tmp_path / "z", file_format="SVG")
    assert "becomes" not in capfd.readouterr().out
    assert {path.name for path in tmp_path.iterdir()} == {"x.foo.svg", "y.dxf", "z.svg"}


def test_what_the_surface_hides_is_left_out(tmp_path: Path) -> None:
    """A ball seen from above is half hidden; of one with a roof nothing is left in its shadow."""
    result = scenes.fill(scenes.sphere(), 0.2)
    splines = scenes.world_splines(result)
    upper = 0.0
    for points, cyclic in splines:
        around = np.vstack([points, points[:1]]) if cyclic else points
        steps = np.linalg.norm(np.diff(around[:, :2], axis=0), axis=1)
        upper += steps[(around[:-1, 2] + around[1:, 2]) > 0.0].sum()
    _export(tmp_path / "top.svg", visible_only=True, scale=0.1)
    paths, _paper = _paths(tmp_path / "top.svg")
    found = sum(_length(*path) for path in paths)
    assert found == pytest.approx(100.0 * upper, rel=0.01)
    sheet = scenes.grid(cells=8)
    with_roof = scenes.mesh_object(
        "Roofed",
        [*(v.co for v in sheet.data.vertices), (-1, -2, 1), (0, -2, 1), (0, 2, 1), (-1, 2, 1)],
        [*(p.vertices for p in sheet.data.polygons), [81, 82, 83, 84]],
    )
    ring = scenes.poly_curve("Ring", [scenes.circle_points(0.3, 0.0)], True)
    scenes.fill(with_roof, 0.15, seed=ring)
    _export(tmp_path / "roof.svg", visible_only=True, scale=0.1)
    paths, paper = _paths(tmp_path / "roof.svg")
    assert len(paths) > 3 and not any(closed for _points, closed in paths)
    assert 88.0 < paper[0] <= 100.6 and paper[1] > 180.0
    # Every part ends under the edge of the roof, to a tenth of a millimetre.
    edge = min(points[:, 0].min() for points, _closed in paths)
    for points, _closed in paths:
        assert np.abs(points[[0, -1], 0] - edge).max() < 0.1
    _export(tmp_path / "all.svg", scale=0.1)
    assert _paths(tmp_path / "all.svg")[1][0] > 180.0


def test_a_script_may_leave_the_format_to_the_name(tmp_path: Path) -> None:
    result = _sheet()
    splines = scenes.world_splines(result)
    _export(tmp_path / "a.dxf")
    assert (tmp_path / "a.dxf").read_text().count("\nVERTEX\n") == sum(
        len(points) for points, _cyclic in splines
    )
    _export(tmp_path / "a.nc", scale=0.1, resample="STEP", step=0.1)
    text = (tmp_path / "a.nc").read_text()
    assert "G21" in text and text.count("\nG1 X") > 50
    _export(tmp_path / "b", file_format="GCODE", layers=2)
    assert "; layer 2, strand 1" in (tmp_path / "b.gcode").read_text()
    assert "choose a Size or Scale, or Write Anyway" in _refused(tmp_path / "c.svg", scale=1e-8)
    assert "inches" in _refused(tmp_path / "c.gcode", unit="CM")


def _lengths_around_the_middle(path: Path, radius: float) -> tuple[float, float]:
    """The length of what is drawn inside a circle around the middle of the paper, and outside."""
    paths, paper = _paths(path)
    inside = outside = 0.0
    for points, closed in paths:
        around = np.vstack([points, points[:1]]) if closed else points
        steps = np.linalg.norm(np.diff(around, axis=0), axis=1)
        away = np.linalg.norm((around[1:] + around[:-1]) / 2.0 - paper / 2.0, axis=1)
        inside += steps[away < radius].sum()
        outside += steps[away >= radius].sum()
    return inside, outside


def test_several_curves_are_one_drawing(tmp_path: Path) -> None:
    first = scenes.fill(scenes.sphere(), 0.3)
    ball = scenes.sphere()
    ball.location = (0.0, 0.0, 5.0)  # above the other, which it hides but for its rim
    ball.scale = (0.5, 0.5, 0.5)
    second = scenes.fill(ball, 0.15)
    counts = [sum(len(s.points) for s in result.data.splines) for result in (first, second)]
    first.select_set(True)
    _export(tmp_path / "one.svg", layout_as="TOP", scale=0.1)
    assert sum(len(points) for points, _c in _paths(tmp_path / "one.svg")[0]) == counts[1]
    _export(tmp_path / "both.svg", selected=True, scale=0.1)
    paths, paper = _paths(tmp_path / "both.svg")
    assert sum(len(points) for points, _c in paths) == sum(counts)
    assert 180.0 < paper.min() <= paper.max() < 201.0
    # The lower one is seen around the upper one, and not through it: that would be half as much
    # again. Curves do not reach the rim alike on all sides, so the paper's middle is a little off.
    _export(tmp_path / "seen.svg", selected=True, visible_only=True, scale=0.1)
    _export(tmp_path / "upper.svg", visible_only=True, scale=0.1)
    inside, outside = _lengths_around_the_middle(tmp_path / "seen.svg", 45.0)
    alone, _nothing = _lengths_around_the_middle(tmp_path / "upper.svg", 45.0)
    assert inside == pytest.approx(alone, rel=0.1)
    assert outside > 0.5 * inside
    assert "one surface" in _refused(tmp_path / "uv.svg", selected=True, layout_as="UV")


def test_without_a_window_there_may_be_no_view(tmp_path: Path) -> None:
    _sheet()
    try:
        _export(tmp_path / "view.svg", layout_as="VIEW", scale=0.1)
    except RuntimeError as refusal:
        assert "There is no 3D view" in str(refusal)


def test_without_the_package_embroidery_says_how_to_get_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    _sheet()
    monkeypatch.setitem(sys.modules, "pyembroidery", None)
    sentence = _refused(tmp_path / "a.dst")
    folder = bpy.utils.user_resource("SCRIPTS", path="addons/modules")
    assert f'pip install --target "{folder}" pyembroidery' in sentence
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    given = ["--input", str(tmp_path / "scene.blend"), "--object", "Grid", "--spacing", "0.3"]
    assert batch.main([*given, "--output", str(tmp_path / "a.pes")]) == 2
    assert "pip install pyembroidery" in capsys.readouterr().err


def _stitches(path: Path) -> tuple[list[np.ndarray], int]:
    """The stitches of an embroidery in millimetres, in runs between jumps, and its trims."""
    pyembroidery = pytest.importorskip("pyembroidery")
    pattern = pyembroidery.read(str(path))
    runs, trims = [[]], 0
    for x, y, command in pattern.stitches:
        command &= pyembroidery.COMMAND_MASK
        if command == pyembroidery.STITCH:
            runs[-1].append((x / 10.0, -y / 10.0))
        elif runs[-1]:
            runs.append([])
        trims += command == pyembroidery.TRIM
    return [np.array(run) for run in runs if len(run) > 8], trims


@pytest.mark.parametrize("suffix", [".dst", ".pes"])
def test_embroidery_has_the_curve_in_stitches(tmp_path: Path, suffix: str) -> None:
    pytest.importorskip("pyembroidery")
    result = _sheet()
    splines = scenes.world_splines(result)
    path = tmp_path / f"a{suffix}"
    _export(path, size=80.0, stitch_length=2.0)
    runs, _trims = _stitches(path)
    everything = np.vstack([points for points, _cyclic in splines])[:, :2]
    factor = 80.0 / np.ptp(everything, axis=0).max()
    assert len(runs) == len(splines)
    for run, (points, cyclic) in zip(runs, splines):
        wanted = _length(points[:, :2] * factor, cyclic)
        steps = np.linalg.norm(np.diff(run, axis=0), axis=1)
        assert steps.max() <= 2.0 + 0.2  # positions are whole tenths
        assert steps.sum() == pytest.approx(wanted, rel=0.05)
        assert cyclic == bool(np.linalg.norm(run[-1] - run[0]) < 1.0)
    spread = np.ptp(np.vstack(runs), axis=0).max()
    assert spread == pytest.approx(80.0, abs=1.5)
    once = path.read_bytes()
    _export(path, size=80.0, stitch_length=2.0)
    assert path.read_bytes() == once
    assert "choose a size" in _refused(tmp_path / f"b{suffix}")


def test_dxf_is_what_another_reader_finds(tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    result = _sheet()
    splines = scenes.world_splines(result)
    for layout in ("SPACE", "FRONT"):
        seen_edge_on = layout == "FRONT"
        _export(tmp_path / "a.dxf", unit="IN", layout_as=layout, scale=0.1, force=seen_edge_on)
        document = ezdxf.readfile(tmp_path / "a.dxf")
        assert not document.audit().errors
        assert document.header["$INSUNITS"] == 1
        polylines = list(document.modelspace().query("POLYLINE"))
        for polyline, (points, cyclic) in zip(polylines, splines, strict=True):
            found = np.array([tuple(vertex.dxf.location) for vertex in polyline.vertices])
            assert polyline.is_closed == cyclic
            assert polyline.is_3d_polyline == (layout == "SPACE")
            if layout == "SPACE":
                assert np.allclose(found, points * 100.0 / 25.4, atol=1e-5)


def test_the_command_draws_what_the_scene_has(tmp_path: Path) -> None:
    scenes.grid(cells=8)
    bpy.context.scene.unit_settings.scale_length = 0.01
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    report = tmp_path / "report.json"
    given = ["--input", str(tmp_path / "scene.blend"), "--object", "Grid", "--spacing", "0.3"]
    given += ["--report", str(report), "--quiet"]
    output = tmp_path / "a.svg"
    flags = ["--layout", "uv", "--light", "0.01", "--line-width", "1"]
    assert batch.main([*given, "--output", str(output), *flags]) == 0
    record = json.loads(report.read_text())
    paths, paper = _paths(output)
    assert record["options"]["layout"] == "uv" and record["options"]["feed"] is None
    assert record["options"]["line_width"] == 1.0 and record["options"]["scale"] == 1.0
    assert sum(len(points) for points, _closed in paths) == record["points"]["written"]
    assert sum(_length(*path) for path in paths) == pytest.approx(10.0 * record["length"], rel=0.01)
    assert paper.max() < 21.0


@pytest.mark.parametrize(
    ("output", "flags", "words"),
    [
        ("a.svg", ["--feed", "100"], "--feed does nothing for an --output of kind .svg"),
        ("a.csv", ["--size", "10"], "--size does nothing for an --output of kind .csv"),
        ("a.svg", ["--layout", "view"], "needs a window"),
        ("a.svg", ["--layout", "uv"], "give a .blend"),
        ("a.gcode", ["--visible-only"], "needs --layout top"),
        ("a.obj", ["--visible-only"], "does nothing for an --output of kind .obj"),
        ("a.svg", ["--layout-map", "UVMap"], "needs --layout uv"),
        ("a.gcode", ["--unit", "cm"], "millimetres and inches"),
        ("a.gcode", ["--layers", "0"], "from 1 to"),
        ("a.gcode", ["--arcs", "0.1"], "give a --layout that is flat"),
    ],
)
def test_flags_that_cannot_be_meant_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture, output: str, flags: list[str], words: str
) -> None:
    mesh = tmp_path / "mesh.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    given = ["--input", str(mesh), "--spacing", "0.3", "--quiet", "--iterations", "1"]
    assert batch.main([*given, "--output", str(tmp_path / output), *flags]) == 2
    assert words in capsys.readouterr().err
    assert not (tmp_path / output).exists()


def test_formats_have_suffixes_of_their_own() -> None:
    assert len(set(export.SUFFIXES)) == len(export.SUFFIXES)
    assert set(embroidery.SUFFIXES) < set(export.SUFFIXES)


def test_arcs_in_space_are_refused_in_the_words_of_the_window(tmp_path: Path) -> None:
    _sheet()
    said = _refused(tmp_path / "a.gcode", layout_as="SPACE", arc_tolerance=0.1)
    assert said == "Arcs lie in a plane; choose a Layout that is flat"


@pytest.mark.parametrize(
    ("machine", "tool"),
    [("generic", "pen"), ("grbl", "spindle"), ("marlin", "servo"), ("klipper", "laser")],
)
def test_the_window_writes_for_machines_as_the_command_does(tmp_path: Path, machine, tool) -> None:
    """Everything but the moves themselves: head, foot, and what switches the tool."""
    result = _sheet()
    _export(tmp_path / "window.gcode", machine=machine.upper(), tool=tool.upper(), size=90.0)
    surface = result.meander.surface
    bpy.context.view_layer.objects.active = surface
    scene = scenes.saved(tmp_path / "scene.blend")
    given = ["--input", scene, "--object", surface.name, "--output", tmp_path / "command.gcode"]
    given += ["--spacing", "0.3", "--quiet", "--machine", machine, "--tool", tool, "--size", "90"]
    assert batch.main([str(a) for a in given]) == 0
    words = []
    for name in ("window", "command"):
        lines = (tmp_path / f"{name}.gcode").read_text().splitlines()
        kept = [line for line in lines if not re.match(r"(G0|G1)\b|;", line)]
        words.append(list(dict.fromkeys(kept)))
    assert words[0] == words[1] and len(words[0]) > 2
    if machine == "klipper":
        assert any("SET_PIN PIN=LASER" in line for line in words[0])


def test_head_and_foot_of_ones_own(tmp_path: Path) -> None:
    _sheet()
    for name in ("head", "foot"):
        (tmp_path / name).write_text(f"; my {name}\nG4 P1\n")
    files = {"header": str(tmp_path / "head"), "footer": str(tmp_path / "foot")}
    _export(tmp_path / "a.gcode", size=90.0, **files)
    lines = (tmp_path / "a.gcode").read_text().splitlines()
    assert lines.index("; my head") < lines.index("; my foot")
    assert "M2 ; end" not in lines
    assert "cannot be read" in _refused(tmp_path / "b.gcode", size=90.0, header="/no/such/file")
