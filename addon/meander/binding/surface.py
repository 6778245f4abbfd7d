# SPDX-License-Identifier: GPL-3.0-or-later
"""A triangle mesh in the native library, and what is known of it before anything grows."""

from __future__ import annotations

import copy
from ctypes import byref
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .abi import (
    ExtentRecord,
    OutlinesRecord,
    SurfaceOptionsRecord,
    SurfaceStatisticsRecord,
)
from .calls import Found, call, figures_of, prepared
from .choices import CURVATURES, DIRECTIONS
from .context import Context, pointer_of
from .cost import Extent
from .elsewhere import mesh_arrays
from .errors import MeanderError
from .handle import Handle, address_of, as_array, checked_array, chosen, created, narrow_offsets
from .mesh_search import Closest, _closest
from .named import number_of, only_its_names, refuse_other, switch_of, whole_of
from .native_library import native
from .seed import Seed


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


def _surface_options_record(
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


# Figures that reports know by another name than the C header.
_FIGURES = {"flipped_faces": "turned_faces"}


class Surface(Handle):
    """A triangle mesh that the library has checked and copied.

    vertices  (n, 3) float64, finite, in any unit; or a mesh of trimesh or PyVista, without faces
    faces     (m, 3) uint32, zero-based, each below n
    options   how to prepare a mesh with faults, and which part of it to take; None: as it is
    threads   for a large mesh, at most 256; 0: as many as the machine has; the result is the same
    context   where it is cancelled, a MeanderError of the status CANCELLED is raised

    Whatever the options do, nodes, gaps, errors and densities speak of the vertices and faces that
    were passed here. A copy, also in another process (`pickle`, `multiprocessing`), is made from
    them again: a surface keeps its own copy of these arrays.

    Raises MeanderError, naming the first element, for a mesh that cannot be used: no faces, a
    coordinate that is not finite, an index out of range, a vertex twice in a face, a face without
    area, an edge with more than two faces, a bow-tie vertex, a component without orientation; also
    where options leave no faces.
    """

    _what = "surface"

    def __init__(
        self,
        vertices: ArrayLike | Any,
        faces: ArrayLike | None = None,
        options: SurfaceOptions | None = None,
        threads: int = 0,
        context: Context | None = None,
    ) -> None:
        vertex_array, face_array = mesh_arrays(vertices, faces)
        library = native()
        record, arrays = _surface_options_record(
            SurfaceOptions() if options is None else options, len(vertex_array), len(face_array)
        )
        record.threads = whole_of("number of threads", threads)
        with pointer_of(context) as cancelling:
            pointer = created(
                library.meander_surface_create,
                library.meander_surface_destroy,
                address_of(vertex_array),
                len(vertex_array),
                address_of(face_array),
                len(face_array),
                byref(record),
                context=cancelling,
            )
        del arrays
        super().__init__(pointer, library.meander_surface_destroy)
        self.vertex_count = len(vertex_array)
        # Copies: the caller may write to theirs.
        self._made_of = (vertex_array.copy(), face_array.copy(), copy.deepcopy(options), threads)

    def __reduce__(self) -> Any:
        self._alive()
        if type(self) is Surface:
            return Surface, self._made_of
        # A class made from this one may be made of something else, and have attributes of its own.
        own = {name: value for name, value in vars(self).items() if name not in _MADE}
        return _made_again, (type(self), self._made_of), own or None

    def close(self) -> None:
        self._made_of = ()
        super().close()

    def statistics(self) -> dict[str, int | float]:
        """Figures of the surface, named as in meander_surface_statistics but for turned_faces.

        vertices (used ones), faces, components, boundary_loops, turned_faces, unused_vertices, and
        what the options did, merged_vertices, dropped_faces, split_vertices, cut_edges,
        masked_faces, clipped_faces, welded_edges, opened_edges, doubled_faces, split_edges,
        small_parts: int; area (square units) and diagonal (of the bounding box): float.
        """
        record = prepared(SurfaceStatisticsRecord)
        call(native().meander_surface_get_statistics, self._alive(), byref(record))
        # The C name has changed since; reports keep the first one.
        return {_FIGURES.get(name, name): value for name, value in figures_of(record).items()}

    def extent(self, density: ArrayLike | None = None) -> Extent:
        """What there is to fill, for estimate_cost; see meander_surface_measure_extent.

        density  (vertex count,) float64, as for Flow; None: 1 everywhere

        Raises MeanderError for a density that is not positive or of another length.
        """
        values = None if density is None else checked_array("density", density, np.float64, None)
        record = prepared(ExtentRecord)
        call(
            native().meander_surface_measure_extent,
            self._alive(),
            address_of(values),
            0 if values is None else len(values),
            byref(record),
        )
        return Extent(
            record.faces,
            record.length_area,
            record.node_area,
            record.edge_density,
            record.curvature,
        )

    def find_closest(
        self, points: ArrayLike, threads: int = 0, context: Context | None = None
    ) -> Closest:
        """The points of the surface nearest to points (n, 3); see meander_surface_find_closest.

        As the function `find_closest`, but without what the options have left out. Faces and
        weights are those of the mesh as passed here.
        """
        function = native().meander_surface_find_closest
        return _closest(function, (self._alive(),), points, threads, context)

    def outlines(
        self, distance: float, spacing: float, context: Context | None = None
    ) -> tuple[Seed, int]:
        """Lines along the boundary at a distance from it, as guides for a seed.

        Returns them, none for a closed surface, and how many stretches were left out because
        nothing fits there; see meander_surface_find_outlines. Raises MeanderError for lengths out
        of range, and a few milliseconds after `context` has been cancelled.
        """
        found = Found(OutlinesRecord)
        with pointer_of(context) as cancelling:
            record = found.fill(
                native().meander_surface_find_outlines,
                self._alive(),
                number_of("distance", distance),
                number_of("spacing", spacing),
                context=(cancelling,),
            )
        strands = record.strand_count
        seed = Seed(
            found.array("positions", record.point_count, 3),
            narrow_offsets(found.array("offsets", strands + 1)),
            found.array("closed", strands),
            guides=np.ones(strands, dtype=np.uint8),
            loops=True,
        )
        return seed, record.skipped_count

    def curvature(
        self, kind: str, smoothing: float = 0.0, context: Context | None = None
    ) -> NDArray[np.float64]:
        """Curvature at every vertex, (vertex count,) float64.

        See meander_surface_compute_curvature.

        kind       one of CURVATURES
        smoothing  radius over which values are averaged, in the surface's units; 0: none

        Raises MeanderError for an unknown kind and a radius larger than the mesh, and soon after
        `context` has been cancelled.
        """
        values = np.empty(self.vertex_count)
        number = chosen("kind of curvature", kind, CURVATURES)
        with pointer_of(context) as cancelling:
            call(
                native().meander_surface_compute_curvature,
                self._alive(),
                number,
                number_of("smoothing", smoothing),
                address_of(values),
                len(values),
                cancelling,
            )
        return values

    def directions(
        self, kind: str, smoothing: float = 0.0, context: Context | None = None
    ) -> NDArray[np.float64]:
        """A field of lines for `Flow.set_directions`, (vertex count, 3) float64: unit tangent
        vectors, signs arbitrary, zero where there is none; see meander_surface_compute_directions.

        kind       one of DIRECTIONS
        smoothing  as in `curvature`; without meaning for 'smooth'

        Raises MeanderError for an unknown kind and a radius larger than the mesh, and soon after
        `context` has been cancelled.
        """
        directions = np.empty((self.vertex_count, 3))
        number = chosen("kind of directions", kind, DIRECTIONS)
        with pointer_of(context) as cancelling:
            call(
                native().meander_surface_compute_directions,
                self._alive(),
                number,
                number_of("smoothing", smoothing),
                address_of(directions),
                len(directions),
                cancelling,
            )
        return directions

    def turned_directions(
        self, directions: ArrayLike, angles: ArrayLike, context: Context | None = None
    ) -> NDArray[np.float64]:
        """The lines of a field, each turned in the surface by an angle of its own.

        directions  (n, 3) float64, of any length, such as `directions` gives
        angles      (n,) radians, counterclockwise as seen from the side that faces show, each as
                    its component's first one

        Returns directions as `directions` does; zero stays. Raises MeanderError for numbers that
        are not finite and another count of either, and soon after `context` has been cancelled.
        """
        lines = checked_array("the directions", directions, np.float64, 3).copy()
        turns = checked_array("the angles", angles, np.float64, None)
        if len(turns) != len(lines):
            raise MeanderError(
                f"there are {len(turns)} angles for {len(lines)} directions; give one for each"
            )
        with pointer_of(context) as cancelling:
            call(
                native().meander_surface_turn_directions,
                self._alive(),
                address_of(lines),
                address_of(turns),
                len(lines),
                cancelling,
            )
        return lines

    def extended_directions(
        self, points: ArrayLike, offsets: ArrayLike, context: Context | None = None
    ) -> NDArray[np.float64]:
        """The smoothest field of lines that is parallel to strokes drawn on the surface.

        points   (n, 3) float64, stroke after stroke, in the surface's units
        offsets  (s + 1,) uint32: stroke k has the points offsets[k] .. offsets[k + 1] - 1

        Returns directions as `directions` does; zero on components without a stroke. Raises
        MeanderError for offsets that do not fit and points that are not finite, and soon after
        `context` has been cancelled.
        """
        point_array = checked_array("the strokes' points", points, np.float64, 3)
        offset_array = checked_array("the strokes' offsets", offsets, np.uint32, None)
        if len(offset_array) < 2 or offset_array[-1] != len(point_array):
            raise MeanderError(
                f"the strokes' offsets must rise from 0 to the number of points, {len(point_array)}"
            )
        ends = offset_array.astype(np.uint64)
        directions = np.empty((self.vertex_count, 3))
        with pointer_of(context) as cancelling:
            call(
                native().meander_surface_compute_stroke_directions,
                self._alive(),
                address_of(point_array),
                len(point_array),
                address_of(ends),
                len(ends) - 1,
                address_of(directions),
                len(directions),
                cancelling,
            )
        return directions


# What a surface itself has.
_MADE = ("_pointer", "_finalizer", "_made_of", "vertex_count")


def _made_again(kind: type[Surface], made_of: tuple[Any, ...]) -> Surface:
    """A surface of a class made from Surface, from what Surface is made of."""
    surface = kind.__new__(kind)
    Surface.__init__(surface, *made_of)
    return surface

