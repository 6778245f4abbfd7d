# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of a result by a UV map of its surface, read back by Blender."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from mathutils.interpolate import poly_3d_calc
from meander.model import maps
from meander.scene import look

SPACING, SIZE = 0.5, 128


def ball(subdivisions: int = 3) -> bpy.types.Object:
    surface = scenes.sphere(subdivisions=subdivisions)
    surface.meander.spacing = SPACING
    bpy.ops.meander.run()
    result = surface.meander.last_result
    bpy.context.view_layer.objects.active = result
    return result


def pixels(path: Path) -> np.ndarray:
    """(rows, columns, 4), the first row at the bottom, as Blender has them."""
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    assert image.is_float or image.depth >= 16
    values = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)


def place_of(surface: bpy.types.Object, uv: np.ndarray) -> np.ndarray | None:
    """Where a place of the map lies on the surface, by trying every triangle."""
    mesh = surface.data
    mesh.calc_loop_triangles()
    layer = mesh.uv_layers.active.data
    for triangle in mesh.loop_triangles:
        corners = [(*layer[loop].uv, 0.0) for loop in triangle.loops]
        weights = np.array(poly_3d_calc(corners, (*uv, 0.0)))
        (a, b, c), p = np.array(corners)[:, :2], uv
        edges = ((a, b), (b, c), (c, a))
        # The determinants of what NumPy 2 takes for a cross product in space only.
        turns = [np.linalg.det([end - start, p - start]) for start, end in edges]
        if min(turns) >= 0.0 or max(turns) <= 0.0:
            points = np.array([mesh.vertices[v].co for v in triangle.vertices])
            return weights @ points
    return None


def test_images_show_the_curve_where_it_is(tmp_path: Path) -> None:
    result = ball()
    surface = result.meander.surface
    assert bpy.ops.meander.maps(
        filepath=str(tmp_path / "line.png"), size=SIZE, kinds={"DISTANCE", "MASK"}, margin=2
    ) == {"FINISHED"}
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "line_distance.png",
        "line_mask.png",
    ]
    distance = pixels(tmp_path / "line_distance.png")[:, :, 0]
    points = np.array([point.co[:3] for spline in result.data.splines for point in spline.points])
    rng = np.random.default_rng(3)
    tried = 0
    for row, column in rng.integers(0, SIZE, (60, 2)):
        uv = (np.array([column, row]) + 0.5) / SIZE
        place = place_of(surface, uv)
        if place is None:
            continue
        tried += 1
        nearest = np.linalg.norm(points - place, axis=1).min()
        if nearest < 0.8 * SPACING:
            assert distance[row, column] == pytest.approx(nearest / SPACING, abs=0.12)
    assert tried > 20


def test_all_kinds_are_written_and_a_second_time_replaced(tmp_path: Path) -> None:
    ball()
    for size in (32, 64):
        assert bpy.ops.meander.maps(filepath=str(tmp_path / "a.png"), size=size) == {"FINISHED"}
    assert len(list(tmp_path.iterdir())) == len(maps.KINDS)
    assert pixels(tmp_path / "a_normal.png").shape == (64, 64, 4)
    normal = pixels(tmp_path / "a_normal.png")[:, :, :3] * 2.0 - 1.0
    lengths = np.linalg.norm(normal, axis=2)
    assert lengths[lengths < 1.5] == pytest.approx(1.0, abs=0.02)


def test_exr_files_hold_the_same_in_floats(tmp_path: Path) -> None:
    ball()
    for name in ("a.png", "a.exr"):
        assert bpy.ops.meander.maps(filepath=str(tmp_path / name), size=64) == {"FINISHED"}
    assert len(list(tmp_path.iterdir())) == 2 * len(maps.KINDS)
    for kind in maps.KINDS:
        exact, rounded = (pixels(tmp_path / f"a_{kind}{end}") for end in (".exr", ".png"))
        assert exact.shape == rounded.shape == (64, 64, 4)
        if kind == "color":
            low = exact[:, :, :3] <= 0.0031308
            exact = np.where(
                low, 12.92 * exact[:, :, :3], 1.055 * exact[:, :, :3] ** (1.0 / 2.4) - 0.055
            )
        assert np.abs(exact[:, :, :3] - rounded[:, :, :3]).max() < 2e-5, kind
    image = bpy.data.images.load(str(tmp_path / "a_distance.exr"))
    assert image.is_float and image.colorspace_settings.name.startswith("Linear")


