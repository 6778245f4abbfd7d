# SPDX-License-Identifier: GPL-3.0-or-later
"""What is found on a mesh without a surface: its faults, and its points nearest to others."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .abi import (
    FaultsRecord,
)
from .calls import Found, call
from .context import Context, pointer_of
from .elsewhere import mesh_arrays
from .handle import address_of, checked_array
from .named import number_of, whole_of
from .native_library import native


class Faults(NamedTuple):
    """All faults of a mesh.

    kinds      (n,) uint32: places in FAULTS, rising
    elements   (n, 2) uint32: a vertex or a face twice, or the two vertices of an edge
    """

    kinds: NDArray[np.uint32]
    elements: NDArray[np.uint32]


def find_faults(vertices: ArrayLike, faces: ArrayLike, weld_distance: float = 0.0) -> Faults:
    """All that is wrong with a mesh, where Surface names the first; see meander_mesh_find_faults.

    vertices, faces   as for Surface; coordinates may be anything
    weld_distance     how near to each other boundary edges count as a seam; 0: none do

    Raises MeanderError for a mesh without faces and for indices out of range.
    """
    vertex_array, face_array = mesh_arrays(vertices, faces)
    found = Found(FaultsRecord)
    with pointer_of(None) as cancelling:
        record = found.fill(
            native().meander_mesh_find_faults,
            address_of(vertex_array),
            len(vertex_array),
            address_of(face_array),
            len(face_array),
            number_of("weld distance", weld_distance),
            context=(cancelling,),
        )
    return Faults(found.array("kinds", record.count), found.array("elements", record.count, 2))


class Closest(NamedTuple):
    """The points of a mesh nearest to some points in space, in their order.

    faces      (n,) uint32; of several that are equally near the first
    weights    (n, 3) float64, weights of the face's vertices in its order, >= 0; sum 1
    distances  (n,) float64; infinite where that is no double
    """

    faces: NDArray[np.uint32]
    weights: NDArray[np.float64]
    distances: NDArray[np.float64]


def find_closest(
    vertices: ArrayLike,
    faces: ArrayLike,
    points: ArrayLike,
    threads: int = 0,
    context: Context | None = None,
) -> Closest:
    """The nearest points of any list of triangles, however faulty; see meander_mesh_find_closest.

    vertices, faces   as for Surface; faces at a vertex that is not finite are left out
    points            (n, 3) float64, finite, in the same unit
    threads           at most 256; 0: as many as the machine has; the result is the same

    Every call makes a tree of the faces. Raises MeanderError for points that are not finite, a mesh
    without faces that lie anywhere, indices out of range, and soon after `context` has been
    cancelled.
    """
    vertex_array, face_array = mesh_arrays(vertices, faces)
    mesh = (address_of(vertex_array), len(vertex_array), address_of(face_array), len(face_array))
    return _closest(native().meander_mesh_find_closest, mesh, points, threads, context)


def _closest(
    function: Any,
    mesh: tuple[int | None, ...],
    points: ArrayLike,
    threads: int,
    context: Context | None,
) -> Closest:
    asked = checked_array("the points", points, np.float64, 3)
    count = len(asked)
    found = Closest(np.empty(count, np.uint32), np.empty((count, 3)), np.empty(count))
    arrays = tuple(address_of(array) for array in found)
    number = whole_of("number of threads", threads)
    with pointer_of(context) as cancelling:
        call(function, *mesh, address_of(asked), count, number, *arrays, cancelling)
    return found
