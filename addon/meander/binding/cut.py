# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface of a flow as a mesh that has the curve among its edges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .abi import CutRecord
from .calls import Found
from .context import Context, pointer_of
from .flow import Flow
from .handle import narrow_offsets
from .named import number_of, refuse_other, switch_of
from .native_library import native

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
    refuse_other("flow", flow, Flow, "cut the surface of one")
    found = Found(CutRecord)
    with flow._use() as pointer, pointer_of(context) as cancelling:
        cut = found.fill(
            native().meander_flow_cut_surface,
            pointer,
            number_of("detail", detail),
            switch_of("wish for middle lines", middle_lines),
            context=(cancelling,),
        )
    n, m, p, s = cut.vertex_count, cut.face_count, cut.point_count, cut.strand_count
    return CutSurface(
        positions=found.array("positions", n, 3),
        distances=found.array("distances", n),
        vertex_faces=found.array("vertex_faces", n),
        vertex_weights=found.array("vertex_weights", n, 3),
        faces=found.array("faces", m, 3),
        origins=found.array("origins", m),
        strands=found.array("strands", m),
        regions=found.array("regions", m),
        sides=found.array("sides", m),
        nearest_sides=found.array("nearest_sides", m),
        along=found.array("along", m, 3),
        face_distances=found.array("face_distances", m, 3),
        corner_weights=found.array("corner_weights", m, 3, 3),
        line_vertices=found.array("line_vertices", p),
        arc_lengths=found.array("arc_lengths", p),
        offsets=narrow_offsets(found.array("offsets", s + 1)),
        line_strands=found.array("line_strands", s),
        closed=found.array("closed", s),
        lengths=found.array("lengths", s),
    )
