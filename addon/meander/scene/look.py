# SPDX-License-Identifier: GPL-3.0-or-later
"""The look of a result: a modifier that gives the line its body, and that is the user's to edit.

A run gives it to a new curve. From then on runs write splines only, and, where they have not been
changed by hand, the spacing of which the thickness is a share and whether it follows a density.

The modifier has to be told the material: before Blender 4 what it makes of a curve has none of the
curve's. So it gets what is in the first slot, where users look for it, whenever that changes. One
that somebody has chosen in the modifier itself stays.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from . import assets
from .blender_versions import group_sockets, input_place, input_value, set_input_value
from .errors import DataError
from .view_aid import is_view_aid

GROUP = "Meander Look"


def modifier_of(thing: bpy.types.Object) -> bpy.types.NodesModifier | None:
    """The modifier that gives a curve its look; None where there is none."""
    return next((other for other in thing.modifiers if _is_look(other)), None)


def shaping_modifiers(thing: bpy.types.Object) -> list[bpy.types.Modifier]:
    """Those that change the line itself: what comes before its look, of which a body is made."""
    shaping = []
    for modifier in thing.modifiers:
        if _is_look(modifier):
            break
        if not is_view_aid(modifier):
            shaping.append(modifier)
    return shaping


def _is_look(modifier: bpy.types.Modifier) -> bool:
    return modifier.type == "NODES" and assets.is_asset(modifier.node_group, GROUP)


def place_of(modifier: bpy.types.NodesModifier, name: str) -> tuple[Any, str] | None:
    """What holds an input of the group, and the property's name there, as layouts want it; None:
    the user's group has no such input any more."""
    identifier = _identifier(modifier, name)
    return None if identifier is None else input_place(modifier, identifier)


def value_of(modifier: bpy.types.NodesModifier, name: str) -> Any:
    """What an input of the group is set to; None where there is no such input."""
    identifier = _identifier(modifier, name)
    return None if identifier is None else input_value(modifier, identifier)


def set_value(modifier: bpy.types.NodesModifier, name: str, value: Any) -> None:
    """Sets an input of the group; nothing happens where there is no such input."""
    identifier = _identifier(modifier, name)
    if identifier is not None:
        set_input_value(modifier, identifier, value)


def copy_values(source: bpy.types.NodesModifier, target: bpy.types.NodesModifier) -> None:
    """Sets all inputs of a modifier to what another one of the same group has."""
    for socket in group_sockets(source.node_group, "INPUT"):
        if input_place(source, socket.identifier) is not None:
            set_input_value(target, socket.identifier, input_value(source, socket.identifier))


def same_values(one: bpy.types.NodesModifier, other: bpy.types.NodesModifier) -> bool:
    """Whether all inputs of two modifiers of the same group are set to the same."""
    return one.node_group == other.node_group and all(
        _comparable(input_value(one, socket.identifier))
        == _comparable(input_value(other, socket.identifier))
        for socket in group_sockets(one.node_group, "INPUT")
        if input_place(one, socket.identifier) is not None
    )


def _comparable(value: Any) -> Any:
    return tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value


def _identifier(modifier: bpy.types.NodesModifier, name: str) -> str | None:
    for socket in group_sockets(modifier.node_group, "INPUT"):
        if socket.name == name and input_place(modifier, socket.identifier) is not None:
            return socket.identifier
    return None


LINE, ENDS = "Meander Line", "Meander Ends"
# How far lines are drawn beside their curves unless something else is chosen, in spacings.
ROUND = 0.12
# Inputs that a run tells the look, and what keeps them, to tell them from what the user has set.
_TOLD = {"Spacing": "look_spacing", "Radius Follows Spacing": "look_follows"}
# Of what Blender keeps in single precision.
_ROUNDING = 1e-6


