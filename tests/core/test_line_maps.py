# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of the curve by a UV map, against distances found pixel by pixel."""

from __future__ import annotations

import struct
import zlib
from dataclasses import replace
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import flow_on
from meander import core
from meander.model import image_files, maps
from meander.model.files.exr import exr
from meander.model.files.png import png
from meander.model.maps import Mapped, Style, Tile

SPACING = 0.1
SIZE = 200


@pytest.fixture(scope="module")
def sheet() -> Mapped:
    """A square that fills the map, with a curve that has not converged: nothing here needs that."""
    mesh = geometry.grid(12, 12)
    low = mesh.vertices.min(axis=0)
    vertices = (mesh.vertices - low) / np.ptp(mesh.vertices[:, 0])
    with flow_on((vertices, mesh.faces), radius=SPACING / 2, iteration_limit=120) as flow:
        flow.run()
        cut = core.cut_surface(flow, SPACING / 8, middle_lines=True)
    return Mapped(cut, cut.positions[cut.faces][:, :, :2].copy(), SPACING)


def centres(size: int = SIZE) -> np.ndarray:
    """Where the pixels of an image lie in the map, (size, size, 2), its first row at the top."""
    u = (np.arange(size) + 0.5) / size
    return np.stack(np.meshgrid(u, 1.0 - u), axis=2)


def true_distances(mapped: Mapped, places: np.ndarray) -> np.ndarray:
    """From points of the plane to the curve, segment by segment."""
    ends = mapped.cut.positions[mapped.cut.line_edges()][:, :, :2]
    return geometry.distance_to_pieces(places, ends[:, 0], ends[:, 1])


def test_pixels_say_how_far_the_line_is(sheet: Mapped) -> None:
    image = Tile(sheet, (0, 0), Style(SIZE, 0)).image("distance") / 65535.0
    true = true_distances(sheet, centres().reshape(-1, 2)).reshape(SIZE, SIZE) / SPACING
    near = true < 1.0
    off = np.abs(image - true)[near]
    assert np.median(off) < 1e-4 and np.percentile(off, 99) < 0.02 and off.max() < 0.1


def test_on_the_inside_of_a_bend_the_nearer_side_counts(sheet: Mapped) -> None:
    """What lies between corners that are nearest to both its sides may be nearest to either."""
    cut, rng = sheet.cut, np.random.default_rng(1)
    sides = np.diff(cut.positions[cut.faces], axis=1)
    area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    faces = rng.choice(len(area), 40_000, p=area / area.sum()).astype(np.int32)
    weights = rng.dirichlet([1.0, 1.0, 1.0], len(faces)).astype(np.float32)
    found = core.cut_places(cut, SPACING, faces, weights, False).distances
    places = (cut.positions[cut.faces[faces]] * weights[:, :, None]).sum(axis=1)[:, :2]
    off = np.abs(found - np.minimum(true_distances(sheet, places), SPACING))
    assert off.max() < 0.012 * SPACING


def test_an_image_is_the_same_for_any_number_of_threads(sheet: Mapped) -> None:
    places = np.random.default_rng(1).uniform(-20, 120, (400, 3, 2))
    one, two = (core.map_pixels(places, 100, 5, threads) for threads in (1, 2))
    assert all(np.array_equal(a, b) for a, b in zip(one[:2], two[:2], strict=True))
    assert one[2:] == two[2:]
    found = [
        core.cut_places(
            sheet.cut, SPACING, np.abs(one.faces) % 50, np.abs(one.weights), True, threads
        )
        for threads in (1, 2)
    ]
    assert all(np.array_equal(a, b) for a, b in zip(*found, strict=True))


