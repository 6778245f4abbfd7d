# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes that lead a line round the creases of its surface, so that a body of it is a bent pipe.

A line has one point on a crease, where a body would be as thin as its section is seen from the
side: in a right angle .7 of its width. There the line gets an arc instead.
"""

from __future__ import annotations

import bpy

from . import nodes

# What counts as a crease: the directions before and after differ along the surface normal by more,
# which a bend of 30 degrees does. Turns within the surface do not.
_SHARP = 0.5
# The radius of an arc in radii of the line, and how deep below the crease it may run at most.
_ARC, _DEPTH = 1.2, 0.4
# Points of the line within this many radii of a crease would leave the arc no room.
_ROOM = 1.3
# A line thicker than this share of the spacing counts as this thick, or arcs of neighbours meet.
_THICKEST = 0.35
# Pieces of an arc.
_PIECES = 4


def rounded(
    tree: nodes.Tree, curve: bpy.types.NodeSocket, spacing: bpy.types.NodeSocket
) -> tuple[bpy.types.NodeSocket, bpy.types.NodeSocket]:
    """A curve with arcs at the creases of its surface, and its normal, which is the surface's.

    curve   with its radius in lengths, and with the surface normal as its normal
    """
    radius = tree.math(
        "MINIMUM", _of_points(tree, "Radius"), tree.math("MULTIPLY", spacing, _THICKEST)
    )
    normal = tree.add("GeometryNodeInputNormal").outputs[0]
    curve, normal = _captured(tree, curve, normal, "FLOAT_VECTOR")
    before, has_before = _direction(tree, -1)
    after, has_after = _direction(tree, 1)
    inside = _both(tree, has_before, has_after)
    turn = tree.add("ShaderNodeVectorMath", {0: after, 1: before}, operation="SUBTRACT").outputs[0]
    bend = tree.math("ABSOLUTE", _dot(tree, turn, normal))
    sharp = _both(tree, inside, _compared(tree, "GREATER_THAN", bend, _SHARP))
    # Half of the bend: an arc of radius 1 begins its tangent from the crease, and is as far below
    # it as the secant is more than 1.
    along = tree.math("ADD", tree.math("MULTIPLY", _dot(tree, before, after), 0.5), 0.5)
    secant = tree.math("DIVIDE", 1.0, tree.math("SQRT", tree.math("MAXIMUM", along, 1e-4)))
    depth = tree.math("SUBTRACT", secant, 1.0)
    shallow = tree.math("DIVIDE", _DEPTH, tree.math("MAXIMUM", depth, 1e-4))
    arc = tree.math("MULTIPLY", tree.math("MINIMUM", shallow, _ARC), radius)
    curve, arc = _captured(tree, curve, tree.math("MULTIPLY", arc, sharp), "FLOAT")
    is_crease = _compared(tree, "GREATER_THAN", arc, 0.0)
    curve, inside = _captured(tree, curve, inside, "BOOLEAN")
    curve = _without_neighbours(tree, curve, is_crease, inside, radius)
    curve = tree.add(
        "GeometryNodeFilletCurve",
        {"Curve": curve, "Count": _PIECES, "Radius": arc, "Limit Radius": True},
        mode="POLY",
    ).outputs[0]
    return _turned(tree, curve, normal), normal


def _without_neighbours(
    tree: nodes.Tree,
    curve: bpy.types.NodeSocket,
    is_crease: bpy.types.NodeSocket,
    inside: bpy.types.NodeSocket,
    radius: bpy.types.NodeSocket,
) -> bpy.types.NodeSocket:
    """The curve without those of its points, other than ends, that are too close to a crease."""
    creases = tree.add(
        "GeometryNodeSeparateGeometry", {"Geometry": curve, "Selection": is_crease}, domain="POINT"
    ).outputs[0]
    points = tree.add("GeometryNodeCurveToPoints", {"Curve": creases}, mode="EVALUATED").outputs[0]
    size = tree.add(
        "GeometryNodeAttributeDomainSize", {"Geometry": points}, component="POINTCLOUD"
    ).outputs
    some = _compared(tree, "GREATER_THAN", nodes.visible(size, "Point Count"), 0.0)
    away = tree.add(
        "GeometryNodeProximity", {"Target": points}, target_element="POINTS"
    ).outputs["Distance"]
    near = _compared(tree, "LESS_THAN", away, tree.math("MULTIPLY", radius, _ROOM))
    other = tree.add("FunctionNodeBooleanMath", {0: is_crease}, operation="NOT").outputs[0]
    gone = _both(tree, _both(tree, near, some), _both(tree, other, inside))
    return tree.add(
        "GeometryNodeDeleteGeometry", {"Geometry": curve, "Selection": gone}, domain="POINT"
    ).outputs[0]


def _turned(
    tree: nodes.Tree, curve: bpy.types.NodeSocket, normal: bpy.types.NodeSocket
) -> bpy.types.NodeSocket:
    """The curve with the tilt by which its normal is as near to another one as it can be."""
    flat = tree.add("GeometryNodeSetCurveTilt", {"Curve": curve, "Tilt": 0.0}).outputs[0]
    own = tree.add("GeometryNodeInputNormal").outputs[0]
    tangent = tree.add("GeometryNodeInputTangent").outputs[0]
    cross = tree.add("ShaderNodeVectorMath", {0: own, 1: normal}, operation="CROSS_PRODUCT")
    angle = tree.math("ARCTAN2", _dot(tree, cross.outputs[0], tangent), _dot(tree, own, normal))
    return tree.add("GeometryNodeSetCurveTilt", {"Curve": flat, "Tilt": angle}).outputs[0]


def _direction(
    tree: nodes.Tree, step: int
) -> tuple[bpy.types.NodeSocket, bpy.types.NodeSocket]:
    """The direction of the line from the point before or to the next, and whether there is one."""
    other = tree.add("GeometryNodeOffsetPointInCurve", {"Offset": step}).outputs
    here = tree.add("GeometryNodeInputPosition").outputs[0]
    there = tree.add(
        "GeometryNodeFieldAtIndex",
        {"Index": other["Point Index"], "Value": here},
        data_type="FLOAT_VECTOR",
        domain="POINT",
    )
    ends = (nodes.visible(there.outputs, "Value"), here)
    first, last = ends if step < 0 else ends[::-1]
    along = tree.add("ShaderNodeVectorMath", {0: last, 1: first}, operation="SUBTRACT").outputs[0]
    unit = tree.add("ShaderNodeVectorMath", {0: along}, operation="NORMALIZE").outputs[0]
    return unit, other["Is Valid Offset"]


def _captured(
    tree: nodes.Tree, curve: bpy.types.NodeSocket, value: bpy.types.NodeSocket, kind: str
) -> tuple[bpy.types.NodeSocket, bpy.types.NodeSocket]:
    """The curve that keeps a value of its points as they are, and the value."""
    node = tree.add(
        "GeometryNodeCaptureAttribute",
        {"Geometry": curve, "Value": value},
        data_type=kind,
        domain="POINT",
    )
    return node.outputs["Geometry"], nodes.visible(node.outputs, "Attribute")


def _of_points(tree: nodes.Tree, name: str) -> bpy.types.NodeSocket:
    return tree.add(f"GeometryNodeInput{name}").outputs[0]


def _both(
    tree: nodes.Tree, one: bpy.types.NodeSocket, other: bpy.types.NodeSocket
) -> bpy.types.NodeSocket:
    return tree.add("FunctionNodeBooleanMath", {0: one, 1: other}, operation="AND").outputs[0]


def _dot(
    tree: nodes.Tree, one: bpy.types.NodeSocket, other: bpy.types.NodeSocket
) -> bpy.types.NodeSocket:
    node = tree.add("ShaderNodeVectorMath", {0: one, 1: other}, operation="DOT_PRODUCT")
    return node.outputs["Value"]


def _compared(
    tree: nodes.Tree, how: str, value: bpy.types.NodeSocket, bound: object
) -> bpy.types.NodeSocket:
    node = tree.add(
        "FunctionNodeCompare", {"A": value, "B": bound}, data_type="FLOAT", operation=how
    )
    return node.outputs[0]
