# SPDX-License-Identifier: GPL-3.0-or-later
"""The bridge to the native library: numpy in, numpy out, no bpy.

Two modules stand below it, and only these three know ctypes: `abi` mirrors ``meander.h``, and
`native_library` finds and loads the library.

    surface = Surface(vertices, faces)           checked and copied by the library
    options = default_options("even")            defaults live in the library only
    options.radius = spacing / 2
    flow = Flow(surface, options, seed, density)
    flow.run(context)                            context.cancel() from any thread
    curve = flow.polylines()

    flow.start(context)                          the same run on a thread of the library's
    while flow.running:
        preview = flow.preview()                 the curve as it grows; None: nothing new
    reason = flow.wait()

Lengths are in the units of the vertices; indices are zero-based. Everything that goes wrong is a
`MeanderError` whose text is one sentence for people. Calls into the library release the GIL.

Threads: a surface may be shared, a flow belongs to one thread at a time (a second thread gets a
`MeanderError`), a context may be touched from any thread at any time. A host that must not have a
Python thread of its own starts the flow, and the library runs it on one that knows no Python.
"""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from ctypes import Structure, byref, c_size_t, c_uint32, c_void_p, sizeof
from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .abi import (
    ABI_VERSION,
    ALIGNMENTS,
    CURVATURES,
    DIRECTIONS,
    ELEMENT_KINDS,
    PRESETS,
    STOP_REASONS,
    VERSION,
    BoundaryRule,
    ErrorRecord,
    FlowOptionsRecord,
    FlowStatisticsRecord,
    IterationRecord,
    MedialAxis,
    PreviewRecord,
    SeedRecord,
    Status,
    StopRule,
    SurfaceOptionsRecord,
    SurfaceStatisticsRecord,
)
from .native_library import (
    LIBRARY_VARIABLE,
    STATUS_NO_LIBRARY,
    Handle,
    MeanderError,
    address_of,
    checked_array,
    library_path,
    library_version,
    native,
    new_error,
    raise_error,
    struct_layouts,
)

# What hosts use; they import nothing else of the three modules.
__all__ = [
    "ABI_VERSION",
    "ALIGNMENTS",
    "CURVATURES",
    "DIRECTIONS",
    "ELEMENT_KINDS",
    "LIBRARY_VARIABLE",
    "PRESETS",
    "STATUS_NO_LIBRARY",
    "STOP_REASONS",
    "VERSION",
    "BoundaryRule",
    "Context",
    "Flow",
    "FlowOptions",
    "Gaps",
    "MeanderError",
    "MedialAxis",
    "Nodes",
    "PointData",
    "Polylines",
    "Preview",
    "Seed",
    "Status",
    "StopRule",
    "Surface",
    "SurfaceOptions",
    "default_options",
    "library_path",
    "library_version",
    "option_warnings",
    "struct_layouts",
]


# ------------------------------------------------------------------------------------------------
# Context


class Context(Handle):
    """Cancels a flow and reports its progress, from any thread at any time.

    A cancel is sticky: every call that was given this context returns 'cancelled' within one
    iteration, and so do later ones, until `reset`.
    """

    _what = "context"

    def __init__(self) -> None:
        library = native()
        pointer = library.meander_context_create()
        if not pointer:
            raise MeanderError(
                "there is no memory for a context; close other programs and try again",
                Status.OUT_OF_MEMORY,
            )
        super().__init__(pointer, library.meander_context_destroy)
        # Counts the calls that use the native context, so that close() cannot pull it away.
        self._lock = threading.Lock()
        self._users = 0
        self._closing = False

    @contextmanager
    def _use(self) -> Iterator[int]:
        with self._lock:
            if self._closing:
                raise MeanderError("this context has been closed; make a new one")
            pointer = self._alive()
            self._users += 1
        try:
            yield pointer
        finally:
            with self._lock:
                self._users -= 1
                if self._closing and self._users == 0:
                    super().close()

    def cancel(self) -> None:
        """Asks the calls that use this context to end within one iteration."""
        with self._use() as pointer:
            native().meander_context_cancel(pointer)

    def reset(self) -> None:
        """Takes a cancel back, so that the context can be used again."""
        with self._use() as pointer:
            native().meander_context_reset(pointer)

    @property
    def progress(self) -> float:
        """How far the present run of a flow is, from 0 to 1; never falls during one run."""
        with self._use() as pointer:
            return native().meander_context_progress(pointer)

    def close(self) -> None:
        """Frees the context, at once or as soon as the last call that uses it has ended."""
        with self._lock:
            self._closing = True
            if self._users == 0:
                super().close()


