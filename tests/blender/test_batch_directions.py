# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions of the batch command from the objects of a scene."""

from __future__ import annotations

import bpy
import numpy as np
from scenes import grid


def add_vectors(thing: bpy.types.Object, name: str, vector) -> None:
    attribute = thing.data.attributes.new(name, "FLOAT_VECTOR", "POINT")
    attribute.data.foreach_set("vector", np.tile(vector, len(thing.data.vertices)))


def share_along(curve, direction) -> float:
    chord = np.diff(curve.points, axis=0)
    length = np.linalg.norm(chord, axis=1)
    return length[np.abs(chord @ np.array(direction)) > 0.95 * length].sum() / length.sum()


def test_an_attribute_turns_with_its_object(run_command):
    thing = grid()
    thing.rotation_euler.z = np.pi / 2
    add_vectors(thing, "Flow", (1.0, 0.0, 0.0))
    _, _, curve, record = run_command("--direction", "Flow", "--alignment", "2")
    assert record["options"]["direction"] == "Flow"
    assert share_along(curve, (0, 1, 0)) > 4 * share_along(curve, (1, 0, 0))


def test_an_axis_is_the_objects_own(run_command):
    thing = grid()
    thing.rotation_euler.z = np.pi / 2
    _, _, curve, _ = run_command("--direction", "x", "--alignment", "2")
    assert share_along(curve, (0, 1, 0)) > 4 * share_along(curve, (1, 0, 0))


def test_what_is_no_direction_is_refused(run_command):
    thing = grid()
    thing.data.attributes.new("Height", "FLOAT", "POINT")
    for name in ("Nothing", "Height"):
        code, errors, *_ = run_command("--direction", name)
        assert code == 2
        assert repr(name) in errors
