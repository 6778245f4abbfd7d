# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture as a sheet with its line: the sheet, its settings, and the tones of what is drawn."""

from __future__ import annotations

import re
from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from mathutils import Euler, Matrix
from meander import batch
from meander.model.files.png import png
from meander.model.picture import drawn as drawings
from meander.model.picture.line import Wishes, plans_of
from meander.model.picture.tone import Tone
from meander.model.toolpaths.toolpath import strand_of
from meander.run import suspended
from meander.run.session_remarks import remarks
from meander.scene import look
from meander.scene import picture as pictures
from meander.scene.picture import DIRECTION, SPACING, read_picture
from watched_runs import begin, tick_until


@pytest.fixture
def ramp(tmp_path: Path) -> Path:
    """A picture, twice as wide as high, that is darker to the right, of 16 bits."""
    path = tmp_path / "ramp.png"
    values = np.tile(np.linspace(0.85, 0.2, 120), (60, 1))
    path.write_bytes(png((65535 * values).round().astype(np.uint16)))
    return path


def drawn(path: Path, **given: object) -> bpy.types.Object:
    asked = {"width": 60.0, "pen": 1.5, "tone": "VALUE"} | given
    assert bpy.ops.meander.picture(filepath=str(path), **asked) == {"FINISHED"}
    return bpy.context.view_layer.objects.active


def test_a_picture_is_read_as_it_is(ramp: Path) -> None:
    found = read_picture(ramp)
    assert found.sides == (120, 60) and found.opacity is None
    assert found.colours[5, :, 1] == pytest.approx(np.linspace(0.85, 0.2, 120), abs=1e-4)
    assert not bpy.data.images.keys() or "ramp" not in " ".join(bpy.data.images.keys())


def test_the_line_has_the_tones(ramp: Path) -> None:
    curve = drawn(ramp)
    assert curve.type == "CURVE"
    sheet = curve.meander.surface
    assert sheet.name.startswith("ramp")
    assert tuple(sheet.dimensions[:2]) == pytest.approx((0.06, 0.03))
    (points, cyclic), = scenes.world_splines(curve)
    assert cyclic
    ring = np.vstack([points, points[:1]])
    middle, steps = (ring[1:] + ring[:-1]) / 2, np.linalg.norm(np.diff(ring, axis=0), axis=1)
    # Ink over area in six columns of the sheet, without the outer ones.
    edges = np.linspace(-0.03, 0.03, 7)
    length = np.histogram(middle[:, 0], edges, weights=steps)[0]
    share = length * 0.0015 / (0.01 * 0.03)
    wanted = 1.0 - np.linspace(0.85, 0.2, 120).reshape(6, 20).mean(axis=1)
    assert share[1:-1] == pytest.approx(wanted[1:-1], abs=0.05)
    assert look.radius_of(curve) == pytest.approx(0.00075, rel=1e-3)


def test_the_sheet_is_all_that_is_made_where_it_is_not_filled(ramp: Path) -> None:
    sheet = drawn(ramp, fill=False, style="ENGRAVING")
    assert sheet.type == "MESH" and DIRECTION in sheet.data.attributes
    values = scenes.column(sheet.data.attributes[SPACING].data, "value")
    spacing = values * sheet.meander.spacing * 1000.0
    assert 1.5 / spacing.min() == pytest.approx(0.8, abs=0.01)
    assert 1.5 / spacing.max() == pytest.approx(0.15, abs=0.01)
    assert sheet.meander.alignment_source == "ATTRIBUTE"


def test_units_of_the_scene_count(ramp: Path) -> None:
    bpy.context.scene.unit_settings.scale_length = 0.001
    assert tuple(drawn(ramp, fill=False).dimensions[:2]) == pytest.approx((60.0, 30.0))


@pytest.fixture
def art(tmp_path: Path) -> Path:
    """A ring, hatching finer than a pen of half a millimetre on 40, and a block of black."""
    count = 240
    values = np.ones((count, count))
    y, x = np.mgrid[:count, :count]
    values[np.abs(np.hypot(x - 84, y - 84) - 53) < 3] = 0.0
    for k in range(12):
        values[148:216, int(120 + 7.2 * k)] = 0.0
    values[168:206, 24:72] = 0.0
    path = tmp_path / "art.png"
    path.write_bytes(png((65535 * values).astype(np.uint16)))
    return path


