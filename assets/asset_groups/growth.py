# SPDX-License-Identifier: GPL-3.0-or-later
"""The node group "Meander Growth": of a curve that holds stages of its growth, shows one."""

from __future__ import annotations

import bpy

from . import nodes

NAME = "Meander Growth"
_INPUTS = (
    ("NodeSocketFloatFactor", "Factor", "How far the line has grown", 1.0, 0.0, 1.0),
    ("NodeSocketInt", "Stages", "How many stages the curve holds, one after another", 1, 1),
    ("NodeSocketInt", "Strands", "How many strands each of them has", 1, 1),
)


def build() -> list[bpy.types.ID]:
    """Makes the group in the open file."""
    group = nodes.geometry_group(NAME, "Shows how a line grew, from the stages in its curve")
    for row in _INPUTS:
        nodes.declare(group, *row)
    tree = nodes.Tree(group)
    given = tree.add("NodeGroupInput").outputs
    last = tree.math("SUBTRACT", given["Stages"], 1.0)
    wanted = tree.math("ROUND", tree.math("MULTIPLY", given["Factor"], last))
    index = tree.add("GeometryNodeInputIndex").outputs[0]
    stage = tree.math("FLOOR", tree.math("DIVIDE", tree.math("ADD", index, 0.5), given["Strands"]))
    off = tree.math("ABSOLUTE", tree.math("SUBTRACT", stage, wanted))
    other = tree.add(
        "FunctionNodeCompare", {"A": off, "B": 0.5}, data_type="FLOAT", operation="GREATER_THAN"
    ).outputs[0]
    kept = tree.add(
        "GeometryNodeDeleteGeometry",
        {"Geometry": given["Geometry"], "Selection": other},
        domain="CURVE",
    )
    tree.add("NodeGroupOutput", {"Geometry": kept.outputs[0]})
    return [group]