def test_the_format_is_chosen_or_the_names(tmp_path: Path) -> None:
    ball()
    for name, given, wanted in (
        ("a.exr", {}, "a_side.exr"),
        ("b", {}, "b_side.png"),
        ("c.v2", {"file_format": "EXR"}, "c.v2_side.exr"),
        ("d.png", {"file_format": "EXR"}, "d_side.exr"),
    ):
        bpy.ops.meander.maps(filepath=str(tmp_path / name), size=16, kinds={"SIDE"}, **given)
        assert [path.name for path in tmp_path.iterdir()] == [wanted]
        (tmp_path / wanted).unlink()


def test_colours_are_those_of_the_look(tmp_path: Path) -> None:
    result = ball(4)
    assert len(result.data.splines) == 1 and result.data.splines[0].use_cyclic_u
    # What a new curve begins with is what the command has without asking Blender.
    stops = zip(*maps.RAMP, strict=True)
    places, colours = next(stops), np.array(next(stops))
    begun = look.ramp_colours(result)
    shares = np.linspace(0.0, 1.0, len(begun))
    expected = np.stack([np.interp(shares, places, colours[:, k]) for k in range(3)], axis=1)
    assert begun == pytest.approx(expected, abs=1e-4)
    ramp = look.ramp_node_of(look.material_of(result)).color_ramp
    for element, colour in zip(ramp.elements, ((0, 0, 1, 1), (0, 1, 0, 1), (1, 0, 0, 1))):
        element.color = colour
    bpy.ops.meander.maps(
        filepath=str(tmp_path / "a.exr"), size=SIZE, kinds={"COLOR", "ALONG"}, margin=0
    )
    along = pixels(tmp_path / "a_along.exr")[:, :, 0]
    colour = pixels(tmp_path / "a_color.exr")[:, :, :3]
    # Where two turns meet, pixels are the mean of both.
    jumps = np.pad(np.abs(along[1:-1, 2:] - along[1:-1, :-2]), 1, constant_values=1.0)
    jumps[1:-1, 1:-1] += np.abs(along[2:, 1:-1] - along[:-2, 1:-1])
    drawn = (colour.max(axis=2) > 0.0) & (jumps < 0.01)
    assert drawn.mean() > 0.1
    back = 1.0 - np.abs(2.0 * along - 1.0)  # 0 where it begins and ends, 1 halfway round
    red, blue = np.clip(2.0 * back - 1.0, 0.0, 1.0), np.clip(1.0 - 2.0 * back, 0.0, 1.0)
    wanted = np.stack([red, 1.0 - red - blue, blue], axis=2)
    assert np.abs(colour - wanted)[drawn].max() < 0.01
    # A material without a ramp leaves the colours that a new curve begins with.
    result.data.materials.clear()
    result.data.materials.append(bpy.data.materials.new("Plain"))
    bpy.context.view_layer.update()
    assert look.ramp_colours(result) is None
    bpy.ops.meander.maps(filepath=str(tmp_path / "b.exr"), size=SIZE, kinds={"COLOR"}, margin=0)
    plain = pixels(tmp_path / "b_color.exr")[:, :, :3][drawn]
    assert plain.min(axis=0) == pytest.approx(np.min(expected, axis=0), abs=0.01)


