# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender data in and out: meshes, weights and curves as arrays, and arrays as a curve object.

Everything leaves here in world units, because the spacing that a user chooses is the one that he
sees; curves are written back into the surface's own space, so that they follow its transform.
Arrays are computed in float64; only what is stored in Blender is rounded to float32.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import numpy as np

from . import core


class DataError(ValueError):
    """Something in the scene cannot be used; str() is one sentence for people."""


# ------------------------------------------------------------------------------------------------
# Transforms


def world_matrix(object: bpy.types.Object) -> np.ndarray:
    """The object's matrix_world as float64 (4, 4).

    Row by row, since np.array(matrix) is float32 in Blender 5.0 and later.
    """
    return np.array([row[:] for row in object.matrix_world], dtype=np.float64)


def to_world(points: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """Local points (n, 3) to world, in float64."""
    return np.asarray(points, dtype=np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def to_local(points: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """World points (n, 3) to the space of `matrix`, in float64."""
    return np.linalg.solve(matrix[:3, :3], (np.asarray(points) - matrix[:3, 3]).T).T


def mean_scale(matrix: np.ndarray) -> float:
    """By how much the matrix enlarges lengths, averaged over the three axes."""
    return float(abs(np.linalg.det(matrix[:3, :3])) ** (1.0 / 3.0))


def _check_invertible(object: bpy.types.Object, matrix: np.ndarray) -> None:
    # Condition number, not determinant: a mesh in micrometres is fine, a flattened one is not.
    if not np.isfinite(matrix).all() or np.linalg.cond(matrix[:3, :3]) > 1e6:
        raise DataError(
            f"'{object.name}' is scaled to nothing along an axis; give it a scale other than 0"
        )


# ------------------------------------------------------------------------------------------------
# Evaluated meshes


@contextmanager
def _linked_copy(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph, with_data: bool
) -> Iterator[bpy.types.Object]:
    """A visible copy of the object in the scene for as long as the block lasts.

    Only objects that the dependency graph shows are evaluated, and an evaluated curve can only be
    changed through a copy.
    """
    copy = object.copy()
    data = None
    try:
        if with_data:
            data = object.data.copy()
            copy.data = data
        copy.hide_viewport = False
        depsgraph.scene.collection.objects.link(copy)
        yield copy
    finally:
        bpy.data.objects.remove(copy)
        if data is not None:
            bpy.data.batch_remove([data])
        depsgraph.update()


@contextmanager
def _mesh_of(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Iterator[tuple[bpy.types.Mesh, np.ndarray]]:
    """The evaluated object's mesh and its world matrix; the mesh is freed after the block."""
    evaluated = object.evaluated_get(depsgraph)
    try:
        mesh = evaluated.to_mesh()
    except RuntimeError as error:
        raise DataError(f"'{object.name}' cannot be turned into a mesh: {error}") from error
    try:
        yield mesh, world_matrix(evaluated)
    finally:
        evaluated.to_mesh_clear()


@contextmanager
def surface_mesh(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> Iterator[tuple[bpy.types.Mesh, np.ndarray]]:
    """The evaluated mesh of a surface and its world matrix, freed after the block.

    Works in Edit Mode and for hidden objects. Raises DataError for what is not a mesh.
    """
    if object.type != "MESH":
        raise DataError(f"'{object.name}' is not a mesh; choose a mesh object as the surface")
    if object.mode == "EDIT":
        object.update_from_editmode()
    if object.visible_get(view_layer=depsgraph.view_layer):
        depsgraph.update()
        with _mesh_of(object, depsgraph) as result:
            yield result
    else:
        with _linked_copy(object, depsgraph, with_data=False) as copy:
            depsgraph.update()
            with _mesh_of(copy, depsgraph) as result:
                yield result


def triangles_of(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> tuple[np.ndarray, np.ndarray]:
    """The triangles of a mesh object as the user sees it: modifiers applied, in world units.

    Works in Edit Mode and for hidden objects. Where the transform mirrors, faces are turned round,
    so that they look outward as Blender shows them.

    Returns vertices float64 (n, 3) and faces uint32 (m, 3). Raises DataError (a ValueError) with
    one sentence for what is not a mesh, has no faces, or is scaled to nothing.
    """
    with surface_mesh(object, depsgraph) as (mesh, matrix):
        _check_invertible(object, matrix)
        mesh.calc_loop_triangles()
        # float32 as stored: asking for float64 converts one value at a time.
        coordinates = np.empty(3 * len(mesh.vertices), dtype=np.float32)
        mesh.vertices.foreach_get("co", coordinates)
        indices = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
        mesh.loop_triangles.foreach_get("vertices", indices)
    if not len(indices):
        raise DataError(f"'{object.name}' has no faces; choose a mesh with faces as the surface")
    faces = indices.reshape(-1, 3).astype(np.uint32)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        faces = np.ascontiguousarray(faces[:, ::-1])
    return to_world(coordinates.reshape(-1, 3), matrix), faces


def in_polygons(
    error: core.MeanderError, object: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> core.MeanderError:
    """An error about a mesh with its faces named as Blender counts them; others as they are.

    The library knows triangles only; a user sees polygons, of the mesh with its modifiers.
    """
    if error.status != core.Status.INVALID_MESH:
        return error
    with surface_mesh(object, depsgraph) as (mesh, _matrix):
        mesh.calc_loop_triangles()
        polygons = np.empty(len(mesh.loop_triangles), dtype=np.int32)
        mesh.loop_triangles.foreach_get("polygon_index", polygons)

    def named(match: re.Match[str]) -> str:
        return re.sub(r"\d+", lambda number: str(polygons[int(number[0])]), match[0])

    # "face 3", and "3 faces (0, 1, 2)": numbers of faces, not of vertices, and not how many.
    text = re.sub(r"(?<=[Ff]ace )\d+|(?<=faces \()[\d, ]+", named, str(error))
    return core.MeanderError(text, error.status, error.element_kind, error.elements)


def vertex_group_weights(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph, name: str
) -> np.ndarray:
    """The weights of a vertex group on the evaluated mesh, float64, 0 where a vertex is not in it.

    The order is that of the vertices of triangles_of(). A group that a Geometry Nodes modifier has
    turned into a named float attribute is found as well. Raises DataError for an unknown name.
    """
    with surface_mesh(object, depsgraph) as (mesh, _matrix):
        count = len(mesh.vertices)
        attribute = mesh.attributes.get(name)
        if attribute is not None and (attribute.domain, attribute.data_type) == ("POINT", "FLOAT"):
            values = np.empty(count, dtype=np.float32)
            attribute.data.foreach_get("value", values)
            return values.astype(np.float64)
        group = object.vertex_groups.get(name)
        if group is None:
            known = ", ".join(f"'{other.name}'" for other in object.vertex_groups)
            raise DataError(
                f"'{object.name}' has no vertex group '{name}'; "
                + (f"it has {known}" if known else "paint one, or leave the field empty")
            )
        index = group.index
        weights = np.zeros(count, dtype=np.float64)
        for position, vertex in enumerate(mesh.vertices):
            for element in vertex.groups:
                if element.group == index:
                    weights[position] = element.weight
        return weights


def area_of(vertices: np.ndarray, faces: np.ndarray) -> float:
    """The area of triangles, in square units of the vertices."""
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0)


def proposed_spacing(vertices: np.ndarray, faces: np.ndarray) -> float:
    """A spacing that shows the shape and takes seconds: 1/30 of the side of a square of the same
    area, rounded to two digits."""
    spacing = np.sqrt(area_of(vertices, faces)) / 30.0
    return float(f"{spacing:.1e}")


# ------------------------------------------------------------------------------------------------
# Curves in


def strands_of_curve(
    object: bpy.types.Object, depsgraph: bpy.types.Depsgraph, fixed_ends: bool = False
) -> core.Seed:
    """The strands of a curve object as a seed, in world units, in the order of its splines.

    Bezier, NURBS and poly splines, open and cyclic, with modifiers, shape keys, parents and
    constraints; bevel, extrude and fill are left out. Works in Edit Mode and for hidden objects.

    fixed_ends   the first and last point of every open strand never move

    Raises DataError with one sentence for what is not a curve, has no segments, or branches.
    """
    if object.type != "CURVE":
        raise DataError(f"'{object.name}' is not a curve; choose a curve object as the seed")
    if object.mode == "EDIT":
        object.update_from_editmode()
    if _is_plain(object):
        points, offsets, closed = _poly_splines(object.data)
        matrix = world_matrix(object)
    else:
        points, edges, matrix = _evaluated_edges(object, depsgraph)
        points, offsets, closed = _chains(points, edges, object.name)
    if not len(closed):
        raise DataError(
            f"'{object.name}' has no spline with two or more points; draw a curve to start from"
        )
    fixed = _ends(offsets, closed) if fixed_ends else None
    return core.Seed(
        points=np.ascontiguousarray(to_world(points, matrix)),
        offsets=offsets.astype(np.uint32),
        closed=closed.astype(np.uint8),
        fixed=fixed,
    )


def _is_plain(object: bpy.types.Object) -> bool:
    """Whether the points of the splines are the curve: nothing to evaluate, so no copy needed."""
    return (
        not object.modifiers
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
    with _linked_copy(object, depsgraph, with_data=True) as copy:
        curve = copy.data
        curve.bevel_depth = 0.0
        curve.bevel_object = None
        curve.extrude = 0.0
        if curve.dimensions == "2D":
            curve.fill_mode = "NONE"
        depsgraph.update()
        with _mesh_of(copy, depsgraph) as (mesh, matrix):
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
    neighbours: dict[int, list[int]] = {}
    for a, b in edges.tolist():
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    if any(len(others) > 2 for others in neighbours.values()):
        raise DataError(f"'{name}' branches; choose a curve of simple strands as the seed")
    chains: list[tuple[int, list[int], bool]] = []
    visited: set[int] = set()
    # Ends first: what is then left over is closed.
    ends = [vertex for vertex, others in neighbours.items() if len(others) == 1]
    for start in ends + list(neighbours):
        if start in visited:
            continue
        visited.add(start)
        chain = [start]
        while True:
            following = [n for n in neighbours[chain[-1]] if n not in visited]
            if not following:
                break
            visited.add(following[0])
            chain.append(following[0])
        chains.append((min(chain), chain, len(neighbours[start]) == 2))
    # Blender numbers the points spline after spline: the least index tells the order.
    chains.sort(key=lambda entry: entry[0])
    order = [vertex for _least, chain, _closed in chains for vertex in chain]
    offsets = np.cumsum([0] + [len(chain) for _least, chain, _closed in chains])
    closed = np.array([is_closed for _least, _chain, is_closed in chains], dtype=bool)
    return points[order], offsets, closed


def _ends(offsets: np.ndarray, closed: np.ndarray) -> np.ndarray:
    fixed = np.zeros(int(offsets[-1]), dtype=np.uint8)
    for begin, end, is_closed in zip(offsets[:-1], offsets[1:], closed, strict=True):
        if not is_closed:
            fixed[[begin, end - 1]] = 1
    return fixed


# ------------------------------------------------------------------------------------------------
# Curves out


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

    curve_object   the curve to rewrite; None makes a new one beside the surface, in its collection
    matrix         the surface's world matrix when the polylines were made; None: as it is now
    bevel_depth    radius of the round bevel in world units; 0: a bare curve
    """
    if matrix is None:
        matrix = world_matrix(surface_object)
    if curve_object is None:
        curve_object = new_curve_object(name, surface_object)
    curve = curve_object.data
    write_splines(curve, polylines, matrix)
    # The bevel lives in the surface's space, where it is scaled along with everything else.
    curve.bevel_depth = bevel_depth / mean_scale(matrix)
    return curve_object


def new_curve_object(name: str, surface_object: bpy.types.Object) -> bpy.types.Object:
    """An empty curve object beside the surface: its child, with no transform of its own."""
    curve_object = bpy.data.objects.new(name, bpy.data.curves.new(name, "CURVE"))
    collection_of(surface_object).objects.link(curve_object)
    curve_object.parent = surface_object
    return curve_object


def write_splines(curve: bpy.types.Curve, polylines: core.Polylines, matrix: np.ndarray) -> None:
    """Replaces the splines of a curve by polylines, in the space of `matrix`."""
    curve.dimensions = "3D"
    curve.fill_mode = "FULL"
    curve.use_fill_caps = True
    curve.use_path = False  # else each update measures the whole curve for an animation
    curve.bevel_resolution = 2
    curve.splines.clear()
    positions = to_local(polylines.positions, matrix).astype(np.float32)
    offsets = np.asarray(polylines.offsets, dtype=np.int64)
    for begin, end, closed in zip(offsets[:-1], offsets[1:], polylines.closed, strict=True):
        count = int(end - begin)
        spline = curve.splines.new("POLY")
        spline.points.add(count - 1)
        points = np.ones((count, 4), dtype=np.float32)
        points[:, :3] = positions[begin:end]
        spline.points.foreach_set("co", points.ravel())
        spline.use_cyclic_u = bool(closed)
    curve.update_tag()


def select_points_around(curve_object: bpy.types.Object, centres: np.ndarray, reach: float) -> int:
    """Selects the points of poly splines around places, and deselects all others.

    centres   (n, 3), in the object's own space
    reach     how far a point may be from a centre, in distances of the point nearest to it: 1.2
              takes what limits the place, on all its sides

    Distances are those that are seen: in world space. Call it in Object Mode, or Edit Mode would
    write its own selection back. Returns the number of points selected.
    """
    matrix = world_matrix(curve_object)
    splines = [spline for spline in curve_object.data.splines if spline.type == "POLY"]
    points = []
    for spline in splines:
        buffer = np.empty(4 * len(spline.points), dtype=np.float32)
        spline.points.foreach_get("co", buffer)
        points.append(to_world(buffer.reshape(-1, 4)[:, :3], matrix))
    everything = np.vstack(points) if points else np.empty((0, 3))
    chosen = np.zeros(len(everything), dtype=bool)
    if len(everything):
        for centre in to_world(centres, matrix):
            squares = ((everything - centre) ** 2).sum(axis=1)
            chosen |= squares <= reach * reach * squares.min()
    begin = 0
    for spline in splines:
        end = begin + len(spline.points)
        spline.points.foreach_set("select", chosen[begin:end])
        begin = end
    for spline in curve_object.data.splines:  # that somebody has added by hand
        for point in spline.bezier_points:
            point.select_control_point = False
            point.select_left_handle = point.select_right_handle = False
    return int(chosen.sum())


def collection_of(object: bpy.types.Object) -> bpy.types.Collection:
    """Where to put something beside an object: its first collection that can be changed."""
    for collection in object.users_collection:
        if collection.library is None:
            return collection
    return bpy.context.scene.collection
