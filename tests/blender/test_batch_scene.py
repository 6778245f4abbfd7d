# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command on a .blend with named objects: once in a Blender of its own, else here."""

from __future__ import annotations

import json
import stat
import subprocess
import sys
from pathlib import Path

import bpy
import meander
import numpy as np
import pytest
from meander.scene import density as scene_density
from scenes import circle_points, column, farthest_from, length_of, poly_curve, saved, sphere

BATCH = Path(meander.__file__).parent / "batch.py"


def run_alone(*arguments: object) -> subprocess.CompletedProcess:
    if bpy.app.binary_path:
        start = [bpy.app.binary_path, "--background", "--factory-startup"]
        start += ["--python-exit-code", "1", "--python", str(BATCH), "--"]
    else:
        start = [sys.executable, str(BATCH), "--"]
    return subprocess.run(
        [*start, *map(str, arguments)], capture_output=True, text=True, timeout=120
    )


@pytest.fixture(scope="module")
def scene(tmp_path_factory) -> Path:
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    surface = sphere(subdivisions=2)
    surface.name = "Ball"
    surface.scale = (1.0, 1.5, 1.0)
    modifier = surface.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = 1
    top = [vertex.index for vertex in surface.data.vertices if vertex.co.z > 0.0]
    surface.vertex_groups.new(name="Top").add(top, 1.0, "REPLACE")
    heights = surface.data.attributes.new("height", "FLOAT", "POINT")
    heights.data.foreach_set("value", [vertex.co.z for vertex in surface.data.vertices])
    poly_curve("Ring", [circle_points(0.43, 0.9)], True)
    poly_curve("Far", [circle_points(1.0, 9.0)], True)
    return saved(tmp_path_factory.mktemp("scene") / "scene.blend")


def test_a_scene_with_named_objects(scene, tmp_path):
    output, report = tmp_path / "out.blend", tmp_path / "out.json"
    done = run_alone(
        *("--input", scene, "--object", "Ball", "--seed-object", "Ring"),
        *("--density-group", "Top", "--spacing", 0.3),
        *("--output", output, "--report", report, "--quiet"),
    )
    assert done.returncode == 0, done.stderr
    figures = json.loads(report.read_text())
    assert figures["converged"] and figures["crossings"] == 0
    bpy.ops.wm.open_mainfile(filepath=str(output))
    surface = bpy.data.objects["Ball"]
    (curve,) = (thing for thing in surface.children if thing.type == "CURVE")
    bpy.context.view_layer.update()
    assert [spline.use_cyclic_u for spline in curve.data.splines] == [True]
    assert length_of(curve) == pytest.approx(figures["length"], rel=1e-3)
    assert farthest_from(surface, curve) < 2e-6
    # What it was made with, so that Continue works on it.
    assert curve.meander.surface == surface
    assert curve.meander.spacing == pytest.approx(0.3)
    assert curve.meander.density_group == "Top"


def test_a_density_by_attribute_range_and_factors(scene, tmp_path, run_batch):
    output, report = tmp_path / "out.blend", tmp_path / "out.json"
    done = run_batch(
        *("--input", scene, "--object", "Ball", "--spacing", 0.3, "--iterations", 5),
        *("--density-attribute", "height", "--density-range", -1, 1),
        *("--spacing-factors", 0.5, 2, "--density-interpolation", "smooth"),
        *("--output", output, "--report", report, "--quiet"),
    )
    assert done.returncode == 0, done.stderr
    options = json.loads(report.read_text())["options"]
    assert options["density_attribute"] == "height" and options["density_group"] is None
    assert options["density_range"] == [-1, 1] and options["spacing_factors"] == [0.5, 2]
    bpy.ops.wm.open_mainfile(filepath=str(output))
    (curve,) = (thing for thing in bpy.data.objects["Ball"].children if thing.type == "CURVE")
    made_with = curve.meander
    assert (made_with.density_source, made_with.density_attribute) == ("ATTRIBUTE", "height")
    assert made_with.use_density_range
    assert (made_with.density_low, made_with.density_high) == (-1.0, 1.0)
    assert (made_with.factor_0, made_with.factor_1) == (0.5, 2.0)
    assert made_with.density_interpolation == "SMOOTH"
    # The surface's own settings are the user's, not the command's.
    assert bpy.data.objects["Ball"].meander.density_source == "GROUP"


