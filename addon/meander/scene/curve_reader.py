# SPDX-License-Identifier: GPL-3.0-or-later
"""Curve objects, outlines of texts, meshes of edges and Grease Pencil, as strands: seeds, strokes,
guides and results."""

from __future__ import annotations

import bpy
import numpy as np

from .. import core
from ..model.geometry.chains import branching, chains_of
from .columns import column
from .errors import DataError
from .evaluated import evaluated_copy, is_evaluated, matrix_of, mesh_of
from .grease_pencil import is_grease_pencil, strokes_of
from .look import shaping_modifiers
from .transforms import to_world, world_matrix

# What a strand is called in the object that it is of.
_SPLINE, _STROKE, _CHAIN = "spline", "stroke", "chain"


def has_strands(object: bpy.types.Object) -> bool:
    """Whether an object can be read as strands: a curve, a text, Grease Pencil, or a mesh without
    faces. Cheap, for fields that choose one."""
    if object.type == "MESH":
        return not len(object.data.polygons)
    return object.type in ("CURVE", "FONT") or is_grease_pencil(object)


def strand_term(object: bpy.types.Object) -> str:
    """What a strand is called in the object that it is of, as users know it."""
    if object.type == "MESH":
        return _CHAIN
    return _STROKE if is_grease_pencil(object) else _SPLINE


def strands_of_curve(
    object: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
    fixed_ends: bool = False,
    of_data: bpy.types.Curve | None = None,
    branches: bool = False,
) -> core.Seed:
    """The strands of an object that has_strands() as a seed, in world units, in its own order.

    Of a curve its Bezier, NURBS and poly splines, open and cyclic, with modifiers, shape keys,
    parents and constraints; bevel, extrude, fill and the look of a result are left out. Of a text
    the outlines of its letters, of a mesh the chains and loops of its edges with its modifiers, of
    Grease Pencil the strokes that it shows. Works in Edit Mode and for hidden objects.

    fixed_ends   the first and last point of every open strand never move
    of_data      poly splines in the space of the object, to be read in place of its own
    branches     edges may branch, and strands end there, as guides may

    Raises DataError with one sentence for what has no strands, has no segments, or branches.
    """
    if not has_strands(object):
        what = "has faces" if object.type == "MESH" else "is not a curve"
        raise DataError(
            f"'{object.name}' {what}; choose a curve, a text, Grease Pencil or a mesh of edges "
            "without faces"
        )
    if object.mode == "EDIT" and not is_grease_pencil(object):
        object.update_from_editmode()
    if is_grease_pencil(object):
        points, offsets, closed = _put_together(strokes_of(object, depsgraph))
        matrix = np.eye(4)
    elif of_data is not None:
        points, offsets, closed = _poly_splines(of_data)
        matrix = matrix_of(object, depsgraph)
    elif _is_plain(object) and (
        object.data.animation_data is None or is_evaluated(object, depsgraph)
    ):
        points, offsets, closed = _poly_splines(object.data)
        matrix = matrix_of(object, depsgraph)
    else:
        points, edges, matrix = _evaluated_edges(object, depsgraph)
        points, offsets, closed = _chains(points, edges, object.name, branches)
    if not len(closed):
        raise _nothing_in(object)
    fixed = ends_of(offsets, closed) if fixed_ends else None
    return core.Seed(
        points=np.ascontiguousarray(to_world(points, matrix)),
        offsets=offsets.astype(np.uint32),
        closed=closed.astype(np.uint8),
        fixed=fixed,
    )


def _nothing_in(object: bpy.types.Object) -> DataError:
    term = strand_term(object)
    if term == _CHAIN:
        return DataError(f"'{object.name}' has no edges; add some, or choose another seed")
    if term == _STROKE:
        return DataError(
            f"'{object.name}' shows no stroke of two or more points at this frame; draw one, show "
            "its layer, or go to a frame that has one"
        )
    return DataError(
        f"'{object.name}' has no spline with two or more points; draw a curve to start from"
    )


def point_numbers(object: bpy.types.Object, seed: core.Seed) -> np.ndarray | None:
    """Which point of its spline each point of a curve's strands is, counted from 1: that control
    point which is nearest to it.

    seed   of strands_of_curve()

    None where the strands have the points of the splines, where modifiers make others of them, and
    for what has no splines.
    """
    if strand_term(object) != _SPLINE:
        return None
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
        points[begin:end] = column(spline.points, "co", 4)
    closed = np.array([spline.use_cyclic_u for spline in strands], dtype=bool)
    return points[:, :3], offsets, closed


def _put_together(
    strokes: list[tuple[np.ndarray, bool]],
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    offsets = np.cumsum([0] + [len(points) for points, _closed in strokes])
    points = np.vstack([np.empty((0, 3)), *(points for points, _closed in strokes)])
    return points, offsets, np.array([closed for _points, closed in strokes], dtype=bool)


def _evaluated_edges(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points and edges of the evaluated object without thickness, and its world matrix."""
    if object.type == "MESH":
        if is_evaluated(object, depsgraph):
            depsgraph.update()
            return _edges_of(object, depsgraph, object.name)
        with evaluated_copy(object, depsgraph, with_data=False) as (copy, own):
            return _edges_of(copy, own, object.name)
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
        return _edges_of(copy, own, object.name)


def _edges_of(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph, name: str
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    with mesh_of(object, depsgraph) as (mesh, matrix):
        if len(mesh.polygons):
            raise DataError(
                f"The modifiers of '{name}' turn it into a surface; choose a curve without them as "
                "the seed"
            )
        points = column(mesh.vertices, "co", 3)
        edges = column(mesh.edges, "vertices", 2, np.int32)
    return points, edges, matrix


def _chains(
    points: np.ndarray, edges: np.ndarray, name: str, branches: bool
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Orders the points along the chains that the edges form; lone points are left out."""
    if len(branching(edges)) and not branches:
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