# ------------------------------------------------------------------------------------------------
# Surface


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
    """

    merge_distance: float = 0.0
    drop_degenerate: bool = False
    split_bow_ties: bool = False
    cut_non_manifold: bool = False
    face_mask: NDArray[np.bool_] | None = None
    vertex_mask: NDArray[np.float64] | None = None
    mask_threshold: float = 0.0


def _surface_options_record(
    options: SurfaceOptions, vertex_count: int, face_count: int
) -> tuple[SurfaceOptionsRecord, tuple[NDArray[Any], ...]]:
    """The C struct of the options, and the arrays that it points to."""
    record = SurfaceOptionsRecord()
    native().meander_surface_options_init(byref(record))
    record.drop_degenerate = bool(options.drop_degenerate)
    record.split_bow_ties = bool(options.split_bow_ties)
    record.cut_non_manifold = bool(options.cut_non_manifold)
    record.merge_distance = float(options.merge_distance)
    record.mask_threshold = float(options.mask_threshold)
    arrays: list[NDArray[Any]] = []
    for name, dtype, count, element in (
        ("face_mask", np.uint8, face_count, "faces"),
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
    return record, tuple(arrays)


class Surface(Handle):
    """A triangle mesh that the library has checked and copied.

    vertices  (n, 3) float64, finite, in any unit
    faces     (m, 3) uint32, zero-based, each below n
    options   how to prepare a mesh with faults, and which part of it to take; None: as it is
    threads   for a large mesh, at most 256; 0: as many as the machine has; the result is the same

    Whatever the options do, nodes, gaps, errors and densities speak of the vertices and faces that
    were passed here.

    Raises MeanderError, naming the first element, for a mesh that cannot be used: no faces, a
    coordinate that is not finite, an index out of range, a vertex twice in a face, a face without
    area, an edge with more than two faces, a bow-tie vertex, a component without orientation; also
    where options leave no faces.
    """

    _what = "surface"

    def __init__(
        self,
        vertices: ArrayLike,
        faces: ArrayLike,
        options: SurfaceOptions | None = None,
        threads: int = 0,
    ) -> None:
        vertex_array = checked_array("vertices", vertices, np.float64, 3)
        face_array = checked_array("faces", faces, np.uint32, 3)
        library = native()
        pointer = c_void_p()
        error = new_error()
        record, arrays = _surface_options_record(
            SurfaceOptions() if options is None else options, len(vertex_array), len(face_array)
        )
        record.threads = int(threads)
        status = library.meander_surface_create_prepared(
            address_of(vertex_array),
            len(vertex_array),
            address_of(face_array),
            len(face_array),
            byref(record),
            byref(pointer),
            byref(error),
        )
        del arrays
        if status != Status.OK:
            raise_error(status, error)
        super().__init__(pointer.value, library.meander_surface_destroy)
        self.vertex_count = len(vertex_array)

    def statistics(self) -> dict[str, int | float]:
        """Figures of the surface, named as in meander_surface_statistics.

        vertices (used ones), faces, components, boundary_loops, turned_faces, unused_vertices, and
        what the options did, merged_vertices, dropped_faces, split_vertices, cut_edges,
        masked_faces, clipped_faces: int; area (square units) and diagonal (of the bounding box):
        float.
        """
        record = SurfaceStatisticsRecord(struct_size=sizeof(SurfaceStatisticsRecord))
        error = new_error()
        status = native().meander_surface_get_statistics(self._alive(), byref(record), byref(error))
        if status != Status.OK:
            raise_error(status, error)
        return _figures(record)

    def outlines(self, distance: float, spacing: float) -> tuple[Seed, int]:
        """Lines along the boundary at a distance from it, as guides for a seed.

        Returns them, none for a closed surface, and how many stretches were left out because
        nothing fits there; see meander_surface_get_outlines. Raises MeanderError for lengths out
        of range.
        """
        function = native().meander_surface_get_outlines
        error = new_error()
        points, strands = c_size_t(), c_size_t()
        skipped = np.zeros(1, dtype=np.uint32)
        point_room, strand_room = _OUTLINE_ROOM
        while True:
            positions = np.empty((point_room, 3))
            offsets = np.zeros(strand_room + 1, dtype=np.uint32)
            closed = np.empty(strand_room, dtype=np.uint8)
            status = function(
                self._alive(),
                float(distance),
                float(spacing),
                address_of(positions),
                point_room,
                byref(points),
                address_of(offsets),
                address_of(closed),
                strand_room,
                byref(strands),
                address_of(skipped),
                byref(error),
            )
            if status != Status.OK:
                raise_error(status, error)
            if points.value <= point_room and strands.value <= strand_room:
                break
            point_room, strand_room = points.value, strands.value
        count = strands.value
        seed = Seed(
            positions[: points.value].copy(),
            offsets[: count + 1].copy(),
            closed[:count].copy(),
            guides=np.ones(count, dtype=np.uint8),
            loops=True,
        )
        return seed, int(skipped[0])

    def curvature(self, kind: str, smoothing: float = 0.0) -> NDArray[np.float64]:
        """Curvature at every vertex, (vertex count,) float64; see meander_surface_get_curvature.

        kind       one of CURVATURES
        smoothing  radius over which values are averaged, in the surface's units; 0: none

        Raises MeanderError for an unknown kind and a radius larger than the mesh.
        """
        values = np.empty(self.vertex_count)
        number = _choice("kind of curvature", kind, CURVATURES)
        error = new_error()
        status = native().meander_surface_get_curvature(
            self._alive(), number, float(smoothing), address_of(values), len(values), byref(error)
        )
        if status != Status.OK:
            raise_error(status, error)
        return values

    def directions(self, kind: str, smoothing: float = 0.0) -> NDArray[np.float64]:
        """A field of lines for `Flow.set_directions`, (vertex count, 3) float64: unit tangent
        vectors, signs arbitrary, zero where there is none; see meander_surface_get_directions.

        kind       one of DIRECTIONS
        smoothing  as in `curvature`; without meaning for 'smooth'

        Raises MeanderError for an unknown kind and a radius larger than the mesh.
        """
        directions = np.empty((self.vertex_count, 3))
        number = _choice("kind of directions", kind, DIRECTIONS)
        error = new_error()
        status = native().meander_surface_get_directions(
            self._alive(),
            number,
            float(smoothing),
            address_of(directions),
            len(directions),
            byref(error),
        )
        if status != Status.OK:
            raise_error(status, error)
        return directions

    def extended_directions(self, points: ArrayLike, offsets: ArrayLike) -> NDArray[np.float64]:
        """The smoothest field of lines that is parallel to strokes drawn on the surface.

        points   (n, 3) float64, stroke after stroke, in the surface's units
        offsets  (s + 1,) uint32: stroke k has the points offsets[k] .. offsets[k + 1] - 1

        Returns directions as `directions` does; zero on components without a stroke. Raises
        MeanderError for offsets that do not fit and points that are not finite.
        """
        point_array = checked_array("the strokes' points", points, np.float64, 3)
        offset_array = checked_array("the strokes' offsets", offsets, np.uint32, None)
        if len(offset_array) < 2 or offset_array[-1] != len(point_array):
            raise MeanderError(
                f"the strokes' offsets must rise from 0 to the number of points, {len(point_array)}"
            )
        directions = np.empty((self.vertex_count, 3))
        error = new_error()
        status = native().meander_surface_extend_directions(
            self._alive(),
            address_of(point_array),
            address_of(offset_array),
            len(offset_array) - 1,
            address_of(directions),
            len(directions),
            byref(error),
        )
        if status != Status.OK:
            raise_error(status, error)
        return directions


def _choice(what: str, value: str, choices: tuple[str, ...]) -> int:
    if value not in choices:
        raise MeanderError(f"there is no {what} {value!r}; choose one of {', '.join(choices)}")
    return choices.index(value)


# Room for outlines that is offered at once, in points and strands: asking would compute twice.
_OUTLINE_ROOM = (1 << 14, 1 << 8)


def _figures(record: Structure) -> dict[str, Any]:
    """The fields of a struct that mean something to a reader, by their C names."""
    names = [field[0] for field in record._fields_ if field[0] not in ("struct_size", "reserved")]
    return {name: getattr(record, name) for name in names}


# ------------------------------------------------------------------------------------------------
# Seed and options


@dataclass
class Seed:
    """Strands to start from, in space; every point is moved to the nearest point of the surface.

    points   (n, 3) float64, strand after strand, in the surface's units
    offsets  (s + 1,) uint32: strand k has the points offsets[k] .. offsets[k + 1] - 1
    closed   (s,) uint8: 1 closed (first point not repeated), 0 open
    fixed    (n,) uint8: 1 never moves; None: every point may move
    guides   (s,) uint8: 1 for a strand that stays as it is and that the others keep away from;
             None: none
    loops    regions between guides, and components, without a growing strand get a small loop
    """

    points: NDArray[np.float64]
    offsets: NDArray[np.uint32]
    closed: NDArray[np.uint8]
    fixed: NDArray[np.uint8] | None = None
    guides: NDArray[np.uint8] | None = None
    loops: bool = False


@dataclass
class FlowOptions:
    """Options of one flow, named as in meander_flow_options, where each is described.

    Made by `default_options` only; the defaults live in the library. Lengths are in the surface's
    units. `radius` is half the spacing and must be chosen.
    """

    preset: str
    radius: float
    segment_length: float
    max_radius: float
    length_weight: float
    bending_weight: float
    medial_weight: float
    alignment_weight: float
    length_power: float
    medial_power: float
    step: float
    growth_coarsening: float
    start_spacing_factor: float
    polish: bool
    stop_rule: StopRule
    polish_bending_weight: float
    polish_length_offset: float
    polish_length_gain: float
    polish_medial_power: float
    border_distance: float
    boundary_rule: BoundaryRule
    iteration_limit: int
    threads: int
    ripening_iterations: int
    medial_axis: MedialAxis


def _preset_number(preset: str) -> int:
    if preset not in PRESETS:
        raise MeanderError(f"there is no preset {preset!r}; choose one of {', '.join(PRESETS)}")
    return PRESETS.index(preset)


def default_options(preset: str = "even") -> FlowOptions:
    """The library's defaults for a preset of PRESETS; radius is 0 and must be chosen.

    Raises MeanderError for an unknown preset.
    """
    record = FlowOptionsRecord()
    status = native().meander_flow_options_init(byref(record), _preset_number(preset))
    if status != Status.OK:
        raise MeanderError(f"the native library does not know the preset {preset!r}", status)
    values = _figures(record)
    values["preset"] = PRESETS[record.preset]
    values["polish"] = bool(record.polish)
    values["stop_rule"] = StopRule(record.stop_rule)
    values["boundary_rule"] = BoundaryRule(record.boundary_rule)
    values["medial_axis"] = MedialAxis(record.medial_axis)
    return FlowOptions(**values)


def _options_record(options: FlowOptions) -> FlowOptionsRecord:
    record = FlowOptionsRecord(struct_size=sizeof(FlowOptionsRecord))
    kinds = {field[0]: field[1] for field in FlowOptionsRecord._fields_}
    for field in fields(FlowOptions):
        value = getattr(options, field.name)
        if field.name == "preset":
            value = _preset_number(value)
        try:
            if kinds[field.name] is c_uint32:
                number = int(value)
                # ctypes would wrap -1 round to 4294967295 without a word.
                if number != value or not 0 <= number <= 0xFFFFFFFF:
                    raise ValueError
                setattr(record, field.name, number)
            else:
                setattr(record, field.name, float(value))
        except (TypeError, ValueError, OverflowError) as problem:
            wanted = "a whole number, 0 or more" if kinds[field.name] is c_uint32 else "a number"
            raise MeanderError(
                f"the option {field.name} must be {wanted}, not {value!r}"
            ) from problem
    return record


def option_warnings(options: FlowOptions) -> list[str]:
    """What is allowed but seldom meant in the options, one sentence each.

    See meander_flow_options_get_warning. Raises MeanderError for values of the wrong type.
    """
    record = _options_record(options)
    function = native().meander_flow_options_get_warning
    warnings: list[str] = []
    while size := function(byref(record), len(warnings), None, 0):
        text = ctypes.create_string_buffer(size)
        function(byref(record), len(warnings), text, size)
        warnings.append(text.value.decode("utf-8"))
    return warnings


# ------------------------------------------------------------------------------------------------
# Flow


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


class Preview(NamedTuple):
    """The curve of a started run between two iterations.

    iterations  over the life of the flow
    nodes       of the curve
    length      of the curve
    seconds     of all iterations
    """

    polylines: Polylines
    iterations: int
    nodes: int
    length: float
    seconds: float


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

    arc_lengths   (n,) float64, way along the strand from its first point
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
    """

    positions: NDArray[np.float64]
    radii: NDArray[np.float64]
    sizes: NDArray[np.float64]
    faces: NDArray[np.uint32]

    def __len__(self) -> int:
        return len(self.sizes)


