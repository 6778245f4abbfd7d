# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions of the batch command from the objects of a scene."""

from __future__ import annotations

import json

import bpy
import numpy as np
import pytest
from meander import batch
from meander.model.files import obj
from scenes import grid


@pytest.fixture
def run(tmp_path, capsys):
    """Saves the scene and runs the command on its object: exit code, standard error, curve."""

    def call(*extra: str):
        scene = tmp_path / "scene.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(scene))
        output, record = tmp_path / "out.obj", tmp_path / "out.json"
        code = batch.main(
            [
                *("--input", str(scene), "--output", str(output), "--report", str(record)),
                *("--spacing", "0.15", "--iterations", "150", "--quiet", *extra),
            ]
        )
        errors = capsys.readouterr().err
        if code:
            return code, errors, None, None
        return code, errors, obj.read_obj_curve(output), json.loads(record.read_text())

    return call


def add_vectors(thing: bpy.types.Object, name: str, vector) -> None:
    attribute = thing.data.attributes.new(name, "FLOAT_VECTOR", "POINT")
    attribute.data.foreach_set("vector", np.tile(vector, len(thing.data.vertices)))


def share_along(curve, direction) -> float:
    chord = np.diff(curve.points, axis=0)
    length = np.linalg.norm(chord, axis=1)
    return length[np.abs(chord @ np.array(direction)) > 0.95 * length].sum() / length.sum()


def test_an_attribute_turns_with_its_object(run):
    thing = grid()
    thing.rotation_euler.z = np.pi / 2
    add_vectors(thing, "Flow", (1.0, 0.0, 0.0))
    _, _, curve, record = run("--direction", "Flow", "--alignment", "2")
    assert record["options"]["direction"] == "Flow"
    assert share_along(curve, (0, 1, 0)) > 4 * share_along(curve, (1, 0, 0))


def test_an_axis_is_the_objects_own(run):
    thing = grid()
    thing.rotation_euler.z = np.pi / 2
    _, _, curve, _ = run("--direction", "x", "--alignment", "2")
    assert share_along(curve, (0, 1, 0)) > 4 * share_along(curve, (1, 0, 0))


def test_what_is_no_direction_is_refused(run):
    thing = grid()
    thing.data.attributes.new("Height", "FLOAT", "POINT")
    for name in ("Nothing", "Height"):
        code, errors, *_ = run("--direction", name)
        assert code == 2
        assert repr(name) in errors