@dataclass(frozen=True)
class Look:
    """What a new result is to look like.

    radius    share of the spacing; 0: a bare curve
    profile   number of the cross section, as the group counts them
    follows   thicker where neighbours are farther apart
    round     how far the line is drawn beside the curve to make turns round, share of the spacing
    """

    radius: float
    profile: int = 0
    follows: bool = False
    round: float = 0.0


def dress(curve_object: bpy.types.Object, look: Look, spacing: float) -> None:
    """Gives a new curve its look and, where it has no material, the add-on's.

    spacing   in the object's own space

    A curve whose strands have materials of their own gets a bevel, since modifiers know one
    material for all of a curve; so does every curve where the add-on's file cannot be read.
    """
    curve = curve_object.data
    curve.twist_mode = "Z_UP"  # by which its points are tilted
    try:
        if not any(curve.materials):
            line = assets.material(LINE)
            if len(curve.materials):
                curve.materials[0] = line
            else:
                curve.materials.append(line)
        if look.radius <= 0.0:
            return
        if len(curve.materials) > 1:
            curve.bevel_depth = look.radius * spacing
            return
        add_modifier(curve_object, look, spacing)
    except DataError:  # a line that has grown must not be lost because of its looks
        curve.bevel_depth = look.radius * spacing


def add_modifier(curve_object: bpy.types.Object, look: Look, spacing: float) -> None:
    """Adds the modifier, with the first material of the curve; see dress(). Raises DataError."""
    group = assets.node_group(GROUP)
    modifier = curve_object.modifiers.new(GROUP, "NODES")
    modifier.node_group = group
    given = (("Radius", look.radius), ("Profile", look.profile), ("Round", look.round))
    for name, value in given:
        set_value(modifier, name, value)
    write(curve_object, modifier)
    for name, value in (("Spacing", spacing), ("Radius Follows Spacing", float(look.follows))):
        _tell(curve_object, modifier, name, value)


def follow_run(curve_object: bpy.types.Object, spacing: float, follows: bool) -> None:
    """Tells the look of a result what its last run was about, but for what the user has set.

    spacing   in the object's own space
    follows   thicker where neighbours are farther apart
    """
    modifier = modifier_of(curve_object)
    if modifier is None:
        return
    for name, value in (("Spacing", spacing), ("Radius Follows Spacing", float(follows))):
        told = getattr(curve_object.meander.figures, _TOLD[name])
        now = value_of(modifier, name)
        if now is not None and math.isclose(now, told, rel_tol=_ROUNDING):
            _tell(curve_object, modifier, name, value)


def _tell(
    curve_object: bpy.types.Object, modifier: bpy.types.NodesModifier, name: str, value: float
) -> None:
    set_value(modifier, name, value)
    setattr(curve_object.meander.figures, _TOLD[name], value)


def give_ends_material(curve_object: bpy.types.Object) -> None:
    """Gives what stands on the ends of a line the add-on's material, where it has none."""
    modifier = modifier_of(curve_object)
    wants = modifier is not None and (value_of(modifier, "Ends") or 0) > 1
    if wants and value_of(modifier, "Ends Material") is None:
        try:
            set_value(modifier, "Ends Material", assets.material(ENDS))
        except DataError:
            pass  # it is plain then


def radius_of(curve_object: bpy.types.Object) -> float:
    """Half the thickness of a result in its own space; 0 for a bare curve."""
    modifier = modifier_of(curve_object)
    if modifier is None:
        return curve_object.data.bevel_depth
    return (value_of(modifier, "Radius") or 0.0) * (value_of(modifier, "Spacing") or 0.0)


def copy_look(source: bpy.types.Object, target: bpy.types.Object) -> None:
    """Gives a curve the look of another, with values of its own from then on."""
    modifier = modifier_of(source)
    if modifier is None:
        return
    copy = target.modifiers.new(modifier.name, "NODES")
    copy.node_group = modifier.node_group
    copy.show_viewport, copy.show_render = modifier.show_viewport, modifier.show_render
    copy_values(modifier, copy)


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
    give_ends_material(thing)  # which a script may have chosen
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
