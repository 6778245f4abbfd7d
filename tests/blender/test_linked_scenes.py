# SPDX-License-Identifier: GPL-3.0-or-later
"""What scenes link from other files: filled again and again into one curve, with settings that are
saved, and where Blender shows it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np
import pytest
from meander.scene.linked_settings import settings_of, settings_to_change
from meander.scene.results import last_result
from scenes import activate, grid, sphere, world_splines
from test_scenes_brought import (
    a_bevelled_curve,
    arrayed,
    moved_off_by_its_parent,
    of_a_shape_key,
    shown,
    subdivided,
)

SPACING = 0.3


def a_text() -> bpy.types.Object:
    data = bpy.data.curves.new("Word", "FONT")
    data.body, data.extrude, data.size = "O", 0.2, 3.0
    thing = bpy.data.objects.new("Word", data)
    bpy.context.scene.collection.objects.link(thing)
    return activate(thing)


def object_of(path: Path, name: str) -> bpy.types.Object:
    with bpy.data.libraries.load(str(path), link=True) as (_there, here):
        here.objects = [name]
    thing = next(one for one in bpy.data.objects if one.name == name and one.library is not None)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def overridden(path: Path, name: str) -> bpy.types.Object:
    return object_of(path, name).override_create(remap_local_usages=True)


def in_a_collection(path: Path, name: str) -> bpy.types.Object:
    with bpy.data.libraries.load(str(path), link=True) as (_there, here):
        here.collections = ["Given"]
    given = next(one for one in bpy.data.collections if one.library is not None)
    bpy.context.scene.collection.children.link(given)
    return given.objects[name]


def its_data_alone(path: Path, name: str) -> bpy.types.Object:
    with bpy.data.libraries.load(str(path), link=True) as (_there, here):
        here.meshes = list(_there.meshes)
    thing = bpy.data.objects.new(name, bpy.data.meshes[0])
    bpy.context.scene.collection.objects.link(thing)
    return thing


def beside_one_of_the_same_name(path: Path, name: str) -> bpy.types.Object:
    other = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    bpy.context.scene.collection.objects.link(other)
    return object_of(path, name)


LINKED = (
    (arrayed, object_of), (of_a_shape_key, object_of), (moved_off_by_its_parent, object_of),
    (a_bevelled_curve, object_of), (a_text, object_of), (subdivided, overridden),
    (sphere, in_a_collection), (grid, its_data_alone), (grid, beside_one_of_the_same_name),
)  # fmt: skip


@pytest.mark.parametrize(
    ("build", "link"), LINKED, ids=lambda part: part.__name__ if callable(part) else ""
)
def test_what_is_linked_is_filled_as_what_is_not(
    tmp_path: Path,
    build: Callable[[], bpy.types.Object],
    link: Callable[[Path, str], bpy.types.Object],
) -> None:
    thing = build()
    thing.name = "Given"
    given = bpy.data.collections.new("Given")
    given.objects.link(thing)
    library = tmp_path / "library.blend"
    bpy.data.libraries.write(str(library), {given, thing})
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    thing = activate(link(library, "Given"))
    settings = settings_to_change(thing)
    settings.spacing, settings.iteration_limit = SPACING, 25
    for _ in range(2):
        activate(thing)
        assert bpy.ops.meander.run() == {"FINISHED"}
    made = [one for one in bpy.context.scene.objects if one.meander.surface == thing]
    assert made == [last_result(thing, bpy.context.scene)]
    result = made[0]
    tree, _area, points = shown(thing)
    size = max(float(np.ptp(points, axis=0).max()), float(np.abs(points).max()))
    for way, _cyclic in world_splines(result):
        away = [tree.find_nearest(place)[3] for place in way[:: max(1, len(way) // 200)]]
        assert max(away) < 1e-4 * size
    name, work = result.name, str(tmp_path / "work.blend")
    before = [len(spline.points) for spline in result.data.splines]
    bpy.ops.wm.save_as_mainfile(filepath=work, check_existing=False)
    bpy.ops.wm.open_mainfile(filepath=work)
    result = bpy.data.objects[name]
    thing = result.meander.surface
    assert settings_of(thing).spacing == pytest.approx(SPACING)
    activate(thing)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert last_result(thing, bpy.context.scene) == result
    assert [len(spline.points) for spline in result.data.splines] == before
