# SPDX-License-Identifier: GPL-3.0-or-later
"""The walls of a maze as a mesh object on its surface, and the way through it as a curve."""

from __future__ import annotations

import bpy
import numpy as np

from .. import core
from ..model.maze import Doors, wall, wall_pieces
from ..model.toolpaths.toolpath import resampled_by_tolerance, strand_of
from .curve_writer import new_curve_object, place_beside, write_splines
from .transforms import to_local

# In spacings: how near the walls are to the line, and how far apart their corners at least.
_TOLERANCE, _LEAST_STEP = 0.01, 0.02


def write_walls(
    name: str,
    cut: core.CutSurface,
    surface: bpy.types.Object,
    matrix: np.ndarray,
    spacing: float,
    sizes: tuple[float, float],
    doors: tuple[Doors | None, float],
) -> bpy.types.Object:
    """Makes walls along all strands of a cut, watertight, as a child of the surface.

    matrix   the surface's world matrix, whose units the cut and the sizes have
    sizes    width and height of the walls
    doors    where they are, and how wide; None: there are none
    """
    width, height = sizes
    normals = _normals(cut)
    vertices, faces, count = [], [], 0
    for strand, closed in enumerate(cut.closed):
        place = cut.line_vertices[cut.offsets[strand] : cut.offsets[strand + 1]]
        gaps = _gaps(cut, strand, *doors)
        pieces = [(cut.positions[place], normals[place], False)]
        if closed:
            pieces = wall_pieces(cut.positions[place], normals[place], gaps)
        for points, across, is_closed in pieces:
            thinned = _thinned(points, across, is_closed, spacing)
            if thinned is None:
                continue
            corners, sides = wall(*thinned, is_closed, width, height, width / 2.0)
            vertices.append(corners)
            faces.append(sides + count)
            count += len(corners)
    mesh = bpy.data.meshes.new(name)
    order = np.arange(4) if np.linalg.det(matrix[:3, :3]) > 0.0 else np.arange(4)[::-1]
    mesh.from_pydata(
        to_local(np.vstack(vertices), matrix).tolist(), [], np.vstack(faces)[:, order].tolist()
    )
    mesh.update()
    thing = bpy.data.objects.new(name, mesh)
    place_beside(thing, surface)
    thing.parent = surface
    return thing


def write_way(
    name: str,
    points: np.ndarray,
    surface: bpy.types.Object,
    matrix: np.ndarray,
    thickness: float,
) -> bpy.types.Object:
    """Makes a curve of the way through a maze, points (n, 3) in the world, as thick as a pen's
    line; a child of the surface. The thickness is in the surface's space."""
    thing = new_curve_object(name, surface)
    offsets = np.array([0, len(points)], dtype=np.uint32)
    up = np.zeros_like(points)
    line = core.Polylines(points, up, offsets, np.zeros(1, dtype=np.uint8))
    write_splines(thing.data, line, matrix)
    thing.data.bevel_depth = thickness
    return thing


def _gaps(
    cut: core.CutSurface, strand: int, doors: Doors | None, width: float
) -> list[tuple[float, float]]:
    if doors is None or strand != doors.strand:
        return []
    first = int(cut.offsets[strand])
    return [(float(cut.arc_lengths[first + place]), width) for place in (doors.first, doors.second)]


def _thinned(
    points: np.ndarray, normals: np.ndarray, closed: bool, spacing: float
) -> tuple[np.ndarray, np.ndarray] | None:
    """Without points that the wall does not need; None where too few are left."""
    strand = resampled_by_tolerance(strand_of(points, normals, closed), _TOLERANCE * spacing)
    points, normals = strand.points, strand.normals
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    kept = np.concatenate([[True], steps > _LEAST_STEP * spacing])
    if kept.sum() < (3 if closed else 2):
        return None
    return points[kept], normals[kept]


def _normals(cut: core.CutSurface) -> np.ndarray:
    """Of the cut's vertices, between those of the faces round each."""
    a, b, c = (cut.positions[cut.faces[:, corner]] for corner in range(3))
    of_faces = np.cross(b - a, c - a)
    found = np.zeros_like(cut.positions)
    for corner in range(3):
        np.add.at(found, cut.faces[:, corner], of_faces)
    lengths = np.linalg.norm(found, axis=1, keepdims=True)
    return np.divide(found, lengths, out=found, where=lengths > 0.0)