def supersampled(mapped: Mapped, size: int, rows: slice) -> tuple[np.ndarray, ...]:
    """The mean distance, height and colour of 64 places a pixel in some rows of an image, found by
    nothing of the cut but its line: (rows, size), the same, and (rows, size, 3)."""
    a, b = np.moveaxis(mapped.cut.positions[mapped.cut.line_edges()][:, :, :2], 1, 0)
    assert mapped.cut.closed.all()  # so every point begins an edge
    strand = np.searchsorted(mapped.cut.offsets, np.arange(len(a)), side="right") - 1
    steps = (np.arange(8) + 0.5) / 8 - 0.5
    offsets = np.stack(np.meshgrid(steps, steps), axis=2).reshape(-1, 2) / size
    middles = centres(size)[rows]
    means = []
    for middle in middles.reshape(-1, 2):
        far = distances_to(middle[None], a, b)[0][0]
        near = np.flatnonzero(far < far.min() + 1.5 / size)
        distance, share = distances_to(middle + offsets, a[near], b[near])
        best = distance.argmin(axis=1)
        every, piece = np.arange(len(offsets)), near[best]
        d = distance[every, best] / SPACING
        on = share[every, best] * np.linalg.norm(b[piece] - a[piece], axis=1)
        part = (mapped.cut.arc_lengths[piece] + on) / mapped.cut.lengths[strand[piece]]
        colours = Style().colours(1 - np.abs(2 * part - 1))  # there and back
        height = 1 - np.clip(1 - 2 * d, 0, 1) ** 2
        means.append([np.clip(d, 0, 1).mean(), height.mean(), *colours.mean(axis=0)])
    images = np.reshape(means, (*middles.shape[:2], 5))
    return images[:, :, 0], images[:, :, 1], images[:, :, 2:]