# Room for gaps that is offered at once: asking for the number first would search twice.
_GAP_ROOM = 256


class Flow(Handle):
    """A curve that grows on a surface. It belongs to one thread at a time.

    surface   stays usable and may be closed; the flow keeps what it needs of it
    options   see `default_options`; read once
    seed      a Seed, or None: one small closed strand per component
    density   (vertex count of the surface,) float64, each > 0, or None for 1 everywhere: the
              local spacing is the spacing divided by sqrt(density)

    Raises MeanderError for options out of range, a density of the wrong length or sign, and a seed
    that is off the surface, crosses or touches itself, or is too short.
    """

    _what = "flow"

    def __init__(
        self,
        surface: Surface,
        options: FlowOptions,
        seed: Seed | None = None,
        density: ArrayLike | None = None,
    ) -> None:
        density_array = None
        if density is not None:
            density_array = checked_array("density", density, np.float64, None)
            if len(density_array) != surface.vertex_count:
                raise MeanderError(
                    f"density must have one value for each of the {surface.vertex_count} vertices "
                    f"of the surface, not {len(density_array)}"
                )
        # The arrays behind the record must outlive the call, hence the second name.
        seed_record, seed_arrays = (None, ()) if seed is None else _seed_record(seed)
        record = _options_record(options)
        library = native()
        pointer = c_void_p()
        error = new_error()
        status = library.meander_flow_create(
            surface._alive(),
            None if seed_record is None else byref(seed_record),
            address_of(density_array),
            byref(record),
            byref(pointer),
            byref(error),
        )
        del seed_arrays
        if status != Status.OK:
            raise_error(status, error)
        super().__init__(pointer.value, library.meander_flow_destroy)
        self._busy = threading.Lock()
        self._seen = 0  # serial of the last preview handed out

    @contextmanager
    def _use(self) -> Iterator[int]:
        """The native flow, for this thread alone.

        The library does not check the thread rule; two threads in one flow would corrupt memory.
        """
        if not self._busy.acquire(blocking=False):
            raise MeanderError(
                "this flow is in use on another thread; wait until its call has ended"
            )
        try:
            yield self._alive()
        finally:
            self._busy.release()

    def close(self) -> None:
        """Frees the flow; raises MeanderError while another thread is using it.

        A started run is cancelled and waited for: an iteration at most.
        """
        if self._pointer is not None:
            with self._use():
                super().close()

    def set_directions(self, directions: ArrayLike | None, kind: str = "along") -> None:
        """Gives the field of lines that the option alignment_weight refers to, before any step.

        directions  (vertex count of the surface, 3) float64, of any length and either sign; zero
                    or not finite: no wish there. None: takes a field back
        kind        one of ALIGNMENTS: the curve lies along the field, or across it

        Raises MeanderError for an array that does not fit, a field without any direction in the
        surface, and a flow that has made an iteration.
        """
        array = None
        if directions is not None:
            array = checked_array("directions", directions, np.float64, 3)
        number = _choice("kind of alignment", kind, ALIGNMENTS)
        error = new_error()
        with self._use() as pointer:
            status = native().meander_flow_set_directions(
                pointer, address_of(array), 0 if array is None else len(array), number, byref(error)
            )
        if status != Status.OK:
            raise_error(status, error)

    def step(self, context: Context | None = None) -> str:
        """Runs one iteration and returns the stop reason, one of STOP_REASONS.

        A step is taken whatever the reason says, so the caller decides when to stop. 'cancelled'
        leaves the state of the last whole iteration; the flow can go on.
        """
        return self._advance("meander_flow_step", context)

    def run(self, context: Context | None = None) -> str:
        """Steps until the flow converges, stalls, is cancelled or reaches its iteration limit.

        Returns which of these it was, one of STOP_REASONS. 'cancelled' leaves the last whole
        iteration in place; the flow can go on.
        """
        return self._advance("meander_flow_run", context)

    def _advance(self, name: str, context: Context | None) -> str:
        error = new_error()
        with self._use() as pointer:
            function = getattr(native(), name)
            if context is None:
                status = function(pointer, None, byref(error))
            else:
                with context._use() as context_pointer:
                    status = function(pointer, context_pointer, byref(error))
            return self._reason(pointer, status, error)

    def _reason(self, pointer: int, status: int, error: ErrorRecord) -> str:
        if status == Status.CANCELLED:
            return "cancelled"
        if status != Status.OK:
            raise_error(status, error)
        return STOP_REASONS[native().meander_flow_stop_reason(pointer)]

    def start(self, context: Context | None = None) -> None:
        """Begins `run` on a thread of the library's and returns at once; the curve is the same.

        Until `wait`, everything but `running`, `preview`, `wait` and `close` raises MeanderError.
        The context may be closed meanwhile, but then the run can only be ended by `close`.
        """
        function = native().meander_flow_start
        error = new_error()
        with self._use() as pointer:
            if context is None:
                status = function(pointer, None, byref(error))
            else:
                with context._use() as context_pointer:
                    status = function(pointer, context_pointer, byref(error))
            if status != Status.OK:
                raise_error(status, error)
            self._seen = 0
            # The interpreter must not go while the library computes; no other thread of Python's
            # can be inside the flow but in `wait`, which takes this back.
            self._finalizer.atexit = True

    @property
    def running(self) -> bool:
        """Whether a started run is still going. Any thread; costs nothing."""
        return bool(native().meander_flow_is_running(self._alive()))

    def wait(self) -> str:
        """Waits for the end of a started run; returns or raises what `run` would have.

        Raises MeanderError also when no run has been started since the last wait.
        """
        error = new_error()
        with self._use() as pointer:
            self._finalizer.atexit = False
            status = native().meander_flow_wait(pointer, byref(error))
            return self._reason(pointer, status, error)

    def preview(self) -> Preview | None:
        """The newest copy of the curve of a started run, once; None while there is no newer one.

        The first is of the curve at the start; the run makes the next one, after its present
        iteration, when this one has been taken. Raises MeanderError before `start` and after
        `wait`.
        """
        function = native().meander_flow_get_preview
        error = new_error()
        figures = PreviewRecord(struct_size=sizeof(PreviewRecord))
        points, strands = c_size_t(), c_size_t()
        with self._use() as pointer:
            status = function(
                pointer,
                byref(figures),
                None,
                None,
                0,
                byref(points),
                None,
                None,
                0,
                byref(strands),
                byref(error),
            )
            if status != Status.OK:
                raise_error(status, error)
            if figures.serial == self._seen:
                return None
            curve = _empty_polylines(points.value, strands.value)
            # The copy has not been taken yet, so that it is still the newest, of the same sizes.
            status = function(
                pointer,
                byref(figures),
                address_of(curve.positions),
                address_of(curve.normals),
                points.value,
                byref(points),
                address_of(curve.offsets),
                address_of(curve.closed),
                strands.value,
                byref(strands),
                byref(error),
            )
            if status != Status.OK:
                raise_error(status, error)
            self._seen = figures.serial
        return Preview(curve, figures.iterations, figures.nodes, figures.length, figures.seconds)

    def set_vertices(self, vertices: ArrayLike) -> None:
        """Moves the vertices of the flow's surface, and the curve with it; see the C header.

        vertices  (n, 3) float64, as many and in the order as passed to Surface

        The curve rides on its faces and is straightened; the steps that follow make it even again.
        Raises MeanderError, and leaves the flow as it was, for another number of vertices, a
        coordinate that is not finite, a face without area, and a surface that has become too small
        or too large for the spacing.
        """
        array = checked_array("vertices", vertices, np.float64, 3)
        error = new_error()
        with self._use() as pointer:
            status = native().meander_flow_set_vertices(
                pointer, address_of(array), len(array), byref(error)
            )
        if status != Status.OK:
            raise_error(status, error)

    def _statistics(self, pointer: int) -> FlowStatisticsRecord:
        record = FlowStatisticsRecord(struct_size=sizeof(FlowStatisticsRecord))
        error = new_error()
        status = native().meander_flow_get_statistics(pointer, byref(record), byref(error))
        if status != Status.OK:
            raise_error(status, error)
        return record

    def statistics(self) -> dict[str, Any]:
        """Figures of the present state, named as in meander_flow_statistics.

        stop_reason is one of STOP_REASONS, polishing a bool, counts are int; lengths are in the
        surface's units, times in seconds. Costs one medial axis and one crossing test.
        """
        with self._use() as pointer:
            record = self._statistics(pointer)
        values = _figures(record)
        values["stop_reason"] = STOP_REASONS[record.stop_reason]
        values["polishing"] = bool(record.polishing)
        return values

    def history(self) -> list[dict[str, int | float]]:
        """One record per iteration, oldest first, named as in meander_iteration.

        iteration (from 1) and nodes: int; length, mean_step, energy, seconds: float.
        """
        library = native()
        error = new_error()
        count = c_size_t()
        with self._use() as pointer:
            status = library.meander_flow_get_history(pointer, None, 0, byref(count), byref(error))
            if status != Status.OK:
                raise_error(status, error)
            records = (IterationRecord * count.value)()
            status = library.meander_flow_get_history(
                pointer, records, count.value, byref(count), byref(error)
            )
            if status != Status.OK:
                raise_error(status, error)
        return [_figures(record) for record in records]

    def polylines(self) -> Polylines:
        """The present curve, nodes and edge crossings; strands come in the order of the seed's."""
        function = native().meander_flow_get_polylines
        error = new_error()
        points = c_size_t()
        strands = c_size_t()
        with self._use() as pointer:
            status = function(
                pointer, None, None, 0, byref(points), None, None, 0, byref(strands), byref(error)
            )
            if status != Status.OK:
                raise_error(status, error)
            curve = _empty_polylines(points.value, strands.value)
            status = function(
                pointer,
                address_of(curve.positions),
                address_of(curve.normals),
                points.value,
                byref(points),
                address_of(curve.offsets),
                address_of(curve.closed),
                strands.value,
                byref(strands),
                byref(error),
            )
            if status != Status.OK:
                raise_error(status, error)
        return curve

    def guides(self) -> NDArray[np.bool_]:
        """(s,) bool: which strands are guides, in the order of the polylines."""
        function = native().meander_flow_get_guides
        error = new_error()
        count = c_size_t()
        with self._use() as pointer:
            status = function(pointer, None, 0, byref(count), byref(error))
            if status != Status.OK:
                raise_error(status, error)
            flags = np.empty(count.value, dtype=np.uint8)
            status = function(pointer, address_of(flags), len(flags), byref(count), byref(error))
            if status != Status.OK:
                raise_error(status, error)
        return flags.astype(bool)

    def nodes(self) -> Nodes:
        """The present nodes, strand after strand."""
        function = native().meander_flow_get_nodes
        error = new_error()
        count = c_size_t()
        with self._use() as pointer:
            status = function(pointer, None, None, None, None, 0, byref(count), byref(error))
            if status != Status.OK:
                raise_error(status, error)
            nodes = Nodes(
                np.empty(count.value, dtype=np.uint32),
                np.empty((count.value, 3)),
                np.empty((count.value, 2)),
                np.empty(count.value, dtype=np.uint8),
            )
            status = function(
                pointer,
                *(address_of(array) for array in nodes),
                count.value,
                byref(count),
                byref(error),
            )
            if status != Status.OK:
                raise_error(status, error)
        return nodes

    def point_data(self) -> PointData:
        """What is known of every point of `polylines()`, in their order. Costs a medial axis."""
        function = native().meander_flow_get_point_data
        error = new_error()
        count = c_size_t()
        with self._use() as pointer:
            status = function(pointer, *(None,) * 6, 0, byref(count), byref(error))
            if status != Status.OK:
                raise_error(status, error)
            data = PointData(
                np.empty(count.value),
                np.empty((count.value, 3)),
                np.empty((count.value, 3)),
                np.empty((count.value, 2)),
                np.empty(count.value, dtype=np.uint32),
                np.empty((count.value, 3)),
            )
            status = function(
                pointer,
                *(address_of(array) for array in data),
                count.value,
                byref(count),
                byref(error),
            )
            if status != Status.OK:
                raise_error(status, error)
        return data

    def gaps(self, least_size: float = 0.0) -> Gaps:
        """The places that the present curve leaves empty; see meander_flow_get_gaps.

        least_size   how far from the curve a place must be to count, in local r, at least 1;
                     0 leaves it to the library, which takes 1.2

        Costs one medial axis and a search; the curve stays as it is. Raises MeanderError for a
        size out of range.
        """
        function = native().meander_flow_get_gaps
        error = new_error()
        count = c_size_t()
        room = _GAP_ROOM
        with self._use() as pointer:
            while True:
                gaps = Gaps(
                    np.empty((room, 3)),
                    np.empty(room),
                    np.empty(room),
                    np.empty(room, dtype=np.uint32),
                )
                status = function(
                    pointer,
                    float(least_size),
                    *(address_of(getattr(gaps, field.name)) for field in fields(Gaps)),
                    room,
                    byref(count),
                    byref(error),
                )
                if status != Status.OK:
                    raise_error(status, error)
                if count.value <= room:
                    break
                room = count.value
        return Gaps(*(getattr(gaps, field.name)[: count.value].copy() for field in fields(Gaps)))


