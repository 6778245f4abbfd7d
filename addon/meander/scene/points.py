# SPDX-License-Identifier: GPL-3.0-or-later
"""What is known of every point of a curve: where on its surface it is, with the triangle that holds
it and its normal, and as attributes of a mesh of edges or of a hair curve.
"""

from __future__ import annotations

import base64

import bpy
import numpy as np
from mathutils.kdtree import KDTree

from .. import core
from ..model.geometry.surface_normals import normals_at
from ..model.geometry.unit_vectors import unit
from ..model.toolpaths import toolpath
from .blender_versions import make_poly
from .curve_reader import strands_of_curve
from .curve_writer import place_beside
from .drawn_line import seen_instead
from .errors import DataError
from .evaluated import matrix_of
from .meshes import triangles_of
from .transforms import mean_scale, to_local

KINDS = ("MESH", "CURVES")


def refuse(kind: str) -> None:
    """Raises DataError where this Blender cannot make an object of that kind."""
    if kind == "CURVES" and "add_curves" not in bpy.types.Curves.bl_rna.functions:
        raise DataError(
            "Hair curves with attributes cannot be written by scripts before Blender 4.2; make "
            "a mesh instead"
        )


def attributes_of(
    strands: list[toolpath.Strand], matrix: np.ndarray
) -> dict[str, tuple[str, np.ndarray]]:
    """Name, Blender's type and values of every point's attributes.

    Directions are in the space of `matrix`, as the points are; lengths are those of the world. What
    is not known is left out.
    """
    counts = [len(strand.points) for strand in strands]
    linear = matrix[:3, :3]
    # The transpose, not the inverse: normals transform as planes do.
    normals = np.vstack([strand.normals for strand in strands]) @ linear
    tangents = np.linalg.solve(linear, np.vstack([strand.tangents for strand in strands]).T).T
    values = {
        "arc_length": ("FLOAT", np.concatenate([strand.arc_lengths for strand in strands])),
        "surface_normal": ("FLOAT_VECTOR", unit(normals)),
        "tangent": ("FLOAT_VECTOR", unit(tangents)),
        "strand": ("INT", np.repeat(np.arange(len(strands)), counts)),
    }
    if all(strand.radii is not None for strand in strands):
        radii = np.vstack([strand.radii for strand in strands])
        values["r_plus"] = ("FLOAT", radii[:, 0])
        values["r_minus"] = ("FLOAT", radii[:, 1])
    if all(strand.faces is not None for strand in strands):
        values["triangle"] = ("INT", np.concatenate([strand.faces for strand in strands]))
        values["weights"] = ("FLOAT_VECTOR", np.vstack([strand.weights for strand in strands]))
    return values


def make(
    kind: str,
    name: str,
    strands: list[toolpath.Strand],
    surface: bpy.types.Object,
    matrix: np.ndarray,
    radius: float = 0.0,
) -> bpy.types.Object:
    """Makes an object of points in world units on a surface object, its child as a result is.

    kind     one of KINDS
    matrix   the surface's world matrix
    radius   thickness of hair curves, in world units

    Raises DataError where this Blender cannot.
    """
    refuse(kind)
    data = _mesh(name, strands, matrix) if kind == "MESH" else _curves(name, strands, matrix)
    for attribute_name, (value_type, values) in attributes_of(strands, matrix).items():
        _set(data.attributes.new(attribute_name, value_type, "POINT"), values)
    if kind == "CURVES" and radius > 0.0:
        count = sum(len(strand.points) for strand in strands)
        attribute = data.attributes.get("radius") or data.attributes.new("radius", "FLOAT", "POINT")
        _set(attribute, np.full(count, radius / mean_scale(matrix)))
    data.update_tag()
    thing = bpy.data.objects.new(name, data)
    place_beside(thing, surface)
    thing.parent = surface
    return thing


def _mesh(name: str, strands: list[toolpath.Strand], matrix: np.ndarray) -> bpy.types.Mesh:
    edges, first = [], 0
    for strand in strands:
        here = first + np.arange(len(strand.points))
        there = np.roll(here, -1)
        pairs = np.column_stack([here, there])
        edges.append(pairs if strand.closed else pairs[:-1])
        first += len(here)
    pairs = np.vstack(edges).astype(np.int32)
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(first)
    mesh.vertices.foreach_set("co", _local(strands, matrix).ravel())
    mesh.edges.add(len(pairs))
    mesh.edges.foreach_set("vertices", pairs.ravel())
    mesh.update()
    return mesh


def _curves(name: str, strands: list[toolpath.Strand], matrix: np.ndarray) -> bpy.types.Curves:
    curves = bpy.data.hair_curves.new(name)
    curves.add_curves([len(strand.points) for strand in strands])
    curves.position_data.foreach_set("vector", _local(strands, matrix).ravel())
    make_poly(curves)
    cyclic = curves.attributes.new("cyclic", "BOOLEAN", "CURVE")
    cyclic.data.foreach_set("value", [strand.closed for strand in strands])
    return curves


def _local(strands: list[toolpath.Strand], matrix: np.ndarray) -> np.ndarray:
    points = np.vstack([strand.points for strand in strands])
    return to_local(points, matrix).astype(np.float32)


