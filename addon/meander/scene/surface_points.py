# SPDX-License-Identifier: GPL-3.0-or-later
"""Points on a surface: the triangle that holds each, and the points of a result, with normals."""

from __future__ import annotations

from collections.abc import Callable

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from .. import core
from ..model.geometry.surface_normals import normals_at
from ..model.toolpaths import toolpath
from . import points as point_attributes
from .curve_reader import strands_of_curve
from .evaluated import matrix_of
from .meshes import triangles_of

# The squared sine of the angle at a corner below which rounding leaves nothing of a triangle.
_LINE = 1e-12


def bind(
    points: np.ndarray, vertices: np.ndarray, faces: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """For each point the nearest triangle and the weights of its corners there."""
    return nearest_on(vertices, faces)(points)


def farthest(points: np.ndarray, vertices: np.ndarray, faces: np.ndarray) -> float:
    """How far the points (n, 3) are from triangles, at most."""
    tree = BVHTree.FromPolygons(vertices.tolist(), faces.tolist())
    return max(tree.find_nearest(point)[3] for point in points.tolist())


def nearest_on(
    vertices: np.ndarray, faces: np.ndarray
) -> Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]:
    """What bind() does, for points that come later. Triangles that are a line hold none."""
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    u, v = b - a, c - a
    longest = (u * u).sum(1) * (v * v).sum(1)
    usable = np.flatnonzero(longest - (u * v).sum(1) ** 2 > _LINE * longest)
    tree = BVHTree.FromPolygons(vertices.tolist(), faces[usable].tolist())

    def bound(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        index, weights = _bound(points, tree, vertices, faces[usable])
        return usable[index], weights

    return bound


def _bound(
    points: np.ndarray, tree: BVHTree, vertices: np.ndarray, faces: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    index = np.array([tree.find_nearest(point)[2] for point in points.tolist()], dtype=np.int64)
    a, b, c = (vertices[faces[index, corner]] for corner in range(3))
    u, v, w = b - a, c - a, points - a
    uu, uv, vv = (u * u).sum(1), (u * v).sum(1), (v * v).sum(1)
    wu, wv = (w * u).sum(1), (w * v).sum(1)
    determinant = uu * vv - uv * uv
    second = (vv * wu - uv * wv) / determinant
    third = (uu * wv - uv * wu) / determinant
    weights = np.clip(np.column_stack([1.0 - second - third, second, third]), 0.0, 1.0)
    return index, weights / weights.sum(axis=1, keepdims=True)


def polylines_of(
    result: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> tuple[core.Polylines, np.ndarray, np.ndarray]:
    """A result's strands in world units with normals of the surface, and for every point the
    triangle of the surface that holds it and the weights of its corners.

    Raises DataError with one sentence for what cannot be used.
    """
    strands = strands_of_curve(result, depsgraph)
    vertices, faces = triangles_of(result.meander.surface, depsgraph)
    index, weights = bind(strands.points, vertices, faces)
    spacing = result.meander.figures.least_spacing or result.meander.spacing
    normals = normals_at(vertices, faces, index, weights, spacing / 2.0)
    curve = core.Polylines(strands.points, normals, strands.offsets, strands.closed)
    return curve, index, weights


def strands_of_result(
    result: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> list[toolpath.Strand]:
    """A result's strands with all that is known of them. Raises DataError."""
    curve, index, weights = polylines_of(result, depsgraph)
    matrix = matrix_of(result.meander.surface, depsgraph)
    radii = point_attributes.medial_radii_of(result, len(curve.positions), matrix)
    return toolpath.strands_of(curve, point_attributes.data_of(index, weights, radii))
