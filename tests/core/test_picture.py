# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures in one line: tones, sheets with holes, inks, files, and how well a drawing has the tone,
which is looked at on an image of it that Pillow draws, and not by the length of its line."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import test_sheets
from conftest import PACKAGE
from meander import batch, core
from meander.model.files.whole import FileError
from meander.model.geometry.flat_crossings import crossings, segments_of
from meander.model.picture import correction, drawn, forms, image, inks, line, sheet, strip, tone

PEN = 1.2


def ball(count: int = 200) -> np.ndarray:
    """The values of a shaded ball on a ramp, (count, count)."""
    place = (np.arange(count) + 0.5) / count
    x, y = np.meshgrid(place, place[::-1])
    u, v = (x - 0.5) / 0.32, (y - 0.5) / 0.32
    inside = u * u + v * v
    height = np.sqrt(np.clip(1 - inside, 0, 1))
    shade = np.clip(-0.5 * u + 0.4 * v + 0.77 * height, 0, 1)
    return 1.0 - np.where(inside < 1, 0.95 - 0.85 * shade, 0.15 + 0.45 * x)


def wishes(**changes) -> line.Wishes:
    kind = changes.pop("tone", tone.Tone("value"))
    return line.Wishes(**({"width": 80.0, "pen": PEN, "tone": kind, "threads": 1} | changes))


@pytest.fixture(scope="module")
def of_ball() -> line.Layer:
    (layer,) = line.draw(image.image_of(ball()), wishes())
    return layer


def has_no_crossing(strands) -> bool:
    begin, end, _owner = segments_of(
        [strand.points for strand in strands], [strand.closed for strand in strands]
    )
    return not len(crossings(begin, end)[2])


def test_a_drawing_is_one_line_with_the_tones(of_ball):
    assert len(of_ball.strands) == 1 and of_ball.reason == "converged"
    assert of_ball.figures["crossings"] == 0 and has_no_crossing(of_ball.strands)
    # The bar is .013 where a sheet has many strands; here there are thirty.
    assert of_ball.error.two < 0.02
    ink = of_ball.plan.share.mean() * 80.0 * 80.0
    assert of_ball.length * PEN == pytest.approx(ink, rel=0.03)


