# SPDX-License-Identifier: GPL-3.0-or-later
"""What a curve has become, as arrays: its strands, nodes, points and gaps; and its strands as other
libraries of Python have them, which are imported for that alone."""

from __future__ import annotations

import importlib
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .calls import Found
from .errors import MeanderError
from .handle import narrow_offsets


class Polylines(NamedTuple):
    """The curve as full geodesic polylines; every straight piece lies in one face.

    positions  (n, 3) float64, strand after strand
    normals    (n, 3) float64, unit normals of the surface
    offsets    (s + 1,) uint32: strand k has the points offsets[k] .. offsets[k + 1] - 1
    closed     (s,) uint8: 1 if the last point joins the first, which is not repeated
    """

    positions: NDArray[np.float64]
    normals: NDArray[np.float64]
    offsets: NDArray[np.uint32]
    closed: NDArray[np.uint8]

    def to_trimesh(self, data: PointData | None = None) -> Any:
        """A trimesh.path.Path3D with a line for each strand, whose points keep their numbers.

        data  of the same points, of Flow.point_data(): vertex attributes, beside `normal`, of the
              names that .csv files have; None: none

        Raises MeanderError where trimesh is not there, and for data of another number of points.
        """
        return path_of(self, data)

    def to_pyvista(self, data: PointData | None = None) -> Any:
        """A pyvista.PolyData with a line for each strand, numbered by the cell data `strand`.

        data  of the same points, of Flow.point_data(): point data, beside `Normals`, of the names
              that .csv files have; None: none

        Raises MeanderError where PyVista is not there, and for data of another number of points.
        """
        return poly_data_of(self, data)


class Preview(NamedTuple):
    """The curve of a started run between two iterations.

    polylines   without normals, which nobody sees who watches: (0, 3)
    iterations  over the life of the flow
    nodes       of the curve
    length      of the curve
    seconds     of all iterations
    kept        how many copies of growth come after this one; see Flow.keep_growth
    """

    polylines: Polylines
    iterations: int
    nodes: int
    length: float
    seconds: float
    kept: int = 0


class Nodes(NamedTuple):
    """The nodes of the curve as points of the mesh, strand after strand.

    faces         (n,) uint32, index of the face as passed to Surface
    barycentrics  (n, 3) float64, weights of the face's vertices in the caller's order; sum 1
    radii         (n, 2) float64, medial radius on either side; 0 before the first step
    fixed         (n,) uint8, 1 never moves
    """

    faces: NDArray[np.uint32]
    barycentrics: NDArray[np.float64]
    radii: NDArray[np.float64]
    fixed: NDArray[np.uint8]


class PointData(NamedTuple):
    """What is known of every point of the polylines, in their order.

    arc_lengths   (n,) float64, arc length of the strand from its first point
    normals       (n, 3) float64, unit normals of the surface
    tangents      (n, 3) float64, unit, along the strand
    radii         (n, 2) float64, half the room on the right and on the left, seen from outside
    faces         (n,) uint32, a face that holds the point, as passed to Surface
    barycentrics  (n, 3) float64, weights of the face's vertices in the caller's order; sum 1
    """

    arc_lengths: NDArray[np.float64]
    normals: NDArray[np.float64]
    tangents: NDArray[np.float64]
    radii: NDArray[np.float64]
    faces: NDArray[np.uint32]
    barycentrics: NDArray[np.float64]


@dataclass(frozen=True)
class Gaps:
    """Places that a curve leaves empty, the largest first.

    positions  (n, 3) float64, on the surface
    radii      (n,) float64, distance from each position to the curve, in the surface's units
    sizes      (n,) float64, the same in units of the local r: 1 between well spaced strands
    faces      (n,) uint32, the face of each position, as passed to Surface
    narrow     (n,) bool, where the surface is narrower than a spacing: a line and its way back have
               no room there
    empty_share    of the surface's area: what is farther than 1.6 local r from the curve, without
    narrow_share   the same where the surface is narrower than a spacing
    """

    positions: NDArray[np.float64]
    radii: NDArray[np.float64]
    sizes: NDArray[np.float64]
    faces: NDArray[np.uint32]
    narrow: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, dtype=np.bool_))
    empty_share: float = 0.0
    narrow_share: float = 0.0

    def __len__(self) -> int:
        return len(self.sizes)


def _imported(name: str, package: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as missing:
        raise MeanderError(
            f"this needs the Python package {package}, which is not there ({missing}); install it "
            f"with python3 -m pip install {package}"
        ) from missing


def _values(curve: Polylines, data: PointData | None) -> dict[str, NDArray]:
    """What is known of the points, by name."""
    if data is None:
        return {}
    if len(data.arc_lengths) != len(curve.positions):
        raise MeanderError(
            f"the data are of {len(data.arc_lengths)} points and the curve has "
            f"{len(curve.positions)}; take both from the flow at the same time"
        )
    return {
        "arc_length": data.arc_lengths,
        "tangent": data.tangents,
        "r_plus": data.radii[:, 0],
        "r_minus": data.radii[:, 1],
        "face": data.faces,
        "weights": data.barycentrics,
    }


def _orders(curve: Polylines) -> list[NDArray[np.int64]]:
    """The points of each strand in order, of a closed one with the first again at the end."""
    offsets = np.asarray(curve.offsets, dtype=np.int64)
    return [
        np.append(np.arange(begin, end), [begin] if closed else []).astype(np.int64)
        for begin, end, closed in zip(offsets[:-1], offsets[1:], curve.closed, strict=True)
    ]


def path_of(curve: Polylines, data: PointData | None) -> Any:
    """A curve as a trimesh.path.Path3D; see Polylines.to_trimesh."""
    entities = _imported("trimesh.path.entities", "trimesh")
    return _imported("trimesh.path", "trimesh").Path3D(
        entities=[entities.Line(order) for order in _orders(curve)],
        vertices=np.array(curve.positions),
        vertex_attributes={"normal": np.array(curve.normals), **_values(curve, data)},
        process=False,
    )


def poly_data_of(curve: Polylines, data: PointData | None) -> Any:
    """A curve as a pyvista.PolyData; see Polylines.to_pyvista."""
    pyvista = _imported("pyvista", "pyvista")
    orders = _orders(curve)
    lines = np.concatenate([np.append(len(order), order) for order in orders] or [[]])
    made = pyvista.PolyData(np.array(curve.positions), lines=lines.astype(np.int64))
    made.point_data["Normals"] = np.array(curve.normals)
    for name, values in _values(curve, data).items():
        made.point_data[name] = values
    made.cell_data["strand"] = np.arange(len(orders))
    return made


def polylines_of(found: Found, normals: NDArray[np.float64]) -> Polylines:
    """A curve as the library has handed it out, meander_polylines or meander_preview."""
    record = found.record
    return Polylines(
        found.array("positions", record.point_count, 3),
        normals,
        narrow_offsets(found.array("offsets", record.strand_count + 1)),
        found.array("closed", record.strand_count),
    )
