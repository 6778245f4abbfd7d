# SPDX-License-Identifier: GPL-3.0-or-later
"""Curve objects, and the outlines of texts, as strands: seeds, strokes, guides and results."""

from __future__ import annotations

import bpy
import numpy as np

from .. import core
from ..model.geometry.chains import branching, chains_of
from .errors import DataError
from .evaluated import evaluated_copy, is_evaluated, matrix_of, mesh_of
from .look import shaping_modifiers
from .transforms import to_world, world_matrix


def has_strands(object: bpy.types.Object) -> bool:
    """Whether an object can be read as strands. Cheap, for fields that choose one."""
    return object.type in ("CURVE", "FONT")


def strands_of_curve(
    object: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
    fixed_ends: bool = False,
    of_data: bpy.types.Curve | None = None,
) -> core.Seed:
    """The strands of a curve object as a seed, in world units, in the order of its splines.

    Bezier, NURBS and poly splines, open and cyclic, with modifiers, shape keys, parents and
    constraints; bevel, extrude, fill and the look of a result are left out. Of a text the outlines
    of its letters. Works in Edit Mode and for hidden objects.

    fixed_ends   the first and last point of every open strand never move
    of_data      poly splines in the space of the object, to be read in place of its own

    Raises DataError with one sentence for what is not a curve, has no segments, or branches.
    """
    if not has_strands(object):
        raise DataError(f"'{object.name}' is not a curve; choose a curve object as the seed")
    if object.mode == "EDIT":
        object.update_from_editmode()
    if of_data is not None:
        points, offsets, closed = _poly_splines(of_data)
        matrix = matrix_of(object, depsgraph)
    elif _is_plain(object) and (
        object.data.animation_data is None or is_evaluated(object, depsgraph)
    ):
        points, offsets, closed = _poly_splines(object.data)
        matrix = matrix_of(object, depsgraph)
    else:
        points, edges, matrix = _evaluated_edges(object, depsgraph)
        points, offsets, closed = _chains(points, edges, object.name)
    if not len(closed):
        raise DataError(
            f"'{object.name}' has no spline with two or more points; draw a curve to start from"
        )
    fixed = ends_of(offsets, closed) if fixed_ends else None
    return core.Seed(
        points=np.ascontiguousarray(to_world(points, matrix)),
        offsets=offsets.astype(np.uint32),
        closed=closed.astype(np.uint8),
        fixed=fixed,
    )


def point_numbers(object: bpy.types.Object, seed: core.Seed) -> np.ndarray | None:
    """Which point of its spline each point of a curve's strands is, counted from 1: that control
    point which is nearest to it.

    seed   of strands_of_curve()

    None where the strands have the points of the splines, and where modifiers make others of them.
    """
    splines = [spline for spline in object.data.splines if _count(spline) > 1]
    if _is_plain(object) or len(splines) != len(seed.closed):
        return None
    numbers = []
    for spline, begin, end in zip(splines, seed.offsets[:-1], seed.offsets[1:], strict=True):
        points = spline.bezier_points if spline.type == "BEZIER" else spline.points
        controls = np.array([point.co[:3] for point in points])
        places = to_world(controls, world_matrix(object))
        numbers += [
            int(((places - point) ** 2).sum(axis=1).argmin()) + 1
            for point in seed.points[begin:end]
        ]
    return np.array(numbers, dtype=np.int64)


def _count(spline: bpy.types.Spline) -> int:
    return len(spline.points) + len(spline.bezier_points)


def _is_plain(object: bpy.types.Object) -> bool:
    """Whether the points of the splines are the curve: nothing to evaluate, so no copy needed."""
    return (
        object.type == "CURVE"
        and not shaping_modifiers(object)
        and object.data.shape_keys is None
        and all(spline.type == "POLY" for spline in object.data.splines)
    )


def _poly_splines(curve: bpy.types.Curve) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    strands = [spline for spline in curve.splines if len(spline.points) > 1]
    offsets = np.cumsum([0] + [len(spline.points) for spline in strands])
    points = np.empty((offsets[-1], 4), dtype=np.float32)
    for spline, begin, end in zip(strands, offsets[:-1], offsets[1:], strict=True):
        buffer = np.empty(4 * (end - begin), dtype=np.float32)
        spline.points.foreach_get("co", buffer)
        points[begin:end] = buffer.reshape(-1, 4)
    closed = np.array([spline.use_cyclic_u for spline in strands], dtype=bool)
    return points[:, :3], offsets, closed


def _evaluated_edges(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points and edges of the evaluated curve without thickness, and its world matrix."""
    with evaluated_copy(object, depsgraph, with_data=True) as (copy, own):
        shaping = {modifier.name for modifier in shaping_modifiers(copy)}
        for modifier in [each for each in copy.modifiers if each.name not in shaping]:
            copy.modifiers.remove(modifier)
        curve = copy.data
        curve.bevel_depth = 0.0
        curve.bevel_object = None
        curve.extrude = 0.0
        if curve.dimensions == "2D":
            curve.fill_mode = "NONE"
        curve.update_tag()
        own.update()
        with mesh_of(copy, own) as (mesh, matrix):
            if len(mesh.polygons):
                raise DataError(
                    f"The modifiers of '{object.name}' turn it into a surface; "
                    "choose a curve without them as the seed"
                )
            points = np.empty(3 * len(mesh.vertices), dtype=np.float32)
            mesh.vertices.foreach_get("co", points)
            edges = np.empty(2 * len(mesh.edges), dtype=np.int32)
            mesh.edges.foreach_get("vertices", edges)
    return points.reshape(-1, 3), edges.reshape(-1, 2), matrix


def _chains(
    points: np.ndarray, edges: np.ndarray, name: str
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Orders the points along the chains that the edges form; lone points are left out."""
    if len(branching(edges)):
        raise DataError(f"'{name}' branches; choose a curve of simple strands as the seed")
    # Blender numbers the points spline after spline: the least index tells the order.
    chains = chains_of(edges)
    order = [vertex for chain in chains for vertex in chain.vertices]
    offsets = np.cumsum([0] + [len(chain.vertices) for chain in chains])
    closed = np.array([chain.closed for chain in chains], dtype=bool)
    return points[order], offsets, closed


def ends_of(offsets: np.ndarray, closed: np.ndarray) -> np.ndarray:
    """Which points, (n,) uint8, are the first or the last of an open strand."""
    fixed = np.zeros(int(offsets[-1]), dtype=np.uint8)
    for begin, end, is_closed in zip(offsets[:-1], offsets[1:], closed, strict=True):
        if not is_closed:
            fixed[[begin, end - 1]] = 1
    return fixed
