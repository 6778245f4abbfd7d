# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes that make a rope or a yarn of a line: plies that wind round one another, and fibres."""

from __future__ import annotations

import math

import bpy

from . import nodes

# Plies are so much thicker than what just touches, since they press into each other.
_PRESSED = 1.08
# Twist counts turns in a length of so many radii.
_LENGTH = 10.0
# The length of the pieces of a ply in radii, where it has no more than one turn in that length.
_PIECE = 0.5
# A fibre: how thick it is, in radii; how many there are on a square of one radius, where Fuzz is 1.
_THIN, _MANY = 0.02, 3.0
# How long fibres are, in radii: most are short, and a few of them long.
_SHORT, _LONG = 0.35, 2.0

INPUTS = (
    ("NodeSocketInt", "Plies", "Of a rope", 3, 2, 12),
    (
        "NodeSocketFloat",
        "Twist",
        "Of a rope: turns of its plies in a length of ten radii; below 0 the other way round",
        1.5,
        -10.0,
        10.0,
    ),
    ("NodeSocketFloatFactor", "Fuzz", "Of a rope: how many loose fibres it has", 0.0, 0.0, 1.0),
)


def twisted(
    tree: nodes.Tree,
    curve: bpy.types.NodeSocket,
    given: bpy.types.NodeInputs,
    thickness: bpy.types.NodeSocket,
) -> bpy.types.NodeSocket:
    """The plies of a curve, with their radii.

    curve       with its radius in lengths, the surface normal as its normal, and `along`
    thickness   of the line where it has its spacing: half of it, in lengths
    """
    normal = tree.add("GeometryNodeInputNormal").outputs[0]
    kept = tree.add(
        "GeometryNodeCaptureAttribute",
        {"Geometry": curve, "Value": normal},
        data_type="FLOAT_VECTOR",
        domain="POINT",
    )
    normal = nodes.visible(kept.outputs, "Attribute")
    fast = tree.math("MAXIMUM", tree.math("ABSOLUTE", given["Twist"]), 1.0)
    piece = tree.math("DIVIDE", tree.math("MULTIPLY", thickness, _PIECE), fast)
    fine = tree.add(
        "GeometryNodeResampleCurve",
        {"Curve": kept.outputs["Geometry"], "Length": tree.math("MAXIMUM", piece, 1e-6)},
        mode="LENGTH",
    ).outputs[0]
    # Whole turns, so that the plies of a closed strand meet themselves.
    whole = tree.add("GeometryNodeSplineLength").outputs["Length"]
    span = tree.math("MAXIMUM", tree.math("MULTIPLY", thickness, _LENGTH), 1e-6)
    spans = tree.math("DIVIDE", whole, span)
    turns = tree.math("ROUND", tree.math("MULTIPLY", spans, given["Twist"]))
    length = tree.add("GeometryNodeSplineParameter").outputs["Length"]
    turned = tree.math("MULTIPLY", turns, tree.math("DIVIDE", length, whole))
    across = tree.add(
        "ShaderNodeVectorMath",
        {0: tree.add("GeometryNodeInputTangent").outputs[0], 1: normal},
        operation="CROSS_PRODUCT",
    ).outputs[0]
    held = fine
    values = []
    for value, kind in ((turned, "FLOAT"), (normal, "FLOAT_VECTOR"), (across, "FLOAT_VECTOR")):
        node = tree.add(
            "GeometryNodeCaptureAttribute",
            {"Geometry": held, "Value": value},
            data_type=kind,
            domain="POINT",
        )
        held = node.outputs["Geometry"]
        values.append(nodes.visible(node.outputs, "Attribute"))
    turned, normal, across = values

    plies = tree.add(
        "GeometryNodeDuplicateElements",
        {"Geometry": held, "Amount": given["Plies"]},
        domain="SPLINE",
    ).outputs
    phase = tree.math("ADD", turned, tree.math("DIVIDE", plies["Duplicate Index"], given["Plies"]))
    angle = tree.math("MULTIPLY", phase, 2.0 * math.pi)
    # Circles side by side on a circle, in a circle of radius 1.
    sine = tree.math("SINE", tree.math("DIVIDE", math.pi, given["Plies"]))
    share = tree.math("DIVIDE", sine, tree.math("ADD", sine, 1.0))
    radius = tree.add("GeometryNodeInputRadius").outputs[0]
    away = tree.math("MULTIPLY", tree.math("SUBTRACT", 1.0, share), radius)
    up = _times(tree, normal, "COSINE", angle, away)
    aside = _times(tree, across, "SINE", angle, away)
    offset = tree.add("ShaderNodeVectorMath", {0: up, 1: aside}, operation="ADD")
    moved = tree.add(
        "GeometryNodeSetPosition", {"Geometry": plies["Geometry"], "Offset": offset.outputs[0]}
    ).outputs[0]
    thin = tree.math("MULTIPLY", tree.math("MULTIPLY", radius, share), _PRESSED)
    thin = tree.add("GeometryNodeSetCurveRadius", {"Curve": moved, "Radius": thin}).outputs[0]
    # Rings of neighbouring points shall not be turned against each other.
    level = tree.add("GeometryNodeSetCurveNormal", {"Curve": thin}, mode="MINIMUM_TWIST").outputs[0]
    return tree.add("GeometryNodeSetCurveTilt", {"Curve": level, "Tilt": 0.0}).outputs[0]


