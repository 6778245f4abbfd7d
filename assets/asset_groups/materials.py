# SPDX-License-Identifier: GPL-3.0-or-later
"""The materials of the asset file."""

from __future__ import annotations

import bpy

from . import nodes

LINE = "Meander Line"
ENDS = "Meander Ends"
_METAL = (0.035, 0.035, 0.04)
# From the first point of a strand to its last, or halfway round a closed one: dark, so that it is
# read on a light surface.
_STOPS = (
    (0.0, (0.010, 0.030, 0.180)),
    (0.5, (0.160, 0.008, 0.150)),
    (1.0, (0.420, 0.045, 0.010)),
)
# The color that strands behind fade into, and how soon they do beside the outline.
_BEHIND, _SOFT = (0.8, 0.8, 0.8, 1.0), 2.5
_IN_VIEWS = (0.012, 0.030, 0.150, 1.0)  # with materials as plain colours, as in Solid view


def build() -> list[bpy.types.ID]:
    """Makes the materials in the open file."""
    return [_line(), _ends()]


def _ends() -> bpy.types.Material:
    material = bpy.data.materials.new(ENDS)
    material.diffuse_color = (*_METAL, 1.0)
    material.metallic, material.roughness = 0.8, 0.35
    material.use_nodes = True
    material.node_tree.nodes.clear()
    tree = nodes.Tree(material.node_tree)
    shader = tree.add(
        "ShaderNodeBsdfPrincipled",
        {"Base Color": (*_METAL, 1.0), "Metallic": 0.8, "Roughness": 0.35},
    )
    tree.add("ShaderNodeOutputMaterial", {"Surface": shader.outputs[0]})
    nodes.mark(material, "Of what stands on the ends of a neon tube or a cable", "Materials")
    return material


def _fade(tree: nodes.Tree) -> bpy.types.NodeSocket:
    """How much of a line fades: a value that is 0 to begin with, where the surface is seen from
    behind; without the surface these are the strands on the far side."""
    normal = tree.add(
        "ShaderNodeAttribute", attribute_type="GEOMETRY", attribute_name="surface_normal"
    )
    in_world = tree.add(
        "ShaderNodeVectorTransform",
        {"Vector": normal.outputs["Vector"]},
        vector_type="NORMAL",
        convert_from="OBJECT",
        convert_to="WORLD",
    )
    to_viewer = tree.add("ShaderNodeNewGeometry").outputs["Incoming"]
    facing = tree.add(
        "ShaderNodeVectorMath", {0: in_world.outputs[0], 1: to_viewer}, operation="DOT_PRODUCT"
    )
    facing = nodes.visible(facing.outputs, "Value")
    away = tree.add(
        "ShaderNodeMath", {0: facing, 1: -_SOFT, 2: 0.5}, operation="MULTIPLY_ADD", use_clamp=True
    )
    fade = tree.add("ShaderNodeValue")
    fade.label, fade.outputs[0].default_value = "Fade Behind", 0.0
    return tree.math("MULTIPLY", away.outputs[0], fade.outputs[0])


def _line() -> bpy.types.Material:
    material = bpy.data.materials.new(LINE)
    material.diffuse_color = _IN_VIEWS
    material.roughness = 0.4
    material.use_nodes = True
    material.node_tree.nodes.clear()
    tree = nodes.Tree(material.node_tree)
    place = tree.add("ShaderNodeAttribute", attribute_type="GEOMETRY", attribute_name="ramp")
    ramp = tree.add("ShaderNodeValToRGB", {"Fac": place.outputs["Fac"]})
    ramp.label = "Along the Line"
    elements = ramp.color_ramp.elements
    while len(elements) < len(_STOPS):
        elements.new(0.5)
    for element, (position, colour) in zip(elements, _STOPS, strict=True):
        element.position = position
        element.color = (*colour, 1.0)
    shader = tree.add(
        "ShaderNodeBsdfPrincipled", {"Base Color": ramp.outputs["Color"], "Roughness": 0.4}
    )
    behind = tree.add("ShaderNodeRGB")
    behind.label, behind.outputs[0].default_value = "Color Behind", _BEHIND
    plain = tree.add("ShaderNodeEmission", {"Color": behind.outputs[0]})
    faded = tree.add(
        "ShaderNodeMixShader", {"Fac": _fade(tree), 1: shader.outputs[0], 2: plain.outputs[0]}
    )
    tree.add("ShaderNodeOutputMaterial", {"Surface": faded.outputs[0]})
    nodes.mark(material, "Colours a line from its beginning to its end", "Materials")
    return material
