# SPDX-License-Identifier: GPL-3.0-or-later
"""What cannot be filled: one sentence, nothing changed."""

from __future__ import annotations

import math

import bpy
import pytest
from scenes import activate, circle_points, cube, grid, mesh_object, poly_curve, refused, sphere

SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]


def no_faces() -> bpy.types.Object:
    return mesh_object("Points", SQUARE, [])


def not_a_number() -> bpy.types.Object:
    return mesh_object("Nan", [*SQUARE[:3], (0, math.nan, 0)], [(0, 1, 2), (0, 2, 3)])


def moebius() -> bpy.types.Object:
    count = 12
    vertices = []
    for i in range(count):
        angle = 2.0 * math.pi * i / count
        for side in (-0.3, 0.3):
            width = 1.0 + side * math.cos(angle / 2.0)
            vertices.append(
                (width * math.cos(angle), width * math.sin(angle), side * math.sin(angle / 2.0))
            )
    faces = [(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2) for i in range(count - 1)]
    faces.append((2 * count - 2, 2 * count - 1, 0, 1))
    return mesh_object("Moebius", vertices, faces)


@pytest.mark.parametrize(
    ("build", "word"),
    [
        (no_faces, "no faces"),
        (not_a_number, "1 vertex without a position"),
        (moebius, "only one side"),
    ],
)
def test_meshes_that_cannot_be_filled(build, word):
    assert word in refused(build(), strict=True).lower()


@pytest.mark.parametrize("value", [math.nan, -math.nan])
def test_a_scale_that_is_not_a_number_is_called_so(value):
    surface = cube()
    surface.scale.y = value
    bpy.context.view_layer.update()
    said = refused(surface)
    assert "not a finite number" in said and "scaled to nothing" not in said


@pytest.mark.parametrize("kind", ["none", "a lamp", "an empty"])
def test_a_collection_without_meshes_is_called_so(kind):
    collection = bpy.data.collections.new("Shown")
    if kind != "none":
        data = bpy.data.lights.new("Lamp", "POINT") if kind == "a lamp" else None
        collection.objects.link(bpy.data.objects.new("Thing", data))
    shown = bpy.data.objects.new("Shown", None)
    shown.instance_type, shown.instance_collection = "COLLECTION", collection
    bpy.context.scene.collection.objects.link(shown)
    said = refused(activate(shown))
    assert "'Shown' shows a collection without meshes; link some" in said
    assert "Error: Object" not in said


def test_a_spacing_larger_than_the_surface():
    assert "spacing" in refused(cube(), spacing=100.0).lower()


@pytest.mark.parametrize(
    ("strand", "cyclic", "word"),
    [
        (circle_points(1.0, 9.0), True, "surface"),  # in the air
        ([(-0.5, -0.5, 0), (0.5, 0.5, 0), (0.5, -0.5, 0), (-0.5, 0.5, 0)], True, "cross"),
        ([(0, 0, 0)], False, "points"),
    ],
)
def test_seeds_that_cannot_be_used(strand, cyclic, word):
    surface = grid()
    assert word in refused(surface, seed=poly_curve("Seed", [strand], cyclic)).lower()


def test_a_surface_scaled_to_nothing():
    surface = sphere()
    surface.scale.x = 0.0
    assert "scale" in refused(surface)


def test_a_result_without_its_surface():
    surface = sphere()
    curve = poly_curve("Result", [circle_points(0.5, 0.86)], True)
    curve.meander.surface = surface
    for collection in surface.users_collection:
        collection.objects.unlink(surface)
    assert "not in this scene" in refused(curve)


def test_poll_asks_for_a_mesh():
    assert not bpy.ops.meander.run.poll()
    assert not bpy.ops.meander.propose_spacing.poll()
    assert not bpy.ops.meander.stop.poll()
