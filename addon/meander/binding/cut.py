# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface of a flow as a mesh that has the curve among its edges."""

from __future__ import annotations

from ctypes import byref, c_size_t, c_void_p
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .context import Context, pointer_of
from .flow import Flow
from .native_library import address_of, call, narrow_offsets, native

NO_STRAND = 2**32 - 1


@dataclass(frozen=True)
class CutSurface:
    """A triangle mesh of n vertices and m faces; lengths are in the surface's units.

    positions       (n, 3) float64
    distances       (n,) float64, from the curve along the surface; 0 on it, inf where no strand is
    vertex_faces    (n,) uint32, a face that holds the vertex, as passed to Surface
    vertex_weights  (n, 3) float64, weights of that face's vertices

    faces           (m, 3) uint32
    origins         (m,) uint32, the face that it is a part of, as passed to Surface
    strands         (m,) uint32, the nearest strand; NO_STRAND where there is none
    regions         (m,) uint32, the same for faces that are joined without crossing the curve
    sides           (m,) int32, 1 or -1: other across the curve wherever that can be
    nearest_sides   (m,) int32, 1 left, -1 right of the nearest strand
    along           (m, 3) float64, arc length of the nearest place, per corner
    face_distances  (m, 3) float64, distance from that place, per corner
    corner_weights  (m, 3, 3) float64, per corner the weights of the vertices of the origin

    line_vertices   (p,) uint32, the curve, strand after strand
    arc_lengths     (p,) float64
    offsets         (s + 1,) uint32: strand k has the points offsets[k] .. offsets[k + 1] - 1
    line_strands    (s,) uint32, which strand of the polylines it is
    closed          (s,) uint8
    lengths         (s,) float64
    """

    positions: NDArray[np.float64]
    distances: NDArray[np.float64]
    vertex_faces: NDArray[np.uint32]
    vertex_weights: NDArray[np.float64]
    faces: NDArray[np.uint32]
    origins: NDArray[np.uint32]
    strands: NDArray[np.uint32]
    regions: NDArray[np.uint32]
    sides: NDArray[np.int32]
    nearest_sides: NDArray[np.int32]
    along: NDArray[np.float64]
    face_distances: NDArray[np.float64]
    corner_weights: NDArray[np.float64]
    line_vertices: NDArray[np.uint32]
    arc_lengths: NDArray[np.float64]
    offsets: NDArray[np.uint32]
    line_strands: NDArray[np.uint32]
    closed: NDArray[np.uint8]
    lengths: NDArray[np.float64]

    def line_edges(self) -> NDArray[np.uint32]:
        """The edges that the curve is made of, (e, 2): pairs of vertices, in its direction."""
        count = len(self.line_vertices)
        follower = np.arange(1, count + 1)
        follower[self.offsets[1:] - 1] = self.offsets[:-1]
        joined = np.ones(count, dtype=bool)
        joined[self.offsets[1:] - 1] = self.closed.astype(bool)
        return np.stack((self.line_vertices, self.line_vertices[follower]), axis=1)[joined]


def cut_surface(
    flow: Flow,
    detail: float = 0.0,
    middle_lines: bool = False,
    context: Context | None = None,
) -> CutSurface:
    """Cuts the flow's surface along its present curve; see meander_flow_cut_surface.

    detail        about how long edges are at most, in the surface's units; 0: as the curve has it
    middle_lines  whether the lines halfway between neighbouring turns become edges too

    Raises MeanderError for a detail out of range, while the flow is running, and soon after
    `context` has been cancelled.
    """
    library = native()
    cut = c_void_p()
    with flow._use() as pointer, pointer_of(context) as cancelling:
        call(
            library.meander_flow_cut_surface,
            pointer,
            float(detail),
            int(middle_lines),
            byref(cut),
            cancelling,
        )
    try:
        return CutSurface(*_vertices(cut), *_faces(cut), *_line(cut))
    finally:
        library.meander_cut_destroy(cut)


def _vertices(cut: c_void_p) -> list[NDArray]:
    function = native().meander_cut_get_vertices
    count = c_size_t()
    call(function, cut, *(None,) * 4, 0, byref(count))
    n = count.value
    arrays = [np.empty((n, 3)), np.empty(n), np.empty(n, dtype=np.uint32), np.empty((n, 3))]
    call(function, cut, *map(address_of, arrays), n, byref(count))
    return arrays


def _faces(cut: c_void_p) -> list[NDArray]:
    function = native().meander_cut_get_faces
    count = c_size_t()
    call(function, cut, *(None,) * 9, 0, byref(count))
    m = count.value
    arrays = [
        np.empty((m, 3), dtype=np.uint32),
        *(np.empty(m, dtype=np.uint32) for _ in range(3)),
        *(np.empty(m, dtype=np.int32) for _ in range(2)),
        *(np.empty((m, 3)) for _ in range(2)),
        np.empty((m, 3, 3)),
    ]
    call(function, cut, *map(address_of, arrays), m, byref(count))
    return arrays


def _line(cut: c_void_p) -> list[NDArray]:
    function = native().meander_cut_get_line
    points, strands = c_size_t(), c_size_t()
    call(function, cut, None, None, 0, byref(points), *(None,) * 4, 0, byref(strands))
    p, s = points.value, strands.value
    vertices, arc_lengths = np.empty(p, dtype=np.uint32), np.empty(p)
    offsets = np.zeros(s + 1, dtype=np.uint64)
    names, closed, lengths = np.empty(s, np.uint32), np.empty(s, np.uint8), np.empty(s)
    call(
        function,
        cut,
        address_of(vertices),
        address_of(arc_lengths),
        p,
        byref(points),
        *map(address_of, (offsets, names, closed, lengths)),
        s,
        byref(strands),
    )
    return [vertices, arc_lengths, narrow_offsets(offsets), names, closed, lengths]