def _empty_polylines(points: int, strands: int) -> Polylines:
    return Polylines(
        np.empty((points, 3)),
        np.empty((points, 3)),
        np.zeros(strands + 1, dtype=np.uint32),
        np.empty(strands, dtype=np.uint8),
    )


def _seed_record(seed: Seed) -> tuple[SeedRecord, tuple[NDArray[Any], ...]]:
    """The C struct of a seed, and the arrays that it points to.

    The library cannot see how long the arrays are, so their lengths are checked here.
    """
    points = checked_array("the seed's points", seed.points, np.float64, 3)
    offsets = checked_array("the seed's offsets", seed.offsets, np.uint32, None)
    closed = checked_array("the seed's closed flags", seed.closed, np.uint8, None)
    fixed = None
    if seed.fixed is not None:
        fixed = checked_array("the seed's fixed flags", seed.fixed, np.uint8, None)
    if len(offsets) != len(closed) + 1 or len(closed) == 0:
        raise MeanderError(
            "a seed needs at least one strand and one more offset than strands, not "
            f"{len(offsets)} offsets for {len(closed)} strands",
            Status.INVALID_SEED,
        )
    if offsets[0] != 0 or offsets[-1] != len(points) or np.any(offsets[1:] < offsets[:-1]):
        raise MeanderError(
            f"the seed's offsets must rise from 0 to the number of its points, {len(points)}",
            Status.INVALID_SEED,
        )
    if fixed is not None and len(fixed) != len(points):
        raise MeanderError(
            f"the seed needs one fixed flag for each of its {len(points)} points, not {len(fixed)}",
            Status.INVALID_SEED,
        )
    guides = None
    if seed.guides is not None:
        guides = checked_array("the seed's guide flags", seed.guides, np.uint8, None)
        if len(guides) != len(closed):
            raise MeanderError(
                f"the seed needs one guide flag for each of its {len(closed)} strands, "
                f"not {len(guides)}",
                Status.INVALID_SEED,
            )
    record = SeedRecord(
        struct_size=sizeof(SeedRecord),
        strand_count=len(closed),
        points=address_of(points),
        offsets=address_of(offsets),
        closed=address_of(closed),
        fixed=address_of(fixed),
        guides=address_of(guides),
        loops=int(seed.loops),
    )
    optional = tuple(array for array in (fixed, guides) if array is not None)
    return record, (points, offsets, closed, *optional)
