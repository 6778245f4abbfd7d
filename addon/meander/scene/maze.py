# SPDX-License-Identifier: GPL-3.0-or-later
"""The walls of a maze as a mesh object on its surface, and the way through it as a curve."""

from __future__ import annotations

import math
from collections.abc import Iterator

import bmesh
import bpy
import numpy as np

from .. import core
from ..model.maze import Doors
from ..model.toolpaths.toolpath import resampled_by_tolerance, strand_of
from ..model.walls import bar_pieces, wall, wall_pieces
from .blender_versions import keep_custom_normals
from .curve_writer import new_curve_object, place_beside, write_splines
from .transforms import to_local

# In spacings: how near the walls are to the line, and how far apart their corners at least.
_TOLERANCE, _LEAST_STEP = 0.002, 0.02
# Bars end in other walls and are a little lower, so that no faces lie in one plane.
_BAR = 0.98
# A wall's sides are shaded as round where they turn by less, and its edges sharp.
_SHARP = math.radians(40.0)


def write_walls(
    name: str,
    cut: core.CutSurface,
    drawn: core.Polylines,
    surface: bpy.types.Object,
    matrix: np.ndarray,
    spacing: float,
    sizes: tuple[float, float],
    doors: tuple[Doors | None, float],
) -> bpy.types.Object:
    """Makes walls along all strands of a cut, watertight, as a child of the surface.

    drawn    the lines of the walls: the strands of the curve with round turns
    matrix   the surface's world matrix, whose units the cut, the lines and the sizes have
    sizes    width and height of the walls
    doors    where they are, and how wide; None: there are none
    """
    width, height = sizes
    vertices, faces, count = [], [], 0
    for points, across, closed, share in _pieces(cut, drawn, *doors):
        thinned = _thinned(points, across, closed, spacing)
        if thinned is None:
            continue
        corners, sides = wall(*thinned, closed, width, share * height, share * width / 2.0)
        vertices.append(corners)
        faces.append(sides + count)
        count += len(corners)
    mesh = bpy.data.meshes.new(name)
    order = np.arange(4) if np.linalg.det(matrix[:3, :3]) > 0.0 else np.arange(4)[::-1]
    mesh.from_pydata(
        to_local(np.vstack(vertices), matrix).tolist(), [], np.vstack(faces)[:, order].tolist()
    )
    _shade(mesh)
    mesh.update()
    thing = bpy.data.objects.new(name, mesh)
    place_beside(thing, surface)
    thing.parent = surface
    return thing


def _shade(mesh: bpy.types.Mesh) -> None:
    """Round where a wall bends, sharp at its edges."""
    edges = bmesh.new()
    edges.from_mesh(mesh)
    sharp = [edge.calc_face_angle(math.pi) > _SHARP for edge in edges.edges]
    edges.free()
    mesh.edges.foreach_set("use_edge_sharp", sharp)
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), dtype=bool))
    keep_custom_normals(mesh, math.pi)


def _pieces(
    cut: core.CutSurface, drawn: core.Polylines, doors: Doors | None, width: float
) -> Iterator[tuple[np.ndarray, np.ndarray, bool, float]]:
    """Points, normals, whether it is closed, and what it has of the height, of each wall."""
    for strand, number in enumerate(cut.line_strands):
        piece = slice(int(drawn.offsets[number]), int(drawn.offsets[number + 1]))
        points, normals = drawn.positions[piece], drawn.normals[piece]
        if not cut.closed[strand]:
            yield points, normals, False, 1.0
        elif doors is None or strand != doors.strand:
            yield points, normals, True, 1.0
        else:
            line = cut.positions[cut.line_vertices[cut.offsets[strand] : cut.offsets[strand + 1]]]
            gaps = [(_place(points, line[gap]), width) for gap in doors.gaps]
            yield from ((*piece, 1.0) for piece in wall_pieces(points, normals, gaps))
            for first, last, opened in doors.bars:
                ends = [
                    int(np.argmin(np.linalg.norm(points - line[end], axis=1)))
                    for end in (first, last)
                ]
                bar = bar_pieces(points[ends], normals[ends], width if opened else 0.0)
                yield from ((*piece, _BAR) for piece in bar)


def _place(points: np.ndarray, place: np.ndarray) -> float:
    """The arc length of the point that is nearest to a place."""
    nearest = int(np.argmin(np.linalg.norm(points - place, axis=1)))
    return float(np.linalg.norm(np.diff(points[: nearest + 1], axis=0), axis=1).sum())


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
