# SPDX-License-Identifier: GPL-3.0-or-later
"""How a mesh is prepared before it becomes a surface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .abi import SurfaceOptionsRecord
from .calls import prepared
from .errors import MeanderError
from .handle import address_of, as_array, checked_array
from .named import number_of, only_its_names, refuse_other, switch_of


@only_its_names
@dataclass
class SurfaceOptions:
    """What to do with a mesh before it is checked; see meander_surface_options.

    As it is made, nothing is done, and the check is strict.

    merge_distance    vertices this near to another become one; 0: none
    drop_degenerate   faces without area are dissolved, doubled ones dropped
    split_bow_ties    a vertex where fans of faces meet becomes one for each
    cut_non_manifold  edges with more than two faces become boundaries of each
    face_mask         (m,) bool: faces that are False are left out; None: all are in
    vertex_mask       (n,) float64: what lies below mask_threshold is cut away, also across faces
    make_manifold     what keeps faces from being a surface is parted there, so that the faces which
                      continue each other stay joined
    weld_distance     boundary edges that lie this near to each other become one; 0: none
    smallest_part     components whose bounding box has a smaller diagonal are left out; 0: none
    drop_doubled      of polygons with outlines in the same place one is kept
    polygons          (m,) uint32: of which polygon each face is a part; None: faces in one plane
                      that continue each other are one, for all that is known
    """

    merge_distance: float = 0.0
    drop_degenerate: bool = False
    split_bow_ties: bool = False
    cut_non_manifold: bool = False
    face_mask: NDArray[np.bool_] | None = None
    vertex_mask: NDArray[np.float64] | None = None
    mask_threshold: float = 0.0
    make_manifold: bool = False
    weld_distance: float = 0.0
    smallest_part: float = 0.0
    drop_doubled: bool = False
    polygons: NDArray[np.uint32] | None = None

    def __init__(
        self,
        merge_distance: float = 0.0,
        drop_degenerate: bool = False,
        split_bow_ties: bool = False,
        cut_non_manifold: bool = False,
        face_mask: ArrayLike | None = None,
        vertex_mask: ArrayLike | None = None,
        mask_threshold: float = 0.0,
        make_manifold: bool = False,
        weld_distance: float = 0.0,
        smallest_part: float = 0.0,
        drop_doubled: bool = False,
        polygons: ArrayLike | None = None,
    ) -> None:
        self.merge_distance, self.weld_distance = merge_distance, weld_distance
        self.drop_degenerate, self.split_bow_ties = drop_degenerate, split_bow_ties
        self.cut_non_manifold, self.make_manifold = cut_non_manifold, make_manifold
        self.face_mask, self.polygons = as_array(face_mask), as_array(polygons)
        self.vertex_mask, self.mask_threshold = as_array(vertex_mask), mask_threshold
        self.smallest_part, self.drop_doubled = smallest_part, drop_doubled


_SWITCHES = "drop_degenerate split_bow_ties cut_non_manifold make_manifold drop_doubled".split()
_NUMBERS = ("merge_distance", "weld_distance", "smallest_part", "mask_threshold")


def surface_options_record(
    options: SurfaceOptions, vertex_count: int, face_count: int
) -> tuple[SurfaceOptionsRecord, tuple[NDArray[Any], ...]]:
    """The C struct of the options, and the arrays that it points to."""
    refuse_other("options", options, SurfaceOptions)
    record = prepared(SurfaceOptionsRecord)
    for names, read in ((_SWITCHES, switch_of), (_NUMBERS, number_of)):
        for name in names:
            setattr(record, name, read(f"option {name}", getattr(options, name)))
    arrays: list[NDArray[Any]] = []
    for name, dtype, count, element in (
        ("face_mask", np.uint8, face_count, "faces"),
        ("polygons", np.uint32, face_count, "faces"),
        ("vertex_mask", np.float64, vertex_count, "vertices"),
    ):
        value = getattr(options, name)
        if value is None:
            continue
        array = checked_array(name, value, dtype, None)
        if len(array) != count:
            raise MeanderError(
                f"{name} must have one value for each of the {count} {element} of the mesh, not "
                f"{len(array)}"
            )
        arrays.append(array)
        setattr(record, name, address_of(array))
        setattr(record, f"{name}_count", len(array))
    return record, tuple(arrays)