def fuzzy(
    tree: nodes.Tree,
    mesh: bpy.types.NodeSocket,
    given: bpy.types.NodeInputs,
    thickness: bpy.types.NodeSocket,
) -> bpy.types.NodeSocket:
    """A mesh with loose fibres on it, which know what its points know."""
    area = tree.math("MAXIMUM", tree.math("MULTIPLY", thickness, thickness), 1e-12)
    many = tree.math("DIVIDE", tree.math("MULTIPLY", given["Fuzz"], _MANY), area)
    roots = tree.add(
        "GeometryNodeDistributePointsOnFaces",
        {"Mesh": mesh, "Density": many},
        distribute_method="RANDOM",
    ).outputs

    def random(low: object, high: object, kind: str, seed: int) -> bpy.types.NodeSocket:
        node = tree.add(
            "FunctionNodeRandomValue", {"Min": low, "Max": high, "Seed": seed}, data_type=kind
        )
        return nodes.visible(node.outputs, "Value")

    fibres = tree.add("GeometryNodeGeometryToInstance")
    for curve in _shapes(tree):
        section = tree.add("GeometryNodeCurvePrimitiveCircle", {"Resolution": 3, "Radius": _THIN})
        fibre = tree.add(
            "GeometryNodeCurveToMesh", {"Curve": curve, "Profile Curve": section.outputs[0]}
        ).outputs[0]
        tree.tree.links.new(fibre, fibres.inputs[0])
    share = tree.math("POWER", random(0.0, 1.0, "FLOAT", 2), 3.0)
    length = tree.math("MULTIPLY_ADD", share, _LONG - _SHORT, _SHORT)
    size = tree.math("MULTIPLY", length, thickness)
    turn = random((-0.6, -0.6, -math.pi), (0.6, 0.6, math.pi), "FLOAT_VECTOR", 1)
    placed = tree.add(
        "GeometryNodeInstanceOnPoints",
        {
            "Points": roots["Points"],
            "Instance": fibres.outputs[0],
            "Pick Instance": True,
            "Instance Index": random(0, 2, "INT", 3),
            "Rotation": roots["Rotation"],
            "Scale": size,
        },
    ).outputs[0]
    turned = tree.add(
        "GeometryNodeRotateInstances", {"Instances": placed, "Rotation": turn}
    ).outputs[0]
    loose = tree.add("GeometryNodeRealizeInstances", {"Geometry": turned}).outputs[0]
    join = tree.add("GeometryNodeJoinGeometry")
    tree.tree.links.new(loose, join.inputs[0])
    tree.tree.links.new(mesh, join.inputs[0])
    return join.outputs[0]


def _shapes(tree: nodes.Tree) -> list[bpy.types.NodeSocket]:
    """Fibres that rise from their place along Z, about as long as 1: one that leans, one that bends
    back, and one that curls."""

    def bent(*ends: tuple[float, float, float]) -> bpy.types.NodeSocket:
        names = ("Start", "Start Handle", "End Handle", "End")
        values = dict(zip(names, ends, strict=True))
        return tree.add(
            "GeometryNodeCurvePrimitiveBezierSegment", {"Resolution": 4} | values
        ).outputs[0]

    curl = tree.add(
        "GeometryNodeCurveSpiral",
        {
            "Resolution": 6,
            "Rotations": 1.3,
            "Start Radius": 0.02,
            "End Radius": 0.22,
            "Height": 0.6,
        },
    ).outputs[0]
    return [
        bent((0.0, 0.0, -0.1), (0.0, 0.0, 0.4), (0.4, 0.0, 0.4), (0.7, 0.2, 0.5)),
        bent((0.0, 0.0, -0.1), (0.1, 0.0, 0.8), (0.7, 0.1, 0.7), (0.5, 0.3, 0.1)),
        curl,
    ]


def _times(
    tree: nodes.Tree,
    direction: bpy.types.NodeSocket,
    wave: str,
    angle: bpy.types.NodeSocket,
    away: bpy.types.NodeSocket,
) -> bpy.types.NodeSocket:
    unit = tree.add("ShaderNodeVectorMath", {0: direction}, operation="NORMALIZE").outputs[0]
    size = tree.math("MULTIPLY", tree.math(wave, angle), away)
    return tree.add("ShaderNodeVectorMath", {0: unit, "Scale": size}, operation="SCALE").outputs[0]
