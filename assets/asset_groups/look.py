# SPDX-License-Identifier: GPL-3.0-or-later
"""The node group "Meander Look": what makes a body of a line, and the modifier of every result."""

from __future__ import annotations

import bpy

from . import creases, ends, nodes, rope

NAME = "Meander Look"
# The number of the profile that is more than a section.
ROPE = 4
# Across the flat profiles, as shares of the radius: a ribbon's height and a wall's width.
THIN = 0.3

_FLOAT, _FACTOR = "NodeSocketFloat", "NodeSocketFloatFactor"
_INPUTS = (
    (_FACTOR, "Radius", "As a share of the spacing; at 0.5 neighbours touch", 0.2, 0.0, 1.0),
    ("NodeSocketInt", "Profile", "0 round, 1 square, 2 ribbon, 3 wall, 4 rope", 0, 0, ROPE),
    ("NodeSocketInt", "Resolution", "Sides of the round profile", 8, 3, 64),
    (_FLOAT, "Lift", "Above the surface, in radii: 0 is half sunk, 1 lies on it", 0.0),
    (
        _FACTOR,
        "Radius Follows Spacing",
        "How much thicker the line is where its neighbours are farther apart",
        0.0,
        0.0,
        1.0,
    ),
    ("NodeSocketMaterial", "Material", "Of the whole line"),
    (
        "NodeSocketFloatDistance",
        "Spacing",
        "What the radius is a share of, in the space of the object",
        0.1,
        0.0,
    ),
    *rope.INPUTS,
    *ends.INPUTS,
    (
        _FACTOR,
        "Round",
        "How far the line is drawn beside the curve to make its turns round, in spacings",
        0.0,
        0.0,
        0.5,
    ),
    ("NodeSocketObject", "Round Line", "The line with round turns, which Meander makes"),
    ("NodeSocketInt", "Round Points", "How many points the curve has that it was made of", 0, 0),
    (_FLOAT, "Round Length", "How long that curve is, in the space of the object", 0.0, 0.0),
)
# How much of the length a curve may have changed by and be the same, as sums are that long.
_SAME_LENGTH = 1e-3


def build() -> list[bpy.types.ID]:
    """Makes the group in the open file."""
    group = nodes.geometry_group(NAME, "Gives a line that fills a surface its thickness")
    for row in _INPUTS:
        nodes.declare(group, *row)
    tree = nodes.Tree(group)
    given = tree.add("NodeGroupInput").outputs
    named = _with_attributes(tree, _round_line(tree, given))

    # In points of a result `radius` is the room beside them in half spacings.
    room = tree.add("GeometryNodeInputRadius").outputs[0]
    more = tree.math("MULTIPLY", tree.math("SUBTRACT", room, 1.0), given["Radius Follows Spacing"])
    thickness = tree.math("MULTIPLY", given["Radius"], given["Spacing"])
    radius = tree.math("MULTIPLY", tree.math("ADD", more, 1.0), thickness)
    curve = tree.add("GeometryNodeSetCurveRadius", {"Curve": named, "Radius": radius}).outputs[0]

    curve, _normal = creases.rounded(tree, curve, given["Spacing"])
    normal = tree.add("GeometryNodeInputNormal").outputs[0]
    height = tree.math("MULTIPLY", tree.add("GeometryNodeInputRadius").outputs[0], given["Lift"])
    up = tree.add("ShaderNodeVectorMath", {0: normal, "Scale": height}, operation="SCALE")
    lifted = tree.add("GeometryNodeSetPosition", {"Geometry": curve, "Offset": up.outputs[0]})

    profile, is_round, is_rope = _profile(tree, given)
    plies = rope.twisted(tree, lifted.outputs[0], given, thickness)
    path = nodes.switch(tree, is_rope, lifted.outputs[0], plies, "GEOMETRY")
    swept = tree.add(
        "GeometryNodeCurveToMesh", {"Curve": path, "Profile Curve": profile, "Fill Caps": True}
    ).outputs[0]
    smooth = tree.add(
        "GeometryNodeSetShadeSmooth", {"Geometry": swept, "Shade Smooth": is_round}
    )
    body = smooth.outputs[0]
    has_fuzz = tree.add(
        "FunctionNodeCompare",
        {"A": given["Fuzz"], "B": 0.0},
        data_type="FLOAT",
        operation="GREATER_THAN",
    ).outputs[0]
    both = tree.add("FunctionNodeBooleanMath", {0: is_rope, 1: has_fuzz}, operation="AND")
    fuzz = rope.fuzzy(tree, body, given, thickness)
    body = nodes.switch(tree, both.outputs[0], body, fuzz, "GEOMETRY")
    coloured = tree.add(
        "GeometryNodeSetMaterial", {"Geometry": body, "Material": given["Material"]}
    )
    whole = ends.with_ends(tree, coloured.outputs[0], lifted.outputs[0], given)
    tree.add("NodeGroupOutput", {"Geometry": whole})
    return [group]