def _set(attribute: bpy.types.Attribute, values: np.ndarray) -> None:
    whole = attribute.data_type in {"INT", "INT8"}
    key = "vector" if attribute.data_type == "FLOAT_VECTOR" else "value"
    attribute.data.foreach_set(
        key, np.ascontiguousarray(values, dtype=np.int32 if whole else np.float32).ravel()
    )


# ------------------------------------------------------------------------------------------------
# The medial radii, which only a run knows, kept with its result


def store_medial_radii(result: bpy.types.Object, radii: np.ndarray, matrix: np.ndarray) -> None:
    """Keeps r+ and r- (n, 2) of a result's points, in the units of `matrix`."""
    scale = mean_scale(matrix)
    packed = np.asarray(radii / scale, dtype="<f4").tobytes()
    result.meander.figures.room = base64.b64encode(packed).decode("ascii")


def clear_medial_radii(result: bpy.types.Object) -> None:
    """Forgets them, as the points are no longer those of the run."""
    result.meander.figures.room = ""


def medial_radii_of(result: bpy.types.Object, count: int, matrix: np.ndarray) -> np.ndarray | None:
    """r+ and r- in world units of a result's `count` points; None where they have been changed."""
    text = result.meander.figures.room
    # Files may hold base 85, which takes a second for 100,000 points.
    decode = base64.b85decode if len(text) == 10 * count else base64.b64decode
    try:
        packed = decode(text)
    except ValueError:
        return None
    if not packed or len(packed) != 8 * count:
        return None
    radii = np.frombuffer(packed, dtype="<f4").reshape(count, 2).astype(np.float64)
    return radii * mean_scale(matrix)


def data_of(index: np.ndarray, weights: np.ndarray, radii: np.ndarray | None) -> core.PointData:
    """What toolpath.strands_of takes, for points that do not come from a run."""
    return core.PointData(None, None, None, radii, index, weights)


# The squared sine of the angle at a corner below which rounding leaves nothing of a triangle.
_LINE = 1e-12


def bind(
    points: np.ndarray, vertices: np.ndarray, faces: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """For each point the nearest triangle and the weights of its corners there. Triangles that are
    a line hold none."""
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    u, v = b - a, c - a
    longest = (u * u).sum(1) * (v * v).sum(1)
    usable = np.flatnonzero(longest - (u * v).sum(1) ** 2 > _LINE * longest)
    found = core.find_closest(vertices, faces[usable], points)
    return usable[found.faces], found.weights


def farthest(points: np.ndarray, vertices: np.ndarray, faces: np.ndarray) -> float:
    """How far the points (n, 3) are from triangles, at most."""
    return float(core.find_closest(vertices, faces, points).distances.max())


def polylines_of(
    result: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
    shown: bpy.types.Object | None = None,
    as_drawn: bool = False,
) -> tuple[core.Polylines, np.ndarray, np.ndarray]:
    """A result's strands in world units with normals of the surface, and for every point the
    triangle of the surface that holds it and the weights of its corners.

    shown     a baked frame of it, whose strands are taken in place of its own
    as_drawn  those with round turns, where the look draws them in place of the curve

    Raises DataError with one sentence for what cannot be used.
    """
    drawn = seen_instead(result) if as_drawn else None
    own = drawn.data if drawn else None
    strands = strands_of_curve(shown or result, depsgraph, of_data=own)
    vertices, faces = triangles_of(result.meander.surface, depsgraph)
    index, weights = bind(strands.points, vertices, faces)
    spacing = result.meander.figures.least_spacing or result.meander.spacing
    normals = normals_at(vertices, faces, index, weights, spacing / 2.0)
    curve = core.Polylines(strands.points, normals, strands.offsets, strands.closed)
    return curve, index, weights


def _nearest(points: np.ndarray, places: np.ndarray) -> np.ndarray:
    """For each place the index of the nearest point."""
    tree = KDTree(len(points))
    for index, point in enumerate(points.tolist()):
        tree.insert(point, index)
    tree.balance()
    return np.array([tree.find(place)[1] for place in places.tolist()], dtype=np.int64)


def strands_of_result(
    result: bpy.types.Object, depsgraph: bpy.types.Depsgraph, as_drawn: bool = False
) -> list[toolpath.Strand]:
    """A result's strands with all that is known of them, as its look draws them or as its curve has
    them. r+ and r- of a drawn point are those of the nearest one of the curve. Raises DataError."""
    curve, index, weights = polylines_of(result, depsgraph, as_drawn=as_drawn)
    matrix = matrix_of(result.meander.surface, depsgraph)
    if as_drawn and seen_instead(result):
        own = strands_of_curve(result, depsgraph).points
        radii = medial_radii_of(result, len(own), matrix)
        radii = None if radii is None else radii[_nearest(own, curve.positions)]
    else:
        radii = medial_radii_of(result, len(curve.positions), matrix)
    return toolpath.strands_of(curve, data_of(index, weights, radii))


def strands_of_frame(
    result: bpy.types.Object, shown: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> list[toolpath.Strand]:
    """The strands of a baked frame of a result, in the frame of its scene. Raises DataError."""
    curve, index, weights = polylines_of(result, depsgraph, shown)
    return toolpath.strands_of(curve, data_of(index, weights, None))
