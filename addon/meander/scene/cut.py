# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface that has been cut along its curve, as a mesh object beside it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import bmesh
import bpy
import numpy as np
from mathutils.kdtree import KDTree

from .. import core
from ..model.cut import along_shares, ribbon_uv, smooth_normals
from .blender_versions import keep_custom_normals
from .columns import column
from .curve_writer import place_beside
from .evaluated import surface_mesh
from .transforms import mean_scale, to_local
from .triangulation import loops_of

UV_MAP = "Ribbon"
# Edges shorter than this, in spacings, are dissolved, and vertices as close to an edge become its
# own: the normals of faces that thin are rounding errors, which shading shows.
_THINNEST = 3e-4
# What says where an object is, in an order in which none changes the others.
_PLACE = (
    "parent",
    "parent_type",
    "parent_bone",
    "parent_vertices",
    "matrix_parent_inverse",
    "rotation_mode",
    "location",
    "rotation_euler",
    "rotation_quaternion",
    "rotation_axis_angle",
    "scale",
    "delta_location",
    "delta_rotation_euler",
    "delta_rotation_quaternion",
    "delta_scale",
)


@dataclass(frozen=True)
class Skin:
    """What the cut takes over from the surface, per triangle of triangles_of().

    corners    (m, 3) loops of the evaluated mesh
    materials  (m,) index of the material
    smooth     (m,) bool
    normals    (n, 3) of the vertices, in the object's space
    uv_maps    name and (loops, 2) of every UV map
    slots      the materials
    """

    corners: np.ndarray
    materials: np.ndarray
    smooth: np.ndarray
    normals: np.ndarray
    uv_maps: list[tuple[str, np.ndarray]]
    slots: list[bpy.types.Material | None]


