# SPDX-License-Identifier: GPL-3.0-or-later
"""The lamps and the world of a scene, as numbers."""

from __future__ import annotations

import math

import bpy
import numpy as np

from ..model.density import luminance
from ..model.lighting import Lamp


def lamps_of(view_layer: bpy.types.ViewLayer, depsgraph: bpy.types.Depsgraph) -> list[Lamp]:
    """The lamps that are rendered, those of instances too. Nodes of lamps are not looked at."""
    shown = {thing for thing in view_layer.objects if not thing.hide_render}
    found = []
    for instance in depsgraph.object_instances:
        lamp = instance.object
        owner = instance.parent.original if instance.is_instance else lamp.original
        if lamp.type == "LIGHT" and owner in shown:
            found.append(_lamp(lamp.data, np.array(instance.matrix_world, dtype=np.float64)))
    return found


def _lamp(data: bpy.types.Light, matrix: np.ndarray) -> Lamp:
    # A lamp shines along its -z.
    x, y, z = (column / (np.linalg.norm(column) or 1.0) for column in matrix[:3, :3].T)
    power = float(luminance(np.array(data.color))) * data.energy
    power *= 2.0 ** getattr(data, "exposure", 0.0)  # from Blender 4.4 on
    given = {"kind": data.type.lower(), "power": power, "place": matrix[:3, 3], "direction": -z}
    given["casts"] = data.use_shadow
    if data.type == "SPOT":
        given |= {"cosine": math.cos(data.spot_size / 2.0), "blend": data.spot_blend}
    elif data.type == "AREA":
        width = data.size
        height = data.size_y if data.shape in ("RECTANGLE", "ELLIPSE") else data.size
        scale = np.linalg.norm(matrix[:3, :2], axis=0)
        given["sides"] = 0.5 * np.array([x * width * scale[0], y * height * scale[1]])
    return Lamp(**given)


def ambient_of(world: bpy.types.World | None) -> float:
    """The light of a world of one colour. Where an image or nodes make the colour, that of the
    socket that they go into counts."""
    if world is None:
        return 0.0
    nodes = world.node_tree.nodes if world.use_nodes and world.node_tree is not None else ()
    for node in nodes:
        if node.type == "BACKGROUND":
            color = np.array(node.inputs["Color"].default_value)
            return float(luminance(color)) * node.inputs["Strength"].default_value
    return float(luminance(np.array(world.color)))
