# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of a surface that is cut along the curve: what each pixel shows, and how far it is."""

from __future__ import annotations

from ctypes import byref, c_size_t
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .abi import CutRecord
from .calls import call, prepared
from .context import Context, pointer_of
from .cut import CutSurface
from .handle import address_of, checked_array
from .native_library import native


class MapPixels(NamedTuple):
    """Of a square image, row by row.

    faces     (size * size,) int32: the face that each pixel lies in; -1: none
    weights   (size * size, 3) float32, of the corners of that face
    covered   how many pixels lie in faces, without the margin
    twice     how many of them lie well inside of several
    """

    faces: NDArray[np.int32]
    weights: NDArray[np.float32]
    covered: int
    twice: int


def map_pixels(
    corners: ArrayLike, size: int, margin: int = 0, threads: int = 0, context: Context | None = None
) -> MapPixels:
    """What the pixels of a flat drawing of faces show; see meander_map_find_pixels.

    corners   (m, 3, 2), in pixels, whose centres are whole numbers; y counts rows downwards
    size      of a side, in pixels, at most 32768
    margin    so many pixels around faces show what lies at their edges

    Raises MeanderError for a size out of range, and soon after `context` has been cancelled.
    """
    places = checked_array("corners", np.asarray(corners).reshape(-1, 6), np.float64, 6)
    count = max(int(size), 1) ** 2
    faces, weights = np.empty(count, np.int32), np.empty((count, 3), np.float32)
    covered, twice = c_size_t(), c_size_t()
    with pointer_of(context) as cancelling:
        call(
            native().meander_map_find_pixels,
            address_of(places),
            len(places),
            int(size),
            int(margin),
            int(threads),
            address_of(faces),
            address_of(weights),
            byref(covered),
            byref(twice),
            cancelling,
        )
    return MapPixels(faces, weights, covered.value, twice.value)


class CutPlaces(NamedTuple):
    """The places on the curve that are nearest to places of a cut.

    distances  (n,) float64, to there
    strands    (n,) uint32: which strand it is on; NO_STRAND where none runs
    along      (n,) float64: its arc length from the first point of that strand
    away       (n, 3) float64: the way from there; None where that was not asked for
    """

    distances: NDArray[np.float64]
    strands: NDArray[np.uint32]
    along: NDArray[np.float64]
    away: NDArray[np.float64] | None


def cut_places(
    cut: CutSurface,
    farthest: float,
    faces: NDArray[np.int32],
    weights: NDArray[np.float32],
    away: bool = False,
    threads: int = 0,
    context: Context | None = None,
) -> CutPlaces:
    """The places on the curve that are nearest to places of a cut; see meander_cut_find_places.

    farthest         distances end there
    faces, weights   (n,) int32 and (n, 3) float32: places as map_pixels gives them

    Raises MeanderError for faces that are not there, and soon after `context` has been cancelled.
    """
    record, kept = prepared(CutRecord), []
    for name, dtype in _READ.items():
        array = np.ascontiguousarray(getattr(cut, name), dtype=dtype)
        kept.append(array)
        setattr(record, name, address_of(array))
    record.vertex_count, record.face_count = len(cut.positions), len(cut.faces)
    record.point_count, record.strand_count = len(cut.line_vertices), len(cut.line_strands)
    face_array = checked_array("faces", faces, np.int32, None)
    weight_array = checked_array("weights", weights, np.float32, 3)
    count = len(face_array)
    places = CutPlaces(
        np.empty(count),
        np.empty(count, dtype=np.uint32),
        np.empty(count),
        np.empty((count, 3)) if away else None,
    )
    with pointer_of(context) as cancelling:
        call(
            native().meander_cut_find_places,
            byref(record),
            float(farthest),
            address_of(face_array),
            address_of(weight_array),
            count,
            int(threads),
            address_of(places.distances),
            address_of(places.away),
            address_of(places.strands),
            address_of(places.along),
            cancelling,
        )
    del kept
    return places


# What is read of a cut.
_READ = {
    "positions": np.float64,
    "distances": np.float64,
    "faces": np.uint32,
    "strands": np.uint32,
    "along": np.float64,
    "face_distances": np.float64,
    "line_vertices": np.uint32,
    "arc_lengths": np.float64,
    "offsets": np.uint64,
    "line_strands": np.uint32,
    "closed": np.uint8,
    "lengths": np.float64,
}
