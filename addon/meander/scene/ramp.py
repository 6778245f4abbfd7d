# SPDX-License-Identifier: GPL-3.0-or-later
"""A ramp that is shaped by hand: Blender's curve widget, and the stops that it stands for.

Blender gives add-ons no curve property. The widget can show the curve of a node, so every object
that wants one has a node group of its own that holds a Float Curve and is used for nothing else.
"""

from __future__ import annotations

import bpy
import numpy as np

from ..model.density import Stops

# The dot keeps it out of Blender's lists.
_NAME = ".Meander Ramp"
# The least number of stops: the widget's curves are smooth.
_SAMPLES = 65


def new_ramp() -> bpy.types.NodeTree:
    """A node group with the curve from (0, 0) to (1, 1)."""
    tree = bpy.data.node_groups.new(_NAME, "ShaderNodeTree")
    tree.nodes.new("ShaderNodeFloatCurve")
    return tree


def node_of(tree: bpy.types.NodeTree | None) -> bpy.types.Node | None:
    """The node whose curve is the ramp; None where somebody has taken it away."""
    if tree is None:
        return None
    found = (node for node in tree.nodes if node.bl_idname == "ShaderNodeFloatCurve")
    return next(found, None)


def stops_of(tree: bpy.types.NodeTree | None) -> Stops:
    """What the widget shows, as stops between which the ramp is straight; () without a curve."""
    node = node_of(tree)
    if node is None:
        return ()
    mapping = node.mapping
    mapping.initialize()
    curve = mapping.curves[0]
    shares = np.linspace(0.0, 1.0, _SAMPLES).tolist()
    shares += [point.location.x for point in curve.points if 0.0 < point.location.x < 1.0]
    shares = sorted({round(share, 6) for share in shares})
    heights = [mapping.evaluate(curve, share) for share in shares]
    return tuple(
        (share, min(max(float(height), 0.0), 1.0)) for share, height in zip(shares, heights)
    )


def ramp_of(stops: Stops) -> bpy.types.NodeTree:
    """A node group whose curve goes straight from stop to stop."""
    tree = new_ramp()
    mapping = node_of(tree).mapping
    points = mapping.curves[0].points
    while len(points) < len(stops):
        points.new(0.5, 0.5)
    while len(points) > len(stops):
        points.remove(points[-2])
    for point, (share, height) in zip(points, stops):
        point.location = (share, height)
        point.handle_type = "VECTOR"
    mapping.update()
    return tree
