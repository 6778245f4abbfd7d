# SPDX-License-Identifier: GPL-3.0-or-later
"""Seeds made of a mesh's own edges: the selected ones, or those of its boundary."""

from __future__ import annotations

import bpy
import numpy as np

from ..model.geometry.chains import Chain, branching, chains_of
from .columns import column
from .curve_reader import has_strands
from .curve_writer import new_curve_object
from .errors import DataError
from .evaluated import surface_mesh
from .fillable import has_faces
from .linked_settings import settings_of
from .settings import surface_of


def new_seed(
    surface: bpy.types.Object, name: str, strands: list[tuple[np.ndarray, bool]]
) -> bpy.types.Object:
    """A curve object of poly splines, beside a surface and in its space, drawn in front of it:
    what is straight between two points of a surface runs below it.

    strands   points (n, 3) and whether the last one goes on to the first, a spline each
    """
    seed = new_curve_object(name, surface)
    seed.data.dimensions = "3D"
    seed.show_in_front = True
    for points, closed in strands:
        spline = seed.data.splines.new("POLY")
        spline.points.add(len(points) - 1)
        places = np.ones((len(points), 4), dtype=np.float32)
        places[:, :3] = points
        spline.points.foreach_set("co", places.ravel())
        spline.use_cyclic_u = closed
    return seed


def mesh_of_seed(
    curve: bpy.types.Object | None, scene: bpy.types.Scene
) -> bpy.types.Object | None:
    """The mesh of a scene of which a curve, or what else has strands, is the seed, a guide or a
    direction; None where there is none. Cheap, for panels: what was drawn on a mesh is its child.
    """
    if curve is None or not has_strands(curve) or surface_of(curve) is not None:
        return None
    parent = curve.parent
    if parent is not None and scene in parent.users_scene and _starts_from(parent, curve):
        return parent
    return next((thing for thing in scene.objects if _starts_from(thing, curve)), None)


def _starts_from(thing: bpy.types.Object, curve: bpy.types.Object) -> bool:
    if not has_faces(thing):
        return False
    settings = settings_of(thing)
    collection = settings.guide_collection
    return curve in (settings.seed, settings.guides, settings.alignment_strokes) or (
        collection is not None and curve in collection.all_objects[:]
    )


def strands_of_edges(
    surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph, branches: bool
) -> list[tuple[np.ndarray, bool]]:
    """The selected edges of a mesh as strands, in the surface's space.

    Call it after Edit Mode was left. Where modifiers leave the vertices what they are and only move
    them, the strands go where the edges are seen; else where they are without modifiers.

    branches   edges may branch, and strands end there

    Raises DataError with one sentence where none is selected, or where they branch.
    """
    edges = column(surface.data.edges, "vertices", 2, np.int32)
    edges = edges[column(surface.data.edges, "select", kind=bool)]
    if not len(edges):
        raise DataError("No edges are selected; select edges that form lines")
    forks = branching(edges)
    if len(forks) and not branches:
        places = "one vertex" if len(forks) == 1 else f"{len(forks)} vertices"
        raise DataError(
            f"The selected edges branch at {places}, and strands may not; deselect edges until no "
            "vertex has more than two, or use them as guides"
        )
    return _strands(chains_of(edges), _places(surface, depsgraph))


def strands_of_boundary(
    surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph, selected: bool
) -> list[tuple[np.ndarray, bool]]:
    """The boundary of a mesh as strands, in the surface's space.

    selected   only those boundaries that have a selected edge, if there is any; for calls after
               Edit Mode was left. Otherwise all of the mesh with its modifiers

    Raises DataError with one sentence for a mesh without boundary, and one that meets itself.
    """
    if selected:
        chosen = column(surface.data.edges, "select", kind=bool)
        edges, which = _boundary(surface.data)
        chains, places = _loops(edges, surface), _places(surface, depsgraph)
        marked = {tuple(pair) for pair in np.sort(edges[chosen[which]], axis=1).tolist()}
        if marked:
            chains = [chain for chain in chains if _sides(chain) & marked]
        return _strands(chains, places)
    with surface_mesh(surface, depsgraph) as (mesh, _matrix):
        edges, _which = _boundary(mesh)
        places = column(mesh.vertices, "co", 3)
    return _strands(_loops(edges, surface), places)


def _loops(edges: np.ndarray, surface: bpy.types.Object) -> list[Chain]:
    if not len(edges):
        raise DataError(f"'{surface.name}' has no boundary; select edges to start from instead")
    forks = branching(edges)
    if len(forks):
        places = "one vertex" if len(forks) == 1 else f"{len(forks)} vertices"
        raise DataError(
            f"The boundary of '{surface.name}' meets itself at {places}, and strands may not; "
            "select edges that do not"
        )
    return chains_of(edges)


def _sides(chain: Chain) -> set[tuple[int, int]]:
    ends = zip(chain.vertices, [*chain.vertices[1:], chain.vertices[0]])
    return {(min(a, b), max(a, b)) for a, b in ends}


def _strands(chains: list[Chain], places: np.ndarray) -> list[tuple[np.ndarray, bool]]:
    return [(places[chain.vertices], chain.closed) for chain in chains]


def _places(surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> np.ndarray:
    """Where the vertices of a mesh are seen, (n, 3) in its space; without modifiers where these
    change how many there are."""
    with surface_mesh(surface, depsgraph) as (mesh, _matrix):
        if len(mesh.vertices) == len(surface.data.vertices):
            return column(mesh.vertices, "co", 3)
    return column(surface.data.vertices, "co", 3)


def _boundary(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """The edges with one face, and their numbers."""
    sides = column(mesh.loops, "edge_index", kind=np.int32)
    which = np.flatnonzero(np.bincount(sides, minlength=len(mesh.edges)) == 1)
    return column(mesh.edges, "vertices", 2, np.int32)[which], which