def test_a_ramp_of_stops_is_kept_with_the_result(scene, tmp_path, run_batch):
    output, report = tmp_path / "out.blend", tmp_path / "out.json"
    done = run_batch(
        *("--input", scene, "--object", "Ball", "--spacing", 0.3, "--iterations", 5),
        *("--density-attribute", "height", "--density-ramp", "0:0.5,0.4:1,1:2"),
        *("--output", output, "--report", report, "--quiet"),
    )
    assert done.returncode == 0, done.stderr
    options = json.loads(report.read_text())["options"]
    assert options["spacing_factors"] == [0.5, 2.0]
    assert options["density_interpolation"] == "free"
    places = np.array(options["density_ramp"])
    assert np.allclose(places, [[0.0, 0.0], [0.4, 1.0 / 3.0], [1.0, 1.0]])
    bpy.ops.wm.open_mainfile(filepath=str(output))
    (curve,) = (thing for thing in bpy.data.objects["Ball"].children if thing.type == "CURVE")
    ramp = scene_density.choice_of(curve.meander).ramp(np.array([0.0, 1.0]))
    wanted = np.interp(np.linspace(0.0, 1.0, 21), [0.0, 0.4, 1.0], [0.5, 1.0, 2.0])
    assert np.allclose(ramp.factors(np.linspace(0.0, 1.0, 21)), wanted, atol=0.01)


def test_alignment_and_terms_are_kept_with_the_result(scene, tmp_path, run_batch):
    output = tmp_path / "out.blend"
    done = run_batch(
        *("--input", scene, "--object", "Ball", "--spacing", 0.3, "--iterations", 5, "--quiet"),
        *("--alignment", 0.5, "--direction-object", "Ring", "--across"),
        *("--preset", "paper", "--bending", 2, "--max-radius", 0.6, "--output", output),
    )
    assert done.returncode == 0, done.stderr
    bpy.ops.wm.open_mainfile(filepath=str(output))
    (curve,) = (thing for thing in bpy.data.objects["Ball"].children if thing.type == "CURVE")
    made_with = curve.meander
    assert (made_with.alignment_source, made_with.alignment_weight) == ("STROKES", 0.5)
    assert made_with.alignment_strokes == bpy.data.objects["Ring"] and made_with.align_across
    assert made_with.use_weights and made_with.bending_weight == 2.0
    assert made_with.length_weight == 1.0, "As Published has it, and the switch turns all four on"
    assert made_with.reach == pytest.approx(4.0)


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (("--object", "Nobody"), "Nobody"),
        (("--object", "Ring"), "has no faces"),
        (("--object", "Ball", "--seed-object", "Ball"), "has faces; choose a curve"),
        (("--object", "Ball", "--seed-object", "Far"), "surface"),
        (("--object", "Ball", "--density-group", "Bottom"), "Bottom"),
        (("--object", "Ball", "--density-attribute", "depth"), "it has 'height'"),
        (("--object", "Ball", "--density-color", "height"), "choose a color attribute"),
        (("--object", "Ball", "--alignment", 1, "--direction", "flow"), "vector attribute"),
        (("--object", "Ball", "--alignment", 1, "--direction-object", "No"), "no curves"),
        (("--object", "Ball", "--density-image", "Map"), "no image 'Map'"),
        (("--object", "Ball", "--density-group", "Top", "--spacing-factors", 0, 1), "0.05 to 5"),
    ],
)
def test_bad_scenes_are_refused(scene, tmp_path, run_batch, arguments, word):
    output = tmp_path / "out.blend"
    done = run_batch("--input", scene, *arguments, "--spacing", 0.3, "--output", output)
    assert done.returncode == 2
    assert word in done.stderr
    assert not output.exists()


