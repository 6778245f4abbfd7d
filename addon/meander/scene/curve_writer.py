# SPDX-License-Identifier: GPL-3.0-or-later
"""Polylines as curve objects.

Curves are written into the surface's own space, so that they follow its transform.
"""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import numpy as np

from .. import core
from ..model.geometry.blocks import blocks
from .transforms import mean_scale, to_local, world_matrix


def write_curve(
    polylines: core.Polylines,
    surface_object: bpy.types.Object,
    name: str,
    curve_object: bpy.types.Object | None = None,
    matrix: np.ndarray | None = None,
    bevel_depth: float = 0.0,
) -> bpy.types.Object:
    """Writes polylines (world units) as a curve object of poly splines on a surface object.

    The curve becomes a child of the surface without a transform of its own, with its points in the
    surface's space: it follows every transform, shear included, and its world positions are exact
    to float32. Strands keep their order; closed ones are cyclic.

    curve_object   the curve to rewrite, which keeps its looks; None makes a new one beside the
                   surface, in its collection
    matrix         the surface's world matrix when the polylines were made; None: as it is now
    bevel_depth    radius of the round bevel of a new one in world units; 0: a bare curve
    """
    if matrix is None:
        matrix = world_matrix(surface_object)
    if curve_object is None:
        curve_object = new_curve_object(name, surface_object)
        _give_looks(curve_object.data, bevel_depth / mean_scale(matrix))
    write_splines(curve_object.data, polylines, matrix)
    return curve_object


def _give_looks(curve: bpy.types.Curve, bevel_depth: float) -> None:
    """What a new curve looks like; from then on that is its user's.

    The bevel lives in the surface's space, where it is scaled along with everything else.
    """
    curve.dimensions = "3D"  # first, since flat curves have other fill modes
    curve.fill_mode = "FULL"
    curve.use_fill_caps = True
    curve.use_path = False  # else each update measures the whole curve for an animation
    curve.bevel_resolution = 2
    curve.bevel_depth = bevel_depth


def new_curve_object(name: str, surface_object: bpy.types.Object) -> bpy.types.Object:
    """An empty curve object beside the surface: its child, with no transform of its own."""
    curve_object = bpy.data.objects.new(name, bpy.data.curves.new(name, "CURVE"))
    place_beside(curve_object, surface_object)
    curve_object.parent = surface_object
    if surface_object.type == "CURVE" and surface_object.data.use_path:
        # Such a parent carries its children along its path, to where it is in this frame.
        bpy.context.view_layer.update()
        carried = curve_object.matrix_world.inverted_safe() @ surface_object.matrix_world
        curve_object.matrix_parent_inverse = carried
    return curve_object


def write_splines(curve: bpy.types.Curve, polylines: core.Polylines, matrix: np.ndarray) -> None:
    """Replaces the splines of a curve by polylines, in the space of `matrix`, and nothing else."""
    curve.dimensions = "3D"
    # What can go wrong comes first: the curve keeps its splines until there are new ones.
    points = np.ones((len(polylines.positions), 4), dtype=np.float32)
    for begin, end in blocks(len(points)):
        points[begin:end, :3] = to_local(polylines.positions[begin:end], matrix)
    offsets = np.asarray(polylines.offsets, dtype=np.int64)
    strands = list(zip(offsets[:-1], offsets[1:], polylines.closed, strict=True))
    curve.splines.clear()
    for begin, end, closed in strands:
        spline = curve.splines.new("POLY")
        spline.points.add(int(end - begin) - 1)
        spline.points.foreach_set("co", points[begin:end].ravel())
        spline.use_cyclic_u = bool(closed)
    curve.update_tag()


def place_beside(thing: bpy.types.Object, other: bpy.types.Object) -> None:
    """Links a new object where another is: into its first collection that can be changed and is
    in the view layer, else into that of the scene; and into the local views that show the other.
    """
    view_layer = bpy.context.view_layer
    shown = [layer.collection for layer in _included(view_layer.layer_collection)]
    own = (one for one in other.users_collection if one.library is None and one in shown)
    next(own, bpy.context.scene.collection).objects.link(thing)
    window = bpy.context.window
    shows_it = window is not None and window.scene == bpy.context.scene
    for area in window.screen.areas if shows_it else ():
        space = area.spaces.active
        if area.type == "VIEW_3D" and space.local_view is not None:
            if view_layer.objects.get(other.name) == other and other.local_view_get(space):
                thing.local_view_set(space, True)


def _included(
    layer: bpy.types.LayerCollection,
) -> Iterator[bpy.types.LayerCollection]:
    """A collection of a view layer and those in it, without those that are excluded."""
    if not layer.exclude:
        yield layer
    for child in layer.children:
        yield from _included(child)
