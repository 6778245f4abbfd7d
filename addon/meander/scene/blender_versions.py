# SPDX-License-Identifier: GPL-3.0-or-later
"""What differs between the versions of Blender that the add-on runs in, 3.4 to the newest.

All of it is here, each difference with the version that made it: when the oldest version that is
supported rises, what can go is found in one place, and nothing else asks which Blender it is in.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from .columns import column

# ------------------------------------------------------------------------------------------------
# Interface


def draw_progress(layout: bpy.types.UILayout, factor: float, text: str) -> bool:
    """Draws a progress bar; False before 4.0, which has none, and then draws nothing."""
    if not hasattr(layout, "progress"):
        return False
    layout.progress(factor=factor, text=text)
    return True


def ask(
    manager: bpy.types.WindowManager, operator: bpy.types.Operator, width: int, confirm: str
) -> set[str]:
    """Opens an operator's dialog; `confirm` is on its button, from 4.1 on."""
    words = {} if bpy.app.version < (4, 1) else {"confirm_text": confirm}
    return manager.invoke_props_dialog(operator, width=width, **words)


def flat_shader() -> str:
    """The name of the built-in shader that draws places in space in one colour; 4.0 renamed it."""
    return "UNIFORM_COLOR" if bpy.app.version >= (4, 0) else "3D_UNIFORM_COLOR"


def add_preset_path(folder: Path) -> None:
    """Tells Blender where presets come with the add-on; nothing before 4.3, which does not ask."""
    if hasattr(bpy.utils, "register_preset_path"):
        bpy.utils.register_preset_path(str(folder))


def remove_preset_path(folder: Path) -> None:
    """Takes back what add_preset_path told."""
    if hasattr(bpy.utils, "unregister_preset_path"):
        bpy.utils.unregister_preset_path(str(folder))


def settings_of(owner: bpy.types.bpy_struct, names: Iterable[str]) -> dict[str, Any]:
    """Those of some settings that this Blender has, with their values."""
    return {name: getattr(owner, name) for name in names if hasattr(owner, name)}


# ------------------------------------------------------------------------------------------------
# Data-blocks


def session_number(block: bpy.types.ID) -> int | None:
    """A number that no other data-block of the session has or will have; None before 4.1."""
    return getattr(block, "session_uid", None)


def keep_custom_normals(mesh: bpy.types.Mesh, angle: float | None = None) -> None:
    """Lets a mesh show sharp edges and normals of its own, which 4.1 and later do anyway.

    `angle`  in radians: edges that are sharper count as sharp; None: as the mesh has it
    """
    if hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth = True
        if angle is not None:
            mesh.auto_smooth_angle = angle


def add_triangles(mesh: bpy.types.Mesh, faces: np.ndarray) -> None:
    """Gives a mesh that has vertices and no face triangles (n, 3)."""
    mesh.loops.add(faces.size)
    mesh.loops.foreach_set("vertex_index", faces.ravel().astype(np.int32))
    mesh.polygons.add(len(faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, faces.size, 3, dtype=np.int32))
    if bpy.app.version < (4, 0):  # later ones read it from where the next one starts
        mesh.polygons.foreach_set("loop_total", np.full(len(faces), 3, dtype=np.int32))


def make_poly(curves: bpy.types.Curves) -> None:
    """Makes all curves of a block poly curves; before set_types by the attribute that it sets."""
    if hasattr(curves, "set_types"):
        curves.set_types(type="POLY")
        return
    kinds = curves.attributes.new("curve_type", "INT8", "CURVE")
    kinds.data.foreach_set("value", [1] * len(kinds.data))
    # Blender 4.2 goes on counting them as they were, and writes past the end of its arrays, until
    # curves are added: none will do.
    curves.add_curves([])


def add_geometry_socket(tree: bpy.types.GeometryNodeTree, way: str) -> None:
    """Gives a tree of Geometry Nodes a socket for a geometry; way is INPUT or OUTPUT."""
    kind = "NodeSocketGeometry"
    if hasattr(tree, "interface"):  # from 4.0 on
        tree.interface.new_socket(name="Geometry", in_out=way, socket_type=kind)
    else:
        (tree.inputs if way == "INPUT" else tree.outputs).new(kind, "Geometry")


