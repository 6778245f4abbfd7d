# SPDX-License-Identifier: GPL-3.0-or-later
"""A triangle mesh in the native library, and what is known of it before anything grows."""

from __future__ import annotations

import copy
from ctypes import byref, c_void_p
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .abi import (
    ExtentRecord,
    OutlinesRecord,
    SurfaceStatisticsRecord,
)
from .calls import Found, call, figures_of, prepared
from .choices import CURVATURES, DIRECTIONS
from .context import Context, pointer_of
from .cost import Extent
from .elsewhere import mesh_arrays
from .errors import MeanderError
from .handle import Handle, address_of, checked_array, chosen, narrow_offsets
from .mesh_search import Closest, _closest
from .named import number_of, whole_of
from .native_library import native
from .seed import Seed
from .surface_options import SurfaceOptions, surface_options_record
from .work import Work

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
        self._making(vertices, faces, options, threads).now(context)

    @classmethod
    def work(
        cls,
        vertices: ArrayLike | Any,
        faces: ArrayLike | None = None,
        options: SurfaceOptions | None = None,
        threads: int = 0,
    ) -> Work[Surface]:
        """A surface that is still to be made, on a thread of the library's if need be."""
        return cls.__new__(cls)._making(vertices, faces, options, threads)

    def _making(
        self,
        vertices: ArrayLike | Any,
        faces: ArrayLike | None,
        options: SurfaceOptions | None,
        threads: int,
    ) -> Work[Surface]:
        vertex_array, face_array = mesh_arrays(vertices, faces)
        # The arrays behind the record must outlive the call.
        record, arrays = surface_options_record(
            SurfaceOptions() if options is None else options, len(vertex_array), len(face_array)
        )
        record.threads = whole_of("number of threads", threads)
        pointer, destroy = c_void_p(), native().meander_surface_destroy

        def made() -> Surface:
            Handle.__init__(self, pointer.value, destroy)
            self.vertex_count = len(vertex_array)
            # Copies: the caller may write to theirs.
            copies = vertex_array.copy(), face_array.copy(), copy.deepcopy(options)
            self._made_of = (*copies, threads)
            return self

        return Work(
            "surface_create",
            "surface",
            (
                address_of(vertex_array),
                len(vertex_array),
                address_of(face_array),
                len(face_array),
                byref(record),
                byref(pointer),
            ),
            made,
            undo=lambda: destroy(pointer),
            holds=arrays,
        )

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
        return self.extent_work(density).now()

    def extent_work(self, density: ArrayLike | None = None) -> Work[Extent]:
        """`extent`, to be measured."""
        values = None if density is None else checked_array("density", density, np.float64, None)
        record = prepared(ExtentRecord)

        def measured() -> Extent:
            return Extent(
                record.faces,
                record.length_area,
                record.node_area,
                record.edge_density,
                record.curvature,
            )

        count = 0 if values is None else len(values)
        arguments = (self._alive(), address_of(values), count, byref(record))
        return Work(
            "surface_measure_extent", "extent", arguments, measured, holds=values, cancelled=False
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
        return self.curvature_work(kind, smoothing).now(context)

    def curvature_work(self, kind: str, smoothing: float = 0.0) -> Work[NDArray[np.float64]]:
        """`curvature`, to be computed."""
        number = chosen("kind of curvature", kind, CURVATURES)
        return self._field_work("curvature", number, smoothing, np.empty(self.vertex_count))

    def _field_work(
        self, what: str, kind: int, smoothing: float, values: NDArray[np.float64]
    ) -> Work[NDArray[np.float64]]:
        length = number_of("smoothing", smoothing)
        arguments = (self._alive(), kind, length, address_of(values), len(values))
        return Work(f"surface_compute_{what}", what, arguments, lambda: values)

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
        return self.directions_work(kind, smoothing).now(context)

    def directions_work(self, kind: str, smoothing: float = 0.0) -> Work[NDArray[np.float64]]:
        """`directions`, to be computed."""
        number = chosen("kind of directions", kind, DIRECTIONS)
        return self._field_work("directions", number, smoothing, np.empty((self.vertex_count, 3)))

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