@pytest.mark.parametrize("kind", ["mesh", "curves"])
def test_points_come_beside_the_curve(scene: Path, tmp_path: Path, run_batch, kind: str) -> None:
    output = tmp_path / "filled.blend"
    done = run_batch(
        *("--input", scene, "--object", "Ball", "--output", output),
        *("--spacing", 0.4, "--points", kind, "--quiet"),
    )
    if kind == "curves" and bpy.app.version < (4, 2):
        assert done.returncode == 2
        assert "4.2" in done.stderr
        assert not output.exists()
        return
    assert done.returncode == 0, done.stderr
    bpy.ops.wm.open_mainfile(filepath=str(output))
    points = bpy.data.objects["Ball Meander Points"]
    assert points.type == kind.upper()
    room = points.data.attributes["r_plus"].data
    values = column(room, "value")
    assert 0.16 < np.median(values) < 0.24
    splines = bpy.data.objects["Ball Meander"].data.splines
    assert len(values) >= sum(len(spline.points) for spline in splines)


def test_a_scene_is_written_through_a_link_with_the_mode_that_is_there(scene, tmp_path, run_batch):
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    real, output = folder / "real.blend", tmp_path / "out.blend"
    real.write_bytes(b"earlier")
    real.chmod(0o600)
    output.symlink_to(real)
    done = run_batch(
        *("--input", scene, "--object", "Ball", "--seed-object", "Ring", "--spacing", 0.5),
        *("--iterations", 3, "--output", output, "--quiet"),
    )
    assert done.returncode == 0, done.stderr
    assert output.is_symlink()
    assert stat.S_IMODE(real.stat().st_mode) == 0o600
    assert [item.name for item in folder.iterdir()] == ["real.blend"]
    bpy.ops.wm.open_mainfile(filepath=str(output))
    assert bpy.data.objects["Ball Meander"].meander.surface == bpy.data.objects["Ball"]


@pytest.mark.parametrize("option", ["--output", "--report"])
def test_a_name_that_is_too_long_is_a_sentence(scene, tmp_path, run_batch, option):
    before = sorted(tmp_path.iterdir())
    done = run_batch(
        *("--input", scene, "--object", "Ball", "--spacing", 0.5, "--iterations", 3),
        *("--output", tmp_path / "out.blend", option, tmp_path / ("n" * 300 + ".blend")),
    )
    assert done.returncode == 2, done.stderr
    assert "choose another name" in done.stderr
    assert sorted(tmp_path.iterdir()) == before


def test_what_a_file_says_of_its_surface_comes_along_into_a_blend(tmp_path, run_batch):
    image = bpy.data.images.new("Steps", 4, 4)
    image.pixels.foreach_set(np.repeat(np.linspace(0, 1, 4), 16).astype(np.float32))
    image.filepath_raw, image.file_format = str(tmp_path / "steps.png"), "PNG"
    image.save()
    cells = range(9)
    places = [(x / 8, y / 8) for y in cells for x in cells]
    corners = [(x + 9 * y, x + 9 * y + 1, x + 9 * y + 10, x + 9 * y + 9)
               for y in cells[:-1] for x in cells[:-1]]  # fmt: skip
    lines = [f"v {x} {y} 0\nvt {x} {y}" for x, y in places]
    lines += ["f " + " ".join(f"{k + 1}/{k + 1}" for k in face) for face in corners]
    (tmp_path / "sheet.obj").write_text("\n".join([*lines, ""]))
    output = tmp_path / "out.blend"
    done = run_batch(
        *("--input", tmp_path / "sheet.obj", "--density-image", tmp_path / "steps.png"),
        *("--spacing", 0.2, "--iterations", 5, "--quiet", "--output", output),
    )
    assert done.returncode == 0, done.stderr
    bpy.ops.wm.open_mainfile(filepath=str(output))
    (curve,) = (thing for thing in bpy.data.objects if thing.type == "CURVE")
    settings = curve.meander
    assert (settings.density_source, settings.density_attribute) == ("ATTRIBUTE", "Density Values")
    assert settings.use_density_range and (settings.density_low, settings.density_high) == (0, 1)
    values = column(settings.surface.data.attributes["Density Values"].data, "value")
    assert values[13] < 0.3 < values[67], "dark below, bright above"
    curve.meander.iteration_limit = 5
    bpy.context.view_layer.objects.active = curve
    assert bpy.ops.meander.run() == {"FINISHED"}