ART = {"width": 40.0, "pen": 0.5, "tone": "VALUE"}
# By one run the line is .015 off in rows, .021 grown, and .013 on a sheet that was turned.
NEAR = 0.012


def error_of(curve: bpy.types.Object, path: Path) -> float:
    """How far a line is from the tones of a picture, on the grid that the command would have."""
    (plan,) = plans_of(read_picture(path), Wishes(40.0, 0.5, tone=Tone("value")))
    local = np.linalg.inv(np.array(curve.meander.surface.matrix_world))
    lines = []
    for points, cyclic in scenes.world_splines(curve):
        flat = 1000.0 * (points @ local[:3, :3].T + local[:3, 3]) + [20.0, 20.0, 0.0]
        lines.append(strand_of(flat, np.tile([0.0, 0.0, 1.0], (len(flat), 1)), cyclic))
    ink = drawings.ink_of(lines, 0.5, plan.grid)
    return drawings.tone_error(ink, plan.share, plan.spacing, plan.grid).two


@pytest.mark.parametrize("style", ["PORTRAIT", "SCRIBBLE"])
def test_the_line_is_corrected_as_the_command_corrects_it(art: Path, style: str) -> None:
    curve = drawn(art, **ART, style=style)
    assert error_of(curve, art) <= NEAR
    assert curve.meander.figures.stop_reason == "converged"


def turned(sheet: bpy.types.Object) -> None:
    sheet.matrix_world = Matrix.Translation((3.0, 1.0, 2.0)) @ Euler((0.4, -1.1, 2.0)).to_matrix(
    ).to_4x4()  # fmt: skip


def test_wherever_the_sheet_lies_its_line_is_corrected(art: Path) -> None:
    sheet = drawn(art, **ART, fill=False)
    turned(sheet)
    assert error_of(scenes.fill(sheet, sheet.meander.spacing), art) <= NEAR


def test_a_line_that_is_filled_again_is_corrected_anew(art: Path) -> None:
    first = drawn(art, **ART)
    points = scenes.world_splines(first)[0][0]
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
    again = bpy.context.view_layer.objects.active
    assert np.array_equal(scenes.world_splines(again)[0][0], points)


def test_a_sheet_that_was_bent_has_the_line_of_one_run(art: Path) -> None:
    sheet = drawn(art, **ART, fill=False)
    sheet.modifiers.new("Ball", "CAST").factor = 1.0
    watched = begin(sheet, sheet.meander.spacing)
    assert watched.plan.problem.tones is None
    watched.end()


def test_with_live_on_another_spacing_is_corrected_anew(art: Path) -> None:
    sheet = drawn(art, **ART, fill=False)
    spacing = sheet.meander.spacing
    curve = scenes.fill(sheet, 1.1 * spacing, live=True)
    scenes.activate(sheet)
    sheet.meander.spacing = spacing
    assert bpy.ops.meander.live() == {"FINISHED"}
    assert error_of(curve, art) <= NEAR


def test_a_correction_is_part_of_the_run_that_is_watched(art: Path, windowed) -> None:
    sheet = drawn(art, **ART, fill=False)
    blocking = scenes.world_splines(scenes.fill(sheet, sheet.meander.spacing))[0][0]
    watched, seen = begin(sheet, sheet.meander.spacing), []

    def look_on() -> bool:
        seen.append((watched.progress(), watched.phase_text(), watched.shown_points))
        return False

    tick_until(watched, look_on)
    shares = [progress for progress, _phase, _points in seen]
    assert shares == sorted(shares) and shares[-1] <= 1.0
    corrected = [points for _progress, phase, points in seen if phase == "Correcting tones"]
    assert corrected and min(corrected) > 0, "the line is seen meanwhile"
    result, figures = watched.keep(bpy.context)
    remark, _warning = remarks(watched, bpy.context, result, figures)
    watched.end()
    assert np.array_equal(scenes.world_splines(result)[0][0], blocking)
    told = float(re.fullmatch(r"tones right to (0\.\d{3}) of the range", remark)[1])
    assert told == pytest.approx(error_of(result, art), abs=0.003)


