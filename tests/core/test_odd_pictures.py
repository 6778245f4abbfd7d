# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of odd kinds: what is drawn of them, and what is said where nothing can be."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from meander import batch
from meander.model.files.whole import FileError
from meander.model.picture import image, line
from meander.model.picture.tone import Tone

RAMP = np.tile(np.linspace(0, 255, 60).astype(np.uint8), (45, 1))


def plan_of(pixels: np.ndarray, **wishes) -> line.Plan:
    (plan,) = line.plans_of(image.image_of(pixels), line.Wishes(width=40.0, pen=1.0, **wishes))
    return plan


@pytest.mark.parametrize("pixels", [np.full((1, 1), 80, np.uint8), np.zeros((9, 9), np.uint8)])
def test_one_pixel_and_all_black_are_even(pixels):
    plan = plan_of(pixels)
    assert plan.share == pytest.approx(np.full(plan.share.shape, plan.share[0, 0]))
    assert (plan.dark, plan.light) == (0.0, 0.0)


@pytest.mark.parametrize("kind", ["eye", "value"])
def test_a_ramp_is_lighter_than_the_pen_only_where_it_is(kind):
    """Tones that are fitted to the pen's are in its reach, whatever rounding makes of the ends."""
    plan = plan_of(RAMP, tone=Tone(kind))
    if kind == "eye":
        assert (plan.dark, plan.light) == (0.0, 0.0)
    else:
        assert plan.dark == pytest.approx(0.1, abs=0.03)
        assert plan.light == pytest.approx(0.06, abs=0.03)


def test_what_is_out_of_reach_is_so_on_paper():
    """On paper that makes lines wider a pen reaches a darkness that its share of ink does not."""
    paper = ((0.5, 0.8), (0.9, 0.99))
    # A hundredth of the ramp is, to a column of the grid; by the share of ink it were a tenth.
    assert plan_of(RAMP, tone=Tone("value", paper=paper)).dark < 0.05


def test_a_strip_narrower_than_a_strand_is_a_sentence():
    with pytest.raises(FileError, match="no room for a strand of a pen of 1 mm"):
        plan_of(np.full((1, 10000), 100, np.uint8))


def test_what_is_transparent_all_over_is_said_to_be():
    clear = np.zeros((9, 9, 4), np.uint8)
    with pytest.raises(FileError, match="the picture is transparent: there is no place"):
        plan_of(clear)
    with pytest.raises(FileError, match="the picture is transparent"):
        line.plans_of(image.image_of(clear), line.Wishes(), image.image_of(np.ones((2, 2))))
    pictures = (image.image_of(RAMP), line.Wishes(), image.image_of(np.zeros((2, 2))))
    with pytest.raises(FileError, match="the mask leaves nothing: there is no place"):
        line.plans_of(*pictures)


@pytest.mark.parametrize("bridges", [True, False])
def test_an_ink_that_is_needed_nowhere_is_left_out(bridges):
    sky = image.image_of(np.full((45, 60, 3), (150, 220, 255), dtype=np.uint8))
    plans = line.plans_of(
        sky, line.Wishes(width=40.0, pen=1.0, inks=("cyan", "black"), bridges=bridges)
    )
    assert [plan.name for plan in plans] == ["cyan"]
    with pytest.raises(FileError, match="nothing of the picture is dark enough"):
        plan_of(np.full((45, 60), 250, dtype=np.uint8), leave_white=0.9, bridges=bridges)


def saved(folder: Path, name: str) -> Path:
    """A file of an odd kind, whose picture is the ramp."""
    from PIL import Image

    path, grey = folder / name, Image.fromarray(RAMP)
    if name == "turned.jpg":
        turn = Image.Exif()
        turn[0x112] = 6
        grey.transpose(Image.Transpose.ROTATE_90).save(path, exif=turn, quality=98)
    elif name == "cmyk.jpg":
        grey.convert("CMYK").save(path, quality=98)
    elif name == "sixteen.png":
        Image.fromarray(RAMP.astype(np.uint16) * 257).save(path)
    elif name == "moving.gif":
        rest = [grey.transpose(Image.Transpose.FLIP_LEFT_RIGHT)]
        grey.save(path, save_all=True, append_images=rest)
    elif name == "opacity.png":
        alpha = Image.new("L", grey.size, 255)
        Image.merge("LA", (grey, alpha)).save(path)
    elif name == "palette.png":
        grey.convert("P").save(path)
    return path


@pytest.mark.parametrize(
    "name",
    ["turned.jpg", "cmyk.jpg", "sixteen.png", "moving.gif", "opacity.png", "palette.png"],
)
def test_files_of_odd_kinds_are_the_same_picture(tmp_path, name):
    pytest.importorskip("PIL")
    found = image.read_image(saved(tmp_path, name))
    assert found.sides == (60, 45) and found.opacity is None
    assert found.colours[..., 1] == pytest.approx(RAMP / 255.0, abs=0.03)


def tiff(values: np.ndarray, order: str, packed: bool) -> bytes:
    """A TIFF of colours of 16 bits, in one strip."""
    height, width, depth = values.shape
    strip = values.astype(f"{order}u2").tobytes()
    strip = zlib.compress(strip) if packed else strip
    # The numbers of TIFF 6.0: sides, bits, compression, RGB, strip, channels, rows, bytes, opacity.
    words = {256: width, 257: height, 258: None, 259: 8 if packed else 1, 262: 2, 273: None}
    words |= {277: depth, 278: height, 279: len(strip)} | ({338: 2} if depth == 4 else {})
    behind = 10 + 12 * len(words) + 4
    places = {258: behind, 273: behind + 2 * depth}
    made = (b"II" if order == "<" else b"MM") + struct.pack(f"{order}HIH", 42, 8, len(words))
    for tag, word in words.items():
        count = depth if tag == 258 else 1
        if tag in places or tag == 279:
            number = 3 if tag == 258 else 4
            made += struct.pack(f"{order}HHII", tag, number, count, places.get(tag, word))
        else:
            made += struct.pack(f"{order}HHIHH", tag, 3, count, word, 0)
    return made + struct.pack(f"{order}I{depth}H", 0, *[16] * depth) + strip