def distances_to(
    places: np.ndarray, a: np.ndarray, b: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Of each place from each piece, (n, m), and how far along the piece, from 0 to 1."""
    u, way = b - a, places[:, None] - a
    share = np.clip((way * u).sum(2) / np.maximum((u * u).sum(1), 1e-300), 0.0, 1.0)
    return np.linalg.norm(way - share[:, :, None] * u, axis=2), share


def test_pixels_are_the_mean_over_their_area(sheet: Mapped) -> None:
    """Against 64 places a pixel; and no border between two turns is off by more than a pixel."""
    size, rows = 120, slice(50, 66)
    distance, height, colour = supersampled(sheet, size, rows)
    tile = Tile(sheet, (0, 0), Style(size, 0))
    for kind, true in (("distance", distance), ("height", height)):
        off = np.abs(tile.values(kind)[rows] - true)
        assert np.percentile(off, 99) < 0.01
    found = tile.values("color")[rows]
    # At borders a pixel differs from its neighbours by a good part of the ramp.
    jump = np.zeros(colour.shape[:2])
    jump[:, 1:] = np.abs(np.diff(colour, axis=1)).max(axis=2)
    jump[1:] = np.maximum(jump[1:], np.abs(np.diff(colour, axis=0)).max(axis=2))
    border = jump > 0.05
    off = np.abs(found - colour).max(axis=2)
    assert border.sum() > 100 and off[border].mean() < 0.02
    # A spike shows a colour that neither the pixel has nor any of its neighbours.
    wide = np.pad(colour, ((1, 1), (1, 1), (0, 0)), mode="edge")
    high, across = colour.shape[:2]
    around = np.stack([wide[r : r + high, c : c + across] for r in range(3) for c in range(3)])
    beyond = np.maximum(around.min(axis=0) - found, found - around.max(axis=0)).max(axis=2)
    assert np.all(beyond[1:-1] < 0.03)


def test_each_pixel_lies_in_its_face() -> None:
    """The last one that it is in, by another formula."""
    generator = np.random.default_rng(2)
    places = generator.uniform(-10, 70, (60, 3, 2))
    places[:3] = places[0]  # without area
    places[3, 1, 0] = np.nan
    found = core.map_pixels(places, 60)
    at = np.stack(np.meshgrid(np.arange(60), np.arange(60)), axis=2).reshape(-1, 2)
    expected = np.full(3600, -1)
    for number, corners in enumerate(places):
        turns = [
            np.cross(corners[(k + 1) % 3] - corners[k], at - corners[k]) for k in range(3)
        ]
        inside = (np.array(turns) > 0).all(axis=0) | (np.array(turns) < 0).all(axis=0)
        expected[inside] = number
    assert (found.faces == expected).mean() > 0.999
    known = found.faces >= 0
    corners = places[found.faces[known]]
    back = np.einsum("nk,nkx->nx", found.weights[known].astype(float), corners)
    assert np.abs(back - at[known]).max() < 1e-3
    assert found.covered == known.sum() >= found.twice > 0


def test_images_are_cancelled(sheet: Mapped, tmp_path: Path) -> None:
    with core.Context() as context:
        context.cancel()
        with pytest.raises(core.MeanderError) as refused:
            image_files.images(sheet, tmp_path / "out.png", ["mask"], Style(SIZE, 0), context)
    assert refused.value.status == core.Status.CANCELLED


def test_images_are_drawn_piece_by_piece(
    sheet: Mapped, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In any pieces the same, with a share that rises to the end."""
    style, kinds = Style(SIZE, 0), ["mask", "distance"]
    whole, _overlap = image_files.images(sheet, tmp_path / "out.png", kinds, style)
    monkeypatch.setattr(maps, "_AT_ONCE", SIZE * SIZE // 5)
    shares = []
    pieces, _overlap = image_files.images(
        sheet, tmp_path / "out.png", kinds, style, progress=shares.append
    )
    assert pieces == whole
    assert len(shares) > 20 and shares == sorted(set(shares)) and shares[-1] == 1.0


def test_the_mask_is_as_wide_as_asked(sheet: Mapped) -> None:
    image = Tile(sheet, (0, 0), Style(SIZE, 0, line_width=0.3)).image("mask") / 65535.0
    true = true_distances(sheet, centres().reshape(-1, 2)).reshape(SIZE, SIZE)
    pixel = 1.0 / SIZE
    assert (image[true < 0.15 * SPACING - pixel] == 1.0).mean() > 0.999
    assert (image[true > 0.15 * SPACING + pixel] == 0.0).mean() > 0.995
    assert image.mean() == pytest.approx((true < 0.15 * SPACING).mean(), rel=0.02)


def test_normals_lean_as_heights_rise(sheet: Mapped) -> None:
    style = Style(SIZE, 0, depth=0.4)
    tile = Tile(sheet, (0, 0), style)
    normal = tile.image("normal") / 65535.0 * 2.0 - 1.0
    assert np.linalg.norm(normal, axis=2) == pytest.approx(1.0, abs=1e-3)
    height = tile.image("height") / 65535.0 * style.depth * SPACING
    rise_v, rise_u = np.gradient(height, 1.0 / SIZE)
    # A difference of two pixels says nothing where a valley or a ridge is between them.
    distance = tile.image("distance") / 65535.0
    smooth = (distance > 0.1) & (distance < 0.35)
    slopes = normal[:, :, :2] / normal[:, :, 2:]
    # Rows count downwards, V counts upwards.
    for found, expected in ((slopes[:, :, 0], -rise_u), (slopes[:, :, 1], rise_v)):
        steep = smooth & (np.abs(expected) > 0.1)
        assert np.corrcoef(found[steep], expected[steep])[0, 1] > 0.97
        assert np.median(found[steep] / expected[steep]) == pytest.approx(1.0, abs=0.05)


def test_a_mirrored_map_mirrors_the_image_and_turns_normals(sheet: Mapped) -> None:
    mirrored = replace(sheet, uv=sheet.uv * [-1, 1] + [1, 0])
    style = Style(SIZE, 0)
    one, other = Tile(sheet, (0, 0), style), Tile(mirrored, (0, 0), style)
    for kind in ("distance", "height", "along", "side"):
        off = np.abs(one.image(kind).astype(float) - other.image(kind)[:, ::-1])
        assert (off < 70.0).mean() > 0.999
    a, b = one.image("normal").astype(float), other.image("normal")[:, ::-1].astype(float)
    b[:, :, 0] = 65535.0 - b[:, :, 0]
    assert (np.abs(a - b) < 70.0).mean() > 0.99


def test_sides_part_at_the_line_and_along_runs_from_0_to_1(sheet: Mapped) -> None:
    tile = Tile(sheet, (0, 0), Style(SIZE, 0))
    side = tile.image("side")
    # Pixels that the line parts are grey.
    assert np.isin(side, (0, 65535)).mean() > 0.85
    # Where the side changes from pixel to pixel, the line is between them.
    changes = (side[:, 1:] > 32767) != (side[:, :-1] > 32767)
    distance = tile.image("distance") / 65535.0
    near = np.minimum(distance[:, 1:], distance[:, :-1])[changes]
    assert (near < 1.5 / SIZE / SPACING).mean() > 0.95
    along = tile.image("along") / 65535.0
    assert along.min() < 0.01 and along.max() > 0.99
    assert np.histogram(along, 10, (0, 1))[0].min() > 0.05 * SIZE * SIZE


def test_islands_go_on_beyond_their_edges(sheet: Mapped) -> None:
    island = replace(sheet, uv=0.25 + 0.5 * sheet.uv)
    bare = Tile(island, (0, 0), Style(SIZE, 0)).face.reshape(SIZE, SIZE) >= 0
    assert bare.mean() == pytest.approx(0.25, abs=0.01)
    wide = Tile(island, (0, 0), Style(SIZE, 7))
    assert (wide.face >= 0).sum() == (0.5 * SIZE + 14) ** 2
    image = wide.image("distance")
    quarter = SIZE // 4
    inner = image[quarter, quarter : 3 * quarter]
    assert (np.abs(image[quarter - 7, quarter : 3 * quarter].astype(float) - inner) < 2500).all()
    assert (image[: quarter - 7] == 0).all()


def test_pixels_at_the_edge_of_an_island_are_the_mean_of_what_is_on_it(sheet: Mapped) -> None:
    """Against 64 places a pixel, of an island that lies askew; and the margin goes on from them."""
    size, turn = 120, 0.6 * np.array([[np.cos(0.4), np.sin(0.4)], [-np.sin(0.4), np.cos(0.4)]])
    island = replace(sheet, uv=(sheet.uv - 0.5) @ turn + 0.5)
    steps = (np.arange(8) + 0.5) / 8 - 0.5
    offsets = np.stack(np.meshgrid(steps, steps), axis=2).reshape(-1, 2) / size
    places = (centres(size).reshape(-1, 1, 2) + offsets - 0.5) @ np.linalg.inv(turn) + 0.5
    on = ((places >= 0.0) & (places <= 1.0)).all(axis=2)
    edge = np.flatnonzero(on.any(axis=1) & ~on.all(axis=1))
    far = true_distances(sheet, places[edge].reshape(-1, 2)).reshape(len(edge), 64) / SPACING
    far, weights = np.clip(far, 0.0, 1.0), on[edge] / on[edge].sum(axis=1, keepdims=True)
    tile = Tile(island, (0, 0), Style(size, 6))
    height = 1.0 - np.clip(1.0 - 2.0 * far, 0.0, 1.0) ** 2
    for kind, true in (("distance", far), ("height", height)):
        image = tile.values(kind).ravel()
        off = np.abs(image[edge] - (true * weights).sum(axis=1))
        # Those that the island only touches have a few places, and not the same ones.
        much = on[edge].mean(axis=1) > 0.25
        assert len(edge) > 250 and np.percentile(off[much], 95) < 0.02 and off.mean() < 0.02
        margin = (tile.face >= 0) & ~on.any(axis=1)
        assert margin.sum() > 1000
        assert np.isin(image[margin], image[on.any(axis=1)]).all()


def test_a_map_that_lies_on_itself_is_told(sheet: Mapped) -> None:
    assert Tile(sheet, (0, 0), Style(SIZE, 4)).overlap < 0.001
    folded = replace(sheet, uv=np.abs(sheet.uv - [0.5, 0.0]))
    assert Tile(folded, (0, 0), Style(SIZE, 4)).overlap > 0.9


def test_tiles_are_counted_as_udim_counts() -> None:
    corners = np.zeros((3, 3, 2)) + [[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]]
    mapped = Mapped(None, corners + np.array([[[0, 0]], [[1, 0]], [[0, 1]]]), 1.0)
    assert mapped.tiles() == [(0, 0), (0, 1), (1, 0)]
    path = Path("folder/line.png")
    assert image_files.file_of(path, "mask", (0, 0), False) == Path("folder/line_mask.png")
    assert image_files.file_of(path, "mask", (1, 2), True) == Path("folder/line_mask.1022.png")
    assert image_files.problem_of_tiles(mapped.tiles()) is None
    many = [(0, k) for k in range(101)]
    for wrong, word in (([], "no area"), ([(-1, 0)], "UDIM"), (many, "101")):
        assert word in image_files.problem_of_tiles(wrong)


def test_tiles_that_lie_beside_each_other_share_the_image(sheet: Mapped) -> None:
    moved = replace(sheet, uv=sheet.uv + [3, 1])
    assert moved.tiles() == [(3, 1)]
    one, other = (Tile(sheet, (0, 0), Style(64, 2)), Tile(moved, (3, 1), Style(64, 2)))
    assert (np.abs(one.image("height").astype(float) - other.image("height")) < 70.0).all()


def test_png_holds_what_was_put_in() -> None:
    """Read by hand: signature, chunks with their sums, rows that add up."""
    rng = np.random.default_rng(1)
    for shape in ((5, 7), (4, 6, 3)):
        image = rng.integers(0, 2**16, shape, dtype=np.uint16)
        data = png(image)
        assert data[:8] == b"\x89PNG\r\n\x1a\n"
        chunks, at = {}, 8
        while at < len(data):
            (length,) = struct.unpack(">I", data[at : at + 4])
            name, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
            (sum_of,) = struct.unpack(">I", data[at + 8 + length : at + 12 + length])
            assert sum_of == zlib.crc32(name + body)
            chunks[name], at = body, at + 12 + length
        width, height, depth, colour = struct.unpack(">IIBB", chunks[b"IHDR"][:10])
        assert (height, width, depth, colour) == (*shape[:2], 16, 2 if len(shape) == 3 else 0)
        raw = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, -1)
        assert (raw[:, 0] == 2).all()
        rows = np.cumsum(raw[:, 1:], axis=0, dtype=np.uint8)
        assert (rows.view(">u2").reshape(shape) == image).all()


def read_exr(data: bytes) -> dict[str, np.ndarray]:
    """The channels of a file, read by hand after the description of the layout."""
    assert data[:8] == bytes.fromhex("762f310102000000")
    attributes, at = {}, 8
    while data[at]:
        name, kind = data[at:].split(b"\0", 2)[:2]
        at += len(name) + len(kind) + 2
        (length,) = struct.unpack("<i", data[at : at + 4])
        attributes[name.decode()] = (kind.decode(), data[at + 4 : at + 4 + length])
        at += 4 + length
    at += 1
    assert attributes["compression"] == ("compression", b"\3")
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"][1])
    assert (left, top) == (0, 0) and attributes["displayWindow"] == attributes["dataWindow"]
    channels, rest = [], attributes["channels"][1]
    while rest[0]:
        name, rest = rest.split(b"\0", 1)
        assert struct.unpack("<i", rest[:4]) == (2,), "32-bit floats"
        channels.append(name.decode())
        rest = rest[16:]
    assert channels == sorted(channels)
    width, height = right + 1, bottom + 1
    blocks = -(-height // 16)
    lines = []
    for (offset,) in struct.iter_unpack("<Q", data[at : at + 8 * blocks]):
        first, size = struct.unpack("<ii", data[offset : offset + 8])
        count = min(16, height - first)
        raw, body = 4 * width * len(channels) * count, data[offset + 8 : offset + 8 + size]
        if size < raw:
            steps = np.frombuffer(zlib.decompress(body), np.uint8).astype(np.int64)
            steps[1:] -= 128
            halves = (np.cumsum(steps) % 256).astype(np.uint8)
            mixed = np.empty(raw, dtype=np.uint8)
            mixed[0::2], mixed[1::2] = halves[: (raw + 1) // 2], halves[(raw + 1) // 2 :]
            body = mixed.tobytes()
        assert len(body) == raw and len(lines) == first
        lines += list(np.frombuffer(body, "<f4").reshape(count, len(channels), width))
    assert len(lines) == height
    return {name: np.stack(lines)[:, k] for k, name in enumerate(channels)}


@pytest.mark.parametrize("shape", [(5, 7), (16, 3), (33, 20, 3), (40, 8)])
@pytest.mark.parametrize("noise", [False, True])
def test_exr_holds_what_was_put_in(shape: tuple[int, ...], noise: bool) -> None:
    rng = np.random.default_rng(2)
    image = np.linspace(0.0, 1.0, int(np.prod(shape)), dtype=np.float32).reshape(shape)
    if noise:  # which is no shorter compressed
        image = rng.integers(0, 2**31 - 2**25, shape).astype(np.uint32).view(np.float32)
    data = exr(image)
    found = read_exr(data)
    planes = {"Y": image} if image.ndim == 2 else {n: image[:, :, k] for k, n in enumerate("RGB")}
    assert found.keys() == planes.keys()
    assert all(np.array_equal(found[name], plane) for name, plane in planes.items())


def test_exr_has_what_png_rounds(sheet: Mapped) -> None:
    tile = Tile(sheet, (0, 0), Style(SIZE, 0))
    exact = read_exr(tile.file("distance", ".exr"))["Y"]
    assert np.abs(exact - tile.image("distance") / 65535.0).max() < 0.51 / 65535.0
    assert len(np.unique(exact)) > 1.5 * len(np.unique(tile.image("distance")))
    normal = read_exr(tile.file("normal", ".exr"))
    assert np.abs(normal["B"] - tile.image("normal")[:, :, 2] / 65535.0).max() < 0.51 / 65535.0
    assert tile.file("mask", ".png")[:4] == b"\x89PNG"


def _parted(along: np.ndarray) -> np.ndarray:
    """Pixels beside others of another turn, which may be a mean of both."""
    parted = np.zeros(along.shape, dtype=bool)
    for axis in (0, 1):
        jumps = np.abs(np.diff(along, axis=axis)) > 0.01
        parted |= np.concatenate((jumps, np.zeros_like(jumps).take([0], axis)), axis)
        parted |= np.concatenate((np.zeros_like(jumps).take([0], axis), jumps), axis)
    return parted


def test_colours_follow_the_ramp_along_the_line(sheet: Mapped) -> None:
    assert sheet.cut.closed.all()
    ramp = np.array([[0.0, 0.1, 0.9], [0.5, 0.1, 0.0], [1.0, 1.0, 0.0]])
    tile = Tile(sheet, (0, 0), Style(SIZE, 0, ramp=ramp))
    colour, along = tile.values("color"), tile.values("along").astype(float)
    # There and back, since the line is closed: the first quarter leads to the middle of the ramp.
    for share, wanted in ((0.02, [0.04, 0.1, 0.9 * 0.92]), (0.25, ramp[1]), (0.5, ramp[2]),
                          (0.75, ramp[1])):  # fmt: skip
        there = (np.abs(along - share) < 0.002) & ~_parted(along)
        assert there.sum() > 20
        assert np.abs(colour[there] - wanted).max() < 0.02
    # As screens have it: half of the light is three quarters of the number.
    there = np.abs(along - 0.25) < 0.002
    png = tile.image("color")[there] / 65535.0
    assert np.median(png[:, 0]) == pytest.approx(0.7354, abs=0.004)
    assert np.median(png[:, 1]) == pytest.approx(0.3492, abs=0.001)


def test_colours_of_an_open_line_end_where_it_ends(sheet: Mapped) -> None:
    opened = replace(sheet, cut=replace(sheet.cut, closed=np.zeros_like(sheet.cut.closed)))
    tile = Tile(opened, (0, 0), Style(SIZE, 0))
    colour, along = tile.values("color"), tile.values("along")
    for share, colours in ((0.0, maps.RAMP[0][1]), (1.0, maps.RAMP[-1][1])):
        there = np.abs(along - share) < 0.004
        assert there.sum() > 5 and np.abs(colour[there] - colours).max() < 0.005