def test_escape_takes_back_a_correction_and_continue_goes_on_with_it(art: Path, windowed) -> None:
    sheet = drawn(art, **ART, fill=False)
    whole = scenes.world_splines(scenes.fill(sheet, sheet.meander.spacing))[0][0]
    bpy.data.objects.remove(sheet.meander.last_result)
    before = scenes.counts()
    watched = begin(sheet, sheet.meander.spacing)
    tick_until(watched, lambda: watched.phase_text() == "Correcting tones")
    watched.suspend()
    assert scenes.counts() == before
    kept = suspended.run_of(sheet)
    assert kept is not None and 0.4 < kept.progress < 1.0
    scenes.activate(sheet)
    assert bpy.ops.meander.resume() == {"FINISHED"}
    assert np.array_equal(scenes.world_splines(sheet.meander.last_result)[0][0], whole)


def test_a_photograph_is_turned_as_its_camera_says_without_pillow(
    tmp_path: Path, monkeypatch
) -> None:
    """Blender's own reader turns none."""
    picture = bpy.data.images.new("high", 30, 60)
    pixels = np.ones((60, 30, 4), dtype=np.float32)
    pixels[:, :, :3] = np.linspace(0.1, 0.9, 60)[:, None, None]  # from the foot, dark, to the top
    picture.pixels.foreach_set(pixels.ravel())
    picture.filepath_raw, picture.file_format = str(tmp_path / "high.jpg"), "JPEG"
    picture.save()
    data = (tmp_path / "high.jpg").read_bytes()
    # A camera that was held upright: its top is on the right of the file (6).
    turn = b"Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0"
    with_turn = data[:2] + b"\xff\xe1" + (len(turn) + 2).to_bytes(2, "big") + turn + data[2:]
    (tmp_path / "turned.jpg").write_bytes(with_turn)
    monkeypatch.setattr(pictures, "is_there", lambda: False)
    found = read_picture(tmp_path / "turned.jpg")
    assert found.sides == (60, 30)
    # What was up in the file is on the right.
    assert found.colours[15, 1, 1] == pytest.approx(0.1, abs=0.05)
    assert found.colours[15, -2, 1] == pytest.approx(0.9, abs=0.05)


def test_light_in_a_file_is_coded_as_other_pictures_are(tmp_path: Path) -> None:
    picture = bpy.data.images.new("light", 40, 20, float_buffer=True)
    picture.colorspace_settings.name = "Non-Color"  # the numbers as they are
    pixels = np.ones((20, 40, 4), dtype=np.float32)
    pixels[:, :20, :3], pixels[:, 20:, :3] = 0.2140, 7.0  # a middle grey, and brighter than white
    picture.pixels.foreach_set(pixels.ravel())
    picture.filepath_raw, picture.file_format = str(tmp_path / "light.exr"), "OPEN_EXR"
    picture.save()
    colours = read_picture(tmp_path / "light.exr").colours
    assert colours[:, :20] == pytest.approx(0.5, abs=2e-3)
    assert colours[:, 20:] == pytest.approx(1.0)


def test_pillow_reads_where_it_is_there(ramp: Path) -> None:
    """It knows more kinds of files, and says of one that is cut off that it is."""
    pillow = pytest.importorskip("PIL.Image")
    data = ramp.with_suffix(".jpg")
    grey = np.tile(np.linspace(0, 255, 120).astype(np.uint8), (60, 1))
    pillow.fromarray(grey).save(data, quality=95)
    whole = data.read_bytes()
    assert tuple(drawn(data, fill=False).dimensions[:2]) == pytest.approx((0.06, 0.03))
    data.write_bytes(whole[: len(whole) // 2])
    assert "cannot be read as a picture (image file is truncated" in refused(data)


def refused(path: object) -> str:
    before = scenes.counts()
    with pytest.raises(RuntimeError) as caught:
        bpy.ops.meander.picture(filepath=str(path))
    assert scenes.counts() == before
    return str(caught.value)


def test_what_is_no_picture_is_refused(tmp_path: Path, monkeypatch) -> None:
    assert "No picture is chosen; choose a file" in refused("")
    path = tmp_path / "a.png"
    path.write_text("x")
    images = len(bpy.data.images)
    monkeypatch.setattr(pictures, "is_there", lambda: False)
    assert "cannot be read as a picture; save it as" in refused(path)
    assert len(bpy.data.images) == images


def test_the_command_reads_pictures_without_pillow(ramp: Path, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr(pictures, "is_there", lambda: False)
    out = tmp_path / "out.svg"
    words = ("--picture", ramp, "--width", 30, "--pen", 1.5, "--output", out, "--quiet")
    assert batch.main([str(word) for word in words]) == 0
    assert 'width="30mm" height="15mm"' in out.read_text()