def test_the_error_is_that_of_an_image(of_ball):
    pytest.importorskip("PIL")
    plan, size = of_ball.plan, 640
    page = drawn.preview([("#000000", of_ball.strands)], (80.0, 80.0), PEN, size)
    dark = 1.0 - np.asarray(page.convert("L")) / 255.0
    wanted = np.clip(1.0 - ball(), 0.06, 0.9)
    places = (np.arange(size) + 0.5) / size * 200 - 0.5
    near = places.round().astype(int).clip(0, 199)
    share = wanted[np.ix_(near, near)]
    blur = 2.0 * plan.spacing / 80.0 * size
    rim = slice(size // 20, size - size // 20)
    seen = image.blurred(dark - share, blur)[rim, rim]
    assert np.abs(seen).mean() == pytest.approx(of_ball.error.two, abs=0.006)


def test_no_two_strands_are_nearer_than_the_pen():
    flat = image.image_of(np.zeros((60, 60)))
    (layer,) = line.draw(flat, wishes(width=60.0))
    assert layer.plan.least_spacing == pytest.approx(PEN / 0.9)
    assert layer.figures["spacing_p05"] > PEN


def line_art(count: int = 240) -> np.ndarray:
    """Values of a ring, hatching finer than a pen of half a millimetre on 60, and a solid block."""
    values = np.ones((count, count))
    y, x = np.mgrid[:count, :count]
    ring = np.hypot(x - 0.35 * count, y - 0.35 * count) - 0.22 * count
    values[np.abs(ring) < 0.012 * count] = 0.0
    for k in range(12):
        values[148:216, int(120 + 7.2 * k)] = 0.0
    values[168:206, 24:72] = 0.0
    return values


@pytest.mark.parametrize("style", ["portrait", "scribble"])
def test_line_art_has_its_tones(style):
    asked = []

    def run(flow: core.Flow) -> str:
        asked.append(flow.statistics()["iterations"])
        return flow.run()

    changes = {"width": 60.0, "pen": 0.5, "style": style}
    (layer,) = line.draw(image.image_of(line_art()), wishes(**changes), run=run)
    assert layer.error.two <= 0.01  # .014 and .018 by one run
    assert len(asked) <= 3 and asked == sorted(asked)
    assert layer.reason == "converged" and len(layer.strands) == 1
    assert has_no_crossing(layer.strands)


def test_what_a_drawing_lacks_is_asked_for_evenly():
    share = np.full((60, 60), 0.3)
    ink = np.where(np.arange(60) < 30, 0.2, 0.4) * np.ones((60, 1))
    kind = tone.Tone("value")
    asked = correction.corrected(share, share, ink, 2.0, kind)
    assert np.allclose(asked[:, 5], 0.4) and np.allclose(asked[:, -5], 0.2)
    dark = correction.corrected(np.full_like(share, 0.88), share, ink, 2.0, kind)
    assert dark.max() == kind.darkest
    light = correction.corrected(np.full_like(share, 0.06), share, ink, 2.0, kind)
    assert light.min() == pytest.approx(kind.lightest / 2.0)


def test_a_blur_keeps_the_mean_and_spreads_a_point():
    values = np.zeros((64, 81))
    values[30, 40] = 1.0
    found = image.blurred(values, 3.0)
    assert found.sum() == pytest.approx(1.0)
    assert found[30, 40] == pytest.approx(1.0 / (2.0 * np.pi * 9.0), rel=0.01)
    assert found[30, 43] / found[30, 40] == pytest.approx(np.exp(-0.5), rel=1e-3)
    assert np.allclose(image.blurred(np.full((9, 7), 0.4), 5.0), 0.4)


def test_an_average_is_that_of_the_pixels():
    values = np.random.default_rng(1).random((120, 90))
    down, across = np.linspace(0, 1, 13), np.linspace(0, 1, 10)
    found = image.averaged(values, down, across)
    assert found[6, 5] == pytest.approx(values[55:65, 45:55].mean())
    assert found[0, 0] == pytest.approx(values[:5, :5].mean())
    assert np.allclose(image.averaged(np.full((3, 3), 0.7), down, across), 0.7)


@pytest.mark.parametrize(
    ("pixels", "opacity"),
    [
        (np.full((4, 5), 128, np.uint8), None),
        (np.full((4, 5, 3), 32896, np.uint16), None),
        (np.stack([np.full((4, 5), 0.5), np.full((4, 5), 0.25)], axis=-1), 0.25),
        (np.full((4, 5, 4), 0.5), 0.5),
    ],
)
def test_arrays_are_pictures(pixels, opacity):
    found = image.image_of(pixels)
    assert found.sides == (5, 4) and found.colours.shape == (4, 5, 3)
    assert np.allclose(found.colours, 0.5, atol=0.002)
    assert found.opacity is None if opacity is None else np.allclose(found.opacity, opacity)


@pytest.mark.parametrize("pixels", [np.zeros(4), np.zeros((0, 4)), np.full((2, 2), np.nan)])
def test_what_is_no_picture_is_a_sentence(pixels):
    with pytest.raises(FileError, match="picture"):
        image.image_of(pixels)


def test_light_and_values_are_each_other_back():
    values = np.linspace(0, 1, 99)
    assert np.allclose(tone.to_value(tone.to_light(values)), values)
    assert np.allclose(tone.light_of(tone.lightness(values)), values)
    assert tone.to_light(np.array(0.5)) == pytest.approx(0.21404, abs=1e-5)
    assert tone.lightness(np.array(0.184187)) == pytest.approx(50.0, abs=1e-3)


@pytest.mark.parametrize(
    ("kind", "darkness"),
    [("value", 0.5), ("light", 1 - 0.21404), ("eye", 0.5963)],
)
def test_a_middle_grey_in_each_tone(kind, darkness):
    grey = tone.lightness(tone.to_light(np.array([0.5])))
    found = tone.of_lightness(grey, tone.Tone(kind))
    assert found.share[0] == pytest.approx(darkness, abs=0.001)


def test_an_eye_keeps_the_order_of_all_tones():
    seen = np.linspace(0, 100, 201)
    share = tone.of_lightness(seen, tone.Tone()).share
    assert (np.diff(share) < 0).all()
    assert share[[0, -1]] == pytest.approx([0.9, 0.06])


def test_what_was_measured_is_taken_back():
    paper = strip.read_paper("0.2:0.3,0.5:0.65,0.8:0.9")
    wanted = tone.of_lightness(np.linspace(0, 100, 50), tone.Tone("value", paper=paper))
    inside = (wanted.share > 0.061) & (wanted.share < 0.899)
    printed = tone.darkness_on_paper(wanted.share, paper)
    assert np.allclose(printed[inside], wanted.darkness[inside])
    assert inside.sum() > 30


@pytest.mark.parametrize("text", ["x", "0.5", "0.5:0.4,0.4:0.6", "0.5:0.6,0.7:0.5", "1:1"])
def test_measurements_that_do_not_rise_are_a_sentence(text):
    with pytest.raises(FileError, match="--paper"):
        strip.read_paper(text)


def test_a_strip_has_its_patches():
    found = strip.test_strip()
    assert np.allclose(np.unique(1.0 - found.colours[0, :, 0]), strip.PATCHES)


def edges_of(faces: np.ndarray) -> np.ndarray:
    """How many faces each edge has."""
    pairs = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return np.unique(pairs, axis=0, return_counts=True)[1]


def test_a_sheet_has_the_area_of_its_cells():
    grid = sheet.grid_of((30.0, 20.0), 1.0)
    cells = np.ones((20, 30), dtype=bool)
    cells[5:9, 6:12] = False
    used, faces = sheet.triangles(cells)
    corners = grid.points()[used][faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (normals[:, 2] > 0).all()
    assert normals[:, 2].sum() / 2 == pytest.approx(cells.sum())
    assert edges_of(faces).max() == 2


def test_islands_are_joined_by_corridors():
    opaque = np.zeros((61, 81), dtype=bool)
    opaque[5:25, 5:25] = opaque[30:55, 50:75] = opaque[5:20, 60:75] = True
    opaque[40, 10] = True  # a speck
    apart = sheet.cells_kept(opaque, 9.0, 4.0, bridges=False)
    joined = sheet.cells_kept(opaque, 9.0, 4.0, bridges=True)
    assert sheet.parts_of(apart)[1] == 3 and sheet.parts_of(joined)[1] == 1
    assert not (apart & ~joined).any() and not joined[38:42, 8:12].any()
    assert edges_of(sheet.triangles(joined)[1]).max() == 2


def test_no_two_cells_meet_at_a_corner_only():
    opaque = np.random.default_rng(2).random((40, 40)) > 0.2
    kept = sheet.cells_kept(opaque, 1.0, 3.0, bridges=True)
    a, b, c, d = kept[:-1, :-1], kept[:-1, 1:], kept[1:, :-1], kept[1:, 1:]
    assert not ((a & d & ~b & ~c) | (b & c & ~a & ~d)).any()
    with _surface(kept) as surface:
        assert surface.statistics()["components"] == 1


def _surface(kept: np.ndarray) -> core.Surface:
    grid = sheet.grid_of((float(kept.shape[1]), float(kept.shape[0])), 1.0)
    used, faces = sheet.triangles(kept)
    return core.Surface(grid.points()[used], faces)


def test_a_hole_stays_white_and_the_line_is_one():
    values = np.full((80, 80), 0.5)
    opacity = np.zeros_like(values)
    opacity[5:35, 5:35] = opacity[45:75, 45:75] = 1.0
    pixels = np.stack([values, opacity], axis=-1)
    (layer,) = line.draw(image.image_of(pixels), wishes())
    assert len(layer.strands) == 1 and has_no_crossing(layer.strands)
    places = layer.strands[0].points[:, :2]
    left = (places[:, 0] < 30) & (places[:, 1] < 30)
    right = (places[:, 0] > 50) & (places[:, 1] > 50)
    assert not left.any() and not right.any()
    apart = line.draw(image.image_of(pixels), wishes(bridges=False))[0].strands
    assert len(apart) == 2


def test_rows_of_an_engraving_follow_the_edges():
    x, y = np.meshgrid(np.linspace(-1, 1, 80), np.linspace(1, -1, 80))
    angles = forms.form_angles(0.5 + 0.3 * np.sin(12 * np.hypot(x, y)), 3.0)
    ring = (np.hypot(x, y) > 0.4) & (np.hypot(x, y) < 0.8)
    along = np.arctan2(x, -y)  # round the middle
    assert np.abs(np.cos(angles - along))[ring].mean() > 0.97


def test_inks_take_the_light_of_their_colour():
    colours = np.array([[[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], [0, 0, 0]]], float)
    picture = image.image_of(np.repeat(np.repeat(colours, 20, axis=0), 20, axis=1))
    places = np.array([0.0, 0.5, 1.0]), np.linspace(0, 1, 11)
    lights = inks.separated(picture, ("cyan", "magenta", "yellow", "black"), *places)
    # In the middles of red, green, blue, white and black.
    taken = {name: 1.0 - light[1, 1::2] for name, light in lights.items()}
    assert taken["cyan"] == pytest.approx([0, 1, 1, 0, 0], abs=0.01)
    assert taken["magenta"] == pytest.approx([1, 0, 1, 0, 0], abs=0.01)
    assert taken["yellow"] == pytest.approx([1, 1, 0, 0, 0], abs=0.01)
    assert taken["black"] == pytest.approx([0, 0, 0, 0, 1], abs=0.01)


def test_black_and_the_colours_of_a_grey_are_the_grey():
    values = tone.to_value(tone.light_of(np.linspace(0, 100, 21)))
    places = np.array([0.0, 1.0]), np.linspace(0, 1, 21)
    picture = image.image_of(np.tile(values, (2, 1)))
    lights = inks.separated(picture, ("cyan", "black"), *places)
    cyan, black = (tone.lightness(lights[name])[0] for name in ("cyan", "black"))
    seen = tone.lightness(tone.grey_light(picture, "light", *places))[0]
    assert np.allclose(cyan * black / 100, seen, atol=1e-3)
    assert black[seen > 55] == pytest.approx(100.0)


# ------------------------------------------------------------------------------------------------
# The command


@pytest.fixture
def portrait(tmp_path: Path) -> Path:
    pillow = pytest.importorskip("PIL.Image")
    path = tmp_path / "portrait.png"
    pillow.fromarray((255 * ball(100)).round().astype(np.uint8)).save(path)
    return path


def run(*words: object) -> int:
    return batch.main([str(word) for word in words])


def test_the_command_writes_a_page_in_millimetres(portrait, tmp_path, capsys):
    out, report, shown = tmp_path / "out.svg", tmp_path / "out.json", tmp_path / "out.png"
    code = run("--picture", portrait, "--width", 40, "--pen", PEN, "--margin", 5, "--output", out,
               "--report", report, "--preview", shown, "--feed", 600)  # fmt: skip
    assert code == 0, capsys.readouterr().err
    text = out.read_text()
    assert 'width="50mm" height="50mm" viewBox="0 0 50 50"' in text
    assert f'stroke-width="{PEN}"' in text and text.count("<path") == 1
    numbers = np.array(re.findall(r"[ML]([\d.]+) ([\d.]+)", text), float)
    assert numbers.min() > 5.0 and numbers.max() < 45.0
    record = json.loads(report.read_text())
    assert record["sides"] == [40.0, 40.0] and record["inks"][0]["crossings"] == 0
    assert record["minutes"] == pytest.approx(record["length"] / 600)
    assert 0 < record["inks"][0]["tone"]["error_2"] < 0.04
    assert shown.read_bytes().startswith(b"\x89PNG")
    assert "mm of line" not in capsys.readouterr().err


@pytest.mark.parametrize("suffix", [".dxf", ".gcode", ".obj", ".png"])
def test_the_command_writes_every_kind(portrait, tmp_path, suffix):
    out = tmp_path / f"out{suffix}"
    arguments = ("--picture", portrait, "--width", 20, "--pen", PEN, "--quiet", "--output", out)
    assert run(*arguments) == 0
    assert out.stat().st_size > 500
    earlier = out.read_bytes()
    assert run(*arguments) == 0
    assert out.read_bytes() == earlier


def test_inks_are_layers_or_files(portrait, tmp_path):
    pillow = pytest.importorskip("PIL.Image")
    colours = np.zeros((40, 40, 3), np.uint8) + np.array([220, 60, 40], np.uint8)
    pillow.fromarray(colours).save(portrait)
    words = ("--picture", portrait, "--width", 20, "--pen", PEN, "--quiet",
             "--inks", "cyan,magenta,yellow", "--output")  # fmt: skip
    assert run(*words, tmp_path / "out.svg") == 0
    text = (tmp_path / "out.svg").read_text()
    layers = re.findall(r'inkscape:label="(\w+)" stroke="(#\w+)"', text)
    assert layers[-2:] == [("magenta", "#e0157f"), ("yellow", "#f7d800")]
    assert run(*words, tmp_path / "out.gcode") == 0
    assert (tmp_path / "out_magenta.gcode").exists() and (tmp_path / "out_yellow.gcode").exists()
    assert not (tmp_path / "out.gcode").exists()


@pytest.mark.parametrize("arcs", [(), ("--arcs", 0.05)])
def test_a_large_picture_comes_in_sheets(portrait, tmp_path, capsys, arcs):
    out, report = tmp_path / "out.svg", tmp_path / "out.json"
    code = run("--picture", portrait, "--width", 60, "--pen", PEN, "--output", out, *arcs,
               "--report", report, "--sheet", "50x42", "--sheet-margin", 4)  # fmt: skip
    said = capsys.readouterr()
    assert code == 0, said.err
    assert "4 sheets of 50 x 42 mm, out_r1c1.svg to out_r2c2.svg" in said.out
    (entry,) = json.loads(report.read_text())["sheets"]
    assert (entry["rows"], entry["columns"]) == (2, 2)
    lengths, pieces = [], []
    for each in entry["written"]:
        text = (tmp_path / each["file"]).read_text()
        assert 'width="50mm" height="42mm"' in text and 'inkscape:label="marks"' in text
        assert text.count('stroke="#000000"') == 2  # of the file, and of the layer
        lengths.append(each["length"])
        assert text.count("<path") == each["paths"] + 8
        if not arcs:
            lines, _marks, _sides = test_sheets.svg(tmp_path / each["file"])
            there = [(each["column"] - 1) * 42.0, (entry["rows"] - each["row"]) * 34.0]
            pieces += [way + there for way in lines[8:]]
    whole = json.loads(report.read_text())["length"]
    assert sum(lengths) == pytest.approx(whole, rel=0.01)
    if not arcs:
        (found,) = test_sheets.joined(pieces, 2 * test_sheets.ROUNDED)
        assert test_sheets.length(found) == pytest.approx(whole, rel=1e-3)


def test_sheets_of_inks_lie_as_one(portrait, tmp_path):
    pillow = pytest.importorskip("PIL.Image")
    colours = np.zeros((40, 40, 3), np.uint8) + np.array([220, 60, 40], np.uint8)
    colours[:, 20:, 1] = 255  # magenta on the left only
    pillow.fromarray(colours).save(portrait)
    words = ("--picture", portrait, "--width", 30, "--pen", PEN, "--quiet", "--leave-white", 0.05,
             "--inks", "magenta,yellow", "--sheet", "25x25", "--sheet-margin", 5, "--output")
    assert run(*words, tmp_path / "out.gcode") == 0
    written = {path.name for path in tmp_path.glob("out_*_r*.gcode")}
    assert "out_magenta_r1c1.gcode" in written and "out_yellow_r2c2.gcode" in written
    marks = {tuple(re.findall(r"X\S+ Y\S+", path.read_text().partition("; layer")[0]))
             for path in tmp_path.glob("out_*_r*.gcode")}  # fmt: skip
    assert len(marks) == 1, "crosses lie in the same places for every pen"
    assert run(*words, tmp_path / "out.svg") == 0
    labels = re.findall(r'inkscape:label="(\w+)"', (tmp_path / "out_r1c1.svg").read_text())
    assert labels == ["marks", "magenta", "yellow"]


@pytest.mark.parametrize("named", ["same.svg", "all_cyan.png", "all_black.gcode", "out.svg"])
def test_what_is_read_or_written_is_not_written_again(portrait, tmp_path, capsys, named):
    """Through a hard link, and by the names that files of inks get."""
    read = tmp_path / named
    os.link(portrait, read)
    argv = ["--picture", str(portrait), "--width", "20", "--pen", "1"]
    argv += {
        "same.svg": ["--output", str(read)],
        "out.svg": ["--output", str(tmp_path / "new.svg"), "--report", str(read)],
        "all_cyan.png": ["--output", str(tmp_path / "all_cyan.obj"), "--preview", str(read)],
        "all_black.gcode": ["--output", str(tmp_path / "all.gcode"), "--inks", "cyan,black"],
    }[named]
    before = portrait.read_bytes()
    assert batch.main(argv) == 2
    assert "would overwrite --picture" in capsys.readouterr().err
    assert read.samefile(portrait) and portrait.read_bytes() == before


def test_a_crop_beyond_the_picture_is_a_sentence(portrait, tmp_path, capsys):
    code = run("--picture", portrait, "--crop", 50, 50, 60, 50, "--output", tmp_path / "a.svg")
    assert code == 2
    assert "is not within the picture, which has 100 x 100 pixels" in capsys.readouterr().err
    assert not (tmp_path / "a.svg").exists()


def test_what_is_no_picture_is_refused(portrait, tmp_path, capsys):
    portrait.write_text("x")
    assert run("--picture", portrait, "--output", tmp_path / "a.svg") == 2
    assert "cannot be read as a picture" in capsys.readouterr().err


def test_sixteen_bits_are_kept(portrait):
    pillow = pytest.importorskip("PIL.Image")
    from meander.model.files.png import png

    values = (np.arange(60 * 50 * 3).reshape(60, 50, 3) * 7 % 65536).astype(np.uint16)
    portrait.write_bytes(png(values))
    found = image.read_image(portrait).colours
    assert np.array_equal((found * 65535).round().astype(int), values)
    pillow.fromarray(values[..., 0]).save(portrait)
    found = image.read_image(portrait).colours[..., 0]
    assert np.array_equal((found * 65535).round().astype(int), values[..., 0])


@pytest.mark.parametrize("turn", range(1, 9))
def test_a_photograph_is_turned_as_its_camera_says(portrait, turn):
    pillow = pytest.importorskip("PIL.Image")
    from PIL import ImageOps

    values = (np.arange(24).reshape(4, 6) * 10).astype(np.uint8)
    made = pillow.fromarray(values)
    exif = made.getexif()
    exif[0x0112] = turn
    made.save(portrait, exif=exif)
    with pillow.open(portrait) as opened:
        wanted = np.asarray(ImageOps.exif_transpose(opened))
    found = image.read_image(portrait).colours[..., 0]
    assert np.array_equal((found * 255).round().astype(np.uint8), wanted)


def test_without_pillow_there_is_a_sentence(portrait, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(image.importlib.util, "find_spec", lambda _name: None)
    assert run("--picture", portrait, "--output", tmp_path / "a.svg") == 2
    assert "pip install Pillow" in capsys.readouterr().err


def test_a_picture_comes_and_goes_by_the_standard_streams(portrait, tmp_path):
    words = ("--width", "20", "--pen", str(PEN), "--output-format", "svg")
    command = [sys.executable, str(PACKAGE / "batch.py"), "--picture", "-", "--output", "-", *words]
    made = subprocess.run(command, input=portrait.read_bytes(), capture_output=True, timeout=60)
    assert made.returncode == 0, made.stderr
    assert made.stdout.startswith(b"<?xml") and made.stdout.rstrip().endswith(b"</svg>")
    assert b"mm of line" not in made.stdout and b"one line" in made.stderr
    out = tmp_path / "out.svg"
    assert run("--picture", portrait, "--output", out, "--quiet", *words[:4]) == 0
    drawing = re.compile(rb'<path[^>]* d="[^"]*"')
    assert drawing.findall(made.stdout) == drawing.findall(out.read_bytes())


def test_ways_between_lines_take_time(portrait, tmp_path):
    pillow = pytest.importorskip("PIL.Image")
    values = np.full((40, 80, 2), 120, np.uint8)
    values[..., 1] = 255
    values[:, 35:45, 1] = 0
    pillow.fromarray(values, "LA").save(portrait)
    report = tmp_path / "a.json"
    assert run("--picture", portrait, "--width", 40, "--pen", PEN, "--no-bridges", "--output",
               tmp_path / "a.svg", "--report", report, "--feed", 600, "--travel-feed", 1200,
               "--quiet") == 0  # fmt: skip
    record = json.loads(report.read_text())
    assert record["inks"][0]["lines"] == 2 and 5.0 < record["travel"] < 45.0
    assert record["minutes"] == pytest.approx(record["length"] / 600 + record["travel"] / 1200)
