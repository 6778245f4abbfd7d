# SPDX-License-Identifier: GPL-3.0-or-later
"""A direction turned by what is painted: curves and fields against those worked out by hand."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from meander import batch, core
from meander.model.alignment import Alignment
from meander.scene import alignment as scene_alignment
from scenes import fill, grid, points_of, refused, saved, world_triangles


def places(thing: bpy.types.Object) -> np.ndarray:
    return np.array([vertex.co[:] for vertex in thing.data.vertices])


def paint(thing: bpy.types.Object, kind: str, degrees: np.ndarray) -> None:
    """Makes "Angle" of a kind on a grid with a corner at (-1, -1)."""
    count = len(thing.data.vertices)
    if kind == "GROUP":
        group = thing.vertex_groups.new(name="Angle")
        for vertex, value in enumerate(degrees):
            group.add([vertex], value / 180.0, "REPLACE")
    elif kind == "ATTRIBUTE":
        attribute = thing.data.attributes.new("Angle", "FLOAT", "POINT")
        attribute.data.foreach_set("value", degrees.astype(np.float32))
    elif kind == "COLOR":
        attribute = thing.data.attributes.new("Angle", "FLOAT_COLOR", "POINT")
        colors = np.ones((count, 4), dtype=np.float32)
        colors[:, :3] = degrees[:, None] / 180.0
        attribute.data.foreach_set("color", colors.ravel())
    else:
        image = bpy.data.images.new("Angle", 64, 64, float_buffer=True, is_data=True)
        across = (np.arange(64) + 0.5) / 32.0 - 1.0
        order = np.argsort(places(thing)[:, 0], kind="stable")
        row = np.interp(across, places(thing)[order, 0], degrees[order]) / 180.0
        pixels = np.ones((64, 64, 4), dtype=np.float32)
        pixels[:, :, :3] = row[None, :, None]
        image.pixels.foreach_set(pixels.ravel())
        image.pack()
        image.use_fake_user = True  # an image that nothing uses is not saved


def field(thing: bpy.types.Object, alignment: Alignment) -> np.ndarray:
    depsgraph = bpy.context.evaluated_depsgraph_get()
    found = scene_alignment.directions_of(alignment, thing, depsgraph, 0.1)
    with core.Surface(*world_triangles(thing)) as surface:
        return found(surface) if callable(found) else found


def share_along(points: np.ndarray, axis: int) -> float:
    chord = np.diff(points, axis=0)
    length = np.linalg.norm(chord, axis=1)
    return length[np.abs(chord[:, axis]) > 0.95 * length].sum() / length.sum()


@pytest.mark.parametrize("kind", ["GROUP", "ATTRIBUTE", "COLOR", "IMAGE"])
def test_a_field_turns_by_what_is_painted(kind: str):
    thing = grid(cells=8)
    degrees = 90.0 + 60.0 * places(thing)[:, 0]
    paint(thing, kind, degrees)
    found = field(thing, Alignment("AXIS", choice="X", angle_source=kind, angle_name="Angle"))
    wanted = np.column_stack([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    # A picture is read at pixels of its own; at the rim it repeats.
    inside = np.abs(places(thing)[:, 0]) < 0.9
    within = 0.05 if kind == "IMAGE" else 1e-4
    assert np.abs((found[:, :2] * wanted).sum(axis=1))[inside].min() > np.cos(within)


def test_curvature_turns_too():
    thing = grid(cells=8)
    thing.rotation_euler.x = 0.4
    bpy.context.view_layer.update()
    paint(thing, "ATTRIBUTE", np.full(len(thing.data.vertices), 90.0))
    plain = field(thing, Alignment("SMOOTH"))
    found = field(thing, Alignment("SMOOTH", angle_source="ATTRIBUTE", angle_name="Angle"))
    assert np.abs((plain * found).sum(axis=1)).max() < 1e-6


def test_a_constant_right_angle_on_x_is_y():
    curves = {}
    for name, axis in (("turned", "X"), ("plain", "Y")):
        thing = grid()
        if name == "turned":
            paint(thing, "GROUP", np.full(len(thing.data.vertices), 90.0))
            thing.meander.alignment_angle, thing.meander.alignment_angle_group = "GROUP", "Angle"
        result = fill(
            thing, 0.15, alignment_source="AXIS", alignment_axis=axis, alignment_weight=4.0
        )
        curves[name] = points_of(result)
    shares = {name: share_along(points, 1) for name, points in curves.items()}
    assert shares["plain"] > 0.6
    assert shares["turned"] == pytest.approx(shares["plain"], abs=0.1)
    assert share_along(curves["turned"], 0) < 0.5 * shares["turned"]


@pytest.mark.parametrize("kind", ["GROUP", "COLOR", "IMAGE"])
def test_halves_have_directions_of_their_own(run_command, kind: str):
    thing = grid()
    paint(thing, kind, np.where(places(thing)[:, 0] > 0.0, 90.0, 0.0))
    words = ("--direction", "x", "--alignment", "4", "--start", "full")
    _, _, curve, record = run_command(*words, "--direction-angle", "Angle")
    points = curve.points
    assert record["options"]["direction_angle"] == "Angle"
    left, right = points[points[:, 0] < -0.15], points[points[:, 0] > 0.15]
    assert share_along(left, 0) > 2 * share_along(left, 1)
    assert share_along(right, 1) > 2 * share_along(right, 0)


def test_the_result_in_a_blend_knows_the_angle(run_command, tmp_path):
    thing = grid()
    paint(thing, "GROUP", np.full(len(thing.data.vertices), 45.0))
    scene = saved(tmp_path / "in.blend")
    given = ["--input", scene, "--output", tmp_path / "out.blend", "--spacing", "0.3", "--quiet"]
    given += ["--direction", "x", "--direction-angle", "Angle", "--iterations", "5"]
    assert batch.main([str(a) for a in given]) == 0
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    made = next(thing for thing in bpy.data.objects if thing.type == "CURVE").meander
    assert (made.alignment_angle, made.alignment_angle_group) == ("GROUP", "Angle")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--direction-angle", "Angle"), "turns a field"),
        (("--direction", "x", "--direction-angle", "None"), "attribute of numbers or color"),
    ],
)
def test_what_cannot_turn_is_refused(run_command, words, said):
    grid()
    code, errors, _, _ = run_command(*words)
    assert code == 2 and said in errors


def test_the_panel_refuses_what_is_missing():
    thing = grid()
    said = "The angle has no"
    for source in ("GROUP", "ATTRIBUTE", "COLOR", "IMAGE"):
        assert said in refused(thing, alignment_source="AXIS", alignment_angle=source)
    paint(thing, "ATTRIBUTE", np.full(len(thing.data.vertices), np.nan))
    sentence = refused(
        thing, alignment_angle="ATTRIBUTE", alignment_angle_attribute="Angle"
    )
    assert "'Angle' is not a finite number at vertex 0" in sentence
