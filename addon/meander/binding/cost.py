# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run is going to cost, before it begins."""

from __future__ import annotations

from ctypes import byref
from dataclasses import dataclass

from .abi import CostRecord, ExtentRecord
from .calls import call, prepared
from .flow_options import FlowOptions, options_record
from .named import number_of, refuse_other, whole_of
from .native_library import native


@dataclass(frozen=True)
class Extent:
    """What there is to fill; see meander_extent.

    faces         how many
    length_area   area of the faces, each times the square root of its density: over the spacing it
                  is the length of the curve
    node_area     area of the faces, each times its density: where strands are closer, so are nodes
    edge_density  length of all edges over the area of all faces
    curvature     sum of the angle defects, in absolute value, over the area of all faces
    """

    faces: int
    length_area: float
    node_area: float
    edge_density: float
    curvature: float = 0.0


@dataclass(frozen=True)
class Cost:
    """What a run to its own end comes to; see meander_cost. Figures may be infinite.

    nodes, points      of the curve, and of its polylines
    length             in the units of the surface
    memory             bytes that the library holds at most
    processor_seconds  of one processor
    """

    nodes: float
    points: float
    length: float
    memory: float
    processor_seconds: float


def estimate_cost(extent: Extent, options: FlowOptions) -> Cost:
    """What filling an extent with these options costs; see meander_extent_estimate_cost.

    Raises MeanderError for figures and options that are out of range.
    """
    refuse_other("extent", extent, Extent, "take that of a surface")
    given, found = prepared(ExtentRecord), prepared(CostRecord)
    given.faces = whole_of("number of faces", extent.faces)
    for name in ("length_area", "node_area", "edge_density", "curvature"):
        setattr(given, name, number_of(name, getattr(extent, name)))
    record = options_record(options)
    call(native().meander_extent_estimate_cost, byref(given), byref(record), byref(found))
    return Cost(
        found.nodes, found.points, found.length, found.memory, found.processor_seconds
    )