def shape_key_points(key: bpy.types.ShapeKey) -> Any:
    """The points of a curve's shape key, of all its splines one after another.

    `points`, which 3.5 brought, is empty for splines of more than one kind.
    """
    return key.points if hasattr(key, "points") and len(key.points) else key.data


# The type of Grease Pencil objects, which 4.3 made anew.
GREASE_PENCIL = "GREASEPENCIL" if bpy.app.version >= (4, 3) else "GPENCIL"


def strokes_of_layer(layer: Any) -> list[tuple[np.ndarray, bool]] | None:
    """Points (n, 3) in the space of layer_matrices(), and whether it is cyclic, for each stroke of
    a Grease Pencil layer at the frame; None where one is no poly curve, as 4.3 and later have
    them."""
    if bpy.app.version < (4, 3):
        frame = layer.active_frame
        found = []
        for stroke in frame.strokes if frame is not None else ():
            points = column(stroke.points, "co", 3)
            found.append((points, stroke.use_cyclic))
        return found
    frame = layer.current_frame()
    drawing = frame.drawing if frame is not None else None
    if drawing is None or not len(drawing.strokes):
        return []
    if any(stroke.curve_type != 1 for stroke in drawing.strokes):
        return None
    offsets = column(drawing.curve_offsets, "value", kind=np.int32)
    points = column(drawing.attributes["position"].data, "vector", 3)
    cyclic = [stroke.cyclic for stroke in drawing.strokes]
    return list(zip(np.split(points, offsets[1:-1]), cyclic, strict=True))


def layer_matrices(layer: Any) -> tuple[np.ndarray, np.ndarray] | None:
    """Of a Grease Pencil layer: the inverse (4, 4) of its parent's matrix when that was chosen, and
    its own matrix (4, 4); None before 4.3, where evaluated strokes are in the object's space."""
    if bpy.app.version < (4, 3):
        return None
    inverse, own = (
        np.array([row[:] for row in matrix], dtype=np.float64)
        for matrix in (layer.matrix_parent_inverse, layer.matrix_local)
    )
    return inverse, own


def fcurves(owner: bpy.types.ID) -> list[bpy.types.FCurve]:
    """The animation curves of a data-block; 5.0 and later keep them in layers."""
    animation = owner.animation_data
    if hasattr(animation.action, "fcurves"):
        return list(animation.action.fcurves)
    strip = animation.action.layers[0].strips[0]
    return list(strip.channelbag(animation.action_slot).fcurves)


# ------------------------------------------------------------------------------------------------
# Node groups


def group_sockets(tree: bpy.types.NodeTree, direction: str) -> list[Any]:
    """What a group takes ("INPUT") or gives ("OUTPUT"): its sockets as its users see them.

    4.0 and later keep them in the group's interface.
    """
    if hasattr(tree, "interface"):
        return [
            item
            for item in tree.interface.items_tree
            if item.item_type == "SOCKET" and item.in_out == direction
        ]
    return list(tree.inputs if direction == "INPUT" else tree.outputs)


def input_place(modifier: bpy.types.NodesModifier, identifier: str) -> tuple[Any, str] | None:
    """What holds an input of a modifier's group, and the property's name there, as layouts want it.

    A custom property of the modifier up to 5.1, an item of its properties from 5.2 on. None where
    there is none, as for geometry.
    """
    if hasattr(modifier, "properties"):
        item = getattr(modifier.properties.inputs, identifier, None)
        return (item, "value") if hasattr(item, "value") else None
    return (modifier, f'["{identifier}"]') if identifier in modifier.keys() else None


def input_value(modifier: bpy.types.NodesModifier, identifier: str) -> Any:
    """The value of an input that has an input_place."""
    if hasattr(modifier, "properties"):
        return getattr(modifier.properties.inputs, identifier).value
    return modifier[identifier]


def set_input_value(modifier: bpy.types.NodesModifier, identifier: str, value: Any) -> None:
    """Sets an input that has an input_place; what depends on it follows."""
    if hasattr(modifier, "properties"):
        getattr(modifier.properties.inputs, identifier).value = value
    else:
        if isinstance(modifier[identifier], float):  # a whole number would make another property
            value = float(value)
        modifier[identifier] = value
        if bpy.app.version < (4, 0):
            # The property is then a new one: choosing the group brings limits and slider back.
            modifier.node_group = modifier.node_group
    modifier.id_data.update_tag()
