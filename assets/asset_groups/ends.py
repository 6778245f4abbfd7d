# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes for the ends of open lines: round ones, those of neon tubes, and plugs of cables."""

from __future__ import annotations

import bpy

from . import nodes

# What stands on an end, along Z from the last point of the line outwards: cones, each from a height
# and a radius to a height and a radius, all in radii of the line.
_NEON = (
    (-2.2, 1.0, -1.9, 1.22),
    (-1.9, 1.22, 1.9, 1.22),
    (1.9, 1.22, 2.3, 0.8),
    (2.3, 0.16, 4.0, 0.16),
)
_PLUG = (
    (-1.0, 1.02, 1.6, 1.25),
    (1.6, 1.25, 2.0, 1.7),
    (2.0, 1.7, 6.0, 1.7),
    (6.0, 1.7, 6.3, 1.3),
    (6.3, 0.75, 10.6, 0.75),
    (10.6, 0.75, 11.0, 0.5),
    (11.0, 0.5, 11.8, 0.85),
    (11.8, 0.85, 13.0, 0.25),
)
# Plugs rise from the surface, over the neighbouring turns: by so much of the normal.
_RISE = 0.8
_SIDES = 32

INPUTS = (
    ("NodeSocketInt", "Ends", "Of open lines: 0 flat, 1 round, 2 neon tube, 3 plug", 0, 0, 3),
    ("NodeSocketMaterial", "Ends Material", "Of what stands on the ends of a neon tube or a cable"),
)


def with_ends(
    tree: nodes.Tree,
    body: bpy.types.NodeSocket,
    curve: bpy.types.NodeSocket,
    given: bpy.types.NodeInputs,
) -> bpy.types.NodeSocket:
    """The body of a curve with what stands on the ends of its open strands.

    curve   with its radius in lengths, and with the surface normal as its normal
    """
    at_start = _endpoint(tree, 1, 0)
    closed = tree.add("GeometryNodeInputSplineCyclic").outputs[0]
    open_end = tree.add(
        "FunctionNodeBooleanMath", {0: _endpoint(tree, 1, 1), 1: closed}, operation="NIMPLY"
    ).outputs[0]
    tangent = tree.add("GeometryNodeInputTangent").outputs[0]
    normal = tree.add("GeometryNodeInputNormal").outputs[0]
    side = nodes.switch(tree, at_start, 1.0, -1.0, "FLOAT")
    outwards = tree.add("ShaderNodeVectorMath", {0: tangent, "Scale": side}, operation="SCALE")
    rise = nodes.switch(tree, _is(tree, given, 3), 0.0, _RISE, "FLOAT")
    upwards = tree.add("ShaderNodeVectorMath", {0: normal, "Scale": rise}, operation="SCALE")
    along = tree.add(
        "ShaderNodeVectorMath", {0: outwards.outputs[0], 1: upwards.outputs[0]}, operation="ADD"
    ).outputs[0]
    turned = tree.add("FunctionNodeAlignEulerToVector", {"Vector": along}, axis="Z").outputs[0]

    ball = tree.add("GeometryNodeMeshUVSphere", {"Segments": _SIDES, "Rings": 16, "Radius": 0.97})
    smooth = tree.add("GeometryNodeSetShadeSmooth", {"Geometry": ball.outputs["Mesh"]}).outputs[0]
    tip = _coloured(tree, smooth, given["Material"])
    neon = _joined(tree, tip, _turned_part(tree, _NEON, given))
    plug = _joined(tree, tip, _turned_part(tree, _PLUG, given))
    end = nodes.switch(tree, _is(tree, given, 2), tip, neon, "GEOMETRY")
    end = nodes.switch(tree, _is(tree, given, 3), end, plug, "GEOMETRY")
    placed = tree.add(
        "GeometryNodeInstanceOnPoints",
        {
            "Points": curve,
            "Selection": open_end,
            "Instance": end,
            "Rotation": turned,
            "Scale": tree.add("GeometryNodeInputRadius").outputs[0],
        },
    ).outputs[0]
    solid = tree.add("GeometryNodeRealizeInstances", {"Geometry": placed}).outputs[0]
    return nodes.switch(tree, _is(tree, given, 0), _joined(tree, body, solid), body, "GEOMETRY")


def _turned_part(
    tree: nodes.Tree, cones: tuple[tuple[float, ...], ...], given: bpy.types.NodeInputs
) -> bpy.types.NodeSocket:
    """A body of cones one above another."""
    parts = []
    for low, wide, high, narrow in cones:
        cone = tree.add(
            "GeometryNodeMeshCone",
            {
                "Vertices": _SIDES,
                "Radius Bottom": wide,
                "Radius Top": narrow,
                "Depth": high - low,
            },
        ).outputs["Mesh"]
        moved = tree.add(
            "GeometryNodeTransform", {"Geometry": cone, "Translation": (0.0, 0.0, low)}
        )
        parts.append(moved.outputs[0])
    return _coloured(tree, _joined(tree, *parts), given["Ends Material"])


def _coloured(
    tree: nodes.Tree, geometry: bpy.types.NodeSocket, material: bpy.types.NodeSocket
) -> bpy.types.NodeSocket:
    return tree.add(
        "GeometryNodeSetMaterial", {"Geometry": geometry, "Material": material}
    ).outputs[0]


def _joined(tree: nodes.Tree, *parts: bpy.types.NodeSocket) -> bpy.types.NodeSocket:
    join = tree.add("GeometryNodeJoinGeometry", {"Geometry": parts[0]})
    for part in parts[:0:-1]:
        tree.tree.links.new(part, join.inputs[0])
    return join.outputs[0]


def _endpoint(tree: nodes.Tree, start: int, end: int) -> bpy.types.NodeSocket:
    return tree.add(
        "GeometryNodeCurveEndpointSelection", {"Start Size": start, "End Size": end}
    ).outputs[0]


def _is(tree: nodes.Tree, given: bpy.types.NodeInputs, number: int) -> bpy.types.NodeSocket:
    return tree.add(
        "FunctionNodeCompare",
        {"A": given["Ends"], "B": number},
        data_type="INT",
        operation="EQUAL",
    ).outputs[0]