def skin_of(surface: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> Skin:
    """Reads a surface's materials, UV maps and shading. Raises DataError for what is no mesh."""
    with surface_mesh(surface, depsgraph) as (mesh, matrix):
        corners = loops_of(mesh)
        polygons = column(mesh.loop_triangles, "polygon_index", kind=np.int32)
        materials = column(mesh.polygons, "material_index", kind=np.int32)
        smooth = column(mesh.polygons, "use_smooth", kind=bool)
        normals = column(mesh.vertices, "normal", 3)
        uv_maps = []
        for layer in mesh.uv_layers:
            uv_maps.append((layer.name, column(layer.data, "uv", 2)))
        slots = [slot.material for slot in surface.material_slots]
    if np.linalg.det(matrix[:3, :3]) < 0.0:  # as triangles_of() turns them
        corners = corners[:, ::-1]
    return Skin(
        corners,
        materials[polygons],
        smooth[polygons],
        normals.astype(np.float64),
        uv_maps,
        slots,
    )


def write_cut(
    name: str,
    cut: core.CutSurface,
    surface: bpy.types.Object,
    triangles: np.ndarray,
    skin: Skin,
    matrix: np.ndarray,
    spacing: float,
) -> bpy.types.Object:
    """Makes a mesh object of a cut, beside the surface and its child.

    triangles   (m, 3) of the surface, as the cut was made of them
    matrix      the surface's world matrix when the cut was made, whose units the cut has
    spacing     in world units

    The curve's edges are seams, exact but for what would be too thin to shade. Attributes, all
    lengths in the object's own space: `distance` and `surface_normal` of vertices; `side`, `strand`
    and `region` of faces; `along` (0 to 1) and `arc_length` of face corners. UV maps: those of the
    surface, and Ribbon.
    """
    mirrored = np.linalg.det(matrix[:3, :3]) < 0.0
    order = np.array([2, 1, 0]) if mirrored else np.arange(3)
    mesh = bpy.data.meshes.new(name)
    points = to_local(cut.positions, matrix)
    mesh.from_pydata(points.tolist(), [], cut.faces[:, order].tolist())
    _mark_seams(mesh, cut)
    _give_skin(mesh, cut, skin, order)
    scale = mean_scale(matrix)
    normals = smooth_normals(cut, skin.normals, triangles)
    # No strand runs on some parts: what is far away there shall not be infinite.
    distances = np.where(np.isfinite(cut.distances), cut.distances, 0.0)
    strands = np.where(cut.strands == core.NO_STRAND, -1, cut.strands.astype(np.int64))
    for attribute, kind, domain, values in (
        ("distance", "FLOAT", "POINT", distances / scale),
        ("surface_normal", "FLOAT_VECTOR", "POINT", normals),
        ("side", "INT", "FACE", cut.sides),
        ("strand", "INT", "FACE", strands),
        ("region", "INT", "FACE", cut.regions),
        ("along", "FLOAT", "CORNER", along_shares(cut)[:, order]),
        ("arc_length", "FLOAT", "CORNER", cut.along[:, order] / scale),
    ):
        data = mesh.attributes.new(attribute, kind, domain).data
        whole = np.int32 if kind == "INT" else np.float32
        flat = np.ascontiguousarray(values, dtype=whole).ravel()
        data.foreach_set("vector" if kind == "FLOAT_VECTOR" else "value", flat)
    _set_uv(mesh, UV_MAP, ribbon_uv(cut, spacing)[:, order])
    _tidy(mesh, _THINNEST * spacing / scale)
    mesh.uv_layers.active = mesh.uv_layers[UV_MAP]
    mesh.update()
    thing = bpy.data.objects.new(name, mesh)
    place_beside(thing, surface)
    thing.parent = surface
    return thing


def take_place(thing: bpy.types.Object, surface: bpy.types.Object) -> None:
    """Puts a new object, a child of its surface, beside that one: for a surface that is hidden.

    Among the children of what is hidden nobody looks for what is seen. One whose surface moves by
    itself stays its child.
    """
    if surface.animation_data is not None or len(surface.constraints):
        return
    for name in _PLACE:
        setattr(thing, name, getattr(surface, name))


def _tidy(mesh: bpy.types.Mesh, distance: float) -> None:
    """Takes out what is thinner than a distance, and leaves triangles."""
    edit = bmesh.new()
    try:
        edit.from_mesh(mesh)
        line = _points_on_line(edit)
        places = KDTree(len(line))
        for number, point in enumerate(line):
            places.insert(point.co, number)
        places.balance()
        bmesh.ops.dissolve_degenerate(edit, dist=distance, edges=edit.edges[:])
        # Where an edge that ends on the line has become a point, that is in the middle of it.
        away = edit.verts.layers.float["distance"]
        for point in _points_on_line(edit):
            if point[away] > 0.0:
                point.co = places.find(point.co)[0]
                point[away] = 0.0
        bmesh.ops.triangulate(edit, faces=[face for face in edit.faces if len(face.verts) > 3])
        edit.to_mesh(mesh)
    finally:
        edit.free()


def _points_on_line(edit: bmesh.types.BMesh) -> list[bmesh.types.BMVert]:
    return [point for point in edit.verts if any(edge.seam for edge in point.link_edges)]


def _mark_seams(mesh: bpy.types.Mesh, cut: core.CutSurface) -> None:
    ends = column(mesh.edges, "vertices", 2, np.int32)
    count = len(cut.positions)

    def keys(pairs: np.ndarray) -> np.ndarray:
        pairs = np.sort(pairs.astype(np.int64).reshape(-1, 2), axis=1)
        return pairs[:, 0] * count + pairs[:, 1]

    mesh.edges.foreach_set("use_seam", np.isin(keys(ends), keys(cut.line_edges())))


def _give_skin(mesh: bpy.types.Mesh, cut: core.CutSurface, skin: Skin, order: np.ndarray) -> None:
    for material in skin.slots:
        mesh.materials.append(material)
    indices = skin.materials[cut.origins].astype(np.int32)
    mesh.polygons.foreach_set("material_index", indices)
    mesh.polygons.foreach_set("use_smooth", skin.smooth[cut.origins])
    corners = skin.corners[cut.origins]
    for name, values in skin.uv_maps:
        blended = np.einsum("fkw,fwx->fkx", cut.corner_weights, values[corners])
        _set_uv(mesh, name, blended[:, order])


def _set_uv(mesh: bpy.types.Mesh, name: str, values: np.ndarray) -> None:
    layer = mesh.uv_layers.new(name=name, do_init=False)
    if layer is not None:  # there may be eight at most
        layer.data.foreach_set("uv", np.ascontiguousarray(values, dtype=np.float32).ravel())


def sharpen_line(thing: bpy.types.Object) -> None:
    """Lets the two sides of a cut's curve be shaded apart, for what gets a crease there."""
    mesh = thing.data
    seams = column(mesh.edges, "use_seam", kind=bool)
    mesh.edges.foreach_set("use_edge_sharp", seams)
    keep_custom_normals(mesh, math.pi)
    mesh.update()


def keep_shading(thing: bpy.types.Object) -> None:
    """Shades a cut as its surface is shaded, where that is smooth.

    New vertices inside of a flat face would otherwise make it look flat.
    """
    mesh = thing.data
    smooth = column(mesh.polygons, "use_smooth", kind=bool)
    if not smooth.any():
        return
    normals = column(mesh.attributes["surface_normal"].data, "vector", 3)
    keep_custom_normals(mesh)
    mesh.normals_split_custom_set_from_vertices(normals.tolist())
