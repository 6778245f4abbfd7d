# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of a result by a UV map of its surface, read back by Blender."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from mathutils.interpolate import poly_3d_calc
from test_batch_scene import run_batch

SPACING, SIZE = 0.5, 128


def ball() -> bpy.types.Object:
    surface = scenes.sphere()
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
        turns = [np.cross(end - start, p - start) for start, end in edges]
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
    assert len(list(tmp_path.iterdir())) == 6
    assert pixels(tmp_path / "a_normal.png").shape == (64, 64, 4)
    normal = pixels(tmp_path / "a_normal.png")[:, :, :3] * 2.0 - 1.0
    lengths = np.linalg.norm(normal, axis=2)
    assert lengths[lengths < 1.5] == pytest.approx(1.0, abs=0.02)


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


def test_the_batch_command_writes_images(tmp_path: Path) -> None:
    surface = scenes.sphere()
    surface.name = "Ball"
    path = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
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
    refused = run_batch(*given, "--maps", tmp_path / "n.png", "--map-uv", "Nowhere")
    assert refused.returncode == 2 and "--maps is not possible here" in refused.stderr
    assert not list(tmp_path.glob("n*"))
