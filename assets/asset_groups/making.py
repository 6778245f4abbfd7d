# SPDX-License-Identifier: GPL-3.0-or-later
"""What dresses a surface that was cut along its line: its relief, two colours, lights that run."""

from __future__ import annotations

import bpy

from . import nodes

RELIEF = "Meander Relief"
CORAL = "Meander Coral"
SIDES = ("Meander Side 1", "Meander Side 2")
LIGHTS = "Meander Running Lights"

_FLOAT = "NodeSocketFloat"
_INPUTS = (
    (_FLOAT, "Height", "Of the ridges between the line, in spacings; below 0 they sink", 0.3),
    (_FLOAT, "Roundness", "1 is a roof, 2 is round, more is a flat top", 2.0, 1.0, 20.0),
    (
        "NodeSocketFloatDistance",
        "Spacing",
        "Between neighbouring turns of the line, in the space of the object",
        0.1,
        0.0,
    ),
)
_SIDE_COLOURS = ((0.80, 0.29, 0.06), (0.02, 0.13, 0.17))
_LOW, _HIGH = (0.09, 0.012, 0.02), (0.78, 0.34, 0.22)
_DARK, _GLOW = (0.008, 0.009, 0.014), (1.0, 0.36, 0.06)


def build() -> list[bpy.types.ID]:
    """Makes the group and the materials in the open file."""
    sides = [_plain(name, colour) for name, colour in zip(SIDES, _SIDE_COLOURS, strict=True)]
    return [_relief(), _coral(), *sides, _lights()]


def _relief() -> bpy.types.NodeTree:
    group = nodes.geometry_group(RELIEF, "Raises a surface between the turns of the line on it")
    for row in _INPUTS:
        nodes.declare(group, *row)
    tree = nodes.Tree(group)
    given = tree.add("NodeGroupInput").outputs

    def named(name: str, kind: str) -> bpy.types.NodeSocket:
        node = tree.add("GeometryNodeInputNamedAttribute", {"Name": name}, data_type=kind)
        return nodes.visible(node.outputs, "Attribute")

    # From 0 on the line to 1 halfway to the next turn.
    half = tree.math("MULTIPLY", given["Spacing"], 0.5)
    away = tree.math("MINIMUM", tree.math("DIVIDE", named("distance", "FLOAT"), half), 1.0)
    below = tree.math("POWER", tree.math("SUBTRACT", 1.0, away), given["Roundness"])
    root = tree.math("DIVIDE", 1.0, given["Roundness"])
    ridge = tree.math("POWER", tree.math("SUBTRACT", 1.0, below), root)
    height = tree.math("MULTIPLY", tree.math("MULTIPLY", ridge, given["Height"]), given["Spacing"])

    normal = named("surface_normal", "FLOAT_VECTOR")
    offset = tree.add("ShaderNodeVectorMath", {0: normal, "Scale": height}, operation="SCALE")
    # Before the points move: the ridge is a field of where they are.
    stored = tree.add(
        "GeometryNodeStoreNamedAttribute",
        {"Geometry": given["Geometry"], "Name": "relief", "Value": ridge},
        data_type="FLOAT",
        domain="POINT",
    )
    moved = tree.add(
        "GeometryNodeSetPosition", {"Geometry": stored.outputs[0], "Offset": offset.outputs[0]}
    )
    smooth = tree.add("GeometryNodeSetShadeSmooth", {"Geometry": moved.outputs[0]})
    tree.add("NodeGroupOutput", {"Geometry": smooth.outputs[0]})
    return group


def _plain(name: str, colour: tuple[float, float, float]) -> bpy.types.Material:
    material, tree = _material(name, colour)
    shader = tree.add("ShaderNodeBsdfPrincipled", {"Base Color": (*colour, 1.0), "Roughness": 0.4})
    tree.add("ShaderNodeOutputMaterial", {"Surface": shader.outputs[0]})
    nodes.mark(material, "Of one of the two sides of a line", "Materials")
    return material


def _coral() -> bpy.types.Material:
    material, tree = _material(CORAL, _HIGH)
    relief = tree.add("ShaderNodeAttribute", attribute_type="GEOMETRY", attribute_name="relief")
    ramp = tree.add("ShaderNodeValToRGB", {"Fac": relief.outputs["Fac"]})
    ramp.label = "From Furrow to Ridge"
    for element, colour in zip(ramp.color_ramp.elements, (_LOW, _HIGH), strict=True):
        element.color = (*colour, 1.0)
    shader = tree.add(
        "ShaderNodeBsdfPrincipled", {"Base Color": ramp.outputs["Color"], "Roughness": 0.5}
    )
    tree.add("ShaderNodeOutputMaterial", {"Surface": shader.outputs[0]})
    nodes.mark(material, "Darkens the furrows of a relief", "Materials")
    return material


def _lights() -> bpy.types.Material:
    """Lamps along the line, by the UV map Ribbon: every so many spacings one lights up."""
    material, tree = _material(LIGHTS, _GLOW)

    def value(label: str, number: float) -> bpy.types.Node:
        node = tree.add("ShaderNodeValue")
        node.label = label
        node.outputs[0].default_value = number
        return node

    place = tree.add(
        "ShaderNodeSeparateXYZ",
        {0: tree.add("ShaderNodeUVMap", uv_map="Ribbon").outputs[0]},
    ).outputs
    period, width = value("Period", 24.0).outputs[0], value("Width", 0.16).outputs[0]
    shift = value("Shift", 0.0)
    driver = shift.outputs[0].driver_add("default_value").driver
    driver.expression = "frame / 24"
    # A comet: bright at its head, fading behind it.
    phase = tree.math("SUBTRACT", tree.math("DIVIDE", place["X"], period), shift.outputs[0])
    tail = tree.math("POWER", tree.math("FRACT", phase), 3.0)
    off = tree.math("ABSOLUTE", tree.math("SUBTRACT", place["Y"], 0.5))
    near = tree.add(
        "ShaderNodeMapRange", {"Value": off, "From Min": width, "From Max": 0.0}, clamp=True
    )
    glow = tree.math("MULTIPLY", tail, near.outputs[0])
    body = tree.add(
        "ShaderNodeBsdfPrincipled",
        {
            "Base Color": (*_DARK, 1.0),
            "Roughness": 0.3,
            "Emission": (*_GLOW, 1.0),
            "Emission Strength": tree.math("MULTIPLY", glow, 12.0),
        },
    )
    tree.add("ShaderNodeOutputMaterial", {"Surface": body.outputs[0]})
    nodes.mark(material, "Lights that run along the line of a surface cut along it", "Materials")
    return material


def _material(
    name: str, colour: tuple[float, float, float]
) -> tuple[bpy.types.Material, nodes.Tree]:
    material = bpy.data.materials.new(name)
    material.diffuse_color = (*colour, 1.0)
    material.roughness = 0.4
    material.use_nodes = True
    material.node_tree.nodes.clear()
    return material, nodes.Tree(material.node_tree)