@pytest.mark.parametrize(
    ("how", "sentence"),
    [
        ("no map", "has no UV map"),
        ("no area", "has no area"),
        ("beyond", "leaves the squares"),
        ("no kinds", "No image is chosen"),
        ("no name", "No file is named"),
        ("no folder", "cannot be written"),
    ],
)
def test_what_cannot_be_drawn_is_said(tmp_path: Path, how: str, sentence: str) -> None:
    result = ball()
    mesh = result.meander.surface.data
    given = {"filepath": str(tmp_path / "a.png"), "size": 32}
    if how == "no map":
        while mesh.uv_layers:
            mesh.uv_layers.remove(mesh.uv_layers[0])
        mesh.update_tag()
    elif how in ("no area", "beyond"):
        for corner in mesh.uv_layers.active.data:
            corner.uv = (0.3, 0.3) if how == "no area" else (corner.uv[0] - 5.0, corner.uv[1])
    elif how == "no kinds":
        given["kinds"] = set()
    elif how == "no name":
        given["filepath"] = ""
    else:
        given["filepath"] = str(tmp_path / "none" / "a.png")
    with pytest.raises(RuntimeError, match=sentence):
        bpy.ops.meander.maps(**given)
    assert not list(tmp_path.iterdir())


def test_a_map_that_lies_on_itself_is_told(tmp_path: Path, capfd: pytest.CaptureFixture) -> None:
    result = ball()
    for corner in result.meander.surface.data.uv_layers.active.data:
        corner.uv = (abs(corner.uv[0] - 0.5), corner.uv[1])
    assert bpy.ops.meander.maps(filepath=str(tmp_path / "a.png"), size=32) == {"FINISHED"}
    assert "The UV map lies on itself" in capfd.readouterr().out


@pytest.mark.parametrize("name", ["m_mask.png", "m_mask.1001.png", "m_height.PNG"])
def test_an_image_that_a_run_is_made_from_is_not_written_over(
    name: str, tmp_path: Path, run_batch
) -> None:
    surface = scenes.sphere()
    surface.name = "Ball"
    image = bpy.data.images.new("Grey", 8, 8)
    image.use_fake_user = True
    image.filepath_raw, image.file_format = str(tmp_path / name), "PNG"
    image.save()
    image.source = "FILE"
    path = scenes.saved(tmp_path / "scene.blend")
    before = (tmp_path / name).read_bytes()
    given = ("--input", path, "--object", "Ball", "--spacing", SPACING, "--iterations", 1)
    given += ("--output", tmp_path / "curve.obj", "--maps", tmp_path / "m.png", "--map-size", 32)
    refused = run_batch(*given, "--density-image", "Grey")
    assert refused.returncode == 2, refused.stderr
    assert "would overwrite" in refused.stderr and name in refused.stderr
    assert (tmp_path / name).read_bytes() == before and not (tmp_path / "curve.obj").exists()
    # One that only a material shows is made again.
    assert run_batch(*given, "--map-kinds", "mask").returncode == 0


def test_the_batch_command_writes_images(tmp_path: Path, run_batch) -> None:
    surface = scenes.sphere()
    surface.name = "Ball"
    path = scenes.saved(tmp_path / "scene.blend")
    given = ("--input", path, "--object", "Ball", "--spacing", SPACING, "--iterations", 30)
    given += ("--output", tmp_path / "curve.obj")
    done = run_batch(
        *given, "--maps", tmp_path / "m.png", "--map-kinds", "along,mask", "--map-size", 64
    )
    assert done.returncode == 0, done.stderr
    names = sorted(found.name for found in tmp_path.glob("m*"))
    assert names == ["m_along.png", "m_mask.png"]
    assert all(f"wrote {tmp_path / name}" in done.stdout for name in names)
    assert pixels(tmp_path / "m_mask.png").shape == (64, 64, 4)
    done = run_batch(
        *given, "--maps", tmp_path / "e.exr", "--map-kinds", "color,mask", "--map-size", 64
    )
    assert done.returncode == 0, done.stderr
    exact = pixels(tmp_path / "e_mask.exr")
    assert np.abs(exact - pixels(tmp_path / "m_mask.png"))[:, :, :3].max() < 2e-5
    assert pixels(tmp_path / "e_color.exr")[:, :, 0].max() == pytest.approx(0.42, abs=0.02)
    refused = run_batch(*given, "--maps", tmp_path / "n.png", "--map-uv", "Nowhere")
    assert refused.returncode == 2 and "--maps is not possible here" in refused.stderr
    assert not list(tmp_path.glob("n*"))