@pytest.mark.parametrize("packed", [False, True])
@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("depth", [3, 4])
def test_colours_of_a_tiff_keep_their_sixteen_bits(tmp_path, depth, order, packed):
    pytest.importorskip("PIL")
    values = (np.arange(20 * 30 * depth).reshape(20, 30, depth) * 37 % 65536).astype(np.uint16)
    (tmp_path / "deep.tif").write_bytes(tiff(values, order, packed))
    found = image.read_image(tmp_path / "deep.tif")
    assert np.array_equal((found.colours * 65535).round().astype(int), values[..., :3])
    if depth == 4:
        assert np.array_equal((found.opacity * 65535).round().astype(int), values[..., 3])


def png(values: np.ndarray, *chunks: tuple[bytes, bytes]) -> bytes:
    """A PNG of 16 bits a channel, with chunks before its pixels."""
    height, width, depth = values.shape
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in values)
    kind = {1: 0, 2: 4, 3: 2, 4: 6}[depth]
    head = struct.pack(">IIBBBBB", width, height, 16, kind, 0, 0, 0)
    parts = [(b"IHDR", head), *chunks, (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in parts
    )


@pytest.mark.parametrize("depth", [1, 2, 3, 4])
def test_a_png_keeps_its_sixteen_bits_and_its_opacity(tmp_path, depth):
    pytest.importorskip("PIL")
    values = (np.arange(20 * 30 * depth).reshape(20, 30, depth) * 37 % 65536).astype(np.uint16)
    (tmp_path / "deep.png").write_bytes(png(values))
    found = image.read_image(tmp_path / "deep.png")
    colours = (found.colours * 65535).round().astype(int)
    wanted = values[..., : 1 if depth < 3 else 3]
    assert np.array_equal(colours, np.broadcast_to(wanted, (20, 30, 3)))
    if depth in (2, 4):
        assert np.array_equal((found.opacity * 65535).round().astype(int), values[..., -1])


@pytest.mark.parametrize("depth", [1, 3])
def test_a_colour_that_stands_for_nothing_has_no_line(tmp_path, depth):
    """Also one of 16 bits, and nothing that is near it."""
    pytest.importorskip("PIL")
    values = np.full((20, 30, depth), 30001, dtype=np.uint16)
    values[:, :10] = 30000
    key = struct.pack(f">{depth}H", *[30000] * depth)
    (tmp_path / "key.png").write_bytes(png(values, (b"tRNS", key)))
    found = image.read_image(tmp_path / "key.png")
    assert np.array_equal(found.opacity, np.where(np.arange(30) < 10, 0.0, 1.0) * np.ones((20, 1)))


def test_numbers_that_are_not_from_0_to_1_are_a_sentence(tmp_path):
    with pytest.raises(FileError, match=r"values up to 255, .* divide them by 255"):
        image.image_of(RAMP.astype(float))
    with pytest.raises(FileError, match="values from -20"):
        image.image_of(RAMP / 255.0 - 20.0)
    # As resampling leaves them beside edges.
    over = image.image_of(RAMP / 255.0 * 1.2 - 0.1)
    assert (over.colours.min(), over.colours.max()) == (0.0, 1.0)
    pytest.importorskip("PIL")
    from PIL import Image

    Image.fromarray(RAMP.astype(np.float32)).save(tmp_path / "float.tif")
    Image.fromarray(RAMP.astype(np.int32) * 100_000).save(tmp_path / "long.tif")
    for name, said in (("float.tif", "float.tif has values up to 255"), ("long.tif", "32 bits")):
        with pytest.raises(FileError, match=said):
            image.read_image(tmp_path / name)


def test_a_sheet_narrower_than_the_pen_has_no_room():
    with pytest.raises(FileError, match="40 x 0.4 mm has no room for a strand of a pen of 1 mm"):
        plan_of(np.full((1, 100), 100, np.uint8))


def test_a_pen_that_is_far_too_fine_is_said_in_the_words_of_a_picture():
    with pytest.raises(FileError, match="has too many lines on 40 x 30 mm; choose a wider pen"):
        line.plans_of(image.image_of(RAMP), line.Wishes(width=40.0, pen=1e-6))


@pytest.mark.parametrize("content", [b"", b"no picture\n", b"\x89PNG\r\n\x1a\n"])
def test_what_is_no_picture_is_said_to_be_none(tmp_path, content):
    pytest.importorskip("PIL")
    path = tmp_path / "picture.png"
    path.write_bytes(content)
    with pytest.raises(FileError, match=r"picture\.png cannot be read as a picture"):
        image.read_image(path)


def test_a_sheet_that_is_too_large_says_what_helps_a_picture(tmp_path, capsys):
    pytest.importorskip("PIL")
    from PIL import Image

    Image.new("L", (4, 4), 100).save(tmp_path / "grey.png")
    argv = f"--picture {tmp_path}/grey.png --output {tmp_path}/x.svg --limit-nodes 10".split()
    assert batch.main(argv) == 2
    assert "choose a wider pen, a smaller width or a part of the picture" in capsys.readouterr().err