def _round_line(tree: nodes.Tree, given: bpy.types.NodeInputs) -> bpy.types.NodeSocket:
    """The line with round turns, where the curve is the one that it was made of; else the curve.

    Elsewhere the curve has been edited or moved since, and nothing is known of how it was.
    """
    curve = given["Geometry"]
    line = tree.add(
        "GeometryNodeObjectInfo", {"Object": given["Round Line"]}, transform_space="ORIGINAL"
    )
    size = tree.add("GeometryNodeAttributeDomainSize", {"Geometry": curve}, component="CURVE")
    points = nodes.visible(size.outputs, "Point Count")
    length = tree.add("GeometryNodeCurveLength", {"Curve": curve}).outputs[0]
    known = given["Round Length"]
    off = tree.math("ABSOLUTE", tree.math("SUBTRACT", length, known))
    tests = (
        ({"A": points, "B": given["Round Points"]}, "INT", "EQUAL"),
        ({"A": off, "B": tree.math("MULTIPLY", known, _SAME_LENGTH)}, "FLOAT", "LESS_THAN"),
    )
    same = [
        tree.add("FunctionNodeCompare", values, data_type=kind, operation=operation).outputs[0]
        for values, kind, operation in tests
    ]
    both = tree.add("FunctionNodeBooleanMath", dict(enumerate(same)), operation="AND").outputs[0]
    drawn = nodes.visible(line.outputs, "Geometry")
    return nodes.switch(tree, both, curve, drawn, "GEOMETRY")


def _with_attributes(tree: nodes.Tree, geometry: bpy.types.NodeSocket) -> bpy.types.NodeSocket:
    """What a material wants to know of a point: where along its strand it is, which that is, and
    how its surface lies."""
    length = tree.add("GeometryNodeSplineParameter").outputs["Length"]
    # Not the node's own factor: in Blender 3.4 that is 1 at the last point of a closed strand.
    whole = tree.add("GeometryNodeSplineLength").outputs["Length"]
    index = tree.add("GeometryNodeInputIndex").outputs[0]
    strand = tree.add(
        "GeometryNodeFieldOnDomain", {"Value": index}, data_type="INT", domain="CURVE"
    )
    along = tree.math("DIVIDE", length, whole)
    # A closed strand has no end: its colours go there and back, or they would jump where it begins.
    signed = tree.math("MULTIPLY_ADD", along, 2.0, -1.0)
    round_trip = tree.math("SUBTRACT", 1.0, tree.math("ABSOLUTE", signed))
    closed = tree.add("GeometryNodeInputSplineCyclic").outputs[0]
    named = (
        ("along", "FLOAT", along),
        ("ramp", "FLOAT", nodes.switch(tree, closed, along, round_trip, "FLOAT")),
        ("arc_length", "FLOAT", length),
        ("strand", "INT", nodes.visible(strand.outputs, "Value")),
        ("surface_normal", "FLOAT_VECTOR", tree.add("GeometryNodeInputNormal").outputs[0]),
    )
    for name, kind, value in named:
        geometry = tree.add(
            "GeometryNodeStoreNamedAttribute",
            {"Geometry": geometry, "Name": name, "Value": value},
            data_type=kind,
            domain="POINT",
        ).outputs[0]
    return geometry


def _profile(
    tree: nodes.Tree, given: bpy.types.NodeInputs
) -> tuple[bpy.types.NodeSocket, bpy.types.NodeSocket, bpy.types.NodeSocket]:
    """The cross section, of radius 1 with X along the surface normal; whether it is round, and
    whether it is that of the plies of a rope."""

    def chosen(number: int) -> bpy.types.NodeSocket:
        return tree.add(
            "FunctionNodeCompare",
            {"A": given["Profile"], "B": number},
            data_type="INT",
            operation="EQUAL",
        ).outputs[0]

    def size(thin: bpy.types.NodeSocket) -> bpy.types.NodeSocket:
        return nodes.switch(tree, thin, 2.0, 2.0 * THIN, "FLOAT")

    is_rope = chosen(ROPE)
    is_round = tree.add(
        "FunctionNodeBooleanMath", {0: chosen(0), 1: is_rope}, operation="OR"
    ).outputs[0]
    circle = tree.add(
        "GeometryNodeCurvePrimitiveCircle", {"Resolution": given["Resolution"], "Radius": 1.0}
    )
    flat = tree.add(
        "GeometryNodeCurvePrimitiveQuadrilateral",
        {"Width": size(chosen(2)), "Height": size(chosen(3))},
    )
    profile = nodes.switch(tree, is_round, flat.outputs[0], circle.outputs[0], "GEOMETRY")
    return profile, is_round, is_rope
