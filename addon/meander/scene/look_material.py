# SPDX-License-Identifier: GPL-3.0-or-later
"""The material of a result: its first slot, where users look for it, told to its look.

A modifier that makes a mesh of a curve has to be told the material: before Blender 4 what it makes
has none of the curve's. So the modifier gets what is in the first slot, whenever that changes. One
that somebody has chosen in the modifier itself stays.
"""

from __future__ import annotations

import bpy
import numpy as np

from .look_modifier import modifier_of, set_value, value_of

_INPUT = "Material"
# A ramp's colours at so many places.
_SAMPLES = 513


def material_of(curve_object: bpy.types.Object) -> bpy.types.Material | None:
    """The material that a result is seen with: that of its look, or of its first slot."""
    modifier = modifier_of(curve_object)
    return _in_slot(curve_object) if modifier is None else value_of(modifier, _INPUT)


def is_chosen_in_modifier(curve_object: bpy.types.Object) -> bool:
    """Whether the modifier has a material of its own, and not that of the first slot."""
    modifier = modifier_of(curve_object)
    return modifier is not None and value_of(modifier, _INPUT) != _in_slot(curve_object)


def ramp_node_of(material: bpy.types.Material) -> bpy.types.Node | None:
    """The node that colours a line along its length, where the material is of the add-on's kind."""
    if material.node_tree is None:
        return None
    nodes = material.node_tree.nodes
    if not any(node.bl_idname == "ShaderNodeAttribute" for node in nodes):
        return None
    return next((node for node in nodes if node.bl_idname == "ShaderNodeValToRGB"), None)


def ramp_colours(curve_object: bpy.types.Object) -> np.ndarray | None:
    """The colours along a result, (k, 3), linear, at equal steps; None where its material has no
    such ramp."""
    material = material_of(curve_object)
    node = None if material is None else ramp_node_of(material)
    if node is None:
        return None
    shares = np.linspace(0.0, 1.0, _SAMPLES).tolist()
    return np.array([node.color_ramp.evaluate(share)[:3] for share in shares])


def write(curve_object: bpy.types.Object, modifier: bpy.types.NodesModifier) -> None:
    """Tells a modifier the material of the first slot."""
    material = _in_slot(curve_object)
    set_value(modifier, _INPUT, material)
    curve_object.meander.figures.look_material = material


def _in_slot(curve_object: bpy.types.Object) -> bpy.types.Material | None:
    slots = curve_object.material_slots
    return slots[0].material if len(slots) else None


def _follow_slot(thing: bpy.types.Object) -> None:
    if thing.type != "CURVE" or thing.library is not None:
        return
    modifier = modifier_of(thing)
    if modifier is None:
        return
    written = thing.meander.figures.look_material
    if _in_slot(thing) != written and value_of(modifier, _INPUT) == written:
        write(thing, modifier)


def on_update(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph | None = None) -> None:
    if depsgraph is None:
        return
    blocks = [update.id.original for update in depsgraph.updates]
    curves = [block for block in blocks if isinstance(block, bpy.types.Curve)]
    things = [block for block in blocks if isinstance(block, bpy.types.Object)]
    if curves:
        things += [thing for thing in scene.objects if thing.data in curves]
    for thing in things:
        _follow_slot(thing)


def on_output() -> None:
    """What a script has changed since the last evaluation, which may be none of this scene's."""
    for thing in bpy.data.objects:
        _follow_slot(thing)
