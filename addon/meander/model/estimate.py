# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run is going to cost: points, time and memory, before it begins; no bpy.

The curve that fills a surface has a length of area over spacing, its nodes lie at an even distance,
and it crosses edges of the mesh as often as any line that runs in all directions: 2 / pi times per
unit of length and per unit of edge length for each unit of area (Crofton). On spheres of 512 and of
8,192 faces, in all presets, nodes and crossings came within 8 % of that.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import core

# The mean distance of nodes, in h: they are kept between h and 2 h apart.
MEAN_SEGMENT = 1.38
# The length of a finished curve, over area by spacing.
FULL_LENGTH = 1.04
# The segment length h where none is chosen, in r; see meander.h.
DEFAULT_SEGMENT = 0.2
# Seconds for each node of a curve of 10,000 on two quiet processors, with distances through space,
# and how the number of iterations grows with the nodes: docs/performance.md.
SECONDS_PER_NODE = {"even": 50e-6, "finest": 130e-6, "paper": 13e-6}
ALONG_SURFACE = 1.3  # times as long with distances along the surface; 1.1 to 1.6 were measured
GROWTH = 0.15
REFERENCE_NODES = 1e4
# Bytes for each node of the flow, and for each face of the surface.
BYTES_PER_NODE = 2200
BYTES_PER_FACE = 400
# Bytes for each point of the curve object: itself, an undo step, and its body where it has
# one.
BYTES_PER_POINT = 330
BYTES_PER_BEVELLED_POINT = 1600
# Runs of fewer nodes say nothing of the machine's speed.
LEAST_NODES = 2000


@dataclass(frozen=True)
class Extent:
    """What there is to fill.

    length_area   area of the faces, each times the square root of its density: over the spacing it
                  is the length of the curve
    node_area     area of the faces, each times its density: where strands are closer, so are nodes
    edges         length of all edges over the area of the faces
    faces         how many
    """

    length_area: float
    node_area: float
    edges: float
    faces: int


@dataclass(frozen=True)
class Estimate:
    """What a run comes to: points of the curve object, seconds, bytes."""

    points: int
    seconds: float
    memory: int


def extent_of(
    vertices: NDArray[np.float64],
    faces: NDArray[np.integer],
    density: NDArray[np.float64] | None = None,
    share: float = 1.0,
) -> Extent:
    """The extent of triangles, of whose area only a share is to be filled.

    vertices (n, 3), faces (m, 3), density (n,) or None for 1 everywhere.
    """
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0
    sides = sum(float(np.linalg.norm(p - q, axis=1).sum()) for p, q in ((a, b), (b, c), (c, a)))
    area = float(areas.sum())
    length_area = node_area = area
    if density is not None:
        of_face = density[faces]
        length_area = float((areas * np.sqrt(of_face).mean(axis=1)).sum())
        node_area = float((areas * of_face.mean(axis=1)).sum())
    # An edge is a side of two faces.
    edges = sides / (2.0 * area) if area > 0.0 else 0.0
    return Extent(share * length_area, share * node_area, edges, len(faces))


class Speeds:
    """How many seconds a node takes on this machine, learned from the runs that ended here."""

    def __init__(self) -> None:
        self._factor: float | None = None

    def learn(self, options: core.FlowOptions, nodes: int, seconds: float) -> None:
        """Takes the figures of a whole run into account; of a small one it takes none."""
        if nodes < LEAST_NODES:
            return
        factor = seconds / _reference_seconds(options, nodes)
        # The machine may be busy with other things: half new, half old.
        self._factor = factor if self._factor is None else math.sqrt(self._factor * factor)

    def seconds(self, options: core.FlowOptions, nodes: float) -> float:
        """How long a run to so many nodes takes."""
        return (self._factor or 1.0) * _reference_seconds(options, nodes)


def _reference_seconds(options: core.FlowOptions, nodes: float) -> float:
    rate = SECONDS_PER_NODE[options.preset]
    if options.medial_axis == core.MedialAxis.GEODESIC:
        rate *= ALONG_SURFACE
    return rate * nodes * max(1.0, nodes / REFERENCE_NODES) ** GROWTH


def estimated(
    extent: Extent, options: core.FlowOptions, bevelled: bool, speeds: Speeds
) -> Estimate:
    """What a run with these options comes to, whose radius and segment length are chosen."""
    scale = FULL_LENGTH / (2.0 * options.radius)
    length = scale * extent.length_area
    segment = MEAN_SEGMENT * (options.segment_length or DEFAULT_SEGMENT * options.radius)
    nodes = scale * extent.node_area / segment
    points = nodes + 2.0 / math.pi * length * extent.edges
    of_point = BYTES_PER_BEVELLED_POINT if bevelled else BYTES_PER_POINT
    memory = BYTES_PER_NODE * nodes + of_point * points + BYTES_PER_FACE * extent.faces
    return Estimate(round(points), speeds.seconds(options, nodes), round(memory))


# ------------------------------------------------------------------------------------------------
# In words


def described(estimate: Estimate) -> str:
    """An estimate in words, to two digits at most: "12,000 points, 3 s, 60 MB"."""
    return (
        f"{_count(estimate.points)} points, {_duration(estimate.seconds)}, "
        f"{_size(estimate.memory)}"
    )


def _rounded(value: float) -> int:
    """To two significant digits, at least 1."""
    return max(1, int(float(f"{value:.2g}")))


def _count(value: float) -> str:
    value = _rounded(value)
    if value >= 1e9:
        return f"{value / 1e9:,g} G"
    return f"{value / 1e6:,g} M" if value >= 1e6 else f"{value:,}"


def _duration(seconds: float) -> str:
    for limit, unit, name in ((100.0, 1.0, "s"), (6e3, 60.0, "min"), (36e4, 3600.0, "h")):
        if seconds < limit:
            return f"{_rounded(seconds / unit)} {name}"
    return f"{_rounded(seconds / 86400.0):,} days"


def _size(size: float) -> str:
    size = _rounded(size)
    if size >= 1e12:
        return f"{size / 1e12:,g} TB"
    return f"{_rounded(size / 1e6)} MB" if size < 1e9 else f"{size / 1e9:,g} GB"
